//! The thickness of the strokes of a sheet, and the walls among them.

use super::field::Field;
use crate::plan::sheet::Ink;
use glam::DVec2;

/// The classes of thickness in a doubling.
const CLASSES: f64 = 8.0;
/// Less than any stroke, pixels.
const THINNEST: f64 = 0.01;
/// The greatest distance of ink from the middle of its wall, in thicknesses of walls.
const REACH: f64 = 1.5;
/// The longest space between dashes, in thicknesses of walls.
const JOINT: f64 = 1.5;
/// The shortest dash, in thicknesses of walls: strokes of letters are as long as wide.
const DASH: f64 = 1.2;
/// The least ratio between the mean thickness of walls and that of other strokes where walls differ by their thickness.
const APART: f64 = 1.7;

/// The ink of a sheet by the thickness of its strokes.
#[derive(Clone, Debug)]
pub struct Strokes {
    /// Thickness of the stroke at each pixel, pixels of full ink; 0 is paper.
    pub thickness: Field<f32>,
    /// Strokes at least as thick are walls.
    pub wall: f64,
    /// The ratio of the thickness of walls to that of other strokes.
    pub apart: f64,
    /// Thickness of walls in the middle of all, pixels.
    pub usual: f64,
}

impl Strokes {
    /// Measures the strokes of a sheet.
    pub fn of(ink: &Ink) -> Strokes {
        let (width, height) = (ink.dark.width() as usize, ink.dark.height() as usize);
        let full = full(ink);
        let tone = Field::new(width, height, |x, y| {
            let level = ink.dark.get_pixel(x as u32, y as u32)[0];
            match level > ink.threshold {
                true => (f32::from(level) / full).min(1.0),
                false => 0.0,
            }
        });
        let thickness = thickness(&tone);
        let (wall, apart) = parted(&thickness);
        let usual = median(thickness.iter().filter(|t| f64::from(*t) >= wall));
        Strokes {
            thickness,
            wall,
            apart,
            usual,
        }
    }

    /// Returns the pixels of walls.
    pub fn walls(&self) -> Field<bool> {
        self.thickness.map(|t| f64::from(t) >= self.wall)
    }

    /// Returns true if walls are as thick as other strokes.
    pub fn has_one_pen(&self) -> bool {
        self.wall <= THINNEST
    }

    /// Sets the least thickness of walls and that of most, pixels.
    pub fn set_walls(&mut self, least: f64, usual: f64) {
        (self.wall, self.usual) = (least, usual);
        self.apart = usual;
    }

    /// Returns the pixels of strokes thinner than walls; with one pen, of all.
    pub fn light(&self) -> Field<bool> {
        let most = if self.has_one_pen() {
            f64::INFINITY
        } else {
            self.wall
        };
        self.thickness.map(|t| t > 0.0 && f64::from(t) < most)
    }

    /// Returns walls with the spaces filled that separate dashes, and strokes that nearly meet.
    pub fn joined(&self, walls: &Field<bool>) -> Field<bool> {
        let [most, dash] = [JOINT, DASH].map(|share| (share * self.usual).round() as usize);
        let mut out = walls.clone();
        for upright in [false, true] {
            let (lines, length) = match upright {
                true => (walls.width, walls.height),
                false => (walls.height, walls.width),
            };
            let place = |line: usize, k: usize| if upright { (line, k) } else { (k, line) };
            for line in 0..lines {
                let at = |k: usize| walls[place(line, k)];
                let runs = runs((0..length).map(at));
                for (a, b) in runs.iter().zip(runs.iter().skip(1)) {
                    let is_dash = |[from, to]: &[usize; 2]| to - from > dash;
                    if b[0] - a[1] <= most && is_dash(a) && is_dash(b) {
                        (a[1]..b[0]).for_each(|k| out[place(line, k)] = true);
                    }
                }
            }
        }
        out
    }

    /// Returns the pixels of all strokes.
    pub fn all(&self) -> Field<bool> {
        self.thickness.map(|t| t > 0.0)
    }
}

impl Strokes {
    /// Returns the share of the ink of walls that lies on one of some lines.
    pub fn explained(&self, lines: impl Iterator<Item = [DVec2; 2]>) -> f64 {
        let walls = self.walls();
        let mut near = walls.map(|_| false);
        let reach = (REACH * self.usual).max(2.0).ceil() as isize;
        for [a, b] in lines {
            let steps = a.distance(b).ceil().max(1.0) as usize;
            for k in 0..=steps {
                let at = a.lerp(b, k as f64 / steps as f64);
                for (dx, dy) in
                    (-reach..=reach).flat_map(|dx| (-reach..=reach).map(move |dy| (dx, dy)))
                {
                    let (x, y) = (at.x as isize + dx, at.y as isize + dy);
                    if near.get(x, y).is_some() {
                        near[(x as usize, y as usize)] = true;
                    }
                }
            }
        }
        let places = || (0..walls.height).flat_map(|y| (0..walls.width).map(move |x| (x, y)));
        let all = places().filter(|p| walls[*p]).count();
        let on = places().filter(|p| walls[*p] && near[*p]).count();
        on as f64 / all.max(1) as f64
    }
}

/// Returns the darkness of full ink: nine tenths of all ink is lighter.
fn full(ink: &Ink) -> f32 {
    let mut counts = [0_usize; 256];
    let dark = ink.dark.pixels().filter(|p| p[0] > ink.threshold);
    dark.for_each(|p| counts[usize::from(p[0])] += 1);
    let all: usize = counts.iter().sum();
    let mut below = 0;
    let level = counts.iter().position(|n| {
        below += n;
        below * 10 > all * 9
    });
    level.unwrap_or(255) as f32
}

/// Returns the thickness at each pixel: the ink of the shortest run through it, of four directions.
fn thickness(tone: &Field<f32>) -> Field<f32> {
    let (width, height) = (tone.width as isize, tone.height as isize);
    let mut out = tone.map(|t| if t > 0.0 { f32::INFINITY } else { 0.0 });
    let mut run = |start: (isize, isize), step: (isize, isize), unit: f32| {
        let (mut x, mut y) = start;
        let mut places = vec![];
        let mut sum = 0.0;
        loop {
            let inside = x >= 0 && y >= 0 && x < width && y < height;
            let t = if inside {
                tone[(x as usize, y as usize)]
            } else {
                0.0
            };
            if t > 0.0 {
                places.push((x as usize, y as usize));
                sum += t * unit;
            } else {
                places.drain(..).for_each(|p| out[p] = out[p].min(sum));
                sum = 0.0;
            }
            if !inside {
                break;
            }
            (x, y) = (x + step.0, y + step.1);
        }
    };
    let slanting = std::f32::consts::SQRT_2;
    (0..height).for_each(|y| run((0, y), (1, 0), 1.0));
    (0..width).for_each(|x| run((x, 0), (0, 1), 1.0));
    for step in [1, -1] {
        let first = if step > 0 { 0 } else { width - 1 };
        (0..width).for_each(|x| run((x, 0), (step, 1), slanting));
        (1..height).for_each(|y| run((first, y), (step, 1), slanting));
    }
    out
}

/// Returns the runs of true values: the first index of each, and that after its last.
fn runs(values: impl Iterator<Item = bool>) -> Vec<[usize; 2]> {
    let mut out: Vec<[usize; 2]> = vec![];
    for (k, _) in values.enumerate().filter(|(_, value)| *value) {
        match out.last_mut() {
            Some(run) if run[1] == k => run[1] = k + 1,
            _ => out.push([k, k + 1]),
        }
    }
    out
}

/// Returns the thickness that parts walls from other strokes, and how far the two are apart; strokes count by their area.
fn parted(thickness: &Field<f32>) -> (f64, f64) {
    let class = |t: f32| ((f64::from(t).max(0.25) * 4.0).log2() * CLASSES) as usize;
    let mut counts = vec![0.0; 128];
    for t in thickness.iter().filter(|t| *t > 0.0) {
        let k = class(t).min(counts.len() - 1);
        counts[k] += 1.0;
    }
    let all: f64 = counts.iter().sum();
    let weighted: f64 = counts.iter().enumerate().map(|(k, n)| k as f64 * n).sum();
    let (mut below, mut sum, mut best) = (0.0, 0.0, (0.0, 0, 0.0));
    for (k, n) in counts.iter().enumerate() {
        below += n;
        sum += k as f64 * n;
        if below == 0.0 || below >= all {
            continue;
        }
        let apart = (weighted - sum) / (all - below) - sum / below;
        let variance = below * (all - below) * apart * apart;
        if variance > best.0 {
            best = (variance, k + 1, apart);
        }
    }
    let apart = (best.2 / CLASSES).exp2();
    if apart < APART {
        // One pen for all: every stroke may be a wall.
        return (THINNEST, apart);
    }
    ((best.1 as f64 / CLASSES).exp2() / 4.0, apart)
}

fn median(values: impl Iterator<Item = f32>) -> f64 {
    let mut all: Vec<f32> = values.collect();
    all.sort_by(f32::total_cmp);
    all.get(all.len() / 2).map_or(0.0, |t| f64::from(*t))
}
