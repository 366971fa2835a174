//! Timber and boarded walls: posts, boarding upright and lapped, charred boards.

use super::Maps;
use super::cells::{row, uneven_row};
use super::color::{Rgb, hex, lap_shadow, line, mix, ramp, scale, smooth};
use super::grain::{BROWN, Board, FRESH, SILVER, edge_grain, weathered};
use super::noise::{fbm, noise};
use super::paint::{Hollows, Spot, Texel, paint};

/// Two shaku: posts and rails show a part of it.
pub(super) const CEDAR: f64 = 0.606;
/// Four boards of 8 sun.
pub(super) const CEDAR_BOARD: f64 = 0.9696;
/// Four boards of 9 sun with 1 sun of lap, hence 8 sun seen.
pub(super) const CLAPBOARD: f64 = 0.9696;
/// Six boards of 5.5 sun.
pub(super) const CHARRED: f64 = 1.0;

const GRAIN: Hollows = Hollows::new(0.004, 250.0);
const JOINTS: Hollows = Hollows::new(0.012, 55.0);

/// Planed timber, grain upright. Light and little saturated, so that a tint (bengara red, soot)
/// multiplies well.
pub(super) fn cedar(size: u32) -> Maps {
    paint(size, CEDAR, GRAIN, cedar_at)
}

/// One spot of [`cedar`].
fn cedar_at(spot: Spot) -> Texel {
    let mut wood = edge_grain(spot.v, spot.u, 66, 21);
    wood.check *= 0.35;
    let cloud = fbm(spot.u, spot.v, (3, 2), 3, 22);
    let early = scale(
        mix(mix(FRESH, SILVER, 0.38), BROWN, 0.12),
        1.04 + 0.10 * cloud,
    );
    let late = scale(mix(BROWN, SILVER, 0.25), 0.95 + 0.10 * cloud);
    Texel {
        height: wood.height(0.000_25),
        color: wood.color(early, late),
        rough: 0.78 - 0.10 * wood.late,
        metal: 0.0,
    }
}

/// Wide upright boards with open joints and two rows of nails.
pub(super) fn cedar_board(size: u32) -> Maps {
    paint(size, CEDAR_BOARD, JOINTS, cedar_board_at)
}

/// One spot of [`cedar_board`].
fn cedar_board_at(spot: Spot) -> Texel {
    let piece = row(spot.u, 4);
    let board = Board {
        id: piece.index,
        width: CEDAR_BOARD / 4.0,
        length: CEDAR_BOARD,
        seed: 31,
    };
    let wood = board.wood(spot.v, piece.at, spot.u);
    let cloud = fbm(spot.u, spot.v, (4, 2), 3, 32);
    let (early, late) = weathered(
        0.18 + 0.25 * board.chance(9) + 0.25 * cloud,
        2.0 * board.chance(8) - 1.0,
    );
    let edge = piece.edge() * spot.metres;
    let joint = line(edge, 0.005, spot.pixel);
    let nail = nails(spot, piece.at * CEDAR_BOARD / 4.0, CEDAR_BOARD / 4.0);
    let color = mix(wood.color(early, late), hex(0x1D_1712), joint * 0.9);
    Texel {
        height: wood.height(0.0004) - 0.006 * joint + 0.001 * board.chance(3)
            - 0.0015 * (1.0 - smooth(0.0, 0.004, edge)),
        color: mix(color, hex(0x2A_2522), nail * 0.85),
        rough: 0.85 - 0.08 * wood.late,
        metal: 0.0,
    }
}

/// Iron nail heads, two across a board in two rows.
fn nails(spot: Spot, x: f64, width: f64) -> f64 {
    let y = [0.25, 0.75].map(|v| (spot.v - v).abs() * spot.metres);
    let dx = (x - 0.035).abs().min((x - width + 0.035).abs());
    let dy = y[0].min(y[1]);
    1.0 - smooth(0.003, 0.0045, (dx * dx + dy * dy).sqrt())
}

/// Boards lapped over each other (shitami), grain level: each leans out over the one below and
/// throws a shadow on it.
pub(super) fn clapboard(size: u32) -> Maps {
    paint(size, CLAPBOARD, JOINTS, clapboard_at)
}

/// One spot of [`clapboard`].
fn clapboard_at(spot: Spot) -> Texel {
    let course = row(spot.v, 4);
    let seen = CLAPBOARD / 4.0;
    let board = Board {
        id: course.index,
        width: seen,
        length: CLAPBOARD,
        seed: 43,
    };
    let wood = board.wood(spot.u, course.at, spot.v);
    let wear = fbm(spot.u, spot.v, (3, 4), 3, 42);
    let age =
        0.42 + 0.25 * (board.chance(9) - 0.5) + 0.3 * wear - 0.25 * smooth(0.6, 1.0, course.at);
    let (early, late) = weathered(age, 1.6 * board.chance(8) - 0.8);
    let shadow = lap_shadow((1.0 - course.at) * seen);
    let lip = 1.0 - smooth(0.0, 0.004, course.at * seen);
    let color = scale(wood.color(early, late), shadow * (1.0 + 0.14 * lip));
    Texel {
        height: wood.height(0.0004) + 0.014 * (1.0 - course.at),
        color,
        rough: 0.86 - 0.08 * wood.late,
        metal: 0.0,
    }
}

/// Boards charred for durability (yakisugi): scaly char, brushed off here and there.
pub(super) fn charred(size: u32) -> Maps {
    paint(size, CHARRED, JOINTS, charred_at)
}

/// One spot of [`charred`].
fn charred_at(spot: Spot) -> Texel {
    const CHAR: [Rgb; 3] = [hex(0x0B_0A0A), hex(0x24_211F), hex(0x60_5A54)];
    let piece = row(spot.u, 6);
    let board = Board {
        id: piece.index,
        width: CHARRED / 6.0,
        length: CHARRED,
        seed: 51,
    };
    let own = 52 + piece.index as u32 * 13;
    let wood = board.wood(spot.v, piece.at, spot.u);
    let warp = 0.012 * noise(spot.u, spot.v, (24, 12), own);
    let column = uneven_row(spot.u + 0.25 * warp, 66, 0.7, own);
    let scale_at = uneven_row(
        spot.v + warp + board.chance(2),
        36,
        0.9,
        own + 7 * column.index as u32,
    );
    let crack = line(scale_at.edge(), 0.0022, spot.pixel)
        .max(0.8 * line(column.edge(), 0.0018, spot.pixel));
    let fibre = wood.fibre * 0.5;
    let tone = 0.42
        + 0.25 * (board.chance(8) - 0.5)
        + 0.12 * fbm(spot.u, spot.v, (5, 4), 3, 55)
        + 0.30 * fibre;
    let joint = line(piece.edge() * spot.metres, 0.004, spot.pixel);
    let bare = smooth(0.36, 0.62, fbm(spot.u, spot.v, (18, 3), 3, 57));
    let char = mix(ramp(&CHAR, tone), CHAR[0], crack * 0.7);
    let color = mix(char, hex(0x4A_372A), bare * 0.5 * (1.0 - crack));
    Texel {
        height: 0.0008 * fibre - 0.0011 * crack - 0.006 * joint
            + 0.001 * board.chance(3)
            + 0.0004 * wood.late,
        color: mix(color, hex(0x05_0505), joint),
        rough: 0.72 + 0.15 * bare - 0.1 * wood.late,
        metal: 0.0,
    }
}
