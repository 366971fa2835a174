//! Barge boards (hafu): bent boards under the edge of a verge (domain.md 4.4: 0.18-0.24 deep, 0.03 thick, plain on
//! houses).

use super::body::Body;
use super::seams::{End, Seam};
use crate::building::Dress;
use crate::material::SurfaceId;
use glam::{DVec2, DVec3};

/// Height of the board, metres, measured upright.
const DEEP: f64 = 0.2;
/// Thickness, metres.
const THICK: f64 = 0.03;
/// How far it stands back from the verge, and from the eaves, metres.
const BACK: f64 = 0.02;
/// How far it reaches into the roof above it, metres.
const SUNK: f64 = 0.01;

/// The least verge that has room for a board, metres.
const LEAST_VERGE: f64 = 0.1;
/// Verges shorter than this in plan have none, metres.
const SHORTEST: f64 = 0.5;

/// The board along a verge.
pub(super) fn boards(seam: &Seam, dress: &Dress, bodies: &mut Vec<Body>) {
    let plan = |i: usize| seam.points[i].truncate();
    let last = seam.points.len() - 1;
    let run = plan(last) - plan(0);
    if dress.verge < LEAST_VERGE || run.length() < SHORTEST {
        return;
    }
    let along = run.normalize_or_zero();
    let out = -along.perp();
    let foot = |i: usize| {
        let deep = match i {
            0 => seam.spans[0].deep[0],
            _ => seam.spans[i - 1].deep[1],
        };
        let at = seam.points[i] - DVec3::Z * (deep - SUNK);
        at + shift(seam, i, along) - (out * BACK).extend(0.0)
    };
    let section = |i: usize| {
        let top = foot(i);
        let by = (out * -THICK).extend(0.0);
        let low = top - DVec3::Z * DEEP;
        vec![top, low, low + by, top + by]
    };
    let sections: Vec<Vec<DVec3>> = (0..=last).map(section).collect();
    bodies.extend(Body::loft(SurfaceId::named("cedar"), &sections));
}

/// How far an end of the board is drawn in along the slope, so that it does not stick out of the eaves.
fn shift(seam: &Seam, i: usize, along: DVec2) -> DVec3 {
    let last = seam.points.len() - 1;
    let (end, beside) = match i {
        0 => (seam.ends[0], 1),
        i if i == last => (seam.ends[1], last - 1),
        _ => return DVec3::ZERO,
    };
    let way = seam.points[beside] - seam.points[i];
    let run = way.truncate().dot(along).abs();
    match end == End::Free && run > BACK {
        true => way * (BACK / run),
        false => DVec3::ZERO,
    }
}
