//! Slopes with the part of each that is filled, mostly down to the wall plate.

use crate::facet::{
    Convex, Corner, HalfPlane, Higher, area, edges, is_outside, sides_of, split_off,
};
use crate::frame::Plane;
use crate::solid::massive::is_gable;
use crate::solid::massive::parts::Part;
use crate::solid::sheet::surface;
use crate::solid::{INFILL_THICKNESS, SUNK};
use glam::DVec2;
use hsd_base::geometry::tolerance::HEIGHT;
use hsd_ir::ast::RoofKind;
use hsd_ir::building::{Attic, Roof};

/// Outlines with less area are left out, square metres.
pub(super) const SLIVER: f64 = 2e-6;
/// Slopes that share less than this in plan lie beside each other, square metres.
pub(super) const HARDLY: f64 = 1e-6;
/// Corners may lie so far outside, metres.
const OUT: f64 = 2e-5;

/// A convex part of a slope.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub(super) outline: Convex,
    /// The convex part of it over the attic; empty if there is none.
    pub(super) filled: Convex,
    pub(super) top: Plane,
    /// Vertical thickness of the slab, metres.
    pub(super) drop: f64,
    /// The covering; none of a wall.
    pub(super) kind: Option<RoofKind>,
    /// The lower end of the filling.
    pub(super) bottom: Plane,
}

impl Piece {
    /// Returns the lower surface of the slab.
    pub(super) fn low(&self) -> Plane {
        self.top.raised(-self.drop)
    }
}

/// Returns the slopes of some roofs, and the gable walls of those without attic; some may share space.
pub(super) fn pieces(roofs: &[&Roof]) -> Vec<Piece> {
    let mut all = Vec::with_capacity(8);
    for roof in roofs {
        let bottom = Plane::level(roof.attic.plate - SUNK);
        for solid in &roof.solids {
            if let Some((slopes, drop)) = surface(solid) {
                for (outline, top) in slopes {
                    let piece = Piece {
                        outline,
                        filled: Convex::new(),
                        top,
                        drop,
                        kind: Some(roof.kind),
                        bottom,
                    };
                    match roof.attic.filled {
                        true => piece.over(&roof.attic, &mut all),
                        false => all.push(piece),
                    }
                }
            } else if !roof.attic.filled && is_gable(solid) {
                let mut walls = vec![];
                Part::wall(solid, &mut walls);
                all.extend(walls.into_iter().map(Piece::wall));
            }
        }
    }
    all.retain(|p| area(&p.outline) > SLIVER);
    all
}

impl Piece {
    fn wall(part: Part) -> Piece {
        Piece {
            filled: Convex::from_slice(&part.outline),
            outline: part.outline,
            top: part.top,
            drop: 0.0,
            kind: None,
            bottom: part.bottom,
        }
    }

    /// Adds it with its filling; in parts if a verge begins in the middle of it.
    fn over(mut self, attic: &Attic, all: &mut Vec<Piece>) {
        let lies_in = |p: &[glam::DVec3], top: Plane| {
            let off = |p: &glam::DVec3| (top.at(p.truncate()) - p.z).abs();
            p.iter().all(|p| off(p) < HEIGHT)
        };
        let own = self.top;
        if let Some((_, by)) = attic.lowered.iter().find(|(v, _)| lies_in(v, own)) {
            self.top = self.top.raised(*by);
        }
        self.filled = match HalfPlane::where_higher(self.low(), self.bottom) {
            Higher::Everywhere => Convex::from_slice(&self.outline),
            Higher::Nowhere => Convex::new(),
            Higher::Inside(side) => {
                let [inside, _] = side.halves(&self.outline);
                kept(inside)
            }
        };
        let top = self.top;
        let mut own = vec![self];
        for verge in attic.verges.iter().filter(|v| lies_in(v, top)) {
            let plan: Vec<DVec2> = verge.iter().map(|p| p.truncate()).collect();
            if let Some(line) = HalfPlane::left_of(plan[1], plan[0]) {
                let line = line.moved_out(INFILL_THICKNESS / 2.0);
                let sides = edges(&plan);
                let before = std::mem::take(&mut own);
                before
                    .into_iter()
                    .for_each(|p| p.end_at(line, &sides, &mut own));
            }
        }
        all.append(&mut own);
    }

    /// Adds it with its filling ending at a gable wall where a verge lies beyond; in parts if it is wider than the
    /// verge.
    fn end_at(mut self, wall: HalfPlane, verge: &[HalfPlane], parts: &mut Vec<Piece>) {
        if is_outside(&self.filled, verge.iter()) {
            return parts.push(self);
        }
        let [inside, beyond] = wall.halves(&self.filled);
        let covered = |c: &Corner| verge.iter().all(|side| side.depth(c.at) > -OUT);
        if beyond.iter().all(covered) {
            self.filled = kept(inside);
            return parts.push(self);
        }
        let mut off = vec![];
        let covered = split_off(Convex::from_slice(&self.outline), verge.iter(), &mut off);
        let Some(covered) = covered.filter(|c| area(c) > HARDLY) else {
            return parts.push(self);
        };
        parts.extend(off.into_iter().map(|outline| self.part(outline)));
        let mut covered = self.part(covered);
        let [inside, _] = wall.halves(&covered.filled);
        covered.filled = kept(inside);
        parts.push(covered);
    }

    /// Returns the part of it over a part of its outline.
    pub(super) fn part(&self, outline: Convex) -> Piece {
        let filled = inside(&self.filled, &sides_of(&outline));
        Piece {
            outline,
            filled: kept(filled),
            ..*self
        }
    }
}

/// Returns the part of a convex outline inside some sides.
pub(super) fn inside(outline: &[Corner], sides: &[HalfPlane]) -> Convex {
    if is_outside(outline, sides.iter()) {
        return Convex::new();
    }
    split_off(Convex::from_slice(outline), sides.iter(), &mut vec![]).unwrap_or_default()
}

/// Returns an outline, or nothing if it is a sliver.
fn kept(outline: Convex) -> Convex {
    match area(&outline) > SLIVER {
        true => outline,
        false => Convex::new(),
    }
}
