//! Rooms as built: the area between the walls, and the mats in it.

use crate::ast::{Flooring, RoomCeiling};
use glam::DVec2;
use hsd_base::source::Span;
use serde::Serialize;

/// A room of a storey.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Room {
    /// The element.
    pub span: Span,
    /// Its name, empty if it has none.
    pub name: String,
    /// The storey, counted from 1.
    pub storey: u32,
    /// Its place in `House::storeys`.
    pub level: usize,
    /// A point in it, U.
    pub at: DVec2,
    /// Its floor.
    pub floor: Flooring,
    /// Its ceiling.
    pub ceiling: RoomCeiling,
    /// From the floor to the ceiling, metres; `None` = up to the next storey.
    pub height: Option<f64>,
    /// Corners of its outline, then of each opening in it (courtyards, rooms that stand free in it), U. Counter-clockwise in
    /// (a, b), openings clockwise.
    pub area: Vec<Vec<DVec2>>,
    /// The pieces of its floor, each as an area, where stairs come up through it; `None` = all of its area.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub floors: Option<Vec<Vec<Vec<DVec2>>>>,
    /// The pieces of its ceiling where stairs lead up through it; `None` = all of its area.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ceilings: Option<Vec<Vec<Vec<DVec2>>>>,
    /// Its mats.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub mats: Vec<Mat>,
}

/// A mat, or half a mat, as a rectangle in U between the centre lines of walls.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Mat {
    /// The least corner.
    pub low: DVec2,
    /// The greatest corner.
    pub high: DVec2,
    /// True where a wall, not a mat or boards, is on this side: -a, +a, -b, +b.
    pub walls: [bool; 4],
}

impl Mat {
    /// Returns true for half a mat.
    pub fn is_half(&self) -> bool {
        let size = self.high - self.low;
        (size.x - size.y).abs() < 0.5
    }

    /// Returns what it counts for; half a mat counts as half.
    pub fn count(&self) -> f64 {
        if self.is_half() { 0.5 } else { 1.0 }
    }

    /// Returns true if its long sides run along a.
    pub fn runs_along_a(&self) -> bool {
        let size = self.high - self.low;
        size.x >= size.y
    }
}

impl Room {
    /// Returns its area, square units.
    pub fn area(&self) -> f64 {
        let each = self.area.iter().map(|ring| hsd_base::geometry::area2(ring));
        each.sum::<f64>() / 2.0
    }

    /// Returns the number of its mats; half a mat counts as half.
    pub fn mat_count(&self) -> f64 {
        self.mats.iter().map(Mat::count).sum()
    }
}
