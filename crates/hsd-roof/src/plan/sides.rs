//! Neighbours of a side: regions that cover the whole of it, upper walls along it.
//!
//! Both are looked up in sorted lists, which is fast for plans of very many regions.

use crate::region::Side;
use hsd_base::geometry::plan::{Cell, Plan};

/// A piece of a line: the line's coordinate, its two ends, its owner.
type Piece = (i64, i64, i64, usize);

/// The sides of all regions by direction.
#[derive(Debug, Default)]
pub(crate) struct Sides {
    /// For each direction (see [`index`]) the sides that face it, sorted. Regions never
    /// overlap, so the pieces of one line are disjoint.
    facing: [Vec<Piece>; 4],
}

impl Sides {
    /// Creates the sides of these cells, with their indices as owners.
    pub(crate) fn of(cells: &[Cell]) -> Self {
        let facing = Side::ALL.map(|side| {
            let mut pieces: Vec<Piece> = cells
                .iter()
                .enumerate()
                .map(|(n, c)| {
                    let (at, lo, hi) = piece(c, side);
                    (at, lo, hi, n)
                })
                .collect();
            pieces.sort_unstable();
            pieces
        });
        Self { facing }
    }

    /// Returns the region that contains the whole of side `side` of `cell` in its own side.
    pub(crate) fn beyond(&self, cell: &Cell, side: Side) -> Option<usize> {
        let (at, lo, hi) = piece(cell, side);
        let facing = &self.facing[index(side.opposite())];
        let next = facing.partition_point(|p| (p.0, p.1) <= (at, lo));
        let &(line, from, to, owner) = facing.get(next.checked_sub(1)?)?;
        (line == at && from <= lo && hi <= to).then_some(owner)
    }

    /// Returns true if another region lies along part of side `side` of `cell`.
    pub(crate) fn touches(&self, cell: &Cell, side: Side) -> bool {
        let (at, lo, hi) = piece(cell, side);
        let facing = &self.facing[index(side.opposite())];
        // Pieces of a line are disjoint, so the last that begins before the end of the side reaches farthest.
        let next = facing.partition_point(|p| (p.0, p.1) < (at, hi));
        let last = next.checked_sub(1).map(|last| facing[last]);
        last.is_some_and(|(line, _, to, _)| line == at && to > lo)
    }
}

/// The walls of the storey above.
#[derive(Debug, Default)]
pub(crate) struct Walls {
    /// Walls along b (first) and along a, sorted, disjoint on each line.
    along: [Vec<(i64, i64, i64)>; 2],
}

impl Walls {
    /// Creates the walls of an upper plan.
    pub(crate) fn of(upper: &Plan) -> Self {
        let mut along = [Vec::new(), Vec::new()];
        for (p, q) in upper.clean().edges() {
            if p.0 == q.0 {
                along[0].push((p.0, p.1.min(q.1), p.1.max(q.1)));
            } else {
                along[1].push((p.1, p.0.min(q.0), p.0.max(q.0)));
            }
        }
        along.iter_mut().for_each(|walls| walls.sort_unstable());
        Self { along }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.along.iter().all(Vec::is_empty)
    }

    /// Returns the length of upper walls along a side of `cell`, in grid steps. The cell must lie
    /// outside the upper storey, so any wall there has that storey on its other side.
    pub(crate) fn along(&self, cell: &Cell, side: Side) -> i64 {
        let (at, lo, hi) = piece(cell, side);
        let walls = &self.along[usize::from(matches!(side, Side::Front | Side::Back))];
        let start = walls.partition_point(|w| w.0 < at || (w.0 == at && w.2 <= lo));
        walls[start..]
            .iter()
            .take_while(|w| w.0 == at && w.1 < hi)
            .fold(0i64, |sum, w| {
                sum.saturating_add(w.2.min(hi).saturating_sub(w.1.max(lo)))
            })
    }
}

/// Returns a side as a piece of its line: coordinate, ends.
fn piece(c: &Cell, side: Side) -> (i64, i64, i64) {
    match side {
        Side::Front => (c.b0, c.a0, c.a1),
        Side::Back => (c.b1, c.a0, c.a1),
        Side::Right => (c.a0, c.b0, c.b1),
        Side::Left => (c.a1, c.b0, c.b1),
    }
}

/// Returns the index of a side in [`Side::ALL`].
fn index(side: Side) -> usize {
    match side {
        Side::Back => 0,
        Side::Front => 1,
        Side::Left => 2,
        Side::Right => 3,
    }
}
