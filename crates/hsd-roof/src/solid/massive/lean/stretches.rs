//! The borders of surfaces over one plan, stretch by stretch: where they pass through a corner, and where one surface falls
//! below another, they are divided.

use crate::frame::Plane;
use crate::solid::massive::lean::ROUNDS;
use crate::solid::massive::lean::corners::WELD;
use glam::DVec2;
use hsd_base::geometry::tolerance::JOINT;
use smallvec::SmallVec;

/// A surface that is not upright.
pub(super) struct Surface {
    pub(super) plane: Plane,
    pub(super) kind: Kind,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// The upper surface of slopes.
    Top,
    /// Their lower surface.
    Low,
    Floor,
}

/// A part of a border between two corners: the lower of their numbers, the higher one, that of the surface, and 1 if this lies
/// to the left of the way from the lower corner. One number is sorted in half the time of four.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Stretch(u64);

pub(super) const CORNER_BITS: u32 = 20;
const SURFACE_BITS: u32 = 16;

impl Stretch {
    /// Creates one with its surface to the left.
    pub(super) fn new(from: u32, to: u32, surface: u32) -> Stretch {
        let over = u64::from(from.min(to)) << CORNER_BITS | u64::from(from.max(to));
        let of = u64::from(surface) << 1 | u64::from(from < to);
        Stretch(over << (SURFACE_BITS + 1) | of)
    }

    pub(super) fn over(self) -> (u32, u32) {
        let corner = |shift: u32| (self.0 >> shift) as u32 & ((1 << CORNER_BITS) - 1);
        let second = SURFACE_BITS + 1;
        (corner(second + CORNER_BITS), corner(second))
    }

    pub(super) fn surface(self) -> u32 {
        (self.0 >> 1) as u32 & ((1 << SURFACE_BITS) - 1)
    }

    pub(super) fn is_left(self) -> bool {
        self.0 & 1 == 1
    }

    /// Returns its ends, with the surface to the left of the way from the first.
    fn way(self) -> (u32, u32) {
        let (low, high) = self.over();
        match self.is_left() {
            true => (low, high),
            false => (high, low),
        }
    }

    /// Returns the heights of its surface over both corners.
    pub(super) fn heights(self, surfaces: &[Surface], corners: &[DVec2]) -> [f64; 2] {
        let plane = surfaces[self.surface() as usize].plane;
        let (low, high) = self.over();
        [low, high].map(|corner| plane.at(corners[corner as usize]))
    }
}

/// Returns the parts of some stretches between the corners that they pass through, sorted.
pub(super) fn passing(mut whole: Vec<Stretch>, corners: &[DVec2]) -> Vec<Stretch> {
    whole.sort_unstable();
    let mut parts = Vec::with_capacity(2 * whole.len());
    let mut way: Vec<(f64, u32)> = Vec::with_capacity(8);
    for same in whole.chunk_by(|s, t| s.over() == t.over()) {
        let (low, high) = same[0].over();
        stops(corners, low, high, &mut way);
        for (stretch, pair) in same
            .iter()
            .flat_map(|s| way.windows(2).map(move |p| (s, p)))
        {
            let (from, to) = match stretch.is_left() {
                true => (pair[0].1, pair[1].1),
                false => (pair[1].1, pair[0].1),
            };
            parts.push(Stretch::new(from, to, stretch.surface()));
        }
    }
    parts.sort_unstable();
    parts
}

/// Divides stretches over which one surface falls below another where they cross, as the verge of one roof does the slope of
/// another.
pub(super) fn divide(stretches: &mut Vec<Stretch>, surfaces: &[Surface], corners: &mut Vec<DVec2>) {
    for _ in 0..ROUNDS {
        let mut more = vec![];
        for same in stretches.chunk_by_mut(|s, t| s.over() == t.over()) {
            let Some(at) = crossing(same, surfaces, corners) else {
                continue;
            };
            let middle = corners.len() as u32;
            corners.push(at);
            for stretch in same {
                let ((from, to), surface) = (stretch.way(), stretch.surface());
                *stretch = Stretch::new(from, middle, surface);
                more.push(Stretch::new(middle, to, surface));
            }
        }
        if more.is_empty() {
            return;
        }
        stretches.append(&mut more);
        stretches.sort_unstable();
    }
}

/// Returns the place between two corners where surfaces over the way between them cross.
fn crossing(same: &[Stretch], surfaces: &[Surface], corners: &[DVec2]) -> Option<DVec2> {
    let (low, high) = same.first()?.over();
    let heights = same.iter().map(|s| s.heights(surfaces, corners));
    let heights: SmallVec<[[f64; 2]; 8]> = heights.collect();
    for (n, one) in heights.iter().enumerate() {
        for other in &heights[n + 1..] {
            let [a, b] = [one[0] - other[0], one[1] - other[1]];
            if a.abs().min(b.abs()) > JOINT && (a > 0.0) != (b > 0.0) {
                let (p, q) = (corners[low as usize], corners[high as usize]);
                return Some(p.lerp(q, a / (a - b)));
            }
        }
    }
    None
}

/// Replaces a list by the corners that a line passes through, its ends included, in their order with their places on it.
fn stops(corners: &[DVec2], from: u32, to: u32, way: &mut Vec<(f64, u32)>) {
    let (p, q) = (corners[from as usize], corners[to as usize]);
    let along = q - p;
    let (lo, hi) = (p.min(q) - WELD, p.max(q) + WELD);
    let most = WELD * WELD * along.length_squared();
    way.clear();
    way.push((0.0, from));
    let first = corners.partition_point(|c| c.x < lo.x);
    for (c, n) in corners[first..].iter().zip(first as u32..) {
        if c.x > hi.x {
            break;
        }
        if c.y < lo.y || c.y > hi.y || n == from || n == to {
            continue;
        }
        let off = along.perp_dot(c - p);
        if off * off < most {
            way.push((along.dot(c - p), n));
        }
    }
    if way.len() > 2 {
        way.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    }
    way.push((f64::INFINITY, to));
}
