//! Pent roof (hisashi, HIS; docs/evidence.md 4.5): a slope outside the walls, hung on them without posts.
//!
//! The rectangle is the whole roof: no eaves, no verges. Its height is that of the UPPER surface at
//! the low edge, so that the high edge meets the foot of the upper wall exactly.

use crate::frame::{Frame, Rect};
use crate::region::Side;
use crate::shape::form::Form;
use crate::shape::lean_to::{Flank, LeanTo};
use crate::shape::look::Look;
use crate::solid::prism;
use hsd_ir::building::{Finish, Solid};

/// Depth to which the roof and its arms penetrate the wall, metres.
const INTO: f64 = 0.03;
/// Side of the purlin under the edge, and height of the arms, metres.
const BEAM: f64 = 0.09;
/// Width of the arms, metres.
const ARM: f64 = 0.06;
/// Distance of the purlin's middle from the low edge, metres.
const PURLIN: f64 = 0.15;

/// Farthest distance of two arms: a ken of 6.5 shaku, metres.
const WIDEST: f64 = 1.97;

/// A pent roof over a rectangle outside the walls.
#[derive(Clone, Debug)]
pub struct Pent {
    /// The whole roof in plan.
    pub rect: Rect,
    /// The side it falls to.
    pub near: Side,
    /// Height of the upper surface at the low edge, metres.
    pub height: f64,
    /// Pitch and covering.
    pub look: Look,
    /// Distances of the posts behind it from the left end as seen from the low side, metres, in order. Its arms stand
    /// on them.
    pub posts: Vec<f64>,
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
        let (foot, head) = (top - 2.0 * BEAM + 0.02, top - BEAM + 0.02);
        for middle in self.arms(2.0 * inset, frame.length - 2.0 * inset) {
            let u = middle - ARM / 2.0;
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
    /// Returns the middles of the arms between two ends: one on each post, the outer ones moved in under the roof, and
    /// further ones where posts are far apart.
    fn arms(&self, from: f64, to: f64) -> Vec<f64> {
        let posts = self.posts.iter().map(|u| u.clamp(from, to));
        let mut arms: Vec<f64> = Vec::with_capacity(self.posts.len() + 2);
        for next in std::iter::once(from).chain(posts).chain([to]) {
            let Some(last) = arms.last().copied() else {
                arms.push(next);
                continue;
            };
            if next - last < 2.0 * ARM {
                continue;
            }
            let parts = ((next - last) / WIDEST).ceil().clamp(1.0, 200.0);
            let step = (next - last) / parts;
            arms.extend((1..=parts as u32).map(|i| last + step * f64::from(i)));
        }
        arms
    }
}
