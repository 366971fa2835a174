//! The colours of what is seen, in sun, sky and shadow.

use crate::render::raster::Grid;
use crate::render::view::{Hit, Triangle, View};
use crate::scene::{Image, Scene};
use crate::texture::samples::{self, Samples, encoded};
use glam::{DVec2, DVec3, dvec3};
use image::{GenericImageView, Rgb, RgbImage, RgbaImage};

/// Linear light of the background and of the ground.
pub(super) const SKY: DVec3 = dvec3(0.74, 0.80, 0.88);
const GROUND: DVec3 = dvec3(0.55, 0.52, 0.46);

/// What plain colour stands for a picture that an author made.
const OWN_PICTURE: DVec3 = dvec3(0.5, 0.5, 0.5);

/// What glass mirrors, and how much of it where nobody says so.
const MIRRORED: DVec3 = dvec3(0.10, 0.14, 0.19);
const MIRRORS: f64 = 0.5;

/// Light from the sky on what looks up, and on what looks down.
const FROM_ABOVE: f64 = 0.52;
const FROM_BELOW: f64 = 0.30;
const FROM_SUN: f64 = 0.85;

/// So far before what it falls on must lie what throws a shadow, metres.
const BIAS: f64 = 0.06;

/// What is drawn on a material.
enum Drawn<'a> {
    Plain,
    Surface(&'static Samples),
    /// A page of joinery.
    Page(&'a RgbaImage),
    /// A picture that an author made.
    Own(RgbImage),
}

/// How all materials of a scene look.
pub(super) struct Looks<'a> {
    scene: &'a Scene,
    drawn: Vec<Drawn<'a>>,
}

impl<'a> Looks<'a> {
    /// `pictures` are those that authors made, by their numbers; where there is none, a plain colour stands for it.
    pub(super) fn new(scene: &'a Scene, pictures: &dyn Fn(u32) -> Option<RgbImage>) -> Looks<'a> {
        let drawn = scene.materials.iter().map(|m| match m.image {
            Image::Surface(name) => samples::samples(name).map(Drawn::Surface),
            Image::Baked(page) => scene
                .baked
                .get(page as usize)
                .map(|b| Drawn::Page(&b.color)),
            Image::Picture(number) => pictures(number).map(Drawn::Own),
            Image::None => None,
        });
        Looks {
            scene,
            drawn: drawn.map(|d| d.unwrap_or(Drawn::Plain)).collect(),
        }
    }

    /// Whether a material has a hole at some weights of a triangle's corners.
    pub(super) fn open(&self, triangle: &Triangle, weights: [f64; 3]) -> bool {
        let Some(id) = triangle.material.map(|id| id.0 as usize) else {
            return false;
        };
        match &self.drawn[id] {
            Drawn::Page(page) if self.scene.materials[id].cutout => {
                let uv = triangle.uv(weights);
                pixel(*page, uv).is_some_and(|p| p.0[3] < 128)
            }
            _ => false,
        }
    }

    /// What colour a triangle has where a line meets it.
    fn dye(&self, triangle: &Triangle, weights: [f64; 3]) -> DVec3 {
        let Some(id) = triangle.material.map(|id| id.0 as usize) else {
            return GROUND;
        };
        let material = &self.scene.materials[id];
        let uv = triangle.uv(weights);
        let light = |c: [u8; 3]| DVec3::from_array(c.map(|c| f64::from(samples::linear(c))));
        let plain = match (&self.drawn[id], &material.image) {
            (Drawn::Surface(samples), _) => {
                DVec3::from_array(samples.at(uv.x, uv.y).color.map(f64::from))
            }
            (Drawn::Page(page), _) => pixel(*page, uv).map_or(OWN_PICTURE, |p| {
                let [r, g, b, _] = p.0;
                light([r, g, b])
            }),
            (Drawn::Own(picture), _) => pixel(picture, uv).map_or(OWN_PICTURE, |p| light(p.0)),
            (Drawn::Plain, Image::None) => DVec3::ONE,
            (Drawn::Plain, _) => OWN_PICTURE,
        };
        let [r, g, b, opacity] = material.tint.map(f64::from);
        let own = plain * dvec3(r, g, b);
        let glass = material.reflection.is_some() || opacity < 1.0;
        match glass {
            true => own.lerp(MIRRORED, material.reflection.map_or(MIRRORS, f64::from)),
            false => own,
        }
    }
}

/// The pixel at texture coordinates, v upwards.
fn pixel<I: GenericImageView>(picture: &I, uv: DVec2) -> Option<I::Pixel> {
    let (width, height) = picture.dimensions();
    let at = |t: f64, n: u32| ((t * f64::from(n)).max(0.0) as u32).min(n.saturating_sub(1));
    let (x, y) = (at(uv.x, width), at(1.0 - uv.y, height));
    (width > 0 && height > 0).then(|| picture.get_pixel(x, y))
}

/// The picture of what lines of sight meet first, `fine` x `fine` of them a pixel; `shade` is what the sun sees, and `sky`
/// what is behind everything.
pub(super) fn shine(
    triangles: &[Triangle],
    looks: &Looks<'_>,
    (grid, hits): (&Grid, &[Option<Hit>]),
    shade: &View,
    fine: u32,
    sky: impl Fn(DVec2) -> DVec3,
) -> RgbImage {
    let color = |hit: &Hit| {
        let triangle = &triangles[hit.triangle as usize];
        looks.dye(triangle, hit.weights.map(f64::from)) * light(triangle, hit, shade)
    };
    let (width, height) = (grid.width as u32 / fine, grid.height as u32 / fine);
    RgbImage::from_fn(width, height, |x, y| {
        let mut sum = DVec3::ZERO;
        for j in 0..fine {
            for i in 0..fine {
                // Rows of the grid run upwards.
                let row = grid.height - 1 - (y * fine + j) as usize;
                let place = row * grid.width + (x * fine + i) as usize;
                let hit = hits[place].as_ref();
                sum += hit.map_or_else(|| sky(grid.at(place)), color);
            }
        }
        let mean = sum / f64::from(fine * fine);
        Rgb(mean.to_array().map(|c| encoded(c as f32)))
    })
}

/// How much light falls where a line meets a triangle.
fn light(triangle: &Triangle, hit: &Hit, shade: &View) -> f64 {
    let [a, b, c] = hit.weights.map(f64::from);
    let [p, q, r] = triangle.corners;
    let at = p * a + q * b + r * c;
    let normal = triangle.normals[0] * a + triangle.normals[1] * b + triangle.normals[2] * c;
    let normal = normal.normalize_or_zero();
    let sun = -normal.dot(shade.frame.way());
    let sky = FROM_BELOW + (FROM_ABOVE - FROM_BELOW) * (0.5 + 0.5 * normal.z);
    if sun <= 0.0 {
        return sky;
    }
    // Away from the surface, so that it throws no shadow on itself, where the sun's lines stand far apart too.
    let bias = BIAS.max(1.5 * shade.grid.step);
    let from = at + normal * bias;
    let before = shade
        .grid
        .nearest(shade.frame.of(from))
        .and_then(|place| shade.hits[place]);
    let shaded = before.is_some_and(|h| h.depth < shade.frame.depth(from) - bias);
    match shaded {
        true => sky,
        false => sky + FROM_SUN * sun,
    }
}
