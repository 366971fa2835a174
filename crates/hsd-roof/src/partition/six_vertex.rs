//! The six-vertex algorithm (002-15 to 002-21): the two boxes and the roofs of an outline of six corners.
//!
//! The longest edge carries Box1; of its two neighbours the longer carries Box2, the shorter is the width of
//! Box1; Roof2 runs on over Box1 up to Roof1's ridge. Two things are corrected, as domain 7.4 found them:
//! - The point where Roof2 ends, printed with the corners of the wrong edge in one case, is written without
//!   numbers: C + (F - C) · ½ W_box1 / L_box2, with C the corner that both long edges share and F the other end
//!   of the edge of Box2.
//! - Where Box2 is wider than Box1 its ridge would stand higher, and end in a gable over the other slope of
//!   Roof1. Then the boxes change their parts ([`SixVertex::exchanged`]), which also is the shorter cut.
//!
//! Exact: everything is a whole number of grid steps or of half steps.

use hsd_base::geometry::plan::Cell;

type Point = (i64, i64);

/// The boxes over an outline of six corners; lengths in grid steps, named as in the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SixVertex {
    /// The box under the main roof.
    pub box1: Cell,
    /// The box under the roof that runs into it, shortened by the width of Box1 (002-19).
    pub box2: Cell,
    /// Length of Box1, L_max where it lies on the longest edge (002-15).
    pub l_box1: i128,
    /// Width of Box1 (002-17).
    pub w_box1: i128,
    /// The edge that carries Box2, in full length (002-16).
    pub l_box2: i128,
    /// Width of Box2 (002-18).
    pub w_box2: i128,
    /// The common corner of both edges and their other ends: of Box1, of Box2.
    corner: Point,
    ends: [Point; 2],
}

impl SixVertex {
    /// Returns the boxes of six corners in the order of the walls, either way round from any of them; `None` unless
    /// they form an L with six right angles.
    ///
    /// By the shorter of the two lines that divide it (domain 7.4), by the longest edge if they are equal.
    pub fn divide(corners: &[Point; 6]) -> Option<Self> {
        let found = Self::by_longest_edge(corners)?;
        Some(match found.w_box2 > found.w_box1 {
            true => found.exchanged(),
            false => found,
        })
    }

    /// Returns the boxes exactly as in the paper, Box1 on the longest edge. Of two equal ones the edge with the
    /// larger Box1 counts, then that whose Box1 lies further in front, then to the right.
    pub fn by_longest_edge(corners: &[Point; 6]) -> Option<Self> {
        // The two long edges meet in the corner opposite to the only bend to the other side.
        let bends = (0..6).map(|k| turn(corners[(k + 5) % 6], corners[k], corners[(k + 1) % 6]));
        let bends: Vec<i128> = bends.collect();
        let sum: i128 = bends.iter().sum();
        let inner = bends.iter().position(|&bend| bend == -sum / 4)?;
        if sum.abs() != 4 || bends.contains(&0) {
            return None;
        }
        let at = |k: usize| corners[(inner + k) % 6];
        let (corner, one, other) = (at(3), at(2), at(4));
        // One corner further than the ends of the long edges lie the ends of the widths.
        let (w_one, w_other) = (length(one, at(1)), length(other, at(5)));
        let found = Self::mount(corner, [one, other], [w_one, w_other]);
        let rival = found.exchanged();
        let rank = |six: &Self| (six.l_box1, six.box1.area());
        let first = rank(&found).cmp(&rank(&rival));
        let first = first.then_with(|| rival.box1.key().cmp(&found.box1.key()));
        Some(if first.is_lt() { rival } else { found })
    }

    /// Returns the other division of the outline: Box1 on the edge that carried Box2.
    pub fn exchanged(&self) -> Self {
        let ends = [self.ends[1], self.ends[0]];
        Self::mount(self.corner, ends, [self.w_box2, self.w_box1])
    }

    /// Returns twice the length of Roof2: 2 L_box2 - W_box1 (002-20).
    pub fn roof2_doubled(&self) -> i128 {
        2 * self.l_box2 - self.w_box1
    }

    /// Returns twice the point on the edge of Box2 beside which Roof2 ends, Prf2 (002-21); the ridge end itself lies
    /// half a W_box2 further in.
    pub fn prf2_doubled(&self) -> (i128, i128) {
        let (c, f) = (self.corner, self.ends[1]);
        let twice = |c: i64, f: i64| {
            2 * i128::from(c) + (i128::from(f) - i128::from(c)).signum() * self.w_box1
        };
        (twice(c.0, f.0), twice(c.1, f.1))
    }

    /// Places Box1 on the edge from the corner to the first end, Box2 on the rest of the other edge.
    fn mount(corner: Point, ends: [Point; 2], [w_box1, w_box2]: [i128; 2]) -> Self {
        let [end1, end2] = ends;
        // The extents of Box1 along the edge of Box2, and of Box2 along that of Box1.
        let across = towards(corner, end2, w_box1);
        let aside = towards(corner, end1, w_box2);
        Self {
            box1: between(end1, across),
            box2: between(across, end2_beside(end2, corner, aside)),
            l_box1: length(corner, end1),
            w_box1,
            l_box2: length(corner, end2),
            w_box2,
            corner,
            ends,
        }
    }
}

/// Returns the far corner of Box2: its end, displaced as `aside` is from the corner.
fn end2_beside(end: Point, corner: Point, aside: Point) -> Point {
    if end.0 == corner.0 {
        (aside.0, end.1)
    } else {
        (end.0, aside.1)
    }
}

/// Returns the direction of a right-angle turn, ±1; 0 if the edges continue, reverse, slant or have no length.
fn turn(p: Point, q: Point, r: Point) -> i128 {
    let step = |p: Point, q: Point| {
        let part = |from: i64, to: i64| (i128::from(to) - i128::from(from)).signum();
        (part(p.0, q.0), part(p.1, q.1))
    };
    let ((a, b), (c, d)) = (step(p, q), step(q, r));
    match (a * b, c * d) {
        (0, 0) => a * d - b * c,
        _ => 0,
    }
}

/// Returns the length of an edge along an axis.
fn length(p: Point, q: Point) -> i128 {
    (i128::from(q.0) - i128::from(p.0)).abs() + (i128::from(q.1) - i128::from(p.1)).abs()
}

/// Returns the point at distance `way` from `from` towards `to`, which must be at least that far away.
fn towards(from: Point, to: Point, way: i128) -> Point {
    let part = |from: i64, to: i64| {
        let moved = i128::from(from) + (i128::from(to) - i128::from(from)).signum() * way;
        i64::try_from(moved).unwrap_or(to)
    };
    (part(from.0, to.0), part(from.1, to.1))
}

fn between(p: Point, q: Point) -> Cell {
    Cell {
        a0: p.0.min(q.0),
        b0: p.1.min(q.1),
        a1: p.0.max(q.0),
        b1: p.1.max(q.1),
    }
}
