//! Joins roofs of one height: each keeps the area where it is the highest (docs/evidence.md 3.7).
//!
//! Eaves vanish inside a neighbour, branches die in their trunk's slope, valleys run where two slopes cross; what
//! remains of each roof is still a closed solid of its own, and no two overlap. Verges are the exception: they stand
//! over a lower neighbour and cut only the parts of it that would penetrate them (`verges`).

use crate::facet::{Convex, Cutter, Facet, HalfPlane, Sides, cut, edges, halves};
use crate::frame::{Rect, round};
use crate::join::nearby::Nearby;
use crate::join::verges::clear_verges;
use crate::shape::form::Form;
use crate::solid::sheet::{Piece, has_area};
use glam::DVec2;

/// The average number of overlapping roofs above which roofs are left unjoined. Roofs side by side have up to two
/// dozen, the smallest with the widest eaves; only stacked roofs have more.
const MOST_NEAR: usize = 32;

/// Returns the forms uncut.
pub(crate) fn apart(forms: &[Form]) -> Vec<Vec<Piece>> {
    forms.iter().map(whole).collect()
}

/// Returns the remaining pieces of each form. `walls` are the convex parts of the upper storey, which no roof enters.
/// `None` if too many roofs overlap.
pub(crate) fn meet(forms: &[Form], walls: &[Vec<DVec2>]) -> Option<Vec<Vec<Piece>>> {
    if let ([_], []) = (forms, walls) {
        return Some(apart(forms));
    }
    let boxes: Vec<Rect> = forms.iter().map(bounds).collect();
    let (roofs, storey) = (
        Nearby::new(boxes.clone()),
        Nearby::new(walls.iter().map(|w| round(w.iter().copied())).collect()),
    );
    let mut left = forms.len().saturating_mul(MOST_NEAR) + 1000;
    for of in &boxes {
        left = left.checked_sub(roofs.overlapping(of).len())?;
    }
    let wall_sides: Vec<Sides> = walls.iter().map(|w| edges(w)).collect();
    let sides_of = |form: &Form| form.facets.iter().map(|f| edges(&f.body)).collect();
    let sides: Vec<Vec<Sides>> = forms.iter().map(sides_of).collect();
    let kept = |n: usize| {
        let walls: Vec<Cutter<'_>> = match forms[n].hung {
            true => vec![],
            false => storey
                .overlapping(&boxes[n])
                .into_iter()
                .map(|i| wall(&walls[i], &wall_sides[i]))
                .collect(),
        };
        let mut near = roofs.overlapping(&boxes[n]);
        near.retain(|i| *i != n);
        let cutters = cutters(n, forms, &sides, &near, walls);
        if cutters.is_empty() {
            return whole(&forms[n]);
        }
        let facets = forms[n].facets.iter();
        facets.flat_map(|f| remaining(f, &cutters)).collect()
    };
    let mut met: Vec<Vec<Piece>> = (0..forms.len()).map(kept).collect();
    clear_verges(forms, &mut met, |n| roofs.overlapping(&boxes[n]));
    Some(met)
}

fn whole(form: &Form) -> Vec<Piece> {
    form.facets
        .iter()
        .map(|f| (Convex::from_slice(&f.outline), f.plane))
        .collect()
}

fn bounds(form: &Form) -> Rect {
    round(form.facets.iter().flat_map(|f| &f.outline).map(|c| c.at))
}

/// Returns the storey above as a cutter, higher than every roof.
fn wall<'f>(body: &'f [DVec2], sides: &'f [HalfPlane]) -> Cutter<'f> {
    Cutter {
        body,
        sides,
        plane: None,
        first: true,
    }
}

/// Returns the cutters of roof `n`: walls, and nearby facets with their sides.
fn cutters<'f>(
    n: usize,
    forms: &'f [Form],
    sides: &'f [Vec<Sides>],
    near: &[usize],
    walls: Vec<Cutter<'f>>,
) -> Vec<Cutter<'f>> {
    let mut cutters = walls;
    for &other in near {
        // A roof under the eaves of its trunk is not part of the surface that the others form: it cuts eaves that would
        // pierce it, and is not cut.
        let tucked = forms[n].under.is_some() && forms[other].under.is_none();
        if tucked || forms[n].under == Some(other) || forms[other].under == Some(n) {
            continue;
        }
        let facets = forms[other].facets.iter().zip(&sides[other]);
        let first = other < n;
        let clearance = forms[other].clearance(n, &forms[n]);
        cutters.extend(facets.map(|(f, sides)| Cutter {
            body: &f.body,
            sides,
            plane: Some(f.plane.raised(clearance)),
            first,
        }));
    }
    cutters
}

fn remaining(facet: &Facet, cutters: &[Cutter<'_>]) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let all: Vec<&Cutter<'_>> = cutters.iter().collect();
    cut_by(facet, Convex::from_slice(&facet.outline), &all, &mut pieces);
    pieces
        .into_iter()
        .filter(|p| has_area(p))
        .map(|p| (p, facet.plane))
        .collect()
}

/// Cuts a piece by all cutters; if they are very many, first in halves, each with those that it meets, since a piece
/// would otherwise be tested against every one.
fn cut_by(facet: &Facet, piece: Convex, cutters: &[&Cutter<'_>], done: &mut Vec<Convex>) {
    const MANY: usize = 48;
    let bounds = |points: &mut dyn Iterator<Item = DVec2>| {
        points.fold((DVec2::MAX, DVec2::MIN), |(lo, hi), p| {
            (lo.min(p), hi.max(p))
        })
    };
    let (lo, hi) = bounds(&mut piece.iter().map(|c| c.at));
    let size = hi - lo;
    if cutters.len() <= MANY || size.max_element() < 0.5 {
        let mut pieces = vec![piece];
        for cutter in cutters {
            if pieces.is_empty() {
                break;
            }
            pieces = cut(facet, pieces, cutter);
        }
        return done.extend(pieces);
    }
    let axis = if size.x > size.y { DVec2::X } else { DVec2::Y };
    let middle = axis.dot(lo + hi) / 2.0;
    for (half, sign) in halves(&piece, axis, middle).into_iter().zip([1.0, -1.0]) {
        let met = |c: &&&Cutter<'_>| {
            let (lo, hi) = bounds(&mut c.body.iter().copied());
            if sign > 0.0 {
                axis.dot(hi) > middle
            } else {
                axis.dot(lo) < middle
            }
        };
        let met: Vec<&Cutter<'_>> = cutters.iter().filter(met).copied().collect();
        cut_by(facet, half, &met, done);
    }
}
