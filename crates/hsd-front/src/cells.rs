//! The cells of a lattice on a straight wall, small and in linear light, and how alike two of them are.

use super::grid::Grid;
use super::tone::linear;
use image::RgbImage;

/// Samples of a cell along each side.
pub const SIDE: usize = 28;
/// How much a sample may differ from those round it in the other cell, as a part of their brightness.
const OFF: f32 = 0.14;
/// The brightness below which differences are noise.
const DARK: f32 = 0.035;
/// How much the sizes of equal cells may differ.
const SIZE: f64 = 0.14;
/// The part of a cell behind a mask at which it is not seen whole.
const BEHIND: f64 = 0.01;

/// A cell of the lattice.
#[derive(Clone, Debug)]
pub struct Cell {
    /// Its storey, from above.
    pub row: usize,
    /// Its bay, from the left.
    pub column: usize,
    /// Left, top, right, bottom, pixels of the wall.
    pub frame: [u32; 4],
    /// Its colours, linear light, row by row.
    pub tones: Vec<[f32; 3]>,
    /// Which of them are seen: not behind a mask, not beyond the photograph.
    pub seen: Vec<bool>,
}

impl Cell {
    /// Whether it is seen whole.
    pub fn is_whole(&self) -> bool {
        let hidden = self.seen.iter().filter(|s| !**s).count();
        (hidden as f64) < BEHIND * self.seen.len() as f64
    }

    /// Its width and height, pixels.
    pub fn size(&self) -> (u32, u32) {
        let [left, top, right, bottom] = self.frame;
        (right - left, bottom - top)
    }
}

/// The cells of a wall, row by row from above; `seen` says which pixels of the wall are seen.
pub fn cells(wall: &RgbImage, seen: &[bool], grid: &Grid) -> Vec<Cell> {
    let pixel = |t: f64, n: u32| ((t * f64::from(n)).round() as u32).min(n);
    let mut found = vec![];
    for (row, v) in grid.rows.windows(2).enumerate() {
        for (column, u) in grid.columns.windows(2).enumerate() {
            let (width, height) = wall.dimensions();
            let frame = [
                pixel(u[0], width),
                pixel(v[0], height),
                pixel(u[1], width),
                pixel(v[1], height),
            ];
            if frame[2] > frame[0] && frame[3] > frame[1] {
                found.push(cell(wall, seen, row, column, frame));
            }
        }
    }
    found
}

fn cell(wall: &RgbImage, seen: &[bool], row: usize, column: usize, frame: [u32; 4]) -> Cell {
    let [left, top, right, bottom] = frame;
    let (mut tones, mut is_seen) = (vec![], vec![]);
    let part = |from: u32, to: u32, k: usize| from + (to - from) * k as u32 / SIDE as u32;
    for j in 0..SIDE {
        let (y0, y1) = (part(top, bottom, j), part(top, bottom, j + 1));
        for i in 0..SIDE {
            let (x0, x1) = (part(left, right, i), part(left, right, i + 1));
            let (mut sum, mut count, mut hidden) = ([0.0_f32; 3], 0.0_f32, false);
            for y in y0..y1.max(y0 + 1) {
                for x in x0..x1.max(x0 + 1) {
                    let tone = linear(wall.get_pixel(x, y).0);
                    sum.iter_mut().zip(tone).for_each(|(s, t)| *s += t);
                    count += 1.0;
                    hidden |= !seen[(y * wall.width() + x) as usize];
                }
            }
            tones.push(sum.map(|s| s / count));
            is_seen.push(!hidden);
        }
    }
    Cell {
        row,
        column,
        frame,
        tones,
        seen: is_seen,
    }
}

/// How alike two cells are.
#[derive(Clone, Debug)]
pub struct Likeness {
    /// The part of what is seen in both that agrees, 0 to 1.
    pub share: f64,
    /// How much brighter the second is.
    pub gain: f32,
    /// Where they disagree.
    pub off: Vec<bool>,
}

/// Whether cells are of one size.
pub fn are_equal(a: &Cell, b: &Cell) -> bool {
    let near = |m: u32, n: u32| (f64::from(m) / f64::from(n) - 1.0).abs() <= SIZE;
    near(a.size().0, b.size().0) && near(a.size().1, b.size().1)
}

/// Compares cells, whatever light lies on each; `None` if they are of different sizes or too little of them is seen.
pub fn compare(a: &Cell, b: &Cell) -> Option<Likeness> {
    if !are_equal(a, b) {
        return None;
    }
    let both = |k: usize| a.seen[k] && b.seen[k];
    let mut ratios: Vec<f32> = (0..SIDE * SIDE)
        .filter(|k| both(*k))
        .map(|k| bright(b.tones[k], DARK) / bright(a.tones[k], DARK))
        .collect();
    if ratios.len() < SIDE * SIDE / 8 {
        return None;
    }
    let half = ratios.len() / 2;
    let gain = *ratios.select_nth_unstable_by(half, f32::total_cmp).1;
    let off: Vec<bool> = (0..SIDE * SIDE)
        .map(|k| both(k) && !(agrees(a, b, gain, k) && agrees(b, a, 1.0 / gain, k)))
        .collect();
    let seen = (0..SIDE * SIDE).filter(|k| both(*k)).count();
    let share = 1.0 - off.iter().filter(|o| **o).count() as f64 / seen as f64;
    Some(Likeness { share, gain, off })
}

fn bright(tone: [f32; 3], plus: f32) -> f32 {
    0.2126 * tone[0] + 0.7152 * tone[1] + 0.0722 * tone[2] + plus
}

/// Whether a sample lies between those round it in the other cell, nearly: edges may be off by a sample.
fn agrees(a: &Cell, b: &Cell, gain: f32, k: usize) -> bool {
    let (x, y) = (k % SIDE, k / SIDE);
    let (mut low, mut high) = ([f32::INFINITY; 3], [0.0_f32; 3]);
    for ny in y.saturating_sub(1)..=(y + 1).min(SIDE - 1) {
        for nx in x.saturating_sub(1)..=(x + 1).min(SIDE - 1) {
            let tone = b.tones[ny * SIDE + nx];
            for c in 0..3 {
                low[c] = low[c].min(tone[c]);
                high[c] = high[c].max(tone[c]);
            }
        }
    }
    let own = a.tones[k].map(|t| t * gain);
    let room = OFF * (bright(own, DARK) + bright(high, 0.0)) / 2.0 + 0.2 * DARK;
    (0..3).all(|c| own[c] > low[c] - room && own[c] < high[c] + room)
}
