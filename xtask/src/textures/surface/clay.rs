//! Walls of earth: the clay of the middle coat with its straw, the fine finish of Juraku.

use crate::textures::color::{hex, mix, ramp, scale, smooth};
use crate::textures::noise::{fbm, noise};
use crate::textures::paint::{Hollows, Spot, Texel, paint};
use crate::textures::surface::cells::{Straw, Straws, grain};
use crate::textures::surface::plaster::{fine_crack, runs};
use crate::textures::{Maps, metres};

/// One metre.
const CLAY: f64 = metres("clay");
/// Two shaku.
const JURAKU: f64 = metres("juraku");

/// Ochre clay (nakanuri) with chopped straw showing: sound, and washed by rain into grooves.
pub(in crate::textures) fn clay(size: u32) -> Maps {
    paint(size, CLAY, Hollows::new(0.006, 120.0), clay_at)
}

/// One spot of [`clay`].
fn clay_at(spot: Spot) -> Texel<2> {
    let tones = [hex(0x97_7B4E), hex(0xB1_9563), hex(0xC4_AA7A)];
    let wide = fbm(spot.u, spot.v, (3, 3), 5, 111);
    let sand = noise(spot.u, spot.v, (210, 210), 112);
    let lumps = fbm(spot.u, spot.v, (40, 40), 2, 113);
    let ground = ramp(&tones, 0.5 + 0.24 * wide + 0.12 * sand + 0.12 * lumps);
    let washed = runs(spot, 120);
    let mut colors = [
        ground,
        scale(mix(ground, hex(0x8E_7A5A), 0.55 * washed), 0.96),
    ];
    let mut height = 0.0014 * wide + 0.0007 * lumps + 0.000_25 * sand - 0.0006 * washed;
    for (seed, cells, reach) in [(114, 14, 0.030), (115, 18, 0.022), (116, 24, 0.016)] {
        let straw = chopped(seed, cells, reach, 0.0034).at(spot);
        let dark = flat_stalk(&straw);
        for (color, share) in colors
            .iter_mut()
            .zip([smooth(0.45, 0.75, straw.id), smooth(0.1, 0.4, straw.id)])
        {
            *color = mix(
                *color,
                mix(hex(0xDE_C88E), hex(0x8E_7040), dark),
                straw.cover * share * 0.85,
            );
        }
        height += 0.0006 * straw.cover * (1.0 - straw.across * straw.across);
    }
    let crack = fine_crack(spot, (4, 4), 117, 0.0016);
    Texel {
        height: height - 0.0012 * crack,
        colors: colors.map(|color| mix(color, hex(0x66_4F30), crack * 0.6)),
        rough: 0.95,
        metal: 0.0,
    }
}

/// Chopped straw in all directions, one piece per cell.
fn chopped(seed: u32, cells: u32, reach: f64, width: f64) -> Straws {
    Straws {
        period: (cells, cells),
        reach,
        width,
        spread: 3.1,
        bow: 0.001,
        seed,
    }
}

/// Returns 0 on a shiny straw, 1 on a dark one, darker towards its edges.
fn flat_stalk(straw: &Straw) -> f64 {
    let dark = smooth(0.80, 0.95, straw.id);
    dark.max(0.5 * straw.across * straw.across)
}

/// The finish of Juraku clay: fine sand and short hemp; old, it shows rust halos ("fireflies").
pub(in crate::textures) fn juraku(size: u32) -> Maps {
    paint(size, JURAKU, Hollows::new(0.004, 160.0), juraku_at)
}

/// One spot of [`juraku`].
fn juraku_at(spot: Spot) -> Texel<2> {
    let tones = [hex(0x98_8258), hex(0xB2_9C72), hex(0xC4_B08A)];
    let wide = fbm(spot.u, spot.v, (3, 3), 4, 151);
    let sand =
        noise(spot.u, spot.v, (250, 250), 152) + 0.7 * noise(spot.u, spot.v, (140, 140), 153);
    let speck = grain(spot.u, spot.v, (90, 90), 154);
    let dark_grain = (1.0 - smooth(0.10, 0.24, speck.near)) * smooth(0.80, 0.86, speck.id);
    let light_grain = (1.0 - smooth(0.12, 0.26, speck.near)) * (1.0 - smooth(0.10, 0.16, speck.id));
    let mut color = ramp(&tones, 0.5 + 0.16 * wide + 0.16 * sand);
    color = mix(color, hex(0x5A_4A34), 0.6 * dark_grain);
    color = mix(color, hex(0xDE_D0AE), 0.6 * light_grain);
    let mut height = 0.0003 * wide + 0.000_28 * sand;
    for (seed, cells) in [(155, 22), (156, 30)] {
        let hemp = chopped(seed, cells, 0.009, 0.0015).at(spot);
        let shown = hemp.cover * smooth(0.35, 0.5, hemp.id);
        color = mix(color, hex(0xE2_D4A8), 0.75 * shown);
        height += 0.0002 * shown;
    }
    // Iron filings rust and bleed into the clay around them.
    let warp = 0.006 * noise(spot.u, spot.v, (40, 40), 157);
    let iron = grain(spot.u + warp, spot.v - warp, (20, 20), 158);
    let rusty = smooth(0.62, 0.9, iron.id);
    let halo = rusty * (1.0 - smooth(0.0, 0.42, iron.near));
    let core = rusty * (1.0 - smooth(0.02, 0.08, iron.near));
    let old = scale(color, 0.90 + 0.06 * wide);
    let old = mix(
        mix(old, hex(0x6E_4A26), 0.6 * halo),
        hex(0x2C_1E14),
        0.85 * core,
    );
    Texel {
        height,
        colors: [color, old],
        rough: 0.93,
        metal: 0.0,
    }
}
