//! Puts walls that stand nearly on one line on that line, so that no roof becomes a strip.

use super::square::{Axis, straighten};
use super::{Ring, are_simple, ends};
use glam::DVec2;

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

/// Joins the lines of squared rings, the outer ring first: walls move by `most` metres at most. Slanting walls of partly
/// squared rings are on no line; their ends move with their neighbours. Courtyards that vanish are empty rings afterwards.
/// Returns the farthest move. Lines stay apart if walls would cross or touch otherwise.
pub fn join(rings: &mut Vec<Ring>, most: f64) -> f64 {
    let mut farthest = 0.0_f64;
    let mut keep = |made: Option<(Vec<Ring>, f64)>, rings: &mut Vec<Ring>| match made {
        Some((made, moved)) => {
            *rings = made;
            farthest = farthest.max(moved);
            true
        }
        None => false,
    };
    for axis in [Axis::X, Axis::Y] {
        let mut lines = united(&lines(rings, axis), most);
        lines.retain(|line| line.low < line.high);
        // Where not all lines can be joined, each is tried alone.
        if !keep(moved(rings, axis, &lines, most), rings) {
            for line in &lines {
                keep(moved(rings, axis, &[*line], most), rings);
            }
        }
    }
    farthest
}

/// Returns rings whose walls on some lines stand at the place of each, and the farthest move; nothing if walls would meet.
fn moved(rings: &[Ring], axis: Axis, lines: &[Line], most: f64) -> Option<(Vec<Ring>, f64)> {
    let mut made = rings.to_vec();
    let mut farthest = 0.0_f64;
    for (ring, before) in made.iter_mut().zip(rings) {
        for side in 0..before.len() {
            let (p, q) = ends(before, side);
            let was = axis.across(p);
            let line = lines.iter().find(|l| l.low <= was && was <= l.high);
            let Some(line) = line.filter(|_| is_along(axis, p, q)) else {
                continue;
            };
            let now = line.place(most);
            farthest = farthest.max((now - was).abs());
            for corner in [side, (side + 1) % before.len()] {
                ring[corner].from = axis.onto(ring[corner].from, now);
            }
        }
        straighten(ring);
        if ring.len() < 4 {
            ring.clear();
        }
    }
    let stands = made.first().is_some_and(|outer| !outer.is_empty());
    (stands && are_simple(&made)).then_some((made, farthest))
}

/// Returns true if a wall is parallel to an axis.
fn is_along(axis: Axis, p: DVec2, q: DVec2) -> bool {
    axis.across(p) == axis.across(q)
}

/// Returns the lines of all walls along an axis, in order.
fn lines(rings: &[Ring], axis: Axis) -> Vec<Line> {
    let mut lines: Vec<Line> = vec![];
    for ring in rings {
        for (p, q) in (0..ring.len()).map(|side| ends(ring, side)) {
            let (place, length) = (axis.across(p), p.distance(q));
            if is_along(axis, p, q) && length > 0.0 {
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
