//! Partitions in a pen between that of thick outer walls and that of all else.

use super::bars::{Bar, bars};
use super::mask::Strokes;
use std::ops::RangeInclusive;

/// The least length of a line, as a share of the diagonal of all ink.
const LINE: f64 = 0.03;
/// The thinnest partitions, pixels: of thinner pens the widths are uncertain.
const THIN: f64 = 3.0;
/// The least ratio of the thickness of outer walls to that of partitions.
const APART: f64 = 4.0;
/// The least thickness of partitions, as a share of most of them; then that of a pen between them and all else.
const ALIKE: f64 = 0.75;
const BETWEEN: f64 = 0.45;
/// The length of all partitions, as a share of that of walls; then the greatest length of a pen between, as a share of theirs.
const COMMON: RangeInclusive<f64> = 0.15..=1.5;
const CLEAR: f64 = 0.35;
/// The least share of partitions, by area, that are connected to a wall. Furniture is not.
const ATTACHED: f64 = 0.75;

/// Counts lines in a second pen, much thinner than outer walls and thicker than all else, among walls. `drawn` is the diagonal of all
/// ink.
pub(super) fn include(strokes: &mut Strokes, drawn: f64) {
    let most = strokes.usual / APART;
    if strokes.has_one_pen() || most < THIN {
        return;
    }
    let lines = |of: &dyn Fn(f64) -> bool| -> Vec<(f64, f64)> {
        let field = strokes.thickness.map(|t| t > 0.0 && of(f64::from(t)));
        [false, true]
            .into_iter()
            .flat_map(|upright| bars(&field, strokes.usual, upright))
            .filter(|bar| bar.length() >= LINE * drawn)
            .map(|bar| (middle(strokes, &bar), bar.length()))
            .collect()
    };
    let length = |lines: &[(f64, f64)], from: f64, to: f64| -> f64 {
        let within = lines.iter().filter(|line| line.0 >= from && line.0 < to);
        within.map(|line| line.1).sum()
    };
    let walls = length(&lines(&|t| t >= strokes.wall), 0.0, f64::INFINITY);
    let mut light = lines(&|t| t < strokes.wall);
    light.sort_by(|a, b| a.0.total_cmp(&b.0));
    let half = length(&light, THIN, most) / 2.0;
    let mut sum = 0.0;
    let usual = light.iter().filter(|line| line.0 >= THIN && line.0 < most);
    let usual = usual.copied().find(|line| {
        sum += line.1;
        sum >= half
    });
    let Some((usual, _)) = usual else { return };
    let partitions = length(&light, ALIKE * usual, most);
    let between = length(&light, BETWEEN * usual, ALIKE * usual);
    let is_pen = COMMON.contains(&(partitions / walls)) && between <= CLEAR * partitions;
    if is_pen && attached(strokes, ALIKE * usual) >= ATTACHED {
        strokes.wall = ALIKE * usual;
    }
}

/// Returns the thickness of a line in the middle of all along it.
fn middle(strokes: &Strokes, bar: &Bar) -> f64 {
    let line = (bar.across[0] + bar.across[1]) / 2;
    let place = |k: usize| if bar.upright { (line, k) } else { (k, line) };
    let mut all: Vec<f32> = (bar.along[0]..=bar.along[1])
        .map(|k| strokes.thickness[place(k)])
        .collect();
    all.sort_by(f32::total_cmp);
    f64::from(all[all.len() / 2])
}

/// Returns the share of strokes of at least some thickness, thinner than walls, that meet a wall.
fn attached(strokes: &Strokes, least: f64) -> f64 {
    let thick = strokes.thickness.map(|t| f64::from(t) >= least);
    let parts = thick.parts(true);
    let mut walls = vec![0_usize; parts.extents().len()];
    let mut thin = walls.clone();
    for (x, y, n) in parts.pixels() {
        let is_wall = f64::from(strokes.thickness[(x as usize, y as usize)]) >= strokes.wall;
        let counts = if is_wall { &mut walls } else { &mut thin };
        counts[n as usize] += 1;
    }
    let wall = (strokes.usual * strokes.usual) as usize;
    let counts = || walls.iter().zip(&thin).skip(1);
    let on: usize = counts()
        .filter(|(walls, _)| **walls >= wall)
        .map(|c| c.1)
        .sum();
    let all: usize = counts().map(|c| c.1).sum();
    on as f64 / all.max(1) as f64
}
