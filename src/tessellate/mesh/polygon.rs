//! Plane polygons into triangles: a fan where they are convex, else ear by ear.

use glam::{DVec2, DVec3};

/// The unit normal of a plane polygon by Newell's sum; zero where it has no area.
pub(in crate::tessellate) fn normal(corners: &[DVec3]) -> DVec3 {
    let mut sum = DVec3::ZERO;
    let origin = corners.first().copied().unwrap_or_default();
    for pair in corners.windows(2).skip(1) {
        sum += (pair[0] - origin).cross(pair[1] - origin);
    }
    sum.normalize_or_zero()
}

/// Twice the area of a triangle below which it is a sliver, square metres.
const SLIVER: f64 = 1e-9;

/// Hands out the triangles of a plane polygon as indices of its corners, in its own sense.
pub(in crate::tessellate) fn triangulate(
    corners: &[DVec3],
    normal: DVec3,
    mut out: impl FnMut([u32; 3]),
) {
    let n = corners.len();
    if n == 3 || is_convex(corners, normal) {
        for i in 1..n as u32 - 1 {
            out([0, i, i + 1]);
        }
        return;
    }
    let (right, up) = crate::tessellate::mesh::axes(normal);
    let flat: Vec<DVec2> = corners
        .iter()
        .map(|p| DVec2::new(right.dot(*p), up.dot(*p)))
        .collect();
    let mut left: Vec<u32> = (0..n as u32).collect();
    while left.len() >= 3 {
        let ear = best_ear(&flat, &left);
        let m = left.len();
        let triangle = [left[(ear + m - 1) % m], left[ear], left[(ear + 1) % m]];
        out(triangle);
        left.remove(ear);
    }
}

/// Whether every corner turns the same way, and none is straight.
fn is_convex(corners: &[DVec3], normal: DVec3) -> bool {
    let [.., before, last] = corners else {
        return false;
    };
    let (mut at, mut way) = (*last, *last - *before);
    corners.iter().all(|next| {
        let ahead = *next - at;
        let bend = normal.dot(way.cross(ahead));
        (at, way) = (*next, ahead);
        bend > SLIVER
    })
}

/// Corners above which the first ear that fits is taken, to stay far from cubic time.
const PATIENCE: usize = 48;

/// The corner to cut off: of all that hold no other corner the roundest, so that points in a straight
/// row are not left to the end as a triangle without area.
fn best_ear(flat: &[DVec2], left: &[u32]) -> usize {
    let n = left.len();
    let mut best = (f64::NEG_INFINITY, 0);
    for i in 0..n {
        let [a, b, c] = [(i + n - 1) % n, i, (i + 1) % n].map(|j| flat[left[j] as usize]);
        let area = (b - a).perp_dot(c - b);
        let longest = (b - a)
            .length_squared()
            .max((c - b).length_squared())
            .max((a - c).length_squared());
        let roundness = area / longest.max(1e-12);
        if roundness <= best.0 || area <= SLIVER && n > 3 {
            continue;
        }
        let blocked = left.iter().any(|&j| {
            let p = flat[j as usize];
            p != a && p != b && p != c && inside(p, a, b, c)
        });
        if !blocked {
            best = (roundness, i);
            if n > PATIENCE {
                break;
            }
        }
    }
    best.1
}

/// Whether a point lies in a counter-clockwise triangle or on its border.
fn inside(p: DVec2, a: DVec2, b: DVec2, c: DVec2) -> bool {
    let left = |q: DVec2, r: DVec2| (r - q).perp_dot(p - q) >= -1e-12;
    left(a, b) && left(b, c) && left(c, a)
}
