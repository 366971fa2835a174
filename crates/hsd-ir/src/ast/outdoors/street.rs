//! Poles, wires, signals, signs and arcades that the rules of a town ask for (docs/contract.md 10.4); lengths in metres.

use crate::ast::CodeText;
use hsd_base::source::Span;
use serde::Serialize;

/// Poles at a point, along a line, or of a network along streets.
#[derive(Clone, Debug, PartialEq)]
pub struct Poles {
    /// The height of a pole.
    pub height: f64,
    /// How far poles stand apart, as nearly as a whole number of spans allows.
    pub spacing: f64,
    /// The wires from pole to pole.
    pub wires: Wires,
    /// The material of a pole.
    pub made: PoleMade,
    /// How far a house may be from a pole of a network; none for poles along a line.
    pub reach: Option<f64>,
}

/// Wires between poles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wires {
    /// Their number; 0 for none.
    pub count: u32,
    /// How far they hang down in the middle of a span of the usual length, as a share of it.
    pub sag: f64,
}

/// Wires along a line, from corner to corner.
#[derive(Clone, Debug, PartialEq)]
pub struct WireLine {
    /// Their height at the corners.
    pub height: f64,
    /// The wires.
    pub wires: Wires,
}

/// The material of a pole.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum PoleMade {
    /// Concrete.
    #[default]
    Concrete,
    /// Wood.
    Wood,
}

impl PoleMade {
    /// The words for it.
    pub const WORDS: [(&'static str, PoleMade); 2] =
        [("concrete", PoleMade::Concrete), ("wood", PoleMade::Wood)];
}

/// A part that stands on a line by itself, as wide as that is long: a torii or a lantern.
#[derive(Clone, Debug, PartialEq)]
pub struct Lone {
    /// The element: `torii` or `lantern`.
    pub word: &'static str,
    /// The part.
    pub code: CodeText,
    /// The place of the code.
    pub span: Span,
    /// Its height, shaku; without, in proportion to its width.
    pub height: Option<f64>,
}

/// A signal at a crossing.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal {
    /// The direction that it faces, degrees clockwise from north; without, one for each road that comes in.
    pub facing: Option<f64>,
    /// The height of its lamps.
    pub height: f64,
}

/// A board with the name of a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Sign {
    /// What is written on it.
    pub text: String,
    /// The direction that it faces, degrees clockwise from north; without, along the nearest street.
    pub facing: Option<f64>,
    /// The size of its letters.
    pub size: f64,
    /// The height of its lower edge.
    pub height: f64,
    /// What it is.
    pub board: Board,
}

/// The board of a sign.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum Board {
    /// White letters on blue.
    #[default]
    Blue,
    /// Black letters on white.
    White,
    /// Black letters on wood.
    Wood,
}

impl Board {
    /// The words for it.
    pub const WORDS: [(&'static str, Board); 3] = [
        ("blue", Board::Blue),
        ("white", Board::White),
        ("wood", Board::Wood),
    ];
}

/// A roof over a pavement along a line, whose left side is the street.
#[derive(Clone, Debug, PartialEq)]
pub struct Arcade {
    /// How far the roof reaches from the line to the right.
    pub depth: f64,
    /// The height of its eaves at the street.
    pub height: f64,
    /// How far posts stand apart, as nearly as a whole number of bays allows.
    pub bay: f64,
}
