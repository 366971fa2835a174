//! The ends of a two-sloped roof: a treatment at each end of its ridge.
//!
//! For each distance d inward from the eaves side's wall line a treatment gives two values: the start of the main
//! slopes, and the distance inward at which the end's own slope reaches the same height ([`End::contour`]). If the two
//! are equal the slopes share a hip. Distances along the ridge count inward from the end's wall line.

use crate::shape::look::Look;
use hsd_ir::ast::RoofShape;

/// The position of an irimoya's gable and the height of a half-hip, shares of the span (docs/evidence.md 6).
const GABLE_AT: f64 = 0.25;
const HALF_HIP: f64 = 0.2;
/// The steepest end slope.
const STEEPEST: f64 = 5.0;

/// The treatment of an end.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Cap {
    /// The slopes extend over a gable wall, or into the roof or wall there.
    #[default]
    Gable,
    /// A third slope from the eaves to the ridge, which starts `run` metres in.
    Hip {
        /// Run of the slope, metres.
        run: f64,
    },
    /// A third slope up to a gable wall `wall` metres in; the upper gable projects by `verge`.
    HipAndGable {
        /// Distance inward of the gable wall, metres.
        wall: f64,
        /// Overhang of the upper gable, metres.
        verge: f64,
    },
    /// A gable whose top is cut by a slope of `run` metres.
    HalfHip {
        /// Run of the slope, metres.
        run: f64,
    },
}

/// One end of a two-sloped roof.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct End {
    /// Length beyond its wall rectangle, inside the roof it joins, metres.
    pub reach: f64,
    /// The distance inward from which it does so, where it is above the walls of the roof it joins.
    pub from: f64,
    /// Overhang beyond that, metres.
    pub verge: f64,
    /// True if the end has a gable wall.
    pub wall: bool,
    /// The treatment; always a gable for ends that continue into another roof.
    pub cap: Cap,
    /// True for each corner, at v = 0 and at v = depth, that is free and thus raised by sori.
    pub rises: [bool; 2],
}

impl Cap {
    /// Returns the treatment that a shape gives to the free ends of a roof `length` metres long over a half span;
    /// `both` = its other end is treated as well.
    pub fn of(look: &Look, length: f64, half: f64, both: bool) -> Cap {
        let room = if both { length / 2.0 } else { length };
        let share = |usual: f64| look.gable.unwrap_or(usual) * 2.0 * half.min(length / 2.0);
        match look.shape {
            RoofShape::Mansard => Cap::Hip {
                run: half.min(room),
            },
            RoofShape::Hip | RoofShape::Pyramid => {
                let wish = look.ratio.map_or(half, |r| length * (1.0 - r) / 2.0);
                let least = half * look.pitch / STEEPEST;
                Cap::Hip {
                    run: wish.max(least).min(room),
                }
            }
            RoofShape::HipAndGable | RoofShape::Temple => {
                let wall = share(GABLE_AT);
                if wall > 0.98 * half.min(room) {
                    let run = half.min(room);
                    return Cap::Hip { run };
                }
                match wall < 0.1 {
                    true => Cap::Gable,
                    false => Cap::HipAndGable {
                        wall,
                        verge: look.barge.clamp(0.02, 0.6 * wall),
                    },
                }
            }
            RoofShape::HalfHip => match share(HALF_HIP).min(0.9 * half.min(room)) {
                run if run < 0.1 => Cap::Gable,
                run => Cap::HalfHip { run },
            },
            _ => Cap::Gable,
        }
    }

    /// Returns true if the end has its own eaves, with corners.
    pub fn has_corners(self) -> bool {
        matches!(self, Cap::Hip { .. } | Cap::HipAndGable { .. })
    }
}

impl End {
    /// Returns for each of its corners whether it is raised.
    pub fn raised(&self) -> [bool; 2] {
        self.rises.map(|r| r && self.cap.has_corners())
    }

    /// Returns the start of the main slopes at both distances of a strip, verges included.
    pub fn start(&self, strip: [f64; 2], half: f64) -> [f64; 2] {
        match self.cap {
            Cap::Gable if self.reach > 0.0 && !self.runs_on(strip) => [0.0; 2],
            Cap::Gable => [-self.reach - self.verge; 2],
            Cap::Hip { run } => strip.map(|d| d * run / half),
            Cap::HipAndGable { wall, verge } => strip.map(|d| d.min(wall - verge)),
            Cap::HalfHip { run } => strip.map(|d| (d - half + run).max(-self.verge)),
        }
    }

    /// Returns the start of the main slopes without verges.
    pub fn body(&self, strip: [f64; 2], half: f64) -> [f64; 2] {
        match self.cap {
            Cap::Gable if !self.runs_on(strip) => [0.0; 2],
            Cap::Gable => [-self.reach; 2],
            Cap::HipAndGable { wall, verge } if strip[1] > wall - verge + 1e-9 => [wall; 2],
            Cap::HipAndGable { .. } => strip,
            Cap::HalfHip { run } => strip.map(|d| (d - half + run).max(0.0)),
            Cap::Hip { .. } => self.start(strip, half),
        }
    }

    /// Returns true if a strip lies high enough to continue into the roof or wall beyond.
    fn runs_on(&self, [lower, upper]: [f64; 2]) -> bool {
        lower + upper > 2.0 * self.from
    }

    /// Returns the inward distance at which the end's slope is as high as the main slopes at distance `d`, metres.
    pub fn contour(&self, d: f64, half: f64) -> f64 {
        match self.cap {
            Cap::HalfHip { run } => d - half + run,
            Cap::Hip { run } => d * run / half,
            Cap::HipAndGable { .. } | Cap::Gable => d,
        }
    }

    /// Returns the distances between which the end has a slope of its own that meets the main slopes in hips.
    pub fn slope(&self, eaves: f64, half: f64) -> Option<(f64, f64)> {
        match self.cap {
            Cap::Gable => None,
            Cap::Hip { .. } => Some((-eaves, half)),
            Cap::HipAndGable { wall, verge } => Some((-eaves, wall - verge)),
            Cap::HalfHip { run } => Some(((half - run - self.verge).max(-eaves), half)),
        }
    }

    /// Returns the distance inward, metres, up to which its slope continues under the upper gable, to that gable's
    /// wall.
    pub fn beyond_hips(&self) -> Option<f64> {
        match self.cap {
            Cap::HipAndGable { wall, .. } => Some(wall),
            _ => None,
        }
    }

    /// Returns the distances inward at which the border of its slopes bends.
    pub fn bends(&self, half: f64) -> [Option<f64>; 2] {
        match self.cap {
            Cap::Gable => [(self.reach > 0.0).then_some(self.from), None],
            Cap::Hip { .. } => [None, None],
            Cap::HipAndGable { wall, verge } => [Some(wall - verge), None],
            Cap::HalfHip { run } => [Some(half - run - self.verge), Some(half - run)],
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::shape::end::*;
    use hsd_ir::ast::RoofStyle;

    fn look(shape: RoofShape) -> Look {
        let mut look = Look::gable(None, &RoofStyle::default(), 6.0, 0.909);
        look.shape = shape;
        look
    }

    #[test]
    fn a_ratio_sets_the_ridge_of_a_hip() {
        let mut hip = look(RoofShape::Hip);
        assert_eq!(Cap::of(&hip, 10.0, 3.0, true), Cap::Hip { run: 3.0 });
        hip.ratio = Some(0.5);
        assert_eq!(Cap::of(&hip, 10.0, 3.0, true), Cap::Hip { run: 2.5 });
        // A ridge as long as the roof would leave vertical ends.
        hip.ratio = Some(1.0);
        let Cap::Hip { run } = Cap::of(&hip, 10.0, 3.0, true) else {
            panic!()
        };
        assert!(run > 0.2, "{run}");
    }

    #[test]
    fn the_gable_of_an_irimoya_goes_from_gable_to_hip() {
        let mut hall = look(RoofShape::HipAndGable);
        let usual = Cap::of(&hall, 10.0, 3.0, true);
        assert_eq!(
            usual,
            Cap::HipAndGable {
                wall: 1.5,
                verge: 0.4
            }
        );
        hall.gable = Some(0.0);
        assert_eq!(Cap::of(&hall, 10.0, 3.0, true), Cap::Gable);
        hall.gable = Some(0.5);
        assert_eq!(Cap::of(&hall, 10.0, 3.0, true), Cap::Hip { run: 3.0 });
    }
}
