//! Small parts that stand alone: letters, specks, arrows. Dashes of lines are joined.

use super::mask::Strokes;
use crate::plan::raster::Parts;
use image::{GrayImage, Luma};

/// The largest letter, as a share of the diagonal of what is drawn.
const LETTER: f64 = 0.03;
/// The least share of its box that a dash fills.
const SOLID: f64 = 0.75;
/// The least length of a dash, in its thickness.
const LONG: f64 = 1.2;
/// The widest space between two dashes, in the length of the longer.
const SPACE: f64 = 1.6;
/// The fewest dashes of a line.
const FEWEST: usize = 4;

/// A connected part of the ink.
#[derive(Clone, Copy, Debug)]
struct Part {
    x: [usize; 2],
    y: [usize; 2],
    area: usize,
}

impl Part {
    fn size(&self) -> [usize; 2] {
        [self.x[1] - self.x[0] + 1, self.y[1] - self.y[0] + 1]
    }

    /// Returns the direction of a dash: true down the sheet.
    fn dash(&self) -> Option<bool> {
        let [w, h] = self.size().map(|s| s as f64);
        let long = w.max(h) >= LONG * w.min(h);
        (long && self.area as f64 >= SOLID * w * h).then_some(h > w)
    }
}

/// Removes letters and joins dashes. Returns the diagonal of what is drawn, pixels.
pub fn remove(strokes: &mut Strokes) -> f64 {
    let field = &strokes.thickness;
    let ink = GrayImage::from_fn(field.width as u32, field.height as u32, |x, y| {
        Luma([u8::from(field[(x as usize, y as usize)] > 0.0)])
    });
    let labels = Parts::of(&ink, true);
    let empty = Part {
        x: [usize::MAX, 0],
        y: [usize::MAX, 0],
        area: 0,
    };
    let mut parts = vec![empty; labels.count + 1];
    for (x, y, n) in labels.pixels() {
        let part = &mut parts[n as usize];
        let (x, y) = (x as usize, y as usize);
        part.x = [part.x[0].min(x), part.x[1].max(x)];
        part.y = [part.y[0].min(y), part.y[1].max(y)];
        part.area += 1;
    }
    let diagonal = |p: &Part| {
        let [w, h] = p.size().map(|s| s as f64);
        w.hypot(h)
    };
    let drawn = parts.iter().skip(1).map(diagonal).fold(0.0, f64::max);
    let is_small: Vec<bool> = parts
        .iter()
        .map(|p| p.area > 0 && diagonal(p) < LETTER * drawn)
        .collect();
    let dashes = dashes(&parts, &is_small);
    for (x, y, n) in labels.pixels() {
        if is_small[n as usize] {
            strokes.thickness[(x as usize, y as usize)] = 0.0;
        }
    }
    for (part, thick) in dashes {
        for y in part.y[0]..=part.y[1] {
            for x in part.x[0]..=part.x[1] {
                strokes.thickness[(x, y)] = thick;
            }
        }
    }
    drawn
}

/// Finds lines of dashes: each with its thickness.
fn dashes(parts: &[Part], is_small: &[bool]) -> Vec<(Part, f32)> {
    let mut out = vec![];
    for upright in [false, true] {
        let small = parts.iter().zip(is_small).filter(|(_, small)| **small);
        let all = small.map(|(p, _)| *p).filter(|p| p.dash() == Some(upright));
        let turned = |p: Part| match upright {
            true => Part {
                x: p.y,
                y: p.x,
                ..p
            },
            false => p,
        };
        let mut all: Vec<Part> = all.map(turned).collect();
        all.sort_by_key(|p| (p.y[0] + p.y[1], p.x[0]));
        let mut used = vec![false; all.len()];
        for k in 0..all.len() {
            if used[k] {
                continue;
            }
            let mut line = vec![k];
            loop {
                let last = all[line[line.len() - 1]];
                let next = (0..all.len()).filter(|j| !used[*j] && follows(&last, &all[*j]));
                let Some(next) = next.min_by_key(|j| all[*j].x[0]) else {
                    break;
                };
                line.push(next);
            }
            if line.len() < FEWEST {
                continue;
            }
            line.iter().for_each(|j| used[*j] = true);
            let of = |j: &usize| all[*j];
            let whole = line.iter().map(of).reduce(|a, b| Part {
                x: [a.x[0].min(b.x[0]), a.x[1].max(b.x[1])],
                y: [a.y[0].min(b.y[0]), a.y[1].max(b.y[1])],
                area: a.area + b.area,
            });
            out.extend(whole.map(|whole| (turned(whole), whole.size()[1] as f32)));
        }
    }
    out
}

/// Returns true if a dash continues where another ends.
fn follows(a: &Part, b: &Part) -> bool {
    let longest = a.size()[0].max(b.size()[0]) as f64;
    let between = b.x[0] as f64 - a.x[1] as f64;
    let beside = (a.y[0] + a.y[1]).abs_diff(b.y[0] + b.y[1]) as f64 / 2.0;
    between > 0.0 && between <= SPACE * longest && beside <= a.size()[1] as f64 / 2.0
}
