//! Pent roof (hisashi, HIS; docs/evidence.md 4.5): a slope outside the walls, hung on them without posts.
//!
//! The rectangle is the whole roof: no eaves, no verges. Its height is that of the UPPER surface at
//! the low edge, so that the high edge meets the foot of the upper wall exactly.

use crate::building::{Finish, Solid};
use crate::roof::frame::{Frame, Rect};
use crate::roof::region::Side;
use crate::roof::shape::form::Form;
use crate::roof::shape::lean_to::{Flank, LeanTo};
use crate::roof::shape::look::Look;
use crate::roof::solid::prism;

/// Depth to which the roof and its arms penetrate the wall, metres.
const INTO: f64 = 0.03;
/// Side of the purlin under the edge, and height of the arms, metres.
const BEAM: f64 = 0.09;
/// Width of the arms, metres.
const ARM: f64 = 0.06;
/// Distance of the purlin's middle from the low edge, metres.
const PURLIN: f64 = 0.15;

/// A pent roof over a rectangle outside the walls.
#[derive(Clone, Copy, Debug)]
pub struct Pent {
    /// The whole roof in plan.
    pub rect: Rect,
    /// The side it falls to.
    pub near: Side,
    /// Height of the upper surface at the low edge, metres.
    pub height: f64,
    /// Pitch and covering.
    pub look: Look,
    /// Distance of the arms, metres.
    pub unit: f64,
}

impl Pent {
    /// Returns the form of the roof with its arms and purlin.
    pub fn form(&self) -> Form {
        let look = Look {
            eaves: 0.0,
            verge: 0.0,
            ..self.look
        };
        let low = self.height - look.drop();
        let slope = LeanTo {
            rect: self.rect,
            near: self.near,
            low,
            look,
            ends: [Flank::default(); 2],
            high: Flank {
                over: INTO,
                wall: false,
            },
        };
        let mut form = slope.form();
        form.floor = f64::MIN;
        form.hung = true;
        if Frame::new(&self.rect, self.near).depth > 2.0 * PURLIN {
            self.brackets(low, &mut form.solids);
        }
        form
    }

    /// Adds a purlin near the low edge, and arms (udegi) from the wall under it.
    fn brackets(&self, low: f64, solids: &mut Vec<Solid>) {
        let frame = Frame::new(&self.rect, self.near);
        let inset = ARM.min(frame.length / 8.0);
        // Its upper edge touches the soffit at its lowest point.
        let top = low + self.look.pitch * (PURLIN - BEAM / 2.0) + 0.005;
        let (v0, v1) = (PURLIN - BEAM / 2.0, PURLIN + BEAM / 2.0);
        let section = [(v0, top - BEAM), (v1, top - BEAM), (v1, top), (v0, top)];
        let profile = section.map(|(v, z)| frame.point(inset, v, z));
        let by = (frame.along() * (frame.length - 2.0 * inset)).extend(0.0);
        solids.push(prism(&profile, by, Finish::Timber));
        let count = (frame.length / self.unit).round().clamp(1.0, 200.0);
        let step = (frame.length - 4.0 * inset) / count;
        let (foot, head) = (top - 2.0 * BEAM + 0.02, top - BEAM + 0.02);
        for i in 0..=count as u32 {
            let u = 2.0 * inset + step * f64::from(i) - ARM / 2.0;
            let (out, back) = (PURLIN - BEAM, frame.depth + INTO);
            let section = [(out, foot), (back, foot), (back, head), (out, head)];
            let profile = section.map(|(v, z)| frame.point(u, v, z));
            solids.push(prism(
                &profile,
                (frame.along() * ARM).extend(0.0),
                Finish::Timber,
            ));
        }
    }
}
