//! Verges over lower roofs: the part of a slope inside the thickness of a verge above it is cut away, since the
//! verge covers it.

use crate::roof::facet::{Corner, Facet, HalfPlane, Higher, edges, subtract};
use crate::roof::frame::Plane;
use crate::roof::shape::form::Form;
use crate::roof::solid::sheet::{Piece, has_area};
use glam::DVec2;

/// Cuts away the parts of every roof inside the verges of the others; `near` gives the roofs near one.
pub(in crate::roof) fn clear_verges(
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
            for (outline, top) in &verges {
                let limits = (top.raised(clearance), top.raised(-form.drop));
                for (piece, plane) in std::mem::take(&mut met[other]) {
                    let mut left = vec![];
                    outside(piece, plane, outline, limits, &mut left);
                    let left = left.into_iter().filter(|p| has_area(p));
                    met[other].extend(left.map(|p| (p, plane)));
                }
            }
        }
    }
}

/// A part of an upper surface: its outline and its plane.
type Cover = (Vec<DVec2>, Plane);

fn cover((outline, plane): &Piece) -> Cover {
    (outline.iter().map(|c| c.at).collect(), *plane)
}

/// Returns the verges of a form that remain after joining.
fn left_of(form: &Form, met: &[Piece]) -> Vec<Cover> {
    let mut verges = vec![];
    for facet in form.facets.iter().filter(|f| has_verge(f)) {
        let body = edges(&facet.body);
        for (piece, _) in met.iter().filter(|(_, plane)| *plane == facet.plane) {
            let mut over = vec![];
            match facet.body.len() {
                0..3 => over.push(piece.clone()),
                _ => subtract(piece.clone(), body.iter(), &mut over),
            }
            verges.extend(over.into_iter().map(|v| cover(&(v, facet.plane))));
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
    piece: Vec<Corner>,
    plane: Plane,
    verge: &[DVec2],
    (top, bottom): (Plane, Plane),
    left: &mut Vec<Vec<Corner>>,
) {
    let mut sides = edges(verge);
    for (upper, lower) in [(top, plane), (plane, bottom)] {
        match HalfPlane::where_higher(upper, lower) {
            Higher::Nowhere => return left.push(piece),
            Higher::Everywhere => {}
            Higher::Inside(side) => sides.push(side),
        }
    }
    subtract(piece, sides.iter(), left);
}
