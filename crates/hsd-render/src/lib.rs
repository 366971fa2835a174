//! The software renderer: parallel projections in sunlight with shadows, for contact sheets, and reflections for
//! `--bake`.
//!
//! - [`raster`]: intersection of parallel rays with triangles;
//! - [`view`]: the nearest hit of each ray;
//! - [`light`]: shading with sun, sky and shadows;
//! - [`sheet`]: contact sheets with seed numbers;
//! - [`beam`]: the nearest hits of rays reflected by a plane;
//! - [`mirror`]: reflections baked into textures.

pub mod beam;
mod digits;
mod light;
pub mod mirror;
pub mod raster;
pub mod sheet;
pub mod view;

use glam::{DVec3, dvec3};
use hsd_scene::{NodeId, Scene};
use image::RgbImage;
use raster::Grid;
use view::{Frame, Triangle, View};

/// Rays per pixel in each direction.
const FINE: u32 = 3;

/// The margin around the house, as a fraction of the image.
const MARGIN: f64 = 0.06;

/// The viewing direction: from the front left and above.
const WAY: DVec3 = dvec3(0.42, 0.86, -0.27);

/// The direction of sunlight.
const SUN: DVec3 = dvec3(0.62, 0.55, -0.80);

/// The extent of the ground around the house in metres.
const GROUND: f64 = 90.0;

/// Renders some houses of a scene to an image of `width` x `height` pixels.
pub fn picture(scene: &Scene, houses: &[NodeId], (width, height): (u32, u32)) -> RgbImage {
    let mut triangles = view::triangles(scene, houses);
    let eye = Frame::new(WAY);
    let grid = Grid::around(
        triangles.iter().flat_map(|t| t.corners).map(|p| eye.of(p)),
        (width * FINE, height * FINE),
        MARGIN,
    );
    triangles.extend(ground(&triangles));
    let appearance = light::Appearance::new(scene, &|_| None);
    let open = |triangle: &Triangle, weights| appearance.open(triangle, weights);
    let seen = View::of(&triangles, eye, grid, open);
    let sun = Frame::new(SUN);
    // Shadows need no finer grid than the image.
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
    light::shine(&triangles, &appearance, seen, &shade, FINE, |_| light::SKY)
}

/// Returns the ground below the triangles.
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

/// Maps items in parallel, keeping their order.
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
