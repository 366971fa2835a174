//! Plane geometry of outlines: segments, rings, distances. Rings run counter-clockwise and do not repeat their first point.

use glam::DVec2;
use hsd_base::geometry::area2;
use hsd_base::geometry::grid::{Grid, wider};
use hsd_base::geometry::overlap::Area;
use std::collections::BTreeSet;

/// A straight line between two points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Its start.
    pub from: DVec2,
    /// Its end.
    pub to: DVec2,
}

impl Segment {
    /// Creates a segment.
    pub fn new(from: DVec2, to: DVec2) -> Segment {
        Segment { from, to }
    }

    /// Returns its length.
    pub fn length(self) -> f64 {
        self.from.distance(self.to)
    }

    /// Returns its direction; zero for a point.
    pub fn direction(self) -> DVec2 {
        (self.to - self.from).normalize_or_zero()
    }

    /// Returns the normal on its right: outwards, for a side of a ring.
    pub fn normal(self) -> DVec2 {
        let d = self.direction();
        DVec2::new(d.y, -d.x)
    }

    /// Returns its middle.
    pub fn middle(self) -> DVec2 {
        self.from.midpoint(self.to)
    }

    /// Returns the nearest point of it.
    pub fn nearest(self, to: DVec2) -> DVec2 {
        let way = self.to - self.from;
        let square = way.length_squared();
        if square == 0.0 {
            return self.from;
        }
        self.from + way * ((to - self.from).dot(way) / square).clamp(0.0, 1.0)
    }

    /// Returns true if both have a point in common.
    pub fn meets(self, other: Segment) -> bool {
        let side = |s: Segment, p: DVec2| (s.to - s.from).perp_dot(p - s.from);
        let divides = |s: Segment, t: Segment| side(s, t.from) * side(s, t.to) <= 0.0;
        let ([a, b], [c, d]) = (self.bounds(), other.bounds());
        a.cmple(d).all() && c.cmple(b).all() && divides(self, other) && divides(other, self)
    }

    /// Returns the distance between both.
    pub fn distance(self, other: Segment) -> f64 {
        if self.meets(other) {
            return 0.0;
        }
        let ends = [
            self.nearest(other.from).distance(other.from),
            self.nearest(other.to).distance(other.to),
            other.nearest(self.from).distance(self.from),
            other.nearest(self.to).distance(self.to),
        ];
        ends.into_iter().fold(f64::INFINITY, f64::min)
    }

    /// Returns true if a ray from a place to the east crosses it.
    fn is_right_of(self, p: DVec2) -> bool {
        let Segment { from, to } = self;
        let between = (from.y > p.y) != (to.y > p.y);
        between && p.x < from.x + (p.y - from.y) / (to.y - from.y) * (to.x - from.x)
    }

    /// Returns its box.
    pub fn bounds(self) -> [DVec2; 2] {
        [self.from.min(self.to), self.from.max(self.to)]
    }
}

/// Returns the sides of a ring.
pub fn sides(ring: &[DVec2]) -> impl Iterator<Item = Segment> + Clone + '_ {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(p, q)| Segment::new(*p, *q))
}

/// Returns the area of a ring with holes.
pub fn area(ring: &[DVec2], holes: &[Vec<DVec2>]) -> f64 {
    let of = |ring: &[DVec2]| {
        let from = ring.first().copied().unwrap_or_default();
        let about: Vec<DVec2> = ring.iter().map(|p| *p - from).collect();
        area2(&about).abs() / 2.0
    };
    of(ring) - holes.iter().map(|hole| of(hole)).sum::<f64>()
}

/// Returns the centroid of a ring, or of its corners if it has no area.
pub fn centroid(ring: &[DVec2]) -> DVec2 {
    let Some(&from) = ring.first() else {
        return DVec2::ZERO;
    };
    let (mut sum, mut area) = (DVec2::ZERO, 0.0);
    for side in sides(ring) {
        let (p, q) = (side.from - from, side.to - from);
        let cross = p.perp_dot(q);
        sum += (p + q) * cross;
        area += cross;
    }
    match area.abs() > 1e-9 {
        true => from + sum / (3.0 * area),
        false => ring.iter().copied().sum::<DVec2>() / ring.len() as f64,
    }
}

/// Returns true if a point lies in a ring.
pub fn contains(ring: &[DVec2], p: DVec2) -> bool {
    sides(ring).filter(|s| s.is_right_of(p)).count() % 2 == 1
}

/// Returns the distance of a point from the line of a ring.
pub fn distance(ring: &[DVec2], p: DVec2) -> f64 {
    let distances = sides(ring).map(|s| s.nearest(p).distance(p));
    distances.fold(f64::INFINITY, f64::min)
}

/// The sides of the rings of an area, with the index of their boxes.
pub struct Borders {
    sides: Vec<Segment>,
    index: Grid,
    /// East of all of them.
    east: f64,
}

impl Borders {
    /// Prepares an outline and its holes.
    pub fn new<'r>(rings: impl Iterator<Item = &'r Vec<DVec2>>) -> Borders {
        let sides: Vec<Segment> = rings.flat_map(|ring| sides(ring)).collect();
        let index = Grid::new(sides.iter().map(|side| side.bounds()).collect());
        let east = sides.iter().map(|side| side.from.x).fold(0.0, f64::max);
        Borders { sides, index, east }
    }

    /// Returns true if a place lies in the outline and in no hole.
    pub fn contain(&self, p: DVec2) -> bool {
        let ray = [p, DVec2::new(self.east.max(p.x), p.y)];
        let near = self.index.near(ray).into_iter();
        let crossed = near.filter(|n| self.sides[*n as usize].is_right_of(p));
        crossed.count() % 2 == 1
    }

    /// Returns true if a border is no farther than this from a place.
    pub fn reach(&self, p: DVec2, far: f64) -> bool {
        let mut near = self.index.near(wider([p; 2], far)).into_iter();
        near.any(|n| self.sides[n as usize].nearest(p).distance(p) <= far)
    }
}

/// Returns the area that two rings share.
pub fn shared(one: &[DVec2], two: &[DVec2]) -> f64 {
    let from = one.first().copied().unwrap_or_default();
    let (mut a, mut b) = (Area::default(), Area::default());
    a.add(one, false, from);
    b.add(two, false, from);
    a.shared(&b)
}

/// Returns the convex hull of points, counter-clockwise (Andrew 1979).
pub fn hull(points: &[DVec2]) -> Vec<DVec2> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|p, q| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)));
    sorted.dedup();
    let chain = |points: &mut dyn Iterator<Item = &DVec2>| {
        let mut chain: Vec<DVec2> = vec![];
        for p in points {
            while let [.., a, b] = chain[..]
                && (b - a).perp_dot(*p - b) <= 0.0
            {
                chain.pop();
            }
            chain.push(*p);
        }
        chain.pop();
        chain
    };
    let mut around = chain(&mut sorted.iter());
    around.extend(chain(&mut sorted.iter().rev()));
    around
}

/// Returns the angle between two directions, degrees from 0 to 180.
pub fn angle(one: DVec2, two: DVec2) -> f64 {
    libm::atan2(one.perp_dot(two).abs(), one.dot(two)).to_degrees()
}

/// Returns the angle from one direction to another, degrees, positive to the left.
pub fn turn(one: DVec2, two: DVec2) -> f64 {
    libm::atan2(one.perp_dot(two), one.dot(two)).to_degrees()
}

/// Returns the compass direction of a vector, degrees from 0 to 360.
pub fn azimuth(way: DVec2) -> f64 {
    let degrees = libm::atan2(way.x, way.y).to_degrees();
    if degrees < 0.0 {
        degrees + 360.0
    } else {
        degrees
    }
}

/// Returns true if all corners are within 10 degrees of right angles.
pub fn is_orthogonal(ring: &[DVec2]) -> bool {
    const RIGHT: f64 = 10.0;
    let all: Vec<Segment> = sides(ring).collect();
    (0..all.len()).all(|n| {
        let next = &all[(n + 1) % all.len()];
        (angle(all[n].direction(), next.direction()) - 90.0).abs() <= RIGHT
    })
}

/// Removes doubled points, spikes and corners that turn by less than half a degree; returns the ring counter-clockwise and
/// the largest distance that a removed corner had from it.
pub fn cleaned(ring: &[DVec2]) -> Vec<DVec2> {
    const NEAR: f64 = 0.01;
    const STRAIGHT: f64 = 0.5;
    let mut kept: Vec<DVec2> = ring.to_vec();
    kept.dedup_by(|a, b| a.distance(*b) < NEAR);
    while kept.len() > 1 && kept[0].distance(kept[kept.len() - 1]) < NEAR {
        kept.pop();
    }
    let kept_before = kept.len();
    let mut beside: Vec<[usize; 2]> = (0..kept_before)
        .map(|i| [(i + kept_before - 1) % kept_before, (i + 1) % kept_before])
        .collect();
    let (mut left, mut is_left) = (kept_before, vec![true; kept_before]);
    // The corners to look at: at first all, then those beside a removed one.
    let mut open: BTreeSet<usize> = (0..kept_before).collect();
    while left > 3
        && let Some(at) = open.pop_first()
    {
        let [before, after] = beside[at];
        let (p, q, r) = (kept[before], kept[at], kept[after]);
        let turn = angle(q - p, r - q);
        if (STRAIGHT..=180.0 - STRAIGHT).contains(&turn) && q.distance(r) >= NEAR {
            continue;
        }
        (beside[before][1], beside[after][0]) = (after, before);
        (left, is_left[at]) = (left - 1, false);
        open.extend([before, after]);
    }
    let mut is_left = is_left.into_iter();
    kept.retain(|_| is_left.next().unwrap_or(true));
    let from = kept.first().copied().unwrap_or_default();
    let about: Vec<DVec2> = kept.iter().map(|p| *p - from).collect();
    if area2(&about) < 0.0 {
        kept.reverse();
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    #[test]
    fn rings_lose_corners_that_do_not_turn_and_spikes() {
        let square = [
            (0.0, 0.0),
            (4.0, 0.0),
            (8.0, 0.0),
            (8.0, 5.0),
            (0.0, 5.0),
            (0.0, 2.0),
        ];
        let spike = [
            (0.0, 0.0),
            (8.0, 0.0),
            (8.0, 5.0),
            (9.0, 5.0),
            (0.0, 5.0),
            (0.0, 0.0),
        ];
        let corners = [(0.0, 0.0), (8.0, 0.0), (8.0, 5.0), (0.0, 5.0)];
        let ring = |points: &[(f64, f64)]| -> Vec<DVec2> {
            points.iter().map(|(x, y)| dvec2(*x, *y)).collect()
        };
        assert_eq!(cleaned(&ring(&square)), ring(&corners));
        assert_eq!(cleaned(&ring(&spike)), ring(&corners));
    }

    #[test]
    fn the_hull_of_points_is_convex() {
        let points = [
            (0.0, 0.0),
            (2.0, 1.0),
            (4.0, 0.0),
            (4.0, 4.0),
            (1.0, 2.0),
            (0.0, 4.0),
        ];
        let points: Vec<DVec2> = points.iter().map(|(x, y)| dvec2(*x, *y)).collect();
        let corners = [0, 2, 3, 5].map(|n| points[n]);
        assert_eq!(hull(&points), corners);
        assert_eq!(hull(&points[..1]).len(), 0);
    }
}
