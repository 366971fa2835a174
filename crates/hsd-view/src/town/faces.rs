//! The face of an envelope at a place: the rule that binds it, and its arithmetic (002-28...-31).

use super::tables::{TownTables, each};
use glam::DVec3;
use serde::Serialize;
use std::io;

/// The farthest that a place may be off the plane of its face, metres: tiles round their corners.
const OFF: f64 = 0.2;

/// A face of an envelope: `EnvelopeFace` in `view/src/server/api.ts`.
#[derive(Debug, Serialize)]
pub(crate) struct BoundFace {
    /// The name of what binds it.
    rule: String,
    /// How the height there comes about; empty where no rule but the border of the lot binds.
    arithmetic: String,
    scenario: String,
}

impl TownTables {
    /// Returns the face of the envelopes of a lot at a place, metres east, north and up in the town; `None` if none is there.
    ///
    /// # Errors
    /// If the table of envelopes cannot be read.
    pub(crate) fn face(
        &self,
        (layer, key): (&str, &str),
        at: DVec3,
    ) -> io::Result<Option<BoundFace>> {
        let mut best: Option<(f64, BoundFace)> = None;
        each(&self.envelopes, &mut |row| {
            if row.cell("key") != key || row.cell("layer") != layer {
                return true;
            }
            let rules = row.cell("rules").split("; ");
            let rules: Vec<&str> = rules.filter_map(|r| Some(r.rsplit_once(": ")?.0)).collect();
            let arithmetic: Vec<&str> = row.cell("arithmetic").split("; ").collect();
            for plane in row.cell("planes").split("; ") {
                let Some((rule, numbers)) = plane.rsplit_once(": ") else {
                    continue;
                };
                let numbers = numbers.split(' ').map(|n| n.parse().unwrap_or(f64::NAN));
                let [a, b, c, d] = numbers.collect::<Vec<f64>>()[..] else {
                    continue;
                };
                let off = (DVec3::new(a, b, c).dot(at) - d).abs();
                if off < best.as_ref().map_or(OFF, |(least, _)| *least) {
                    let bare = rule.strip_prefix("end of ").unwrap_or(rule);
                    let number = rules.iter().position(|own| *own == bare);
                    let arithmetic = number.and_then(|n| arithmetic.get(n));
                    let face = BoundFace {
                        rule: rule.to_owned(),
                        arithmetic: arithmetic.map_or(String::new(), |a| (*a).to_owned()),
                        scenario: row.cell("scenario").to_owned(),
                    };
                    best = Some((off, face));
                }
            }
            true
        })?;
        Ok(best.map(|(_, face)| face))
    }
}
