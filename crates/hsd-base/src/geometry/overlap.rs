//! The area that two polygons with holes share.

use crate::geometry::area2;
use glam::DVec2;

/// An area between rings: the triangles from one point to each of their sides, which count for it or against it.
#[derive(Clone, Debug, Default)]
pub struct Area(Vec<Signed>);

/// A counter-clockwise triangle, and 1 or -1.
type Signed = ([DVec2; 3], f64);

impl Area {
    /// Adds a ring in either direction; a hole counts against the rest. `from` is a point near all rings.
    pub fn add(&mut self, ring: &[DVec2], hole: bool, from: DVec2) {
        let turned = (area2(ring) > 0.0) == hole;
        let next = ring.iter().cycle().skip(1);
        for (p, q) in ring.iter().zip(next) {
            let (p, q) = if turned { (*q, *p) } else { (*p, *q) };
            let area = (p - from).perp_dot(q - from);
            if area > 0.0 {
                self.0.push(([from, p, q], 1.0));
            } else if area < 0.0 {
                self.0.push(([from, q, p], -1.0));
            }
        }
    }

    /// Returns the area shared with another. Takes the product of their numbers of sides.
    pub fn shared(&self, other: &Area) -> f64 {
        let pairs = self.0.iter();
        let pairs = pairs.flat_map(|one| other.0.iter().map(move |two| (one, two)));
        let shared = pairs.map(|((one, own), (two, its))| own * its * common(one, two));
        shared.sum()
    }
}

/// Returns the area that two counter-clockwise triangles share.
fn common(one: &[DVec2; 3], two: &[DVec2; 3]) -> f64 {
    let [low, high] = bounds(one);
    let [from, to] = bounds(two);
    if !(low.cmplt(to).all() && from.cmplt(high).all()) {
        return 0.0;
    }
    let mut piece = one.to_vec();
    for side in 0..3 {
        let (p, q) = (two[side], two[(side + 1) % 3]);
        let depth = |c: DVec2| (q - p).perp_dot(c - p);
        let mut inside = Vec::with_capacity(piece.len() + 1);
        for (i, &at) in piece.iter().enumerate() {
            let next = piece[(i + 1) % piece.len()];
            let (here, there) = (depth(at), depth(next));
            if here >= 0.0 {
                inside.push(at);
            }
            if (here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0) {
                inside.push(at.lerp(next, here / (here - there)));
            }
        }
        if inside.len() < 3 {
            return 0.0;
        }
        piece = inside;
    }
    area2(&piece) / 2.0
}

fn bounds(triangle: &[DVec2; 3]) -> [DVec2; 2] {
    let [p, q, r] = *triangle;
    [p.min(q).min(r), p.max(q).max(r)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Heading;
    use glam::dvec2;

    fn square(at: DVec2, side: f64, turn: f64) -> Vec<DVec2> {
        let way = Heading::new(turn).vector();
        let corners = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)];
        corners.map(|(x, y)| at + way.rotate(dvec2(x, y))).to_vec()
    }

    fn shared(one: &[DVec2], hole: &[Vec<DVec2>], two: &[DVec2]) -> f64 {
        let (mut a, mut b) = (Area::default(), Area::default());
        a.add(one, false, DVec2::ZERO);
        hole.iter().for_each(|h| a.add(h, true, DVec2::ZERO));
        b.add(two, false, dvec2(3.0, -1.0));
        assert!((a.shared(&b) - b.shared(&a)).abs() < 1e-9);
        a.shared(&b)
    }

    #[test]
    fn areas_are_shared_whatever_the_walk_and_the_angle() {
        let one = square(DVec2::ZERO, 10.0, 0.0);
        let mut back = one.clone();
        back.reverse();
        let beside = square(dvec2(10.0, 0.0), 10.0, 0.0);
        assert!(shared(&one, &[], &beside).abs() < 1e-9, "a party wall");
        let into = square(dvec2(9.0, 5.0), 10.0, 0.0);
        assert!((shared(&back, &[], &into) - 5.0).abs() < 1e-9);
        let diamond = square(dvec2(5.0, 0.0), 50.0_f64.sqrt(), 45.0);
        assert!((shared(&one, &[], &diamond) - 50.0).abs() < 1e-9);
        let court = square(dvec2(2.0, 2.0), 6.0, 0.0);
        let pavilion = square(dvec2(3.0, 3.0), 4.0, 0.0);
        assert!(shared(&one, &[court], &pavilion) < 1e-9, "in the court");
    }
}
