//! Puts walls that stand nearly on one line on that line, so that no roof becomes a strip.

use super::square::{Axis, straighten};
use super::{Ring, are_simple, ends};

/// Lines nearer to each other become one where they may: no roof is narrower, metres.
pub const NARROWEST: f64 = 0.5;

/// A line, or several that became one.
#[derive(Clone, Copy)]
struct Line {
    low: f64,
    high: f64,
    /// The length of the walls on it, and the sum of their places weighted by it.
    length: f64,
    sum: f64,
}

impl Line {
    /// Returns where it lies: at the mean of its walls, but no farther than `most` from any.
    fn place(&self, most: f64) -> f64 {
        let (least, greatest) = (self.high - most, self.low + most);
        (self.sum / self.length).max(least).min(greatest)
    }

    fn with(self, other: Line) -> Line {
        Line {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            length: self.length + other.length,
            sum: self.sum + other.sum,
        }
    }
}

/// Joins the lines of squared rings, the outer ring first: walls move by `most` metres at most. Courts that vanish are
/// empty rings afterwards. Returns the farthest move; rings that would cross stay as they are.
pub fn join(rings: &mut Vec<Ring>, most: f64) -> f64 {
    let (mut joined, mut moved) = (rings.clone(), 0.0_f64);
    for axis in [Axis::X, Axis::Y] {
        let lines = lines(rings, axis);
        let places = united(&lines, most);
        for (ring, before) in joined.iter_mut().zip(rings.iter()) {
            for side in 0..before.len() {
                let (p, q) = ends(before, side);
                if Axis::of(q - p) != axis {
                    continue;
                }
                let was = axis.across(p);
                let Some(place) = places.iter().find(|l| l.low <= was && was <= l.high) else {
                    continue;
                };
                let now = place.place(most);
                moved = moved.max((now - was).abs());
                let next = (side + 1) % before.len();
                for corner in [side, next] {
                    ring[corner].from = axis.onto(ring[corner].from, now);
                }
            }
        }
    }
    if moved == 0.0 {
        return 0.0;
    }
    for ring in &mut joined {
        straighten(ring);
        if ring.len() < 4 {
            ring.clear();
        }
    }
    if joined[0].is_empty() || !are_simple(&joined) {
        return 0.0;
    }
    *rings = joined;
    moved
}

/// Returns the lines of all walls along an axis, in order.
fn lines(rings: &[Ring], axis: Axis) -> Vec<Line> {
    let mut lines: Vec<Line> = vec![];
    for ring in rings {
        for (p, q) in (0..ring.len()).map(|side| ends(ring, side)) {
            let (place, length) = (axis.across(p), p.distance(q));
            if Axis::of(q - p) == axis && length > 0.0 {
                lines.push(Line {
                    low: place,
                    high: place,
                    length,
                    sum: place * length,
                });
            }
        }
    }
    lines.sort_by(|one, two| one.low.total_cmp(&two.low));
    lines
}

/// Unites lines, the nearest first, while the place of one is within reach of all its walls.
fn united(lines: &[Line], most: f64) -> Vec<Line> {
    let mut lines = lines.to_vec();
    loop {
        let gap = |k: usize| -> Option<f64> {
            let (one, two) = (lines.get(k)?, lines.get(k + 1)?);
            let gap = two.place(most) - one.place(most);
            let fits =
                gap < NARROWEST && two.high.max(one.high) - one.low.min(two.low) <= 2.0 * most;
            fits.then_some(gap)
        };
        let gaps: Vec<Option<f64>> = (0..lines.len()).map(gap).collect();
        let is_least = |k: usize| {
            let Some(own) = gaps[k] else { return false };
            let before = k.checked_sub(1).and_then(|b| gaps[b]);
            let after = gaps.get(k + 1).copied().flatten();
            before.is_none_or(|b| own < b) && after.is_none_or(|a| own <= a)
        };
        let mut next: Vec<Line> = Vec::with_capacity(lines.len());
        let mut k = 0;
        while k < lines.len() {
            if is_least(k) {
                next.push(lines[k].with(lines[k + 1]));
                k += 2;
            } else {
                next.push(lines[k]);
                k += 1;
            }
        }
        if next.len() == lines.len() {
            return lines;
        }
        lines = next;
    }
}
