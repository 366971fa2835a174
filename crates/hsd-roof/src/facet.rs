//! Facets: convex plan polygons, each under one plane of a roof's upper surface, and cutting them.

use crate::frame::Plane;
use glam::DVec2;
use hsd_base::geometry::tolerance::{CUT, SLIVER};
use smallvec::SmallVec;

/// A corner of a facet.
#[derive(Clone, Copy, Debug)]
pub struct Corner {
    /// Its position, house frame, metres.
    pub at: DVec2,
    /// True if the edge that starts here lies on the roof's own eaves or verge.
    pub rim: bool,
}

/// The corners of a convex polygon in plan. Most have so few that they need no memory of their own.
pub type Convex = SmallVec<[Corner; 6]>;

/// The sides of a convex polygon.
pub(crate) type Sides = SmallVec<[HalfPlane; 6]>;

/// A plane piece of a roof's upper surface.
#[derive(Clone, Debug)]
pub struct Facet {
    /// Convex, counter-clockwise seen from above.
    pub outline: Convex,
    /// The convex part of it that cuts lower roofs: without verges, which stand over a lower neighbour rather than in
    /// it.
    pub body: Vec<DVec2>,
    /// The upper surface.
    pub plane: Plane,
    /// Offset below its neighbours, metres, so that its slab shares no corner with theirs.
    pub lowered: f64,
}

impl Facet {
    /// Creates a facet that is all body, with rims by edge.
    pub fn new(corners: &[(DVec2, bool)], body: &[DVec2], plane: Plane) -> Facet {
        let outline = corners.iter().map(|&(at, rim)| Corner { at, rim });
        Facet {
            outline: outline.collect(),
            body: body.to_vec(),
            plane,
            lowered: 0.0,
        }
    }
}

impl Facet {
    /// Reduces its body to what lies in a convex area, counter-clockwise; only that takes the place of lower roofs. Where nothing
    /// does, the body is the side nearest to the area, which has no inside.
    pub(crate) fn keep_body(&mut self, area: &[DVec2]) {
        let corner = |at: &DVec2| Corner {
            at: *at,
            rim: false,
        };
        let whole: Convex = self.body.iter().map(corner).collect();
        let rest = edges(area)
            .iter()
            .fold(whole, |rest, side| side.inside(&rest));
        if self::area(&rest) > SLIVER {
            self.body = rest.iter().map(|c| c.at).collect();
            return;
        }
        let middle = area.iter().sum::<DVec2>() / area.len().max(1) as f64;
        let next = self.outline.iter().cycle().skip(1);
        let sides = self.outline.iter().zip(next).map(|(p, q)| [p.at, q.at]);
        let far = |[p, q]: &[DVec2; 2]| p.midpoint(*q).distance_squared(middle);
        let nearest = sides.min_by(|a, b| far(a).total_cmp(&far(b)));
        self.body = nearest.map_or(vec![], |side| side.to_vec());
    }

    /// Returns its parts beyond its body and beyond further sides: convex, each with its first edge on the side that
    /// cut it off.
    pub(crate) fn beyond(&self, more: &[HalfPlane]) -> Vec<Convex> {
        let mut verges = vec![];
        let same = |(c, p): (&Corner, &DVec2)| c.at == *p;
        let whole =
            self.outline.len() == self.body.len() && self.outline.iter().zip(&self.body).all(same);
        let body = if whole {
            Sides::new()
        } else {
            edges(&self.body)
        };
        let mut inside = Convex::from_slice(&self.outline);
        for side in body.iter().chain(more) {
            if inside.iter().all(|c| side.depth(c.at) > -CUT) {
                continue;
            }
            let [rest, mut outer] = side.halves(&inside);
            inside = rest;
            let on = |c: &Corner| side.depth(c.at) > -2.0 * CUT;
            let n = outer.len();
            if area(&outer) > SLIVER
                && let Some(first) = (0..n).find(|i| on(&outer[*i]) && on(&outer[(i + 1) % n]))
            {
                outer.rotate_left(first);
                verges.push(outer);
            }
            if area(&inside) <= SLIVER {
                break;
            }
        }
        verges
    }
}

/// A higher body that cuts lower facets.
#[derive(Clone, Debug)]
pub(crate) struct Cutter<'f> {
    /// Convex, counter-clockwise.
    pub(crate) body: &'f [DVec2],
    /// Its [`edges`].
    pub(crate) sides: &'f [HalfPlane],
    /// Its upper surface; `None` = it is higher than everything (an upper storey).
    pub(crate) plane: Option<Plane>,
    /// True if it keeps the area that both cover at the same height.
    pub(crate) first: bool,
}

/// Inside where `normal . p >= at`; `normal` has unit length, so values are distances.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HalfPlane {
    normal: DVec2,
    at: f64,
}

impl HalfPlane {
    pub(crate) fn depth(&self, p: DVec2) -> f64 {
        self.normal.dot(p) - self.at
    }

    /// Returns the unit vector across its border to its inside.
    pub(crate) fn inward(&self) -> DVec2 {
        self.normal
    }

    /// Returns the parts of a convex piece inside and outside; one may have no corners.
    pub(crate) fn halves(&self, piece: &[Corner]) -> [Convex; 2] {
        [part(piece, self, 1.0), part(piece, self, -1.0)]
    }

    /// Returns the part of a convex piece inside; it may have no corners.
    pub(crate) fn inside(&self, piece: &[Corner]) -> Convex {
        match piece.iter().all(|c| self.depth(c.at) > -CUT) {
            true => Convex::from_slice(piece),
            false => part(piece, self, 1.0),
        }
    }

    /// Returns the half-plane moved outward by a distance, metres.
    #[must_use]
    pub(crate) fn moved_out(self, by: f64) -> HalfPlane {
        HalfPlane {
            at: self.at - by,
            ..self
        }
    }

    /// Returns the half-plane where `upper` is as high as `lower` or higher.
    pub(crate) fn where_not_lower(upper: Plane, lower: Plane) -> Higher {
        match relative_position(lower, Some(upper)) {
            RelativePosition::Level => Higher::Everywhere,
            _ => HalfPlane::where_higher(upper, lower),
        }
    }

    /// Returns where `upper` is higher than `lower` by more than the tolerance: everywhere, nowhere, or inside a
    /// half-plane.
    pub(crate) fn where_higher(upper: Plane, lower: Plane) -> Higher {
        match relative_position(lower, Some(upper)) {
            RelativePosition::Below => Higher::Everywhere,
            RelativePosition::Above | RelativePosition::Level => Higher::Nowhere,
            RelativePosition::Crossing(side) => Higher::Inside(side),
        }
    }

    /// Returns the half-plane to the left of the line from `p` to `q`.
    pub(crate) fn left_of(p: DVec2, q: DVec2) -> Option<HalfPlane> {
        let normal = (q - p).perp().try_normalize()?;
        Some(HalfPlane {
            normal,
            at: normal.dot(p),
        })
    }
}

/// The area where one plane is higher than another.
pub(crate) enum Higher {
    Everywhere,
    Nowhere,
    Inside(HalfPlane),
}

/// Removes from `pieces` of one facet the area that a cutter covers at a greater height.
pub(crate) fn cut(facet: &Facet, pieces: Vec<Convex>, cutter: &Cutter<'_>) -> Vec<Convex> {
    let higher = match relative_position(facet.plane, cutter.plane) {
        RelativePosition::Above => return pieces,
        RelativePosition::Level if !cutter.first => return cut_verges(facet, pieces, cutter),
        RelativePosition::Below | RelativePosition::Level => None,
        RelativePosition::Crossing(higher) => Some(higher),
    };
    let sides = || higher.iter().chain(cutter.sides);
    // Most nearby roofs do not touch a piece.
    if pieces.iter().all(|p| is_outside(p, sides())) {
        return pieces;
    }
    let mut left = Vec::with_capacity(pieces.len());
    pieces
        .into_iter()
        .for_each(|p| subtract(p, sides(), &mut left));
    left
}

/// Cuts at the same height: a facet keeps its body, and its verges give way to the other's body.
fn cut_verges(facet: &Facet, pieces: Vec<Convex>, cutter: &Cutter<'_>) -> Vec<Convex> {
    let mine = edges(&facet.body);
    let mut left = Vec::with_capacity(pieces.len());
    for piece in pieces {
        let mut verges = Vec::new();
        left.extend(split_off(piece, mine.iter(), &mut verges));
        verges
            .into_iter()
            .for_each(|p| subtract(p, cutter.sides.iter(), &mut left));
    }
    left
}

/// Returns the parts of a piece with `axis . p` above and below a value; one may have no corners.
pub(crate) fn halves(piece: &[Corner], axis: DVec2, at: f64) -> [Convex; 2] {
    HalfPlane { normal: axis, at }.halves(piece)
}

/// The position of a facet relative to a cutter's plane.
enum RelativePosition {
    Below,
    Above,
    Level,
    Crossing(HalfPlane),
}

fn relative_position(mine: Plane, cutter: Option<Plane>) -> RelativePosition {
    let Some(other) = cutter else {
        return RelativePosition::Below;
    };
    let (slope, rise) = (other.slope - mine.slope, other.z - mine.z);
    let steepness = slope.length();
    match steepness < 1e-9 {
        true if rise.abs() < 1e-6 => RelativePosition::Level,
        true if rise > 0.0 => RelativePosition::Below,
        true => RelativePosition::Above,
        false => RelativePosition::Crossing(HalfPlane {
            normal: slope / steepness,
            at: -rise / steepness,
        }),
    }
}

/// Returns the half-planes whose intersection is a convex polygon.
pub(crate) fn edges(polygon: &[DVec2]) -> Sides {
    sides(polygon, |p| *p)
}

/// Returns the half-planes whose intersection is a convex outline.
pub(crate) fn sides_of(outline: &[Corner]) -> Sides {
    sides(outline, |c| c.at)
}

fn sides<T>(polygon: &[T], at: impl Fn(&T) -> DVec2) -> Sides {
    let mut sides = Sides::new();
    for (i, p) in polygon.iter().enumerate() {
        let q = polygon.get(i + 1).unwrap_or(&polygon[0]);
        if let Some(side) = HalfPlane::left_of(at(p), at(q)) {
            sides.push(side);
        }
    }
    sides
}

/// Returns the pieces of `piece` outside the intersection of some half-planes.
pub(crate) fn subtract<'s>(
    piece: Convex,
    sides: impl Iterator<Item = &'s HalfPlane> + Clone,
    left: &mut Vec<Convex>,
) {
    if is_outside(&piece, sides.clone()) {
        return left.push(piece);
    }
    let mut off = Vec::new();
    let inside = split_off(Convex::from_slice(&piece), sides, &mut off).is_some();
    match inside {
        true => left.append(&mut off),
        false => left.push(piece),
    }
}

/// Returns true if a piece lies wholly beyond one of the given sides.
pub(crate) fn is_outside<'s>(
    piece: &[Corner],
    mut sides: impl Iterator<Item = &'s HalfPlane>,
) -> bool {
    sides.any(|h| piece.iter().all(|c| h.depth(c.at) < CUT))
}

/// Returns the part of `piece` inside all half-planes; the rest goes to `off` in convex pieces.
pub(crate) fn split_off<'s>(
    piece: Convex,
    sides: impl Iterator<Item = &'s HalfPlane>,
    off: &mut Vec<Convex>,
) -> Option<Convex> {
    let mut inside = piece;
    for side in sides {
        if inside.iter().all(|c| side.depth(c.at) > -CUT) {
            continue;
        }
        let outer = part(&inside, side, -1.0);
        inside = part(&inside, side, 1.0);
        off.extend((area(&outer) > SLIVER).then_some(outer));
        if area(&inside) <= SLIVER {
            return None;
        }
    }
    Some(inside)
}

/// Returns the part of a convex polygon where `sign * depth >= 0`.
fn part(polygon: &[Corner], side: &HalfPlane, sign: f64) -> Convex {
    let mut kept = Convex::new();
    let Some(first) = polygon.first() else {
        return kept;
    };
    let mut ahead = sign * side.depth(first.at);
    for (i, &p) in polygon.iter().enumerate() {
        let q = *polygon.get(i + 1).unwrap_or(first);
        let (dp, dq) = (ahead, sign * side.depth(q.at));
        ahead = dq;
        if dp > -CUT {
            // An edge that leaves at its very start is replaced by the cut.
            let rim = p.rim && (dp >= CUT || dq > -CUT);
            kept.push(Corner { rim, ..p });
        }
        if (dp >= CUT && dq <= -CUT) || (dp <= -CUT && dq >= CUT) {
            let at = p.at.lerp(q.at, dp / (dp - dq));
            let rim = p.rim && dq > 0.0;
            kept.push(Corner { at, rim });
        }
    }
    kept
}

/// Returns the area of an outline, positive when counter-clockwise, square metres.
pub(crate) fn area(outline: &[Corner]) -> f64 {
    let Some(first) = outline.first() else {
        return 0.0;
    };
    let mut sum = 0.0;
    for w in outline.windows(2) {
        sum += (w[0].at - first.at).perp_dot(w[1].at - first.at);
    }
    sum / 2.0
}

#[cfg(test)]
mod tests {
    use crate::facet::*;
    use glam::dvec2;

    fn square(x0: f64, y0: f64, x1: f64, y1: f64) -> Vec<DVec2> {
        vec![dvec2(x0, y0), dvec2(x1, y0), dvec2(x1, y1), dvec2(x0, y1)]
    }

    fn facet(body: Vec<DVec2>, plane: Plane) -> Facet {
        let corners: Vec<(DVec2, bool)> = body.iter().map(|p| (*p, true)).collect();
        Facet::new(&corners, &body, plane)
    }

    fn rest(mine: &Facet, other: &Facet, first: bool) -> f64 {
        let cutter = Cutter {
            body: &other.body,
            sides: &edges(&other.body),
            plane: Some(other.plane),
            first,
        };
        let pieces = cut(mine, vec![mine.outline.clone()], &cutter);
        pieces.iter().map(|p| area(p)).sum()
    }

    #[test]
    fn the_higher_one_keeps_the_place() {
        let low = facet(square(0.0, 0.0, 4.0, 4.0), Plane::level(1.0));
        let high = facet(square(1.0, 1.0, 2.0, 3.0), Plane::level(2.0));
        assert!((rest(&low, &high, false) - 14.0).abs() < 1e-12);
        assert!((rest(&high, &low, true) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn crossing_planes_meet_in_a_valley() {
        let flat = facet(square(0.0, 0.0, 4.0, 4.0), Plane::level(2.0));
        let rising = facet(
            square(0.0, 0.0, 4.0, 4.0),
            Plane {
                z: 0.0,
                slope: dvec2(1.0, 0.0),
            },
        );
        assert!((rest(&flat, &rising, false) - 8.0).abs() < 1e-12);
        assert!((rest(&rising, &flat, false) - 8.0).abs() < 1e-12);
    }

    #[test]
    fn level_ones_go_to_the_first_but_a_verge_never_wins() {
        let first = facet(square(0.0, 0.0, 4.0, 4.0), Plane::level(2.0));
        let mut other = facet(square(2.0, 0.0, 6.0, 4.0), Plane::level(2.0));
        assert!((rest(&first, &other, false) - 16.0).abs() < 1e-12);
        assert!((rest(&other, &first, true) - 8.0).abs() < 1e-12);
        other.body = square(3.0, 0.0, 6.0, 4.0);
        let verged = Facet {
            body: square(0.0, 0.0, 3.0, 4.0),
            ..first
        };
        assert!((rest(&verged, &other, false) - 12.0).abs() < 1e-12);
    }
}
