//! Two-sloped roofs: gable (kirizuma, KIR, 001-20), hip (yosemune), hip and gable (irimoya), pyramid
//! (hogyo), half-hip (hakama-goshi) and karahafu are one recipe, an [`End`] treatment at each end of a ridge
//! (docs/evidence.md 7.10).
//!
//! The LOWER surface passes through the wall plate (z = base at the wall line), the upper one lies one drop
//! higher, so that walls fill up to the roof whatever its thickness. Eaves are cut upright. Slopes are
//! strips along the [`Profile`] of the rafters; the ends' strips lie at the same heights, so that hips run
//! through their corners.

use crate::facet::Facet;
use crate::frame::{Frame, Rect, end_sides};
use crate::region::Side;
use crate::shape::corners::Raised;
use crate::shape::end::{Cap, End};
use crate::shape::form::Form;
use crate::shape::gable_wall::{Fill, panel};
use crate::shape::look::Look;
use crate::shape::profile::{Knot, Profile};
use crate::shape::strip::{Edge, Strip};
use crate::solid::SUNK;
use hsd_base::geometry::tolerance::POINT;
use hsd_ir::building::{Finish, Solid};

/// The gap between slabs that must not share a corner, metres.
const APART: f64 = 1e-3;

/// Below this no boards stand between the walls and the slab, metres.
const LEAST_GAP: f64 = 1e-3;

/// A two-sloped roof over a rectangle.
#[derive(Clone, Copy, Debug)]
pub struct RidgeRoof {
    /// The wall rectangle.
    pub rect: Rect,
    /// The eaves side at v = 0.
    pub near: Side,
    /// Height of the wall plate, metres.
    pub base: f64,
    /// Pitch, overhangs and so on.
    pub look: Look,
    /// The ends at u = 0 and at u = length.
    pub ends: [End; 2],
}

impl RidgeRoof {
    /// Returns the form of the roof.
    pub fn form(&self) -> Form {
        let drop = self.look.drop();
        let mut facets = Vec::with_capacity(2);
        let slopes = Slopes::of(self);
        let [start, end] = self.ends;
        let (start_up, end_up) = (start.raised(), end.raised());
        let far = self.near.opposite();
        slopes.main(
            self.near,
            [start, end],
            [start_up[0], end_up[0]],
            &mut facets,
        );
        slopes.main(far, [end, start], [end_up[1], start_up[1]], &mut facets);
        // Seen from the start the near side lies to the right, from the end to the left.
        let [first, last] = end_sides(self.near);
        slopes.end(first, start, [start_up[1], start_up[0]], &mut facets);
        slopes.end(last, end, end_up, &mut facets);
        Form {
            facets,
            drop,
            floor: self.base + self.look.lift() + 1e-4,
            solids: self.walls(&slopes),
            walls: self.walls_under_hips(),
            ..Form::default()
        }
    }

    /// Returns the walls with the area that the roof extends over, if a half-hip projects over its gable wall.
    fn walls_under_hips(&self) -> Option<Rect> {
        let half_hip = |e: &End| matches!(e.cap, Cap::HalfHip { .. });
        self.ends.iter().any(half_hip).then(|| {
            let frame = Frame::new(&self.rect, self.near);
            let [start, end] = self.ends.map(|e| e.reach);
            let (p, q) = (
                frame.at(-start, 0.0),
                frame.at(frame.length + end, frame.depth),
            );
            Rect {
                min: p.min(q),
                max: p.max(q),
            }
        })
    }

    /// Returns the walls that fill its gables.
    fn walls(&self, slopes: &Slopes<'_>) -> Vec<Solid> {
        let frame = Frame::new(&self.rect, self.near);
        let mut solids = Vec::with_capacity(2);
        let [start, end] = self.ends;
        for (end, outward, u) in [(start, -1.0, 0.0), (end, 1.0, frame.length)] {
            if !end.wall {
                continue;
            }
            let (from, top, inward, verge) = match end.cap {
                Cap::Hip { .. } => continue,
                Cap::Gable => (0.0, slopes.half, -end.reach, end.verge),
                Cap::HipAndGable { wall, verge } => (wall, slopes.half, wall, verge),
                Cap::HalfHip { run } => (0.0, slopes.half - run, 0.0, end.verge),
            };
            let fill = Fill {
                frame: &frame,
                u: u - outward * inward,
                outward,
                verge,
                gap: self.look.gap(),
            };
            solids.push(fill.under(&slopes.profile, self.base, (from, top)));
        }
        solids.extend(self.boards());
        solids
    }

    /// Returns the boards between the wall plates and a slab that lies above them (面戸板 mendo-ita).
    fn boards(&self) -> Vec<Solid> {
        let gap = self.look.gap();
        if gap < LEAST_GAP {
            return vec![];
        }
        let own = [self.near, self.near.opposite()];
        let ends = end_sides(self.near).into_iter().zip(self.ends);
        let hipped = ends.filter(|(_, end)| end.cap.has_corners());
        let sides = own.into_iter().chain(hipped.map(|(side, _)| side));
        let board = |side: Side| {
            let frame = Frame::new(&self.rect, side);
            let at = |u: f64| frame.point(u, 0.0, self.base - SUNK);
            let top = self.base + gap + SUNK;
            panel(at(0.0), at(frame.length), [top, top], Finish::Gable)
        };
        sides.map(board).collect()
    }
}

/// Shared data of the slopes of one roof.
struct Slopes<'h> {
    roof: &'h RidgeRoof,
    profile: Profile,
    /// Half the span, metres.
    half: f64,
    /// The lift of the corners of its eaves.
    raised: Option<Raised>,
}

impl<'h> Slopes<'h> {
    fn of(roof: &'h RidgeRoof) -> Slopes<'h> {
        let frame = Frame::new(&roof.rect, roof.near);
        let half = frame.depth / 2.0;
        let corners = roof.ends.iter().any(|e| e.raised() != [false; 2]);
        let bends = roof.ends.map(|e| e.bends(half));
        let mut at = [f64::NAN; 5];
        for (place, d) in at.iter_mut().zip(bends.iter().flatten()) {
            *place = d.unwrap_or(f64::NAN);
        }
        let profile = Profile::new(&roof.look, half, &at);
        let raised = corners
            .then(|| Raised::of(&roof.look, &profile, half.min(frame.length / 2.0)))
            .flatten();
        Slopes {
            roof,
            profile,
            half,
            raised,
        }
    }

    /// Returns the height of the upper surface over the wall plate.
    fn top(&self) -> f64 {
        self.roof.base + self.roof.look.lift()
    }

    /// Returns the strips of the slope that falls to `near`; the ends are those at u = 0 and u = length.
    fn main(&self, near: Side, [start, end]: [End; 2], lifted: [bool; 2], facets: &mut Vec<Facet>) {
        let frame = Frame::new(&self.roof.rect, near);
        let half = self.half;
        for (i, (lower, upper)) in self.profile.strips().enumerate() {
            let d = [lower.d, upper.d];
            let strip = Strip {
                frame: &frame,
                lower: Edge::of(lower, lower.d, self.top()),
                upper: Edge::of(upper, upper.d, self.top()),
                from: start.start(d, half),
                to: end.start(d, half).map(|u| frame.length - u),
                body: [
                    start.body(d, half),
                    end.body(d, half).map(|u| frame.length - u),
                ],
                eaves: i == 0,
                verges: [start, end].map(|e| !self.shares_hip(&e, d)),
                ridge: false,
            };
            self.lay(&strip, d, lifted, facets);
        }
    }

    /// Returns the strips of an end's own slope, which falls to `side`.
    fn end(&self, side: Side, end: End, lifted: [bool; 2], facets: &mut Vec<Facet>) {
        let eaves = -self.profile.knots[0].d;
        let Some((from, to)) = end.slope(eaves, self.half) else {
            return;
        };
        let frame = Frame::new(&self.roof.rect, side);
        let within = |d: f64| d > from - 1e-6 && d < to + 1e-6;
        let strips = self.profile.strips();
        let own = strips.filter(|(p, q)| within(p.d) && within(q.d));
        // The part under the upper gable is a separate slab, slightly lower, so that it shares no corner with the
        // slopes above, in whose planes its edges lie.
        let beyond = end
            .beyond_hips()
            .map(|wall| (self.lowered(to), self.lowered(wall)));
        let own = own.map(|strip| (strip, 0.0));
        let beyond = beyond.into_iter().map(|strip| (strip, APART));
        for (i, ((lower, upper), lowered)) in own.chain(beyond).enumerate() {
            let contour = |k: Knot| end.contour(k.d, self.half);
            let (from, to) = (
                [lower.d, upper.d],
                [lower.d, upper.d].map(|d| frame.length - d),
            );
            let strip = Strip {
                frame: &frame,
                lower: Edge::of(lower, contour(lower), self.top()),
                upper: Edge::of(upper, contour(upper), self.top()),
                from,
                to,
                body: [from, to],
                eaves: i == 0,
                verges: [false; 2],
                ridge: false,
            };
            let d = [lower.d, upper.d];
            let before = facets.len();
            self.lay(&strip, d, lifted, facets);
            facets[before..]
                .iter_mut()
                .for_each(|f| f.lowered = lowered);
        }
    }

    /// Returns a point of the rafter line, lowered by [`APART`].
    fn lowered(&self, d: f64) -> Knot {
        let knot = self.profile.knot(d);
        Knot {
            z: knot.z - APART,
            ..knot
        }
    }

    /// Lays the strip between two distances inward, in triangles at its lifted ends.
    fn lay(&self, strip: &Strip<'_>, d: [f64; 2], lifted: [bool; 2], facets: &mut Vec<Facet>) {
        match &self.raised {
            Some(raised) if lifted != [false; 2] && d[1] < POINT => {
                raised.lay(strip, d, lifted, facets);
            }
            _ => facets.extend(strip.facet()),
        }
    }

    /// Returns true if the main slopes meet the end's slope along the border of a strip.
    fn shares_hip(&self, end: &End, d: [f64; 2]) -> bool {
        let Some((from, to)) = end.slope(-self.profile.knots[0].d, self.half) else {
            return false;
        };
        let start = end.start(d, self.half);
        let inside = d[0] > from - 1e-6 && d[1] < to + 1e-6;
        inside && (0..2).all(|i| (start[i] - end.contour(d[i], self.half)).abs() < 1e-6)
    }
}
