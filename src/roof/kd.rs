//! `kd`: the published kD-roofing with its gaps filled (001-15 to 001-18; domain 3.2).
//!
//! Each cell is cut along the scan line with the greatest wall length, orthogonally to the
//! cut that made it; where no wall runs that way, along the other direction (domain 3.3).

use super::plan::Cell;
use super::raster::{Raster, Span};
use super::scan::{Candidate, Lengths, Line, candidates, halves};
use std::cmp::Reverse;

/// The roof cells of a raster before merging, in no particular order.
pub(super) fn cut(raster: &Raster) -> Vec<Cell> {
    let walls = Lengths::walls(raster);
    let mut roofs = Vec::new();
    let mut todo = vec![(raster.span(), None)];
    while let Some((s, last)) = todo.pop() {
        match best(raster, &walls, s, last) {
            Some(c) => todo.extend(halves(s, c.line, c.n).map(|half| (half, Some(c.line)))),
            // No wall inside: one field decides for all (domain 3.4).
            None if raster.inside[s.j0 * raster.cols() + s.i0] => roofs.push(raster.cell(s)),
            None => {}
        }
    }
    roofs
}

/// The cut of a cell: most wall, then the tie rules; `last` is its parent's direction.
fn best(raster: &Raster, walls: &Lengths, s: Span, last: Option<Line>) -> Option<Candidate> {
    candidates(raster, walls, s).min_by_key(|c| (Some(c.line) == last, Reverse(c.wall), c.tie()))
}
