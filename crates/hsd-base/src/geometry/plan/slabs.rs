//! Plans with too many corners for a raster, handled in slabs between neighbouring b's.
//!
//! No coordinates are ranked here: a slab's intervals continue into the next slab while they do not change. It is exact
//! for any even-odd plan, and small for any outline a person draws.

use crate::geometry::plan::{Cell, Plan};

/// A wall along b: its a, its front and back end, and true if it belongs to the first plan.
type Wall = (i64, i64, i64, bool);

/// Returns the plan as cells that do not overlap: strips along a, each as deep as it stays unchanged.
pub fn strips(plan: &Plan) -> Vec<Cell> {
    combine(plan, &Plan::default(), |mine, _| mine)
}

/// Returns the fields of two plans for which `keep` (first inside, second inside) holds, as strips.
pub fn combine(first: &Plan, second: &Plan, keep: fn(bool, bool) -> bool) -> Vec<Cell> {
    let mut walls = walls(first, second);
    walls.sort_unstable_by_key(|w| (w.1, w.0));
    let mut levels: Vec<i64> = walls.iter().flat_map(|w| [w.1, w.2]).collect();
    levels.sort_unstable();
    levels.dedup();
    let (mut next, mut active) = (0, Vec::<Wall>::new());
    let (mut open, mut done) = (Vec::<Cell>::new(), Vec::new());
    for pair in levels.windows(2) {
        let (b0, b1) = (pair[0], pair[1]);
        active.retain(|w| w.2 > b0);
        let begun = walls[next..].iter().take_while(|w| w.1 == b0).count();
        active.extend_from_slice(&walls[next..next + begun]);
        next += begun;
        // Two sorted runs: the stable sort merges them.
        active.sort_by_key(|w| w.0);
        open = advance(open, intervals(&active, keep), (b0, b1), &mut done);
    }
    done.append(&mut open);
    done
}

fn walls(first: &Plan, second: &Plan) -> Vec<Wall> {
    let of = |plan: &'_ Plan, mine: bool| -> Vec<Wall> {
        plan.edges()
            .filter(|(p, q)| p.1 != q.1)
            .map(|(p, q)| (p.0, p.1.min(q.1), p.1.max(q.1), mine))
            .collect()
    };
    let mut walls = of(first, true);
    walls.extend(of(second, false));
    walls
}

/// Returns the kept intervals along a of one slab, from its walls sorted by a.
fn intervals(active: &[Wall], keep: fn(bool, bool) -> bool) -> Vec<(i64, i64)> {
    let (mut mine, mut theirs, mut start) = (false, false, None);
    let mut found: Vec<(i64, i64)> = Vec::new();
    for (n, wall) in active.iter().enumerate() {
        if wall.3 {
            mine = !mine;
        } else {
            theirs = !theirs;
        }
        if active.get(n + 1).is_some_and(|w| w.0 == wall.0) {
            continue;
        }
        match (start, keep(mine, theirs)) {
            (None, true) => start = Some(wall.0),
            (Some(a0), false) => {
                found.push((a0, wall.0));
                start = None;
            }
            _ => {}
        }
    }
    found
}

/// Continues the open strips that have the same interval in this slab, and closes the others.
fn advance(
    open: Vec<Cell>,
    now: Vec<(i64, i64)>,
    (b0, b1): (i64, i64),
    done: &mut Vec<Cell>,
) -> Vec<Cell> {
    let mut open = open.into_iter().peekable();
    let next = now
        .into_iter()
        .map(|(a0, a1)| {
            while let Some(ended) = open.next_if(|c| c.a0 < a0) {
                done.push(ended);
            }
            match open.next_if(|c| c.a0 == a0 && c.a1 == a1 && c.b1 == b0) {
                Some(c) => Cell { b1, ..c },
                None => Cell { a0, b0, a1, b1 },
            }
        })
        .collect();
    done.extend(open);
    next
}

#[cfg(test)]
mod tests {
    use crate::geometry::plan::slabs::*;

    #[test]
    fn strips_run_on_until_the_outline_changes() {
        let plan = Plan::from_loops(vec![vec![(0, 0), (8, 0), (8, 4), (3, 4), (3, 9), (0, 9)]]);
        let mut cells = strips(&plan);
        cells.sort_unstable_by_key(Cell::key);
        assert_eq!(
            cells,
            vec![
                Cell {
                    a0: 0,
                    b0: 0,
                    a1: 8,
                    b1: 4
                },
                Cell {
                    a0: 0,
                    b0: 4,
                    a1: 3,
                    b1: 9
                }
            ]
        );
    }
}
