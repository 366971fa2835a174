//! The ink in the rooms, by units of the grid: sampled finely, without what is on walls.

use crate::grid::{Grid, dark_at};
use crate::shape::Shape;
use crate::sheet::Ink;
use glam::{DVec2, dvec2};

/// Samples along a unit.
pub(super) const FINE: i32 = 32;
/// What counts as ink here, of what counts as ink of walls: things are drawn with the finest pen.
const FAINT: f64 = 0.5;
/// What is smaller in both directions and stands alone is a speck, samples.
const SPECK: i32 = 7;
/// What lies nearer to a wall is part of its symbol, units.
const WALL: f64 = 0.2;

/// Samples over a house: to the right, then downwards.
#[derive(Clone, Debug)]
pub(super) struct Canvas {
    /// The upper left crossing.
    pub(super) from: (i32, i32),
    /// Samples across and down.
    pub(super) size: (i32, i32),
    /// Where there is ink.
    pub(super) ink: Vec<bool>,
    /// Where there is ink that runs aslant.
    pub(super) slanting: Vec<bool>,
    /// What is on a wall, or outside of the house.
    pub(super) hidden: Vec<bool>,
}

impl Canvas {
    /// Samples the ink of a sheet; `straight` is that without strokes that run aslant.
    pub(super) fn of(ink: &Ink, straight: &Ink, grid: &Grid, shape: &Shape) -> Canvas {
        let mut canvas = Canvas::empty(shape);
        for y in 0..canvas.size.1 {
            for x in 0..canvas.size.0 {
                let place = |dx: f64, dy: f64| {
                    let at = canvas.place(x, y) + dvec2(dx, dy) / f64::from(FINE);
                    grid.at(at.x, at.y)
                };
                let parts = [(-0.25, -0.25), (0.25, -0.25), (-0.25, 0.25), (0.25, 0.25)];
                let places = parts.map(|(dx, dy)| place(dx, dy));
                let least = (f64::from(ink.threshold) * FAINT) as u8;
                let is = |ink: &Ink| places.iter().any(|at| dark_at(ink, *at) > least);
                let k = canvas.number(x, y);
                canvas.ink[k] = is(ink);
                canvas.slanting[k] = canvas.ink[k] && !is(straight);
            }
        }
        canvas.without_specks();
        canvas
    }

    /// Clears ink that is small in both directions and stands alone.
    fn without_specks(&mut self) {
        let (width, height) = self.size;
        let mut met = vec![false; self.ink.len()];
        for start in 0..self.ink.len() {
            if !self.ink[start] || met[start] {
                continue;
            }
            met[start] = true;
            let (mut part, mut next) = (vec![start], 0);
            let (mut low, mut high) = ((i32::MAX, i32::MAX), (0, 0));
            while let Some(&k) = part.get(next) {
                next += 1;
                let (x, y) = (k as i32 % width, k as i32 / width);
                low = (low.0.min(x), low.1.min(y));
                high = (high.0.max(x), high.1.max(y));
                let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (x + dx, y + dy)));
                for (x, y) in around {
                    if (0..width).contains(&x) && (0..height).contains(&y) {
                        let k = self.number(x, y);
                        if self.ink[k] && !met[k] {
                            met[k] = true;
                            part.push(k);
                        }
                    }
                }
            }
            if high.0 - low.0 < SPECK && high.1 - low.1 < SPECK {
                for k in part {
                    (self.ink[k], self.slanting[k]) = (false, false);
                }
            }
        }
    }

    fn empty(shape: &Shape) -> Canvas {
        let all = || shape.cells.iter();
        let low = (
            all().map(|c| c.0).min().unwrap_or(0),
            all().map(|c| c.1).min().unwrap_or(0),
        );
        let high = (
            all().map(|c| c.0 + 1).max().unwrap_or(0),
            all().map(|c| c.1 + 1).max().unwrap_or(0),
        );
        let size = ((high.0 - low.0) * FINE, (high.1 - low.1) * FINE);
        let count = (size.0 * size.1) as usize;
        let mut canvas = Canvas {
            from: low,
            size,
            ink: vec![false; count],
            slanting: vec![false; count],
            hidden: vec![true; count],
        };
        for &(u, v) in &shape.cells {
            canvas.fill(
                dvec2(f64::from(u), f64::from(v)),
                dvec2(f64::from(u + 1), f64::from(v + 1)),
                false,
            );
        }
        for wall in shape.outer.iter().chain(&shape.inner) {
            let end = |p: (i32, i32)| dvec2(f64::from(p.0), f64::from(p.1));
            let (low, high) = (
                end(wall.from).min(end(wall.to)),
                end(wall.from).max(end(wall.to)),
            );
            canvas.fill(low - WALL, high + WALL, true);
        }
        canvas
    }

    fn fill(&mut self, low: DVec2, high: DVec2, hidden: bool) {
        let sample = |at: f64, from: i32, most: i32| {
            (((at - f64::from(from)) * f64::from(FINE)).round() as i32).clamp(0, most)
        };
        let across =
            sample(low.x, self.from.0, self.size.0)..sample(high.x, self.from.0, self.size.0);
        for y in sample(low.y, self.from.1, self.size.1)..sample(high.y, self.from.1, self.size.1) {
            for x in across.clone() {
                let k = self.number(x, y);
                self.hidden[k] = hidden;
            }
        }
    }

    /// The number of a sample.
    pub(super) fn number(&self, x: i32, y: i32) -> usize {
        (y * self.size.0 + x) as usize
    }

    /// The middle of a sample, units.
    fn place(&self, x: i32, y: i32) -> DVec2 {
        let along = |k: i32, from: i32| f64::from(from) + (f64::from(k) + 0.5) / f64::from(FINE);
        dvec2(along(x, self.from.0), along(y, self.from.1))
    }

    /// The first sample of a cell.
    pub(super) fn corner(&self, cell: (i32, i32)) -> (i32, i32) {
        ((cell.0 - self.from.0) * FINE, (cell.1 - self.from.1) * FINE)
    }

    /// Where ink is within so many samples.
    pub(super) fn near(&self, reach: i32) -> Vec<bool> {
        spread(&self.ink, self.size, reach)
    }
}

/// What lies within so many samples of something, in both directions.
pub(super) fn spread(some: &[bool], (width, height): (i32, i32), reach: i32) -> Vec<bool> {
    let along = |some: &[bool], step: i32, count: i32, line: &dyn Fn(i32) -> i32, lines: i32| {
        let mut out = vec![false; some.len()];
        for l in 0..lines {
            let mut last = i32::MIN / 2;
            let at = |k: i32| (line(l) + k * step) as usize;
            for k in 0..count {
                if some[at(k)] {
                    (last.max(k - reach - 1) + 1..k)
                        .chain([k])
                        .filter(|j| *j >= 0)
                        .for_each(|j| out[at(j)] = true);
                    last = k;
                } else if k - last <= reach {
                    out[at(k)] = true;
                }
            }
        }
        out
    };
    let level = along(some, 1, width, &|l| l * width, height);
    along(&level, width, height, &|l| l, width)
}
