//! Abutments: branches end in the slope of their trunk, whatever side of it they lie on (docs/evidence.md 3.7).

use crate::frame::near_side;
use crate::region::Side;
use crate::shape::end::{Cap, End};
use crate::shape::profile::Profile;
use crate::storey::automatic::Automatic;

/// Depth to which a ridge penetrates the slope it ends in, metres.
const INTO: f64 = 0.02;

/// The slope of a trunk as seen from a branch.
struct Slope {
    profile: Profile,
    /// Metres in plan for each metre of the profile's distance.
    stretch: f64,
    /// Length of the slope in plan, metres.
    run: f64,
    /// True if it ends at an upper gable instead of a ridge.
    gable: bool,
}

impl Automatic<'_, '_> {
    /// Returns the treatment of the free ends of a region's roof or of a written one.
    pub(crate) fn cap(&self, n: usize) -> Cap {
        let region = &self.regions[n];
        let Some(ridge) = region.ridge else {
            return Cap::Gable;
        };
        let metres = |steps: i64| self.context.metres(steps);
        let length = metres(near_side(ridge).measure(&region.cell).0);
        // A branch has one free end.
        let both = region.joins.is_none();
        Cap::of(&self.looks[n], length, metres(region.span()) / 2.0, both)
    }

    /// Returns the slope of `trunk` seen from a roof that lies with `side` on it.
    fn slope_from(&self, trunk: usize, side: Side) -> Option<Slope> {
        let (region, look) = (&self.regions[trunk], &self.looks[trunk]);
        let across = self.context.metres(side.measure(&region.cell).1);
        let half = self.context.metres(region.span()) / 2.0;
        let slope = |profile: f64, stretch: f64, run: f64, gable: bool| Slope {
            profile: Profile::new(look, profile, &[]),
            stretch,
            run,
            gable,
        };
        match (region.ridge, region.fall) {
            (Some(ridge), _) if ridge != side.ridge_into() => {
                Some(slope(across / 2.0, 1.0, across / 2.0, false))
            }
            (Some(_), _) => match self.cap(trunk) {
                Cap::Hip { run } => Some(slope(half, run / half, run, false)),
                Cap::HipAndGable { wall, .. } => Some(slope(half, 1.0, wall, true)),
                Cap::Gable | Cap::HalfHip { .. } => None,
            },
            (None, Some(fall)) if fall == side.opposite() && region.over.is_none() => {
                Some(slope(across, 1.0, across, false))
            }
            // Above a lower lean-to.
            _ => None,
        }
    }

    /// Returns the end of branch `n` that lies with `side` on its trunk: the ridge continues until it ends in the
    /// trunk's slope (docs/evidence.md 3.7). If it is higher than the trunk, it ends over the trunk's ridge in a gable.
    pub(crate) fn abut(&self, n: usize, trunk: usize, side: Side, plain: End) -> End {
        let (own, other) = (&self.looks[n], &self.looks[trunk]);
        let Some(slope) = self.slope_from(trunk, side) else {
            return plain;
        };
        let span = self.context.metres(self.regions[n].span());
        let height = own.pitch * span / 2.0 + own.drop() - other.drop();
        let dies = slope.profile.reach(height).map(|d| d * slope.stretch);
        match dies.filter(|d| *d <= slope.run + 1e-6) {
            Some(d) => End {
                reach: (d + INTO).clamp(INTO, slope.run.max(INTO)),
                ..End::default()
            },
            None if slope.gable => End {
                reach: slope.run + INTO,
                ..End::default()
            },
            None => End {
                reach: slope.run,
                ..plain
            },
        }
    }
}
