//! Gegyo: the carved pendant under the apex of a gable, 1.0 to 1.5 times as high as the barge boards are deep
//! (docs/evidence.md 4.4), with its hexagonal boss (rokuyo). Three kinds by the size of the gable: plain ume-bachi, the
//! turnip (kabura), and the triple turnip (mitsubana) of great halls.

use crate::trim::TrimContext;
use crate::trim::body::Body;
use glam::{DVec2, DVec3};
use hsd_scene::Detail;

/// The right half of a pendant from the head down: shares of its height, to the right and down.
type Outline = &'static [(f64, f64)];

/// 梅鉢: a plain board with rounded flanks.
const UME_BACHI: Outline = &[
    (0.34, 0.00),
    (0.50, 0.12),
    (0.56, 0.34),
    (0.50, 0.56),
    (0.34, 0.72),
    (0.14, 0.84),
    (0.05, 1.00),
];
/// 蕪: a turnip.
const KABURA: Outline = &[
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
/// 三花: a turnip below, and one on either side.
const MITSUBANA: Outline = &[
    (0.26, 0.00),
    (0.40, 0.08),
    (0.46, 0.18),
    (0.64, 0.20),
    (0.88, 0.30),
    (1.02, 0.46),
    (1.06, 0.58),
    (0.92, 0.62),
    (0.74, 0.58),
    (0.52, 0.52),
    (0.44, 0.58),
    (0.52, 0.68),
    (0.50, 0.80),
    (0.36, 0.88),
    (0.20, 0.92),
    (0.12, 0.96),
    (0.05, 1.06),
];
/// Half the width in plan from which gables have a turnip, and three, metres.
const TURNIP: f64 = 2.0;
const TRIPLE: f64 = 5.0;

/// Thickness of the board and of the boss in front of it, metres.
const THICK: f64 = 0.045;
const BOSS: f64 = 0.03;

/// Adds a pendant whose top is at `at` on the front of the boards facing `out`, `height` metres high, under a gable `half`
/// metres from apex to foot in plan.
pub(in crate::trim) fn pendant(
    context: &TrimContext<'_>,
    (at, out): (DVec3, DVec2),
    (height, half): (f64, f64),
    bodies: &mut Vec<Body>,
) {
    let finish = context.timber();
    let (across, out) = (out.perp().extend(0.0), out.extend(0.0));
    let back = at - out * 0.005;
    let corner = |side: f64, (w, d): &(f64, f64)| {
        back + across * (side * w * height) - DVec3::Z * (d * height)
    };
    let outline = match half {
        small if small < TURNIP => UME_BACHI,
        middle if middle < TRIPLE => KABURA,
        _ => MITSUBANA,
    };
    let right = outline.iter().map(|c| corner(1.0, c));
    let left = outline.iter().rev().map(|c| corner(-1.0, c));
    bodies.extend(Body::sweep(
        finish,
        right.chain(left).collect(),
        out * THICK,
    ));
    if context.detail < Detail::Everything {
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
