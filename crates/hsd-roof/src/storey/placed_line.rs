//! A roof line with its place: the level it roofs, its rectangle, the height of its plate, and its directions.

use crate::region::{Ridge, Side};
use hsd_base::geometry::plan::Cell;
use hsd_ir::ast::{RoofDirection, RoofLine, RoofShape};

/// A roof line with its place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedLine<'h> {
    /// The line.
    pub(crate) line: &'h RoofLine,
    /// Index of the level whose top it roofs.
    pub(crate) level: usize,
    /// Its rectangle.
    pub(crate) cell: Cell,
    /// Height of the wall plate (of the low edge's upper surface for HIS), metres.
    pub(crate) base: f64,
    /// Its form as written.
    pub(crate) shape: RoofShape,
}

impl PlacedLine<'_> {
    /// Returns true if its rectangle is excluded from the automatic regions.
    pub(crate) fn covers(&self) -> bool {
        self.shape != RoofShape::Pent && !self.shape.stands_on_another()
    }
}

/// Returns the side a single slope falls to.
pub(crate) fn fall(direction: RoofDirection) -> Option<Side> {
    match direction {
        RoofDirection::Front => Some(Side::Front),
        RoofDirection::Back => Some(Side::Back),
        RoofDirection::Left => Some(Side::Left),
        RoofDirection::Right => Some(Side::Right),
        RoofDirection::AlongFront | RoofDirection::AcrossFront => None,
    }
}

/// Returns the direction of a ridge.
pub(crate) fn ridge(direction: RoofDirection) -> Option<Ridge> {
    match direction {
        RoofDirection::AlongFront => Some(Ridge::A),
        RoofDirection::AcrossFront => Some(Ridge::B),
        _ => None,
    }
}

/// Returns the side a written lean-to falls to.
pub(crate) fn falls_to(one: &PlacedLine<'_>) -> Side {
    let wish = one.line.direction.and_then(|d| fall(d.value));
    wish.unwrap_or(Side::Front)
}

/// Returns true if a single written roof covers the whole rectangle.
pub(crate) fn covers(lines: &[&PlacedLine<'_>], cell: &Cell) -> bool {
    lines.iter().any(|l| l.covers() && l.cell.contains(cell))
}
