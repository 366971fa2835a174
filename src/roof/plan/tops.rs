//! What lies under a rectangle on each storey, for roof lines: the plans are cut into strips once, so that
//! a thousand lines over a plan of a thousand corners cost no thousand divisions of it.

use crate::geometry::plan::slabs;
use crate::geometry::plan::{Cell, Plan};
use crate::roof::plan::level::Level;
use crate::roof::plan::outline::Outline;
use std::cell::OnceCell;

/// The storeys of a house, each looked at when somebody asks.
pub(in crate::roof) struct Tops<'l, 'h> {
    /// The storeys.
    pub(in crate::roof) levels: &'l [Level<'h>],
    known: Vec<Known>,
}

#[derive(Clone, Default)]
struct Known {
    whole: OnceCell<Vec<Cell>>,
    open: OnceCell<Vec<Cell>>,
    outline: OnceCell<Outline>,
}

impl<'l, 'h> Tops<'l, 'h> {
    pub(in crate::roof) fn of(levels: &'l [Level<'h>]) -> Self {
        let known = vec![Known::default(); levels.len()];
        Tops { levels, known }
    }

    /// The area of a storey's plan inside a cell, square steps.
    pub(in crate::roof) fn inside(&self, k: usize, cell: &Cell) -> i128 {
        let plan = &self.levels[k].plan;
        common(
            self.known[k].whole.get_or_init(|| slabs::strips(plan)),
            cell,
        )
    }

    /// Whether a storey lies in the open anywhere inside a cell.
    pub(in crate::roof) fn is_open(&self, k: usize, cell: &Cell) -> bool {
        let plan = &self.levels[k].plan;
        let upper = self.levels.get(k + 1).filter(|u| u.orthogonal);
        let cut = |upper: &Plan| slabs::combine(plan, upper, |mine, theirs| mine && !theirs);
        match upper.filter(|u| plan.fits(Some(&u.plan))) {
            Some(u) => common(self.known[k].open.get_or_init(|| cut(&u.plan)), cell) > 0,
            None => self.inside(k, cell) > 0,
        }
    }

    /// The walls of a storey.
    pub(in crate::roof) fn outline(&self, k: usize) -> &Outline {
        let plan = &self.levels[k].plan;
        self.known[k].outline.get_or_init(|| Outline::of(plan))
    }
}

/// The area that some cells, which do not overlap, share with another.
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
