//! The part of a grid that is kept.

use super::{Wish, height};
use crate::Crs;
use crate::fault::{Fault, Kind};
use glam::DVec2;
use std::ops::Range;

/// Cells of a grid that may be kept: 256 MiB.
const MOST: u64 = 64 << 20;
/// Rows or columns of a grid.
const LONGEST: u64 = 4 << 20;

/// Where the cells of a grid lie.
#[derive(Clone, Copy, Debug)]
pub(super) struct Raster {
    /// The middle of the first cell.
    pub(super) first: DVec2,
    /// From a cell to the next one of its row, and from a row to the next one.
    pub(super) step: DVec2,
    pub(super) columns: u64,
    pub(super) rows: u64,
}

/// The cells that are kept, to be filled.
pub(super) struct Cut {
    raster: Raster,
    kept: [Range<u64>; 2],
    /// Row after row, as far as heights have been set: a head may promise more cells than the file has.
    pub(super) values: Vec<f32>,
}

impl Raster {
    /// Prepares to keep the cells in the window.
    ///
    /// # Errors
    /// If the grid is nonsense, or too many are kept.
    pub(super) fn cut(self, crs: Option<&Crs>, wish: &Wish<'_>) -> Result<Cut, Fault> {
        let sound = |v: DVec2| v.is_finite() && v.x != 0.0 && v.y != 0.0;
        if !self.first.is_finite() || !sound(self.step) || self.columns == 0 || self.rows == 0 {
            let what = "the place or the size of its cells is missing or makes no sense";
            return Err(wish.fault(Kind::Damaged { what }));
        }
        let too_large = |what, limit| Err(wish.fault(Kind::TooLarge { what, limit }));
        if self.columns > LONGEST || self.rows > LONGEST {
            return too_large("the side of a grid of heights, cells", LONGEST);
        }
        let kept = match crs.map(wish.window) {
            // Without a system nobody can say what is asked for; the town refuses it.
            None => [0..0, 0..0],
            Some(None) => [0..self.columns, 0..self.rows],
            Some(Some(window)) => {
                let [a, b] = window.map(|corner| (corner - self.first) / self.step);
                let (low, high) = (a.min(b), a.max(b));
                // Two cells more: heights between the middles of cells, and slopes at the edge.
                let range = |low: f64, high: f64, count: u64| {
                    let from = (low.floor() - 2.0).clamp(0.0, count as f64) as u64;
                    let to = (high.ceil() + 3.0).clamp(0.0, count as f64) as u64;
                    from..to.max(from)
                };
                [
                    range(low.x, high.x, self.columns),
                    range(low.y, high.y, self.rows),
                ]
            }
        };
        let count = |range: &Range<u64>| range.end - range.start;
        let cells = count(&kept[0]) * count(&kept[1]);
        if cells > MOST {
            return too_large("the cells of a grid of heights over the town", MOST);
        }
        Ok(Cut {
            raster: self,
            kept,
            values: vec![],
        })
    }
}

impl Cut {
    pub(super) fn columns(&self) -> usize {
        (self.kept[0].end - self.kept[0].start) as usize
    }

    /// Returns the number of rows that are kept.
    pub(super) fn height(&self) -> usize {
        (self.kept[1].end - self.kept[1].start) as usize
    }

    pub(super) fn step(&self) -> DVec2 {
        self.raster.step
    }

    /// Returns the middle of the first cell that is kept.
    pub(super) fn first(&self) -> DVec2 {
        let start = DVec2::new(self.kept[0].start as f64, self.kept[1].start as f64);
        self.raster.first + start * self.raster.step
    }

    /// Returns the rows that are kept.
    pub(super) fn rows(&self) -> &Range<u64> {
        &self.kept[1]
    }

    /// Returns true if some of these cells are kept.
    pub(super) fn meets(&self, columns: &Range<u64>, rows: &Range<u64>) -> bool {
        let meet = |a: &Range<u64>, b: &Range<u64>| a.start < b.end && b.start < a.end;
        meet(&self.kept[0], columns) && meet(&self.kept[1], rows)
    }

    /// Sets the height of a cell, if it is kept.
    pub(super) fn set(&mut self, column: u64, row: u64, value: f64) {
        if self.kept[0].contains(&column) && self.kept[1].contains(&row) {
            let (x, y) = (column - self.kept[0].start, row - self.kept[1].start);
            let at = y as usize * self.columns() + x as usize;
            if at >= self.values.len() {
                self.values.resize(at + 1, f32::NAN);
            }
            self.values[at] = height(value);
        }
    }
}
