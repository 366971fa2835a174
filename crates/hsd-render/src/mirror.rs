//! Reflections of facade glass baked into textures, for viewers that cannot draw reflections (003-13, 003-14, 003-18).
//!
//! Coplanar walls of a house share one texture. The viewpoint is above the ground in front of the centre of their panes, far
//! enough away to see all of them within 60 degrees, but not beyond the building opposite. The texture shows other houses,
//! other wings of the house itself, ground and sky, lit as by [`picture`](super); it has no reflections of reflections.
//!
//! - [`walls`]: the reflecting panes and their texture coordinates;
//! - [`scenery`]: the geometry within the beam of a wall.

mod scenery;
mod walls;

use crate::SUN;
use crate::beam::Beam;
use crate::light;
use crate::light::Appearance;
use crate::raster::Grid;
use crate::view::{Frame, View};
use glam::{DVec2, DVec3, dvec2, dvec3};
use hsd_scene::Scene;
use image::{RgbImage, imageops};
use scenery::PlacedScene;
use walls::Wall;

/// Rays per pixel in each direction.
const FINE: u32 = 2;

/// The maximum resolution in pixels per metre: reflections are seen from a distance.
const DENSITY: f64 = 48.0;

/// Rows of pixels rendered at once.
const BAND: u32 = 64;

/// The height of the viewpoint above the ground in metres.
const EYE: f64 = 1.6;

/// The minimum distance of the viewpoint in metres.
const NEAREST: f64 = 2.0;

/// The maximum distance of the viewpoint, as a fraction of the distance to the building opposite.
const FREE: f64 = 0.9;

/// The distance per metre of wall at which it is seen within 60 degrees.
const AWAY: f64 = 0.866;

/// Sun rays in each direction, and the extent of shadows from the wall in metres.
const SUNBEAMS: u32 = 1024;
const SHADOWS: f64 = 60.0;

/// Linear sky colours at the horizon and the zenith; darker than sunlit plaster, as in a photograph.
const HORIZON: DVec3 = dvec3(0.56, 0.66, 0.78);
const ZENITH: DVec3 = dvec3(0.16, 0.30, 0.58);

/// Options of baking.
#[derive(Clone, Copy, Debug)]
pub struct BakeOptions {
    /// The viewpoint in metres east, north and up; walls that face away from it use their default viewpoint.
    pub eye: Option<DVec3>,
    /// The maximum number of pixels of the longer side of a texture.
    pub longest: u32,
}

/// Bakes the reflections of all walls of the scene and assigns them to their panes; returns the number of textures.
/// `pictures` returns custom images by index.
pub fn bake(
    scene: &mut Scene,
    options: BakeOptions,
    pictures: &dyn Fn(u32) -> Option<RgbImage>,
) -> usize {
    let walls = walls::walls(scene);
    if walls.is_empty() {
        return 0;
    }
    let scenery = PlacedScene::new(scene);
    let appearance = Appearance::new(scene, pictures);
    let drawn: Vec<(Sheet, RgbImage)> = walls
        .iter()
        .map(|wall| {
            let sheet = Sheet::of(wall, options.longest);
            (sheet, draw(&scenery, &appearance, wall, sheet, options.eye))
        })
        .collect();
    let count = drawn.len();
    walls::show(scene, walls, drawn);
    count
}

/// The position of a texture on the plane of a wall.
#[derive(Clone, Copy, Debug)]
struct Sheet {
    low: DVec2,
    /// The size in metres.
    size: DVec2,
    /// The size in pixels.
    pixels: (u32, u32),
}

impl Sheet {
    /// Returns the texture that covers all panes of a wall. Its sides are multiples of four pixels, for texture compression.
    fn of(wall: &Wall, longest: u32) -> Sheet {
        let longest = (longest & !3).max(4);
        let span = (wall.high - wall.low).max(DVec2::splat(1e-3));
        let density = DENSITY.min(f64::from(longest) / span.max_element());
        let side = |metres: f64| {
            ((metres * density).ceil() as u32)
                .next_multiple_of(4)
                .min(longest)
        };
        let pixels = (side(span.x), side(span.y));
        Sheet {
            low: wall.low,
            size: dvec2(f64::from(pixels.0), f64::from(pixels.1)) / density,
            pixels,
        }
    }

    /// Returns the size of a pixel in metres.
    fn pixel(&self) -> f64 {
        self.size.x / f64::from(self.pixels.0)
    }
}

/// Renders the reflection of a wall.
fn draw(
    scenery: &PlacedScene<'_>,
    appearance: &Appearance<'_>,
    wall: &Wall,
    sheet: Sheet,
    requested: Option<DVec3>,
) -> RgbImage {
    let beam = Beam {
        eye: eye(scenery, wall, requested),
        low: sheet.low,
        high: sheet.low + sheet.size,
    };
    let triangles = scenery.in_beam(wall, &beam);
    let plane = wall.plane;
    let corners: Vec<[DVec3; 3]> = triangles
        .iter()
        .map(|t| t.corners.map(|p| plane.of(p)))
        .collect();
    let open = |triangle: &_, weights| appearance.open(triangle, weights);
    let sun = Frame::new(SUN);
    let near = corners.iter().flatten().filter(|p| p.z < SHADOWS);
    let lit = near.filter(|p| p.truncate().abs().max_element() < 4.0 * SHADOWS);
    let lit = lit.map(|p| sun.of(plane.world(*p)));
    let lit = Grid::around(lit, (SUNBEAMS, SUNBEAMS), 0.01);
    let shade = View::of(&scenery.under(&sun, &lit), sun, lit, open);
    let step = sheet.pixel() / f64::from(FINE);
    let sky = |q: DVec2| HORIZON.lerp(ZENITH, beam.way(q).y.clamp(0.0, 1.0));
    let (width, height) = sheet.pixels;
    let band = |first: u32| {
        let rows = BAND.min(height - first);
        // Rows of a grid run upwards, those of an image downwards.
        let below = f64::from((height - first - rows) * FINE) * step;
        let origin = sheet.low + dvec2(0.0, below) + step / 2.0;
        let grid = Grid {
            origin,
            step,
            width: (width * FINE) as usize,
            height: (rows * FINE) as usize,
        };
        let part = Beam {
            low: origin - step,
            high: grid.at(grid.width * grid.height - 1) + step,
            ..beam
        };
        let hits = part.look(&triangles, &corners, &grid, open);
        light::shine(&triangles, appearance, (&grid, &hits), &shade, FINE, sky)
    };
    let bands: Vec<u32> = (0..height).step_by(BAND as usize).collect();
    let mut picture = RgbImage::new(width, height);
    for (first, part) in bands
        .iter()
        .zip(crate::on_all_processors(&bands, |f| band(*f)))
    {
        imageops::replace(&mut picture, &part, 0, i64::from(*first));
    }
    picture
}

/// Returns the viewpoint in the frame of the plane.
fn eye(scenery: &PlacedScene<'_>, wall: &Wall, requested: Option<DVec3>) -> DVec3 {
    let requested = requested.map(|eye| wall.plane.of(eye));
    if let Some(eye) = requested.filter(|eye| eye.z >= NEAREST / 4.0) {
        return eye;
    }
    let middle = (wall.low.x + wall.high.x) / 2.0;
    let height = wall.ground + EYE;
    let above = (wall.high.y - height).max(0.0);
    let whole = AWAY * (wall.high.x - wall.low.x).max(2.0 * above);
    let free = scenery.free(wall, dvec2(middle, height), NEAREST);
    let away = free.map_or(whole, |free| whole.min(free * FREE));
    dvec3(middle, height, away.max(NEAREST))
}
