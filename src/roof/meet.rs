//! Where roofs of one height meet: each keeps what it covers highest (domain.md 3.7).
//!
//! Eaves vanish inside a neighbour, branches die in their trunk's slope, valleys run where two
//! slopes cross; what remains of each roof is still a closed solid of its own, and no two overlap.
//! Verges are the exception: they stand over a lower neighbour and take nothing from it.

use super::facet::{Cutter, Facet, cut, open_shares};
use super::form::{Form, RidgeLine};
use super::frame::Rect;
use super::sheet::{Piece, has_area};
use glam::DVec2;

/// What remains of each form: the pieces of its surface and of its ridges. `walls` are rectangles
/// that nothing may enter: the upper storey.
pub(super) fn meet(forms: &[Form], walls: &[Rect]) -> Vec<(Vec<Piece>, Vec<RidgeLine>)> {
    if let ([form], []) = (forms, walls) {
        return vec![(whole(form), form.ridges.clone())];
    }
    let boxes: Vec<Rect> = forms.iter().map(bounds).collect();
    let walls: Vec<[DVec2; 4]> = walls.iter().map(Rect::corners).collect();
    let near = Near::new(&boxes, &walls);
    let kept = |n: usize| {
        let walls = if forms[n].hung { vec![] } else { near.walls(n, &boxes, &walls) };
        let cutters = cutters(n, forms, &near.roofs(n, &boxes), &walls);
        if cutters.is_empty() {
            return (whole(&forms[n]), forms[n].ridges.clone());
        }
        let pieces = forms[n].facets.iter().flat_map(|f| remaining(f, &cutters)).collect();
        let ridges = forms[n].ridges.iter().flat_map(|r| ridge_parts(r, &cutters)).collect();
        (pieces, ridges)
    };
    (0..forms.len()).map(kept).collect()
}

fn whole(form: &Form) -> Vec<Piece> {
    form.facets.iter().map(|f| (f.outline.clone(), f.plane)).collect()
}

fn bounds(form: &Form) -> Rect {
    let corners = form.facets.iter().flat_map(|f| &f.outline).map(|c| c.at);
    let none = Rect {
        min: DVec2::MAX,
        max: DVec2::MIN,
    };
    corners.fold(none, |r, p| Rect { min: r.min.min(p), max: r.max.max(p) })
}

/// Who lies near whom, by sweeping over the least x.
struct Near {
    /// Roofs by least x, and the greatest width among them.
    roofs: (Vec<usize>, f64),
    /// The same of the walls.
    walls: (Vec<usize>, f64),
}

impl Near {
    fn new(boxes: &[Rect], walls: &[[DVec2; 4]]) -> Near {
        let sorted = |lo: &dyn Fn(usize) -> f64, hi: &dyn Fn(usize) -> f64, n: usize| {
            let mut order: Vec<usize> = (0..n).collect();
            order.sort_by(|i, j| lo(*i).total_cmp(&lo(*j)));
            (order, (0..n).map(|i| hi(i) - lo(i)).fold(0.0, f64::max))
        };
        Near {
            roofs: sorted(&|i| boxes[i].min.x, &|i| boxes[i].max.x, boxes.len()),
            walls: sorted(&|i| walls[i][0].x, &|i| walls[i][2].x, walls.len()),
        }
    }

    fn roofs(&self, n: usize, boxes: &[Rect]) -> Vec<usize> {
        let mut found = self.among(&self.roofs, &boxes[n], |i| boxes[i]);
        found.retain(|i| *i != n);
        found.sort_unstable();
        found
    }

    fn walls<'w>(&self, n: usize, boxes: &[Rect], walls: &'w [[DVec2; 4]]) -> Vec<&'w [DVec2]> {
        let rect = |i: usize| Rect { min: walls[i][0], max: walls[i][2] };
        self.among(&self.walls, &boxes[n], rect).into_iter().map(|i| &walls[i][..]).collect()
    }

    fn among(
        &self,
        (order, widest): &(Vec<usize>, f64),
        of: &Rect,
        rect: impl Fn(usize) -> Rect,
    ) -> Vec<usize> {
        let start = order.partition_point(|i| rect(*i).min.x < of.min.x - widest);
        let ahead = order[start..].iter().copied().take_while(|i| rect(*i).min.x < of.max.x);
        ahead.filter(|i| rect(*i).overlaps(of)).collect()
    }
}

/// What may cut roof `n`.
fn cutters<'f>(n: usize, forms: &'f [Form], near: &[usize], walls: &[&'f [DVec2]]) -> Vec<Cutter<'f>> {
    let mut cutters: Vec<Cutter<'f>> =
        walls.iter().map(|body| Cutter { body, plane: None, first: true }).collect();
    for &other in near {
        // A roof under the eaves of its trunk is no part of the surface that the others make: it
        // takes place from eaves that would pierce it, and gives none.
        let tucked = forms[n].under.is_some() && forms[other].under.is_none();
        if tucked || forms[n].under == Some(other) || forms[other].under == Some(n) {
            continue;
        }
        let facets = forms[other].facets.iter();
        let first = other < n;
        cutters.extend(facets.map(|f| Cutter { body: &f.body, plane: Some(f.plane), first }));
    }
    cutters
}

fn remaining(facet: &Facet, cutters: &[Cutter<'_>]) -> Vec<Piece> {
    let mut pieces = vec![facet.outline.clone()];
    for cutter in cutters {
        pieces = cut(facet, pieces, cutter);
    }
    pieces.into_iter().filter(|p| has_area(p)).map(|p| (p, facet.plane)).collect()
}

/// The open parts of a ridge, run on a little into what covers it.
fn ridge_parts(ridge: &RidgeLine, cutters: &[Cutter<'_>]) -> Vec<RidgeLine> {
    const INTO: f64 = 0.15;
    let way = ridge.to - ridge.from;
    let length = way.length();
    let open = open_shares(ridge.from, ridge.to, cutters).into_iter();
    open.filter(|(s, e)| (e - s) * length > 0.05)
        .map(|(s, e)| {
            let start = if s > 0.0 { (s - INTO / length).max(0.0) } else { s };
            let end = if e < 1.0 { (e + INTO / length).min(1.0) } else { e };
            RidgeLine {
                from: ridge.from + way * start,
                to: ridge.from + way * end,
                free: [ridge.free[0] && s <= 0.0, ridge.free[1] && e >= 1.0],
            }
        })
        .collect()
}
