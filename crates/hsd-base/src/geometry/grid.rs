//! A spatial index: boxes in a packed tree (sort-tile-recursive, Leutenegger et al. 1997). A query takes time for what it finds,
//! wherever the boxes are: all at one place, or one of them as wide as the town. What it finds comes in the order in which it
//! was added, so that nothing depends on the index.

use glam::DVec2;
use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

/// The number of children of a node.
const CHILDREN: usize = 16;

/// A box: its low and high corner.
pub type Bounds = [DVec2; 2];

/// An index of boxes by their numbers.
#[derive(Debug, Default)]
pub struct Grid {
    bounds: Vec<Bounds>,
    /// The numbers of the boxes, in the order of the leaves.
    order: Vec<u32>,
    /// The nodes of each level, from the leaves to the root. A node holds [`CHILDREN`] of the level below it.
    levels: Vec<Vec<GridNode>>,
}

/// A node of the tree.
#[derive(Clone, Copy, Debug)]
struct GridNode {
    bounds: Bounds,
    /// The box of the middles of the boxes in it.
    middles: Bounds,
    /// The least number of the boxes in it.
    least: u32,
}

/// A node or a box that a search for the nearest boxes has yet to look at. The order is that of distances, then of the distances
/// of middles, then of numbers: boxes that all meet are ordered by place too.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    distance: f64,
    of_middle: f64,
    least: u32,
    /// The level above that of the node; 0 for a box.
    level: usize,
    /// The index on its level.
    at: usize,
}

impl Ord for Waiting {
    fn cmp(&self, other: &Waiting) -> Ordering {
        let place = |own: &Waiting| (own.least, own.level, own.at);
        let by_distance = self.distance.total_cmp(&other.distance);
        by_distance
            .then(self.of_middle.total_cmp(&other.of_middle))
            .then_with(|| place(self).cmp(&place(other)))
    }
}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Waiting) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Waiting {
    fn eq(&self, other: &Waiting) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Waiting {}

impl Grid {
    /// Creates the index of boxes, which are numbered in their order.
    pub fn new(bounds: Vec<Bounds>) -> Grid {
        let order = tiled(&bounds);
        let leaves: Vec<GridNode> = order
            .iter()
            .map(|n| GridNode {
                bounds: bounds[*n as usize],
                middles: [middle(bounds[*n as usize]); 2],
                least: *n,
            })
            .collect();
        let mut levels = vec![];
        let mut below = around_each(&leaves);
        while below.len() > 1 {
            let above = around_each(&below);
            levels.push(below);
            below = above;
        }
        levels.push(below);
        Grid {
            bounds,
            order,
            levels,
        }
    }

    /// Returns the numbers of the boxes that meet a box, ascending.
    pub fn near(&self, bounds: Bounds) -> Vec<u32> {
        let mut found = vec![];
        self.collect(bounds, usize::MAX, &mut found);
        found.sort_unstable();
        found
    }

    /// Returns the numbers of the boxes that meet a box, ascending; `None` if they are more than `most`.
    pub fn near_at_most(&self, bounds: Bounds, most: usize) -> Option<Vec<u32>> {
        let mut found = vec![];
        let is_all = self.collect(bounds, most, &mut found);
        found.sort_unstable();
        is_all.then_some(found)
    }

    /// Returns the numbers of the boxes within a distance of a box on both axes, ascending. At most `most` are returned, so the
    /// time is bounded where everything is at one place. Those are the nearest boxes; among equals those with the nearest middles,
    /// then those with the least numbers.
    pub fn nearest(&self, to: Bounds, far: f64, most: usize) -> Vec<u32> {
        let mut found = vec![];
        if !self.collect(wider(to, far), most, &mut found) {
            found = self.by_distance(to, far, most);
        }
        found.sort_unstable();
        found
    }

    /// Collects the numbers of the boxes that meet a box; returns false as soon as there are more than `most`.
    fn collect(&self, bounds: Bounds, most: usize, found: &mut Vec<u32>) -> bool {
        let top = self.levels.len();
        let mut open: Vec<(usize, usize)> = (top > 0).then_some((top, 0)).into_iter().collect();
        while let Some((level, at)) = open.pop() {
            for child in self.children(level, at) {
                if !meet(self.box_of(level - 1, child), bounds) {
                    continue;
                }
                match level {
                    1 => found.push(self.order[child]),
                    _ => open.push((level - 1, child)),
                }
                if found.len() > most {
                    return false;
                }
            }
        }
        true
    }

    /// Returns the nearest boxes to a box, the nearest first.
    fn by_distance(&self, to: Bounds, far: f64, most: usize) -> Vec<u32> {
        let within = wider(to, far);
        let from = [middle(to); 2];
        let waiting = |level: usize, at: usize| {
            let bounds = self.box_of(level, at);
            meet(bounds, within).then(|| {
                let (middles, least) = match level {
                    0 => ([middle(bounds); 2], self.order[at]),
                    _ => {
                        let node = &self.levels[level - 1][at];
                        (node.middles, node.least)
                    }
                };
                Waiting {
                    distance: gap(bounds, to),
                    of_middle: gap(middles, from),
                    least,
                    level,
                    at,
                }
            })
        };
        let root = waiting(self.levels.len(), 0);
        let mut open: BinaryHeap<Reverse<Waiting>> = root.map(Reverse).into_iter().collect();
        let mut found = vec![];
        while found.len() < most
            && let Some(Reverse(next)) = open.pop()
        {
            match next.level {
                0 => found.push(next.least),
                level => {
                    let children = self.children(level, next.at);
                    open.extend(
                        children
                            .filter_map(|at| waiting(level - 1, at))
                            .map(Reverse),
                    );
                }
            }
        }
        found
    }

    /// Returns the indices of the children of a node on the level below it.
    fn children(&self, level: usize, at: usize) -> std::ops::Range<usize> {
        let below = match level {
            1 => self.order.len(),
            _ => self.levels[level - 2].len(),
        };
        at * CHILDREN..((at + 1) * CHILDREN).min(below)
    }

    /// Returns the box of a node; of level 0 are the boxes themselves.
    fn box_of(&self, level: usize, at: usize) -> Bounds {
        match level {
            0 => self.bounds[self.order[at] as usize],
            _ => self.levels[level - 1][at].bounds,
        }
    }
}

/// Returns the numbers of boxes in an order in which those that follow each other are near each other.
fn tiled(bounds: &[Bounds]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..bounds.len() as u32).collect();
    let middle = |n: u32| middle(bounds[n as usize]);
    order.sort_by(|a, b| middle(*a).x.total_cmp(&middle(*b).x));
    let leaves = bounds.len().div_ceil(CHILDREN);
    let columns = leaves.isqrt().max(1);
    let column = leaves.div_ceil(columns).max(1) * CHILDREN;
    for column in order.chunks_mut(column) {
        column.sort_by(|a, b| middle(*a).y.total_cmp(&middle(*b).y));
    }
    order
}

/// Returns the nodes of the level above some nodes.
fn around_each(nodes: &[GridNode]) -> Vec<GridNode> {
    let both = |[a, b]: Bounds, [c, d]: Bounds| [a.min(c), b.max(d)];
    let around = |a: GridNode, b: &GridNode| GridNode {
        bounds: both(a.bounds, b.bounds),
        middles: both(a.middles, b.middles),
        least: a.least.min(b.least),
    };
    let chunks = nodes.chunks(CHILDREN);
    chunks
        .map(|chunk| chunk.iter().fold(chunk[0], around))
        .collect()
}

/// Returns the middle of a box.
fn middle([low, high]: Bounds) -> DVec2 {
    low.midpoint(high)
}

/// Returns the distance between two boxes.
fn gap([a, b]: Bounds, [c, d]: Bounds) -> f64 {
    (c - b).max(a - d).max(DVec2::ZERO).length()
}

/// Returns the box of points; `None` for none.
pub fn bounds(points: impl IntoIterator<Item = DVec2>) -> Option<Bounds> {
    let mut points = points.into_iter();
    let first = points.next()?;
    Some(points.fold([first; 2], |[low, high], p| [low.min(p), high.max(p)]))
}

/// Returns a box that reaches farther on all sides.
pub fn wider([low, high]: Bounds, by: f64) -> Bounds {
    [low - DVec2::splat(by), high + DVec2::splat(by)]
}

/// Returns true if two boxes have a place in common.
pub fn meet([a, b]: Bounds, [c, d]: Bounds) -> bool {
    a.cmple(d).all() && c.cmple(b).all()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Place;

    /// Returns boxes strewn over a square: many small ones, some of them equal, and a few as wide as all.
    fn strewn(count: u64, side: f64) -> Vec<Bounds> {
        let draw = |n: u64, what: &str| Place::seed(n).named(what).share();
        let one = |n: u64| {
            let low = DVec2::new(draw(n / 3, "x"), draw(n / 3, "y")) * side;
            let wide = if n.is_multiple_of(50) { side } else { 5.0 };
            [low, low + DVec2::new(draw(n, "w"), draw(n, "h")) * wide]
        };
        (0..count).map(one).collect()
    }

    #[test]
    fn finds_what_meets_a_box() {
        for count in [0, 1, 15, 16, 17, 300, 5000] {
            let all = strewn(count, 300.0);
            let index = Grid::new(all.clone());
            for asked in strewn(40, 300.0) {
                let found = index.near(asked);
                let wanted = (0..).zip(&all).filter(|(_, own)| meet(**own, asked));
                let wanted: Vec<u32> = wanted.map(|(n, _)| n).collect();
                assert_eq!(found, wanted, "{count}");
            }
        }
    }

    #[test]
    fn finds_the_nearest_of_too_many() {
        let all = strewn(2000, 100.0);
        let index = Grid::new(all.clone());
        for asked in strewn(40, 100.0) {
            let within = wider(asked, 20.0);
            let mut wanted: Vec<u32> = index.near(within);
            let far = |n: &u32| gap(all[*n as usize], asked);
            let off = |n: &u32| middle(all[*n as usize]).distance(middle(asked));
            wanted.sort_by(|a, b| {
                let by_distance = far(a).total_cmp(&far(b));
                by_distance.then(off(a).total_cmp(&off(b))).then(a.cmp(b))
            });
            wanted.truncate(64);
            wanted.sort_unstable();
            assert_eq!(index.nearest(asked, 20.0, 64), wanted);
        }
    }
}
