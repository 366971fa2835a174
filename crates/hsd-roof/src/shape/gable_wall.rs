//! Gable walls: the infill at the end of a roof from the wall plate to its lower surface.

use crate::frame::Frame;
use crate::shape::profile::Profile;
use crate::solid::{INFILL_THICKNESS, SUNK, curtain, prism};
use glam::DVec3;
use hsd_ir::building::{Finish, Solid};
use smallvec::SmallVec;

/// The upper edge of an infill: (v, z).
type Chain = SmallVec<[(f64, f64); 8]>;

/// A wall across u, under a roof.
#[derive(Clone, Copy, Debug)]
pub struct Fill<'f> {
    /// The frame of the roof.
    pub frame: &'f Frame,
    /// Its wall line.
    pub u: f64,
    /// Direction out of the house along u: +1 or -1.
    pub outward: f64,
    /// The overhang above it, metres.
    pub verge: f64,
    /// How far the lower surface lies above the slope over the walls, metres.
    pub gap: f64,
}

impl Fill<'_> {
    /// Returns the wall under two slopes that rise over `base` by this profile, from one distance inward to another,
    /// where it ends level.
    pub fn under(&self, profile: &Profile, base: f64, (from, top): (f64, f64)) -> Solid {
        let foot = base + profile.height(from) - SUNK;
        let mut chain = heights(profile, base + self.gap, (from, top));
        // Back down the other slope; two slopes share their ridge.
        let ridge = top > self.frame.depth / 2.0 - 1e-6;
        let mut back = chain.clone();
        if ridge {
            back.pop();
        }
        chain.extend(back.iter().rev().map(|(v, z)| (self.frame.depth - v, *z)));
        self.stand(foot, &chain, profile)
    }

    /// Returns the wedge or trapezoid at the side of a single slope over the whole depth.
    pub fn beside(&self, profile: &Profile, base: f64) -> Solid {
        let chain = heights(profile, base + self.gap, (0.0, self.frame.depth));
        self.stand(base - SUNK, &chain, profile)
    }

    /// Returns a wall from a level foot up to a chain; it never projects from under its verge.
    fn stand(&self, foot: f64, chain: &[(f64, f64)], under: &Profile) -> Solid {
        let face = self.u + self.outward * (INFILL_THICKNESS / 2.0).min(self.verge - SUNK / 2.0);
        let by: DVec3 = (self.frame.along() * (-self.outward * INFILL_THICKNESS)).extend(0.0);
        let point = |(v, z): &(f64, f64)| self.frame.point(face, *v, *z);
        let upper: SmallVec<[DVec3; 8]> = chain.iter().map(point).collect();
        if chain.len() <= 4 && under.is_straight() {
            // Convex: the chain and its ends at the foot.
            let mut profile = upper;
            let (first, last) = (chain[0].0, chain[chain.len() - 1].0);
            profile.extend([(last, foot), (first, foot)].map(|p| point(&p)));
            return prism(&profile, by, Finish::Gable);
        }
        curtain(&upper, foot, by, Finish::Gable)
    }
}

/// Returns the heights of the lower surface between two distances inward, slightly raised.
fn heights(profile: &Profile, base: f64, (from, to): (f64, f64)) -> Chain {
    let between = profile
        .knots
        .iter()
        .filter(|k| k.d > from + 1e-6 && k.d < to - 1e-6);
    let at = |d: f64| (d, base + profile.height(d) + SUNK);
    let mut chain: Chain = SmallVec::new();
    chain.push(at(from));
    chain.extend(between.map(|k| at(k.d)));
    chain.push(at(to));
    chain
}

/// Returns a wall along a line from `from` to `to` (lower corners), up to heights over both.
pub fn panel(from: DVec3, to: DVec3, tops: [f64; 2], finish: Finish) -> Solid {
    let across = (to - from).truncate().perp().normalize_or_zero() * INFILL_THICKNESS;
    let by = across.extend(0.0);
    let (p, q) = (from - by / 2.0, to - by / 2.0);
    let profile = [
        p,
        q,
        q.truncate().extend(tops[1]),
        p.truncate().extend(tops[0]),
    ];
    prism(&profile, by, finish)
}
