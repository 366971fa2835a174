//! Fixtures as built: where they stand, and what they stand against.

use crate::ast::{FixtureKind, Side};
use glam::{DVec2, dvec2};
use hsd_base::source::Span;
use serde::Serialize;

/// Something that is built into a room.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fixture {
    /// The element.
    pub span: Span,
    /// What it is.
    pub kind: FixtureKind,
    /// The storey, counted from 1.
    pub storey: u32,
    /// Its place in `House::storeys`.
    pub level: usize,
    /// The least corner of its rectangle, U.
    pub low: DVec2,
    /// The greatest corner of its rectangle, U.
    pub high: DVec2,
    /// The side that its front is on.
    pub faces: Side,
    /// True where a wall is on this side: -a, +a, -b, +b.
    pub walls: [bool; 4],
    /// From the floor to the ceiling of its room, metres; `None` = up to the next storey.
    pub height: Option<f64>,
    /// Of stairs, true where no wall of the storey above is on this side of the opening in its floor.
    pub open_above: [bool; 4],
}

/// Outward directions of the sides of a rectangle in their order: -a, +a, -b, +b.
pub const OUTWARD: [DVec2; 4] = [DVec2::NEG_X, DVec2::X, DVec2::NEG_Y, DVec2::Y];

impl Fixture {
    /// Returns the corners of its rectangle, counter-clockwise, U.
    pub fn corners(&self) -> [DVec2; 4] {
        let (low, high) = (self.low, self.high);
        [low, dvec2(high.x, low.y), high, dvec2(low.x, high.y)]
    }

    /// Returns its middle, U.
    pub fn middle(&self) -> DVec2 {
        (self.low + self.high) / 2.0
    }

    /// Returns the middle of its edge in a direction along an axis, U.
    pub fn edge(&self, way: DVec2) -> DVec2 {
        self.middle() + way * (self.high - self.low) / 2.0
    }

    /// Returns its width along its front and its depth, U.
    pub fn front_and_depth(&self) -> (f64, f64) {
        let size = self.high - self.low;
        match self.faces {
            Side::Front | Side::Back => (size.x, size.y),
            Side::Left | Side::Right => (size.y, size.x),
        }
    }

    /// Returns true if the insides of two rectangles meet.
    pub fn overlaps(&self, other: &Fixture) -> bool {
        const TOUCH: f64 = 0.01;
        let low = self.low.max(other.low);
        let high = self.high.min(other.high);
        (high - low).min_element() > TOUCH
    }
}
