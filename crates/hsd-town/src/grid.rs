//! A spatial index: boxes in square cells. What it finds comes in the order in which it was added, so that nothing depends on
//! the index.

use glam::DVec2;

/// The side of a cell, metres: about the size of a house.
const CELL: f64 = 16.0;
/// The number of cells above which a box is looked at in every query.
const MOST: i64 = 4096;

/// A box: its low and high corner.
pub type Bounds = [DVec2; 2];

/// An index of boxes by their numbers.
#[derive(Debug, Default)]
pub struct Grid {
    bounds: Vec<Bounds>,
    /// Cells with the boxes in them, sorted.
    cells: Vec<((i64, i64), u32)>,
    /// Boxes of more cells.
    large: Vec<u32>,
}

fn cell(p: DVec2) -> (i64, i64) {
    ((p.x / CELL).floor() as i64, (p.y / CELL).floor() as i64)
}

impl Grid {
    /// Creates the index of boxes, which are numbered in their order.
    pub fn new(bounds: Vec<Bounds>) -> Grid {
        let (mut cells, mut large) = (vec![], vec![]);
        for (number, [low, high]) in bounds.iter().enumerate() {
            let ((x0, y0), (x1, y1)) = (cell(*low), cell(*high));
            let number = number as u32;
            if (x1 - x0 + 1).saturating_mul(y1 - y0 + 1) > MOST {
                large.push(number);
                continue;
            }
            for x in x0..=x1 {
                cells.extend((y0..=y1).map(|y| ((x, y), number)));
            }
        }
        cells.sort_unstable();
        Grid {
            bounds,
            cells,
            large,
        }
    }

    /// Returns the numbers of the boxes that meet a box, ascending.
    pub fn near(&self, [low, high]: Bounds) -> Vec<u32> {
        let ((x0, y0), (x1, y1)) = (cell(low), cell(high));
        let mut found = self.large.clone();
        for x in x0..=x1 {
            let from = self.cells.partition_point(|(at, _)| *at < (x, y0));
            let there = self.cells[from..].iter();
            found.extend(there.take_while(|(at, _)| *at <= (x, y1)).map(|(_, n)| *n));
        }
        found.sort_unstable();
        found.dedup();
        found.retain(|n| {
            let [from, to] = self.bounds[*n as usize];
            from.cmple(high).all() && low.cmple(to).all()
        });
        found
    }
}

/// Returns the box of points; `None` for none.
pub fn bounds(points: impl IntoIterator<Item = DVec2>) -> Option<Bounds> {
    let mut points = points.into_iter();
    let first = points.next()?;
    Some(points.fold([first; 2], |[low, high], p| [low.min(p), high.max(p)]))
}

/// Returns a box that reaches farther on all sides.
pub fn wider([low, high]: Bounds, by: f64) -> Bounds {
    [low - DVec2::splat(by), high + DVec2::splat(by)]
}

/// Returns true if two boxes have a place in common.
pub fn meet([a, b]: Bounds, [c, d]: Bounds) -> bool {
    a.cmple(d).all() && c.cmple(b).all()
}
