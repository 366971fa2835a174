//! Merge: roofs that share a whole edge become one (001-19; domain 3.2).
//!
//! Always the pair with the longest shared edge; ties: larger union, then lower b, then lower a of the union. If even
//! that leaves two pairs (the corner of a square grid), the pair side by side along a comes first, as x comes before y
//! among cuts.

use hsd_base::geometry::plan::Cell;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

/// Above this many cells the pairs are kept in a heap instead of being searched each time.
const FEW: usize = 24;

/// The merit of uniting a pair; the greatest comes first.
type Rank = (i64, i128, Reverse<i64>, Reverse<i64>, bool);

/// Unites cells until no two share a whole edge of both; the order of the result is (b0, a0).
pub(crate) fn merge(mut cells: Vec<Cell>) -> Vec<Cell> {
    if cells.len() > FEW {
        cells = merge_many(cells);
    } else {
        merge_few(&mut cells);
    }
    cells.sort_unstable_by_key(Cell::key);
    cells
}

fn merge_few(cells: &mut Vec<Cell>) {
    loop {
        let mut best: Option<(Rank, usize, usize)> = None;
        for q in 1..cells.len() {
            for p in 0..q {
                if let Some(rank) = rank(&cells[p], &cells[q])
                    && best.is_none_or(|b| b.0 < rank)
                {
                    best = Some((rank, p, q));
                }
            }
        }
        let Some((_, p, q)) = best else { return };
        cells[p] = united(&cells[p], &cells[q]);
        cells.swap_remove(q);
    }
}

/// Returns the rank of a pair that shares a whole edge of both.
fn rank(p: &Cell, q: &Cell) -> Option<Rank> {
    let beside = p.b0 == q.b0 && p.b1 == q.b1 && (p.a1 == q.a0 || q.a1 == p.a0);
    let behind = p.a0 == q.a0 && p.a1 == q.a1 && (p.b1 == q.b0 || q.b1 == p.b0);
    let shared = if beside {
        p.depth()
    } else if behind {
        p.width()
    } else {
        return None;
    };
    let union = united(p, q);
    Some((
        shared,
        union.area(),
        Reverse(union.b0),
        Reverse(union.a0),
        beside,
    ))
}

fn united(p: &Cell, q: &Cell) -> Cell {
    Cell {
        a0: p.a0.min(q.a0),
        b0: p.b0.min(q.b0),
        a1: p.a1.max(q.a1),
        b1: p.b1.max(q.b1),
    }
}

/// A whole edge: true if it runs along b, its line, its ends.
type Edge = (bool, i64, i64, i64);

fn edges(c: &Cell) -> [Edge; 4] {
    [
        (true, c.a0, c.b0, c.b1),
        (true, c.a1, c.b0, c.b1),
        (false, c.b0, c.a0, c.a1),
        (false, c.b1, c.a0, c.a1),
    ]
}

/// Applies the same rule with the pairs in a heap: cells never change, they end and new ones begin.
fn merge_many(cells: Vec<Cell>) -> Vec<Cell> {
    let mut all: Vec<(Cell, bool)> = Vec::with_capacity(2 * cells.len());
    let mut by_edge: BTreeMap<Edge, [usize; 2]> = BTreeMap::new();
    let mut pairs = BinaryHeap::new();
    for cell in cells {
        enter(cell, &mut all, &mut by_edge, &mut pairs);
    }
    while let Some((_, p, q)) = pairs.pop() {
        if !(all[p].1 && all[q].1) {
            continue;
        }
        for n in [p, q] {
            all[n].1 = false;
            for edge in edges(&all[n].0) {
                let owners = by_edge.entry(edge).or_insert([usize::MAX; 2]);
                owners
                    .iter_mut()
                    .filter(|o| **o == n)
                    .for_each(|o| *o = usize::MAX);
            }
        }
        let union = united(&all[p].0, &all[q].0);
        enter(union, &mut all, &mut by_edge, &mut pairs);
    }
    all.into_iter().filter(|c| c.1).map(|c| c.0).collect()
}

/// Adds a live cell, and its pairs with those whose whole edges are already there.
fn enter(
    cell: Cell,
    all: &mut Vec<(Cell, bool)>,
    by_edge: &mut BTreeMap<Edge, [usize; 2]>,
    pairs: &mut BinaryHeap<(Rank, usize, usize)>,
) {
    let n = all.len();
    all.push((cell, true));
    for edge in edges(&cell) {
        let owners = by_edge.entry(edge).or_insert([usize::MAX; 2]);
        for &other in owners.iter().filter(|o| **o != usize::MAX) {
            if let Some(rank) = rank(&all[other].0, &cell) {
                pairs.push((rank, other, n));
            }
        }
        if let Some(free) = owners.iter_mut().find(|o| **o == usize::MAX) {
            *free = n;
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::partition::merge::*;

    #[test]
    fn the_longest_edge_goes_first() {
        let cells = vec![
            Cell {
                a0: 0,
                b0: 0,
                a1: 6,
                b1: 4,
            },
            Cell {
                a0: 0,
                b0: 4,
                a1: 6,
                b1: 6,
            },
            Cell {
                a0: 6,
                b0: 0,
                a1: 9,
                b1: 4,
            },
        ];
        let merged = vec![
            Cell {
                a0: 0,
                b0: 0,
                a1: 6,
                b1: 6,
            },
            Cell {
                a0: 6,
                b0: 0,
                a1: 9,
                b1: 4,
            },
        ];
        assert_eq!(merge(cells), merged);
    }

    #[test]
    fn the_heap_does_what_the_search_does() {
        let mut seed = 7u64;
        for _ in 0..300 {
            // A grid with some fields missing and some columns as wide as their rows.
            let mut cells = Vec::new();
            for n in 0..36i64 {
                seed = seed
                    .wrapping_mul(6364136223846793005)
                    .wrapping_add(1442695040888963407);
                if seed >> 60 != 0 {
                    let (i, j) = (n % 6, n / 6);
                    cells.push(Cell {
                        a0: 2 * i,
                        b0: 2 * j,
                        a1: 2 * i + 2,
                        b1: 2 * j + 2,
                    });
                }
            }
            let mut few = cells.clone();
            merge_few(&mut few);
            let mut many = merge_many(cells);
            few.sort_unstable();
            many.sort_unstable();
            assert_eq!(few, many);
        }
    }
}
