//! The table of envelopes: a line for each lot and scenario.

use super::{SkippedFeature, quoted, short};
use crate::ast::Value;
use crate::town::site::law::EnvelopeRow;

/// Heights are measured to no less than this, metres.
const ABOVE: f64 = 0.01;

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
