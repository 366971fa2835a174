//! The ground that is left of a lot behind its house. Local frame: s metres to the right along the front as seen from the
//! street, t metres into the lot behind it.

use crate::plot::Rectangle;
use crate::shape::{Segment, area, shared, sides};
use glam::DVec2;
use hsd_base::geometry::grid::bounds;

/// The area that a house may share with what it must not meet, square metres: what numbers lose.
const NOTHING: f64 = 0.01;
/// The distance of the lines at which the width of a lot is measured, metres.
const STEP: f64 = 0.5;

/// A rectangle along the front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Local {
    /// From left to right, metres.
    pub(super) s: [f64; 2],
    /// From the street to the back, metres.
    pub(super) t: [f64; 2],
}

/// The side of a house that is its front.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Facing {
    /// Towards the street.
    Street,
    /// Towards the left as seen from the street.
    Left,
    /// Towards the right.
    Right,
}

/// How far the roof of a house reaches over its walls, metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Eaves {
    /// Over the front and the back.
    pub(super) along: f64,
    /// Over the ends.
    pub(super) across: f64,
}

/// The ground of a lot.
pub(super) struct Ground<'g> {
    origin: DVec2,
    right: DVec2,
    inward: DVec2,
    ring: &'g [DVec2],
    holes: &'g [Vec<DVec2>],
    /// The outlines round the lot.
    others: &'g [&'g [DVec2]],
    /// The corners of its ring in the local frame.
    local: Vec<DVec2>,
    /// Houses with their roofs.
    taken: Vec<[DVec2; 4]>,
    /// Alleys.
    clear: Vec<[DVec2; 4]>,
    /// The houses on the front: from left to right, and how far back they reach, metres.
    pub(super) houses: Local,
    /// Its depth behind the front, metres.
    pub(super) depth: f64,
}

impl<'g> Ground<'g> {
    /// Creates the ground of a lot on whose front houses stand, one at least, and others behind them.
    pub(super) fn new(
        (ring, holes): (&'g [DVec2], &'g [Vec<DVec2>]),
        others: &'g [&'g [DVec2]],
        houses: &[Rectangle],
        behind: &[Rectangle],
    ) -> Ground<'g> {
        let front = houses[0].front;
        let mut ground = Ground {
            origin: front.from,
            right: front.direction(),
            inward: -front.normal(),
            ring,
            holes,
            others,
            local: vec![],
            taken: houses
                .iter()
                .chain(behind)
                .map(Rectangle::corners)
                .collect(),
            clear: vec![],
            houses: Local {
                s: [0.0, 0.0],
                t: [0.0, 0.0],
            },
            depth: 0.0,
        };
        ground.local = ring.iter().map(|p| ground.local_of(*p)).collect();
        ground.depth = ground.local.iter().map(|p| p.y).fold(0.0, f64::max);
        let corners = houses.iter().flat_map(Rectangle::corners);
        let corners: Vec<DVec2> = corners.map(|p| ground.local_of(p)).collect();
        let at = &mut ground.houses;
        for p in corners {
            at.s = [at.s[0].min(p.x), at.s[1].max(p.x)];
            at.t = [at.t[0].min(p.y), at.t[1].max(p.y)];
        }
        ground
    }

    fn local_of(&self, p: DVec2) -> DVec2 {
        let from = p - self.origin;
        DVec2::new(from.dot(self.right), from.dot(self.inward))
    }

    fn place_of(&self, s: f64, t: f64) -> DVec2 {
        self.origin + self.right * s + self.inward * t
    }

    fn corners(&self, of: Local) -> [DVec2; 4] {
        let ([s0, s1], [t0, t1]) = (of.s, of.t);
        [(s0, t0), (s1, t0), (s1, t1), (s0, t1)].map(|(s, t)| self.place_of(s, t))
    }

    /// Returns a rectangle with its front.
    pub(super) fn rectangle(&self, of: Local, facing: Facing) -> Rectangle {
        let ([s0, s1], [t0, t1]) = (of.s, of.t);
        let (from, to, depth) = match facing {
            Facing::Street => ((s0, t0), (s1, t0), t1 - t0),
            Facing::Left => ((s0, t1), (s0, t0), s1 - s0),
            Facing::Right => ((s1, t0), (s1, t1), s1 - s0),
        };
        Rectangle {
            front: Segment::new(self.place_of(from.0, from.1), self.place_of(to.0, to.1)),
            depth,
        }
    }

    /// Returns the width of the lot from one depth to another: the greatest left and the least right; `None` if nothing is.
    pub(super) fn room(&self, [from, to]: [f64; 2]) -> Option<[f64; 2]> {
        let steps = ((to - from) / STEP).ceil().max(1.0) as usize;
        let mut room = [f64::NEG_INFINITY, f64::INFINITY];
        for step in 0..=steps {
            // A line through a corner is ambiguous, one a hair beside it is not.
            let share = (step as f64 / steps as f64).clamp(1e-6, 1.0 - 1e-6);
            let [left, right] = self.width(from + (to - from) * share)?;
            room = [room[0].max(left), room[1].min(right)];
        }
        (room[0] < room[1]).then_some(room)
    }

    /// Returns the longest piece of a line across the lot that lies in it.
    fn width(&self, t: f64) -> Option<[f64; 2]> {
        let crossing = |side: Segment| {
            let (p, q) = (side.from, side.to);
            ((p.y > t) != (q.y > t)).then(|| p.x + (t - p.y) / (q.y - p.y) * (q.x - p.x))
        };
        let mut at: Vec<f64> = sides(&self.local).filter_map(crossing).collect();
        at.sort_by(f64::total_cmp);
        let pieces = at.chunks_exact(2).map(|ends| [ends[0], ends[1]]);
        pieces.max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))
    }

    /// Takes the place of a house if it lies in the lot with its roof, meets no other, and leaves the alleys.
    pub(super) fn take(&mut self, walls: Local, facing: Facing, eaves: Eaves) -> Option<Rectangle> {
        let (s, t) = match facing {
            Facing::Street => (eaves.across, eaves.along),
            Facing::Left | Facing::Right => (eaves.along, eaves.across),
        };
        let whole = self.corners(Local {
            s: [walls.s[0] - s, walls.s[1] + s],
            t: [walls.t[0] - t, walls.t[1] + t],
        });
        let own = self.corners(walls);
        if !self.holds(&whole) || self.clear.iter().any(|alley| meets(&own, alley)) {
            return None;
        }
        self.taken.push(whole);
        Some(self.rectangle(walls, facing))
    }

    /// Returns true if a rectangle lies in the lot and meets no house.
    fn holds(&self, whole: &[DVec2; 4]) -> bool {
        let outside = area(whole, &[]) - shared(whole, self.ring);
        outside <= NOTHING
            && !self.holes.iter().any(|hole| meets(whole, hole))
            && !self.others.iter().any(|other| meets(whole, other))
            && !self.taken.iter().any(|house| meets(whole, house))
    }

    /// Keeps an alley clear of walls.
    pub(super) fn keep_clear(&mut self, alley: Local) {
        let corners = self.corners(alley);
        self.clear.push(corners);
    }

    /// Finds a place for a house of a size that faces the street, from one depth to another: as far back as there is one, at
    /// the left or right edge, or between them.
    pub(super) fn place(
        &mut self,
        [width, depth]: [f64; 2],
        [from, to]: [f64; 2],
        eaves: Eaves,
        right_first: bool,
    ) -> Option<Rectangle> {
        const BACK: f64 = 0.25;
        let mut t1 = to - eaves.along;
        while t1 - depth - eaves.along >= from - 1e-9 {
            let whole = [t1 - depth - eaves.along, t1 + eaves.along];
            if let Some([left, right]) = self.room(whole) {
                let (left, right) = (left + eaves.across, right - eaves.across - width);
                let mut at = [left, right, left.midpoint(right)];
                if right_first {
                    at.swap(0, 1);
                }
                for s in at
                    .into_iter()
                    .filter(|s| (left - 1e-9..=right + 1e-9).contains(s))
                {
                    let walls = Local {
                        s: [s, s + width],
                        t: [t1 - depth, t1],
                    };
                    if let Some(found) = self.take(walls, Facing::Street, eaves) {
                        return Some(found);
                    }
                }
            }
            t1 -= BACK;
        }
        None
    }
}

/// Returns true if a rectangle shares ground with a ring.
fn meets(whole: &[DVec2; 4], ring: &[DVec2]) -> bool {
    let boxes = bounds(whole.iter().copied()).zip(bounds(ring.iter().copied()));
    boxes.is_some_and(|([low, high], [from, to])| low.cmple(to).all() && from.cmple(high).all())
        && shared(whole, ring) > NOTHING
}
