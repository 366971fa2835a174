//! Walls bound with cement: sprayed mortar (lysin), fair-faced concrete.

use crate::textures::color::{hex, line, mix, scale, smooth};
use crate::textures::noise::{fbm, noise};
use crate::textures::paint::{Hollows, Spot, Texel, paint};
use crate::textures::surface::cells::{grain, row};
use crate::textures::surface::plaster::{fine_crack, runs};
use crate::textures::{Maps, metres};

/// One metre.
const MORTAR: f64 = metres("mortar");
/// Two form panels of 0.9 x 1.8 m.
const CONCRETE: f64 = metres("concrete");

/// Mortar of a kanban front, sprayed with a coarse coat (lysin): new; with dirty runs and hair cracks.
pub(in crate::textures) fn mortar(size: u32) -> Maps {
    paint(size, MORTAR, Hollows::new(0.004, 200.0), mortar_at)
}

/// One spot of [`mortar`].
fn mortar_at(spot: Spot) -> Texel<2> {
    let wide = fbm(spot.u, spot.v, (3, 2), 4, 121);
    let drop = grain(spot.u, spot.v, (96, 96), 123);
    let small = grain(spot.u, spot.v, (170, 170), 124);
    // Drops of the spray: some large, many small, bare mortar between.
    let large = smooth(0.55, 0.10, drop.near) * smooth(0.25, 0.6, drop.id);
    let bump = large.max(0.5 * smooth(0.6, 0.15, small.near) * small.id);
    let crack = fine_crack(spot, (3, 3), 125, 0.0008);
    let light = 0.94 + 0.05 * wide + 0.10 * (bump - 0.35) + 0.05 * (drop.id - 0.5) * large;
    let fresh = scale(hex(0xCC_C4B2), light);
    let dirt = runs(spot, 126);
    let old = mix(
        scale(fresh, 0.90),
        hex(0x6A_665E),
        0.50 * dirt + 0.25 * (0.5 - bump).max(0.0),
    );
    Texel {
        height: 0.0022 * bump + 0.001 * wide - 0.0010 * crack,
        colors: [fresh, mix(old, hex(0x4A_4640), crack * 0.75)],
        rough: 0.93,
        metal: 0.0,
    }
}

/// Fair-faced concrete: form joints, cone holes at 450 x 600 mm, pores, pour clouds; later dark runs.
pub(in crate::textures) fn concrete(size: u32) -> Maps {
    paint(size, CONCRETE, Hollows::new(0.02, 40.0), concrete_at)
}

/// One spot of [`concrete`].
fn concrete_at(spot: Spot) -> Texel<2> {
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
        0.97 + 0.12 * wide + 0.05 * streak + 0.015 * fine + 0.05 * (panel.index as f64 - 0.5);
    let marked = |face| {
        let lined = mix(
            face,
            hex(0x5C_5B58),
            (0.55 * joint).max(0.8 * hole).max(0.35 * rim),
        );
        mix(lined, hex(0x55_5452), cone * 0.85)
    };
    let fresh = scale(hex(0xA9_A8A3), light);
    // Water runs from the joint between the lifts, and a thread of rust and lime from each cone.
    let below = smooth(0.0, 0.75, lift.at);
    let tear = smooth(0.016, 0.006, dx.abs()) * smooth(-0.30, -0.01, dy) * smooth(0.0, -0.01, dy);
    let dark = (runs(spot, 135) * (0.35 + 0.65 * below)).max(0.5 * tear);
    let old = mix(scale(fresh, 0.92), hex(0x55_5550), 0.62 * dark);
    Texel {
        height: 0.0006 * wide + 0.000_05 * fine - 0.008 * cone - 0.0015 * joint - 0.0015 * hole,
        colors: [marked(fresh), marked(old)],
        rough: 0.82 + 0.08 * wide,
        metal: 0.0,
    }
}
