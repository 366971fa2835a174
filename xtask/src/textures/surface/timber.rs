//! Planed wood without joints: posts, rails and bars of cedar, planks, and the zelkova of great doors.

use crate::textures::color::{Rgb, hex, mix, scale, smooth};
use crate::textures::noise::{fbm, floor, noise};
use crate::textures::paint::{Hollows, Spot, Texel, paint};
use crate::textures::surface::grain::Face;
use crate::textures::{Maps, metres};

/// Two shaku; posts and rails show a part of it.
const CEDAR: f64 = metres("cedar");
/// Two shaku, wider than any single board.
const PLANK: f64 = metres("plank");
/// Two shaku.
const KEYAKI: f64 = metres("keyaki");

const GRAIN: Hollows = Hollows::new(0.004, 250.0);

/// Iron red with soot in oil.
const BENGARA: Rgb = hex(0x5A_2E22);
/// Soot in persimmon juice.
const SOOT: Rgb = hex(0x3A_2E26);
/// Hinoki: paler and less red than cedar.
const HINOKI: Rgb = hex(0xE6_CFA4);

/// Planed timber, grain vertical, rings 3 to 6 mm: cedar by age, hinoki, sooted and bengara-stained wood, which share
/// the relief.
pub(in crate::textures) fn cedar(size: u32) -> Maps {
    paint(size, CEDAR, GRAIN, cedar_at)
}

/// One spot of [`cedar`].
fn cedar_at(spot: Spot) -> Texel<9> {
    let face = Face {
        hearts: 0,
        rings: 112,
        arches: 7.0,
        turns: (3, 1),
        knots: None,
        seed: 21,
    };
    let mut wood = face.wood(spot.v, spot.u, CEDAR);
    wood.check *= 0.35;
    let cloud = fbm(spot.u, spot.v, (3, 2), 3, 22);
    let streak = fbm(spot.u, spot.v, (40, 2), 3, 23);
    let [fresh, brown, silver, dark] = wood.ages(cloud, cloud);
    let hinoki = scale(
        wood.color(scale(HINOKI, 1.03), scale(HINOKI, 0.86)),
        1.0 + 0.03 * cloud,
    );
    let stain = |dye: Rgb, fade: f64| {
        let grained = scale(
            dye,
            1.06 + 0.10 * wood.fibre - 0.22 * wood.late - 0.5 * wood.check + 0.06 * cloud,
        );
        mix(grained, mix(brown, silver, 0.45), fade)
    };
    // Stain leaves the hard latewood and the rained-on streaks first.
    let bare = 0.5 * streak + 0.6 * cloud + 0.35 * (wood.late - 0.4);
    Texel {
        height: wood.height(0.000_25),
        colors: [
            fresh,
            brown,
            silver,
            dark,
            hinoki,
            stain(SOOT, 0.10 * smooth(0.0, 0.5, bare)),
            stain(BENGARA, 0.0),
            stain(BENGARA, 0.25 + 0.55 * smooth(-0.3, 0.5, bare)),
            stain(BENGARA, 0.70 + 0.30 * smooth(-0.4, 0.2, bare)),
        ],
        rough: 0.78 - 0.10 * wood.late,
        metal: 0.0,
    }
}

/// Flat-sawn cedar without joints, grain vertical: for boards modelled as separate bodies.
pub(in crate::textures) fn plank(size: u32) -> Maps {
    paint(size, PLANK, GRAIN, plank_at)
}

/// One spot of [`plank`].
fn plank_at(spot: Spot) -> Texel<4> {
    let face = Face {
        hearts: 2,
        rings: 84,
        arches: 8.0,
        turns: (2, 1),
        knots: Some((3, 2)),
        seed: 24,
    };
    let wood = face.wood(spot.v, spot.u, PLANK);
    let cloud = fbm(spot.u, spot.v, (5, 2), 3, 25);
    Texel {
        height: wood.height(0.0004),
        colors: wood.ages(cloud, 1.2 * fbm(spot.u, spot.v, (4, 1), 2, 26)),
        rough: 0.85 - 0.08 * wood.late,
        metal: 0.0,
    }
}

/// Zelkova: broad warm figure, each ring beginning in a band of open pores. New, and dark with age and hands.
pub(in crate::textures) fn keyaki(size: u32) -> Maps {
    paint(size, KEYAKI, GRAIN, keyaki_at)
}

/// One spot of [`keyaki`].
fn keyaki_at(spot: Spot) -> Texel<2> {
    let phase = spot.u * 76.0
        + 15.0 * noise(spot.u, spot.v, (3, 1), 27)
        + 1.2 * fbm(spot.u, spot.v, (5, 2), 3, 28)
        + 0.35 * noise(spot.u, spot.v, (30, 5), 29);
    let year = phase - floor(phase) as f64;
    // Pores: dashes along the grain, crowded where the year begins, a few all over.
    let band = (1.0 - smooth(0.22, 0.40, year)) * smooth(0.0, 0.05, year);
    let dash = noise(spot.u, spot.v, (256, 12), 30) + 0.5 * noise(spot.u, spot.v, (170, 20), 31);
    let pore = smooth(-0.25, 0.45, dash) * band + 0.5 * smooth(0.45, 0.8, dash);
    let late = smooth(0.45, 1.0, year);
    let cloud = fbm(spot.u, spot.v, (3, 1), 4, 32);
    // Rays and curl throw the light back in cross bands.
    let curl = noise(spot.u, spot.v, (5, 22), 33) * smooth(-0.2, 0.5, cloud);
    let figure = |pale: Rgb, deep: Rgb, hollow: Rgb| {
        let ringed = mix(pale, deep, 0.10 + 0.60 * late + 0.3 * cloud);
        mix(
            scale(ringed, 1.0 + 0.05 * curl),
            hollow,
            0.72 * pore.min(1.0),
        )
    };
    Texel {
        height: 0.000_10 * late - 0.000_22 * pore,
        colors: [
            figure(hex(0xC9_945C), hex(0xA0_6A3A), hex(0x5C_3418)),
            figure(hex(0x7E_4E2C), hex(0x5A_331C), hex(0x24_120A)),
        ],
        rough: 0.52 + 0.25 * pore - 0.05 * curl,
        metal: 0.0,
    }
}
