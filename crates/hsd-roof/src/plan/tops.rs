//! The area of each storey under a rectangle, for roof lines: plans are cut into strips only once for all lines.

use crate::plan::level::Level;
use crate::plan::outline::Outline;
use hsd_base::geometry::plan::slabs;
use hsd_base::geometry::plan::{Cell, Plan};
use std::cell::OnceCell;

/// The storeys of a house with what is derived from them on first use.
pub(crate) struct Tops<'l, 'h> {
    /// The storeys.
    pub(crate) levels: &'l [Level<'h>],
    cache: Vec<LevelCache>,
}

#[derive(Clone, Default)]
struct LevelCache {
    whole: OnceCell<Vec<Cell>>,
    open: OnceCell<Vec<Cell>>,
    outline: OnceCell<Outline>,
}

impl<'l, 'h> Tops<'l, 'h> {
    pub(crate) fn of(levels: &'l [Level<'h>]) -> Self {
        let cache = vec![LevelCache::default(); levels.len()];
        Tops { levels, cache }
    }

    /// Returns the area of a storey's plan inside a cell, square steps.
    pub(crate) fn inside(&self, k: usize, cell: &Cell) -> i128 {
        let plan = &self.levels[k].plan;
        common(
            self.cache[k].whole.get_or_init(|| slabs::strips(plan)),
            cell,
        )
    }

    /// Returns true if any part of a storey inside a cell has no storey above it.
    pub(crate) fn is_open(&self, k: usize, cell: &Cell) -> bool {
        let plan = &self.levels[k].plan;
        let upper = self.levels.get(k + 1).filter(|u| u.orthogonal);
        let cut = |upper: &Plan| slabs::combine(plan, upper, |mine, theirs| mine && !theirs);
        match upper.filter(|u| plan.fits(Some(&u.plan))) {
            Some(u) => common(self.cache[k].open.get_or_init(|| cut(&u.plan)), cell) > 0,
            None => self.inside(k, cell) > 0,
        }
    }

    /// Returns the walls of a storey.
    pub(crate) fn outline(&self, k: usize) -> &Outline {
        let plan = &self.levels[k].plan;
        self.cache[k].outline.get_or_init(|| Outline::of(plan))
    }
}

/// Returns the area that some non-overlapping cells share with another.
fn common(cells: &[Cell], with: &Cell) -> i128 {
    let shared = |c: &Cell| Cell {
        a0: c.a0.max(with.a0),
        b0: c.b0.max(with.b0),
        a1: c.a1.min(with.a1),
        b1: c.b1.min(with.b1),
    };
    let over = cells.iter().filter(|c| c.overlaps(with));
    over.map(|c| shared(c).area()).sum()
}
