//! Lime plaster (shikkui): white and trowelled, black and polished.

use crate::textures::color::{hex, line, mix, scale, smooth};
use crate::textures::noise::{fbm, noise};
use crate::textures::paint::{Hollows, Spot, Texel, paint};
use crate::textures::surface::cells::{Straws, grain};
use crate::textures::{Maps, metres};

/// One ken.
const PLASTER: f64 = metres("plaster");
/// One ken.
const BLACK_PLASTER: f64 = metres("black_plaster");

/// White lime plaster, trowelled almost flat: new; with grey runs; stained, cracked, flaked off in patches.
pub(in crate::textures) fn plaster(size: u32) -> Maps {
    paint(size, PLASTER, Hollows::new(0.03, 60.0), plaster_at)
}

/// One spot of [`plaster`].
fn plaster_at(spot: Spot) -> Texel<3> {
    let wide = fbm(spot.u, spot.v, (3, 3), 4, 101);
    let bend = 0.05 * fbm(spot.u, spot.v, (3, 3), 2, 102);
    let sweep = fbm(spot.u + bend, spot.v - 1.6 * bend, (6, 11), 3, 103);
    let marks = trowel(spot, 104).max(trowel(spot, 105));
    let fine = noise(spot.u, spot.v, (230, 230), 106);
    let light = 0.985 + 0.034 * wide + 0.018 * sweep + 0.010 * fine - 0.026 * marks;
    let fresh = scale(
        mix(hex(0xF4_F1E9), hex(0xE4_DDCB), 0.10 + 0.55 * wide),
        light,
    );
    let runs = runs(spot, 110);
    let worn = mix(fresh, hex(0x9A_978F), 0.42 * runs);
    let crack = fine_crack(spot, (5, 5), 117, 0.0014);
    let lost = smooth(
        0.58,
        0.61,
        wide + 0.45 * fbm(spot.u, spot.v, (17, 17), 3, 118),
    );
    let rim = smooth(
        0.52,
        0.58,
        wide + 0.45 * fbm(spot.u, spot.v, (17, 17), 3, 118),
    );
    let clay = scale(
        hex(0xA8_8E62),
        0.95 + 0.2 * fbm(spot.u, spot.v, (60, 60), 2, 119),
    );
    let stained = mix(
        mix(scale(fresh, 0.93), hex(0x86_8278), 0.7 * runs),
        hex(0xB0_A486),
        0.25 + 0.5 * sweep,
    );
    let old = mix(
        mix(stained, hex(0x6E_695F), 0.6 * crack),
        hex(0xD8_D2C4),
        0.5 * rim,
    );
    Texel {
        height: 0.0011 * wide + 0.0006 * sweep + 0.000_04 * fine - 0.0004 * marks - 0.0002 * crack,
        colors: [fresh, worn, mix(old, clay, lost)],
        rough: 0.80 + 0.06 * sweep,
        metal: 0.0,
    }
}

/// Returns the strength of dirty rain runs, 0..1.
pub(in crate::textures) fn runs(spot: Spot, seed: u32) -> f64 {
    let wander = 0.012 * noise(spot.u, spot.v, (5, 5), seed);
    let thin = fbm(spot.u + wander, spot.v, (26, 1), 4, seed + 1);
    let broad = fbm(spot.u, spot.v, (4, 2), 3, seed + 2);
    smooth(-0.10, 0.65, thin + 0.8 * broad)
}

/// The edges a trowel leaves where strokes overlap: faint arcs.
fn trowel(spot: Spot, seed: u32) -> f64 {
    let strokes = Straws {
        period: (5, 5),
        reach: 0.34,
        width: 0.004,
        spread: 3.1,
        bow: 0.09,
        seed,
    };
    let straw = strokes.at(spot);
    straw.cover * (1.0 - straw.along * straw.along) * straw.id
}

/// Shrinkage cracks: the borders of warped grains, broken off here and there.
pub(in crate::textures) fn fine_crack(spot: Spot, cells: (u32, u32), seed: u32, width: f64) -> f64 {
    let du = 0.035 * fbm(spot.u, spot.v, (8, 8), 3, seed);
    let dv = 0.035 * fbm(spot.u, spot.v, (8, 8), 3, seed + 1);
    let border = grain(spot.u + du, spot.v + dv, cells, seed + 2).border;
    let open = smooth(0.10, 0.35, fbm(spot.u, spot.v, (4, 4), 2, seed + 3));
    line(
        border * spot.metres / f64::from(cells.0) * 0.6,
        width,
        spot.pixel,
    ) * open
}

/// Lime with soot, polished by hand to a mirror finish; later with grey bloom.
pub(in crate::textures) fn black_plaster(size: u32) -> Maps {
    paint(
        size,
        BLACK_PLASTER,
        Hollows::new(0.03, 20.0),
        black_plaster_at,
    )
}

/// One spot of [`black_plaster`].
fn black_plaster_at(spot: Spot) -> Texel<2> {
    let wide = fbm(spot.u, spot.v, (3, 3), 4, 141);
    let cloud = fbm(spot.u, spot.v, (9, 7), 4, 142);
    let strokes = trowel(spot, 143).max(trowel(spot, 144));
    let runs = runs(spot, 145);
    let black = scale(
        hex(0x37_3639),
        1.0 + 0.22 * wide + 0.16 * cloud + 0.25 * strokes,
    );
    let bloom = smooth(-0.35, 0.6, cloud + 0.6 * wide);
    let crack = fine_crack(spot, (4, 4), 148, 0.0012);
    let chalky = mix(
        mix(black, hex(0x6A_6866), 0.30 + 0.45 * bloom),
        hex(0x8A_8782),
        0.35 * runs,
    );
    Texel {
        height: 0.0007 * wide + 0.000_15 * cloud - 0.0001 * strokes,
        colors: [black, mix(chalky, hex(0x32_3131), 0.7 * crack)],
        rough: 0.26 + 0.10 * bloom,
        metal: 0.0,
    }
}
