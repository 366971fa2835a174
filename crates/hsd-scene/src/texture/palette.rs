//! All colours in one picture, for what is seen from afar and has no texture of its own: faces of any colour share one material.
//!
//! The cube of sRGB in steps of 1/63 is cut into 64 squares of equal blue, laid in eight rows of eight: red grows to the right in
//! each, green upwards. A face has one place for all its corners, so that a viewer never mixes neighbours.

use super::samples::{encoded, linear};
use image::{Rgb, RgbImage};
use std::sync::LazyLock;

/// The name by which materials know the picture.
pub const COLOURS: &str = "colours";

/// The name of its file.
pub const FILE: &str = "colours.png";

/// The roughness and the metalness of what it colours.
pub const GLOSS: [f32; 2] = [0.8, 0.0];

/// Steps of a channel.
const STEPS: u32 = 64;

/// Squares in a row.
const SQUARES: u32 = 8;

/// Width and height, pixels.
const SIDE: u32 = STEPS * SQUARES;

/// Returns the place of a colour, linear RGB: to the right and up, shares of the picture.
pub fn place(colour: [f32; 3]) -> [f32; 2] {
    let [r, g, b] = colour.map(|light| step(encoded(light.clamp(0.0, 1.0))));
    let x = r + STEPS * (b % SQUARES);
    let y = g + STEPS * (b / SQUARES);
    [x, y].map(|n| (n as f32 + 0.5) / SIDE as f32)
}

/// Returns the colour at a place, linear RGB.
pub fn colour([u, v]: [f32; 2]) -> [f32; 3] {
    let [x, y] = [u, v].map(|share| ((share * SIDE as f32) as u32).min(SIDE - 1));
    at(x, y).map(linear)
}

/// Returns the picture as a PNG.
pub fn picture() -> &'static [u8] {
    static BYTES: LazyLock<Vec<u8>> = LazyLock::new(|| {
        let drawn = RgbImage::from_fn(SIDE, SIDE, |x, y| Rgb(at(x, SIDE - 1 - y)));
        super::png(&drawn, super::Packing::Tight)
    });
    &BYTES
}

/// Returns the step that is nearest to a channel.
fn step(channel: u8) -> u32 {
    (u32::from(channel) * (STEPS - 1) + 127) / 255
}

/// Returns the colour of a pixel, counted from the lower left corner.
fn at(x: u32, y: u32) -> [u8; 3] {
    let blue = x / STEPS + SQUARES * (y / STEPS);
    [x % STEPS, y % STEPS, blue].map(|n| ((n * 255 + (STEPS - 1) / 2) / (STEPS - 1)) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_found_again() {
        for number in [0x00_0000, 0xFF_FFFF, 0xF2_EFE6, 0x12_3456, 0x8A_6A4A] {
            let wanted = super::super::linear(number);
            let shown = colour(place(wanted));
            let [p, q] = [wanted, shown].map(|c| c.map(|light| i32::from(encoded(light))));
            let near = (0..3).all(|k| (p[k] - q[k]).abs() <= 2);
            assert!(near, "{p:?}, not {q:?}");
        }
    }

    #[test]
    fn the_picture_is_small_and_holds_the_colours_where_they_are_sought() {
        assert!(picture().len() < 4096, "{} bytes", picture().len());
        let drawn = image::load_from_memory(picture())
            .expect("a picture")
            .into_rgb8();
        let [u, v] = place(super::super::linear(0x8A_6A4A));
        let [x, y] = [u, 1.0 - v].map(|share| (share * SIDE as f32) as u32);
        assert_eq!(drawn.get_pixel(x, y).0.map(linear), colour([u, v]));
    }
}
