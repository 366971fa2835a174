//! Fired clay: the sangawara roof, the namako wall, small wall tiles.

use super::Maps;
use super::cells::{grain, row};
use super::color::{hex, lap_shadow, line, mix, ramp, scale, smooth};
use super::noise::{fbm, hash, noise};
use super::paint::{Hollows, Spot, Texel, paint};

/// Eight columns of 265 mm; nine courses of 235.6 mm, where the 53A tile has 235 mm.
pub(super) const KAWARA: f64 = 2.12;
/// Two diagonals of a tile of one shaku (0.303 m x sqrt 2), joint included.
pub(super) const NAMAKO: f64 = 0.857;
/// Eight tiles of 95 mm and sixteen of 45 mm, each with a joint of 5 mm.
pub(super) const TILE: f64 = 0.8;

/// Height in metres of a sangawara across its width, 0..1: the roll lies over the right rim of
/// the neighbour to the left, then the pan sinks and rises again to its own rim.
fn san_profile(at: f64) -> f64 {
    // Crest at 0.17, valley at 0.71 of the width; a step of a tile's thickness at the seam.
    let turn = -0.20 + at * (1.25 - 0.37 * at);
    0.026 * libm::cos(std::f64::consts::TAU * turn)
}

/// Smoked roof tiles (ibushi) laid in straight columns: each tile's foot stands proud of the
/// course below and throws a shadow.
pub(super) fn kawara(size: u32) -> Maps {
    paint(size, KAWARA, Hollows::new(0.05, 9.0), kawara_at)
}

/// One spot of [`kawara`].
fn kawara_at(spot: Spot) -> Texel {
    let tones = [
        hex(0x40_4448),
        hex(0x56_5B60),
        hex(0x6B_7075),
        hex(0x7C_8084),
    ];
    let column = row(spot.u, 8);
    let profile = san_profile(column.at);
    // The foot follows the profile a little, as it is seen from the street.
    let course = row(spot.v + 0.32 * profile / KAWARA, 9);
    let chance = |salt: u32| hash(column.index, course.index, 800 + salt);
    let length = KAWARA / 9.0;
    let skew = 0.004 * (chance(1) - 0.5) * (column.at - 0.5);
    let from_foot = course.at * length;
    let shadow = lap_shadow((1.0 - course.at) * length);
    let seam = line(column.at.min(1.0 - column.at) * 0.265, 0.007, spot.pixel)
        .max(0.65 * smooth(0.90, 1.0, column.at));
    let lip = 1.0 - smooth(0.004, 0.012, from_foot);
    let bloom = fbm(spot.u, spot.v, (4, 4), 4, 811);
    let spots = smooth(0.30, 0.62, fbm(spot.u, spot.v, (28, 28), 3, 812));
    let fine = noise(spot.u, spot.v, (180, 180), 813);
    let tone = 0.42 + 0.30 * (chance(2) - 0.5) + 0.16 * bloom + 0.05 * fine;
    let warm = mix(
        ramp(&tones, tone),
        hex(0x6A_655C),
        0.22 * chance(3) * chance(3),
    );
    let shape = 1.0 + 5.5 * profile;
    let color = scale(
        mix(warm, hex(0x83_857E), 0.35 * spots),
        shape * shadow * (1.0 + 0.16 * lip),
    );
    Texel {
        height: profile + 0.020 * (1.0 - course.at) + skew + 0.0002 * fine,
        color: mix(color, hex(0x14_1517), seam * 0.85),
        rough: 0.50 + 0.14 * chance(4) + 0.22 * spots + 0.08 * bloom,
        metal: 0.0,
    }
}

/// Flat tiles set on the corner (shihan) with half-round plaster joints, 36 mm wide and 18 mm
/// proud.
pub(super) fn namako(size: u32) -> Maps {
    paint(size, NAMAKO, Hollows::new(0.022, 22.0), namako_at)
}

/// One spot of [`namako`].
fn namako_at(spot: Spot) -> Texel {
    let tones = [hex(0x3E_4246), hex(0x52_575C), hex(0x64_696D)];
    let ripple = 0.003 * noise(spot.u, spot.v, (9, 9), 821);
    // Along either axis a repeat crosses two tiles of each diagonal row, four on both.
    let a = row((spot.u + spot.v) / 2.0 + ripple, 4);
    let b = row((spot.u - spot.v) / 2.0 + ripple, 4);
    let tile = 0.303;
    let off = (a.at.min(1.0 - a.at)).min(b.at.min(1.0 - b.at)) * tile;
    let x = (off / 0.018).min(1.0);
    let joint = 1.0 - smooth(0.0172, 0.0172 + spot.pixel, off);
    let chance = hash(
        (a.index + b.index).rem_euclid(4),
        (a.index - b.index).rem_euclid(4),
        822,
    );
    let wide = fbm(spot.u, spot.v, (4, 4), 4, 823);
    let fine = noise(spot.u, spot.v, (180, 180), 824);
    let tone = 0.5 + 0.6 * (chance - 0.5) + 0.3 * wide + 0.06 * fine;
    let grey = ramp(&tones, tone);
    let foot = 1.0 - 0.35 * (1.0 - smooth(0.018, 0.032, off));
    let white = scale(
        hex(0xF0_ECE2),
        0.97 + 0.04 * wide - 0.16 * smooth(0.6, 1.0, x),
    );
    let bulge = 0.018 * (1.0 - x * x).max(0.0).sqrt();
    Texel {
        height: bulge + 0.0006 * wide + 0.000_08 * fine,
        color: mix(scale(grey, foot), white, joint),
        rough: 0.58 + 0.24 * joint + 0.1 * wide,
        metal: 0.0,
    }
}

/// Small ceramic wall tiles of 45 x 95 mm with straight joints, as on fronts of the 1970s.
pub(super) fn tile(size: u32) -> Maps {
    paint(size, TILE, Hollows::new(0.006, 45.0), tile_at)
}

/// One spot of [`tile`].
fn tile_at(spot: Spot) -> Texel {
    let glaze = [
        hex(0xA2_7C5C),
        hex(0xB0_8864),
        hex(0xBC_9874),
        hex(0xAC_8E70),
    ];
    let (column, course) = (row(spot.u, 8), row(spot.v, 16));
    let edge = column.edge().min(course.edge()) * TILE;
    let joint = 1.0 - smooth(0.0025 - spot.pixel / 2.0, 0.0025 + spot.pixel / 2.0, edge);
    let chance = |salt: u32| hash(column.index, course.index, 830 + salt);
    let mottle = fbm(spot.u, spot.v, (40, 40), 3, 835);
    let speck = smooth(0.82, 0.95, grain(spot.u, spot.v, (150, 150), 836).id);
    let fired = scale(
        ramp(&glaze, chance(1)),
        0.97 + 0.10 * (chance(2) - 0.5) + 0.07 * mottle,
    );
    let color = mix(fired, hex(0x5A_4030), 0.35 * speck);
    let tilt = 0.0006 * (chance(3) - 0.5) * (column.at - 0.5)
        + 0.0006 * (chance(4) - 0.5) * (course.at - 0.5);
    Texel {
        height: 0.002 * smooth(0.0015, 0.0055, edge) + tilt + 0.000_06 * mottle,
        color: mix(color, scale(hex(0x9A_948A), 0.95 + 0.1 * mottle), joint),
        rough: 0.30 + 0.55 * joint + 0.05 * mottle,
        metal: 0.0,
    }
}
