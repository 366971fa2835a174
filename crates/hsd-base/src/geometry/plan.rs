//! Regions of a plan on exact integers: one rectangle ([`Cell`]) and any orthogonal region
//! ([`Plan`]) with the set operations the roofs need.
//!
//! Frame: author frame, a to the left along the first line, b back into the plot; any exact
//! grid (normally quarter units). All operations are exact and never panic.

pub mod raster;
pub mod slabs;

use crate::geometry::plan::raster::Raster;

/// An axis-parallel rectangle, `a0 < a1` and `b0 < b1`, in grid steps of the author frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Cell {
    /// Least a (the right-hand side seen from the street).
    pub a0: i64,
    /// Least b (the front).
    pub b0: i64,
    /// Greatest a (the left-hand side seen from the street).
    pub a1: i64,
    /// Greatest b (the back).
    pub b1: i64,
}

impl Cell {
    /// Returns the extent along a, in grid steps.
    pub fn width(&self) -> i64 {
        self.a1.saturating_sub(self.a0)
    }

    /// Returns the extent along b, in grid steps.
    pub fn depth(&self) -> i64 {
        self.b1.saturating_sub(self.b0)
    }

    /// Returns the area in square grid steps.
    pub fn area(&self) -> i128 {
        i128::from(self.width()) * i128::from(self.depth())
    }

    /// Returns true if `other` lies inside this cell, borders included.
    pub fn contains(&self, other: &Cell) -> bool {
        self.a0 <= other.a0 && other.a1 <= self.a1 && self.b0 <= other.b0 && other.b1 <= self.b1
    }

    /// Returns true if the two share area, not merely a border.
    pub fn overlaps(&self, other: &Cell) -> bool {
        self.a0 < other.a1 && other.a0 < self.a1 && self.b0 < other.b1 && other.b0 < self.b1
    }

    /// Returns the four corners in walk order (interior on the right), from the least (a, b).
    pub fn corners(&self) -> [(i64, i64); 4] {
        [
            (self.a0, self.b0),
            (self.a1, self.b0),
            (self.a1, self.b1),
            (self.a0, self.b1),
        ]
    }

    /// Returns the sorting key of regions: (b0, a0, b1, a1), `docs/contract.md` 4.
    pub fn key(&self) -> (i64, i64, i64, i64) {
        (self.b0, self.a0, self.b1, self.a1)
    }
}

/// A region bounded by axis-parallel closed loops, even-odd: outer loops and holes alike, perhaps several disjoint
/// pieces. The last corner joins the first; corners in mid-wall and any starting corner or direction are allowed, and
/// so are coincident edges, which cancel.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Plan {
    /// The loops, in grid steps of the author frame.
    pub loops: Vec<Vec<(i64, i64)>>,
}

impl Plan {
    /// Creates the region bounded by these loops.
    pub fn from_loops(loops: Vec<Vec<(i64, i64)>>) -> Self {
        Self { loops }
    }

    /// Returns the union of cells that do not overlap each other (others count even-odd).
    pub fn from_cells(cells: &[Cell]) -> Self {
        Self {
            loops: cells.iter().map(|c| c.corners().to_vec()).collect(),
        }
    }

    /// Returns every edge of every loop, as written.
    pub fn edges(&self) -> impl Iterator<Item = ((i64, i64), (i64, i64))> + '_ {
        self.loops
            .iter()
            .flat_map(|l| (0..l.len()).map(move |i| (l[i], l[(i + 1) % l.len()])))
    }

    /// Returns the number of corners of its loops, as written.
    pub fn corners(&self) -> usize {
        self.loops.iter().map(Vec::len).sum()
    }

    /// Returns true if every edge is parallel to an axis.
    pub fn is_orthogonal(&self) -> bool {
        self.edges().all(|(p, q)| p.0 == q.0 || p.1 == q.1)
    }

    /// Returns the plan as one cell, if it is written as a single loop of four corners.
    pub fn as_cell(&self) -> Option<Cell> {
        let [only] = self.loops.as_slice() else {
            return None;
        };
        let &[p, q, r, s] = only.as_slice() else {
            return None;
        };
        let round = (p.1 == q.1 && q.0 == r.0 && r.1 == s.1 && s.0 == p.0)
            || (p.0 == q.0 && q.1 == r.1 && r.0 == s.0 && s.1 == p.1);
        let cell = Cell {
            a0: p.0.min(r.0),
            b0: p.1.min(r.1),
            a1: p.0.max(r.0),
            b1: p.1.max(r.1),
        };
        (round && cell.a0 < cell.a1 && cell.b0 < cell.b1).then_some(cell)
    }

    /// Returns true if this region overlaid with `other` is within the intended size of the methods: at most
    /// 2^20 fields between the distinct coordinates of both. Beyond that all results are
    /// still exact, but slow where many coordinates cross (a comb over a comb has as many pieces as
    /// fields), and `partition` only makes strips: callers report it instead.
    pub fn fits(&self, other: Option<&Plan>) -> bool {
        match other {
            Some(other) => Raster::joint(&[self, other]).is_some(),
            None => Raster::joint(&[self]).is_some(),
        }
    }

    /// Returns the part of this region outside `other`, exactly: P_k minus P_{k+1} (domain 3.8).
    pub fn difference(&self, other: &Plan) -> Plan {
        self.combine(other, |mine, theirs| mine && !theirs)
    }

    /// Returns the union of this region and `other`.
    pub fn union(&self, other: &Plan) -> Plan {
        self.combine(other, |mine, theirs| mine || theirs)
    }

    /// Returns the part that this region and `other` share.
    pub fn intersection(&self, other: &Plan) -> Plan {
        self.combine(other, |mine, theirs| mine && theirs)
    }

    /// Returns this region without some cells, which may overlap each other.
    pub fn minus_cells(&self, cells: &[Cell]) -> Plan {
        let covering = Plan::from_cells(cells);
        let Some(mut raster) = Raster::joint(&[self, &covering]) else {
            let sum = |sum: Plan, c: &Cell| sum.union(&Plan::from_cells(&[*c]));
            return self.difference(&cells.iter().fold(Plan::default(), sum));
        };
        let (mine, covered) = (raster.fill(self), raster.covered(cells));
        let open = mine.iter().zip(&covered).map(|(m, c)| *m && !c);
        raster.inside = open.collect();
        Plan {
            loops: raster.loops(),
        }
    }

    /// Returns true if the two regions share area, not merely walls.
    pub fn intersects(&self, other: &Plan) -> bool {
        !self.intersection(other).loops.is_empty()
    }

    /// Returns true if the region has no area.
    pub fn is_empty(&self) -> bool {
        self.as_cell().is_none() && slabs::strips(self).is_empty()
    }

    /// Returns the area in square grid steps, saturating.
    pub fn area(&self) -> i128 {
        slabs::strips(self)
            .iter()
            .fold(0i128, |sum, c| sum.saturating_add(c.area()))
    }

    /// Returns the region in clean loops: corners only, no coincident edges, outer loops walked with the interior on
    /// the right from their least (b, a) corner, holes the other way.
    pub fn clean(&self) -> Plan {
        self.combine(&Plan::default(), |mine, _| mine)
    }

    /// Returns the 4-connected pieces: joined along walls, not at corners alone, in the order of their least (b, a)
    /// corner.
    pub fn components(&self) -> Vec<Plan> {
        let Some(mut raster) = Raster::of(self) else {
            return vec![self.clone()];
        };
        let all = raster.inside.clone();
        let (labels, count) = label(&all, raster.cols());
        (1..=count)
            .map(|n| {
                raster.inside = labels.iter().map(|&l| l == n).collect();
                Plan {
                    loops: raster.loops(),
                }
            })
            .collect()
    }

    /// Returns the distinct coordinates (a's, b's) of the region's walls, ascending.
    pub fn coordinates(&self) -> (Vec<i64>, Vec<i64>) {
        Raster::of(self).map_or_else(
            || {
                let sorted = |mut v: Vec<i64>| {
                    v.sort_unstable();
                    v.dedup();
                    v
                };
                let corners = || self.loops.iter().flatten();
                (
                    sorted(corners().map(|p| p.0).collect()),
                    sorted(corners().map(|p| p.1).collect()),
                )
            },
            |r| (r.a.source, r.b.source),
        )
    }

    fn combine(&self, other: &Plan, keep: fn(bool, bool) -> bool) -> Plan {
        let Some(mut raster) = Raster::joint(&[self, other]) else {
            return Plan::from_cells(&slabs::combine(self, other, keep));
        };
        let (mine, theirs) = (raster.fill(self), raster.fill(other));
        raster.inside = mine
            .iter()
            .zip(&theirs)
            .map(|(&m, &t)| keep(m, t))
            .collect();
        Plan {
            loops: raster.loops(),
        }
    }
}

/// Numbers the 4-connected pieces of the true fields from 1; returns the numbers and their count.
fn label(inside: &[bool], cols: usize) -> (Vec<u32>, u32) {
    let mut labels = vec![0u32; inside.len()];
    let mut count = 0;
    let mut stack = Vec::new();
    for start in 0..inside.len() {
        if !inside[start] || labels[start] != 0 {
            continue;
        }
        count += 1;
        stack.push(start);
        while let Some(n) = stack.pop() {
            if !inside[n] || labels[n] != 0 {
                continue;
            }
            labels[n] = count;
            let i = n % cols;
            stack.extend((i > 0).then(|| n - 1));
            stack.extend((i + 1 < cols).then_some(n + 1));
            stack.extend((n >= cols).then(|| n - cols));
            stack.extend((n + cols < inside.len()).then_some(n + cols));
        }
    }
    (labels, count)
}

#[cfg(test)]
mod tests {
    use crate::geometry::plan::*;

    fn cell(a0: i64, b0: i64, a1: i64, b1: i64) -> Cell {
        Cell { a0, b0, a1, b1 }
    }

    #[test]
    fn difference_leaves_the_strip_and_the_ring() {
        let ground = Plan::from_cells(&[cell(0, 0, 10, 8)]);
        let rear = ground.difference(&Plan::from_cells(&[cell(0, 0, 10, 5)]));
        assert_eq!(rear.loops, vec![vec![(0, 5), (10, 5), (10, 8), (0, 8)]]);
        let ring = ground.difference(&Plan::from_cells(&[cell(2, 2, 8, 6)]));
        assert_eq!(ring.loops.len(), 2);
        assert_eq!(ring.area(), 80 - 24);
        assert_eq!(ring.loops[1], vec![(2, 2), (2, 6), (8, 6), (8, 2)]);
    }

    #[test]
    fn touching_corners_stay_two_pieces() {
        let two = Plan::from_cells(&[cell(0, 0, 2, 2), cell(2, 2, 4, 4)]);
        assert_eq!(two.clean().loops.len(), 2);
        assert_eq!(two.components().len(), 2);
        let one = Plan::from_cells(&[cell(0, 0, 2, 2), cell(2, 0, 4, 4)]);
        assert_eq!(one.components().len(), 1);
        assert_eq!(
            one.clean().loops,
            vec![vec![(0, 0), (4, 0), (4, 4), (2, 4), (2, 2), (0, 2)]]
        );
    }

    #[test]
    fn empty_and_degenerate_plans_are_empty() {
        for loops in [
            vec![],
            vec![vec![]],
            vec![vec![(0, 0)]],
            vec![vec![(0, 0), (4, 0)]],
        ] {
            let plan = Plan::from_loops(loops);
            assert!(plan.is_empty());
            assert!(plan.components().is_empty());
            assert_eq!(plan.area(), 0);
        }
    }

    #[test]
    fn overlapping_cells_are_taken_off_once() {
        let plan = Plan::from_cells(&[cell(0, 0, 10, 10)]);
        let rest = plan.minus_cells(&[cell(0, 0, 6, 6), cell(4, 4, 10, 10)]);
        assert_eq!(rest.area(), 100 - 36 - 36 + 4);
    }
}
