//! Outlines round a house: the outline of its walls, moved outwards.

use super::metres;
use glam::{DVec2, dvec2};
use hsd_base::geometry::area2;
use hsd_ir::building::{House, Ring};

/// Returns the corners of a ring in the house frame, counter-clockwise, metres.
pub(super) fn outline(house: &House, ring: &Ring) -> Vec<DVec2> {
    let corners = ring.corners();
    let mut points: Vec<DVec2> = corners.iter().map(|p| metres(house, *p)).collect();
    if area2(&points) < 0.0 {
        points.reverse();
    }
    points
}

/// Moves a counter-clockwise outline outwards by these distances along x and y. If it would cross itself, in narrow
/// courts that open outwards, returns its bounding rectangle.
pub(super) fn moved(points: &[DVec2], by: DVec2) -> Vec<DVec2> {
    let n = points.len();
    let edge = |i: usize| (points[(i + 1) % n] - points[i % n]).normalize_or_zero();
    let shift = |way: DVec2| {
        let out = dvec2(way.y, -way.x);
        out * (out * by).length()
    };
    let corner = |i: usize| {
        let (before, after) = (edge(i + n - 1), edge(i));
        let (p, q) = (points[i] + shift(before), points[i] + shift(after));
        let turn = before.perp_dot(after);
        match turn.abs() < 1e-6 {
            true => q,
            false => p + before * ((q - p).perp_dot(after) / turn),
        }
    };
    let made: Vec<DVec2> = (0..n).map(corner).collect();
    let keeps = (0..n).all(|i| (made[(i + 1) % n] - made[i]).dot(edge(i)) >= 0.0);
    if keeps && area2(&made) > 0.0 {
        return made;
    }
    let (lo, hi) = bounds(points);
    let (lo, hi) = (lo - by, hi + by);
    vec![lo, dvec2(hi.x, lo.y), hi, dvec2(lo.x, hi.y)]
}

/// Returns the bounding rectangle of some points.
pub(super) fn bounds(points: &[DVec2]) -> (DVec2, DVec2) {
    let lo = points.iter().copied().fold(DVec2::INFINITY, DVec2::min);
    let hi = points.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
    (lo, hi)
}

/// Returns the longest edge of a counter-clockwise outline that faces this way, by its two corners.
pub(super) fn facing(points: &[DVec2], way: DVec2) -> Option<(DVec2, DVec2)> {
    let n = points.len();
    let edges = (0..n).map(|i| (points[i], points[(i + 1) % n]));
    let looks = |p: DVec2, q: DVec2| {
        let along = (q - p).normalize_or_zero();
        dvec2(along.y, -along.x).dot(way) > 0.7
    };
    let facing = edges.filter(|(p, q)| looks(*p, *q));
    facing.reduce(|a, b| {
        if b.0.distance(b.1) > a.0.distance(a.1) + 1e-9 {
            b
        } else {
            a
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(points: &[DVec2]) -> f64 {
        area2(points) / 2.0
    }

    fn polygon(points: &[(f64, f64)]) -> Vec<DVec2> {
        points.iter().map(|(x, y)| dvec2(*x, *y)).collect()
    }

    #[test]
    fn outlines_move_by_their_margins() {
        let square = polygon(&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]);
        assert_eq!(area(&moved(&square, dvec2(1.0, 2.0))), 6.0 * 8.0);
        let corner = polygon(&[
            (0.0, 0.0),
            (6.0, 0.0),
            (6.0, 3.0),
            (3.0, 3.0),
            (3.0, 6.0),
            (0.0, 6.0),
        ]);
        assert_eq!(area(&moved(&corner, dvec2(1.0, 1.0))), 64.0 - 9.0);
    }

    #[test]
    fn narrow_courts_are_filled() {
        let court = polygon(&[
            (0.0, 0.0),
            (6.0, 0.0),
            (6.0, 6.0),
            (4.0, 6.0),
            (4.0, 2.0),
            (2.0, 2.0),
            (2.0, 6.0),
            (0.0, 6.0),
        ]);
        assert_eq!(area(&moved(&court, dvec2(1.5, 1.5))), 81.0);
    }
}
