//! Blank parts of a sheet, where nothing needs to be sampled: a drawing is mostly paper, and sampling takes most of the time.

use super::super::grid::Grid;
use glam::{DVec2, dvec2};
use image::GrayImage;

/// The side of a block, pixels.
const SIDE: usize = 8;

/// The darkest pixel of each block of a sheet.
pub(super) struct DarkBlocks {
    wide: usize,
    high: usize,
    darkest: Vec<u8>,
}

impl DarkBlocks {
    /// Finds the darkest pixel of each block.
    pub(super) fn of(dark: &GrayImage) -> DarkBlocks {
        let blocks = |pixels: u32| (pixels as usize).div_ceil(SIDE);
        let (wide, high) = (blocks(dark.width()), blocks(dark.height()));
        let mut darkest = vec![0; wide * high];
        let rows = dark.as_raw().chunks_exact(dark.width().max(1) as usize);
        for (y, row) in rows.enumerate() {
            let line = &mut darkest[y / SIDE * wide..][..wide];
            for (most, pixels) in line.iter_mut().zip(row.chunks(SIDE)) {
                *most = pixels.iter().copied().fold(*most, u8::max);
            }
        }
        DarkBlocks {
            wide,
            high,
            darkest,
        }
    }

    /// Returns true if no pixel of a box is darker than a level. Two corners give the box, units of the grid.
    pub(super) fn is_blank(&self, grid: &Grid, [low, high]: [DVec2; 2], level: u8) -> bool {
        let corners = [low, dvec2(high.x, low.y), high, dvec2(low.x, high.y)];
        let corners = corners.map(|corner| grid.at(corner.x, corner.y));
        if corners.iter().any(|corner| !corner.is_finite()) {
            return false;
        }
        let [first, ..] = corners;
        let (from, to) = corners
            .iter()
            .fold((first, first), |(a, b), c| (a.min(*c), b.max(*c)));
        // A pixel more on each side, for rounding.
        let block = |pixel: f64, last: usize| (pixel.max(0.0) as usize / SIDE).min(last);
        let range = |from: f64, to: f64, count: usize| {
            let last = count.saturating_sub(1);
            block(from - 1.0, last)..(block(to + 1.0, last) + 1).min(count)
        };
        let columns = range(from.x, to.x, self.wide);
        range(from.y, to.y, self.high).all(|row| {
            let row = &self.darkest[row * self.wide..][columns.clone()];
            row.iter().all(|darkest| *darkest <= level)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat3;
    use image::Luma;

    #[test]
    fn a_box_is_blank_unless_a_dark_pixel_is_in_it() {
        let mut dark = GrayImage::new(101, 53);
        dark.put_pixel(60, 40, Luma([90]));
        let grid = Grid {
            to_sheet: DMat3::from_diagonal(dvec2(10.0, 10.0).extend(1.0)),
            across: (0, 10),
            down: (0, 5),
            fit: 1.0,
            unit: 10.0,
            residual: 0.0,
        };
        let blocks = DarkBlocks::of(&dark);
        let blank = |x: f64, y: f64, level| {
            blocks.is_blank(&grid, [dvec2(x, y), dvec2(x + 1.0, y + 1.0)], level)
        };
        assert!(blank(0.0, 0.0, 0) && blank(20.0, 20.0, 0));
        assert!(!blank(5.5, 3.5, 89) && blank(5.5, 3.5, 90));
    }
}
