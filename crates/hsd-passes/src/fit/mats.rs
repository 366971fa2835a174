//! Lays mats (畳) in a room: whole ones, twice as long as wide, and as few halves as the room asks for.
//!
//! In a festive room no four mats meet in a point. Such a layout is searched for cell by cell; a room that is large, or has
//! none, gets rows, as halls have. What is too narrow for half a mat stays boards.

use glam::{DVec2, dvec2};
use hsd_base::geometry::in_rings;
use hsd_ir::ast::MatOrder;
use hsd_ir::building::Mat;

/// The most cells of a room with mats; a hall of a thousand mats has two thousand.
pub(super) const MOST_CELLS: usize = 20_000;

/// The most cells for which a festive layout is searched.
const MOST_FESTIVE: usize = 144;

/// The most steps of a search.
const MOST_STEPS: usize = 20_000;

/// The most halves that a festive layout may have more than needed.
const MORE_HALVES: usize = 2;

/// A part of a side of a cell that counts as beside it, U.
const BESIDE: f64 = 0.05;

/// The cells of a room: half mats, one U square, from the least corner on.
struct Floor {
    low: DVec2,
    columns: usize,
    rows: usize,
    /// True for cells within the room.
    free: Vec<bool>,
}

/// Lays mats in an area; `None` if it has too many cells.
pub(super) fn lay(area: &[Vec<DVec2>], order: MatOrder) -> Option<Vec<Mat>> {
    let floor = Floor::new(area)?;
    let count = floor.free.iter().filter(|free| **free).count();
    let festive = order == MatOrder::Festive && count <= MOST_FESTIVE;
    let found = festive.then(|| floor.festive(count)).flatten();
    let layout = found.unwrap_or_else(|| floor.in_rows());
    Some(floor.mats(&layout, area))
}

impl Floor {
    fn new(area: &[Vec<DVec2>]) -> Option<Floor> {
        let points = || area.iter().flatten();
        let low = points().copied().reduce(DVec2::min)?;
        let high = points().copied().reduce(DVec2::max)?;
        let size = (high - low + 1e-6).floor();
        if size.x * size.y > MOST_CELLS as f64 {
            return None;
        }
        let (columns, rows) = (size.x as usize, size.y as usize);
        let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        let free = cells.map(|(column, row)| {
            let corner = low + dvec2(column as f64, row as f64);
            let edges = area.iter().flat_map(|ring| {
                let next = ring.iter().cycle().skip(1);
                ring.iter().zip(next)
            });
            let mut edges = edges.map(|(p, q)| (*p - corner, *q - corner));
            in_rings(area, corner + 0.5) && !edges.any(|(p, q)| cuts_cell(p, q))
        });
        Some(Floor {
            low,
            columns,
            rows,
            free: free.collect(),
        })
    }

    /// Returns the mat of each cell, counted from 1, 0 outside the room: a layout in which no four meet, with as few halves as
    /// one has.
    fn festive(&self, count: usize) -> Option<Vec<usize>> {
        let least = count % 2;
        (least..=least + MORE_HALVES).step_by(2).find_map(|halves| {
            let mut search = Search {
                floor: self,
                mats: vec![0; self.free.len()],
                steps: 0,
            };
            search.from(0, halves, 1).then_some(search.mats)
        })
    }

    /// The same in rows: mats along the longer side, the rest across, and halves where neither fits.
    fn in_rows(&self) -> Vec<usize> {
        let mut mats = vec![0; self.free.len()];
        let mut last = 0;
        let along = (1, self.columns);
        let (first, then) = match self.columns >= self.rows {
            true => (along.0, along.1),
            false => (along.1, along.0),
        };
        for step in [first, then, 0] {
            for cell in 0..self.free.len() {
                let Some(other) = self.beside(cell, step) else {
                    continue;
                };
                if self.free[cell] && mats[cell] == 0 && self.free[other] && mats[other] == 0 {
                    last += 1;
                    (mats[cell], mats[other]) = (last, last);
                }
            }
        }
        mats
    }

    /// Returns the cell after one along a (1) or b (the number of columns), or itself (0).
    fn beside(&self, cell: usize, step: usize) -> Option<usize> {
        let wraps = step == 1 && (cell + 1).is_multiple_of(self.columns);
        let other = cell + step;
        (!wraps && other < self.free.len()).then_some(other)
    }

    fn mats(&self, layout: &[usize], area: &[Vec<DVec2>]) -> Vec<Mat> {
        let count = layout.iter().max().copied().unwrap_or(0);
        let nothing = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let mut found = vec![nothing; count];
        for (cell, mat) in layout.iter().enumerate().filter(|(_, mat)| **mat > 0) {
            let (column, row) = (cell % self.columns, cell / self.columns);
            let corner = self.low + dvec2(column as f64, row as f64);
            let (low, high) = &mut found[mat - 1];
            *low = low.min(corner);
            *high = high.max(corner + 1.0);
        }
        let mat = |(low, high): (DVec2, DVec2)| {
            let beyond = |side: usize| {
                let size = high - low;
                let (axis, across) = match side < 2 {
                    true => (DVec2::X, DVec2::Y),
                    false => (DVec2::Y, DVec2::X),
                };
                let from = match side % 2 {
                    0 => low - axis * BESIDE,
                    _ => low + axis * (size.dot(axis) + BESIDE),
                };
                let cells = size.dot(across).round() as usize;
                let mut middles = (0..cells).map(|i| from + across * (i as f64 + 0.5));
                middles.any(|p| !in_rings(area, p))
            };
            Mat {
                low,
                high,
                walls: [0, 1, 2, 3].map(beyond),
            }
        };
        found.into_iter().map(mat).collect()
    }
}

/// Returns true if a line between two points goes through the inside of the unit square.
fn cuts_cell(p: DVec2, q: DVec2) -> bool {
    const EDGE: f64 = 1e-6;
    let way = q - p;
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let (low, high) = (EDGE - p[axis], 1.0 - EDGE - p[axis]);
        if way[axis].abs() < 1e-12 {
            if low > 0.0 || high < 0.0 {
                return false;
            }
            continue;
        }
        let (s, t) = (low / way[axis], high / way[axis]);
        from = from.max(s.min(t));
        to = to.min(s.max(t));
    }
    from < to
}

/// A search for a festive layout, cell by cell.
struct Search<'f> {
    floor: &'f Floor,
    mats: Vec<usize>,
    steps: usize,
}

impl Search<'_> {
    /// Lays mats from a cell on; false if there is no way, or the search takes too long.
    fn from(&mut self, cell: usize, halves: usize, number: usize) -> bool {
        let floor = self.floor;
        let open = |mats: &[usize], cell: usize| floor.free[cell] && mats[cell] == 0;
        let Some(cell) = (cell..self.mats.len()).find(|cell| open(&self.mats, *cell)) else {
            return true;
        };
        self.steps += 1;
        if self.steps > MOST_STEPS {
            return false;
        }
        for step in [1, floor.columns, 0] {
            let Some(other) = floor.beside(cell, step) else {
                continue;
            };
            if !open(&self.mats, other) || (step == 0 && halves == 0) {
                continue;
            }
            (self.mats[cell], self.mats[other]) = (number, number);
            let left = halves - usize::from(step == 0);
            if !self.meets_four(cell)
                && !self.meets_four(other)
                && self.from(cell, left, number + 1)
            {
                return true;
            }
            (self.mats[cell], self.mats[other]) = (0, 0);
        }
        false
    }

    /// Returns true if four mats meet in a corner of a cell.
    fn meets_four(&self, cell: usize) -> bool {
        let columns = self.floor.columns;
        let (column, row) = (cell % columns, cell / columns);
        let corners = [(0, 0), (1, 0), (0, 1), (1, 1)];
        corners.into_iter().any(|(right, down)| {
            let (right, down) = (column + right, row + down);
            if right == 0 || down == 0 || right >= columns || down >= self.floor.rows {
                return false;
            }
            let at = down * columns + right;
            let four = [at, at - 1, at - columns, at - columns - 1].map(|c| self.mats[c]);
            let differ = |i: usize| !four[..i].contains(&four[i]);
            four.iter().all(|mat| *mat > 0) && (1..4).all(differ)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn room(columns: f64, rows: f64) -> Vec<Vec<DVec2>> {
        let [x, y] = [columns, rows];
        vec![vec![DVec2::ZERO, dvec2(x, 0.0), dvec2(x, y), dvec2(0.0, y)]]
    }

    /// Corners of mats in which four of them meet.
    fn fours(mats: &[Mat]) -> usize {
        let corners = |m: &Mat| {
            [
                m.low,
                m.high,
                dvec2(m.low.x, m.high.y),
                dvec2(m.high.x, m.low.y),
            ]
        };
        let all: Vec<DVec2> = mats.iter().flat_map(corners).collect();
        let same = |p: &DVec2| all.iter().filter(|q| p.distance(**q) < 1e-9).count();
        all.iter().filter(|p| same(p) == 4).count() / 4
    }

    fn area(mats: &[Mat]) -> f64 {
        let each = mats.iter().map(|m| (m.high - m.low).element_product());
        each.sum()
    }

    /// Areas in which two mats lie.
    fn overlap(mats: &[Mat]) -> f64 {
        let pairs = mats
            .iter()
            .enumerate()
            .flat_map(|(i, m)| mats[..i].iter().map(move |n| (m, n)));
        let shared = pairs.map(|(m, n)| {
            let size = m.high.min(n.high) - m.low.max(n.low);
            size.max(DVec2::ZERO).element_product()
        });
        shared.sum()
    }

    #[test]
    fn rooms_of_the_usual_sizes_are_festive_and_full() {
        // Sizes in half mats, with the number of mats that the room is called by.
        for (columns, rows, called) in [
            (2.0, 2.0, 2.0),
            (2.0, 3.0, 3.0),
            (3.0, 3.0, 4.5),
            (3.0, 4.0, 6.0),
            (4.0, 4.0, 8.0),
            (4.0, 5.0, 10.0),
            (5.0, 6.0, 15.0),
            (4.0, 6.0, 12.0),
            (5.0, 7.0, 17.5),
        ] {
            for (columns, rows) in [(columns, rows), (rows, columns)] {
                let mats = lay(&room(columns, rows), MatOrder::Festive).expect("is small");
                let halves = mats.iter().filter(|m| m.is_half()).count() as f64;
                assert_eq!(mats.len() as f64 - halves / 2.0, called);
                assert!(halves < 2.0, "{columns} x {rows}: {halves} halves");
                assert_eq!(area(&mats), columns * rows);
                assert_eq!(overlap(&mats), 0.0);
                assert_eq!(fours(&mats), 0, "{columns} x {rows}");
            }
        }
    }

    #[test]
    fn mats_of_any_room_cover_what_whole_cells_do_and_never_twice() {
        for (columns, rows) in (1..15).flat_map(|c| (1..15).map(move |r| (c, r))) {
            for order in [MatOrder::Festive, MatOrder::Rows] {
                let (x, y) = (f64::from(columns) + 0.25, f64::from(rows) + 0.75);
                let mats = lay(&room(x, y), order).expect("is small");
                assert_eq!(area(&mats), f64::from(columns * rows));
                assert_eq!(overlap(&mats), 0.0);
                let odd = mats.iter().filter(|m| m.is_half()).count() % 2;
                assert_eq!(odd as i32, columns * rows % 2);
            }
        }
    }

    #[test]
    fn mats_keep_off_what_slants_or_stands_free() {
        let slanting = vec![vec![
            DVec2::ZERO,
            dvec2(4.0, 0.0),
            dvec2(4.0, 4.0),
            dvec2(0.0, 2.0),
        ]];
        let mats = lay(&slanting, MatOrder::Rows).expect("is small");
        assert_eq!(area(&mats), 10.0);
        let post = vec![
            dvec2(1.25, 1.25),
            dvec2(1.25, 1.75),
            dvec2(1.75, 1.75),
            dvec2(1.75, 1.25),
        ];
        let mats = lay(&[room(3.0, 3.0).remove(0), post], MatOrder::Festive).expect("is small");
        assert_eq!(area(&mats), 8.0);
    }
}
