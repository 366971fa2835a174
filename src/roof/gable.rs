//! Gable (kirizuma, KIR, 001-20): two slopes from the wall plates to the ridge.
//!
//! The LOWER surface passes through the wall plate (z = base at the wall line), the upper one lies
//! one drop higher, so that walls fill up to the roof whatever its thickness. Eaves are cut upright.

use super::facet::Facet;
use super::form::Form;
use super::frame::{Frame, Plane, Rect};
use super::gable_wall::gable_wall;
use super::look::Look;
use super::ridge::Side;
use crate::building::Solid;

/// What a gable does at one end of its ridge.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct End {
    /// How far the roof runs on beyond its wall rectangle, inside the roof it joins, metres.
    pub reach: f64,
    /// Overhang beyond that, metres.
    pub verge: f64,
    /// Whether a gable wall stands there.
    pub wall: bool,
}

/// A gable roof over a rectangle.
#[derive(Clone, Copy, Debug)]
pub struct Gable {
    /// The wall rectangle.
    pub rect: Rect,
    /// The eaves side at v = 0.
    pub near: Side,
    /// Height of the wall plate, metres.
    pub base: f64,
    /// Pitch, overhangs and so on.
    pub look: Look,
    /// At u = 0 and at u = length.
    pub ends: [End; 2],
}

impl Gable {
    /// The form of the roof.
    pub fn form(&self) -> Form {
        let frame = Frame::new(&self.rect, self.near);
        let drop = self.look.drop();
        let mut facets = Vec::with_capacity(2);
        self.slope(&frame, self.ends, &mut facets);
        let far = Frame::new(&self.rect, self.near.opposite());
        self.slope(&far, [self.ends[1], self.ends[0]], &mut facets);
        Form {
            facets,
            drop,
            floor: self.base + drop + 1e-4,
            solids: self.walls(&frame),
            under: None,
            hung: false,
        }
    }

    /// Gable walls.
    fn walls(&self, frame: &Frame) -> Vec<Solid> {
        let mut solids = Vec::with_capacity(2);
        for (end, outward, u) in self.outer_ends(frame) {
            if end.wall {
                solids.push(gable_wall(
                    frame, u, outward, self.base, &self.look, end.verge,
                ));
            }
        }
        solids
    }

    /// Both ends with the direction out of the roof along u and where their wall stands.
    fn outer_ends(&self, frame: &Frame) -> [(End, f64, f64); 2] {
        let [start, end] = self.ends;
        [
            (start, -1.0, -start.reach),
            (end, 1.0, frame.length + end.reach),
        ]
    }

    /// The facets of the slope over v from 0 to the ridge, with its eaves.
    fn slope(&self, frame: &Frame, [start, end]: [End; 2], facets: &mut Vec<Facet>) {
        let plane = frame.rising(self.base + self.look.drop(), self.look.pitch);
        let (length, ridge, eaves) = (frame.length, frame.depth / 2.0, -self.look.eaves);
        let own = |e: End| if e.reach > 0.0 { 0.0 } else { e.verge };
        let (u0, u1) = (-own(start), length + own(end));
        let outline = [
            (frame.at(u0, eaves), true),
            (frame.at(u1, eaves), true),
            (frame.at(u1, ridge), false),
            (frame.at(u0, ridge), true),
        ];
        let body = [(0.0, eaves), (length, eaves), (length, ridge), (0.0, ridge)];
        facets.push(Facet::new(
            &outline,
            &body.map(|(u, v)| frame.at(u, v)),
            plane,
        ));
        if start.reach > 0.0 {
            let (wall, outer) = (-start.reach, -start.reach - start.verge);
            facets.push(extension(frame, [outer, 0.0], [wall, 0.0], plane));
        }
        if end.reach > 0.0 {
            let wall = length + end.reach;
            facets.push(extension(
                frame,
                [length, wall + end.verge],
                [length, wall],
                plane,
            ));
        }
    }
}

/// A slope beyond its wall rectangle, over u from and to: it stands inside another roof, so it has no
/// eaves. `body` is the part without verge.
fn extension(frame: &Frame, outer: [f64; 2], body: [f64; 2], plane: Plane) -> Facet {
    let ridge = frame.depth / 2.0;
    let [from, to] = outer;
    let outline = [
        (frame.at(from, 0.0), false),
        (frame.at(to, 0.0), to > body[1]),
        (frame.at(to, ridge), false),
        (frame.at(from, ridge), from < body[0]),
    ];
    let [from, to] = body;
    let body = [(from, 0.0), (to, 0.0), (to, ridge), (from, ridge)];
    Facet::new(&outline, &body.map(|(u, v)| frame.at(u, v)), plane)
}
