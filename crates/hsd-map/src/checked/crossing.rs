//! Finds rings that cross or touch themselves or each other.

use crate::feature::Area;
use glam::DVec2;
use hsd_base::geometry::grid::{Bounds, Grid};

/// A side of a ring.
struct Side {
    from: DVec2,
    to: DVec2,
    ring: usize,
    number: usize,
    /// The number of sides of its ring.
    count: usize,
}

/// Sides of a few are compared with each other, without an index.
const FEW: usize = 32;
/// The most pairs of sides whose boxes meet, on average for a side and at least. Coasts have some ten; of spikes that all point to
/// one place each meets all others.
const PAIRS: [usize; 2] = [256, 2_000_000];

/// Returns true if sides of an area cross, or lie on each other. Rings that only touch in a corner, as holes may touch the
/// outline, do not cross.
///
/// # Errors
/// The limit, if more pairs of sides would have to be compared.
pub(super) fn crosses(area: &Area) -> Result<bool, usize> {
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
    if sides.len() <= FEW {
        let meets_one_before = |(n, side): (usize, &Side)| sides[..n].iter().any(|o| side.meets(o));
        return Ok(sides.iter().enumerate().any(meets_one_before));
    }
    let index = Grid::new(sides.iter().map(Side::bounds).collect());
    let most = PAIRS[1].max(PAIRS[0] * sides.len());
    let mut left = most;
    for (side, n) in sides.iter().zip(0..) {
        let near = index.near_at_most(side.bounds(), left).ok_or(most)?;
        left -= near.len();
        let mut before = near.iter().take_while(|other| **other < n);
        if before.any(|other| side.meets(&sides[*other as usize])) {
            return Ok(true);
        }
    }
    Ok(false)
}

impl Side {
    fn bounds(&self) -> Bounds {
        [self.from.min(self.to), self.from.max(self.to)]
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::feature::Chain;
    use glam::dvec2;
    use hsd_base::rng::Place;
    use std::f64::consts::TAU;

    fn star(count: u32, radius: impl Fn(u32) -> f64) -> Area {
        let point = |n: u32| {
            let (sin, cos) = (f64::from(n) * TAU / f64::from(count)).sin_cos();
            dvec2(cos, sin) * radius(n)
        };
        Area {
            outline: Chain::flat((0..count).map(point).collect()),
            holes: vec![],
        }
    }

    #[test]
    fn large_rings_are_compared_as_small_ones_are() {
        for seed in 0..200 {
            let draw = |n: u32| Place::seed(seed).at(u64::from(n)).share();
            let mut area = star(120, |n| 10.0 + draw(n));
            assert_eq!(crosses(&area), Ok(false), "{seed}");
            let moved = (draw(200) * 120.0) as usize;
            area.outline.points[moved] *= -2.0;
            assert_eq!(crosses(&area), Ok(true), "{seed}");
        }
    }

    #[test]
    fn spikes_are_refused_before_all_are_compared() {
        let spikes = |count| star(count, |n| if n % 2 == 0 { 100.0 } else { 500.0 });
        assert_eq!(crosses(&spikes(1_000)), Ok(false));
        assert_eq!(crosses(&spikes(30_000)), Err(PAIRS[0] * 30_000));
    }
}
