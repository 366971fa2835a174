//! Shading with sun, sky and shadows.

use crate::raster::Grid;
use crate::view::{Hit, Triangle, View};
use glam::{DVec2, DVec3, dvec3};
use hsd_scene::texture::palette;
use hsd_scene::texture::samples::{self, Samples, encoded};
use hsd_scene::{Image, Scene};
use image::{GenericImageView, Rgb, RgbImage, RgbaImage};

/// Linear colours of the background and of the ground.
pub(super) const SKY: DVec3 = dvec3(0.74, 0.80, 0.88);
const GROUND: DVec3 = dvec3(0.55, 0.52, 0.46);

/// The plain colour of custom images that are not available.
const OWN_PICTURE: DVec3 = dvec3(0.5, 0.5, 0.5);

/// The colour that glass reflects, and its default reflectance.
const MIRRORED: DVec3 = dvec3(0.10, 0.14, 0.19);
const MIRRORS: f64 = 0.5;

/// Light on surfaces facing up and down, from the sky, and from the sun.
const FROM_ABOVE: f64 = 0.52;
const FROM_BELOW: f64 = 0.30;
const FROM_SUN: f64 = 0.85;

/// The minimum distance between an occluder and its shadow in metres.
const BIAS: f64 = 0.06;

/// The texture of a material.
enum Texture {
    Plain,
    /// The picture of all colours.
    Colours,
    Surface(&'static Samples),
    /// A baked texture of parts.
    Page(RgbaImage),
    /// A custom image.
    Own(RgbImage),
}

/// The appearance of all materials of a scene.
pub(super) struct Appearance<'a> {
    scene: &'a Scene,
    textures: Vec<Texture>,
}

impl<'a> Appearance<'a> {
    /// Collects the textures; `pictures` returns custom images by index, and missing ones are replaced by a plain colour.
    pub(super) fn new(
        scene: &'a Scene,
        pictures: &dyn Fn(u32) -> Option<RgbImage>,
    ) -> Appearance<'a> {
        let textures = scene.materials.iter().map(|m| match m.image {
            Image::Surface(palette::COLOURS) => Some(Texture::Colours),
            Image::Surface(name) => samples::samples(name).map(Texture::Surface),
            Image::Baked(page) => scene
                .baked
                .get(page as usize)
                .and_then(|b| image::load_from_memory(&b.color).ok())
                .map(|page| Texture::Page(page.into_rgba8())),
            Image::Picture(number) => pictures(number).map(Texture::Own),
            Image::None => None,
        });
        Appearance {
            scene,
            textures: textures.map(|t| t.unwrap_or(Texture::Plain)).collect(),
        }
    }

    /// Returns whether a triangle has a hole at some weights.
    pub(super) fn open(&self, triangle: &Triangle, weights: [f64; 3]) -> bool {
        let Some(id) = triangle.material.map(|id| id.0 as usize) else {
            return false;
        };
        match &self.textures[id] {
            Texture::Page(page) if self.scene.materials[id].cutout => {
                let uv = triangle.uv(weights);
                pixel(page, uv).is_some_and(|p| p.0[3] < 128)
            }
            _ => false,
        }
    }

    /// Returns the unlit colour of a triangle at some weights.
    fn dye(&self, triangle: &Triangle, weights: [f64; 3]) -> DVec3 {
        let Some(id) = triangle.material.map(|id| id.0 as usize) else {
            return GROUND;
        };
        let material = &self.scene.materials[id];
        let uv = triangle.uv(weights);
        let light = |c: [u8; 3]| DVec3::from_array(c.map(|c| f64::from(samples::linear(c))));
        let plain = match (&self.textures[id], &material.image) {
            (Texture::Surface(samples), _) => {
                DVec3::from_array(samples.at(uv.x, uv.y).color.map(f64::from))
            }
            (Texture::Colours, _) => {
                let [u, v] = uv.as_vec2().to_array();
                DVec3::from_array(palette::colour([u, v]).map(f64::from))
            }
            (Texture::Page(page), _) => pixel(page, uv).map_or(OWN_PICTURE, |p| {
                let [r, g, b, _] = p.0;
                light([r, g, b])
            }),
            (Texture::Own(picture), _) => pixel(picture, uv).map_or(OWN_PICTURE, |p| light(p.0)),
            (Texture::Plain, Image::None) => DVec3::ONE,
            (Texture::Plain, _) => OWN_PICTURE,
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

/// Returns the pixel at texture coordinates, with v upwards.
fn pixel<I: GenericImageView>(picture: &I, uv: DVec2) -> Option<I::Pixel> {
    let (width, height) = picture.dimensions();
    let at = |t: f64, n: u32| ((t * f64::from(n)).max(0.0) as u32).min(n.saturating_sub(1));
    let (x, y) = (at(uv.x, width), at(1.0 - uv.y, height));
    (width > 0 && height > 0).then(|| picture.get_pixel(x, y))
}

/// Shades the hits of rays, `fine` x `fine` per pixel; `shade` is the view from the sun, and `sky` returns the background.
pub(super) fn shine(
    triangles: &[Triangle],
    appearance: &Appearance<'_>,
    (grid, hits): (&Grid, &[Option<Hit>]),
    shade: &View,
    fine: u32,
    sky: impl Fn(DVec2) -> DVec3,
) -> RgbImage {
    let color = |hit: &Hit| {
        let triangle = &triangles[hit.triangle as usize];
        appearance.dye(triangle, hit.weights.map(f64::from)) * light(triangle, hit, shade)
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

/// Returns the light at a hit.
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
    // Offset from the surface to avoid self-shadowing, also with a coarse grid.
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
