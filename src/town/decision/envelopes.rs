//! The table of envelopes: a line for each lot and scenario, with the faces of its solid.

use super::{SkippedFeature, quoted, short};
use crate::ast::Value;
use serde::{Deserialize, Serialize};

/// Heights are measured to no less than this, metres.
const ABOVE: f64 = 0.01;

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

/// The first line of the table of envelopes.
pub const ENVELOPES_HEAD: &str = "key,layer,scenario,volume,floor_area,height,rules,lot_area,roads,road_width,ratio,floors,built,above,arithmetic\n";

impl EnvelopeRow {
    /// Returns its floor area, square metres.
    pub fn floor_area(&self) -> f64 {
        self.floors.iter().sum()
    }

    /// Returns the house that stands there, if it is above it.
    pub fn above(&self) -> Option<SkippedFeature> {
        let above = format!("{:.2} m above its envelope", self.above);
        (self.above > ABOVE).then(|| SkippedFeature {
            layer: self.layer.clone(),
            key: self.key.clone(),
            code: "above".to_owned(),
            reason: match &*self.scenario {
                "" => above,
                scenario => format!("{above} ({scenario})"),
            },
        })
    }

    /// Returns its line of the table.
    pub fn line(&self) -> String {
        let number = |n: f64| format!("{:.3}", n + 0.0);
        let known = |n: Option<f64>| n.map(number).unwrap_or_default();
        let rules = self.rules.iter();
        let rules = rules.map(|(rule, area)| format!("{rule}: {}", short(&Value::Number(*area))));
        let floors = self
            .floors
            .iter()
            .map(|floor| short(&Value::Number(*floor)));
        let cells = [
            self.key.clone(),
            self.layer.clone(),
            self.scenario.clone(),
            number(self.volume),
            number(self.floor_area()),
            number(self.height),
            rules.collect::<Vec<String>>().join("; "),
            number(self.lot_area),
            self.roads.to_string(),
            known(self.road_width),
            known(self.ratio),
            floors.collect::<Vec<String>>().join(" "),
            known(self.built),
            number(self.above),
            self.arithmetic.join("; "),
        ];
        let cells: Vec<String> = cells.iter().map(|cell| quoted(cell)).collect();
        cells.join(",") + "\n"
    }
}
