//! Plane polygons into triangles: a fan where they are convex, else by their ears.

use glam::{DVec2, DVec3};
use hsd_base::geometry::tolerance::EAR;
use hsd_base::geometry::triangulate::ears;
use smallvec::SmallVec;

/// Returns the unit normal of a plane polygon by Newell's method; zero if it has no area.
pub(crate) fn normal(corners: &[DVec3]) -> DVec3 {
    let mut sum = DVec3::ZERO;
    let origin = corners.first().copied().unwrap_or_default();
    for pair in corners.windows(2).skip(1) {
        sum += (pair[0] - origin).cross(pair[1] - origin);
    }
    sum.normalize_or_zero()
}

/// Passes on the triangles of a plane polygon as indices of its corners, in its own sense.
pub(crate) fn triangulate(corners: &[DVec3], normal: DVec3, mut out: impl FnMut([u32; 3])) {
    let n = corners.len();
    if n == 3 || is_convex(corners, normal) {
        for i in 1..n as u32 - 1 {
            out([0, i, i + 1]);
        }
        return;
    }
    let (right, up) = crate::mesh::axes(normal);
    let flat: SmallVec<[DVec2; 16]> = corners
        .iter()
        .map(|p| DVec2::new(right.dot(*p), up.dot(*p)))
        .collect();
    ears(&flat, out);
}

/// Returns true if the polygon is strictly convex: all corners turn the same way and none is straight.
fn is_convex(corners: &[DVec3], normal: DVec3) -> bool {
    let [.., before, last] = corners else {
        return false;
    };
    let (mut at, mut way) = (*last, *last - *before);
    corners.iter().all(|next| {
        let ahead = *next - at;
        let bend = normal.dot(way.cross(ahead));
        (at, way) = (*next, ahead);
        bend > EAR
    })
}
