//! Roofs of split wood and of bark; `v` points up the slope. New, silver, dark with moss.

use crate::textures::color::{Rgb, hex, lap_light, line, mix, ramp, scale, smooth};
use crate::textures::noise::{fbm, hash, noise};
use crate::textures::paint::{Hollows, Spot, Texel, paint};
use crate::textures::surface::cells::{RowPiece, row, uneven_row};
use crate::textures::surface::grain::{Board, Face};
use crate::textures::{Maps, metres};

/// Four courses of boards, each 1.5 shaku to the weather.
const BOARD_ROOF: f64 = metres("board_roof");
/// Twenty-five courses of 36 mm (1.2 sun), shingles 60 to 120 mm wide.
const KOKERA: f64 = metres("kokera");
/// Sixty courses of 12.5 mm (4 bu).
const BARK: f64 = metres("bark");

const MOSS: Rgb = hex(0x56_5A38);

/// Split boards laid up the slope (ita-buki), of uneven width, grey and cupped.
pub(in crate::textures) fn board_roof(size: u32) -> Maps {
    paint(size, BOARD_ROOF, Hollows::new(0.02, 30.0), board_roof_at)
}

/// One spot of [`board_roof`].
fn board_roof_at(spot: Spot) -> Texel<3> {
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
    let wear = fbm(spot.u, spot.v, (6, 6), 3, 204) + 0.8 * (board.chance(9) - 0.5);
    let [fresh, brown, silver, dark] = wood.ages(wear, board.tone());
    let shadow = lap_light(course.at, BOARD_ROOF / 4.0, spot.pixel);
    let joint = line(piece.edge() * BOARD_ROOF, 0.006, spot.pixel);
    let cup = 2.0 * piece.at - 1.0;
    // Moss begins where water stands: along joints and under the laps.
    let wet = 0.5 * smooth(0.6, 1.0, cup.abs()) + 0.5 * smooth(0.5, 1.0, course.at);
    let moss = smooth(0.25, 0.7, wet * 0.6 + fbm(spot.u, spot.v, (11, 11), 4, 205));
    Texel {
        height: wood.height(0.0006)
            + 0.016 * (1.0 - course.at)
            + 0.002 * cup * cup
            + 0.004 * board.chance(3)
            - 0.008 * joint,
        colors: [
            mix(fresh, brown, 0.25),
            silver,
            mix(dark, MOSS, 0.75 * moss),
        ]
        .map(|color| scale(mix(color, hex(0x22_1E1A), joint * 0.85), shadow)),
        rough: 0.9,
        metal: 0.0,
    }
}

/// Returns the board of a course at a spot; joints are never above each other.
fn roof_piece(spot: Spot, course: i64) -> RowPiece {
    uneven_row(spot.u + 0.37 * course as f64, 10, 0.7, 201 + course as u32)
}

/// Thin shingles (kokera), 3 mm thick: narrow even courses, each shingle its own tone.
pub(in crate::textures) fn kokera(size: u32) -> Maps {
    paint(size, KOKERA, Hollows::new(0.008, 70.0), kokera_at)
}

/// One spot of [`kokera`].
fn kokera_at(spot: Spot) -> Texel<3> {
    let near = row(spot.v, 25).index;
    let ragged = 0.0030 * (hash(shingle(spot, near).index, near, 212) - 0.5);
    let course = row(spot.v + ragged, 25);
    let piece = shingle(spot, course.index);
    let board = Board {
        id: piece.index + 11 * course.index,
        width: piece.width * KOKERA,
        length: KOKERA,
        seed: 213,
    };
    // Split along the rays, so that rings run straight.
    let split = Face {
        hearts: 0,
        rings: 240,
        arches: 1.5,
        turns: (9, 2),
        knots: None,
        seed: 216,
    };
    let wood = split.wood(spot.v + board.chance(1), spot.u + board.chance(2), KOKERA);
    let wear = fbm(spot.u, spot.v, (5, 5), 3, 214) + 0.9 * (board.chance(9) - 0.5);
    let [fresh, _, silver, dark] = wood.ages(wear, 1.6 * board.tone());
    let below = (1.0 - course.at) * KOKERA / 25.0;
    let shadow =
        1.0 - 0.68 * (1.0 - smooth(0.001, 0.007, below)) - 0.12 * (1.0 - smooth(0.0, 0.03, below));
    let joint = line(piece.edge() * KOKERA, 0.0028, spot.pixel);
    let moss = smooth(0.15, 0.6, fbm(spot.u, spot.v, (8, 8), 4, 215));
    Texel {
        height: wood.height(0.0002) + 0.0045 * (1.0 - course.at) + 0.0012 * board.chance(3)
            - 0.002 * joint,
        colors: [fresh, silver, mix(dark, MOSS, 0.6 * moss)]
            .map(|color| scale(mix(color, hex(0x26_201A), joint * 0.75), shadow)),
        rough: 0.9,
        metal: 0.0,
    }
}

/// Returns the shingle of a course at a spot.
fn shingle(spot: Spot, course: i64) -> RowPiece {
    uneven_row(spot.u + 0.43 * course as f64, 10, 0.75, 211 + course as u32)
}

/// Cypress bark (hiwada): very fine courses of fibrous strips with frayed edges.
pub(in crate::textures) fn bark(size: u32) -> Maps {
    paint(size, BARK, Hollows::new(0.006, 70.0), bark_at)
}

/// One spot of [`bark`].
fn bark_at(spot: Spot) -> Texel<3> {
    const RED: [Rgb; 4] = [
        hex(0x42_2E22),
        hex(0x66_4632),
        hex(0x82_5E44),
        hex(0x98_7456),
    ];
    const BROWN: [Rgb; 4] = [
        hex(0x38_2E26),
        hex(0x54_463A),
        hex(0x70_6052),
        hex(0x86_7868),
    ];
    const GREY: [Rgb; 4] = [
        hex(0x32_2F2A),
        hex(0x4E_4A42),
        hex(0x6A_665C),
        hex(0x82_7E74),
    ];
    let near = row(spot.v, 60).index;
    // The edge of a strip wanders, and its fibres hang out of it.
    let fray = 0.0075 * fbm(spot.u, spot.v, (7, 13), 3, 303)
        + 0.0028 * noise(spot.u, spot.v, (150, 60), 302)
        + 0.0050 * (hash(bark_strip(spot, near).index, near, 304) - 0.5);
    let course = row(spot.v + fray, 60);
    let piece = bark_strip(spot, course.index);
    let chance = hash(piece.index, course.index, 305);
    let fibre = fbm(spot.u + 0.1 * chance, spot.v, (120, 16), 3, 306);
    let wide = fbm(spot.u, spot.v, (3, 3), 3, 307);
    let under = 1.0 - course.at;
    let shadow = 1.0 - 0.50 * (1.0 - smooth(0.02, 0.42, under));
    let lip = 1.0 - smooth(0.0, 0.25, course.at);
    let tone = 0.5 + 0.55 * (chance - 0.5) + 0.42 * fibre + 0.16 * wide + 0.10 * lip;
    let moss = smooth(
        0.20,
        0.65,
        fbm(spot.u, spot.v, (6, 6), 4, 308) + 0.15 * fibre,
    );
    Texel {
        height: 0.0038 * under + 0.0008 * fibre + 0.0012 * chance,
        colors: [
            ramp(&RED, tone),
            ramp(&BROWN, tone),
            mix(ramp(&GREY, tone), scale(MOSS, 0.8 + 0.4 * tone), 0.7 * moss),
        ]
        .map(|color| scale(color, shadow)),
        rough: 0.94,
        metal: 0.0,
    }
}

/// Returns the strip of a course at a spot.
fn bark_strip(spot: Spot, course: i64) -> RowPiece {
    uneven_row(spot.u + 0.31 * course as f64, 9, 0.85, 301 + course as u32)
}
