//! The one triangulation: any simple polygon, with holes or without, by clipping its roundest ears.

use crate::geometry::tolerance::EAR;
use glam::DVec2;

mod bridge;
mod many;

pub use bridge::bridged;

/// Rings with more corners take the next ear instead of the roundest, to stay far from cubic time.
const MANY: usize = 48;

/// Most rings have at most this many corners; a small array is cheaper to fill and to move.
const FEW: usize = 12;

/// Points nearer to the border of an ear, in twice the area of the triangle they span with it, lie on the border.
const ON_BORDER: f64 = 1e-12;

/// Passes on the triangles of a counter-clockwise ring, as indices of its corners; always two fewer than corners. The
/// ring may pass a place twice, as along a bridge to a hole.
pub fn ears(ring: &[DVec2], mut out: impl FnMut([u32; 3])) {
    let all = 0..ring.len() as u32;
    if ring.len() > MANY {
        let mut cutting = many::Cutting::new(ring);
        (MANY..ring.len()).for_each(|_| out(cutting.cut()));
        Left::<MANY>::of(ring, cutting.rest()).cut_all(out);
    } else if ring.len() > FEW {
        Left::<MANY>::of(ring, all).cut_all(out);
    } else {
        Left::<FEW>::of(ring, all).cut_all(out);
    }
}

/// Returns the triangles of an outline (counter-clockwise) with holes (clockwise), as corners, without slivers.
pub fn triangles(outline: &[DVec2], holes: &[Vec<DVec2>]) -> Vec<[DVec2; 3]> {
    let ring = bridged(outline, holes);
    let mut found = Vec::with_capacity(ring.len());
    ears(&ring, |triangle| {
        let [p, q, r] = triangle.map(|corner| ring[corner as usize]);
        if turn(p, q, r) > EAR {
            found.push([p, q, r]);
        }
    });
    found
}

/// The corners of a ring, of which ears are cut off. What is known of a corner stays until a neighbour of it is cut off, or the
/// corner that its triangle held.
struct Left<const MOST: usize> {
    given: usize,
    /// How many are left, and the index of one of them.
    count: usize,
    any: usize,
    corners: [Known; MOST],
}

/// A corner, and what is known of the triangle it makes with its neighbours.
#[derive(Clone, Copy, Default)]
struct Known {
    number: u32,
    at: DVec2,
    /// The most that cutting it off next may be worth; not a number once it is gone.
    worth: f64,
    before: u8,
    after: u8,
    kind: Kind,
}

#[derive(Clone, Copy, Default, PartialEq)]
enum Kind {
    /// Cut off.
    #[default]
    Gone,
    /// It turns inwards, or it is straight.
    Inward,
    /// Its triangle may hold other corners.
    Unknown,
    /// Its triangle holds none.
    Ear,
    /// Its triangle holds the corner of this index.
    Blocked(u8),
}

impl<const MOST: usize> Left<MOST> {
    /// Takes some corners of a ring, at most `MOST`.
    fn of(ring: &[DVec2], numbers: impl Iterator<Item = u32>) -> Left<MOST> {
        let mut left = Left {
            given: 0,
            count: 0,
            any: 0,
            corners: [Known::default(); MOST],
        };
        for (known, number) in left.corners.iter_mut().zip(numbers) {
            known.number = number;
            known.at = ring[number as usize];
            known.before = left.given.saturating_sub(1) as u8;
            left.given += 1;
            known.after = left.given as u8;
        }
        left.count = left.given;
        if let Some(last) = left.given.checked_sub(1) {
            left.corners[0].before = last as u8;
            left.corners[last].after = 0;
        }
        (0..left.given).for_each(|i| left.look(i));
        left
    }

    /// Cuts ears off until none is left.
    fn cut_all(mut self, mut out: impl FnMut([u32; 3])) {
        while self.count > 2 {
            let ear = self.best();
            out(self.cut(ear));
        }
    }

    /// Returns the indices before and after one.
    fn beside(&self, i: usize) -> [usize; 2] {
        let known = &self.corners[i];
        [known.before, known.after].map(usize::from)
    }

    fn triangle(&self, i: usize) -> [DVec2; 3] {
        let [before, after] = self.beside(i);
        [before, i, after].map(|n| self.corners[n].at)
    }

    fn look(&mut self, i: usize) {
        let (roundness, convex) = shape(self.triangle(i));
        let known = &mut self.corners[i];
        (known.kind, known.worth) = match convex {
            true => (Kind::Unknown, roundness),
            false => (Kind::Inward, worth_blocked(roundness)),
        };
    }

    /// Returns the index of the corner to cut off next: of all whose triangle holds no other corner the roundest, so that
    /// collinear corners are not left to the end as a triangle without area; if there is none, the corner that comes
    /// nearest.
    fn best(&mut self) -> usize {
        loop {
            let mut best = (f64::NEG_INFINITY, self.any);
            for (i, known) in self.corners[..self.given].iter().enumerate() {
                if known.worth > best.0 {
                    best = (known.worth, i);
                }
            }
            let i = best.1;
            if self.corners[i].kind != Kind::Unknown {
                return i;
            }
            let Some(held) = self.held(i) else {
                self.corners[i].kind = Kind::Ear;
                return i;
            };
            self.corners[i].kind = Kind::Blocked(held as u8);
            self.corners[i].worth = worth_blocked(best.0);
        }
    }

    /// Returns the first other corner in the triangle of one. If there are any, one of them turns inwards.
    fn held(&self, i: usize) -> Option<usize> {
        let [p, q, r] = self.triangle(i);
        let inside = |k: &Known| {
            k.kind == Kind::Inward && holds([p, q, r], k.at) && k.at != p && k.at != q && k.at != r
        };
        self.corners[..self.given].iter().position(inside)
    }

    /// Cuts a corner off, and returns it between its neighbours.
    fn cut(&mut self, i: usize) -> [u32; 3] {
        let [before, after] = self.beside(i);
        let numbers = [before, i, after].map(|n| self.corners[n].number);
        self.corners[i].kind = Kind::Gone;
        self.corners[i].worth = f64::NAN;
        self.corners[before].after = after as u8;
        self.corners[after].before = before as u8;
        self.any = after;
        self.count -= 1;
        if self.count > 2 {
            self.look(before);
            self.look(after);
            for n in 0..self.given {
                if self.corners[n].kind == Kind::Blocked(i as u8) {
                    self.look(n);
                }
            }
        }
        numbers
    }
}

/// Returns how round the triangle of a corner is, twice its area by the square of its longest side, and true if it has area
/// and lies to the left of its corners.
#[inline]
fn shape([a, b, c]: [DVec2; 3]) -> (f64, bool) {
    let area = (b - a).perp_dot(c - b);
    let longest = (b - a)
        .length_squared()
        .max((c - b).length_squared())
        .max((a - c).length_squared());
    (area / longest.max(1e-12), area > EAR)
}

/// Returns the worth of a corner that is no ear: less than that of every ear.
fn worth_blocked(roundness: f64) -> f64 {
    match roundness > 0.0 {
        true => -2.0,
        false => roundness - 2.0,
    }
}

/// Returns true if a point lies in a counter-clockwise triangle or on its border.
#[inline]
fn holds([a, b, c]: [DVec2; 3], p: DVec2) -> bool {
    let left = |q: DVec2, r: DVec2| (r - q).perp_dot(p - q) >= -ON_BORDER;
    left(a, b) && left(b, c) && left(c, a)
}

/// Returns twice the area to the left of the path p, q, r.
pub fn turn(p: DVec2, q: DVec2, r: DVec2) -> f64 {
    (q - p).perp_dot(r - p)
}

#[cfg(test)]
pub(in crate::geometry) mod tests {
    use crate::geometry::triangulate::*;
    use glam::dvec2;

    /// Returns an L-shaped outline of 64 square metres, which is not convex.
    pub(in crate::geometry) fn l_shape() -> Vec<DVec2> {
        let corners = [
            (0.0, 0.0),
            (6.0, 0.0),
            (6.0, 4.0),
            (4.0, 4.0),
            (4.0, 14.0),
            (0.0, 14.0),
        ];
        corners.map(DVec2::from).to_vec()
    }

    fn area(triangles: &[[DVec2; 3]]) -> f64 {
        triangles
            .iter()
            .map(|[p, q, r]| turn(*p, *q, *r) / 2.0)
            .sum()
    }

    fn circle(n: usize, radius: f64) -> Vec<DVec2> {
        let at = |i: usize| std::f64::consts::TAU * i as f64 / n as f64;
        (0..n)
            .map(|i| radius * dvec2(libm::cos(at(i)), libm::sin(at(i))))
            .collect()
    }

    /// Returns the outline of a comb that is two metres high and has this number of teeth, counter-clockwise.
    fn comb(teeth: usize) -> Vec<DVec2> {
        let tooth = |i: usize| {
            let x = 2.0 * i as f64;
            [(x + 1.0, 1.0), (x + 1.0, 2.0), (x, 2.0), (x, 1.0)].map(DVec2::from)
        };
        let back = [(0.0, 0.0), (2.0 * teeth as f64 - 1.0, 0.0)].map(DVec2::from);
        let mut ring: Vec<DVec2> = (0..teeth).rev().flat_map(tooth).collect();
        ring.pop();
        ring.remove(0);
        ring.splice(0..0, back);
        ring
    }

    #[test]
    fn rings_of_many_corners_keep_their_area() {
        for teeth in [13, 100, 3_000] {
            let ring = comb(teeth);
            let whole = 2.0 * teeth as f64 - 1.0 + teeth as f64;
            let found = triangles(&ring, &[]);
            let told = (teeth, area(&found), whole);
            assert!((area(&found) - whole).abs() < 1e-6, "{told:?}");
            assert!(found.iter().all(|[p, q, r]| turn(*p, *q, *r) > 0.0));
        }
    }

    #[test]
    fn stars_of_many_corners_keep_their_area() {
        for n in [90, 333, 4_001] {
            let away = |i: usize| 4.0 + ((i * i * 7919) % 101) as f64 / 20.0;
            let star: Vec<DVec2> = (circle(n, 1.0).into_iter().enumerate())
                .map(|(i, p)| p * away(i))
                .collect();
            let whole: f64 = (0..n).map(|i| star[i].perp_dot(star[(i + 1) % n])).sum();
            let found = triangles(&star, &[]);
            assert!((area(&found) - whole / 2.0).abs() < 1e-6, "{n}");
            assert!(found.iter().all(|[p, q, r]| turn(*p, *q, *r) > 0.0));
        }
    }

    #[test]
    fn a_concave_polygon_keeps_its_area() {
        let l = l_shape();
        assert!((area(&triangles(&l, &[])) - 64.0).abs() < 1e-9);
    }

    #[test]
    fn a_ring_without_area_has_no_triangles() {
        let (p, q) = (dvec2(1.0, 2.0), dvec2(4.0, 2.0));
        for ring in [&[][..], &[p], &[p, q], &[p, p, p], &[p, q, p, q]] {
            assert!(triangles(ring, &[]).is_empty(), "{ring:?}");
        }
        // Corners that are no numbers neither end in a loop.
        let lost = [p, q, DVec2::NAN, dvec2(4.0, 9.0)];
        assert!(triangles(&lost, &[]).len() < 3);
    }

    #[test]
    fn rings_keep_their_area() {
        let (outer, inner) = (circle(36, 10.0), circle(24, 4.0));
        let whole = area(&triangles(&outer, &[])) - area(&triangles(&inner, &[]));
        let hole: Vec<DVec2> = inner.into_iter().rev().collect();
        assert!((area(&triangles(&outer, &[hole])) - whole).abs() < 1e-9);
    }

    #[test]
    fn two_holes_keep_their_area() {
        let outer = circle(40, 10.0);
        let hole = |x: f64| {
            circle(8, 2.0)
                .into_iter()
                .rev()
                .map(|p| p + dvec2(x, 0.5))
                .collect::<Vec<_>>()
        };
        let hole_area = area(&triangles(&circle(8, 2.0), &[]));
        let got = area(&triangles(&outer, &[hole(-4.0), hole(4.0)]));
        assert!((got - (area(&triangles(&outer, &[])) - 2.0 * hole_area)).abs() < 1e-9);
    }

    #[test]
    fn many_holes_keep_their_area() {
        for side in [5, 12, 40] {
            let square = |x: f64, y: f64, wide: f64| {
                let corners = [(0.0, 0.0), (wide, 0.0), (wide, wide), (0.0, wide)];
                corners.map(|(a, b)| dvec2(x + a, y + b)).to_vec()
            };
            let places = (0..side * side).map(|n| (n % side, n / side));
            let holes = places.map(|(x, y)| {
                let mut hole = square(3.0 * f64::from(x), 3.0 * f64::from(y), 1.0);
                hole.reverse();
                hole
            });
            let holes: Vec<Vec<DVec2>> = holes.collect();
            let wide = 3.0 * f64::from(side);
            let found = triangles(&square(-1.0, -1.0, wide), &holes);
            let whole = wide * wide - f64::from(side * side);
            assert!((area(&found) - whole).abs() < 1e-6, "{side}");
        }
    }
}
