//! Board roofs held down by battens and stones (ishi-oki, docs/evidence.md 4.3), only on gentle slopes, since stones
//! roll.

use crate::trim::body::Body;
use crate::trim::slope::{Field, places};
use glam::DVec3;
use hsd_ir::material::SurfaceId;

/// Spacing of battens up the slope, metres in plan; half width and height of one.
const APART: f64 = 0.60;
const BATTEN: (f64, f64) = (0.022, 0.026);
/// Spacing of stones, metres.
const STONES: f64 = 0.62;
/// The steepest slope with stones, rise over run.
const STEEPEST: f64 = 0.36;
/// How far battens and stones extend into the slope, metres.
const SUNK: f64 = 0.01;

/// The largest number of stones on a facet, about 750 square metres; real roofs with stones are smaller, and without a
/// limit the number would grow with the square of the lengths in a roof line.
const MANY: f64 = 2000.0;

/// Adds the battens of a facet, and its stones if these are not too many.
pub(super) fn battens(field: &Field, bodies: &mut Vec<Body>) {
    if field.pitch() > STEEPEST {
        return;
    }
    let (half, high) = BATTEN;
    let profile = [(-half, -SUNK), (half, -SUNK), (half, high), (-half, high)];
    let (lo, hi) = field.bounds();
    let rows = ((hi.y - lo.y - 0.3) / APART).floor().clamp(0.0, 200.0) as u32;
    let laid = f64::from(rows) * (hi.x - lo.x) <= MANY * STONES;
    for row in 0..=rows {
        let t = lo.y + 0.18 + APART * f64::from(row);
        bodies.extend(field.bar(SurfaceId::named("cedar_silver"), t, &profile));
        let Some((from, to)) = field.course(t).filter(|_| laid) else {
            continue;
        };
        let shift = if row.is_multiple_of(2) {
            0.0
        } else {
            0.5 * STONES
        };
        for (n, s) in places(from + 0.15, to - 0.15, STONES, shift).enumerate() {
            let chance = |salt: u32| chance(n as u32, row, salt);
            let s = s + 0.12 * (chance(0) - 0.5);
            let size = 0.085 + 0.05 * chance(1);
            bodies.extend(stone(field.point(s, t + half, high), size, 6.3 * chance(2)));
        }
    }
}

/// Builds a flat round stone on a point.
fn stone(at: DVec3, size: f64, turn: f64) -> Option<Body> {
    const SIDES: u32 = 8;
    // Of its corners, as it lay in a river.
    const LONG: [f64; 8] = [1.0, 0.88, 0.97, 1.06, 0.9, 0.95, 1.08, 0.92];
    // Shares of its size: how wide and how high each ring lies.
    let rings = [(0.70, -0.35), (1.0, 0.04), (0.74, 0.42)];
    let ring = |(wide, up): (f64, f64)| -> Vec<DVec3> {
        let corner = |i: u32| {
            let angle = turn + std::f64::consts::TAU * f64::from(i) / f64::from(SIDES);
            let radius = size * wide * LONG[i as usize];
            at + DVec3::new(
                1.2 * radius * libm::cos(angle),
                radius * libm::sin(angle),
                size * up,
            )
        };
        (0..SIDES).map(corner).collect()
    };
    let body = Body::loft(SurfaceId::named("stone"), &rings.map(ring));
    body.map(Body::smooth)
}

/// Returns a pseudo-random number from 0 to 1 for a position.
fn chance(n: u32, row: u32, salt: u32) -> f64 {
    let mut word = n.wrapping_mul(0x9e37_79b9) ^ row.wrapping_mul(0x85eb_ca6b) ^ (salt << 7);
    word = (word ^ (word >> 15)).wrapping_mul(0x2c1b_3c6d);
    word = (word ^ (word >> 12)).wrapping_mul(0x297a_2d39);
    f64::from(word >> 8) / f64::from(1_u32 << 24)
}
