//! Foliage: leaves over leaves, as a trimmed tree or hedge shows them from some paces away.

use crate::textures::color::{hex, mix, smooth};
use crate::textures::noise::{fbm, noise};
use crate::textures::paint::{Hollows, Spot, Texel, paint};
use crate::textures::surface::cells::grain;
use crate::textures::{Maps, metres};

/// Three shaku.
const FOLIAGE: f64 = metres("foliage");

/// Leaves in three layers, the lower ones in the shade of the upper. The light is in their colours; the relief is that of the
/// clumps alone, since single leaves would make the largest picture of all.
pub(in crate::textures) fn foliage(size: u32) -> Maps {
    paint(size, FOLIAGE, Hollows::new(0.03, 45.0), foliage_at)
}

/// One spot of [`foliage`].
fn foliage_at(spot: Spot) -> Texel<1> {
    let clump = fbm(spot.u, spot.v, (5, 5), 4, 990);
    let mut light = 0.12;
    for (layer, cells) in [40_u32, 34, 28].into_iter().enumerate() {
        let seed = 991 + 4 * layer as u32;
        let bend = |seed| 0.5 / f64::from(cells) * noise(spot.u, spot.v, (cells, cells), seed);
        let leaf = grain(
            spot.u + bend(seed),
            spot.v + bend(seed + 1),
            (cells, cells),
            seed + 2,
        );
        let lies = leaf.id > 0.2 * layer as f64 + 0.15;
        let inside = if lies {
            smooth(0.03, 0.14, leaf.border)
        } else {
            0.0
        };
        // The rib is paler, and each leaf has its own tone.
        let tone = 0.30 + 0.16 * layer as f64 + 0.35 * (leaf.id * 613.0).fract() - 0.25 * leaf.near;
        light += (tone - light) * inside;
    }
    let light = (light + 0.18 * clump).clamp(0.0, 1.0);
    Texel {
        height: 0.01 * fbm(spot.u, spot.v, (5, 5), 2, 990),
        colors: [mix(hex(0x1F_2C12), hex(0x7C_9146), light)],
        rough: 0.72,
        metal: 0.0,
    }
}

/// Six rows of plants, a foot apart.
const ROWS: f64 = metres("rows");
/// The number of rows, and of plants in a row.
const PLANTS: (u32, u32) = (6, 8);

/// Rows of young plants on wet earth, paler than any leaf: their colour is that of the crop.
pub(in crate::textures) fn rows(size: u32) -> Maps {
    paint(size, ROWS, Hollows::new(0.05, 12.0), rows_at)
}

/// One spot of [`rows`].
fn rows_at(spot: Spot) -> Texel<1> {
    let (across, along) = PLANTS;
    let bend = 0.012 * noise(spot.u, spot.v, (across * 2, along * 2), 1_001);
    let at = |t: f64, n: u32| (t * f64::from(n)).rem_euclid(1.0) - 0.5;
    let (x, y) = (at(spot.u + bend, across), at(spot.v + bend, along));
    // A tuft is a star of blades.
    let angle = libm::atan2(y, x * 1.2);
    let blades = 0.5 + 0.5 * libm::cos(angle * 7.0 + 9.0 * noise(spot.u, spot.v, PLANTS, 1_003));
    let reach = 0.30 + 0.14 * blades + 0.10 * noise(spot.u, spot.v, (across * 3, along * 3), 1_005);
    let far = libm::hypot(x * 1.2, y);
    let leaf = 1.0 - smooth(reach * 0.7, reach, far);
    let soil = fbm(spot.u, spot.v, (8, 8), 3, 1_007);
    let tone = 0.72 + 0.20 * blades - 0.35 * (far / reach.max(0.05)).min(1.0);
    let plant = mix(hex(0x8E_927C), hex(0xFA_FCE8), tone.clamp(0.0, 1.0));
    let ground = mix(hex(0x4A_4238), hex(0x7C_7262), 0.5 + 0.4 * soil);
    Texel {
        // Its light is in its colours, as that of leaves is.
        height: 0.02 * smooth(0.45, 0.0, far),
        colors: [mix(ground, plant, leaf)],
        rough: 0.7,
        metal: 0.0,
    }
}
