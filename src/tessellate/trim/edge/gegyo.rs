//! Gegyo: the carved pendant under the apex of a gable, 1.0 to 1.5 times as high as the barge boards are deep
//! (docs/evidence.md 4.4). The plain turnip form (kabura) with its hexagonal boss (rokuyo).

use crate::material::SurfaceId;
use crate::scene::Detail;
use crate::tessellate::trim::body::Body;
use glam::{DVec2, DVec3};

/// The right half of the turnip from the head down: shares of its height, to the right and down.
const OUTLINE: [(f64, f64); 10] = [
    (0.30, 0.00),
    (0.46, 0.10),
    (0.52, 0.24),
    (0.46, 0.36),
    (0.56, 0.46),
    (0.54, 0.60),
    (0.40, 0.72),
    (0.22, 0.78),
    (0.14, 0.88),
    (0.06, 1.00),
];

/// Thickness of the board and of the boss in front of it, metres.
const THICK: f64 = 0.045;
const BOSS: f64 = 0.03;

/// Adds a pendant whose top is at `at` on the front of the boards facing `out`, `height` metres high.
pub(in crate::tessellate::trim) fn pendant(
    at: DVec3,
    out: DVec2,
    height: f64,
    detail: Detail,
    bodies: &mut Vec<Body>,
) {
    let finish = SurfaceId::named("cedar");
    let (across, out) = (out.perp().extend(0.0), out.extend(0.0));
    let back = at - out * 0.005;
    let corner = |side: f64, (w, d): &(f64, f64)| {
        back + across * (side * w * height) - DVec3::Z * (d * height)
    };
    let right = OUTLINE.iter().map(|c| corner(1.0, c));
    let left = OUTLINE.iter().rev().map(|c| corner(-1.0, c));
    bodies.extend(Body::sweep(
        finish,
        right.chain(left).collect(),
        out * THICK,
    ));
    if detail < Detail::Everything {
        return;
    }
    let middle = back - DVec3::Z * (0.26 * height) + out * (THICK - 0.005);
    let ring = |i: u32| {
        let angle = std::f64::consts::TAU * (f64::from(i) + 0.5) / 6.0;
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        middle + across * (0.15 * height * cos) + DVec3::Z * (0.15 * height * sin)
    };
    bodies.extend(Body::sweep(finish, (0..6).map(ring).collect(), out * BOSS));
}
