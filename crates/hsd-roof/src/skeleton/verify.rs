//! Checks of the faces: polygons that tile the outline, each rising from its own edge.

use super::contour::Contours;
use super::pairs::{Segment, near_pairs};
use super::{Face, Skeleton};
use glam::DVec2;

/// The share of the area that may be missing or covered twice.
const AREA: f64 = 1e-6;
/// The error of a node's distance from its edges, as a share of the plan's size.
const LEVEL: f64 = 1e-6;

/// Returns true if a skeleton is valid for its outline.
pub(super) fn holds(contours: &Contours, skeleton: &Skeleton) -> bool {
    let level = LEVEL * contours.size.max(1.0);
    let mut sum = 0.0;
    for face in &skeleton.faces {
        let area = area(skeleton, face);
        let node = |n: &u32| skeleton.nodes[*n as usize];
        let even = |n: &u32| (face.line.depth(node(n).at) - node(n).time).abs() < level;
        if area < -level * level
            || !face.nodes.iter().all(even)
            || !is_simple(skeleton, face, level)
        {
            return false;
        }
        sum += area;
    }
    let whole = contours.area();
    (sum - whole).abs() <= AREA * whole
}

fn area(skeleton: &Skeleton, face: &Face) -> f64 {
    let place = |n: &u32| skeleton.nodes[*n as usize].at;
    let first = face.nodes.first().map(place).unwrap_or_default();
    let fan = face
        .nodes
        .windows(2)
        .map(|w| (place(&w[0]) - first).perp_dot(place(&w[1]) - first));
    fan.sum::<f64>() / 2.0
}

/// Returns true if no two borders of a face cross by more than `trifle`.
fn is_simple(skeleton: &Skeleton, face: &Face, trifle: f64) -> bool {
    let n = face.nodes.len();
    if n < 4 {
        return true;
    }
    let place = |i: usize| skeleton.nodes[face.nodes[i % n] as usize].at;
    let borders: Vec<Segment> = (0..n).map(|i| [place(i), place(i + 1)]).collect();
    let mut simple = true;
    near_pairs(&borders, 0.0, |i, j| {
        simple = !crosses(borders[i], borders[j], trifle);
        !simple
    });
    simple
}

fn crosses([p, q]: Segment, [r, s]: Segment, trifle: f64) -> bool {
    let beyond = |a: DVec2, b: DVec2, c: DVec2| (b - a).normalize_or_zero().perp_dot(c - a);
    let apart = |a: f64, b: f64| a.min(b) > -trifle || a.max(b) < trifle;
    !apart(beyond(p, q, r), beyond(p, q, s)) && !apart(beyond(r, s, p), beyond(r, s, q))
}
