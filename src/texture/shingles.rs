//! Roofs of wood, bark and grass; `v` points up the slope.

use super::Maps;
use super::cells::{Piece, Straws, row, uneven_row};
use super::color::{Rgb, hex, lap_shadow, line, mix, ramp, scale, smooth};
use super::grain::{Board, weathered};
use super::noise::{fbm, hash};
use super::paint::{Hollows, Spot, Texel, paint};

/// Four courses of boards, each 1.5 shaku to the weather.
pub(super) const BOARD_ROOF: f64 = 1.818;
/// Sixty courses of 12.5 mm (4 bu).
pub(super) const BARK: f64 = 0.75;
/// One metre.
pub(super) const THATCH: f64 = 1.0;

/// Split boards laid up the slope (ita-buki), of uneven width, grey and cupped.
pub(super) fn board_roof(size: u32) -> Maps {
    paint(size, BOARD_ROOF, Hollows::new(0.02, 30.0), board_roof_at)
}

/// One spot of [`board_roof`].
fn board_roof_at(spot: Spot) -> Texel {
    let near = row(spot.v, 4).index;
    // Each board ends a little higher or lower than its neighbour.
    let ragged = 0.014 * (hash(roof_piece(spot, near).index, near, 202) - 0.5);
    let course = row(spot.v + ragged, 4);
    let piece = roof_piece(spot, course.index);
    let id = piece.index + 10 * course.index;
    let board = Board {
        id,
        width: piece.width * BOARD_ROOF,
        length: BOARD_ROOF,
        seed: 203,
    };
    let wood = board.wood(spot.v, piece.at, spot.u);
    let wear = fbm(spot.u, spot.v, (6, 6), 3, 204);
    let (early, late) = weathered(
        0.80 + 0.30 * (board.chance(9) - 0.5) + 0.25 * wear,
        1.6 * board.chance(8) - 0.8,
    );
    let shadow = lap_shadow((1.0 - course.at) * BOARD_ROOF / 4.0);
    let joint = line(piece.edge() * BOARD_ROOF, 0.006, spot.pixel);
    let cup = 2.0 * piece.at - 1.0;
    let color = mix(wood.color(early, late), hex(0x22_1E1A), joint * 0.85);
    Texel {
        height: wood.height(0.0006)
            + 0.016 * (1.0 - course.at)
            + 0.002 * cup * cup
            + 0.004 * board.chance(3)
            - 0.008 * joint,
        color: scale(color, shadow),
        rough: 0.9,
        metal: 0.0,
    }
}

/// The board of a course at a spot; joints never stand above each other.
fn roof_piece(spot: Spot, course: i64) -> Piece {
    uneven_row(spot.u + 0.37 * course as f64, 10, 0.7, 201 + course as u32)
}

/// Cypress bark (hiwada), or thin shingles (kokera): very fine courses with frayed edges.
pub(super) fn bark(size: u32) -> Maps {
    paint(size, BARK, Hollows::new(0.006, 70.0), bark_at)
}

/// One spot of [`bark`].
fn bark_at(spot: Spot) -> Texel {
    let tones = [
        hex(0x3E_2F24),
        hex(0x5C_4838),
        hex(0x75_5F4C),
        hex(0x85_7462),
    ];
    let near = row(spot.v, 60).index;
    let fray = 0.0030 * fbm(spot.u, spot.v, (88, 30), 2, 302)
        + 0.0060 * fbm(spot.u, spot.v, (8, 11), 3, 303)
        + 0.002 * (hash(bark_strip(spot, near).index, near, 304) - 0.5);
    let course = row(spot.v + fray, 60);
    let piece = bark_strip(spot, course.index);
    let chance = hash(piece.index, course.index, 305);
    let fibre = fbm(spot.u, spot.v, (110, 12), 3, 306);
    let wide = fbm(spot.u, spot.v, (3, 3), 3, 307);
    let under = 1.0 - course.at;
    let shadow = 1.0 - 0.48 * (1.0 - smooth(0.02, 0.50, under));
    let joint = 0.25 * line(piece.edge() * BARK, 0.0014, spot.pixel);
    let tone = 0.5 + 0.22 * (chance - 0.5) + 0.50 * fibre + 0.13 * wide + 0.12 * (0.5 - course.at);
    Texel {
        height: 0.0035 * (1.0 - course.at) + 0.0007 * fibre + 0.0008 * chance - 0.0015 * joint,
        color: scale(ramp(&tones, tone), shadow * (1.0 - 0.6 * joint)),
        rough: 0.94,
        metal: 0.0,
    }
}

/// The strip of a course at a spot.
fn bark_strip(spot: Spot, course: i64) -> Piece {
    uneven_row(spot.u + 0.31 * course as f64, 18, 0.8, 301 + course as u32)
}

/// Colours of miscanthus from shade to bleached.
const REED: [Rgb; 5] = [
    hex(0x4A_3E30),
    hex(0x6C_5C46),
    hex(0x8A_785A),
    hex(0xA2_9072),
    hex(0x9C_9384),
];

/// Miscanthus thatch (kaya): reeds up the slope, their cut feet showing.
pub(super) fn thatch(size: u32) -> Maps {
    paint(size, THATCH, Hollows::new(0.012, 45.0), thatch_at)
}

/// One spot of [`thatch`].
fn thatch_at(spot: Spot) -> Texel {
    let wide = fbm(spot.u, spot.v, (4, 4), 4, 401);
    let mut texel = Texel {
        height: -0.008,
        color: scale(REED[0], 0.75),
        rough: 0.95,
        metal: 0.0,
    };
    for layer in 0..4 {
        lay_reeds(&mut texel, spot, layer, wide);
    }
    let bed = fbm(spot.u, spot.v, (14, 7), 3, 402);
    texel.height += 0.006 * bed;
    texel.color = scale(texel.color, 1.0 + 0.22 * bed);
    texel
}

/// One more layer of reeds on what lies there.
fn lay_reeds(texel: &mut Texel, spot: Spot, layer: u32, wide: f64) {
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
    let stalk = scale(ramp(&REED, tone), 0.70 + 0.36 * round);
    let color = mix(stalk, hex(0x2A_2118), 0.75 * foot);
    texel.color = mix(texel.color, color, reed.cover);
    let top = 0.002 * f64::from(layer) + 0.003 * round - 0.004 * reed.along;
    texel.height += (top - texel.height) * reed.cover;
}
