//! Gable walls: what fills the end of a roof from the wall plate to its lower surface.

use super::frame::Frame;
use super::look::Look;
use super::solid::prism;
use crate::building::{Finish, Solid};
use glam::DVec3;

/// Thickness, metres, centred on the wall line.
pub const THICK: f64 = 0.07;

/// So far fills reach into what they meet, metres: no cracks, and no faces in one plane.
pub const SUNK: f64 = 0.01;

/// The triangle at the end of a gable roof: at `u`, `outward` +1 or -1 along u.
pub fn gable_wall(
    frame: &Frame,
    u: f64,
    outward: f64,
    base: f64,
    look: &Look,
    verge: f64,
) -> Solid {
    let (span, rise) = (frame.depth, look.pitch * frame.depth / 2.0);
    let profile = [
        (0.0, base - SUNK),
        (span, base - SUNK),
        (span, base + SUNK),
        (span / 2.0, base + rise + SUNK),
        (0.0, base + SUNK),
    ];
    upright(frame, u, outward, &profile, verge)
}

/// The wedge or trapezoid at the side of a single slope that rises from `base` at v = 0.
pub fn wedge(frame: &Frame, u: f64, outward: f64, base: f64, look: &Look, verge: f64) -> Solid {
    let (depth, rise) = (frame.depth, look.pitch * frame.depth);
    let profile = [
        (0.0, base - SUNK),
        (depth, base - SUNK),
        (depth, base + rise + SUNK),
        (0.0, base + SUNK),
    ];
    upright(frame, u, outward, &profile, verge)
}

/// A wall across u with a profile of (v, z); it never sticks out from under its verge.
fn upright(frame: &Frame, u: f64, outward: f64, profile: &[(f64, f64)], verge: f64) -> Solid {
    let face = u + outward * (THICK / 2.0).min(verge - SUNK / 2.0);
    let by: DVec3 = (frame.along() * (-outward * THICK)).extend(0.0);
    let mut points = [DVec3::ZERO; 5];
    for (point, (v, z)) in points.iter_mut().zip(profile) {
        *point = frame.point(face, *v, *z);
    }
    prism(&points[..profile.len()], by, Finish::Gable)
}

/// A wall along a line from `from` to `to` (lower corners), up to heights over both.
pub fn panel(from: DVec3, to: DVec3, tops: [f64; 2], finish: Finish) -> Solid {
    let across = (to - from).truncate().perp().normalize_or_zero() * THICK;
    let by = across.extend(0.0);
    let (p, q) = (from - by / 2.0, to - by / 2.0);
    let profile = [
        p,
        q,
        q.truncate().extend(tops[1]),
        p.truncate().extend(tops[0]),
    ];
    prism(&profile, by, finish)
}
