//! Divides a region into rectangles: cut by a method, then merge (domain 3.2; `docs/contract.md` 4).
//!
//! The rectangles cover the region exactly and never overlap.

pub mod six_vertex;
pub mod least_cut;
pub mod branch_cut;
pub mod merge;
pub mod kd;
pub mod chord;
pub(crate) mod scan;

use crate::budget::SearchBudget;
use hsd_base::geometry::plan::raster::Raster;
use hsd_base::geometry::plan::slabs;
use hsd_base::geometry::plan::{Cell, Plan};

/// The method that cuts a region.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Method {
    /// The published method with the orthogonal fallback (001-15 to 001-19).
    Kd,
    /// The guillotine tree with the least total roof cut (domain 3.5 `opt`).
    #[default]
    LeastCut,
    /// Branch after branch down to six corners, which the six-vertex algorithm divides (002-15 to 002-23).
    BranchCut,
}

/// Returns the rectangles of a region, sorted by (b0, a0), in the plan's own grid steps.
///
/// The region is cut as one, pieces that do not touch included; see [`cut`].
pub fn partition(plan: &Plan, method: Method) -> Vec<Cell> {
    partition_within(plan, method, &SearchBudget::endless())
}

/// Does the same within a budget; if it is too small, `LeastCut` and `BranchCut` are greedy.
pub fn partition_within(plan: &Plan, method: Method, budget: &SearchBudget) -> Vec<Cell> {
    match plan.as_cell() {
        Some(cell) => vec![cell],
        None => merge::merge(cut_within(plan, method, budget)),
    }
}

/// Does the same; where a rectangle is narrower than `least` steps, the other methods are tried, and the division with the
/// fewest of those is taken.
pub(crate) fn partition_broad(
    plan: &Plan,
    method: Method,
    budget: &SearchBudget,
    least: i64,
) -> Vec<Cell> {
    let narrow = |cells: &[Cell]| {
        let narrow = cells.iter().filter(|c| c.width().min(c.depth()) < least);
        narrow.count()
    };
    let cells = partition_within(plan, method, budget);
    if narrow(&cells) == 0 {
        return cells;
    }
    let turned = |c: Cell| Cell {
        a0: c.b0,
        b0: c.a0,
        a1: c.b1,
        b1: c.a1,
    };
    let across = Plan {
        loops: plan
            .loops
            .iter()
            .map(|l| l.iter().map(|p| (p.1, p.0)).collect())
            .collect(),
    };
    let across = slabs::strips(&across).into_iter().map(turned).collect();
    let methods = [Method::LeastCut, Method::BranchCut, Method::Kd].into_iter();
    let others = methods.filter(|m| *m != method);
    let others = others.map(|m| partition_within(plan, m, budget));
    let strips = [slabs::strips(plan), across].map(merge::merge);
    let all = std::iter::once(cells).chain(others).chain(strips);
    // Of equals the first is taken.
    let best = all.min_by_key(|cells| (narrow(cells), cells.len()));
    best.unwrap_or_default()
}

/// Returns the rectangles before merging, sorted by (b0, a0).
///
/// `LeastCut` is exact up to 32 distinct coordinates per axis and greedy (`chord.rs`) above.
/// `BranchCut` is greedy too if it would take more than 2^28 steps (a stair of 480). A
/// region with more than 2^20 grid fields comes in strips along a, whatever the method: ranking
/// cuts over more lines would take too long.
pub fn cut(plan: &Plan, method: Method) -> Vec<Cell> {
    cut_within(plan, method, &SearchBudget::endless())
}

fn cut_within(plan: &Plan, method: Method, budget: &SearchBudget) -> Vec<Cell> {
    let mut cells = match Raster::of(plan) {
        None => slabs::strips(plan),
        Some(raster) if raster.cols() == 0 || raster.rows() == 0 => Vec::new(),
        Some(raster) => match method {
            Method::Kd => kd::cut(&raster),
            Method::LeastCut => least_cut(&raster, plan.corners(), budget),
            Method::BranchCut => branch_cut(&raster, plan.corners(), budget),
        },
    };
    cells.sort_unstable_by_key(Cell::key);
    cells
}

/// Returns the best cuts, or greedy ones if there are too many to choose from.
fn least_cut(raster: &Raster, corners: usize, budget: &SearchBudget) -> Vec<Cell> {
    if raster.cols().max(raster.rows()) < least_cut::MAX_LINES {
        let (cells, steps) = least_cut::cut(raster, budget.most(corners));
        budget.pay(corners, steps, cells.is_some());
        if let Some(cells) = cells {
            return cells;
        }
    }
    chord::cut(raster)
}

/// Returns the cuts by branches, or greedy ones if there are too many to choose from.
fn branch_cut(raster: &Raster, corners: usize, budget: &SearchBudget) -> Vec<Cell> {
    let most = budget.most(corners).min(branch_cut::MOST_STEPS);
    let (cells, steps) = branch_cut::cut(raster, most);
    budget.pay(corners, steps, cells.is_some());
    cells.unwrap_or_else(|| chord::cut(raster))
}
