//! Fittings of a house: platform, posts, veranda, bracket complexes, and the finial of the roof. Lengths in shaku. Values that no one wrote are those of [`Default`], or `None` where they follow from
//! the house; `docs/evidence.md` 4.8 and 7.10 say what monuments have.

use crate::source::{Span, Spanned};
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

    /// Out of the house, author frame.
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
    /// Red lead (丹塗 ni-nuri) with yellow ends, as at gates, pagodas and shrines.
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

    /// The surface it wears.
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
    /// Of its top above the ground.
    pub height: f64,
    /// From the walls to its edge: left and right, front and back.
    pub margin: [f64; 2],
    /// Where stairs lead up.
    pub stairs: Vec<Side>,
    /// Width of the stairs; `None` = the middle bay, or a third of the side.
    pub width: Option<f64>,
}

/// `<Posts>`: what carries the walls of a storey.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Posts {
    /// The element.
    pub span: Span,
    /// Side or diameter.
    pub size: f64,
    /// True if they are round.
    pub round: bool,
    /// Of posts and beams.
    pub paint: Paint,
    /// Rows of tie beams (長押 nageshi) before the posts: at the foot, over the doors, under the sills.
    pub nageshi: u32,
}

/// How a railing (高欄 koran) ends at corners.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum Rail {
    /// There is none.
    #[default]
    None,
    /// Rails cross and run out beyond each other (組高欄 kumi-koran).
    Crossed,
    /// Posts with bulbs stand there (擬宝珠高欄 giboshi-koran).
    Knobbed,
}

/// `<Veranda>`: boards around a storey (縁 en).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Veranda {
    /// The element.
    pub span: Span,
    /// From the walls to its edge.
    pub width: f64,
    /// Of its boards above the ground on the ground storey, which it raises; above the storey's foot upstairs.
    pub height: f64,
    /// Its railing.
    pub rail: Rail,
    /// Where wooden stairs lead up to that of a ground storey.
    pub stairs: Vec<Side>,
    /// Of its timber; `None` = as the posts.
    pub paint: Option<Paint>,
}

/// `<Brackets>`: bracket complexes (組物 kumimono) on the posts, under the eaves.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Brackets {
    /// The element.
    pub span: Span,
    /// How often they step out: 0 in the plane of the wall, 3 = mitesaki.
    pub steps: u32,
    /// From the top of the posts to the top of the storey; `None` = by the steps.
    pub height: Option<f64>,
    /// From the wall to the purlin they carry; `None` = by the steps.
    pub out: Option<f64>,
    /// Of their timber; `None` = as the posts.
    pub paint: Option<Paint>,
}

/// A finial.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum FinialKind {
    /// 相輪: base, bowl, nine rings, water-flame and jewels on the mast of a pagoda.
    Sorin,
    /// 宝珠: a jewel on a dew basin (露盤 roban), on pyramids.
    Hoju,
    /// 鴟尾: fish tails at the ends of the ridge.
    Shibi,
    /// 千木・鰹木: crossed boards and logs on the ridge of a shrine.
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

/// `<Finial>`: what crowns the highest roof, or the one over a place.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finial {
    /// The element.
    pub span: Span,
    /// Which.
    pub kind: FinialKind,
    /// Above the roof; `None` = by the kind and the size of the roof.
    pub height: Option<f64>,
    /// Logs between the crossed boards; `None` = by the length of the ridge.
    pub count: Option<u32>,
    /// Over which place of the plan, in U; `None` = the highest roof.
    pub at: Option<Spanned<(f64, f64)>>,
}

/// All of a house that holds for the whole of it.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Fittings {
    /// The platform under it.
    pub platform: Option<Platform>,
    /// Of storeys that have none of their own.
    pub posts: Option<Posts>,
    /// Of storeys that have none of their own.
    pub brackets: Option<Brackets>,
    /// On its roofs.
    pub finials: Vec<Finial>,
}

/// The settings of one storey.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Order {
    /// The support of its walls.
    pub posts: Option<Posts>,
    /// Round it.
    pub veranda: Option<Veranda>,
    /// Under its eaves.
    pub brackets: Option<Brackets>,
}

impl Brackets {
    /// From the top of the posts to the storey's top, shaku: a block, an arm, and a little more each step.
    pub fn zone(&self) -> f64 {
        self.height.unwrap_or(1.8 + 1.1 * f64::from(self.steps))
    }

    /// From the wall to the purlin, shaku.
    pub fn reach(&self) -> f64 {
        self.out.unwrap_or(1.2 * f64::from(self.steps))
    }
}
