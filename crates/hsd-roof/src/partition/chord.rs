//! `chord`: the greedy substitute for `least-cut` on outlines with very many coordinates:
//! always the cut that divides the least roof (domain 3.5).

use crate::partition::scan::{Lengths, best, candidates, halves};
use hsd_base::geometry::plan::Cell;
use hsd_base::geometry::plan::raster::Raster;
use std::cmp::Reverse;

/// Returns the roof cells of a raster before merging, in no particular order.
///
/// Candidates are those of `kd` (some wall in the cell); least roof divided, then most wall,
/// then the ties of `kd`.
pub(crate) fn cut(raster: &Raster) -> Vec<Cell> {
    let (walls, roof) = (Lengths::walls(raster), Lengths::roof(raster));
    let mut roofs = Vec::new();
    let mut todo = vec![raster.span()];
    while let Some(s) = todo.pop() {
        let ranked =
            candidates(&walls, s).map(|c| ((roof.within(c.line, c.n, s), Reverse(c.wall)), c));
        match best(raster, s, ranked) {
            Some(c) => todo.extend(halves(s, c.line, c.n)),
            None if raster.inside[s.j0 * raster.cols() + s.i0] => roofs.push(raster.cell(s)),
            None => {}
        }
    }
    roofs
}
