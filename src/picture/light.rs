//! The colours of what is seen, in sun, sky and shadow.

use super::view::{Hit, Triangle, View};
use crate::scene::{Image, Material, Scene};
use crate::texture::samples::{self, Samples, encoded};
use glam::{DVec3, dvec3};
use image::{Rgb, RgbImage};

/// Linear light of the background and of the ground.
const SKY: DVec3 = dvec3(0.74, 0.80, 0.88);
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

/// The picture of what is seen, `fine` x `fine` lines a pixel; `shade` is what the sun sees.
pub(super) fn shine(
    scene: &Scene,
    triangles: &[Triangle],
    seen: &View,
    shade: &View,
    fine: u32,
) -> RgbImage {
    let surfaces: Vec<Option<&Samples>> = scene.materials.iter().map(surface).collect();
    let color = |hit: &Hit| {
        let triangle = &triangles[hit.triangle as usize];
        let own = match triangle.material {
            None => GROUND,
            Some(id) => {
                let k = id.0 as usize;
                dye(&scene.materials[k], surfaces[k], triangle, hit)
            }
        };
        own * light(triangle, hit, shade)
    };
    let (width, height) = (
        seen.grid.width as u32 / fine,
        seen.grid.height as u32 / fine,
    );
    RgbImage::from_fn(width, height, |x, y| {
        let mut sum = DVec3::ZERO;
        for j in 0..fine {
            for i in 0..fine {
                // Rows of the grid run upwards.
                let row = seen.grid.height - 1 - (y * fine + j) as usize;
                let place = row * seen.grid.width + (x * fine + i) as usize;
                sum += seen.hits[place].as_ref().map_or(SKY, color);
            }
        }
        let mean = sum / f64::from(fine * fine);
        Rgb(mean.to_array().map(|c| encoded(c as f32)))
    })
}

/// The pictures of a material.
fn surface(material: &Material) -> Option<&'static Samples> {
    match material.image {
        Image::Surface(name) => samples::samples(name),
        Image::None | Image::Picture(_) | Image::Baked(_) => None,
    }
}

/// What colour a material has where a line meets it.
fn dye(material: &Material, surface: Option<&Samples>, triangle: &Triangle, hit: &Hit) -> DVec3 {
    let [a, b, c] = hit.weights.map(f64::from);
    let uv = triangle.uvs[0] * a + triangle.uvs[1] * b + triangle.uvs[2] * c;
    let plain = match (surface, &material.image) {
        (Some(samples), _) => DVec3::from_array(samples.at(uv.x, uv.y).color.map(f64::from)),
        (None, Image::None) => DVec3::ONE,
        (None, _) => OWN_PICTURE,
    };
    let [r, g, b, opacity] = material.tint.map(f64::from);
    let own = plain * dvec3(r, g, b);
    let glass = material.reflection.is_some() || opacity < 1.0;
    match glass {
        true => own.lerp(MIRRORED, material.reflection.map_or(MIRRORS, f64::from)),
        false => own,
    }
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
    // Away from the surface, so that it throws no shadow on itself.
    let from = at + normal * BIAS;
    let before = shade
        .grid
        .nearest(shade.frame.of(from))
        .and_then(|place| shade.hits[place]);
    let shaded = before.is_some_and(|h| h.depth < shade.frame.depth(from) - BIAS);
    match shaded {
        true => sky,
        false => sky + FROM_SUN * sun,
    }
}
