//! Thin things of fibre: shoji paper, dyed cotton, rush mats.

use crate::textures::color::{Rgb, hex, mix, ramp, scale, smooth};
use crate::textures::noise::{fbm, hash, noise};
use crate::textures::paint::{Hollows, Spot, Texel, paint};
use crate::textures::surface::cells::{Straws, row};
use crate::textures::{Maps, metres};

/// Two shaku.
const PAPER: f64 = metres("paper");
/// 128 threads of 1.25 mm.
const CLOTH: f64 = metres("cloth");
/// 64 ribs of 14.2 mm, one mat wide.
const TATAMI: f64 = metres("tatami");

/// Mulberry paper: warm white with long fibres; yellow after two years.
pub(in crate::textures) fn paper(size: u32) -> Maps {
    paint(size, PAPER, Hollows::new(0.004, 0.0), paper_at)
}

/// One spot of [`paper`].
fn paper_at(spot: Spot) -> Texel<2> {
    let cloud = fbm(spot.u, spot.v, (9, 9), 4, 501);
    let flock = fbm(spot.u, spot.v, (30, 30), 3, 506);
    let mut color = scale(hex(0xF2_ECDC), 0.985 + 0.030 * cloud + 0.018 * flock);
    let mut height = 0.000_05 * cloud;
    for (seed, cells, reach) in [
        (502, 9, 0.055),
        (503, 13, 0.038),
        (504, 18, 0.026),
        (505, 18, 0.026),
    ] {
        let hairs = Straws {
            period: (cells, cells),
            reach,
            width: 0.0014,
            spread: 3.1,
            bow: 0.02,
            seed,
        };
        let hair = hairs.at(spot);
        let tint = if hair.id > 0.45 {
            hex(0xFF_FCF2)
        } else {
            hex(0xC9_B893)
        };
        color = mix(
            color,
            tint,
            0.55 * hair.cover * (0.3 + 0.7 * hash((hair.id * 1e6) as i64, 0, seed)),
        );
        height += 0.000_05 * hair.cover;
    }
    let stain = smooth(0.1, 0.7, fbm(spot.u, spot.v, (3, 3), 4, 507));
    let yellow = mix(
        mix(color, hex(0xD8_C08A), 0.45),
        hex(0xB4_9460),
        0.30 * stain,
    );
    Texel {
        height,
        colors: [color, yellow],
        rough: 0.88,
        metal: 0.0,
    }
}

/// Cotton in plain weave: threads over and under, thick and thin by hand spinning. Dyed with indigo and with
/// persimmon, each strong and faded; undyed, bleached and grey.
pub(in crate::textures) fn cloth(size: u32) -> Maps {
    paint(size, CLOTH, Hollows::new(0.0012, 300.0), cloth_at)
}

/// From the valleys between threads to their crests: indigo, persimmon and undyed, each strong, then faded.
const DYES: [[Rgb; 4]; 6] = [
    [
        hex(0x10_182C),
        hex(0x1E_2B48),
        hex(0x30_4265),
        hex(0x54_6786),
    ],
    [
        hex(0x34_425E),
        hex(0x50_6280),
        hex(0x6E_809C),
        hex(0x98_A6B8),
    ],
    [
        hex(0x56_2614),
        hex(0x84_3E20),
        hex(0xA4_5630),
        hex(0xBC_7850),
    ],
    [
        hex(0x76_4C36),
        hex(0x9C_6C50),
        hex(0xB8_8C6E),
        hex(0xCE_AC92),
    ],
    [
        hex(0xB0_A890),
        hex(0xD4_CCB8),
        hex(0xE8_E2D2),
        hex(0xF2_EEE2),
    ],
    [
        hex(0x86_7C66),
        hex(0xAC_A28A),
        hex(0xC6_BCA4),
        hex(0xD4_CCB8),
    ],
];

/// One spot of [`cloth`].
fn cloth_at(spot: Spot) -> Texel<6> {
    let (warp, weft) = (row(spot.u, 128), row(spot.v, 128));
    let over = (warp.index + weft.index) % 2 == 0;
    let (x, y) = (2.0 * warp.at - 1.0, 2.0 * weft.at - 1.0);
    let (across, along) = if over { (x, y) } else { (y, x) };
    let (thread, place, other) = if over {
        (warp.index, spot.v, 511)
    } else {
        (weft.index, spot.u, 512)
    };
    let slub = noise((thread as f64 + 0.5) / 128.0, place, (128, 5), other);
    let spun = hash(thread, 0, other) + 0.5 * slub;
    let round = (1.0 - 0.85 * across * across).max(0.0).sqrt() * (1.0 - 0.35 * along * along);
    let fade = fbm(spot.u, spot.v, (3, 3), 3, 513);
    let tone = 0.12 + 0.45 * round + 0.28 * (spun - 0.5) + 0.10 * fade;
    // Dye leaves the crests of the threads first.
    let rubbed = tone + 0.14 * round - 0.05 * fade;
    Texel {
        height: 0.000_32 * round * (1.0 + 0.25 * slub),
        colors: [
            ramp(&DYES[0], tone),
            ramp(&DYES[1], rubbed),
            ramp(&DYES[2], tone),
            ramp(&DYES[3], rubbed),
            ramp(&DYES[4], tone + 0.1),
            ramp(&DYES[5], rubbed),
        ],
        rough: 0.92,
        metal: 0.0,
    }
}

/// Mats side by side: rush across, tied in ribs, and the cloth that binds the long edges. Green, then straw.
pub(in crate::textures) fn tatami(size: u32) -> Maps {
    paint(size, TATAMI, Hollows::new(0.004, 130.0), tatami_at)
}

/// One spot of [`tatami`].
fn tatami_at(spot: Spot) -> Texel<2> {
    const GREEN: [Rgb; 4] = [
        hex(0x7E_8450),
        hex(0x9A_9E66),
        hex(0xAE_AE78),
        hex(0xA2_A270),
    ];
    const STRAW: [Rgb; 4] = [
        hex(0xA0_8A54),
        hex(0xBE_A66C),
        hex(0xCE_B882),
        hex(0xB8_A274),
    ];
    let rib = row(spot.u, 64);
    let x = 2.0 * rib.at - 1.0;
    let stem = row(
        spot.v + if rib.index % 2 == 0 { 0.0 } else { 0.5 / 170.0 },
        170,
    );
    let y = 2.0 * stem.at - 1.0;
    let chance = hash(
        stem.index,
        (rib.index + 7 * stem.index).rem_euclid(64) / 16,
        521,
    );
    let swell = (1.0 - x * x).max(0.0).sqrt();
    let valley = smooth(0.82, 1.0, x.abs());
    let wide = fbm(spot.u, spot.v, (3, 3), 3, 522);
    let tone = 0.50 + 0.40 * (chance - 0.5) + 0.15 * wide;
    let light = (1.0 - 0.40 * valley) * (1.0 - 0.22 * y * y);
    // 30 mm of cloth either side of the joint between two mats; the joint lies inside the repeat.
    let off = (row(spot.u + 0.25, 1).at - 0.5).abs() * TATAMI;
    let edge = 1.0 - smooth(0.030 - spot.pixel, 0.030, off);
    let gap = 1.0 - smooth(0.0012, 0.0012 + spot.pixel, off);
    let twill = row(spot.u * 2.0 + spot.v, 150).at;
    let cloth = scale(hex(0x22_3034), 0.85 + 0.30 * twill);
    let bound = |tones: &[Rgb], worn: f64| {
        let border = mix(cloth, hex(0x5A_5C54), worn);
        mix(
            mix(scale(ramp(tones, tone), light), border, edge),
            hex(0x0E_0D0B),
            gap,
        )
    };
    let rush_height = 0.0012 * swell + 0.0004 * (1.0 - y * y);
    let cloth_height = 0.0018 + 0.000_15 * twill;
    Texel {
        height: rush_height + (cloth_height - rush_height) * edge - 0.003 * gap,
        colors: [bound(&GREEN, 0.0), bound(&STRAW, 0.25)],
        rough: 0.70 + 0.18 * edge,
        metal: 0.0,
    }
}
