//! Removes what a survey holds by accident: doubled points, spikes, corners within a straight wall.

use super::{Ring, Side};
use glam::DVec2;

/// Points nearer to each other, or to the line of their neighbours, are no corners: a centimetre.
pub const NEAR: f64 = 0.01;

/// What was removed from a ring.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Removed {
    /// Points that stand on another one.
    pub doubled: usize,
    /// Points to which a wall goes and from which it comes back.
    pub spikes: usize,
}

/// Returns the sides of a ring of points; `marks` says what stands on each. Fewer than three sides are none.
pub fn clean(points: &[DVec2], marks: &[u32]) -> (Ring, Removed) {
    let sides = points.iter().zip(marks).enumerate();
    let mut ring: Ring = sides
        .map(|(number, (from, mark))| Side {
            from: *from,
            corner: number,
            number,
            mark: *mark,
        })
        .collect();
    let mut removed = Removed::default();
    if ring.len() > 1 && ring[0].from == ring[ring.len() - 1].from {
        ring.pop(); // the ring was closed by a copy of its first point
    }
    loop {
        let before = ring.len();
        removed.doubled += drop_where(&mut ring, |[_, here, next], _| {
            here.from.distance(next.from) < NEAR
        });
        removed.spikes += drop_where(&mut ring, |[last, here, next], _| {
            is_spike(last.from, here.from, next.from)
        });
        if ring.len() == before {
            break;
        }
    }
    drop_where(&mut ring, |[last, here, next], _| {
        last.mark == here.mark && is_straight(last.from, here.from, next.from)
    });
    if ring.len() < 3 {
        ring.clear();
    }
    (ring, removed)
}

/// Removes corners one after another; the side before takes the place of the one that began there. Returns how many.
pub(super) fn drop_where(ring: &mut Ring, is_needless: impl Fn([Side; 3], usize) -> bool) -> usize {
    let before = ring.len();
    let mut k = 0;
    while k < ring.len() && ring.len() > 2 {
        let n = ring.len();
        let around = [ring[(k + n - 1) % n], ring[k], ring[(k + 1) % n]];
        if !is_needless(around, k) {
            k += 1;
            continue;
        }
        let [last, here, next] = around;
        // The longer of two sides lends its number.
        if last.from.distance(here.from) < here.from.distance(next.from) {
            let side = &mut ring[(k + n - 1) % n];
            (side.number, side.mark) = (here.number, here.mark);
        }
        ring.remove(k);
        k = k.saturating_sub(1);
    }
    before - ring.len()
}

fn is_spike(last: DVec2, here: DVec2, next: DVec2) -> bool {
    let (to, from) = (here - last, next - here);
    if to.dot(from) >= 0.0 {
        return false;
    }
    // How far the shorter arm stands off the longer one.
    let off = to.perp_dot(from).abs() / to.length().max(from.length());
    off < NEAR
}

fn is_straight(last: DVec2, here: DVec2, next: DVec2) -> bool {
    let chord = next - last;
    (here - last).dot(next - here) > 0.0
        && chord.perp_dot(here - last).abs() < NEAR * chord.length()
}
