//! What a plan is drawn on: boards are brown and have a grain, paper is pale or the same in all directions.

use image::{GrayImage, Rgb, RgbImage, imageops};

/// Pixels along the longer side of the small copy on which the grain is seen: strokes are too thin for it, boards have a stripe or
/// two in a pixel.
const ALONG: u32 = 100;
/// The share of the sheet at each edge that is left out: tables, margins.
const MARGIN: u32 = 6;
/// The share of its brightest colour that the darkest lacks on old paper at least, and how much more on wood.
const PALE: f64 = 0.22;
const BROWN: f64 = 0.1;
/// How many levels more a pixel differs across the grain than along it: more than on paper, and how many more on boards.
const EVEN: f64 = 0.8;
const GRAIN: f64 = 1.2;

/// How surely a flat sheet is of wood, 0 to 1.
pub fn wood(sheet: &RgbImage) -> f64 {
    let (width, height) = sheet.dimensions();
    let (x, y) = (width / MARGIN, height / MARGIN);
    let middle = imageops::crop_imm(sheet, x, y, width - 2 * x, height - 2 * y);
    let scale = f64::from(ALONG) / f64::from(width.max(height));
    let pixels = |length: u32| ((f64::from(length) * scale) as u32).max(2);
    let small = imageops::thumbnail(&*middle, pixels(width), pixels(height));
    let brown = ((lack(&small) - PALE) / BROWN).clamp(0.0, 1.0);
    let grain = ((stripes(&small) - EVEN) / GRAIN).clamp(0.0, 1.0);
    brown * grain
}

/// How much of its brightest colour the ground lacks in its darkest, a share.
fn lack(sheet: &RgbImage) -> f64 {
    let lack = |Rgb(c): &Rgb<u8>| {
        let most = f64::from(*c.iter().max().unwrap_or(&0)).max(1.0);
        (most - f64::from(*c.iter().min().unwrap_or(&0))) / most
    };
    middle(sheet.pixels().map(lack).collect())
}

/// How much more neighbours differ in one direction than in the other, levels.
fn stripes(sheet: &RgbImage) -> f64 {
    let grey: GrayImage = imageops::grayscale(sheet);
    let (width, height) = grey.dimensions();
    let differences = |x1: u32, y1: u32| {
        let at = |x: u32, y: u32| f64::from(grey.get_pixel(x, y)[0]);
        let places = (0..height - y1).flat_map(|y| (0..width - x1).map(move |x| (x, y)));
        let all = places.map(|(x, y)| (at(x + x1, y + y1) - at(x, y)).abs());
        middle(all.collect())
    };
    (differences(1, 0) - differences(0, 1)).abs()
}

/// The value in the middle of all.
fn middle(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sheet of a colour whose lightness changes with what `of` says, -1 to 1.
    fn sheet(colour: [f64; 3], of: impl Fn(f64, f64) -> f64) -> RgbImage {
        RgbImage::from_fn(600, 400, |x, y| {
            let by = 12.0 * of(f64::from(x), f64::from(y));
            Rgb(colour.map(|c| (c + by).clamp(0.0, 255.0) as u8))
        })
    }

    #[test]
    fn boards_are_brown_with_a_grain_in_one_direction() {
        const BROWN: [f64; 3] = [190.0, 150.0, 105.0];
        let grain = |x: f64, y: f64| libm::sin(y / 9.0 + libm::sin(x / 80.0));
        assert!(wood(&sheet(BROWN, grain)) > 0.9);
        assert!(wood(&sheet(BROWN, |x, y| grain(y, x))) > 0.9);
        // Yellowed paper, clouded alike both ways, and a grey picture of boards: nobody can say.
        let clouds = |x: f64, y: f64| libm::sin(y / 9.0) * libm::sin(x / 9.0);
        assert!(wood(&sheet(BROWN, clouds)) < 0.1);
        assert!(wood(&sheet([170.0; 3], grain)) < 0.1);
        assert!(wood(&sheet([250.0, 245.0, 225.0], grain)) < 0.1);
    }

    #[test]
    fn the_smallest_sheets_have_a_ground() {
        for (width, height) in [(1, 1), (1, 300), (2, 3), (300, 1)] {
            assert!(wood(&RgbImage::new(width, height)) < 0.1);
        }
    }
}
