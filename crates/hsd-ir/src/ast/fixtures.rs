//! Fixtures: what is built into the rooms of a storey and does not move, from the tokonoma to the stove.

use crate::ast::Side;
use hsd_base::source::{Span, Spanned};
use serde::Serialize;

/// `<Fixture kind="tokonoma" at="3 11" faces="F"/>`: something that stands in a room with its back to a wall.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fixture {
    /// The element.
    pub span: Span,
    /// What it is.
    pub kind: FixtureKind,
    /// The least corner of its rectangle (a, b) in U, author frame.
    pub at: Spanned<(f64, f64)>,
    /// The size of its rectangle, along a and along b, in U; `None` = by its kind.
    pub size: Option<Spanned<(f64, f64)>>,
    /// The side that its front is on; of stairs the side of the first step.
    pub faces: Side,
}

/// The kinds of fixtures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
pub enum FixtureKind {
    /// The alcove of a zashiki with its scroll (床の間).
    Tokonoma,
    /// Staggered shelves beside it (違い棚).
    Chigaidana,
    /// The household altar in its recess (仏壇).
    Butsudan,
    /// A closet behind two fusuma (押入).
    OshiIre,
    /// Steep open stairs (階段).
    Stairs,
    /// Stairs whose steps are chests (箱階段).
    HakoKaidan,
    /// The row of clay stoves (竈).
    Kamado,
    /// A well in the house (井戸).
    Well,
    /// The sink with its water jar (流し).
    Sink,
}

impl FixtureKind {
    /// Every kind with its word.
    pub const ALL: [(&'static str, FixtureKind); 9] = [
        ("tokonoma", FixtureKind::Tokonoma),
        ("chigaidana", FixtureKind::Chigaidana),
        ("butsudan", FixtureKind::Butsudan),
        ("oshi-ire", FixtureKind::OshiIre),
        ("stairs", FixtureKind::Stairs),
        ("hako-kaidan", FixtureKind::HakoKaidan),
        ("kamado", FixtureKind::Kamado),
        ("well", FixtureKind::Well),
        ("sink", FixtureKind::Sink),
    ];

    /// Returns its word.
    pub fn word(self) -> &'static str {
        let mut all = Self::ALL.iter();
        all.find(|(_, kind)| *kind == self).map_or("", |(w, _)| w)
    }

    /// Returns its usual width along its front and its depth, U.
    pub fn usual_size(self) -> (f64, f64) {
        match self {
            FixtureKind::Tokonoma | FixtureKind::Chigaidana | FixtureKind::OshiIre => (2.0, 1.0),
            FixtureKind::Stairs | FixtureKind::HakoKaidan => (1.0, 3.0),
            FixtureKind::Kamado | FixtureKind::Sink => (2.0, 0.75),
            FixtureKind::Butsudan | FixtureKind::Well => (1.0, 1.0),
        }
    }

    /// Returns true if one climbs it.
    pub fn climbs(self) -> bool {
        matches!(self, FixtureKind::Stairs | FixtureKind::HakoKaidan)
    }
}
