//! The houses round an outline: what touches it, how far it is to them, what stands in the way.

use super::shape::{Segment, contains, sides};
use glam::DVec2;
use hsd_base::geometry::grid::{bounds, wider};

/// Outlines that are drawn apart by so much count as touching, metres.
pub const TOUCHING: f64 = 0.6;
/// The distance of the places at which a wall is looked at, metres.
const STEP: f64 = 0.3;

/// The outlines of the houses round one.
#[derive(Clone, Debug)]
pub struct Neighbours<'t> {
    /// Their rings.
    pub rings: Vec<&'t [DVec2]>,
}

impl Neighbours<'_> {
    /// Returns the length of a wall that is free of neighbours.
    pub fn free_length(&self, wall: Segment) -> f64 {
        let length = wall.length();
        let near = self.near(wall, TOUCHING);
        if near.is_empty() {
            return length;
        }
        let steps = (length / STEP).ceil().max(1.0) as usize;
        let mut is_taken = vec![false; steps];
        for ring in near {
            let (from, to) = within(wall, ring, TOUCHING);
            // Shares have an error; a place more on either side is as good as none.
            let first = ((from * steps as f64 - 1.5).max(0.0) as usize).min(steps);
            let end = ((to * steps as f64 + 1.5).max(0.0) as usize).min(steps);
            for (n, is_taken) in (first..end).zip(&mut is_taken[first..]) {
                let at = wall.from.lerp(wall.to, (n as f64 + 0.5) / steps as f64);
                *is_taken = *is_taken || is_within(ring, at, TOUCHING);
            }
        }
        let free = is_taken.iter().filter(|is_taken| !**is_taken).count();
        free as f64 * length / steps as f64
    }

    /// Returns the free way before the middle of a wall, at most `most`.
    pub fn free_way(&self, wall: Segment, most: f64) -> f64 {
        let from = wall.middle() + wall.normal() * 0.05;
        let way = Segment::new(from, from + wall.normal() * most);
        let mut free = most;
        for side in self.rings.iter().flat_map(|ring| sides(ring)) {
            if side.meets(way) {
                let (d, e) = (way.to - way.from, side.to - side.from);
                let cross = d.perp_dot(e);
                let share = match cross.abs() > 1e-12 {
                    true => (side.from - way.from).perp_dot(e) / cross,
                    false => 0.0,
                };
                free = free.min(most * share.clamp(0.0, 1.0));
            }
        }
        free
    }

    /// Returns true if nothing stands between two places.
    pub fn is_free(&self, way: Segment) -> bool {
        let [low, high] = way.bounds();
        self.rings.iter().all(|ring| {
            let beside = |f: fn(DVec2) -> f64, least: f64, most: f64| {
                ring.iter().all(|p| f(*p) < least) || ring.iter().all(|p| f(*p) > most)
            };
            beside(|p| p.x, low.x, high.x)
                || beside(|p| p.y, low.y, high.y)
                || !sides(ring).any(|side| side.meets(way))
        })
    }

    /// Returns true if a neighbour stands along more than half of a wall.
    pub fn is_party(&self, wall: Segment) -> bool {
        self.free_length(wall) < wall.length() / 2.0
    }

    /// Returns the distance of the nearest neighbour from a wall, at most `most`; those behind it do not count.
    pub fn distance(&self, wall: Segment, most: f64) -> f64 {
        let normal = wall.normal();
        let outside = |side: &Segment| {
            [side.from, side.to]
                .iter()
                .any(|p| (*p - wall.from).dot(normal) > -TOUCHING)
        };
        let all = self.near(wall, most);
        let all = all.iter().flat_map(|ring| sides(ring)).filter(outside);
        all.map(|side| side.distance(wall)).fold(most, f64::min)
    }

    /// Returns the outlines within a distance of a wall.
    fn near(&self, wall: Segment, far: f64) -> Vec<&[DVec2]> {
        let [low, high] = wider(wall.bounds(), far);
        let near = self.rings.iter().filter(|ring| {
            let meets = |f: fn(DVec2) -> f64, least: f64, most: f64| {
                ring.iter().any(|p| f(*p) >= least) && ring.iter().any(|p| f(*p) <= most)
            };
            meets(|p| p.x, low.x, high.x) && meets(|p| p.y, low.y, high.y)
        });
        near.copied().collect()
    }
}

/// Returns the shares of a wall between which it is in the bounds of a ring widened by a distance.
fn within(wall: Segment, ring: &[DVec2], far: f64) -> (f64, f64) {
    let Some(bounds) = bounds(ring.iter().copied()) else {
        return (0.0, 0.0);
    };
    let ends = wider(bounds, far);
    let way = wall.to - wall.from;
    let (mut from, mut to) = (0.0, 1.0);
    for axis in 0..2 {
        // Across the axis, `near` has compared the bounds.
        if way[axis].abs() > 1e-9 {
            let shares = ends.map(|end| (end[axis] - wall.from[axis]) / way[axis]);
            from = f64::max(from, shares[0].min(shares[1]));
            to = f64::min(to, shares[0].max(shares[1]));
        }
    }
    (from, to)
}

/// Returns true if a place lies in a ring or within a distance of it.
fn is_within(ring: &[DVec2], p: DVec2, far: f64) -> bool {
    sides(ring).any(|s| s.nearest(p).distance(p) <= far) || contains(ring, p)
}
