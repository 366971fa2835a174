//! The walls of a plan along the sides of a rectangle.

use crate::region::Side;
use hsd_base::geometry::plan::{Cell, Plan};

/// The walls of a plan by direction and line.
#[derive(Clone, Debug, Default)]
pub struct Outline {
    /// Walls along b (first) and along a (second) as (line, start, end), sorted.
    walls: [Vec<(i64, i64, i64)>; 2],
}

impl Outline {
    /// Creates the outline of a plan whose loops do not overlap each other.
    pub fn of(plan: &Plan) -> Outline {
        let mut walls = [Vec::new(), Vec::new()];
        for (p, q) in plan.edges() {
            if p.0 == q.0 {
                walls[0].push((p.0, p.1.min(q.1), p.1.max(q.1)));
            } else {
                walls[1].push((p.1, p.0.min(q.0), p.0.max(q.0)));
            }
        }
        walls.iter_mut().for_each(|w| w.sort_unstable());
        Outline { walls }
    }

    /// Returns the pieces of a side of `cell` along which a wall runs, ascending.
    pub fn along(&self, cell: &Cell, side: Side) -> Vec<(i64, i64)> {
        self.beside(cell, side).collect()
    }

    fn beside(&self, cell: &Cell, side: Side) -> impl Iterator<Item = (i64, i64)> + '_ {
        self.pieces(matches!(side, Side::Front | Side::Back), piece(cell, side))
    }

    /// Returns the pieces of a line along a (or b) from `lo` to `hi` along which a wall runs, ascending.
    pub fn on(&self, along_a: bool, on: (i64, i64, i64)) -> Vec<(i64, i64)> {
        self.pieces(along_a, on).collect()
    }

    fn pieces(
        &self,
        along_a: bool,
        (line, lo, hi): (i64, i64, i64),
    ) -> impl Iterator<Item = (i64, i64)> + '_ {
        let walls = &self.walls[usize::from(along_a)];
        // Walls of one line do not overlap, so they are sorted by their ends as well.
        let start = walls.partition_point(|w| (w.0, w.2) <= (line, lo));
        let on = walls[start..]
            .iter()
            .take_while(move |w| w.0 == line && w.1 < hi);
        let clipped = on.map(move |w| (w.1.max(lo), w.2.min(hi)));
        clipped.filter(|(from, to)| from < to)
    }

    /// Returns the pieces of a side of `cell` along which no wall runs, ascending.
    pub fn gaps(&self, cell: &Cell, side: Side) -> Vec<(i64, i64)> {
        let (_, lo, hi) = piece(cell, side);
        let mut gaps = Vec::new();
        let mut at = lo;
        for (from, to) in self.beside(cell, side) {
            gaps.extend((at < from).then_some((at, from)));
            at = at.max(to);
        }
        gaps.extend((at < hi).then_some((at, hi)));
        gaps
    }

    /// Returns true if a wall runs along the whole side.
    pub fn whole(&self, cell: &Cell, side: Side) -> bool {
        let (_, lo, hi) = piece(cell, side);
        let reached = self
            .beside(cell, side)
            .try_fold(lo, |at, (from, to)| (from <= at).then_some(at.max(to)));
        reached.is_some_and(|at| at >= hi)
    }
}

/// Returns a side as a piece of its line: the line, its ends.
pub fn piece(cell: &Cell, side: Side) -> (i64, i64, i64) {
    match side {
        Side::Front => (cell.b0, cell.a0, cell.a1),
        Side::Back => (cell.b1, cell.a0, cell.a1),
        Side::Right => (cell.a0, cell.b0, cell.b1),
        Side::Left => (cell.a1, cell.b0, cell.b1),
    }
}

#[cfg(test)]
mod tests {
    use crate::plan::outline::*;

    #[test]
    fn walls_and_gaps_of_a_side_add_up() {
        let l = Plan::from_loops(vec![vec![(0, 0), (6, 0), (6, 4), (4, 4), (4, 14), (0, 14)]]);
        let front = Cell {
            a0: 0,
            b0: 0,
            a1: 6,
            b1: 4,
        };
        let outline = Outline::of(&l);
        assert!(outline.whole(&front, Side::Front));
        assert_eq!(outline.along(&front, Side::Back), vec![(4, 6)]);
        assert_eq!(outline.gaps(&front, Side::Back), vec![(0, 4)]);
        assert_eq!(outline.along(&front, Side::Right), vec![(0, 4)]);
    }
}
