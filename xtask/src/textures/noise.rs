//! Periodic random fields: an integer hash on a periodic lattice.
//!
//! Coordinates are fractions of the repeat (1.0 is one repeat), periods are whole lattice cells, so every field is
//! seamless by construction. Only correctly rounded operations are used.

/// Lattice cells in one repeat along `u` and `v`.
pub(super) type Period = (u32, u32);

/// Returns a well-mixed 32-bit hash of a lattice point (finaliser "lowbias32" by C. Wellons).
fn bits(x: i64, y: i64, seed: u32) -> u32 {
    let mut h = (x as u32).wrapping_mul(0x9E37_79B1)
        ^ (y as u32).wrapping_mul(0x85EB_CA77).rotate_left(13)
        ^ seed.wrapping_mul(0xC2B2_AE3D);
    h = (h ^ (h >> 16)).wrapping_mul(0x7FEB_352D);
    h = (h ^ (h >> 15)).wrapping_mul(0x846C_A68B);
    h ^ (h >> 16)
}

/// Returns a pseudo-random number in 0..1 for a lattice point.
pub(super) fn hash(x: i64, y: i64, seed: u32) -> f64 {
    f64::from(bits(x, y, seed)) / 4_294_967_296.0
}

/// Returns the largest integer at or below `x`. `f64::floor` is a call on machines without an instruction for it.
pub(super) fn floor(x: f64) -> i64 {
    let near = x as i64;
    near - i64::from(near as f64 > x)
}

/// Wraps a lattice index into one repeat; most are already in it, and a division is slow.
pub(super) fn wrap(index: i64, cells: i64) -> i64 {
    if (0..cells).contains(&index) {
        index
    } else {
        index.rem_euclid(cells)
    }
}

/// Returns the dot product of a lattice point's random direction with an offset.
fn slope(x: i64, y: i64, seed: u32, dx: f64, dy: f64) -> f64 {
    const H: f64 = std::f64::consts::FRAC_1_SQRT_2;
    match bits(x, y, seed) >> 29 {
        0 => dx,
        1 => -dx,
        2 => dy,
        3 => -dy,
        4 => (dx + dy) * H,
        5 => (dx - dy) * H,
        6 => (dy - dx) * H,
        _ => -(dx + dy) * H,
    }
}

/// The curve 6t^5 - 15t^4 + 10t^3, without kinks at lattice lines (Perlin, 2002).
fn fade(t: f64) -> f64 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

/// Gradient noise, about -1..1.
pub(super) fn noise(u: f64, v: f64, period: Period, seed: u32) -> f64 {
    let (nx, ny) = (i64::from(period.0), i64::from(period.1));
    let (x, y) = (u * nx as f64, v * ny as f64);
    let (cx, cy) = (floor(x), floor(y));
    let (dx, dy) = (x - cx as f64, y - cy as f64);
    let (x0, y0) = (wrap(cx, nx), wrap(cy, ny));
    let (x1, y1) = (wrap(x0 + 1, nx), wrap(y0 + 1, ny));
    let (a, b) = (
        slope(x0, y0, seed, dx, dy),
        slope(x1, y0, seed, dx - 1.0, dy),
    );
    let (c, d) = (
        slope(x0, y1, seed, dx, dy - 1.0),
        slope(x1, y1, seed, dx - 1.0, dy - 1.0),
    );
    let (s, t) = (fade(dx), fade(dy));
    let (low, high) = (a + (b - a) * s, c + (d - c) * s);
    (low + (high - low) * t) * 1.5
}

/// Returns fractal noise: each octave has twice the cells and half the amplitude; about -1..1.
pub(super) fn fbm(u: f64, v: f64, period: Period, octaves: u32, seed: u32) -> f64 {
    let (mut sum, mut strength) = (0.0, 0.5);
    for octave in 0..octaves {
        let cells = (period.0 << octave, period.1 << octave);
        sum += strength * noise(u, v, cells, seed.wrapping_add(octave * 101));
        strength *= 0.5;
    }
    sum * 1.3
}
