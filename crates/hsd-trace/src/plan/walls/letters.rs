//! Small parts that stand alone: letters, specks, arrows. Dashes of lines are joined.

use super::field::Field;
use super::mask::Strokes;
use crate::plan::raster::{Extent, Parts};
use std::ops::Range;

/// The largest letter, as a share of the diagonal of what is drawn.
const LETTER: f64 = 0.03;
/// The least share of its box that a dash fills.
const SOLID: f64 = 0.75;
/// The least diagonal of a wall, in thicknesses of walls.
const SPECK: f64 = 2.0;
/// The least length of a dash, in its thickness.
const LONG: f64 = 1.2;
/// The widest space between two dashes, in the length of the longer.
const SPACE: f64 = 1.6;
/// The greatest distance of a short wall from the next ones in its line, in its length.
const LINE: f64 = 8.0;
/// The fewest dashes of a line.
const FEWEST: usize = 4;

/// Returns the direction of a dash: true down the sheet.
fn dash(part: &Extent) -> Option<bool> {
    let [w, h] = part.size().map(|s| s as f64);
    let long = w.max(h) >= LONG * w.min(h);
    (long && part.area as f64 >= SOLID * w * h).then_some(h > w)
}

/// Removes letters and joins dashes. Returns the diagonal of what is drawn, pixels.
pub fn remove(strokes: &mut Strokes) -> f64 {
    let labels = strokes.all().parts(true);
    let parts = labels.extents();
    let drawn = parts.iter().map(Extent::diagonal).fold(0.0, f64::max);
    let mut is_small: Vec<bool> = parts
        .iter()
        .map(|p| p.area > 0 && p.diagonal() < LETTER * drawn)
        .collect();
    let walls: Vec<usize> = (1..parts.len())
        .filter(|n| is_small[*n] && stands_between(strokes, &parts[*n], (&labels, &is_small)))
        .collect();
    walls.iter().for_each(|n| is_small[*n] = false);
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

/// Returns walls without specks.
pub fn without_specks(strokes: &Strokes, walls: &Field<bool>) -> Field<bool> {
    let parts = walls.parts(true);
    let extents = parts.extents();
    let least = SPECK * strokes.usual;
    Field::new(walls.width, walls.height, |x, y| {
        walls[(x, y)] && extents[parts.at((x, y))].diagonal() >= least
    })
}

/// Returns true for a short wall between two openings: as thick as walls, with others in its line on both sides.
fn stands_between(strokes: &Strokes, part: &Extent, (labels, is_small): (&Parts, &[bool])) -> bool {
    let Some(upright) = dash(part).filter(|_| !strokes.has_one_pen()) else {
        return false;
    };
    let field = &strokes.thickness;
    let middle = |[a, b]: [usize; 2]| (a + b) / 2;
    let place = |k: usize| match upright {
        true => (middle(part.x), k),
        false => (k, middle(part.y)),
    };
    let ([from, to], length) = match upright {
        true => (part.y, field.height),
        false => (part.x, field.width),
    };
    if f64::from(field[place((from + to) / 2)]) < strokes.wall {
        return false;
    }
    let reach = (LINE * (to - from + 1) as f64) as usize;
    let is_wall = |k: usize| {
        let (x, y) = place(k);
        let part = labels.at((x, y));
        part > 0 && !is_small[part] && f64::from(field[(x, y)]) >= strokes.wall
    };
    let own = to - from + 1;
    // A wall across the line has a shorter run.
    let has_run = |mut line: Range<usize>| {
        let mut run = 0;
        line.any(|k| {
            run = if is_wall(k) { run + 1 } else { 0 };
            run >= own
        })
    };
    let before = from.saturating_sub(reach)..from;
    let after = to + 1..(to + 1 + reach).min(length);
    has_run(before) && has_run(after)
}

/// Finds lines of dashes: each with its thickness.
fn dashes(parts: &[Extent], is_small: &[bool]) -> Vec<(Extent, f32)> {
    let mut out = vec![];
    for upright in [false, true] {
        let small = parts.iter().zip(is_small).filter(|(_, small)| **small);
        let all = small.map(|(p, _)| *p).filter(|p| dash(p) == Some(upright));
        let turned = |p: Extent| match upright {
            true => Extent {
                x: p.y,
                y: p.x,
                ..p
            },
            false => p,
        };
        let mut all: Vec<Extent> = all.map(turned).collect();
        all.sort_by_key(|p| (p.y[0] + p.y[1], p.x[0]));
        let mut used = vec![false; all.len()];
        for k in 0..all.len() {
            if used[k] {
                continue;
            }
            let mut line = vec![k];
            loop {
                let last = all[line[line.len() - 1]];
                let next = beside(&all, &last).filter(|j| !used[*j] && follows(&last, &all[*j]));
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
            let whole = line.iter().map(of).reduce(Extent::with);
            out.extend(whole.map(|whole| (turned(whole), whole.size()[1] as f32)));
        }
    }
    out
}

/// Returns the range of dashes that may continue one; all are sorted by their middle across.
fn beside(all: &[Extent], dash: &Extent) -> Range<usize> {
    let middle = |p: &Extent| p.y[0] + p.y[1];
    let [low, high] = [
        middle(dash).saturating_sub(dash.size()[1]),
        middle(dash) + dash.size()[1],
    ];
    all.partition_point(|p| middle(p) < low)..all.partition_point(|p| middle(p) <= high)
}

/// Returns true if a dash continues where another ends.
fn follows(a: &Extent, b: &Extent) -> bool {
    let longest = a.size()[0].max(b.size()[0]) as f64;
    let between = b.x[0] as f64 - a.x[1] as f64;
    let beside = (a.y[0] + a.y[1]).abs_diff(b.y[0] + b.y[1]) as f64 / 2.0;
    between > 0.0 && between <= SPACE * longest && beside <= a.size()[1] as f64 / 2.0
}
