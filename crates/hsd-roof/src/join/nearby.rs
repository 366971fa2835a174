//! A search tree for the rectangles that overlap a given one; each node is split at the middle of its
//! longer side.

use crate::frame::Rect;

/// Nodes with no more rectangles are searched linearly.
const LEAF: usize = 8;

/// A tree over rectangles.
#[derive(Clone, Debug)]
pub(crate) struct Nearby {
    rects: Vec<Rect>,
    /// The indices in the order of the tree: each node is a range of it.
    order: Vec<usize>,
    /// The bounds of the nodes, in preorder.
    bounds: Vec<Rect>,
}

impl Nearby {
    pub(crate) fn new(rects: Vec<Rect>) -> Nearby {
        let order: Vec<usize> = (0..rects.len()).collect();
        let mut tree = Nearby {
            rects,
            order,
            bounds: vec![],
        };
        let count = tree.order.len();
        if count > 0 {
            tree.grow(0, count);
        }
        tree
    }

    fn grow(&mut self, from: usize, to: usize) {
        let rects = &self.rects;
        let part = &mut self.order[from..to];
        let all = part.iter().map(|i| rects[*i]);
        let Some(bounds) = all.reduce(|r, s| Rect {
            min: r.min.min(s.min),
            max: r.max.max(s.max),
        }) else {
            return;
        };
        self.bounds.push(bounds);
        if to - from <= LEAF {
            return;
        }
        // By midpoints, so that a stack of long strips is split across their length.
        let spread = |axis: usize| {
            let middle = |i: &usize| rects[*i].min[axis] + rects[*i].max[axis];
            let (lo, hi) = part
                .iter()
                .map(middle)
                .fold((f64::MAX, f64::MIN), |(l, h), m| (l.min(m), h.max(m)));
            hi - lo
        };
        let axis = usize::from(spread(1) > spread(0));
        let middle = |i: &usize| rects[*i].min[axis] + rects[*i].max[axis];
        let half = part.len() / 2;
        part.select_nth_unstable_by(half, |i, j| middle(i).total_cmp(&middle(j)).then(i.cmp(j)));
        self.grow(from, from + half);
        self.grow(from + half, to);
    }

    /// Returns the rectangles that share more than a border with `of`, ascending.
    pub(crate) fn overlapping(&self, of: &Rect) -> Vec<usize> {
        let mut found = Vec::new();
        if !self.order.is_empty() {
            self.collect(of, 0, (0, self.order.len()), &mut found);
        }
        found.sort_unstable();
        found
    }

    /// Visits one node; returns the number of the node after its last one.
    fn collect(
        &self,
        of: &Rect,
        node: usize,
        (from, to): (usize, usize),
        found: &mut Vec<usize>,
    ) -> usize {
        if to - from <= LEAF {
            let part = self.order[from..to].iter();
            found.extend(part.filter(|i| self.rects[**i].overlaps(of)));
            return node + 1;
        }
        if !self.bounds[node].overlaps(of) {
            return node + nodes(to - from);
        }
        let half = from + (to - from) / 2;
        let next = self.collect(of, node + 1, (from, half), found);
        self.collect(of, next, (half, to), found)
    }
}

/// Returns the number of nodes of a tree over this many rectangles.
fn nodes(count: usize) -> usize {
    if count <= LEAF {
        1
    } else {
        1 + nodes(count / 2) + nodes(count - count / 2)
    }
}

#[cfg(test)]
mod tests {
    use crate::join::nearby::*;
    use glam::dvec2;

    #[test]
    fn the_tree_finds_what_looking_at_all_finds() {
        let mut state = 5u64;
        let mut draw = |n: u64| {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            ((state >> 33) % n) as f64
        };
        let rects: Vec<Rect> = (0..500)
            .map(|_| {
                let min = dvec2(draw(100), draw(100));
                Rect {
                    min,
                    max: min + dvec2(1.0 + draw(30), 1.0 + draw(9)),
                }
            })
            .collect();
        let tree = Nearby::new(rects.clone());
        for of in rects.iter().take(100) {
            let all: Vec<usize> = (0..rects.len())
                .filter(|i| rects[*i].overlaps(of))
                .collect();
            assert_eq!(tree.overlapping(of), all);
        }
        assert!(Nearby::new(vec![]).overlapping(&rects[0]).is_empty());
    }
}
