//! Verges over lower roofs: the part of a slope inside the thickness of a verge above it is cut away, since the
//! verge covers it.

use crate::facet::{Convex, Corner, Facet, HalfPlane, Higher, Sides, edges, sides_of, subtract};
use crate::frame::{Plane, Rect, round};
use crate::shape::form::Form;
use crate::solid::sheet::{Piece, has_area};
use glam::DVec2;

/// Cuts away the parts of every roof inside the verges of the others; `near` gives the roofs near one.
pub(crate) fn clear_verges(
    forms: &[Form],
    met: &mut [Vec<Piece>],
    near: impl Fn(usize) -> Vec<usize>,
) {
    if forms.len() < 2 {
        return;
    }
    for (n, form) in forms.iter().enumerate() {
        let verges = left_of(form, &met[n]);
        for other in near(n).into_iter().filter(|o| *o != n) {
            let clearance = form.clearance(other, &forms[other]);
            for verge in &verges {
                // Most slopes nearby lie beside it.
                if !met[other].iter().any(|(piece, _)| verge.overlaps(piece)) {
                    continue;
                }
                let limits = (verge.top.raised(clearance), verge.top.raised(-form.drop));
                let mut left = vec![];
                for (piece, plane) in std::mem::take(&mut met[other]) {
                    outside(piece, plane, &verge.sides, limits, &mut left);
                    let left = left.drain(..).filter(|p| has_area(p));
                    met[other].extend(left.map(|p| (p, plane)));
                }
            }
        }
    }
}

/// A part of an upper surface that stands over lower ones.
struct Cover {
    sides: Sides,
    around: Rect,
    top: Plane,
}

impl Cover {
    fn of(outline: &Convex, top: Plane) -> Cover {
        Cover {
            sides: sides_of(outline),
            around: around(outline),
            top,
        }
    }

    fn overlaps(&self, piece: &Convex) -> bool {
        self.around.overlaps(&around(piece))
    }
}

fn around(outline: &Convex) -> Rect {
    round(outline.iter().map(|c| c.at))
}

/// Returns the verges of a form that remain after joining.
fn left_of(form: &Form, met: &[Piece]) -> Vec<Cover> {
    let mut verges = vec![];
    for facet in form.facets.iter().filter(|f| has_verge(f)) {
        let body = edges(&facet.body);
        for (piece, _) in met.iter().filter(|(_, plane)| *plane == facet.plane) {
            let mut over = vec![];
            match facet.body.len() {
                0..3 => over.push(Convex::from_slice(piece)),
                _ => subtract(Convex::from_slice(piece), body.iter(), &mut over),
            }
            verges.extend(over.iter().map(|v| Cover::of(v, facet.plane)));
        }
    }
    verges
}

fn has_verge(facet: &Facet) -> bool {
    let same = |(c, p): (&Corner, &DVec2)| c.at == *p;
    facet.outline.len() != facet.body.len() || !facet.outline.iter().zip(&facet.body).all(same)
}

/// Returns the part of a piece outside a verge, which takes the space between two limits, the upper first.
fn outside(
    piece: Convex,
    plane: Plane,
    verge: &Sides,
    (top, bottom): (Plane, Plane),
    left: &mut Vec<Convex>,
) {
    let mut sides = Sides::from_slice(verge);
    for (upper, lower) in [(top, plane), (plane, bottom)] {
        match HalfPlane::where_higher(upper, lower) {
            Higher::Nowhere => return left.push(piece),
            Higher::Everywhere => {}
            Higher::Inside(side) => sides.push(side),
        }
    }
    subtract(piece, sides.iter(), left);
}
