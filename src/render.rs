//! Pictures of scenes, drawn without a browser: what an eye far away sees along parallel lines, in sunlight with shadows.
//! For contact sheets, where many houses are compared; for the look of one, open its model in a viewer.
//!
//! - [`raster`]: which lines of sight meet a triangle, and where;
//! - [`view`]: the nearest thing on each line;
//! - [`light`]: its colour in sun and shadow;
//! - [`sheet`]: pictures side by side, with their numbers;
//! - [`beam`]: the nearest thing on lines that an eye sends over a mirror;
//! - [`mirror`]: what the glass of facades mirrors, as pictures for plain viewers.

pub mod beam;
mod digits;
mod light;
pub mod mirror;
pub mod raster;
pub mod sheet;
pub mod view;

use crate::scene::{NodeId, Scene};
use glam::{DVec3, dvec3};
use image::RgbImage;
use raster::Grid;
use view::{Frame, Triangle, View};

/// Lines of sight a pixel in each direction.
const FINE: u32 = 3;

/// Share of a picture that is left free round the house.
const MARGIN: f64 = 0.06;

/// Where the eye looks to: from the left before the house, and from above.
const WAY: DVec3 = dvec3(0.42, 0.86, -0.27);

/// Where the sun shines to.
const SUN: DVec3 = dvec3(0.62, 0.55, -0.80);

/// How far the ground is drawn round the house, metres.
const GROUND: f64 = 90.0;

/// A picture of some houses of a scene, so many pixels wide and high.
pub fn picture(scene: &Scene, houses: &[NodeId], (width, height): (u32, u32)) -> RgbImage {
    let mut triangles = view::triangles(scene, houses);
    let eye = Frame::new(WAY);
    let grid = Grid::around(
        triangles.iter().flat_map(|t| t.corners).map(|p| eye.of(p)),
        (width * FINE, height * FINE),
        MARGIN,
    );
    triangles.extend(ground(&triangles));
    let looks = light::Looks::new(scene, &|_| None);
    let open = |triangle: &Triangle, weights| looks.open(triangle, weights);
    let seen = View::of(&triangles, eye, grid, open);
    let sun = Frame::new(SUN);
    // A shadow needs no finer grid than the picture has.
    let lit = Grid::around(
        triangles
            .iter()
            .filter(|t| t.material.is_some())
            .flat_map(|t| t.corners)
            .map(|p| sun.of(p)),
        (width * FINE, width * FINE),
        0.01,
    );
    let shade = View::of(&triangles, sun, lit, open);
    let seen = (&seen.grid, &*seen.hits);
    light::shine(&triangles, &looks, seen, &shade, FINE, |_| light::SKY)
}

/// The ground under everything.
fn ground(triangles: &[Triangle]) -> [Triangle; 2] {
    let corners = triangles.iter().flat_map(|t| t.corners);
    let start = (DVec3::MAX, DVec3::MIN);
    let (low, high) = corners.fold(start, |(l, h), p| (l.min(p), h.max(p)));
    let (low, high, z) = match low.x <= high.x {
        true => (low - GROUND, high + GROUND, low.z),
        false => (DVec3::splat(-GROUND), DVec3::splat(GROUND), 0.0),
    };
    let at = |x: f64, y: f64| dvec3(x, y, z - 0.01);
    let [a, b, c, d] = [
        at(low.x, low.y),
        at(high.x, low.y),
        at(high.x, high.y),
        at(low.x, high.y),
    ];
    [[a, b, c], [a, c, d]].map(Triangle::ground)
}

/// What comes of every item, in their order, made on all processors.
fn on_all_processors<I: Sync, T: Send>(items: &[I], one: impl Fn(&I) -> T + Sync) -> Vec<T> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let share = items.len().div_ceil(threads).max(1);
    let one = &one;
    std::thread::scope(|scope| {
        let jobs: Vec<_> = items
            .chunks(share)
            .map(|some| scope.spawn(move || some.iter().map(one).collect::<Vec<_>>()))
            .collect();
        let done = jobs.into_iter().map(|job| job.join().unwrap_or_default());
        done.flatten().collect()
    })
}
