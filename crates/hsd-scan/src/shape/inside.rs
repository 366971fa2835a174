//! Recognition of the floors of rooms, and of stairs, wells and stoves in them.
//!
//! | step | file |
//! |---|---|
//! | the ink in the rooms, without that of walls | `canvas` |
//! | things, by the symbols of the legend | `things` |
//! | floors, by strokes that go on over a room | `floors` |

mod canvas;
mod floors;
mod things;

use super::Shape;
use crate::grid::Grid;
use crate::legend::{Thing, ThingKind};
use crate::sheet::Ink;
use canvas::Canvas;
pub use floors::Floor;

/// A thing that was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// Its kind.
    pub kind: ThingKind,
    /// Its upper left cell.
    pub at: (i32, i32),
    /// Its size: cells across and down.
    pub size: (i32, i32),
    /// The direction of its front on the sheet: 1 or -1 to the right or down, the other 0.
    pub faces: (i32, i32),
    /// How well the ink agrees with its symbol, 0 to 1.
    pub likeness: f64,
}

/// Returns a house with the floors and things found in its rooms: `symbols` are those of its legend, `straight` is the ink without strokes that run
/// aslant.
#[must_use]
pub fn furnished(
    mut shape: Shape,
    symbols: &[Thing],
    (ink, straight): (&Ink, &Ink),
    grid: &Grid,
    is_by_hand: bool,
) -> Shape {
    let canvas = Canvas::of(ink, straight, grid, &shape);
    shape.things = things::things(&canvas, &shape, symbols, is_by_hand);
    floors::mark(&canvas, &mut shape);
    shape
}
