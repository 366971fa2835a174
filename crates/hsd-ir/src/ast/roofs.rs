//! The roof section of a house (`docs/evidence.md` 6).

use crate::ast::Paint;
use hsd_base::source::{Span, Spanned};
use serde::Serialize;

/// The roofs of a house: the written ones, and automatic ones for the rest or none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum RoofMode {
    /// Written roofs, and automatic roofs over what they leave uncovered.
    #[default]
    Auto,
    /// Written roofs only.
    Explicit,
}

/// A method of dividing a plan into roofs (docs/contract.md 4).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum RoofMethod {
    /// The partition that cuts the least roof.
    #[default]
    LeastCut,
    /// The published method to the letter: every region has a gable, its long side is the eaves side (001-15 to 001-20).
    Kd,
    /// The published division, with branches and lean-tos as in the others (001-15 to 001-19).
    KdBranches,
    /// Branches are cut off one after the other (002-22, 002-23).
    BranchCut,
    /// No division: one hipped roof over the whole outline, by its straight skeleton.
    Skeleton,
}

impl RoofMethod {
    /// Every method with its name.
    pub const ALL: [(&'static str, RoofMethod); 5] = [
        ("least-cut", RoofMethod::LeastCut),
        ("kd", RoofMethod::Kd),
        ("kd-branches", RoofMethod::KdBranches),
        ("branch-cut", RoofMethod::BranchCut),
        ("skeleton", RoofMethod::Skeleton),
    ];
}

/// The roof section of a house.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Roofs {
    /// The start tag of the section, if it has one.
    pub span: Option<Span>,
    /// Automatic roofs or not.
    pub mode: Option<Spanned<RoofMode>>,
    /// The method of the automatic ones.
    pub method: Option<Spanned<RoofMethod>>,
    /// The style of automatic roofs.
    pub style: RoofStyle,
    /// The word that leaves their shape to what the house is for.
    pub by_use: Option<Span>,
    /// Written roofs.
    pub lines: Vec<RoofLine>,
}

/// The covering of a roof (`docs/evidence.md` 6, column 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub enum RoofKind {
    /// K, sangawara-buki: pantiles.
    Tiles,
    /// G, hon-gawara-buki: concave tiles with round tiles over the joints.
    CoverTiles,
    /// I, ita-buki: boards.
    Boards,
    /// S, kokera: shingles.
    Shingles,
    /// H, hiwada: bark.
    Bark,
    /// Y, kaya: thatch.
    Thatch,
    /// T, totan: metal.
    Metal,
}

/// The form of a roof (`docs/evidence.md` 6).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum RoofShape {
    /// KIR, kirizuma: gable.
    Gable,
    /// YOS, yosemune: hip.
    Hip,
    /// YOK, yokonaga-kirizuma: gable roof with its ridge along the short side.
    BroadGable,
    /// IRI, irimoya: hip and gable.
    HipAndGable,
    /// HAK, hakama-goshi: gable roof with hipped tips.
    HalfHip,
    /// HOG, hogyo: pyramidal roof.
    Pyramid,
    /// KAT, katanagare: shed roof.
    LeanTo,
    /// HIS, hisashi: pent roof outside the walls.
    Pent,
    /// TER, tera: concave hip-and-gable roof, as on temples.
    Temple,
    /// KAR, karahafu: cusped gable.
    Karahafu,
    /// RIK, rikuyane: flat, with a parapet.
    Flat,
    /// KOS, koshiore: gambrel, a gable roof whose two slopes are steep below and gentle above.
    Gambrel,
    /// MAN, mansard: such slopes on all four sides.
    Mansard,
    /// CHI, chidori-hafu: a triangular gable on the slope of another roof.
    Chidori,
    /// NOK, noki-karahafu: an undulating gable in the eaves or on the slope of another roof.
    EavesKarahafu,
    /// KOY, koshi-yane: a monitor with vents on the ridge of another roof.
    Monitor,
    /// UDA, hon-udatsu: a party wall raised over another roof.
    FireWall,
}

impl RoofShape {
    /// Every shape with its letters.
    pub const ALL: [(&'static str, RoofShape); 17] = [
        ("KIR", RoofShape::Gable),
        ("YOS", RoofShape::Hip),
        ("YOK", RoofShape::BroadGable),
        ("IRI", RoofShape::HipAndGable),
        ("HAK", RoofShape::HalfHip),
        ("HOG", RoofShape::Pyramid),
        ("KAT", RoofShape::LeanTo),
        ("HIS", RoofShape::Pent),
        ("TER", RoofShape::Temple),
        ("KAR", RoofShape::Karahafu),
        ("RIK", RoofShape::Flat),
        ("KOS", RoofShape::Gambrel),
        ("MAN", RoofShape::Mansard),
        ("CHI", RoofShape::Chidori),
        ("NOK", RoofShape::EavesKarahafu),
        ("KOY", RoofShape::Monitor),
        ("UDA", RoofShape::FireWall),
    ];

    /// The names of shapes in OpenStreetMap (`roof:shape`), which XML reads as well.
    pub const MAPPED: [(&'static str, RoofShape); 10] = [
        ("gabled", RoofShape::Gable),
        ("hipped", RoofShape::Hip),
        ("half-hipped", RoofShape::HalfHip),
        ("hipped-and-gabled", RoofShape::HipAndGable),
        ("pyramidal", RoofShape::Pyramid),
        ("skillion", RoofShape::LeanTo),
        ("lean_to", RoofShape::LeanTo),
        ("flat", RoofShape::Flat),
        ("gambrel", RoofShape::Gambrel),
        ("mansard", RoofShape::Mansard),
    ];

    /// Returns the shape of three letters.
    pub fn from_letters(letters: &str) -> Option<RoofShape> {
        Self::ALL
            .iter()
            .find(|(l, _)| *l == letters)
            .map(|(_, shape)| *shape)
    }

    /// Returns true for a hip whose four slopes have the same pitch; `ratio` = the length of its ridge is given.
    pub fn has_equal_slopes(self, ratio: bool) -> bool {
        match self {
            RoofShape::Hip | RoofShape::Pyramid => !ratio,
            RoofShape::Mansard => true,
            _ => false,
        }
    }

    /// Returns true for roofs that stand on another one: dormers, monitors and fire walls.
    pub fn stands_on_another(self) -> bool {
        self.is_dormer() || matches!(self, RoofShape::Monitor | RoofShape::FireWall)
    }

    /// Returns true for gables on the slope of another roof, which face one side.
    pub fn is_dormer(self) -> bool {
        matches!(self, RoofShape::Chidori | RoofShape::EavesKarahafu)
    }

    /// Returns its three letters.
    pub fn letters(self) -> &'static str {
        Self::ALL
            .iter()
            .find(|(_, shape)| *shape == self)
            .map_or("KIR", |(letters, _)| letters)
    }
}

impl RoofKind {
    /// Every kind with its letter.
    pub const ALL: [(char, RoofKind); 7] = [
        ('K', RoofKind::Tiles),
        ('G', RoofKind::CoverTiles),
        ('I', RoofKind::Boards),
        ('S', RoofKind::Shingles),
        ('H', RoofKind::Bark),
        ('Y', RoofKind::Thatch),
        ('T', RoofKind::Metal),
    ];

    /// Returns the kind of a letter.
    pub fn from_letter(letter: char) -> Option<RoofKind> {
        Self::ALL
            .iter()
            .find(|(l, _)| *l == letter)
            .map(|(_, kind)| *kind)
    }
}

/// The direction of a ridge, or the fall of a single slope.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum RoofDirection {
    /// X: ridge parallel to the first line.
    AlongFront,
    /// Y: ridge at right angles to it.
    AcrossFront,
    /// F: falls to the front (-b).
    Front,
    /// B: falls to the back (+b).
    Back,
    /// L: falls to the left (+a).
    Left,
    /// R: falls to the right (-a).
    Right,
}

/// The material of an irimoya's gable walls.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum GableWall {
    /// The same as the wall below.
    Wall,
    /// Boards behind a square lattice, kitsune-goshi 狐格子.
    Lattice,
}

impl GableWall {
    /// Every kind with its word in XML.
    pub const ALL: [(&'static str, GableWall); 2] =
        [("wall", GableWall::Wall), ("lattice", GableWall::Lattice)];
}

/// Options of a roof; `None` = by kind, shape and span.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct RoofStyle {
    /// Covering.
    pub kind: Option<Spanned<RoofKind>>,
    /// Form.
    pub shape: Option<Spanned<RoofShape>>,
    /// P: rise in sun per shaku (4.0 = 4/10).
    pub pitch: Option<Spanned<f64>>,
    /// E: horizontal overhang beyond the wall line, shaku.
    pub eaves: Option<Spanned<f64>>,
    /// G: overhang beyond the gable wall, shaku.
    pub verge: Option<Spanned<f64>>,
    /// T: thickness, shaku.
    pub thickness: Option<Spanned<f64>>,
    /// M: courses of ridge tiles.
    pub noshi: Option<Spanned<u32>>,
    /// S: sagitta of the slope in per cent of its length; negative is convex (mukuri).
    pub sori: Option<Spanned<f64>>,
    /// C: position of an irimoya's gable, share of the span.
    pub gable: Option<Spanned<f64>>,
    /// R: length of a hip's ridge, share of the roof's length.
    pub ratio: Option<Spanned<f64>>,
    /// O: plain ridge ends, without onigawara.
    pub plain_ridge: Option<Spanned<bool>>,
    /// The material of an irimoya's gable walls; XML only.
    pub gable_wall: Option<Spanned<GableWall>>,
    /// From the slope over the walls to the upper face, at right angles, shaku (rf_offs, 004-09); XML only.
    pub offset: Option<Spanned<f64>>,
    /// Wood or paint of rafters, soffits and boards; XML only.
    pub paint: Option<Spanned<Paint>>,
}

/// One roof line, or one `Roof` element.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RoofLine {
    /// The whole line.
    pub span: Span,
    /// Options.
    pub style: RoofStyle,
    /// Ridge or fall; `None` = automatic.
    pub direction: Option<Spanned<RoofDirection>>,
    /// Eaves height in shaku above z = 0; `None` = the top of the topmost uncovered storey there.
    pub height: Option<Spanned<f64>>,
    /// a0 b0 a1 b1 in U, any two opposite corners.
    pub corners: Spanned<[f64; 4]>,
}
