//! Fittings of a house: platform, posts, veranda, bracket complexes, and the finial of the roof. Lengths in shaku.
//! Omitted values are those of [`Default`], or `None` if they follow from the house; `docs/evidence.md` 4.8 and 7.10
//! describe monuments.

use crate::ast::CodeText;
use hsd_base::source::{Span, Spanned};
use serde::Serialize;

/// A side of a house in the author frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Side {
    /// F: -b.
    Front,
    /// B: +b.
    Back,
    /// L: +a.
    Left,
    /// R: -a.
    Right,
}

impl Side {
    /// Every side with its letter.
    pub const ALL: [(char, Side); 4] = [
        ('F', Side::Front),
        ('B', Side::Back),
        ('L', Side::Left),
        ('R', Side::Right),
    ];

    /// Returns the direction out of the house, author frame.
    pub fn outward(self) -> glam::DVec2 {
        match self {
            Side::Front => glam::DVec2::NEG_Y,
            Side::Back => glam::DVec2::Y,
            Side::Left => glam::DVec2::X,
            Side::Right => glam::DVec2::NEG_X,
        }
    }
}

/// The finish of a frame's timber.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize)]
pub enum Paint {
    /// Bare cedar or pine.
    #[default]
    Cedar,
    /// Bare cypress.
    Hinoki,
    /// Bare zelkova.
    Keyaki,
    /// Red lead (丹塗 ni-nuri) with yellow ends, as on gates, pagodas and shrines.
    Vermilion,
    /// Iron red with soot.
    Bengara,
    /// Black.
    Sooted,
}

impl Paint {
    /// Every paint with its word.
    pub const ALL: [(&'static str, Paint); 6] = [
        ("cedar", Paint::Cedar),
        ("hinoki", Paint::Hinoki),
        ("keyaki", Paint::Keyaki),
        ("vermilion", Paint::Vermilion),
        ("bengara", Paint::Bengara),
        ("sooted", Paint::Sooted),
    ];

    /// Returns the name of its surface.
    pub fn surface(self) -> &'static str {
        Self::ALL
            .iter()
            .find(|(_, paint)| *paint == self)
            .map_or("cedar", |(word, _)| word)
    }
}

/// `<Platform>`: a stone platform (基壇 kidan) that the house stands on.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Platform {
    /// The element.
    pub span: Span,
    /// Height of its top above the ground.
    pub height: f64,
    /// Distances from the walls to its edge: left and right, front and back.
    pub margin: [f64; 2],
    /// Sides with stairs.
    pub stairs: Vec<Side>,
    /// Width of the stairs; `None` = the middle bay, or a third of the side.
    pub width: Option<f64>,
}

/// `<Posts>`: the posts and beams that carry the walls of a storey.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Posts {
    /// The element.
    pub span: Span,
    /// Side or diameter.
    pub size: f64,
    /// True if they are round.
    pub round: bool,
    /// Paint of posts and beams.
    pub paint: Paint,
    /// Rows of tie beams (長押 nageshi) before the posts: at the foot, over the doors, under the sills.
    pub nageshi: u32,
}

/// The form of a railing (高欄 koran) at corners.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum Rail {
    /// No railing.
    #[default]
    None,
    /// Rails that cross and project beyond each other (組高欄 kumi-koran).
    Crossed,
    /// Corner posts with giboshi finials (擬宝珠高欄 giboshi-koran).
    Knobbed,
}

/// `<Veranda>`: boards round a storey (縁 en).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Veranda {
    /// The element.
    pub span: Span,
    /// Distance from the walls to its edge.
    pub width: f64,
    /// Height of its boards: on the ground storey, which it raises, above the ground; upstairs above the storey's foot, as high
    /// as the floor inside.
    pub height: f64,
    /// Its railing.
    pub rail: Rail,
    /// Sides with wooden stairs, on the ground storey.
    pub stairs: Vec<Side>,
    /// Paint of its timber; `None` = as the posts.
    pub paint: Option<Paint>,
}

/// `<Brackets>`: bracket complexes (組物 kumimono) on the posts, under the eaves.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Brackets {
    /// The element.
    pub span: Span,
    /// The number of steps: 0 in the plane of the wall, 3 = mitesaki.
    pub steps: u32,
    /// Height from the top of the posts to the top of the storey; `None` = by the steps.
    pub height: Option<f64>,
    /// Distance from the wall to the purlin they carry; `None` = by the steps.
    pub out: Option<f64>,
    /// Paint of their timber; `None` = as the posts.
    pub paint: Option<Paint>,
}

/// The kinds of finials.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum FinialKind {
    /// 相輪: base, bowl, nine rings, water-flame and jewels on the shaft on top of a pagoda.
    Sorin,
    /// 宝珠: a jewel on a dew basin (露盤 roban), on pyramids.
    Hoju,
    /// 鴟尾: upturned ornaments at the ends of the ridge.
    Shibi,
    /// 千木・鰹木: forked finials and billets on the ridge of a shrine.
    Chigi,
}

impl FinialKind {
    /// Every kind with its word.
    pub const ALL: [(&'static str, FinialKind); 4] = [
        ("sorin", FinialKind::Sorin),
        ("hoju", FinialKind::Hoju),
        ("shibi", FinialKind::Shibi),
        ("chigi", FinialKind::Chigi),
    ];
}

/// `<Finial>`: the ornament on the highest roof, or on the one over a place.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finial {
    /// The element.
    pub span: Span,
    /// Its kind.
    pub kind: FinialKind,
    /// Height above the roof; `None` = by the kind and the size of the roof.
    pub height: Option<f64>,
    /// Number of billets between the forked finials; `None` = by the length of the ridge.
    pub count: Option<u32>,
    /// A place of the plan, in U, whose roof carries it; `None` = the highest roof.
    pub at: Option<Spanned<(f64, f64)>>,
}

/// `<Put code="OTO" at="3 -4"/>`: a part that stands by itself on the ground beside the house, such as a lantern, a tree or a
/// bench.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Put {
    /// The element.
    pub span: Span,
    /// The part.
    pub code: Spanned<CodeText>,
    /// Its middle (a, b) in U, author frame.
    pub at: Spanned<(f64, f64)>,
    /// By how much it is turned clockwise from facing the front of the house, degrees.
    pub turn: f64,
    /// Its width in U; `None` = that of its code.
    pub width: Option<f64>,
    /// Its height in shaku; `None` = that of its part.
    pub height: Option<f64>,
}

/// `<Ground surface="gravel" at="3 -4" size="6 4"/>`: a rectangle of gravel, moss or paving beside the house.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ground {
    /// The element.
    pub span: Span,
    /// Its surface.
    pub surface: GroundSurface,
    /// Its middle (a, b) in U, author frame.
    pub at: (f64, f64),
    /// Along the front of the house, then back, U.
    pub size: [f64; 2],
    /// By how much it is turned clockwise, degrees.
    pub turn: f64,
}

/// The surface of covered ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum GroundSurface {
    /// Gravel (砂利).
    Gravel,
    /// White sand (白砂).
    Sand,
    /// Moss (苔).
    Moss,
    /// Grass (芝).
    Grass,
    /// Slabs of stone in courses (敷石).
    Paving,
    /// Pounded earth (土).
    Earth,
}

impl GroundSurface {
    /// Every surface with its word.
    pub const ALL: [(&'static str, GroundSurface); 6] = [
        ("gravel", GroundSurface::Gravel),
        ("sand", GroundSurface::Sand),
        ("moss", GroundSurface::Moss),
        ("grass", GroundSurface::Grass),
        ("paving", GroundSurface::Paving),
        ("earth", GroundSurface::Earth),
    ];
}

/// The fittings of a whole house.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Fittings {
    /// The platform under it.
    pub platform: Option<Platform>,
    /// Posts of storeys that have none of their own.
    pub posts: Option<Posts>,
    /// Brackets of storeys that have none of their own.
    pub brackets: Option<Brackets>,
    /// Finials of its roofs.
    pub finials: Vec<Finial>,
    /// Parts on the ground beside it.
    pub puts: Vec<Put>,
    /// Gravel, moss and paving beside it, in order: later ones lie on earlier ones.
    pub grounds: Vec<Ground>,
    /// Set if this is no house but an outdoor object of a town, such as a road or a row of trees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub outdoors: Option<Box<super::Outdoors>>,
}

/// The posts, veranda and brackets of one storey.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Order {
    /// The posts of its walls.
    pub posts: Option<Posts>,
    /// The veranda round it.
    pub veranda: Option<Veranda>,
    /// The brackets under its eaves.
    pub brackets: Option<Brackets>,
}

impl Brackets {
    /// Returns the height from the top of the posts to the storey's top, shaku: a block, an arm, and a little more for
    /// each step.
    pub fn zone(&self) -> f64 {
        self.height.unwrap_or(1.8 + 1.1 * f64::from(self.steps))
    }

    /// Returns the distance from the wall to the purlin, shaku.
    pub fn reach(&self) -> f64 {
        self.out.unwrap_or(1.2 * f64::from(self.steps))
    }
}
