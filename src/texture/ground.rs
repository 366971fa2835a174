//! What the house stands on: granite and trodden earth.

use super::Maps;
use super::cells::grain;
use super::color::{Rgb, hex, mix, ramp, scale, smooth};
use super::noise::{fbm, noise};
use super::paint::{Hollows, Spot, Texel, paint};

/// Three shaku.
pub(super) const STONE: f64 = 0.909;
/// Two metres.
pub(super) const EARTH: f64 = 2.0;

/// Feldspar, quartz, mica: the share of each follows the order and number of the entries.
const GRANITE: [Rgb; 7] = [
    hex(0xC6_BFB4),
    hex(0xB4_ADA3),
    hex(0xBF_B2A4),
    hex(0xA3_9F99),
    hex(0x8E_8C88),
    hex(0x6C_6A68),
    hex(0x33_3230),
];

/// Granite dressed with a bush hammer: speckled crystals, pitted face.
pub(super) fn stone(size: u32) -> Maps {
    paint(size, STONE, Hollows::new(0.008, 70.0), stone_at)
}

/// One spot of [`stone`].
fn stone_at(spot: Spot) -> Texel {
    let du = 0.002 * noise(spot.u, spot.v, (160, 160), 901);
    let coarse = grain(spot.u + du, spot.v - du, (140, 140), 902);
    let small = grain(spot.u - du, spot.v + du, (250, 250), 903);
    let id = if coarse.id > 0.45 {
        coarse.id * coarse.id
    } else {
        small.id
    };
    let crystal = GRANITE[((id * 7.0) as usize).min(6)];
    let wide = fbm(spot.u, spot.v, (3, 3), 4, 904);
    let hammered = grain(spot.u, spot.v, (34, 34), 905);
    let pit = 1.0 - smooth(0.0, 0.55, hammered.near);
    let face = fbm(spot.u, spot.v, (7, 7), 4, 906);
    let stain = smooth(0.15, 0.6, fbm(spot.u, spot.v, (4, 3), 4, 907));
    let tone = scale(mix(crystal, hex(0xA8_A299), 0.28), 0.95 + 0.10 * wide);
    Texel {
        height: 0.0035 * face - 0.0012 * pit * hammered.id + 0.0002 * (small.id - 0.5),
        color: mix(tone, hex(0x7A_7464), 0.22 * stain),
        rough: 0.78 + 0.10 * stain - 0.10 * id,
        metal: 0.0,
    }
}

/// A stone in the ground: how much it shows, its dome and its tone.
fn pebble(spot: Spot, cells: u32, share: f64, seed: u32) -> (f64, f64, f64) {
    let du = 0.25 / f64::from(cells) * noise(spot.u, spot.v, (cells * 2, cells * 2), seed);
    let stone = grain(spot.u + du, spot.v - du, (cells, cells), seed + 1);
    let chosen = if stone.id < share {
        0.5 + 0.5 * stone.id / share
    } else {
        0.0
    };
    let size = 0.34 * chosen;
    let shown = if chosen > 0.0 {
        1.0 - smooth(size * 0.8, size, stone.near)
    } else {
        0.0
    };
    let dome = (1.0 - (stone.near / size.max(0.01)).min(1.0))
        .max(0.0)
        .sqrt();
    (shown, dome * shown, chosen * 2.0 - 1.0)
}

/// Trodden earth of a street or court: sand, small stones, damp patches.
pub(super) fn earth(size: u32) -> Maps {
    paint(size, EARTH, Hollows::new(0.015, 45.0), earth_at)
}

/// One spot of [`earth`].
fn earth_at(spot: Spot) -> Texel {
    let soil = [
        hex(0x6E_5B42),
        hex(0x8E_7857),
        hex(0xA6_9170),
        hex(0xB4_A283),
    ];
    let wide = fbm(spot.u, spot.v, (3, 3), 5, 911);
    let lumps = fbm(spot.u, spot.v, (24, 24), 4, 912);
    let sand = noise(spot.u, spot.v, (240, 240), 913);
    let mut height = 0.006 * wide + 0.003 * lumps + 0.0006 * sand;
    let mut color = ramp(&soil, 0.48 + 0.26 * wide + 0.28 * lumps + 0.16 * sand);
    for (cells, share, tall, seed) in [
        (120, 0.22, 0.003, 920),
        (64, 0.12, 0.005, 925),
        (30, 0.05, 0.008, 930),
    ] {
        let (shown, dome, tone) = pebble(spot, cells, share, seed);
        color = mix(
            color,
            mix(hex(0x8A_857A), hex(0xB9_B0A0), tone),
            0.75 * shown,
        );
        height += tall * dome;
    }
    Texel {
        height,
        color,
        rough: 0.95,
        metal: 0.0,
    }
}
