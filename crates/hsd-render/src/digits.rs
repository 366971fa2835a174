//! A digit font of three by five dots, for numbers in images.

use image::{Rgb, RgbImage};

/// Rows of three dots from top to bottom; the left dot is the highest bit.
const DIGITS: [[u8; 5]; 10] = [
    [0b111, 0b101, 0b101, 0b101, 0b111],
    [0b010, 0b110, 0b010, 0b010, 0b111],
    [0b111, 0b001, 0b111, 0b100, 0b111],
    [0b111, 0b001, 0b111, 0b001, 0b111],
    [0b101, 0b101, 0b111, 0b001, 0b001],
    [0b111, 0b100, 0b111, 0b001, 0b111],
    [0b111, 0b100, 0b111, 0b101, 0b111],
    [0b111, 0b001, 0b010, 0b010, 0b010],
    [0b111, 0b101, 0b111, 0b101, 0b111],
    [0b111, 0b101, 0b111, 0b001, 0b111],
];

const INK: Rgb<u8> = Rgb([0x2b, 0x27, 0x24]);

/// Draws a number with its upper left corner at (`x`, `y`) and `dot` pixels per dot.
pub(super) fn write(number: u64, picture: &mut RgbImage, (x, y): (u32, u32), dot: u32) {
    for (k, digit) in (0..).zip(number.to_string().bytes()) {
        let rows = DIGITS[usize::from(digit - b'0')];
        for (j, row) in (0..).zip(rows) {
            for i in (0..3).filter(|i| row & (0b100 >> i) != 0) {
                let corner = (x + (4 * k + i) * dot, y + j * dot);
                fill(picture, corner, dot);
            }
        }
    }
}

fn fill(picture: &mut RgbImage, (x, y): (u32, u32), size: u32) {
    for j in y..(y + size).min(picture.height()) {
        for i in x..(x + size).min(picture.width()) {
            picture.put_pixel(i, j, INK);
        }
    }
}
