//! The picture of a sheet that `hsd view` lays under the plan of the house, and where it lies there (`plan_file`).

use super::Found;
use super::flatten::warp;
use glam::{DMat3, DVec2, dvec2};
use image::RgbImage;

/// The most pixels of a unit in the picture of a sheet.
const FINEST: f64 = 64.0;
/// Units round the plan that the picture of a sheet shows.
const MARGIN: i32 = 2;

/// The part of a sheet that shows the plan, so that units are squares; and what takes its pixels to metres, if the house begins
/// at `origin` (to the right and down, units of this sheet) and a unit has `metres`.
pub fn draw(found: &Found, origin: (i32, i32), metres: f64) -> (RgbImage, [f64; 6]) {
    let grid = &found.grid;
    let pixels = grid.unit.round().clamp(8.0, FINEST);
    let corner = (grid.across.0 - MARGIN, grid.down.0 - MARGIN);
    let size = |(first, last): (i32, i32)| (f64::from(last - first + 2 * MARGIN) * pixels) as u32;
    let to_units =
        DMat3::from_translation(at(corner)) * DMat3::from_scale(DVec2::splat(1.0 / pixels));
    let picture = warp(
        &found.flat.sheet,
        grid.to_sheet * to_units,
        (size(grid.across), size(grid.down)),
    );
    let scale = metres / pixels;
    let zero = at(origin) - at(corner);
    (
        picture,
        [-scale, 0.0, 0.0, -scale, zero.x * metres, zero.y * metres],
    )
}

fn at(p: (i32, i32)) -> DVec2 {
    dvec2(f64::from(p.0), f64::from(p.1))
}
