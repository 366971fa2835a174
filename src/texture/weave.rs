//! Thin things of fibre: shoji paper, indigo cotton, rush mats.

use super::Maps;
use super::cells::{Straws, row};
use super::color::{hex, mix, ramp, scale, smooth};
use super::noise::{fbm, hash, noise};
use super::paint::{Hollows, Spot, Texel, paint};

/// Two shaku.
pub(super) const PAPER: f64 = 0.606;
/// 128 threads of 1.25 mm.
pub(super) const CLOTH: f64 = 0.16;
/// 64 ribs of 14.2 mm.
pub(super) const TATAMI: f64 = 0.909;

/// Mulberry paper: warm white with long fibres.
pub(super) fn paper(size: u32) -> Maps {
    paint(size, PAPER, Hollows::new(0.004, 0.0), paper_at)
}

/// One spot of [`paper`].
fn paper_at(spot: Spot) -> Texel {
    let cloud = fbm(spot.u, spot.v, (9, 9), 4, 501);
    let mut color = scale(hex(0xF2_EAD6), 0.985 + 0.030 * cloud);
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
            hex(0xFD_F8EA)
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
    Texel {
        height,
        color,
        rough: 0.88,
        metal: 0.0,
    }
}

/// Cotton dyed with indigo, plain weave: threads over and under, thick and thin by hand spinning.
pub(super) fn cloth(size: u32) -> Maps {
    paint(size, CLOTH, Hollows::new(0.0012, 380.0), cloth_at)
}

/// One spot of [`cloth`].
fn cloth_at(spot: Spot) -> Texel {
    let dye = [
        hex(0x12_1A2E),
        hex(0x1F_2C49),
        hex(0x30_4265),
        hex(0x52_6484),
    ];
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
    let tone = 0.12 + 0.45 * round + 0.28 * (spun - 0.5) + 0.15 * fade;
    Texel {
        height: 0.000_32 * round * (1.0 + 0.25 * slub),
        color: ramp(&dye, tone),
        rough: 0.92,
        metal: 0.0,
    }
}

/// The face of a mat: rush across, tied in ribs.
pub(super) fn tatami(size: u32) -> Maps {
    paint(size, TATAMI, Hollows::new(0.004, 130.0), tatami_at)
}

/// One spot of [`tatami`].
fn tatami_at(spot: Spot) -> Texel {
    let rush = [
        hex(0x96_8C58),
        hex(0xB6_A872),
        hex(0xC8_B884),
        hex(0xB4_A67A),
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
    Texel {
        height: 0.0012 * swell + 0.0004 * (1.0 - y * y),
        color: scale(ramp(&rush, tone), light),
        rough: 0.70,
        metal: 0.0,
    }
}
