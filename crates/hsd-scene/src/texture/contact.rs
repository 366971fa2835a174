//! The contact sheet: every look on a wall one bay wide, all at one scale, lit by a low sun from the upper left.

use image::{Rgb as Pixel, RgbImage, imageops};

use super::{COLOR_SIZE, Look, ORM_SIZE, SURFACES, Surface, embedded};
use rayon::prelude::*;
use std::sync::LazyLock;

/// Width of a swatch in metres: the bay of three shaku.
const BAY: f64 = 10.0 / 11.0;
/// Width of a swatch in pixels, and of the gap beside it.
const SIDE: u32 = 156;
const GAP: u32 = 4;
/// Number of swatches in a row.
const COLUMNS: u32 = 10;
/// Samples along each side of a pixel.
const FINE: u32 = 4;

/// Direction of the sun, in the frame of the normals; then halfway between the sun and the eye.
const SUN: [f64; 3] = [-0.55, 0.55, 0.628];
const HALF: [f64; 3] = [-0.305, 0.305, 0.902];

/// Returns a JPEG of all looks in the order of the table, ten per row.
pub fn contact_sheet() -> Vec<u8> {
    let swatches: Vec<RgbImage> = SURFACES
        .par_iter()
        .flat_map(|surface| surface.looks.par_iter().map(|look| swatch(surface, look)))
        .collect();
    let rows = (swatches.len() as u32).div_ceil(COLUMNS);
    let mut sheet = RgbImage::from_pixel(
        COLUMNS * (SIDE + GAP) + GAP,
        rows * (SIDE + GAP) + GAP,
        Pixel([255; 3]),
    );
    for (swatch, k) in swatches.iter().zip(0_u32..) {
        let at = |n: u32| i64::from(GAP + n * (SIDE + GAP));
        imageops::replace(&mut sheet, swatch, at(k % COLUMNS), at(k / COLUMNS));
    }
    super::files::jpeg(&sheet, 66)
}

/// Returns the contents of an embedded file.
fn decoded_file(file: &str) -> RgbImage {
    let image = embedded(file).and_then(|bytes| image::load_from_memory(bytes).ok());
    image.expect("each look has its files").into_rgb8()
}

/// Renders the swatch of a look.
fn swatch(surface: &Surface, look: &Look) -> RgbImage {
    let color = decoded_file(&look.color_file());
    let normal = decoded_file(&surface.normal_file());
    let orm = decoded_file(&surface.orm_file());
    RgbImage::from_fn(SIDE, SIDE, |x, y| {
        let mut sum = [0.0; 3];
        for k in 0..FINE * FINE {
            let (i, j) = (x * FINE + k % FINE, y * FINE + k / FINE);
            let at = |n: u32| {
                let metres = (f64::from(n) + 0.5) / f64::from(SIDE * FINE) * BAY;
                (metres / surface.metres * f64::from(COLOR_SIZE)) as u32 % COLOR_SIZE
            };
            let (x, y) = (at(i), at(j));
            let shrunk = COLOR_SIZE / ORM_SIZE;
            let orm = orm.get_pixel(x / shrunk, y / shrunk).0;
            let light = lit(color.get_pixel(x, y).0, normal.get_pixel(x, y).0, orm);
            sum = [0, 1, 2].map(|c| sum[c] + light[c]);
        }
        Pixel(sum.map(|light| encoded(light / f64::from(FINE * FINE))))
    })
}

/// Returns the light that a texel reflects, linear RGB.
fn lit(color: [u8; 3], normal: [u8; 3], orm: [u8; 3]) -> [f64; 3] {
    let n = normal.map(|c| f64::from(c) / 127.5 - 1.0);
    let [_, rough, metal] = orm.map(|c| f64::from(c) / 255.0);
    let dot = |way: [f64; 3]| (0..3).map(|i| n[i] * way[i]).sum::<f64>().max(0.0);
    let (sun, glance) = (dot(SUN), dot(HALF));
    // A lobe as wide as the roughness; its height keeps the energy.
    let alpha = (rough * rough).max(0.01);
    let t = glance * glance * (alpha * alpha - 1.0) + 1.0;
    let lobe = alpha * alpha / (t * t) * 0.25 * sun;
    let sky = 0.35 + 0.65 * (0.5 + 0.5 * n[1]);
    color.map(|c| {
        let own = decoded(c);
        let mirror = 0.04 + (own - 0.04) * metal;
        own * (1.0 - 0.6 * metal) * (1.15 * sun + 0.33 * sky) + mirror * (1.6 * lobe + 0.3 * sky)
    })
}

/// Decodes an sRGB byte to linear light.
fn decoded(byte: u8) -> f64 {
    // A power for each sample would be slow.
    static LIGHT: LazyLock<[f64; 256]> =
        LazyLock::new(|| std::array::from_fn(|byte| libm::pow(byte as f64 / 255.0, 2.2)));
    LIGHT[usize::from(byte)]
}

/// Encodes linear light as an sRGB byte.
fn encoded(light: f64) -> u8 {
    (libm::pow(light.clamp(0.0, 1.0), 1.0 / 2.2) * 255.0).round() as u8
}
