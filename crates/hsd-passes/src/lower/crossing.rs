//! Checks that no walls of a storey cross or touch (C4), within or between rings, and that every courtyard lies in a
//! house.
//!
//! A sweep along a. Walls across the sweep (all of them in an orthogonal plan) are kept in a tree by b, so that a plan
//! with a hundred thousand walls costs a hundred thousand look-ups; oblique walls are compared with every wall under
//! the sweep, which is fast enough for the few dozen of a round tower.

use crate::messages::plan;
use glam::DVec2;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::geometry::{SAME, steps};
use hsd_ir::building::Ring;
use std::collections::BTreeSet;

/// The maximum number of comparisons of oblique walls; a plan needs a few thousand.
const MOST_COMPARISONS: usize = 20_000_000;

/// Up to this many walls are compared pair by pair first: nearly always none of them meet, and nothing has to be sorted.
const FEW: usize = 16;

#[derive(Clone, Copy)]
struct Segment {
    ring: usize,
    wall: usize,
    low: (i64, i64),
    high: (i64, i64),
}

/// Reports the first crossing; the rings concerned count as open afterwards.
pub(super) fn check(rings: &mut [Ring], out: &mut Diagnostics) {
    let segments = segments(rings);
    let oblique = segments
        .iter()
        .any(|s| s.low.0 != s.high.0 && s.low.1 != s.high.1);
    let hit = if oblique {
        oblique_hit(rings, &segments)
    } else {
        square_hit(rings, &segments)
    };
    if let Some((one, two)) = hit {
        let (w1, w2) = (
            &rings[one.ring].walls[one.wall],
            &rings[two.ring].walls[two.wall],
        );
        let crossing = properly_cross(w1.from, w1.to, w2.from, w2.to);
        let (first, second) = if w1.span.start <= w2.span.start {
            (w1, w2)
        } else {
            (w2, w1)
        };
        let of = meeting(one.ring == two.ring, &rings[one.ring], &rings[two.ring]);
        out.push(plan::walls_meet(second.span, first.span, crossing, of));
        rings[one.ring].closed = false;
        rings[two.ring].closed = false;
        return;
    }
    if rings.len() > 1 {
        check_nesting(rings, out);
    }
}

fn meeting(same: bool, one: &Ring, two: &Ring) -> plan::Meeting {
    match (same, one.hole, two.hole) {
        (true, ..) => plan::Meeting::Itself,
        (_, true, true) => plan::Meeting::Courtyards,
        (_, false, false) => plan::Meeting::Outlines,
        _ => plan::Meeting::Courtyard,
    }
}

fn segments(rings: &[Ring]) -> Vec<Segment> {
    let mut segments = vec![];
    for (ring, r) in rings.iter().enumerate().filter(|(_, r)| r.closed) {
        for (wall, w) in r.walls.iter().enumerate() {
            let (p, q) = (
                (steps(w.from.x), steps(w.from.y)),
                (steps(w.to.x), steps(w.to.y)),
            );
            segments.push(Segment {
                ring,
                wall,
                low: p.min(q),
                high: p.max(q),
            });
        }
    }
    segments
}

/// Returns true for neighbours, which may share a corner; if the walk continues straight they share no more than that.
fn neighbours(rings: &[Ring], one: &Segment, two: &Segment) -> bool {
    let n = rings[one.ring].walls.len();
    one.ring == two.ring && ((one.wall + 1) % n == two.wall || (two.wall + 1) % n == one.wall)
}

/// Returns true if no two walls meet but neighbours.
fn are_apart(rings: &[Ring], segments: &[Segment]) -> bool {
    let apart = |s: &Segment, o: &Segment| {
        let (below, above) = (s.high.1 < o.low.1, o.high.1 < s.low.1);
        s.high.0 < o.low.0 || o.high.0 < s.low.0 || below || above
    };
    let fits = |(i, s)| {
        let mut before = segments[..i].iter();
        before.all(|o| apart(s, o) || neighbours(rings, s, o))
    };
    segments.iter().enumerate().all(fits)
}

/// Finds a crossing at right angles, in integer steps: touching is exact.
fn square_hit(rings: &[Ring], segments: &[Segment]) -> Option<(Segment, Segment)> {
    if segments.len() <= FEW && are_apart(rings, segments) {
        return None;
    }
    // (a, what, b, segment): walls along a begin before walls along b are looked up, and end after.
    let mut events = Vec::with_capacity(segments.len() * 2);
    for (i, s) in segments.iter().enumerate() {
        if s.low.0 == s.high.0 {
            events.push((s.low.0, 1, s.low.1, i));
        } else {
            events.push((s.low.0, 0, s.low.1, i));
            events.push((s.high.0, 2, s.low.1, i));
        }
    }
    events.sort_unstable();
    let mut open: BTreeSet<(i64, usize)> = BTreeSet::new();
    let mut stack = Stack::default();
    for (_, what, _, i) in events {
        let s = &segments[i];
        let met = match what {
            0 => {
                let met = first_other(rings, segments, &open, s);
                open.insert((s.low.1, i));
                met
            }
            1 => stack
                .meet(rings, s)
                .or_else(|| first_other(rings, segments, &open, s)),
            _ => {
                open.remove(&(s.low.1, i));
                None
            }
        };
        if let Some(other) = met {
            return Some((other, *s));
        }
    }
    None
}

/// The last walls along b at the current a, which come in the order of b: a wall that meets any of
/// them meets one of the last two, since at most one of those is its neighbour.
#[derive(Default)]
struct Stack(Option<Segment>, Option<Segment>);

impl Stack {
    fn meet(&mut self, rings: &[Ring], s: &Segment) -> Option<Segment> {
        let met = [self.0, self.1]
            .into_iter()
            .flatten()
            .find(|o| o.low.0 == s.low.0 && s.low.1 <= o.high.1 && !neighbours(rings, s, o));
        *self = Stack(self.1, Some(*s));
        met
    }
}

/// Returns a wall under the sweep that meets `s` and is not its neighbour.
fn first_other(
    rings: &[Ring],
    segments: &[Segment],
    open: &BTreeSet<(i64, usize)>,
    s: &Segment,
) -> Option<Segment> {
    let range = open.range((s.low.1, 0)..=(s.high.1, usize::MAX));
    range
        .map(|&(_, j)| segments[j])
        .find(|o| !neighbours(rings, s, o))
}

/// Finds a crossing at any angles.
fn oblique_hit(rings: &[Ring], segments: &[Segment]) -> Option<(Segment, Segment)> {
    let mut order: Vec<&Segment> = segments.iter().collect();
    order.sort_by_key(|s| (s.low, s.high, s.ring, s.wall));
    let mut under: Vec<&Segment> = vec![];
    let mut compared = 0;
    for s in order {
        under.retain(|o| o.high.0 >= s.low.0);
        compared += under.len();
        if compared > MOST_COMPARISONS {
            return None;
        }
        for o in &under {
            if !neighbours(rings, s, o) && distance(rings, s, o) < SAME {
                return Some((**o, *s));
            }
        }
        under.push(s);
    }
    None
}

/// Returns the distance of two walls in U, 0 if they cross.
fn distance(rings: &[Ring], one: &Segment, two: &Segment) -> f64 {
    let (w1, w2) = (
        &rings[one.ring].walls[one.wall],
        &rings[two.ring].walls[two.wall],
    );
    if properly_cross(w1.from, w1.to, w2.from, w2.to) {
        return 0.0;
    }
    let to = |p: DVec2, a: DVec2, b: DVec2| {
        let along = (p - a).dot(b - a) / (b - a).length_squared();
        p.distance(a + (b - a) * along.clamp(0.0, 1.0))
    };
    let one_to_two = to(w1.from, w2.from, w2.to).min(to(w1.to, w2.from, w2.to));
    one_to_two
        .min(to(w2.from, w1.from, w1.to))
        .min(to(w2.to, w1.from, w1.to))
}

fn properly_cross(p: DVec2, q: DVec2, r: DVec2, s: DVec2) -> bool {
    let side = |a: DVec2, b: DVec2, c: DVec2| (b - a).perp_dot(c - a);
    side(p, q, r) * side(p, q, s) < 0.0 && side(r, s, p) * side(r, s, q) < 0.0
}

/// Checks that courtyards lie in an outer ring, and that outer rings lie side by side.
fn check_nesting(rings: &mut [Ring], out: &mut Diagnostics) {
    // Bounds are compared first: a thousand courtyards have a million pairs.
    let boxes: Vec<(DVec2, DVec2)> = rings.iter().map(bounds).collect();
    let about = |j: usize, p: DVec2| p.cmpge(boxes[j].0).all() && p.cmple(boxes[j].1).all();
    for i in 0..rings.len() {
        if !rings[i].closed {
            continue;
        }
        let probe = rings[i].walls[0].from;
        let outer = rings
            .iter()
            .enumerate()
            .filter(|(j, r)| *j != i && about(*j, probe) && r.closed && !r.hole);
        let around = outer.filter(|(_, r)| surrounds(r, probe)).count();
        if rings[i].hole && around == 0 {
            out.push(plan::hole_outside(rings[i].span));
            rings[i].closed = false;
        } else if !rings[i].hole && around > 0 {
            out.push(plan::loop_inside(rings[i].span));
            rings[i].closed = false;
        }
    }
}

/// Returns the least and the greatest coordinates of a ring.
fn bounds(ring: &Ring) -> (DVec2, DVec2) {
    let corners = ring.walls.iter().map(|w| w.from);
    corners.fold((DVec2::MAX, DVec2::MIN), |(lo, hi), p| {
        (lo.min(p), hi.max(p))
    })
}

fn surrounds(ring: &Ring, p: DVec2) -> bool {
    let crossed = ring.walls.iter().filter(|w| {
        let (a, b) = (w.from, w.to);
        (a.y <= p.y) != (b.y <= p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
    });
    crossed.count() % 2 == 1
}
