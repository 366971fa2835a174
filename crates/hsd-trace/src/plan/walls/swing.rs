//! Swinging doors: an open leaf, or the arc of its edge.

use super::bars::Bar;
use super::mask::Strokes;
use std::f64::consts::FRAC_PI_2;

/// The share of the bins of a quarter of a circle in which a swinging door is drawn.
const SWINGS: f64 = 0.7;
/// The bins of a quarter of a circle, and how much of it is looked at: the ends are at walls.
const BINS: usize = 9;
/// The radii of a door's arc, in the width of its opening.
const ARC: [f64; 2] = [0.82, 1.12];
/// The greatest distance of an arc from its radius, in the width of its opening.
const SWAYS: f64 = 0.03;
/// The part of the radius that is looked at within the arc, and the share of it that may be drawn.
const CLEAR: f64 = 0.75;
const EMPTY: f64 = 0.3;
/// The narrowest and widest door, as shares of the plan's diagonal.
const SHARES: [f64; 2] = [0.03, 0.14];
/// The directions of a leaf without an arc, as shares of a right angle. Along and across a wall other lines run too.
const LEAF: [f64; 2] = [0.28, 0.78];
/// The part of a leaf that is checked, in the width of its opening, and the least share of it that is drawn.
const LENGTH: [f64; 2] = [0.12, 0.8];
const DRAWN: f64 = 0.92;
/// The length beyond which a leaf does not extend, in the width of its opening.
const END: f64 = 1.25;

/// One of the four quarters of a circle into which a door opens.
struct Quarter<'a> {
    strokes: &'a Strokes,
    upright: bool,
    /// The hinge, along and across the wall.
    hinge: [f64; 2],
    /// The direction to the other jamb, and that into the room: 1 or -1.
    ahead: f64,
    side: f64,
    /// The width of the opening.
    width: f64,
}

/// Returns true if a leaf or its arc is drawn at one of the ends of an opening; `diagonal` is that of the plan.
pub(super) fn swings(strokes: &Strokes, bar: &Bar, diagonal: f64) -> bool {
    let width = (bar.along[1] - bar.along[0] + 1) as f64;
    let [least, most] = SHARES.map(|share| share * diagonal);
    if width < least || width > most {
        return false;
    }
    let line = (bar.across[0] + bar.across[1]) as f64 / 2.0;
    let ends = [(bar.along[0] as f64, 1.0), (bar.along[1] as f64, -1.0)];
    ends.into_iter().any(|(hinge, ahead)| {
        [-1.0, 1.0].into_iter().any(|side| {
            let quarter = Quarter {
                strokes,
                upright: bar.upright,
                hinge: [hinge, line],
                ahead,
                side,
                width,
            };
            quarter.is_empty() && (quarter.has_arc() || quarter.has_leaf())
        })
    })
}

impl Quarter<'_> {
    /// Returns the direction at an angle from the wall, radians: along it and across.
    fn direction(&self, angle: f64) -> [f64; 2] {
        [self.ahead * libm::cos(angle), self.side * libm::sin(angle)]
    }

    /// Returns true if a thin stroke runs through a place: its direction and its distance from the hinge, pixels.
    fn is_inked(&self, [ahead, side]: [f64; 2], radius: f64) -> bool {
        self.is_inked_at(
            self.hinge[0] + ahead * radius,
            self.hinge[1] + side * radius,
        )
    }

    fn is_inked_at(&self, along: f64, across: f64) -> bool {
        let (x, y) = match self.upright {
            true => (across, along),
            false => (along, across),
        };
        let (x, y) = (x.round() as isize, y.round() as isize);
        let ink = self.strokes.thickness.get(x, y);
        ink.is_some_and(|t| t > 0.0 && f64::from(t) < self.strokes.wall)
    }

    /// Returns true if a stroke keeps to one distance from the hinge.
    fn has_arc(&self) -> bool {
        let angles = (0..BINS).map(|k| (k as f64 + 1.0) / (BINS as f64 + 1.0) * FRAC_PI_2);
        let directions: Vec<_> = angles.map(|angle| self.direction(angle)).collect();
        let sways = (SWAYS * self.width).max(1.5) as i32;
        let drawn = |radius: f64| {
            let near = |direction: [f64; 2]| {
                let mut around = -sways..=sways;
                around.any(|off| self.is_inked(direction, radius + f64::from(off)))
            };
            let drawn = directions.iter().filter(|direction| near(**direction));
            drawn.count() as f64 >= SWINGS * BINS as f64
        };
        let steps = ((ARC[1] - ARC[0]) * self.width).ceil() as usize;
        (0..=steps).any(|n| drawn(self.width * ARC[0] + n as f64))
    }

    /// Returns true if a line runs aslant from the hinge, about as long as the opening is wide.
    fn has_leaf(&self) -> bool {
        let steps = (FRAC_PI_2 * self.width).ceil().max(1.0);
        let from = (LEAF[0] * steps) as usize;
        let to = (LEAF[1] * steps) as usize;
        let [near, far] = LENGTH.map(|l| (l * self.width) as usize);
        let drawn = |direction: [f64; 2]| {
            let at = (near..=far).filter(|r| self.is_inked(direction, *r as f64));
            at.count() as f64 >= DRAWN * (far + 1 - near) as f64
        };
        let ends = |direction: [f64; 2]| {
            let beyond = (END * self.width) as usize;
            !(beyond..beyond + 3).any(|r| self.is_inked(direction, r as f64))
        };
        let angles = (from..=to).map(|k| k as f64 / steps * FRAC_PI_2);
        let mut directions = angles.map(|angle| self.direction(angle));
        directions.any(|direction| drawn(direction) && ends(direction))
    }

    /// Returns true if next to nothing is drawn within the arc.
    fn is_empty(&self) -> bool {
        let cells = (0..BINS * BINS).map(|k| (k / BINS + 1, k % BINS + 1));
        let unit = self.width * CLEAR / BINS as f64;
        let cells = cells.filter(|(a, b)| a * a + b * b < BINS * BINS);
        let all = cells.clone().count();
        let drawn = cells.filter(|(a, b)| {
            let along = self.hinge[0] + self.ahead * unit * *a as f64;
            self.is_inked_at(along, self.hinge[1] + self.side * unit * *b as f64)
        });
        (drawn.count() as f64) < EMPTY * all as f64
    }
}
