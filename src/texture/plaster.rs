//! What a trowel or a form leaves: lime plaster, clay, mortar, concrete.

use super::Maps;
use super::cells::{Straws, grain, row};
use super::color::{hex, line, mix, ramp, scale, smooth};
use super::noise::{fbm, noise};
use super::paint::{Hollows, Spot, Texel, paint};

/// One ken.
pub(super) const PLASTER: f64 = 1.818;
/// One metre.
pub(super) const CLAY: f64 = 1.0;
/// One metre.
pub(super) const MORTAR: f64 = 1.0;
/// Two form panels of 0.9 x 1.8 m.
pub(super) const CONCRETE: f64 = 1.8;

/// White lime plaster (shikkui), trowelled almost flat.
pub(super) fn plaster(size: u32) -> Maps {
    paint(size, PLASTER, Hollows::new(0.03, 60.0), plaster_at)
}

/// One spot of [`plaster`].
fn plaster_at(spot: Spot) -> Texel {
    let wide = fbm(spot.u, spot.v, (3, 3), 4, 101);
    let bend = 0.05 * fbm(spot.u, spot.v, (3, 3), 2, 102);
    let sweep = fbm(spot.u + bend, spot.v - 1.6 * bend, (6, 11), 3, 103);
    let marks = trowel(spot, 104).max(trowel(spot, 105));
    let fine = noise(spot.u, spot.v, (230, 230), 106);
    let light = 0.985 + 0.022 * wide + 0.012 * sweep + 0.008 * fine - 0.022 * marks;
    Texel {
        height: 0.0011 * wide + 0.0006 * sweep + 0.000_04 * fine - 0.0004 * marks,
        color: scale(mix(hex(0xF2_EFE6), hex(0xE6_E0D0), 0.5 * wide), light),
        rough: 0.80 + 0.06 * sweep,
        metal: 0.0,
    }
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

/// Ochre clay (nakanuri, arakabe) with chopped straw showing.
pub(super) fn clay(size: u32) -> Maps {
    paint(size, CLAY, Hollows::new(0.006, 120.0), clay_at)
}

/// One spot of [`clay`].
fn clay_at(spot: Spot) -> Texel {
    let tones = [hex(0x97_7B4E), hex(0xB5_9A6A), hex(0xC6_AD7E)];
    let wide = fbm(spot.u, spot.v, (3, 3), 5, 111);
    let sand = noise(spot.u, spot.v, (210, 210), 112);
    let lumps = fbm(spot.u, spot.v, (40, 40), 2, 113);
    let mut color = ramp(&tones, 0.5 + 0.28 * wide + 0.12 * sand + 0.12 * lumps);
    let mut height = 0.0014 * wide + 0.0007 * lumps + 0.000_25 * sand;
    for (seed, cells, reach) in [(114, 18, 0.030), (115, 22, 0.022), (116, 28, 0.018)] {
        let layer = Straws {
            period: (cells, cells),
            reach,
            width: 0.003,
            spread: 3.1,
            bow: 0.004,
            seed,
        };
        let straw = layer.at(spot);
        let shown = straw.cover * smooth(-0.3, 0.4, lumps + straw.id - 0.5);
        color = mix(
            color,
            mix(hex(0xDC_C68E), hex(0x86_6A3C), straw.id),
            shown * 0.75,
        );
        height += 0.0006 * shown * (1.0 - straw.across * straw.across);
    }
    let crack = fine_crack(spot, (4, 4), 117, 0.0016);
    Texel {
        height: height - 0.0012 * crack,
        color: mix(color, hex(0x66_4F30), crack * 0.6),
        rough: 0.95,
        metal: 0.0,
    }
}

/// Shrinkage cracks: the borders of warped grains, broken off here and there.
fn fine_crack(spot: Spot, cells: (u32, u32), seed: u32, width: f64) -> f64 {
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

/// Sprayed cement mortar of a kanban front: coarse, grey, streaked, with hair cracks.
pub(super) fn mortar(size: u32) -> Maps {
    paint(size, MORTAR, Hollows::new(0.004, 160.0), mortar_at)
}

/// One spot of [`mortar`].
fn mortar_at(spot: Spot) -> Texel {
    let wide = fbm(spot.u, spot.v, (3, 2), 4, 121);
    let streak = fbm(spot.u, spot.v, (22, 2), 3, 122);
    let drop = grain(spot.u, spot.v, (120, 120), 123);
    let bump = smooth(0.75, 0.15, drop.near) * (0.4 + 0.6 * drop.id);
    let crack = fine_crack(spot, (3, 3), 124, 0.0007);
    let light = 0.94 + 0.07 * wide - 0.07 * streak.max(0.0) + 0.06 * (bump - 0.4);
    Texel {
        height: 0.0016 * bump + 0.001 * wide - 0.0015 * crack,
        color: mix(scale(hex(0xBD_B5A6), light), hex(0x5E_5A54), crack * 0.5),
        rough: 0.93,
        metal: 0.0,
    }
}

/// Fair-faced concrete: form joints, cone holes at 450 x 600 mm, pores, pour clouds.
pub(super) fn concrete(size: u32) -> Maps {
    paint(size, CONCRETE, Hollows::new(0.02, 40.0), concrete_at)
}

/// One spot of [`concrete`].
fn concrete_at(spot: Spot) -> Texel {
    let wide = fbm(spot.u, spot.v, (3, 3), 5, 131);
    // Joints lie inside the repeat, so that its edge crosses plain concrete.
    let (u, v) = (spot.u + 0.05, spot.v + 0.08);
    let (panel, lift) = (row(u, 2), row(v, 1));
    let from_joint = panel.edge().min(lift.edge()) * CONCRETE;
    let joint = line(from_joint, 0.006, spot.pixel);
    let (hole_u, hole_v) = (row(u, 4), row(v, 3));
    let (dx, dy) = ((hole_u.at - 0.5) * 0.45, (hole_v.at - 0.5) * 0.60);
    let from_hole = (dx * dx + dy * dy).sqrt();
    let cone = 1.0 - smooth(0.011, 0.017, from_hole);
    let rim = line(from_hole - 0.018, 0.004, spot.pixel);
    let pore = grain(spot.u, spot.v, (60, 60), 132);
    let hole = (1.0 - smooth(0.05, 0.12, pore.near)) * smooth(0.72, 0.9, pore.id);
    let streak = fbm(spot.u, spot.v, (26, 2), 3, 133);
    let fine = noise(spot.u, spot.v, (200, 200), 134);
    let light =
        0.97 + 0.10 * wide + 0.04 * streak + 0.015 * fine + 0.03 * (panel.index as f64 - 0.5);
    let color = mix(
        scale(hex(0xA9_A8A3), light),
        hex(0x5C_5B58),
        (0.55 * joint).max(0.8 * hole).max(0.35 * rim),
    );
    Texel {
        height: 0.0006 * wide + 0.000_05 * fine - 0.008 * cone - 0.0015 * joint - 0.0015 * hole,
        color: mix(color, hex(0x55_5452), cone * 0.85),
        rough: 0.82 + 0.08 * wide,
        metal: 0.0,
    }
}
