//! What a town keeps of the envelope of a lot.

use serde::{Deserialize, Serialize};

/// A face of an envelope: what binds it, and its corners, metres in the town, counter-clockwise seen from outside.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct EnvelopeFace {
    /// What binds it.
    pub rule: String,
    /// Its corners.
    pub ring: Vec<[f64; 3]>,
}

/// The envelope of a lot in a scenario.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct EnvelopeRow {
    /// The key of the lot.
    pub key: String,
    /// Its layer.
    pub layer: String,
    /// The key of the block that it lies in; empty if that is not known.
    pub block: String,
    /// The name of the set of rules; empty for none.
    pub scenario: String,
    /// Its volume, cubic metres.
    pub volume: f64,
    /// The areas of its storeys, from below, square metres.
    pub floors: Vec<f64>,
    /// Its height, metres.
    pub height: f64,
    /// The rules that bind, each with the area of ground under it, square metres.
    pub rules: Vec<(String, f64)>,
    /// The arithmetic of these rules.
    pub arithmetic: Vec<String>,
    /// The area of the lot, square metres.
    pub lot_area: f64,
    /// The number of roads in front.
    pub roads: usize,
    /// The width of the widest of these, metres.
    pub road_width: Option<f64>,
    /// The greatest ratio of floor area.
    pub ratio: Option<f64>,
    /// The height of the house that stands there, metres.
    pub built: Option<f64>,
    /// How far that is above it, metres; 0 if it is not.
    pub above: f64,
    /// Its faces.
    pub faces: Vec<EnvelopeFace>,
}
