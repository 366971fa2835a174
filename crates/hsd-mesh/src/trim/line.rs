//! Polylines on a roof: lengths along them, sections across them.

use glam::{DVec2, DVec3};

/// A line with at least two points, metres.
#[derive(Clone, Debug)]
pub(super) struct Line {
    pub(super) points: Vec<DVec3>,
}

impl Line {
    /// Returns its length, metres.
    pub(super) fn length(&self) -> f64 {
        self.points.windows(2).map(|w| w[0].distance(w[1])).sum()
    }

    /// Returns the point at a distance along it; extrapolates beyond its ends.
    pub(super) fn at(&self, distance: f64) -> DVec3 {
        let mut left = distance;
        let pieces = self.points.len() - 1;
        for (i, w) in self.points.windows(2).enumerate() {
            let length = w[0].distance(w[1]);
            if left <= length || i + 1 == pieces {
                return w[0] + (w[1] - w[0]).normalize_or_zero() * left;
            }
            left -= length;
        }
        self.points[0]
    }

    /// Returns the horizontal direction at right angles to the line at corner `i`, to its left.
    pub(super) fn across(&self, i: usize) -> DVec3 {
        let last = self.points.len() - 1;
        let (before, after) = (self.points[i.max(1) - 1], self.points[(i + 1).min(last)]);
        level_left(after - before).extend(0.0)
    }

    /// Returns vertical sections at all corners of a profile of (to the left, up).
    pub(super) fn sections(&self, profile: &[(f64, f64)]) -> Vec<Vec<DVec3>> {
        let section = |i: usize| -> Vec<DVec3> {
            let (at, across) = (self.points[i], self.across(i));
            let corner = |(w, z): &(f64, f64)| at + across * *w + DVec3::Z * *z;
            profile.iter().map(corner).collect()
        };
        (0..self.points.len()).map(section).collect()
    }

    /// Returns the line extended by `by` metres at both ends.
    pub(super) fn longer(&self, by: f64) -> Line {
        let mut line = self.clone();
        let last = line.points.len() - 1;
        for (at, back) in [(0, 1), (last, last - 1)] {
            let out = self.points[at] - self.points[back];
            line.points[at] += out.normalize_or_zero() * by;
        }
        line
    }

    /// Returns the part between two distances.
    pub(super) fn part(&self, from: f64, to: f64) -> Line {
        let mut points = vec![self.at(from)];
        let mut run = 0.0;
        for w in self.points.windows(2) {
            run += w[0].distance(w[1]);
            if run > from + 1e-6 && run < to - 1e-6 {
                points.push(w[1]);
            }
        }
        points.push(self.at(to));
        Line { points }
    }
}

/// Returns the direction to the left of a direction in plan, unit length.
pub(super) fn level_left(way: DVec3) -> DVec2 {
    way.truncate().perp().normalize_or_zero()
}
