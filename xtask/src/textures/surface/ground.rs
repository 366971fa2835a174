//! Ground surfaces: granite, gravel, trodden earth, the beaten floor of a passage.

use crate::textures::color::{Rgb, hex, mix, ramp, scale, smooth};
use crate::textures::noise::{fbm, noise};
use crate::textures::paint::{Hollows, Spot, Texel, paint};
use crate::textures::surface::cells::grain;
use crate::textures::{Maps, metres};

/// Three shaku.
const STONE: f64 = metres("stone");
/// Two metres.
const EARTH: f64 = metres("earth");
/// One bay.
const GRAVEL: f64 = metres("gravel");
/// Four shaku.
const DOMA: f64 = metres("doma");

/// Feldspar, quartz, mica: the number of entries gives the share of each.
const GRANITE: [Rgb; 7] = [
    hex(0xC6_BFB4),
    hex(0xB4_ADA3),
    hex(0xBF_B2A4),
    hex(0xA3_9F99),
    hex(0x8E_8C88),
    hex(0x6C_6A68),
    hex(0x33_3230),
];

/// Granite dressed with a bush hammer: speckled crystals, pitted face; old, with moss and black runs.
pub(in crate::textures) fn stone(size: u32) -> Maps {
    paint(size, STONE, Hollows::new(0.008, 70.0), stone_at)
}

/// One spot of [`stone`].
fn stone_at(spot: Spot) -> Texel<2> {
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
    let fresh = mix(tone, hex(0x7A_7464), 0.15 * stain);
    let moss = smooth(
        0.10,
        0.55,
        wide - 0.5 * face + 0.25 * noise(spot.u, spot.v, (80, 80), 908),
    );
    let grime = scale(mix(tone, hex(0x56_5348), 0.35 + 0.25 * stain), 0.88);
    Texel {
        height: 0.0035 * face - 0.0012 * pit * hammered.id + 0.0002 * (small.id - 0.5),
        colors: [fresh, mix(grime, hex(0x58_5E3C), 0.6 * moss)],
        rough: 0.78 + 0.10 * stain - 0.10 * id,
        metal: 0.0,
    }
}

/// Returns the coverage of a stone in the ground, its dome and its tone.
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
pub(in crate::textures) fn earth(size: u32) -> Maps {
    paint(size, EARTH, Hollows::new(0.015, 45.0), earth_at)
}

/// One spot of [`earth`].
fn earth_at(spot: Spot) -> Texel<1> {
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
        colors: [color],
        rough: 0.95,
        metal: 0.0,
    }
}

/// The floor of a passage (tataki): earth, lime and brine beaten hard, polished by feet; later dark and cracked.
pub(in crate::textures) fn doma(size: u32) -> Maps {
    paint(size, DOMA, Hollows::new(0.012, 60.0), doma_at)
}

/// One spot of [`doma`].
fn doma_at(spot: Spot) -> Texel<2> {
    let soil = [hex(0x8A_7A62), hex(0xA2_9278), hex(0xB6_A78E)];
    let wide = fbm(spot.u, spot.v, (3, 3), 5, 941);
    let beaten = fbm(spot.u, spot.v, (12, 12), 3, 942);
    let sand = noise(spot.u, spot.v, (230, 230), 943);
    let mut color = ramp(&soil, 0.5 + 0.24 * wide + 0.20 * beaten + 0.10 * sand);
    for (cells, share, seed) in [(110, 0.30, 950), (58, 0.16, 955)] {
        // Stones lie flush: seen, not felt.
        let (shown, _, tone) = pebble(spot, cells, share, seed);
        color = mix(
            color,
            mix(hex(0x6E_685C), hex(0xC4_BAA6), tone),
            0.6 * shown,
        );
    }
    let trodden = smooth(-0.3, 0.6, wide + 0.4 * beaten);
    let crack = crate::textures::surface::plaster::fine_crack(spot, (4, 4), 960, 0.0018);
    let dark = mix(scale(color, 0.72), hex(0x4A_4034), 0.45 * trodden);
    Texel {
        height: 0.003 * wide + 0.0025 * beaten + 0.000_15 * sand - 0.0008 * crack,
        colors: [
            mix(color, hex(0x6A_5C46), 0.3 * crack),
            mix(dark, hex(0x2A_241C), 0.7 * crack),
        ],
        rough: 0.80 - 0.14 * trodden,
        metal: 0.0,
    }
}

/// River gravel of a rain gutter or a court: rounded stones of 12 to 35 mm, each its own grey.
pub(in crate::textures) fn gravel(size: u32) -> Maps {
    paint(size, GRAVEL, Hollows::new(0.014, 55.0), gravel_at)
}

/// One spot of [`gravel`].
fn gravel_at(spot: Spot) -> Texel<1> {
    const TONES: [Rgb; 6] = [
        hex(0x66_6868),
        hex(0x7C_7E7C),
        hex(0x8A_8984),
        hex(0x98_948A),
        hex(0x8C_8274),
        hex(0xA8_A49A),
    ];
    let mut height = -0.004;
    let mut color = scale(
        hex(0x4A_443A),
        1.0 + 0.3 * noise(spot.u, spot.v, (200, 200), 971),
    );
    // Three sizes poured over each other; the larger lie on top.
    for (layer, cells) in [62_u32, 44, 30].into_iter().enumerate() {
        let seed = 972 + 5 * layer as u32;
        let du = 0.22 / f64::from(cells) * noise(spot.u, spot.v, (cells, cells), seed);
        let dv = 0.22 / f64::from(cells) * noise(spot.u, spot.v, (cells, cells), seed + 1);
        let stone = grain(spot.u + du, spot.v + dv, (cells, cells), seed + 2);
        let lies = if layer == 0 || stone.id > 0.45 {
            1.0
        } else {
            0.0
        };
        let inside =
            smooth(0.04, 0.20, stone.border) * (1.0 - smooth(0.42, 0.54, stone.near)) * lies;
        let dome = (1.0 - (stone.near / 0.60).min(1.0) * (stone.near / 0.60).min(1.0)).sqrt();
        let kind = (stone.id * 977.0).fract();
        let tone = TONES[((kind * 6.0) as usize).min(5)];
        let vein = fbm(spot.u, spot.v, (70, 90), 3, seed + 3);
        color = mix(color, scale(tone, 0.78 + 0.30 * dome + 0.12 * vein), inside);
        let top = 0.003 * layer as f64 + 0.35 / f64::from(cells) * dome;
        height += (top - height) * inside;
    }
    Texel {
        height,
        colors: [color],
        rough: 0.82,
        metal: 0.0,
    }
}

/// Two bays.
const WATER: f64 = metres("water");

/// Water of a river or a pond under an even breeze: what one sees is the sky in its ripples, so its own colour is dark.
pub(in crate::textures) fn water(size: u32) -> Maps {
    paint(size, WATER, Hollows::new(0.2, 0.0), water_at)
}

/// One spot of [`water`].
fn water_at(spot: Spot) -> Texel<1> {
    let swell = fbm(spot.u, spot.v, (5, 3), 2, 981);
    let ripple = noise(spot.u + 0.03 * swell, spot.v, (14, 9), 983);
    let deep = fbm(spot.u, spot.v, (2, 2), 3, 985);
    Texel {
        height: 0.035 * swell + 0.010 * ripple,
        colors: [mix(hex(0x2B_3A36), hex(0x46_554A), 0.5 + 0.5 * deep)],
        rough: 0.12,
        metal: 0.0,
    }
}
