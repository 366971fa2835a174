//! One strip of a slope between two heights, in the frame of its roof.

use crate::facet::Facet;
use crate::frame::Frame;
use crate::shape::profile::Knot;
use glam::DVec2;
use hsd_base::geometry::tolerance::POINT;
use smallvec::SmallVec;

/// The lower or the upper edge of a strip.
#[derive(Clone, Copy, Debug)]
pub struct Edge {
    /// Distance inward from the wall line, metres.
    pub v: f64,
    /// Height of the upper surface, metres.
    pub z: f64,
}

impl Edge {
    pub(crate) fn of(knot: Knot, v: f64, top: f64) -> Edge {
        Edge { v, z: top + knot.z }
    }
}

/// One strip of a slope in its frame.
#[derive(Clone, Copy, Debug)]
pub struct Strip<'f> {
    /// The slope's frame.
    pub frame: &'f Frame,
    /// The edge towards the eaves.
    pub lower: Edge,
    /// The edge towards the ridge.
    pub upper: Edge,
    /// Its start along u, on the lower and on the upper edge.
    pub from: [f64; 2],
    /// Its end along u.
    pub to: [f64; 2],
    /// Its start and end without verges.
    pub body: [[f64; 2]; 2],
    /// True if its lower edge is the eaves.
    pub eaves: bool,
    /// True for each end that is a verge.
    pub verges: [bool; 2],
    /// True if its upper edge is exposed.
    pub ridge: bool,
}

impl Strip<'_> {
    /// Returns its facet; `None` if it has no width.
    pub fn facet(&self) -> Option<Facet> {
        let [lower, upper] = [self.lower, self.upper];
        let pitch = (upper.z - lower.z) / (upper.v - lower.v);
        let plane = self.frame.rising(lower.z - pitch * lower.v, pitch);
        let wide = (self.to[0] - self.from[0]).max(self.to[1] - self.from[1]) > POINT;
        if !wide || upper.v - lower.v < 1e-9 {
            return None;
        }
        let rims = [self.eaves, self.verges[1], self.ridge, self.verges[0]];
        let outline = self.corners(self.from, self.to, rims);
        let body = self.corners(self.body[0], self.body[1], rims);
        let body: SmallVec<[DVec2; 4]> = body.iter().map(|c| c.0).collect();
        Some(Facet::new(&outline, &body, plane))
    }

    /// Returns its corners with the kinds of their edges; the tip of a triangle is one corner.
    fn corners(
        &self,
        from: [f64; 2],
        to: [f64; 2],
        rims: [bool; 4],
    ) -> SmallVec<[(DVec2, bool); 4]> {
        let at = |u: f64, edge: Edge| self.frame.at(u, edge.v);
        let all = [
            (at(from[0], self.lower), rims[0]),
            (at(to[0], self.lower), rims[1]),
            (at(to[1], self.upper), rims[2]),
            (at(from[1], self.upper), rims[3]),
        ];
        let tips = [
            to[0] - from[0] < POINT,
            false,
            to[1] - from[1] < POINT,
            false,
        ];
        let kept = all.into_iter().zip(tips).filter(|(_, tip)| !tip);
        kept.map(|(corner, _)| corner).collect()
    }
}
