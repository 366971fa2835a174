//! Renders formulas to maps: sampling, shading of hollows, and normals from heights.

use image::{Rgb as Pixel, RgbImage};

use super::Maps;
use super::color::Rgb;

/// The position of a sample.
#[derive(Clone, Copy)]
pub(super) struct Spot {
    /// Fraction of the repeat, to the right.
    pub(super) u: f64,
    /// Fraction of the repeat, upwards.
    pub(super) v: f64,
    /// Width and height of the repeat, metres.
    pub(super) metres: f64,
    /// Width of a pixel, metres.
    pub(super) pixel: f64,
}

/// The result of a sample: one relief, and a base colour for each of `N` looks.
#[derive(Clone, Copy)]
pub(super) struct Texel<const N: usize> {
    /// Height above the mean surface, metres.
    pub(super) height: f64,
    /// Base colours.
    pub(super) colors: [Rgb; N],
    /// Roughness, from 0 polished to 1 dull.
    pub(super) rough: f64,
    /// Metalness, 0 or 1.
    pub(super) metal: f64,
}

/// Darkening of hollows, which receive light from fewer directions.
#[derive(Clone, Copy)]
pub(super) struct Hollows {
    /// Half width of the neighbourhood to which a height is compared, metres.
    pub(super) reach: f64,
    /// Share of light lost per metre below the neighbourhood.
    pub(super) loss: f64,
}

impl Hollows {
    /// `reach` in metres, `loss` per metre.
    pub(super) const fn new(reach: f64, loss: f64) -> Self {
        Hollows { reach, loss }
    }
}

/// Renders a surface from its formula.
pub(super) fn paint<const N: usize>(
    size: u32,
    metres: f64,
    hollows: Hollows,
    formula: impl Fn(Spot) -> Texel<N>,
) -> Maps {
    let pixel = metres / f64::from(size);
    let side = size as usize;
    let texels: Vec<Texel<N>> = (0..side * side)
        .map(|k| {
            let u = ((k % side) as f64 + 0.5) / side as f64;
            let v = 1.0 - ((k / side) as f64 + 0.5) / side as f64;
            formula(Spot {
                u,
                v,
                metres,
                pixel,
            })
        })
        .collect();
    let heights: Vec<f64> = texels.iter().map(|texel| texel.height).collect();
    let reach = ((hollows.reach / pixel) as usize).clamp(1, side / 2 - 1);
    let around = surroundings(&heights, side, reach);
    let light = |k: usize| (1.0 + hollows.loss * (heights[k] - around[k])).clamp(0.35, 1.18);
    let at = |x: u32, y: u32| y as usize * side + x as usize;
    let colored = |look: usize| {
        RgbImage::from_fn(size, size, |x, y| {
            let k = at(x, y);
            Pixel(texels[k].colors[look].map(|channel| byte(channel * light(k))))
        })
    };
    Maps {
        colors: (0..N).map(colored).collect(),
        normal: normals(&heights, size, pixel),
        orm: RgbImage::from_fn(size, size, |x, y| {
            let texel = texels[at(x, y)];
            Pixel([255, byte(texel.rough), byte(texel.metal)])
        }),
    }
}

/// Shifts an image's mean to a colour, channel by channel, so that a look has its documented colour.
pub(super) fn tone(picture: &mut RgbImage, mean: Rgb) {
    let count = f64::from(picture.width()) * f64::from(picture.height());
    let mut sums = [0_u64; 3];
    for pixel in picture.pixels() {
        for (sum, channel) in sums.iter_mut().zip(pixel.0) {
            *sum += u64::from(channel);
        }
    }
    let now = sums.map(|sum| (sum as f64 / count / 255.0).max(1.0 / 255.0));
    let table = [0, 1, 2].map(|c| {
        let factor = mean[c] / now[c];
        core::array::from_fn::<u8, 256, _>(|value| byte(value as f64 / 255.0 * factor))
    });
    for pixel in picture.pixels_mut() {
        for (channel, table) in pixel.0.iter_mut().zip(&table) {
            *channel = table[usize::from(*channel)];
        }
    }
}

/// Returns the mean height of the square around each point, `reach` pixels in each direction.
fn surroundings(heights: &[f64], side: usize, reach: usize) -> Vec<f64> {
    let upright = blur(&transpose(heights, side), side, reach);
    blur(&transpose(&upright, side), side, reach)
}

/// Converts a fraction to a byte, rounded.
fn byte(fraction: f64) -> u8 {
    (fraction.clamp(0.0, 1.0) * 255.0).round() as u8
}

/// Transposes a square field.
fn transpose(field: &[f64], side: usize) -> Vec<f64> {
    (0..side * side)
        .map(|k| field[(k % side) * side + k / side])
        .collect()
}

/// Returns the mean of each value and `reach` neighbours on both sides along its row, wrapping around.
fn blur(field: &[f64], side: usize, reach: usize) -> Vec<f64> {
    let mut out = Vec::with_capacity(field.len());
    for row in field.chunks(side) {
        let mut sum: f64 = (0..=2 * reach)
            .map(|k| row[(k + side - reach) % side])
            .sum();
        for x in 0..side {
            out.push(sum / (2 * reach + 1) as f64);
            sum += row[(x + reach + 1) % side] - row[(x + side - reach) % side];
        }
    }
    out
}

/// Computes normals by central differences, wrapping around, OpenGL convention.
fn normals(heights: &[f64], size: u32, pixel: f64) -> RgbImage {
    let side = size as usize;
    RgbImage::from_fn(size, size, |x, y| {
        let (x, y) = (x as usize, y as usize);
        let at = |x: usize, y: usize| heights[(y % side) * side + x % side];
        let dx = (at(x + 1, y) - at(x + side - 1, y)) / (2.0 * pixel);
        let dy = (at(x, y + side - 1) - at(x, y + 1)) / (2.0 * pixel);
        let length = (dx * dx + dy * dy + 1.0).sqrt();
        Pixel([-dx / length, -dy / length, 1.0 / length].map(|n| byte(n * 0.5 + 0.5)))
    })
}
