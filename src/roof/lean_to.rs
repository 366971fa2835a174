//! Lean-to (katanagare, KAT; geya): one slope from a low wall up to a high one.
//!
//! Three uses: over the wall plate, against an upper storey's wall or free; tucked under the eaves
//! of its trunk on the same storey, where the walls below end at its lower surface ([`Ceiling`]);
//! and written by the author.
//!
//! [`Ceiling`]: crate::building::Ceiling

use super::facet::Facet;
use super::form::Form;
use super::frame::{Frame, Plane, Rect};
use super::gable_wall::{SUNK, panel, wedge};
use super::look::Look;
use super::ridge::Side;
use crate::building::Finish;

/// What a lean-to does at one of its ends, or at its high side.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flank {
    /// Overhang, metres.
    pub over: f64,
    /// Whether a wall fills it up to the roof.
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
    /// At u = 0 and at u = length.
    pub ends: [Flank; 2],
    /// At v = depth.
    pub high: Flank,
}

impl LeanTo {
    /// The form of the roof.
    pub fn form(&self) -> Form {
        let frame = Frame::new(&self.rect, self.near);
        let drop = self.look.drop();
        Form {
            facets: vec![self.facet(&frame)],
            drop,
            floor: self.low + drop + 1e-4,
            solids: self.walls(&frame),
            under: None,
            hung: false,
        }
    }

    /// Its lower surface.
    pub fn soffit(&self) -> Plane {
        Frame::new(&self.rect, self.near).rising(self.low, self.look.pitch)
    }

    fn facet(&self, frame: &Frame) -> Facet {
        let [start, end] = self.ends;
        let (length, eaves) = (frame.length, -self.look.eaves);
        let (u0, u1, high) = (-start.over, length + end.over, frame.depth + self.high.over);
        let outline = [
            (frame.at(u0, eaves), true),
            (frame.at(u1, eaves), true),
            (frame.at(u1, high), true),
            (frame.at(u0, high), true),
        ];
        let body = [
            (0.0, eaves),
            (length, eaves),
            (length, frame.depth),
            (0.0, frame.depth),
        ];
        let plane = self.soffit().raised(self.look.drop());
        Facet::new(&outline, &body.map(|(u, v)| frame.at(u, v)), plane)
    }

    fn walls(&self, frame: &Frame) -> Vec<crate::building::Solid> {
        let mut walls = Vec::new();
        let ends = [(self.ends[0], -1.0, 0.0), (self.ends[1], 1.0, frame.length)];
        for (end, outward, u) in ends {
            if end.wall {
                walls.push(wedge(frame, u, outward, self.low, &self.look, end.over));
            }
        }
        if self.high.wall {
            let top = self.low + self.look.pitch * frame.depth + SUNK;
            let at = |u: f64| frame.point(u, frame.depth, self.low - SUNK);
            walls.push(panel(at(0.0), at(frame.length), [top, top], Finish::Gable));
        }
        walls
    }
}
