//! `kd`: the published kD-roofing with its gaps filled (001-15 to 001-18; domain 3.2).
//!
//! Each cell is cut along the scan line with the greatest wall length, orthogonally to the
//! cut that made it; where no wall runs that way, along the other direction (domain 3.3).

use crate::partition::scan::{Lengths, best, candidates, halves};
use hsd_base::geometry::plan::Cell;
use hsd_base::geometry::plan::raster::Raster;
use std::cmp::Reverse;

/// Returns the roof cells of a raster before merging, in no particular order.
pub(crate) fn cut(raster: &Raster) -> Vec<Cell> {
    let walls = Lengths::walls(raster);
    let mut roofs = Vec::new();
    let mut todo = vec![(raster.span(), None)];
    while let Some((s, last)) = todo.pop() {
        // Orthogonal cuts first, then most wall.
        let ranked = candidates(&walls, s).map(|c| ((Some(c.line) == last, Reverse(c.wall)), c));
        match best(raster, s, ranked) {
            Some(c) => todo.extend(halves(s, c.line, c.n).map(|half| (half, Some(c.line)))),
            // No wall inside: one field decides for all (domain 3.4).
            None if raster.inside[s.j0 * raster.cols() + s.i0] => roofs.push(raster.cell(s)),
            None => {}
        }
    }
    roofs
}
