//! Split bamboo: strips side by side, as in an inu-yarai or a fence.

use crate::textures::color::{Rgb, hex, mix, ramp, scale, smooth};
use crate::textures::noise::{fbm, hash};
use crate::textures::paint::{Hollows, Spot, Texel, paint};
use crate::textures::surface::cells::row;
use crate::textures::{Maps, metres};

/// 24 strips of 37.9 mm (25 to a bay of 3 shaku would be 36.4 mm).
const BAMBOO: f64 = metres("bamboo");

/// Strips upright, their bowed skins outwards, with a node every foot or so: cut green, dried, grey.
pub(in crate::textures) fn bamboo(size: u32) -> Maps {
    paint(size, BAMBOO, Hollows::new(0.010, 40.0), bamboo_at)
}

/// One spot of [`bamboo`].
fn bamboo_at(spot: Spot) -> Texel<3> {
    const GREEN: [Rgb; 3] = [hex(0x5E_7438), hex(0x7E_9250), hex(0xA2_A866)];
    const DRY: [Rgb; 4] = [
        hex(0xA0_8C54),
        hex(0xBE_A66A),
        hex(0xD0_B880),
        hex(0xB4_9C68),
    ];
    const GREY: [Rgb; 3] = [hex(0x62_584A), hex(0x8C_8068), hex(0xA8_9C84)];
    let strip = row(spot.u, 24);
    let chance = |salt: u32| hash(strip.index, 3, 700 + salt);
    let x = 2.0 * strip.at - 1.0;
    // Nodes: three to a repeat, moved from strip to strip as culms differ.
    let node = row(spot.v + chance(1), 3);
    let shift = 0.06 * (hash(strip.index, node.index, 703) - 0.5);
    let from_node = (node.at - 0.5 + shift) * node.width * spot.metres;
    let ridge = libm::exp(-(from_node * from_node) / 0.000_02);
    let groove = libm::exp(-(from_node - 0.007) * (from_node - 0.007) / 0.000_012);
    let gap = smooth(0.90, 0.97, x.abs());
    let streak = fbm(spot.u, spot.v, (96, 3), 3, 705);
    let stain = fbm(spot.u, spot.v, (48, 5), 4, 707);
    let tone = chance(2) + 0.3 * streak + 0.2 * fbm(spot.u, spot.v, (6, 4), 2, 706);
    let skin = |tones: &[Rgb], pale: u32, mould: f64| {
        let mut color = scale(ramp(tones, tone), 1.0 - 0.24 * x * x);
        color = mix(color, hex(0x38_3226), mould * smooth(0.15, 0.55, stain));
        color = mix(color, hex(pale), ridge * 0.6);
        color = mix(color, hex(0x4E_4028), groove * 0.7);
        mix(color, hex(0x1A_140C), gap)
    };
    Texel {
        height: 0.007 * (1.0 - x * x).max(0.0).sqrt() + 0.0016 * ridge - 0.0012 * groove
            + 0.0001 * streak,
        colors: [
            skin(&GREEN, 0xC4_C9A4, 0.0),
            skin(&DRY, 0xDC_CEA6, 0.2),
            skin(&GREY, 0xAE_A490, 0.7),
        ],
        rough: 0.45 + 0.2 * gap + 0.1 * streak,
        metal: 0.0,
    }
}
