//! Smoked roof tiles (ibushi): the S of the sangawara, round tiles over flat ones, the courses of a ridge, and
//! the plain fired face. Each new and silvery, then worn, then with lichen.

use crate::textures::color::{Rgb, hex, lap_light, line, mix, scale, smooth};
use crate::textures::noise::{fbm, hash, noise};
use crate::textures::paint::{Hollows, Spot, Texel, paint};
use crate::textures::surface::cells::{grain, row, uneven_row};
use crate::textures::{Maps, metres};

/// Eight columns of 265 mm; nine courses of 235.6 mm, where the 53A tile has 235 mm.
const KAWARA: f64 = metres("kawara");
/// Seven columns of 272 mm; six round tiles of 317 mm up the slope, two flat ones showing to each.
const HONGAWARA: f64 = metres("hongawara");
/// Twenty-four courses of 35 mm, three tiles in each.
const NOSHI: f64 = metres("noshi");
/// Two shaku.
const IBUSHI: f64 = metres("ibushi");

/// Returns the smoked face before shading: silvery, worn, with lichen. `chance` varies from tile to tile.
fn smoked(spot: Spot, chance: impl Fn(u32) -> f64, cells: u32) -> [Rgb; 3] {
    let bloom = fbm(spot.u, spot.v, (cells, cells), 4, 811);
    let fine = noise(spot.u, spot.v, (190, 190), 813);
    // The kiln: carbon lies thick or thin, with a blue or a brown cast.
    let kiln = 1.0 + 0.11 * (chance(2) - 0.5) + 0.07 * bloom + 0.03 * fine;
    let brown = chance(3) * chance(3);
    let new = scale(
        mix(
            mix(hex(0x62_686E), hex(0x80_868C), 0.45 + 0.4 * bloom),
            hex(0x6A_6864),
            0.4 * brown,
        ),
        kiln,
    );
    let worn = scale(mix(hex(0x57_5E64), hex(0x5E_5850), 0.45 * brown), kiln);
    let blot = fbm(spot.u, spot.v, (cells * 7, cells * 7), 4, 814);
    let damp = fbm(spot.u, spot.v, (cells, cells), 3, 817) + 0.5 * (chance(5) - 0.5);
    let lichen = smooth(0.36, 0.52, blot + 0.38 * damp);
    let moss = smooth(0.15, 0.7, bloom + 0.3 * fine);
    let dull = mix(scale(hex(0x58_5852), kiln), hex(0x40_4230), 0.40 * moss);
    let plant = mix(hex(0x94_9884), hex(0xA8_9A68), smooth(0.45, 0.62, blot));
    [new, worn, mix(dull, plant, 0.6 * lichen)]
}

/// Returns the dullness of a worn face; the material makes a new one shinier.
fn dullness(spot: Spot, chance: f64) -> f64 {
    0.72 + 0.10 * chance + 0.08 * fbm(spot.u, spot.v, (9, 9), 3, 816)
}

/// Returns the height of a sangawara across its width, 0..1, metres: the roll lies over the right rim of the neighbour
/// to the left, then the pan sinks and rises again to its own rim.
fn san_profile(at: f64) -> f64 {
    // Crest at 0.17, valley at 0.71 of the width; a step of a tile's thickness at the seam.
    let turn = -0.20 + at * (1.25 - 0.37 * at);
    0.026 * libm::cos(std::f64::consts::TAU * turn)
}

/// Sangawara in straight columns: each tile's foot is proud of the course below and casts a shadow.
pub(in crate::textures) fn kawara(size: u32) -> Maps {
    paint(size, KAWARA, Hollows::new(0.05, 7.0), kawara_at)
}

/// One spot of [`kawara`].
fn kawara_at(spot: Spot) -> Texel<3> {
    let column = row(spot.u, 8);
    let profile = san_profile(column.at);
    // The foot follows the profile a little, as it is seen from the street.
    let course = row(spot.v + 0.32 * profile / KAWARA, 9);
    let chance = |salt: u32| hash(column.index, course.index, 800 + salt);
    let length = KAWARA / 9.0;
    let skew = 0.004 * (chance(1) - 0.5) * (column.at - 0.5);
    let shadow = lap_light(course.at, length, spot.pixel);
    let seam = line(column.at.min(1.0 - column.at) * 0.265, 0.007, spot.pixel)
        .max(0.65 * smooth(0.90, 1.0, column.at));
    let lip = 1.0 - smooth(0.004, 0.012, course.at * length);
    let shape = (1.0 + 4.0 * profile) * shadow * (1.0 + 0.16 * lip);
    let faces = smoked(spot, chance, 6);
    Texel {
        height: profile + 0.020 * (1.0 - course.at) + skew,
        colors: faces.map(|face| mix(scale(face, shape), hex(0x14_1517), seam * 0.85)),
        rough: dullness(spot, chance(4)),
        metal: 0.0,
    }
}

/// Hon-gawara of temples and gates: rows of round tiles over the joints of slightly hollow flat ones.
pub(in crate::textures) fn hongawara(size: u32) -> Maps {
    paint(size, HONGAWARA, Hollows::new(0.05, 5.5), hongawara_at)
}

/// One spot of [`hongawara`].
fn hongawara_at(spot: Spot) -> Texel<3> {
    const RADIUS: f64 = 0.074;
    let column = row(spot.u, 7);
    let x = (column.at - 0.5) * HONGAWARA / 7.0;
    let round = x.abs() < RADIUS;
    let arch = 0.86 * (RADIUS * RADIUS - x * x).max(0.0).sqrt();
    // The pan is hollow between two rows of round tiles.
    let from_pan = (HONGAWARA / 14.0 - x.abs()) / (HONGAWARA / 14.0 - RADIUS);
    let pan = -0.022 * (1.0 - from_pan * from_pan).max(0.0);
    let (count, thick) = if round { (6, 0.006) } else { (12, 0.020) };
    let sag = if round { 0.10 * arch } else { -0.3 * pan };
    let course = row(spot.v - sag / HONGAWARA, count);
    let length = HONGAWARA / f64::from(count);
    let side = i64::from(round);
    let chance = |salt: u32| hash(column.index * 2 + side, course.index, 840 + salt);
    let butt = line(course.edge() * HONGAWARA, 0.005, spot.pixel);
    let shadow = if round {
        1.0 - 0.75 * butt
    } else {
        lap_light(course.at, length, spot.pixel)
    };
    // Beside a round tile the pan lies in its shade.
    let beside = if round {
        1.0
    } else {
        1.0 - 0.62 * (1.0 - smooth(RADIUS, RADIUS + 0.035, x.abs()))
    };
    let lip = 1.0 - smooth(0.004, 0.012, course.at * length);
    let shape =
        shadow * beside * (1.0 + 0.12 * lip) * if round { 0.832 + 3.28 * arch } else { 1.0 };
    let base = if round { arch + 0.012 } else { pan };
    Texel {
        height: base + thick * (1.0 - course.at) - if round { 0.004 * butt } else { 0.0 },
        colors: smoked(spot, chance, 6).map(|face| scale(face, shape)),
        rough: dullness(spot, chance(4)),
        metal: 0.0,
    }
}

/// Flat tiles bedded in courses under a ridge cap, each lip proud of the joint below.
pub(in crate::textures) fn noshi(size: u32) -> Maps {
    paint(size, NOSHI, Hollows::new(0.012, 40.0), noshi_at)
}

/// One spot of [`noshi`].
fn noshi_at(spot: Spot) -> Texel<3> {
    let course = row(spot.v, 24);
    let tile = uneven_row(
        spot.u + 0.167 * (course.index % 2) as f64,
        3,
        0.06,
        850 + course.index as u32,
    );
    let chance = |salt: u32| hash(tile.index, course.index, 851 + salt);
    let height = course.at * NOSHI / 24.0;
    // 25 mm of tile over 10 mm of bedding that lies back.
    let lip = smooth(0.006, 0.009, height) * (1.0 - smooth(0.033, 0.035, height));
    let joint = line(tile.edge() * NOSHI, 0.004, spot.pixel) * lip;
    let bed = scale(
        hex(0x38_3634),
        1.0 + 0.3 * noise(spot.u, spot.v, (90, 90), 852),
    );
    let faces = smoked(spot, chance, 3);
    Texel {
        height: 0.018 * lip + 0.002 * (chance(6) - 0.5) - 0.004 * joint,
        colors: faces.map(|face| mix(mix(bed, face, lip), hex(0x16_1617), 0.8 * joint)),
        rough: dullness(spot, chance(4)),
        metal: 0.0,
    }
}

/// The fired face without joints: ridge caps, end tiles, flat tiles modelled as separate bodies.
pub(in crate::textures) fn ibushi(size: u32) -> Maps {
    paint(size, IBUSHI, Hollows::new(0.006, 60.0), ibushi_at)
}

/// One spot of [`ibushi`].
fn ibushi_at(spot: Spot) -> Texel<3> {
    let wide = fbm(spot.u, spot.v, (3, 3), 4, 861);
    let drawn = fbm(spot.u, spot.v, (4, 60), 3, 862);
    let pit = grain(spot.u, spot.v, (70, 70), 863);
    let hole = (1.0 - smooth(0.06, 0.16, pit.near)) * smooth(0.85, 0.92, pit.id);
    let chance = |salt: u32| 0.5 + 0.5 * noise(spot.u, spot.v, (3, 3), 864 + salt);
    Texel {
        height: 0.0006 * wide + 0.000_05 * drawn - 0.0006 * hole,
        colors: smoked(spot, chance, 3).map(|face| scale(face, 1.0 + 0.04 * drawn - 0.35 * hole)),
        rough: dullness(spot, 0.5 + 0.5 * wide),
        metal: 0.0,
    }
}
