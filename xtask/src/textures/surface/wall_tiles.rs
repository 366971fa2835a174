//! Tiles on walls: namako with its plaster joints, small ceramic tiles of later fronts.

use crate::textures::color::{Rgb, hex, mix, ramp, scale, smooth};
use crate::textures::noise::{fbm, hash, noise};
use crate::textures::paint::{Hollows, Spot, Texel, paint};
use crate::textures::surface::cells::{grain, row};
use crate::textures::surface::plaster::runs;
use crate::textures::{Maps, metres};

/// Two diagonals of a tile of one shaku (0.303 m x sqrt 2), joint included.
const NAMAKO: f64 = metres("namako");
/// Eight tiles of 95 mm and sixteen of 45 mm, each with a joint of 5 mm.
const TILE: f64 = metres("tile");

/// Flat tiles set on the corner (shihan) with half-round plaster joints, 36 mm wide and 18 mm
/// proud: new, and with grey joints and dull tiles.
pub(in crate::textures) fn namako(size: u32) -> Maps {
    paint(size, NAMAKO, Hollows::new(0.022, 22.0), namako_at)
}

/// One spot of [`namako`].
fn namako_at(spot: Spot) -> Texel<2> {
    let tones = [hex(0x44_484D), hex(0x56_5B60), hex(0x68_6D72)];
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
    let foot = 1.0 - 0.35 * (1.0 - smooth(0.018, 0.032, off));
    let grey = scale(ramp(&tones, tone), foot);
    let white = scale(
        hex(0xF2_EFE6),
        0.97 + 0.04 * wide - 0.16 * smooth(0.6, 1.0, x),
    );
    let dirt = runs(spot, 825);
    let dusty = mix(grey, hex(0x6E_6A60), 0.35 + 0.3 * wide);
    let stained = mix(
        scale(white, 0.88),
        hex(0x7A_776F),
        0.6 * dirt + 0.2 * smooth(0.3, 1.0, x),
    );
    let bulge = 0.018 * (1.0 - x * x).max(0.0).sqrt();
    Texel {
        height: bulge + 0.0006 * wide + 0.000_08 * fine,
        colors: [mix(grey, white, joint), mix(dusty, stained, joint)],
        rough: 0.58 + 0.24 * joint + 0.1 * wide,
        metal: 0.0,
    }
}

/// Small ceramic wall tiles of 45 x 95 mm with straight joints, as on fronts of the 1970s: brown, brown with
/// dirty joints, white.
pub(in crate::textures) fn tile(size: u32) -> Maps {
    paint(size, TILE, Hollows::new(0.006, 45.0), tile_at)
}

/// One spot of [`tile`].
fn tile_at(spot: Spot) -> Texel<3> {
    const BROWN: [Rgb; 4] = [
        hex(0x8A_5A3E),
        hex(0x9E_6C4A),
        hex(0xAA_7C58),
        hex(0x92_6A50),
    ];
    const WHITE: [Rgb; 3] = [hex(0xD8_D6CE), hex(0xE2_E0D8), hex(0xEA_E8E2)];
    let (column, course) = (row(spot.u, 8), row(spot.v, 16));
    let edge = column.edge().min(course.edge()) * TILE;
    let joint = 1.0 - smooth(0.0025 - spot.pixel / 2.0, 0.0025 + spot.pixel / 2.0, edge);
    let chance = |salt: u32| hash(column.index, course.index, 830 + salt);
    let mottle = fbm(spot.u, spot.v, (40, 40), 3, 835);
    let speck = smooth(0.82, 0.95, grain(spot.u, spot.v, (150, 150), 836).id);
    let glaze = |tones: &[Rgb], lively: f64| {
        let light = 0.97 + lively * (0.10 * (chance(2) - 0.5) + 0.07 * mottle);
        mix(
            scale(ramp(tones, chance(1)), light),
            hex(0x4A_3224),
            lively * 0.35 * speck,
        )
    };
    let grout = scale(hex(0x9A_948A), 0.95 + 0.1 * mottle);
    let brown = glaze(&BROWN, 1.0);
    let dirt = runs(spot, 837);
    let tilt = 0.0006 * (chance(3) - 0.5) * (column.at - 0.5)
        + 0.0006 * (chance(4) - 0.5) * (course.at - 0.5);
    Texel {
        height: 0.002 * smooth(0.0015, 0.0055, edge) + tilt + 0.000_06 * mottle,
        colors: [
            mix(brown, grout, joint),
            mix(
                mix(brown, hex(0x5A_4E44), 0.35 * dirt),
                scale(grout, 0.55),
                joint,
            ),
            mix(glaze(&WHITE, 0.35), scale(grout, 1.06), joint),
        ],
        rough: 0.30 + 0.55 * joint + 0.05 * mottle,
        metal: 0.0,
    }
}
