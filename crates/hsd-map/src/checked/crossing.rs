//! Finds rings that cross or touch themselves or each other.

use crate::feature::Area;
use glam::DVec2;

/// A side of a ring.
struct Side {
    from: DVec2,
    to: DVec2,
    ring: usize,
    number: usize,
    /// The number of sides of its ring.
    count: usize,
}

/// Returns true if sides of an area cross, or lie on each other. Rings that only touch in a corner, as holes may touch the
/// outline, do not cross.
///
/// Sides are compared with those that overlap them from west to east, so that long coasts take no more than
/// their breadth demands.
pub(super) fn crosses(area: &Area) -> bool {
    let mut sides: Vec<Side> = vec![];
    for (ring, chain) in area.rings().enumerate() {
        let count = chain.points.len();
        for (number, from) in chain.points.iter().enumerate() {
            sides.push(Side {
                from: *from,
                to: chain.points[(number + 1) % count],
                ring,
                number,
                count,
            });
        }
    }
    sides.sort_by(|p, q| p.west().total_cmp(&q.west()));
    let mut open: Vec<&Side> = vec![];
    for side in &sides {
        open.retain(|other| other.east() >= side.west());
        if open.iter().any(|other| side.meets(other)) {
            return true;
        }
        open.push(side);
    }
    false
}

impl Side {
    fn west(&self) -> f64 {
        self.from.x.min(self.to.x)
    }

    fn east(&self) -> f64 {
        self.from.x.max(self.to.x)
    }

    fn is_beside(&self, other: &Side) -> bool {
        let apart = self.number.abs_diff(other.number);
        self.ring == other.ring && (apart == 1 || apart + 1 == self.count)
    }

    fn meets(&self, other: &Side) -> bool {
        let (p, q) = (self.to - self.from, other.to - other.from);
        if self.is_beside(other) {
            // Neighbours lie on each other if one goes back.
            return p.perp_dot(q) == 0.0 && p.dot(q) < 0.0;
        }
        let high = self.from.y.max(self.to.y);
        let low = self.from.y.min(self.to.y);
        if high < other.from.y.min(other.to.y) || low > other.from.y.max(other.to.y) {
            return false;
        }
        let ends = |of: &Side| [of.from, of.to];
        let sides = ends(other).map(|r| p.perp_dot(r - self.from));
        let others = ends(self).map(|r| q.perp_dot(r - other.from));
        let divides = |s: [f64; 2]| (s[0] < 0.0 && s[1] > 0.0) || (s[0] > 0.0 && s[1] < 0.0);
        if divides(sides) && divides(others) {
            return true;
        }
        // On one line and side by side.
        let on_line = sides == [0.0, 0.0];
        let along = |r: DVec2| p.dot(r - self.from);
        let [a, b] = ends(other).map(along);
        on_line && a.max(b) > 0.0 && a.min(b) < p.length_squared()
    }
}
