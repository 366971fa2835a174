//! The walls in doubt of a plan.

use super::{PlanPlace, place, point};
use crate::stroke::WallAt;
use crate::stroke::sheet::Sheet;
use crate::stroke::sheet::doubts::doubts;
use hsd_export::number::Number;
use serde::Serialize;

/// A wall of which a reader of plans was not certain.
#[derive(Debug, Serialize)]
pub struct PlanDoubt {
    /// The code that was written.
    pub code: String,
    /// The place where its part began then.
    pub at: [Number; 2],
    /// The part now; none if the wall is gone.
    pub unit: Option<DoubtfulUnit>,
    /// Its entry in the comment.
    #[serde(flatten)]
    pub place: PlanPlace,
}

/// A part in the plan, by the numbers of its wall.
#[derive(Debug, Serialize)]
pub struct DoubtfulUnit {
    /// The house.
    pub house: usize,
    /// The storey in its list.
    pub storey: usize,
    /// The walk.
    pub ring: usize,
    /// The wall.
    pub wall: usize,
    /// The unit.
    pub unit: usize,
}

/// Returns the walls in doubt, in the order of the file.
pub(super) fn all(sheet: &Sheet<'_>) -> Vec<PlanDoubt> {
    let found = doubts(sheet).into_iter();
    let told = found.map(|doubt| PlanDoubt {
        at: point(doubt.at),
        unit: doubt.unit.map(|(at, unit)| located(at, unit)),
        place: place(sheet.a.source.span(doubt.entry.clone())),
        code: doubt.code,
    });
    told.collect()
}

fn located(at: WallAt, unit: usize) -> DoubtfulUnit {
    let WallAt {
        house,
        storey,
        ring,
        wall,
    } = at;
    DoubtfulUnit {
        house,
        storey,
        ring,
        wall,
        unit,
    }
}
