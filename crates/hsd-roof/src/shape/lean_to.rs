//! Shed roof (katanagare, KAT) and lean-to (geya): one slope from a low wall up to a high one.
//!
//! Three uses: over the wall plate, against an upper storey's wall or free; tucked under the eaves
//! of its trunk on the same storey, where the walls below end at its lower surface ([`Ceiling`]);
//! and written by the author.
//!
//! [`Ceiling`]: hsd_ir::building::Ceiling

use crate::facet::Facet;
use crate::frame::{Frame, Plane, Rect};
use crate::region::Side;
use crate::shape::form::Form;
use crate::shape::gable_wall::{Fill, panel};
use crate::shape::look::Look;
use crate::shape::profile::Profile;
use crate::shape::strip::{Edge, Strip};
use crate::solid::SUNK;
use hsd_ir::building::Finish;

/// One end of a lean-to, or its high side.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flank {
    /// Overhang, metres.
    pub over: f64,
    /// True if a wall closes it up to the roof.
    pub wall: bool,
}

/// A single slope over a rectangle.
#[derive(Clone, Copy, Debug)]
pub struct LeanTo {
    /// The wall rectangle.
    pub rect: Rect,
    /// The side it falls to, at v = 0.
    pub near: Side,
    /// Height of its lower surface over that side's wall line, metres.
    pub low: f64,
    /// Pitch, overhangs and so on.
    pub look: Look,
    /// The ends at u = 0 and at u = length.
    pub ends: [Flank; 2],
    /// The high side at v = depth.
    pub high: Flank,
}

impl LeanTo {
    /// Returns the form of the roof.
    pub fn form(&self) -> Form {
        let frame = Frame::new(&self.rect, self.near);
        let drop = self.look.drop();
        let profile = self.profile(&frame);
        Form {
            facets: self.facets(&frame, &profile),
            drop,
            floor: self.low + self.look.lift() + 1e-4,
            solids: self.walls(&frame, &profile),
            ..Form::default()
        }
    }

    /// Returns its lower surface, if that is plane.
    pub fn soffit(&self) -> Plane {
        Frame::new(&self.rect, self.near).rising(self.low, self.look.pitch)
    }

    /// Returns its rafter line.
    fn profile(&self, frame: &Frame) -> Profile {
        Profile::new(&self.look, frame.depth, &[])
    }

    fn facets(&self, frame: &Frame, profile: &Profile) -> Vec<Facet> {
        let [start, end] = self.ends;
        let base = self.low + self.look.lift();
        let length = frame.length;
        let strips = profile.strips().enumerate();
        let facets = strips.filter_map(|(i, (lower, upper))| {
            let last = i + 2 == profile.knots.len();
            let over = if last { self.high.over } else { 0.0 };
            let edge = |v: f64| Edge {
                v,
                z: base + profile.height(v),
            };
            let strip = Strip {
                frame,
                lower: edge(lower.d),
                upper: edge(upper.d + over),
                from: [-start.over; 2],
                to: [length + end.over; 2],
                body: [[0.0; 2], [length; 2]],
                eaves: i == 0,
                verges: [true; 2],
                ridge: last,
            };
            let mut facet = strip.facet()?;
            if over > 0.0 {
                let body = [
                    (0.0, lower.d),
                    (length, lower.d),
                    (length, upper.d),
                    (0.0, upper.d),
                ];
                facet.body = body.map(|(u, v)| frame.at(u, v)).to_vec();
            }
            Some(facet)
        });
        facets.collect()
    }

    fn walls(&self, frame: &Frame, profile: &Profile) -> Vec<hsd_ir::building::Solid> {
        let mut walls = Vec::new();
        let gap = self.look.gap();
        let ends = [(self.ends[0], -1.0, 0.0), (self.ends[1], 1.0, frame.length)];
        for (end, outward, u) in ends {
            if end.wall {
                let fill = Fill {
                    frame,
                    u,
                    outward,
                    verge: end.over,
                    gap,
                };
                walls.push(fill.beside(profile, self.low));
            }
        }
        if self.high.wall {
            let top = self.low + self.look.pitch * frame.depth + gap + SUNK;
            let at = |u: f64| frame.point(u, frame.depth, self.low - SUNK);
            walls.push(panel(at(0.0), at(frame.length), [top, top], Finish::Gable));
        }
        if gap > SUNK {
            let at = |u: f64| frame.point(u, 0.0, self.low - SUNK);
            let top = self.low + gap + SUNK;
            walls.push(panel(at(0.0), at(frame.length), [top, top], Finish::Gable));
        }
        walls
    }
}
