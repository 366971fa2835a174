//! Boarded walls: upright boards, lapped boards, charred boards.

use crate::textures::color::{Rgb, hex, lap_light, line, mix, ramp, scale, smooth};
use crate::textures::noise::{fbm, noise};
use crate::textures::paint::{Hollows, Spot, Texel, paint};
use crate::textures::surface::cells::{grain, row};
use crate::textures::surface::grain::Board;
use crate::textures::{Maps, metres};

/// Four boards of 8 sun.
const BOARDING: f64 = metres("boarding");
/// Four boards of 9 sun with 1 sun of lap, hence 8 sun seen.
const CLAPBOARD: f64 = metres("clapboard");
/// Four boards of 5.5 sun.
const CHARRED: f64 = metres("charred");

const JOINTS: Hollows = Hollows::new(0.012, 55.0);

/// Wide upright boards with open joints and two rows of nails.
pub(in crate::textures) fn boarding(size: u32) -> Maps {
    paint(size, BOARDING, JOINTS, boarding_at)
}

/// One spot of [`boarding`].
fn boarding_at(spot: Spot) -> Texel<4> {
    let piece = row(spot.u, 4);
    let board = Board {
        id: piece.index,
        width: BOARDING / 4.0,
        length: BOARDING,
        seed: 31,
    };
    let wood = board.wood(spot.v, piece.at, spot.u);
    let cloud = fbm(spot.u, spot.v, (8, 2), 3, 32) + 0.7 * (board.chance(9) - 0.5);
    let edge = piece.edge() * spot.metres;
    let joint = line(edge, 0.005, spot.pixel);
    let nail = nails(spot, piece.at * BOARDING / 4.0, BOARDING / 4.0);
    // Iron bleeds into wet wood below its head.
    let bleed = bleeding(spot, piece.at * BOARDING / 4.0, BOARDING / 4.0);
    let mut colors = wood.ages(cloud, board.tone());
    for (color, stain) in colors.iter_mut().zip([0.0, 0.2, 0.45, 0.5]) {
        *color = mix(*color, hex(0x33_2C28), stain * bleed);
        *color = mix(*color, hex(0x1D_1712), joint * 0.9);
        *color = mix(*color, hex(0x2A_2522), nail * 0.85);
    }
    Texel {
        height: wood.height(0.0004) - 0.006 * joint + 0.001 * board.chance(3)
            - 0.0015 * (1.0 - smooth(0.0, 0.004, edge)),
        colors,
        rough: 0.85 - 0.08 * wood.late,
        metal: 0.0,
    }
}

/// Returns the distance to the nearest nail: across, and upwards from it, metres.
fn to_nail(spot: Spot, x: f64, width: f64) -> (f64, f64) {
    let dx = (x - 0.035).abs().min((x - width + 0.035).abs());
    let at = row(spot.v, 2).at;
    (dx, (at - 0.5) * spot.metres / 2.0)
}

/// Iron nail heads, two across a board in two rows.
fn nails(spot: Spot, x: f64, width: f64) -> f64 {
    let (dx, dy) = to_nail(spot, x, width);
    1.0 - smooth(0.003, 0.0045, (dx * dx + dy * dy).sqrt())
}

/// The dark streak below a nail.
fn bleeding(spot: Spot, x: f64, width: f64) -> f64 {
    let (dx, dy) = to_nail(spot, x, width);
    let down = smooth(0.004, -0.004, dy) * smooth(-0.11, -0.01, dy);
    down * (1.0 - smooth(0.002, 0.007, dx))
}

/// Boards lapped over each other (shitami), grain horizontal: each leans out over the one below and casts a shadow on
/// it.
pub(in crate::textures) fn clapboard(size: u32) -> Maps {
    paint(size, CLAPBOARD, JOINTS, clapboard_at)
}

/// One spot of [`clapboard`].
fn clapboard_at(spot: Spot) -> Texel<4> {
    let course = row(spot.v, 4);
    let seen = CLAPBOARD / 4.0;
    let board = Board {
        id: course.index,
        width: seen,
        length: CLAPBOARD,
        seed: 43,
    };
    let wood = board.wood(spot.u, course.at, spot.v);
    // Under the lap above a board stays brown.
    let cloud = fbm(spot.u, spot.v, (3, 4), 3, 42)
        + 0.6 * (board.chance(9) - 0.5)
        + 0.7 * smooth(0.55, 1.0, course.at)
        - 0.2;
    let shadow = lap_light(course.at, seen, spot.pixel);
    let lip = 1.0 - smooth(0.0, 0.004, course.at * seen);
    let colors = wood.ages(cloud, board.tone());
    Texel {
        height: wood.height(0.0004) + 0.014 * (1.0 - course.at),
        colors: colors.map(|color| scale(color, shadow * (1.0 + 0.14 * lip))),
        rough: 0.86 - 0.08 * wood.late,
        metal: 0.0,
    }
}

/// Boards charred for durability (yakisugi): char cracked like a crocodile's skin. New; flaking; bare after 40 years.
pub(in crate::textures) fn charred(size: u32) -> Maps {
    paint(size, CHARRED, JOINTS, charred_at)
}

/// One spot of [`charred`].
fn charred_at(spot: Spot) -> Texel<3> {
    const CHAR: [Rgb; 3] = [hex(0x10_0F0E), hex(0x26_2421), hex(0x58_5552)];
    let piece = row(spot.u, 4);
    let board = Board {
        id: piece.index,
        width: CHARRED / 4.0,
        length: CHARRED,
        seed: 51,
    };
    let wood = board.wood(spot.v, piece.at, spot.u);
    let warp = fbm(spot.u, spot.v, (20, 10), 2, 52);
    // Two generations of cracks: long scales up the grain, each broken again across.
    let big = grain(spot.u + 0.010 * warp, spot.v + 0.014 * warp, (42, 14), 53);
    let small = grain(spot.u - 0.006 * warp, spot.v + 0.006 * warp, (74, 32), 54);
    let deep = 1.0 - smooth(0.03, 0.20, big.border);
    let fine = 0.6 * (1.0 - smooth(0.02, 0.16, small.border));
    let crack = deep.max(fine);
    let pillow = smooth(0.0, 0.5, big.border) + 0.4 * smooth(0.0, 0.4, small.border);
    let tone = 0.30
        + 0.30 * (big.id - 0.5)
        + 0.25 * (small.id - 0.5)
        + 0.16 * pillow
        + 0.2 * (board.chance(8) - 0.5)
        + 0.12 * wood.fibre;
    let joint = line(piece.edge() * spot.metres, 0.004, spot.pixel);
    let char = mix(ramp(&CHAR, tone), hex(0x06_0605), crack * 0.85);
    let cloud = fbm(spot.u, spot.v, (9, 2), 4, 57) + 0.5 * (board.chance(9) - 0.5);
    let [_, brown, silver, _] = wood.ages(cloud, board.tone());
    // Whole scales fall: the loss follows their outlines.
    let loss = |share: f64| {
        smooth(
            0.0,
            0.12,
            0.45 * cloud + 0.5 * big.id + 0.2 * noise(spot.u, spot.v, (60, 8), 58) - share,
        )
    };
    let bare = mix(scale(brown, 0.8), silver, 0.35);
    let worn = mix(char, scale(brown, 0.62), loss(0.42));
    let old = mix(mix(char, bare, 0.35), bare, loss(0.08));
    Texel {
        height: 0.0012 * pillow - 0.0008 * crack - 0.006 * joint
            + 0.001 * board.chance(3)
            + 0.0003 * wood.late,
        colors: [char, worn, old].map(|color| mix(color, hex(0x05_0505), joint)),
        rough: 0.62 + 0.25 * crack - 0.08 * tone,
        metal: 0.0,
    }
}
