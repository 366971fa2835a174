//! The frontage rule of the machiya macro, to the letter (000-44 to 000-49, 000-60).

use crate::shape::{Segment, centroid};
use crate::street::{Piece, nearest};
use glam::DVec2;

/// The least distance of the two vertices of a frontage, metres (000-46, -47).
const LEAST: f64 = 1.2;
/// The greatest angle first - centroid - second, degrees (000-46).
const WIDEST: f64 = 120.0;
/// Rounding of coordinates that decides nothing.
const EXACT: f64 = 1e-9;

/// Returns the frontage among vertices in the order of their distance to the street: the first, and the next one at least
/// 1.2 m from it and at most 120 degrees round the centroid.
pub fn pair(sorted: &[DVec2], centre: DVec2) -> Option<[DVec2; 2]> {
    let first = *sorted.first()?;
    let fits = |p: &&DVec2| {
        let (a, b) = (first - centre, **p - centre);
        let angle = libm::atan2(a.perp_dot(b).abs(), a.dot(b)).to_degrees();
        first.distance(**p) >= LEAST - EXACT && angle <= WIDEST + EXACT
    };
    let second = sorted[1..].iter().find(fits)?;
    Some([first, *second])
}

/// Returns the front of a ring by the published rule, with the house on the left of its direction.
pub fn front(ring: &[DVec2], pieces: &[Piece]) -> Option<Segment> {
    let centre = centroid(ring);
    let mut sorted: Vec<(f64, DVec2)> = vec![];
    for p in ring {
        sorted.push((nearest(pieces, *p)?.distance, *p));
    }
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let sorted: Vec<DVec2> = sorted.into_iter().map(|(_, p)| p).collect();
    let [a, b] = pair(&sorted, centre)?;
    let left = (b - a).perp_dot(centre - a) > 0.0;
    Some(if left {
        Segment::new(a, b)
    } else {
        Segment::new(b, a)
    })
}

/// Returns the published depth: twice the distance of the centroid from the frontage (000-49).
pub fn depth(ring: &[DVec2], front: Segment) -> f64 {
    2.0 * front
        .direction()
        .perp_dot(centroid(ring) - front.from)
        .abs()
}

/// Returns the location-dependent random number from 0 to 99: the last digits of both coordinates at this many decimals.
pub fn rand_loc(at: DVec2, decimals: i32) -> f64 {
    let scale = libm::pow(10.0, f64::from(decimals));
    let digit = |x: f64| (x.abs() * scale + 1e-6).floor() % 10.0;
    10.0 * digit(at.x) + digit(at.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    /// Worked out by hand: centre (0, 0); the first vertex at (0, -2).
    #[test]
    fn limits_count_at_their_borders() {
        let first = dvec2(0.0, -2.0);
        let at = |degrees: f64, far: f64| {
            let turn = (degrees - 90.0).to_radians();
            dvec2(far * libm::cos(turn), far * libm::sin(turn))
        };
        let chosen = |second: DVec2, third: DVec2| {
            pair(&[first, second, third], DVec2::ZERO).map(|[_, b]| b)
        };
        let far = at(90.0, 2.0);
        assert_eq!(
            chosen(dvec2(1.2, -2.0), far),
            Some(dvec2(1.2, -2.0)),
            "1.2 m is enough"
        );
        assert_eq!(chosen(dvec2(1.19, -2.0), far), Some(far), "1.19 m is not");
        let wide = at(120.0, 2.0);
        assert_eq!(chosen(wide, far), Some(wide), "120 degrees are allowed");
        assert_eq!(chosen(at(120.1, 2.0), far), Some(far), "120.1 are not");
        assert_eq!(
            chosen(at(150.0, 2.0), at(180.0, 2.0)),
            None,
            "no model (000-48)"
        );
    }

    #[test]
    fn wide_shallow_houses_lose_their_front_as_published() {
        // 6.0 by 3.4 m: the angle at the centroid over the long side is 120.9 degrees.
        let ring = [
            dvec2(0.0, 0.0),
            dvec2(6.0, 0.0),
            dvec2(6.0, 3.4),
            dvec2(0.0, 3.4),
        ];
        let [a, b] = pair(&[ring[0], ring[1], ring[3], ring[2]], centroid(&ring)).expect("a side");
        assert_eq!([a, b], [ring[0], ring[3]]);
        let front = Segment::new(ring[0], ring[1]);
        assert!((depth(&ring, front) - 3.4).abs() < 1e-9);
    }

    #[test]
    fn digits_of_the_place_are_the_number() {
        assert_eq!(rand_loc(dvec2(12.34, -5.67), 2), 47.0);
        assert_eq!(rand_loc(dvec2(12.34, -5.67), 1), 36.0);
    }
}
