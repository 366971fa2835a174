//! Levels of detail keep their silhouette: seen from the front, from the side and from above, an example covers nearly the same
//! area at each detail.

use crate::support::depths::skins_of;
use crate::support::{assert_none, compile_file, on_all_processors, stem, texts_in_turn, thorough};
use glam::{DVec2, DVec3, dvec2};
use hsd::driver;
use hsd::scene::{Detail, Scene};

/// The cells of a picture along its longer side.
const CELLS: usize = 500;

/// The most of the area of detail 3 by which the silhouette of each lower detail may differ: at detail 0 there are no gutters,
/// ridges, verandas and posts that stand free.
const MOST: [f64; 3] = [0.10, 0.05, 0.03];

/// What is less deep is a front without a house behind it, metres.
const SHEET: f64 = 1.5;

/// Where a point is in a picture.
type Place = fn(DVec3) -> DVec2;

/// Directions, and the place of a point in their pictures.
const SIDES: [(&str, Place); 3] = [
    ("the front", |p| dvec2(p.x, p.z)),
    ("the side", |p| dvec2(p.y, p.z)),
    ("above", |p| dvec2(p.x, p.y)),
];

/// The frame of a picture.
#[derive(Clone, Copy)]
struct Frame {
    low: DVec2,
    cell: f64,
    size: [usize; 2],
}

/// The triangles of a scene in a picture.
fn flat(scene: &Scene, place: Place) -> Vec<[DVec2; 3]> {
    let skins = skins_of(scene).into_iter();
    skins.map(|(corners, _)| corners.map(place)).collect()
}

/// The cells whose middles are covered.
fn covered(triangles: &[[DVec2; 3]], frame: Frame) -> Vec<bool> {
    let [wide, high] = frame.size;
    let mut cells = vec![false; wide * high];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|p| (p - frame.low) / frame.cell - 0.5);
        let whole = (b - a).perp_dot(c - a);
        if whole == 0.0 {
            continue;
        }
        let (lo, hi) = (a.min(b).min(c), a.max(b).max(c));
        let range = |lo: f64, hi: f64, most: usize| {
            let first = lo.ceil().max(0.0) as usize;
            first..((hi.floor() + 1.0).max(0.0) as usize).min(most)
        };
        for y in range(lo.y, hi.y, high) {
            for x in range(lo.x, hi.x, wide) {
                let p = dvec2(x as f64, y as f64);
                let inside = |q: DVec2, r: DVec2| (r - q).perp_dot(p - q) * whole >= 0.0;
                if inside(a, b) && inside(b, c) && inside(c, a) {
                    cells[y * wide + x] = true;
                }
            }
        }
    }
    cells
}

#[test]
fn every_detail_keeps_its_silhouette() {
    let examples = texts_in_turn("examples", 3);
    assert_none(&on_all_processors(examples.len(), |index| {
        let run = compile_file(&examples[index]);
        let scenes = Detail::ALL.map(|d| driver::scene(&run.building, &run.catalog, d));
        let mut found = vec![];
        let in_turn = SIDES
            .iter()
            .enumerate()
            .filter(|(k, _)| thorough() || k % 3 == index % 3);
        for (_, &(side, place)) in in_turn {
            let all = scenes.each_ref().map(|scene| flat(scene, place));
            let points = || all[3].iter().flatten().copied();
            let low = points().fold(DVec2::MAX, DVec2::min);
            let high = points().fold(DVec2::MIN, DVec2::max);
            // A margin for what stands out at another detail.
            let cell = (high - low).max_element() / (CELLS as f64 * 0.9);
            let frame = Frame {
                low: (low + high) / 2.0 - cell * CELLS as f64 / 2.0,
                cell,
                size: [CELLS; 2],
            };
            let shapes = all.each_ref().map(|triangles| covered(triangles, frame));
            let area = shapes[3].iter().filter(|c| **c).count() as f64;
            // A front alone is a sheet at detail 0: from the side there is nothing of it.
            let first = usize::from((high - low).min_element() < SHEET);
            for (detail, most) in MOST.into_iter().enumerate().skip(first) {
                let both = shapes[detail].iter().zip(&shapes[3]);
                let apart = both.filter(|(a, b)| a != b).count() as f64 / area;
                if apart > most {
                    let name = stem(&examples[index]);
                    found.push(format!("{name} at detail {detail} from {side}: {apart:.4}"));
                }
            }
        }
        found
    }));
}
