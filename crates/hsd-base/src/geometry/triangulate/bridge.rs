//! Bridges from holes to the ring around them. With few corners all sides are looked at; with many a tree of their boxes finds
//! those near a bridge.

use crate::geometry::grid::{Bounds, Grid};
use crate::geometry::triangulate::turn;
use glam::DVec2;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Sides of a few are looked at without an index.
const FEW: usize = 64;

/// The corners to which a bridge may be tried, for each corner. In rings that do not cross the first or second is free.
const TRIES: usize = 16;

/// Joins an outline and its holes into one ring by the shortest bridges that cross nothing. A hole without such a bridge is left
/// out, as are holes that cross others if too many bridges have been tried.
pub fn bridged(outline: &[DVec2], holes: &[Vec<DVec2>]) -> Vec<DVec2> {
    let mut ring = outline.to_vec();
    let mut rest: Vec<&Vec<DVec2>> = holes.iter().filter(|h| h.len() > 2).collect();
    // In the order of the hole that reaches farthest, so that a bridge meets only what is joined already.
    let reach = |hole: &[DVec2]| hole.iter().map(|p| p.x).fold(f64::MIN, f64::max);
    rest.sort_by(|g, h| reach(h).total_cmp(&reach(g)));
    let mut borders = Borders::new(outline, &rest);
    let mut tries = TRIES * borders.sides.len();
    for (number, hole) in rest.into_iter().enumerate() {
        let start = (0..hole.len())
            .max_by(|i, j| hole[*i].x.total_cmp(&hole[*j].x))
            .unwrap_or(0);
        let from = hole[start];
        // Squares are not negative, so their bits have their order.
        let order = ring.iter().enumerate();
        let order = order.map(|(i, p)| Reverse((from.distance_squared(*p).to_bits(), i)));
        let mut order: BinaryHeap<Reverse<(u64, usize)>> = order.collect();
        let nearest = std::iter::from_fn(|| order.pop().map(|Reverse((_, i))| i));
        let found = nearest.take(tries).find(|i| {
            tries -= 1;
            opens_to(&ring, *i, from) && borders.are_clear(from, ring[*i])
        });
        let Some(to) = found else {
            borders.drop_hole(number);
            continue;
        };
        borders.add_bridge(from, ring[to]);
        let around = (0..=hole.len()).map(|i| hole[(start + i) % hole.len()]);
        let mut bridge: Vec<DVec2> = around.collect();
        bridge.push(ring[to]);
        ring.splice(to + 1..to + 1, bridge);
    }
    ring
}

/// The sides of an outline, of its holes, and of the bridges between them.
struct Borders {
    sides: Vec<Side>,
    /// The index of the first sides; those behind them are looked at one by one.
    index: Grid,
    indexed: usize,
    is_dropped: Vec<bool>,
}

/// A side of a ring.
struct Side {
    from: DVec2,
    to: DVec2,
    /// The number of the hole; `None` for the outline and bridges.
    hole: Option<usize>,
}

impl Borders {
    fn new(outline: &[DVec2], holes: &[&Vec<DVec2>]) -> Borders {
        let mut sides = vec![];
        let mut add = |ring: &[DVec2], hole: Option<usize>| {
            let ends = ring.iter().zip(ring.iter().cycle().skip(1));
            sides.extend(ends.map(|(from, to)| Side {
                from: *from,
                to: *to,
                hole,
            }));
        };
        add(outline, None);
        holes
            .iter()
            .enumerate()
            .for_each(|(n, hole)| add(hole, Some(n)));
        let mut borders = Borders {
            sides,
            index: Grid::default(),
            indexed: 0,
            is_dropped: vec![false; holes.len()],
        };
        borders.index_many();
        borders
    }

    /// Indexes all sides as soon as many are not.
    fn index_many(&mut self) {
        if self.sides.len() - self.indexed > FEW.max(self.indexed / 8) {
            self.index = Grid::new(self.sides.iter().map(|s| around(s.from, s.to)).collect());
            self.indexed = self.sides.len();
        }
    }

    fn add_bridge(&mut self, from: DVec2, to: DVec2) {
        for (from, to) in [(from, to), (to, from)] {
            let hole = None;
            self.sides.push(Side { from, to, hole });
        }
        self.index_many();
    }

    /// Leaves the sides of a hole out of account.
    fn drop_hole(&mut self, number: usize) {
        self.is_dropped[number] = true;
    }

    /// Returns true if a bridge crosses nothing.
    fn are_clear(&self, from: DVec2, to: DVec2) -> bool {
        let crosses =
            |side: &Side| !side.hole.is_some_and(|n| self.is_dropped[n]) && side.crosses(from, to);
        let near = self.index.near(around(from, to));
        !near.iter().any(|n| crosses(&self.sides[*n as usize]))
            && !self.sides[self.indexed..].iter().any(crosses)
    }
}

impl Side {
    /// Returns true if a bridge crosses the side; one that ends in a corner of it does not.
    fn crosses(&self, from: DVec2, to: DVec2) -> bool {
        let (p, q) = (self.from, self.to);
        let touches = |s: DVec2| s == from || s == to;
        if touches(p) || touches(q) {
            return false;
        }
        let side = |a: DVec2, b: DVec2, c: DVec2| turn(a, b, c) >= 0.0;
        side(from, to, p) != side(from, to, q) && side(p, q, from) != side(p, q, to)
    }
}

fn around(p: DVec2, q: DVec2) -> Bounds {
    [p.min(q), p.max(q)]
}

/// Returns true if `from` lies within the angle of the ring's corner `i`, so that a bridge runs inside.
fn opens_to(ring: &[DVec2], i: usize, from: DVec2) -> bool {
    let n = ring.len();
    let (p, q, r) = (ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]);
    let (left_in, left_out) = (turn(p, q, from) > 0.0, turn(q, r, from) > 0.0);
    if turn(p, q, r) >= 0.0 {
        left_in && left_out
    } else {
        left_in || left_out
    }
}
