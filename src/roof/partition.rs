//! A region to rectangles: cut by a method, then merge (domain 3.2; `language.md` 4).
//!
//! The rectangles cover the region exactly and never overlap.

use super::plan::{Cell, Plan};
use super::raster::{MAX_FIELDS, Raster};
use super::{chord, kd, least_cut, merge, slabs};

/// How a region is cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Method {
    /// The published method with the orthogonal fallback (001-15 to 001-19).
    Kd,
    /// The guillotine tree with the least total roof cut (domain 3.5 `opt`).
    #[default]
    LeastCut,
}

/// The rectangles of a region, sorted by (b0, a0), in the plan's own grid steps.
///
/// The region is cut as one, pieces that do not touch included. `LeastCut` is exact up to 32
/// distinct coordinates per axis and greedy (`chord.rs`) above. A region with more than
/// 2^20 grid fields comes in strips along a, merged, whatever the method: ranking cuts
/// over so many lines would take longer than anyone waits.
pub fn partition(plan: &Plan, method: Method) -> Vec<Cell> {
    if let Some(cell) = plan.as_cell() {
        return vec![cell];
    }
    let Some(raster) = Raster::of(plan) else {
        debug_assert!(plan.loops.iter().map(Vec::len).sum::<usize>() as u128 > (MAX_FIELDS as u128).isqrt());
        return merge::merge(slabs::strips(plan));
    };
    if raster.cols() == 0 || raster.rows() == 0 {
        return Vec::new();
    }
    let lines = raster.cols().max(raster.rows()) + 1;
    let cells = match method {
        Method::Kd => kd::cut(&raster),
        Method::LeastCut if lines <= least_cut::MAX_LINES => least_cut::cut(&raster),
        Method::LeastCut => chord::cut(&raster),
    };
    merge::merge(cells)
}
