//! Whole fronts of houses: in one piece, and as a ground and an upper one that are combined freely (000-55, 000-56).

use super::Front;
use image::{RgbImage, imageops};

/// The pictures of a front, cleared and evenly lit: the whole one, and its ground and upper storeys if there are several; with
/// what is added to their names.
pub fn fronts(front: &Front) -> Vec<(&'static str, RgbImage)> {
    let whole = front.rebuilt();
    let (width, height) = whole.dimensions();
    let rows = &front.grid.rows;
    let ground = (rows[rows.len() - 2] * f64::from(height)).round() as u32;
    let mut pieces = vec![];
    if ground > 0 && ground < height {
        let part = |top: u32, bottom: u32| {
            imageops::crop_imm(&whole, 0, top, width, bottom - top).to_image()
        };
        pieces.push(("-ground", part(ground, height)));
        pieces.push(("-upper", part(0, ground)));
    }
    pieces.push(("", whole));
    pieces
}
