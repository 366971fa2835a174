//! Raised corners: the eaves of hipped roofs with sori rise towards the corners (docs/evidence.md 7.10).
//!
//! The lift grows with the square of the distance along the last half span before the corner, and dies out
//! up the slope at the wall line, so that no gap opens over the plate: its triangles lie along rays from
//! the corner of the walls, as fan rafters do.

use crate::facet::Facet;
use crate::frame::Plane;
use crate::shape::look::Look;
use crate::shape::profile::Profile;
use crate::shape::strip::Strip;
use glam::{DVec2, DVec3};

/// Number of triangles at one side of a corner.
const PARTS: u32 = 4;
/// The corner's lift relative to the sori times the distance over which it rises.
const RISE: f64 = 1.5;
/// The maximum share of the fall of the eaves that a lift may take back.
const MOST: f64 = 0.7;
/// The minimum lift that is modelled, metres.
const LEAST: f64 = 0.02;

/// The lift of the corners of one roof.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Raised {
    /// Height of the corner over the middle of the eaves, metres.
    lift: f64,
    /// The distance along the eaves over which it rises, metres.
    way: f64,
    /// Depth of the eaves, metres.
    eaves: f64,
}

/// A strip end with its corner, in coordinates from the corner of the walls, away from the roof's end.
struct Fan<'s> {
    strip: &'s Strip<'s>,
    /// Position of the wall corner along u, and the direction of the roof from there.
    foot: f64,
    inward: f64,
    /// Position of the corner of the eaves, from the wall corner.
    corner: f64,
    way: f64,
    lift: f64,
    /// The share of the eaves that lies inward of the strip's lower and upper edge.
    shares: [f64; 2],
}

impl Raised {
    /// Returns the lift of a roof of this look, with half the shorter side of its walls; none without sori.
    pub(crate) fn of(look: &Look, profile: &Profile, half: f64) -> Option<Raised> {
        let eaves = -profile.knots[0].d;
        let way = half + eaves;
        let lift = (RISE * look.sori * way).min(-MOST * profile.knots[0].z);
        let curved = !profile.is_straight();
        (lift > LEAST && eaves > LEAST && curved).then_some(Raised { lift, way, eaves })
    }

    /// Lays a strip under the eaves, between two distances inward, with one or both of its ends lifted.
    pub(crate) fn lay(
        &self,
        strip: &Strip<'_>,
        d: [f64; 2],
        lifted: [bool; 2],
        facets: &mut Vec<Facet>,
    ) {
        let shares = d.map(|d| (-d / self.eaves).clamp(0.0, 1.0));
        let length = strip.frame.length;
        let mut middle = *strip;
        for (side, lifted) in lifted.into_iter().enumerate() {
            if !lifted {
                continue;
            }
            let (foot, inward) = [(0.0, 1.0), (length, -1.0)][side];
            let corner = match side {
                0 => strip.from[0],
                _ => length - strip.to[0],
            } / shares[0];
            let fan = Fan {
                strip,
                foot,
                inward,
                corner,
                way: self.way.min(length / 2.0 - corner),
                lift: self.lift,
                shares,
            };
            fan.lay(facets);
            let rest = [0, 1].map(|edge| fan.at(edge, 1.0));
            match side {
                0 => (middle.from, middle.body[0]) = (rest, rest),
                _ => (middle.to, middle.body[1]) = (rest, rest),
            }
        }
        // The strip between the fans is plane.
        facets.extend(middle.facet());
    }
}

impl Fan<'_> {
    /// Returns the point on the lower (0) or upper (1) edge after a share of the distance from the corner.
    fn at(&self, edge: usize, share: f64) -> f64 {
        self.foot + self.inward * self.shares[edge] * (self.corner + self.way * share)
    }

    fn point(&self, edge: usize, n: u32) -> DVec3 {
        let share = f64::from(n) / f64::from(PARTS);
        let line = [self.strip.lower, self.strip.upper][edge];
        let lift = self.lift * self.shares[edge] * (1.0 - share) * (1.0 - share);
        let frame = self.strip.frame;
        frame.point(self.at(edge, share), line.v, line.z + lift)
    }

    fn lay(&self, facets: &mut Vec<Facet>) {
        for n in 0..PARTS {
            let (p, q) = (self.point(0, n), self.point(0, n + 1));
            let (r, s) = (self.point(1, n + 1), self.point(1, n));
            facets.extend(triangle([p, q, r], self.strip.eaves));
            // On the wall line all rays meet in the foot of the hip.
            if self.shares[1] > 1e-6 {
                facets.extend(triangle([r, s, p], false));
            }
        }
    }
}

/// Returns a triangle whose first side is the eaves; either way round.
fn triangle([p, q, r]: [DVec3; 3], rim: bool) -> Option<Facet> {
    let plane = Plane::through([p, q, r])?;
    let (p, q, r): (DVec2, DVec2, DVec2) = (p.truncate(), q.truncate(), r.truncate());
    let (p, q) = if (q - p).perp_dot(r - p) > 0.0 {
        (p, q)
    } else {
        (q, p)
    };
    Some(Facet::new(
        &[(p, rim), (q, false), (r, false)],
        &[p, q, r],
        plane,
    ))
}
