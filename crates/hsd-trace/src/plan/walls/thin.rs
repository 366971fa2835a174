//! Walls of lines: sliding screens and partitions that are drawn thinner than walls.

use super::bars::{Bar, bars, widened};
use super::field::Field;
use super::mask::Strokes;
use crate::plan::raster::Extent;

/// The least length of a thin wall, as a share of the plan's diagonal.
const LEAST: f64 = 0.05;
/// The thickest wall of lines, in thicknesses of walls.
const THICK: f64 = 1.6;
/// The greatest distance of the end of a thin wall from a wall, in thicknesses of walls.
const NEAR: f64 = 0.8;

/// Finds lines, single or in pairs, that run from wall to wall.
pub(super) fn thin(
    strokes: &Strokes,
    walls: &Field<bool>,
    (bounds, diagonal): (Extent, f64),
) -> Vec<Bar> {
    let mut left = candidates(strokes, (bounds, diagonal));
    let reach = (NEAR * strokes.usual).ceil() as usize + 2;
    let mut known = walls.clone();
    let mut out = vec![];
    loop {
        let before = out.len();
        left.retain(|bar| {
            let holds = [false, true]
                .iter()
                .all(|end| held(bar, *end, reach, &known));
            if holds {
                out.push(*bar);
            }
            !holds
        });
        for bar in &out[before..] {
            draw(&mut known, bar);
        }
        if out.len() == before {
            return out;
        }
    }
}

/// Finds lines, single or in pairs, that are long and thin enough.
fn candidates(strokes: &Strokes, (bounds, diagonal): (Extent, f64)) -> Vec<Bar> {
    let all = strokes.all();
    let half = (strokes.usual / 2.0).ceil().max(1.0) as usize;
    let mut out: Vec<Bar> = vec![];
    for upright in [false, true] {
        let wide = widened(&all, half, upright);
        for bar in bars(&wide, strokes.usual, upright) {
            let across = [bar.across[0] + half, bar.across[1].saturating_sub(half)];
            if across[1] < across[0] {
                continue;
            }
            let (around, ends) = match upright {
                true => (bounds.x, bounds.y),
                false => (bounds.y, bounds.x),
            };
            // Extension lines of dimensions run on beyond the house.
            let along = [bar.along[0].max(ends[0]), bar.along[1].min(ends[1])];
            if along[1] <= along[0] {
                continue;
            }
            let bar = Bar {
                across,
                along,
                ..bar
            };
            let length = (along[1] - along[0] + 1) as f64;
            let thickness = bar.thickness() as f64;
            let line = bar.across[0];
            if line < around[0] || line > around[1] {
                continue;
            }
            if length >= LEAST * diagonal && thickness <= THICK * strokes.usual + 1.0 {
                out.push(bar);
            }
        }
    }
    out
}

/// Draws a wall, to the walls at its ends.
pub fn draw(walls: &mut Field<bool>, bar: &Bar) {
    for line in bar.across[0]..=bar.across[1] {
        for k in bar.along[0]..=bar.along[1] {
            walls[if bar.upright { (line, k) } else { (k, line) }] = true;
        }
    }
}

/// Returns true if a wall stands at an end of a thin one.
fn held(bar: &Bar, last: bool, reach: usize, known: &Field<bool>) -> bool {
    let (lines, length) = match bar.upright {
        true => (known.width, known.height),
        false => (known.height, known.width),
    };
    let end = bar.along[usize::from(last)];
    let (from, to) = (end.saturating_sub(reach), (end + reach).min(length - 1));
    let across = bar.across[0].saturating_sub(1)..=(bar.across[1] + 1).min(lines - 1);
    let place = |k: usize, line: usize| if bar.upright { (line, k) } else { (k, line) };
    (from..=to).any(|k| across.clone().any(|line| known[place(k, line)]))
}
