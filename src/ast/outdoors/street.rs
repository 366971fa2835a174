//! What stands in the streets of a town, as its rules want it (docs/contract.md 10.4); lengths in metres.

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
    /// What a pole is made of.
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

/// What a pole is made of.
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

/// A signal at a crossing.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal {
    /// The direction that it faces, degrees clockwise from north; without, one for each road that comes in.
    pub facing: Option<f64>,
    /// The height of its lamps.
    pub height: f64,
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
