//! Gaps in walls that should close: a wall or a corridor that ends a little before another house.

use glam::DVec2;
use hsd_base::geometry::SAME;
use hsd_ir::building::{House, Ring};

/// Shorter gaps are closed, longer ones are passages, metres.
const CLOSED: f64 = 0.05;
pub(super) const PASSAGE: f64 = 1.0;
/// The width of a house that is taken for a corridor, at most, metres; and its length in widths, at least.
const CORRIDOR: f64 = 2.0;
const SLENDER: f64 = 2.5;
/// The cosine of the angle between a wall and the gap before it, at least.
const AHEAD: f64 = 0.9;

/// An end of a wall or of a corridor.
#[derive(Clone, Copy, Debug)]
pub(super) struct WallEnd {
    /// Its place in the world, metres.
    pub(super) at: DVec2,
    /// The direction in which it would go on.
    pub(super) out: DVec2,
}

/// A gap before another house.
pub(super) struct Gap {
    pub(super) length: f64,
    /// The place where it ends.
    pub(super) to: DVec2,
    /// The number of that house.
    pub(super) other: u32,
}

/// Returns the ends of the walls of a house that encloses nothing, and of a corridor.
pub(super) fn ends(house: &House, rings: &[&Ring]) -> Box<[WallEnd]> {
    let mut ends = vec![];
    for ring in rings {
        let (Some(first), Some(last)) = (ring.walls.first(), ring.walls.last()) else {
            continue;
        };
        if ring.closed {
            ends.extend(corridor(house, ring).into_iter().flatten());
        } else if first.from.distance(last.to) > SAME {
            ends.push(WallEnd::new(house.world(first.to), house.world(first.from)));
            ends.push(WallEnd::new(house.world(last.from), house.world(last.to)));
        }
    }
    ends.into()
}

/// Returns the ends of a long narrow rectangle.
fn corridor(house: &House, ring: &Ring) -> Option<[WallEnd; 2]> {
    let corners: Vec<DVec2> = ring.corners().iter().map(|p| house.world(*p)).collect();
    let [a, b, c, d] = corners[..] else {
        return None;
    };
    let [one, two] = match a.distance(b) < b.distance(c) {
        true => [a.midpoint(b), c.midpoint(d)],
        false => [b.midpoint(c), d.midpoint(a)],
    };
    let width = a.distance(b).min(b.distance(c));
    let slender = width <= CORRIDOR && one.distance(two) >= SLENDER * width;
    slender.then(|| [WallEnd::new(two, one), WallEnd::new(one, two)])
}

impl WallEnd {
    fn new(before: DVec2, at: DVec2) -> WallEnd {
        WallEnd {
            at,
            out: (at - before).normalize_or_zero(),
        }
    }

    /// Returns the gap to the nearest of some houses, given by their numbers and walls, if there is one before it; none if it touches a house.
    pub(super) fn gap<W: Iterator<Item = [DVec2; 2]>>(
        self,
        others: impl Iterator<Item = (u32, W)>,
    ) -> Option<Gap> {
        let mut nearest: Option<Gap> = None;
        for (other, walls) in others {
            for [p, q] in walls {
                let along = q - p;
                let share =
                    (self.at - p).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
                let to = p + along * share.clamp(0.0, 1.0);
                let length = to.distance(self.at);
                if length < CLOSED {
                    return None;
                }
                let ahead = (to - self.at).dot(self.out) > AHEAD * length;
                if ahead && length < nearest.as_ref().map_or(PASSAGE, |n| n.length) {
                    nearest = Some(Gap { length, to, other });
                }
            }
        }
        nearest
    }

    /// Returns true if it is at a place.
    pub(super) fn is_at(self, place: DVec2) -> bool {
        self.at.distance(place) < CLOSED
    }
}
