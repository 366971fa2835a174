//! The size of a plan, and its evidence.

use super::{Divided, Reading, digits, gaps, openings};
use crate::plan::sheet::Ink;

/// The width of the opening of a door, metres.
const DOOR: f64 = 0.85;
/// The fewest doors that say how large a plan is.
const FEWEST: usize = 2;

/// The evidence for the size of a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Evidence {
    /// The author.
    Given,
    /// Printed dimensions, by their number.
    Printed(usize),
    /// Swinging doors, by their number, taken for usual ones.
    Doors(usize),
    /// The commonest opening, taken for a door.
    Openings,
}

/// The size of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// Metres of a pixel.
    pub metres: f64,
    /// The evidence.
    pub evidence: Evidence,
}

impl Scale {
    /// Returns true if printed dimensions say it.
    pub fn is_printed(&self) -> bool {
        matches!(self.evidence, Evidence::Printed(_))
    }
}

/// Returns the size of the pixels of a plan: as it was given, or by what is drawn; `None` if nothing says it.
pub fn of(reading: &Reading, ink: &Ink, given: Option<f64>) -> Option<Scale> {
    let given = given.map(|metres| Scale {
        metres,
        evidence: Evidence::Given,
    });
    let printed = || {
        let numbers = digits::numbers(ink, reading.divided.diagonal);
        let (metres, count) = digits::metres(&numbers, &reading.graph)?;
        Some(Scale {
            metres,
            evidence: Evidence::Printed(count),
        })
    };
    given
        .or_else(printed)
        .or_else(|| by_doors(&reading.divided))
        .or_else(|| by_openings(&reading.divided))
}

/// Returns the scale by the commonest opening, taken for a door.
fn by_openings(divided: &Divided) -> Option<Scale> {
    let usual = gaps::usual_opening(&divided.strokes, &divided.strokes.walls(), divided.diagonal)?;
    Some(Scale {
        metres: DOOR / usual,
        evidence: Evidence::Openings,
    })
}

/// Returns the scale by swinging doors.
fn by_doors(divided: &Divided) -> Option<Scale> {
    let mut widths = openings::swinging(divided);
    widths.sort_by(f64::total_cmp);
    let middle = *widths.get(widths.len() / 2)?;
    (widths.len() >= FEWEST).then_some(Scale {
        metres: DOOR / middle,
        evidence: Evidence::Doors(widths.len()),
    })
}
