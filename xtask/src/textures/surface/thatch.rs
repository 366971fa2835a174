//! Roofs of grass; `v` points up the slope.

use crate::textures::color::{Rgb, hex, mix, ramp, scale, smooth};
use crate::textures::noise::fbm;
use crate::textures::paint::{Hollows, Spot, Texel, paint};
use crate::textures::surface::cells::Straws;
use crate::textures::{Maps, metres};

/// One metre.
const THATCH: f64 = metres("thatch");

/// Colours of miscanthus from shade to light: cut last winter, weathered, old.
const REED: [[Rgb; 5]; 3] = [
    [
        hex(0x5A_4628),
        hex(0x8A_7042),
        hex(0xB2_9458),
        hex(0xD0_B478),
        hex(0xC4_B080),
    ],
    [
        hex(0x46_3C30),
        hex(0x6A_5C48),
        hex(0x88_785C),
        hex(0xA0_9074),
        hex(0x9C_9384),
    ],
    [
        hex(0x30_2C26),
        hex(0x4A_463C),
        hex(0x66_6054),
        hex(0x7C_766A),
        hex(0x88_8478),
    ],
];

/// Miscanthus thatch (kaya): reeds up the slope, their cut feet showing; old, it bears moss.
pub(in crate::textures) fn thatch(size: u32) -> Maps {
    paint(size, THATCH, Hollows::new(0.012, 45.0), thatch_at)
}

/// One spot of [`thatch`].
fn thatch_at(spot: Spot) -> Texel<3> {
    let wide = fbm(spot.u, spot.v, (4, 4), 4, 401);
    let mut texel = Texel {
        height: -0.008,
        colors: REED.map(|tones| scale(tones[0], 0.75)),
        rough: 0.95,
        metal: 0.0,
    };
    for layer in 0..4 {
        lay_reeds(&mut texel, spot, layer, wide);
    }
    let bed = fbm(spot.u, spot.v, (14, 7), 3, 402);
    texel.height += 0.006 * bed;
    texel.colors = texel.colors.map(|color| scale(color, 1.0 + 0.22 * bed));
    let moss = smooth(0.12, 0.55, fbm(spot.u, spot.v, (5, 4), 5, 403) + 0.3 * bed);
    texel.colors[2] = mix(
        texel.colors[2],
        scale(hex(0x62_6A3A), 0.8 + 0.5 * bed),
        0.7 * moss,
    );
    texel
}

/// Adds a layer of reeds.
fn lay_reeds(texel: &mut Texel<3>, spot: Spot, layer: u32, wide: f64) {
    let reeds = Straws {
        period: (52 + 9 * layer, 13 + layer),
        reach: 0.062,
        width: 0.0062,
        spread: 0.16,
        bow: 0.004,
        seed: 410 + layer,
    };
    let reed = reeds.at(spot);
    let round = (1.0 - reed.across * reed.across).max(0.0).sqrt();
    let tone = 0.18 + 0.10 * f64::from(layer) + 0.42 * reed.id + 0.22 * wide + 0.10 * reed.along;
    // The cut foot: pale rim, dark hollow stem.
    let foot = 1.0 - smooth(-0.95, -0.86, reed.along);
    for (color, tones) in texel.colors.iter_mut().zip(&REED) {
        let stalk = scale(ramp(tones, tone), 0.70 + 0.36 * round);
        *color = mix(*color, mix(stalk, hex(0x2A_2118), 0.75 * foot), reed.cover);
    }
    let top = 0.002 * f64::from(layer) + 0.003 * round - 0.004 * reed.along;
    texel.height += (top - texel.height) * reed.cover;
}
