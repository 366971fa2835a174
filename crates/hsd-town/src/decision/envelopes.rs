//! The table of envelopes: a line for each lot and scenario.

use super::{SkippedFeature, quoted, short};
use crate::site::law::EnvelopeRow;
use glam::DVec3;
use hsd_ir::ast::Value;
use std::collections::BTreeSet;

/// Heights are measured to no less than this, metres.
const ABOVE: f64 = 0.01;

/// The first line of the table of envelopes.
pub const ENVELOPES_HEAD: &str = "key,layer,scenario,volume,floor_area,height,rules,lot_area,roads,road_width,ratio,floors,built,above,arithmetic,planes,block\n";

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

    /// Returns the planes of its faces over the ground, each with what binds it: `a b c d`, where a point of the plane has
    /// `a east + b north + c up = d`, metres in the town.
    fn planes(&self) -> String {
        let mut known = BTreeSet::new();
        let planes = self.faces.iter().filter(|face| face.rule != "ground");
        let planes = planes.filter_map(|face| {
            let ring: Vec<DVec3> = face.ring.iter().copied().map(DVec3::from).collect();
            let first = *ring.first()?;
            let fan = ring[1..].windows(2);
            let normal: DVec3 = fan.map(|two| (two[0] - first).cross(two[1] - first)).sum();
            let normal = normal.try_normalize()?;
            // Rounded by itself, since -0.0000001 is written as -0.000000.
            let [a, b, c] = ((normal * 1e6).round() / 1e6 + 0.0).to_array();
            let d = (normal.dot(first) * 1e3).round() / 1e3 + 0.0;
            let plane = format!("{}: {a} {b} {c} {d}", face.rule);
            known.insert(plane.clone()).then_some(plane)
        });
        planes.collect::<Vec<String>>().join("; ")
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
            self.planes(),
            self.block.clone(),
        ];
        let cells: Vec<String> = cells.iter().map(|cell| quoted(cell)).collect();
        cells.join(",") + "\n"
    }
}
