//! What the glass of facades mirrors, as pictures for viewers that know no mirrors (003-13, 003-14, 003-18).
//!
//! Walls of a house that lie in one plane mirror in one picture. The eye stands on the ground before the middle of their
//! panes, so far away that it has all of them within 60 degrees, but not beyond what stands opposite: somebody in the
//! street. In the picture are other houses, the wings of the own one, ground and sky, in the light of all pictures of
//! [`picture`](super); other glass mirrors nothing in it.
//!
//! - [`walls`]: which panes mirror, and how they come to show a picture;
//! - [`scenery`]: what stands in the beam of a wall.

mod scenery;
mod walls;

use crate::render::SUN;
use crate::render::beam::Beam;
use crate::render::light;
use crate::render::light::Looks;
use crate::render::raster::Grid;
use crate::render::view::{Frame, View};
use crate::scene::Scene;
use glam::{DVec2, DVec3, dvec2, dvec3};
use image::{RgbImage, imageops};
use scenery::Town;
use walls::Wall;

/// Lines of sight a pixel in each direction.
const FINE: u32 = 2;

/// Most pixels a metre: what is mirrored is seen from afar.
const DENSITY: f64 = 48.0;

/// Rows of pixels that are drawn at once.
const BAND: u32 = 64;

/// Height of the eye above the ground, metres.
const EYE: f64 = 1.6;

/// The eye comes no nearer, metres.
const NEAREST: f64 = 2.0;

/// Of the way to what stands opposite, how far the eye goes.
const FREE: f64 = 0.9;

/// How far to go for each metre of wall, to see it within 60 degrees.
const AWAY: f64 = 0.866;

/// Lines of the sun in each direction, and how far from the wall shadows fall, metres.
const SUNBEAMS: u32 = 1024;
const SHADOWS: f64 = 60.0;

/// Linear light of the sky at the horizon and overhead: darker than sunlit plaster, as in a photograph of both.
const HORIZON: DVec3 = dvec3(0.56, 0.66, 0.78);
const ZENITH: DVec3 = dvec3(0.16, 0.30, 0.58);

/// What is wished for of the pictures.
#[derive(Clone, Copy, Debug)]
pub struct Wishes {
    /// Where the eye stands, metres to the east and north and up; walls that turn their backs on it are seen by one of
    /// their own.
    pub eye: Option<DVec3>,
    /// Most pixels of a picture's longer side.
    pub longest: u32,
}

/// Draws what walls mirror into pictures of the scene, and lets their panes show them; returns how many there are.
/// `pictures` are those that authors made, by their numbers.
pub fn bake(
    scene: &mut Scene,
    wishes: Wishes,
    pictures: &dyn Fn(u32) -> Option<RgbImage>,
) -> usize {
    let walls = walls::walls(scene);
    if walls.is_empty() {
        return 0;
    }
    let town = Town::new(scene);
    let looks = Looks::new(scene, pictures);
    let drawn: Vec<(Sheet, RgbImage)> = walls
        .iter()
        .map(|wall| {
            let sheet = Sheet::of(wall, wishes.longest);
            (sheet, draw(&town, &looks, wall, sheet, wishes.eye))
        })
        .collect();
    let count = drawn.len();
    walls::show(scene, walls, drawn);
    count
}

/// How a picture lies on the plane of a wall.
#[derive(Clone, Copy, Debug)]
struct Sheet {
    low: DVec2,
    /// Metres.
    size: DVec2,
    /// Pixels.
    pixels: (u32, u32),
}

impl Sheet {
    /// A sheet over all panes of a wall. Its sides are multiples of four pixels, as graphics cards want them.
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

    /// Metres of a pixel.
    fn pixel(&self) -> f64 {
        self.size.x / f64::from(self.pixels.0)
    }
}

/// The picture of what a wall mirrors.
fn draw(
    town: &Town<'_>,
    looks: &Looks<'_>,
    wall: &Wall,
    sheet: Sheet,
    wished: Option<DVec3>,
) -> RgbImage {
    let beam = Beam {
        eye: eye(town, wall, wished),
        low: sheet.low,
        high: sheet.low + sheet.size,
    };
    let triangles = town.in_beam(wall, &beam);
    let plane = wall.plane;
    let corners: Vec<[DVec3; 3]> = triangles
        .iter()
        .map(|t| t.corners.map(|p| plane.of(p)))
        .collect();
    let open = |triangle: &_, weights| looks.open(triangle, weights);
    let sun = Frame::new(SUN);
    let near = corners.iter().flatten().filter(|p| p.z < SHADOWS);
    let lit = near.filter(|p| p.truncate().abs().max_element() < 4.0 * SHADOWS);
    let lit = lit.map(|p| sun.of(plane.world(*p)));
    let lit = Grid::around(lit, (SUNBEAMS, SUNBEAMS), 0.01);
    let shade = View::of(&town.under(&sun, &lit), sun, lit, open);
    let step = sheet.pixel() / f64::from(FINE);
    let sky = |q: DVec2| HORIZON.lerp(ZENITH, beam.way(q).y.clamp(0.0, 1.0));
    let (width, height) = sheet.pixels;
    let band = |first: u32| {
        let rows = BAND.min(height - first);
        // Rows of a grid run upwards, those of a picture downwards.
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
        light::shine(&triangles, looks, (&grid, &hits), &shade, FINE, sky)
    };
    let bands: Vec<u32> = (0..height).step_by(BAND as usize).collect();
    let mut picture = RgbImage::new(width, height);
    for (first, part) in bands
        .iter()
        .zip(crate::render::on_all_processors(&bands, |f| band(*f)))
    {
        imageops::replace(&mut picture, &part, 0, i64::from(*first));
    }
    picture
}

/// Where the eye stands, in the plane's frame.
fn eye(town: &Town<'_>, wall: &Wall, wished: Option<DVec3>) -> DVec3 {
    let wished = wished.map(|eye| wall.plane.of(eye));
    if let Some(eye) = wished.filter(|eye| eye.z >= NEAREST / 4.0) {
        return eye;
    }
    let middle = (wall.low.x + wall.high.x) / 2.0;
    let height = wall.ground + EYE;
    let above = (wall.high.y - height).max(0.0);
    let whole = AWAY * (wall.high.x - wall.low.x).max(2.0 * above);
    let free = town.free(wall, dvec2(middle, height), NEAREST);
    let away = free.map_or(whole, |free| whole.min(free * FREE));
    dvec3(middle, height, away.max(NEAREST))
}
