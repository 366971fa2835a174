//! The drawn textures: seamless, true, and the same bytes everywhere.

use super::{Maps, draw, encode};
use hsd_scene::texture::{COLOR_SIZE, SURFACES, Surface, embedded, look};
use image::RgbImage;

/// Small enough to draw all surfaces in a moment.
const SMALL: u32 = 256;

/// Calls `check` for every surface, on all processors.
fn for_each_surface(check: impl Fn(&'static Surface) + Sync) {
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for worker in 0..workers {
            let check = &check;
            scope.spawn(move || {
                SURFACES
                    .iter()
                    .skip(worker)
                    .step_by(workers)
                    .for_each(check)
            });
        }
    });
}

/// Mean difference of two columns of pixels.
fn step(picture: &RgbImage, left: u32, right: u32) -> f64 {
    let sum: u32 = (0..picture.height())
        .flat_map(|y| {
            let (a, b) = (picture.get_pixel(left, y).0, picture.get_pixel(right, y).0);
            [0, 1, 2].map(|c| u32::from(a[c].abs_diff(b[c])))
        })
        .sum();
    f64::from(sum) / f64::from(picture.height() * 3)
}

/// The step around the edge may be as great as the greatest step inside, not greater: a course
/// of tiles may end at the edge, but the picture may not.
fn assert_closes(picture: &RgbImage, what: &str) {
    let last = picture.width() - 1;
    let inside = (0..last)
        .map(|x| step(picture, x, x + 1))
        .fold(0.0, f64::max);
    let around = step(picture, last, 0);
    assert!(
        around <= inside * 1.1 + 0.1,
        "{what}: {around} around the edge, {inside} inside"
    );
}

#[test]
fn surfaces_close_on_themselves() {
    for_each_surface(|surface| {
        let Maps {
            colors,
            normal,
            orm,
        } = draw(surface, SMALL);
        let names = surface.looks.iter().map(|look| look.name);
        let colors = colors.into_iter().zip(names);
        for (picture, kind) in colors.chain([(normal, "normal"), (orm, "orm")]) {
            assert_closes(&picture, &format!("{} {kind} along u", surface.name));
            let turned = image::imageops::rotate90(&picture);
            assert_closes(&turned, &format!("{} {kind} along v", surface.name));
        }
    });
}

#[test]
#[ignore = "draws all surfaces: `.ci/nightly tests`"]
fn embedded_files_are_what_the_formulas_draw() {
    for_each_surface(|surface| {
        for (file, bytes) in encode(surface) {
            let committed = embedded(&file).unwrap_or_else(|| panic!("{file} is not embedded"));
            assert!(
                bytes == committed,
                "{file} differs from textures/{file}; run `cargo run --release -p xtask -- textures` and look at them"
            );
        }
    });
}

#[test]
fn normals_are_unit_vectors_that_face_outwards() {
    for_each_surface(|surface| {
        for pixel in draw(surface, SMALL).normal.pixels() {
            let n = pixel.0.map(|c| f64::from(c) / 127.5 - 1.0);
            let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
            assert!((length - 1.0).abs() < 0.012, "{}: {n:?}", surface.name);
            assert!(n[2] > 0.0, "{}: {n:?}", surface.name);
        }
    });
}

#[test]
fn occlusion_is_left_to_the_renderer() {
    for_each_surface(|surface| {
        let maps = draw(surface, 32);
        assert!(
            maps.orm.pixels().all(|pixel| pixel.0[0] == 255),
            "{}",
            surface.name
        );
    });
}

#[test]
fn drawing_twice_gives_the_same_pictures() {
    for_each_surface(|surface| {
        assert_eq!(draw(surface, 64), draw(surface, 64), "{}", surface.name);
    });
}

#[test]
fn relief_faces_the_right_way() {
    // Feet of roof tiles are proud: going down the slope the surface drops at each foot, so many
    // normals there lean down (green below the middle), few lean sharply up.
    let kawara = look("kawara_new").expect("kawara is drawn").0;
    let normals = draw(kawara, COLOR_SIZE).normal;
    let lean = |test: fn(u8) -> bool| normals.pixels().filter(|p| test(p.0[1])).count();
    assert!(lean(|green| green < 60) > 4 * lean(|green| green > 195));
}
