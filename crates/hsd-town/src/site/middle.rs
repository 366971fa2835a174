//! Houses in the middle: at the centre of a feature, along a line, and where the gate of its wall is.

use super::{Decision, LotSite, cap};
use crate::plot;
use crate::shape::{Segment, azimuth, sides};
use crate::street;
use glam::DVec2;
use hsd_ir::ast::town::{PlaceOn, Stood, Wish};

impl LotSite<'_> {
    /// Puts a house at the centre of a feature, or in the middle of a line.
    pub(super) fn on_centre(&self, wish: &Wish<'_>, on: PlaceOn) -> Stood {
        let centre = self.lot().shape.centre();
        let pieces = self.plan.pieces(self.lot(), "");
        let towards = street::nearest(&pieces, centre).map(|n| n.point - centre);
        let own = self.frontage().map(|f| f.front.chord);
        let along = self
            .longest()
            .filter(|_| on == PlaceOn::Line)
            .map(Segment::normal);
        let way = along
            .or(own.map(Segment::normal))
            .or(towards)
            .unwrap_or(-DVec2::Y);
        let front = own.unwrap_or(Segment::new(centre, centre));
        let ring = self.lot().shape.ring();
        let depth = ring
            .map_or(0.0, |r| plot::depth_behind(r, front))
            .min(cap(wish));
        self.decisions.borrow_mut().push(Decision {
            on,
            front,
            depth,
            iou: None,
            iou_full: None,
            refused: None,
        });
        Stood {
            at: centre,
            z: self.lot().z,
            plinth: 0.0,
            azimuth: azimuth(way),
            frontage: front.length(),
            depth,
            centred: true,
            walls: None,
        }
    }

    /// Puts a house across the middle of the front.
    pub(super) fn on_gate(&self) -> Option<Stood> {
        let (at, side) = self.gate()?;
        self.decisions.borrow_mut().push(Decision {
            on: PlaceOn::Gate,
            front: side,
            depth: 0.0,
            iou: None,
            iou_full: None,
            refused: None,
        });
        Some(Stood {
            at,
            z: self.lot().z,
            plinth: 0.0,
            azimuth: azimuth(side.normal()),
            frontage: side.length(),
            depth: 0.0,
            centred: true,
            walls: None,
        })
    }

    /// Returns the middle of the front of an area, and the side that it lies on.
    pub(super) fn gate(&self) -> Option<(DVec2, Segment)> {
        let near = self.frontage()?.front.chord.middle();
        let off = |side: &Segment| side.nearest(near).distance(near);
        let all = sides(self.lot().shape.ring()?);
        let side = all.min_by(|a, b| off(a).total_cmp(&off(b)))?;
        Some((side.nearest(near), side))
    }
}
