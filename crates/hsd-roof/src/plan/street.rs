//! Street rule: the building along the street is a region of its own (`docs/contract.md` 4;
//! domain 3.6 L2, 3.7).

use hsd_base::geometry::plan::slabs;
use hsd_base::geometry::plan::{Cell, Plan};

/// Returns the largest rectangle inside the region whose whole front is the first line.
///
/// `first_line` is the first wall line, collinear lines merged, from its start to its end in walk order (interior on
/// the right); a reversed line is accepted too. `None` if the region does not lie behind the whole of it (a set-back
/// storey, say), or if the line is not a wall line.
pub fn street_front(plan: &Plan, first_line: ((i64, i64), (i64, i64))) -> Option<Cell> {
    let (start, end) = first_line;
    if start.1 == end.1 && start.0 != end.0 {
        let (lo, hi) = (start.0.min(end.0), start.0.max(end.0));
        return front(&slabs::strips(plan), (lo, hi), start.1, start.0 < end.0);
    }
    if start.0 == end.0 && start.1 != end.1 {
        // The same with the axes exchanged, which also mirrors left and right.
        let turned = slabs::strips(&turn(plan));
        let (lo, hi) = (start.1.min(end.1), start.1.max(end.1));
        let cell = front(&turned, (lo, hi), start.0, start.1 > end.1)?;
        return Some(Cell {
            a0: cell.b0,
            b0: cell.a0,
            a1: cell.b1,
            b1: cell.a1,
        });
    }
    None
}

fn turn(plan: &Plan) -> Plan {
    Plan {
        loops: plan
            .loops
            .iter()
            .map(|l| l.iter().map(|p| (p.1, p.0)).collect())
            .collect(),
    }
}

/// Returns the rectangle on the line b = `at` from `ends.0` to `ends.1`: behind it if `behind` holds and there is any
/// region, otherwise before it.
fn front(strips: &[Cell], ends: (i64, i64), at: i64, behind: bool) -> Option<Cell> {
    let deep = |behind: bool| {
        let to = if behind {
            run(strips, ends, at)
        } else {
            run_before(strips, ends, at)
        };
        (to != at).then(|| Cell {
            a0: ends.0,
            b0: at.min(to),
            a1: ends.1,
            b1: at.max(to),
        })
    };
    deep(behind).or_else(|| deep(!behind))
}

/// Returns the b up to which the strips behind b = `at` cover the whole of `ends`. Strips lie one behind
/// the other, and those of one slab never touch, so one strip must span all.
fn run(strips: &[Cell], ends: (i64, i64), at: i64) -> i64 {
    let spans = |c: &&Cell| c.a0 <= ends.0 && ends.1 <= c.a1;
    let mut to = at;
    while let Some(next) = strips
        .iter()
        .filter(spans)
        .find(|c| c.b0 <= to && to < c.b1)
    {
        to = next.b1;
    }
    to
}

fn run_before(strips: &[Cell], ends: (i64, i64), at: i64) -> i64 {
    let spans = |c: &&Cell| c.a0 <= ends.0 && ends.1 <= c.a1;
    let mut to = at;
    while let Some(next) = strips
        .iter()
        .filter(spans)
        .find(|c| c.b0 < to && to <= c.b1)
    {
        to = next.b0;
    }
    to
}

#[cfg(test)]
mod tests {
    use crate::plan::street::*;

    fn l2() -> Plan {
        Plan::from_loops(vec![vec![(0, 0), (6, 0), (6, 4), (4, 4), (4, 14), (0, 14)]])
    }

    #[test]
    fn the_front_building_is_as_deep_as_its_whole_width() {
        let front = Cell {
            a0: 0,
            b0: 0,
            a1: 6,
            b1: 4,
        };
        assert_eq!(street_front(&l2(), ((0, 0), (6, 0))), Some(front));
        assert_eq!(street_front(&l2(), ((6, 0), (0, 0))), Some(front));
        assert_eq!(
            street_front(&turn(&l2()), ((0, 6), (0, 0))),
            Some(Cell {
                a0: 0,
                b0: 0,
                a1: 4,
                b1: 6
            })
        );
    }

    #[test]
    fn no_region_behind_the_whole_line_no_street_region() {
        assert_eq!(street_front(&l2(), ((0, 14), (6, 14))), None);
        assert_eq!(street_front(&l2(), ((0, 0), (0, 0))), None);
        let upper = Plan::from_loops(vec![vec![(0, 0), (6, 0), (6, 4), (0, 4)]]);
        assert_eq!(
            street_front(&l2().difference(&upper), ((0, 0), (6, 0))),
            None
        );
    }
}
