//! The document as written, from either syntax: every construct the author used, with its place.
//!
//! Invariants: spans lie in the source; numbers are finite (the readers report others and leave them
//! out); elements nest at most `Limits::nesting` deep. Codes are still text: whether a part exists is the
//! business of `expand`, the only pass that opens the catalogue for them.

use crate::source::{Span, Spanned};
use serde::Serialize;

/// All houses of one file.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Document {
    /// In the order of the file.
    pub houses: Vec<House>,
}

/// One house: settings, then storeys or facades, then roofs.
#[derive(Clone, Debug, Default, Serialize)]
pub struct House {
    /// The whole house.
    pub span: Span,
    /// Its name, if it has one.
    pub name: Option<Spanned<String>>,
    /// The header values.
    pub settings: Settings,
    /// Storey heights of a legacy header in shaku; a missing one is the default.
    pub heights: Vec<Spanned<f64>>,
    /// Storeys from the ground up.
    pub storeys: Vec<Item<Storey>>,
    /// Walls given facade by facade (the `Structure` of 003), if the house is written that way.
    pub structures: Vec<Structure>,
    /// Gloss and pictures of single textures (003-13).
    pub textures: Vec<Texture>,
    /// The roof section.
    pub roofs: Roofs,
}

/// Values that hold for a whole house; `None` means the default of language.md.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Settings {
    /// East of the house's origin, metres.
    pub x: Option<Spanned<f64>>,
    /// North of the house's origin, metres.
    pub y: Option<Spanned<f64>>,
    /// Height of the house's origin, metres.
    pub z: Option<Spanned<f64>>,
    /// Compass direction of the first line's outward normal, degrees; 180 = south.
    pub azimuth: Option<Spanned<f64>>,
    /// One U in shaku: 3.0 Edo-ma, 3.25 Kyo-ma.
    pub unit: Option<Spanned<f64>>,
    /// Key of all draws.
    pub seed: Option<Spanned<u64>>,
    /// Whether the first line stands on a street.
    pub street: Option<Spanned<bool>>,
}

/// Something of a kind, or an operation on the things beside it.
#[derive(Clone, Debug, Serialize)]
pub enum Item<T> {
    /// The thing itself.
    One(T),
    /// The content several times (003-08).
    Repeat(Repeat<T>),
    /// A draw (003-10).
    Random(Random),
    /// A substitution (003-11).
    Replace(Replace),
}

/// `<repeat num="8">`.
#[derive(Clone, Debug, Serialize)]
pub struct Repeat<T> {
    /// The start tag.
    pub span: Span,
    /// How often; 0 leaves the content out.
    pub num: Spanned<u32>,
    /// What.
    pub body: Vec<Item<T>>,
}

/// `<random code="a 2, b">`: an edit where the enclosing element has parts of its own, else a slot.
#[derive(Clone, Debug, Serialize)]
pub struct Random {
    /// The element.
    pub span: Span,
    /// The list as written, not yet divided.
    pub codes: Spanned<String>,
    /// Weights, as many as codes.
    pub weights: Option<Spanned<Vec<f64>>>,
}

/// `<replace code="x y" with="z" at="2,5-7"/>`.
#[derive(Clone, Debug, Serialize)]
pub struct Replace {
    /// The element.
    pub span: Span,
    /// The list as written; `None` = every part at the positions.
    pub codes: Option<Spanned<String>>,
    /// What comes instead.
    pub with: Spanned<String>,
    /// Positions from 1, as inclusive ranges; `None` = everywhere.
    pub at: Option<Spanned<Vec<(u32, u32)>>>,
}

/// What a storey is for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum StoreyKind {
    /// Rooms, and a roof above them.
    #[default]
    Storey,
    /// A wall round the flat roof of the storey below; not counted.
    Parapet,
}

/// One storey of a house.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Storey {
    /// The element, or its lines.
    pub span: Span,
    /// Height in shaku.
    pub height: Option<Spanned<f64>>,
    /// Start point (a, b) in U, author frame.
    pub start: Option<Spanned<(f64, f64)>>,
    /// Storey or parapet.
    pub kind: StoreyKind,
    /// Rows that stand in the storey itself form one loop; further ones are courtyards or wings.
    pub loops: Vec<Loop>,
    /// `random` and `replace` directly in the storey: edits of all its rows.
    pub edits: Vec<Edit>,
}

/// An operation on a whole storey or floor, in document order.
#[derive(Clone, Debug, Serialize)]
pub enum Edit {
    /// Draw again.
    Random(Random),
    /// Substitute.
    Replace(Replace),
}

/// A closed walk.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Loop {
    /// The element, or its lines.
    pub span: Span,
    /// Whether the solid lies outside the loop: a courtyard.
    pub hole: bool,
    /// Start point (a, b) in U, author frame.
    pub start: Option<Spanned<(f64, f64)>>,
    /// Wall lines.
    pub rows: Vec<Item<Row>>,
}

/// One wall line and the turn at its end.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Row {
    /// The line without its line end; the whole element in XML.
    pub span: Span,
    /// Parts from right to left as seen from outside.
    pub pieces: Vec<Item<Piece>>,
    /// The turn at the end, in degrees, right positive; `None` = the default of its loop.
    pub turn: Option<Spanned<f64>>,
}

/// What stands in a wall line.
#[derive(Clone, Debug, Serialize)]
pub enum Piece {
    /// One part.
    Part(Part),
    /// One storey part divided above and below (003-09).
    Split(Box<Split>),
}

/// A code with what was said about this one use of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Part {
    /// The code as written, `span` on it. Shorter than 5 where blanks were lost.
    pub code: Spanned<CodeText>,
    /// Width in U instead of the catalogue's.
    pub width: Option<Spanned<f64>>,
    /// Height in shaku instead of the storey's.
    pub height: Option<Spanned<f64>>,
}

/// `<split ratio="0.5"><upper/><lower/></split>`.
#[derive(Clone, Debug, Serialize)]
pub struct Split {
    /// The start tag.
    pub span: Span,
    /// Share of the upper half in the height, 0 to 1.
    pub ratio: Option<Spanned<f64>>,
    /// Above.
    pub upper: Half,
    /// Below.
    pub lower: Half,
}

/// One half of a split.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Half {
    /// The element.
    pub span: Span,
    /// From right to left as seen from outside.
    pub pieces: Vec<Item<Piece>>,
}

/// The text of a code: up to five bytes in place, since texts hold hundreds of thousands of them.
#[derive(Clone, PartialEq, Eq, Hash)]
pub enum CodeText {
    /// A code of the catalogue's form, padded with blanks.
    Five([u8; 5]),
    /// A name of any other length: an own part or a part picture.
    Name(Box<str>),
}

impl CodeText {
    /// ASCII of at most five bytes is padded to a code; everything else is a name.
    pub fn new(text: &str) -> CodeText {
        if text.len() > 5 || !text.is_ascii() {
            return CodeText::Name(text.into());
        }
        let mut five = [b' '; 5];
        five[..text.len()].copy_from_slice(text.as_bytes());
        CodeText::Five(five)
    }

    /// The text, with its padding.
    pub fn as_str(&self) -> &str {
        match self {
            CodeText::Five(five) => std::str::from_utf8(five).unwrap_or_default(),
            CodeText::Name(name) => name,
        }
    }
}

impl std::fmt::Debug for CodeText {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:?}", self.as_str())
    }
}

impl Serialize for CodeText {
    fn serialize<S: serde::Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        s.serialize_str(self.as_str())
    }
}

/// Walls given facade by facade (003-12, 003-15).
#[derive(Clone, Debug, Serialize)]
pub struct Structure {
    /// The start tag.
    pub span: Span,
    /// Size; a facade is size x ratio x scale metres wide. `None` = not given.
    pub size: Option<Spanned<f64>>,
    /// Metres per size unit.
    pub scale: Option<Spanned<f64>>,
    /// Whether parts run from left to right as seen from outside (default: to the left).
    pub rightwards: bool,
    /// Clockwise seen from above.
    pub facades: Vec<Item<Facade>>,
}

/// One plane wall over all storeys.
#[derive(Clone, Debug, Serialize)]
pub struct Facade {
    /// The start tag.
    pub span: Span,
    /// Its name in part pictures; its number from 1 where it has none.
    pub id: Option<Spanned<String>>,
    /// Share of the structure's size.
    pub ratio: Option<Spanned<f64>>,
    /// Turn from the previous facade's direction, degrees, right positive; `None` = 0 for the first, 90.
    pub angle: Option<Spanned<f64>>,
    /// Whether its glass mirrors the neighbourhood.
    pub reflection: bool,
    /// From the ground up.
    pub floors: Vec<Item<Floor>>,
}

/// One storey row of a facade.
#[derive(Clone, Debug, Serialize)]
pub struct Floor {
    /// The start tag.
    pub span: Span,
    /// Its name; `k` in it stands for the storey's number.
    pub id: Option<Spanned<String>>,
    /// Height in shaku.
    pub height: Option<Spanned<f64>>,
    /// Storey or parapet.
    pub kind: StoreyKind,
    /// Parts and, in document order among them, edits or slots.
    pub pieces: Vec<Item<Piece>>,
}

/// `<Texture texturecode="x" reflection="0.5" src="x.png"/>`.
#[derive(Clone, Debug, Serialize)]
pub struct Texture {
    /// The element.
    pub span: Span,
    /// Of which part or picture.
    pub code: Spanned<String>,
    /// Share of light that it mirrors, 0 to 1.
    pub reflection: Option<Spanned<f64>>,
    /// The picture's file, relative to the source.
    pub src: Option<Spanned<String>>,
}

/// Which roofs stand: the written ones, and automatic ones for the rest or none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum RoofMode {
    /// The lines, and automatic roofs for what they leave open.
    #[default]
    Auto,
    /// The lines only.
    Explicit,
}

/// How a plan is divided into roofs (language.md 4).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum RoofMethod {
    /// Least roof is cut.
    #[default]
    LeastCut,
    /// The published method (001-15 to 001-19).
    Kd,
}

/// The roof section of a house.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Roofs {
    /// Automatic roofs or not.
    pub mode: Option<Spanned<RoofMode>>,
    /// The method of the automatic ones.
    pub method: Option<Spanned<RoofMethod>>,
    /// What the automatic ones look like.
    pub style: RoofStyle,
    /// Roofs with a place of their own.
    pub lines: Vec<RoofLine>,
}

/// What covers a roof (`domain.md` 6, column 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub enum RoofKind {
    /// K, kawara-buki: tiles.
    Tiles,
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

/// The form of a roof (`domain.md` 6).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum RoofShape {
    /// KIR, kirizuma: gable.
    Gable,
    /// YOS, yosemune: hip.
    Hip,
    /// YOK, yokonaga-kirizuma: gable with its ridge along the short side.
    BroadGable,
    /// IRI, irimoya: hip and gable.
    HipAndGable,
    /// HOG, hogyo: pyramid.
    Pyramid,
    /// KAT, katanagare: lean-to.
    LeanTo,
    /// HIS, hisashi: pent roof outside the walls.
    Pent,
    /// TER, tera: temple.
    Temple,
    /// KAR, karahafu: undulating gable.
    Karahafu,
    /// RIK, rikuyane: flat, with a parapet.
    Flat,
}

impl RoofShape {
    /// Every shape with its letters.
    pub const ALL: [(&'static str, RoofShape); 10] = [
        ("KIR", RoofShape::Gable),
        ("YOS", RoofShape::Hip),
        ("YOK", RoofShape::BroadGable),
        ("IRI", RoofShape::HipAndGable),
        ("HOG", RoofShape::Pyramid),
        ("KAT", RoofShape::LeanTo),
        ("HIS", RoofShape::Pent),
        ("TER", RoofShape::Temple),
        ("KAR", RoofShape::Karahafu),
        ("RIK", RoofShape::Flat),
    ];

    /// The shape of three letters.
    pub fn from_letters(letters: &str) -> Option<RoofShape> {
        Self::ALL
            .iter()
            .find(|(l, _)| *l == letters)
            .map(|(_, shape)| *shape)
    }

    /// Its three letters.
    pub fn letters(self) -> &'static str {
        Self::ALL
            .iter()
            .find(|(_, shape)| *shape == self)
            .map_or("KIR", |(letters, _)| letters)
    }
}

impl RoofKind {
    /// Every kind with its letter.
    pub const ALL: [(char, RoofKind); 6] = [
        ('K', RoofKind::Tiles),
        ('I', RoofKind::Boards),
        ('S', RoofKind::Shingles),
        ('H', RoofKind::Bark),
        ('Y', RoofKind::Thatch),
        ('T', RoofKind::Metal),
    ];

    /// The kind of a letter.
    pub fn from_letter(letter: char) -> Option<RoofKind> {
        Self::ALL
            .iter()
            .find(|(l, _)| *l == letter)
            .map(|(_, kind)| *kind)
    }
}

/// The run of a ridge, or the fall of a single slope.
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

/// Options of a roof; `None` = by kind, shape and span.
#[derive(Clone, Debug, Default, Serialize)]
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
    /// C: place of an irimoya's gable, share of the span.
    pub gable: Option<Spanned<f64>>,
    /// O: no onigawara.
    pub plain_ridge: Option<Spanned<bool>>,
}

/// One roof line, or one `Roof` element.
#[derive(Clone, Debug, Serialize)]
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
