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
const COMMON: RangeInclusive<f64> = 0.05..=1.5;
const CLEAR: f64 = 0.35;
/// The least share of partitions, by length, that are connected to a wall. Furniture is not.
const ATTACHED: f64 = 0.75;

/// Counts lines in a second pen, much thinner than outer walls and thicker than all else, among walls. `drawn` is the diagonal of all
/// ink.
pub(super) fn include(strokes: &mut Strokes, drawn: f64) {
    let most = strokes.usual / APART;
    if strokes.has_one_pen() || most < THIN {
        return;
    }
    let lines = |of: &dyn Fn(f64) -> bool| -> Vec<(f64, Bar)> {
        let field = strokes.thickness.map(|t| t > 0.0 && of(f64::from(t)));
        [false, true]
            .into_iter()
            .flat_map(|upright| bars(&field, strokes.usual, upright))
            .filter(|bar| bar.length() >= LINE * drawn)
            .map(|bar| (middle(strokes, &bar), bar))
            .collect()
    };
    let length = |lines: &[(f64, Bar)], from: f64, to: f64| -> f64 {
        let within = lines.iter().filter(|line| line.0 >= from && line.0 < to);
        within.map(|line| line.1.length()).sum()
    };
    let walls = length(&lines(&|t| t >= strokes.wall), 0.0, f64::INFINITY);
    let mut light = lines(&|t| t < strokes.wall);
    light.sort_by(|a, b| a.0.total_cmp(&b.0));
    let half = length(&light, THIN, most) / 2.0;
    let mut sum = 0.0;
    let usual = light.iter().filter(|line| line.0 >= THIN && line.0 < most);
    let usual = usual.copied().find(|line| {
        sum += line.1.length();
        sum >= half
    });
    let Some((usual, _)) = usual else { return };
    let partitions = length(&light, ALIKE * usual, most);
    let between = length(&light, BETWEEN * usual, ALIKE * usual);
    let is_pen = COMMON.contains(&(partitions / walls)) && between <= CLEAR * partitions;
    light.retain(|line| line.0 >= ALIKE * usual && line.0 < most);
    if is_pen && attached(strokes, ALIKE * usual, &light) >= ATTACHED * partitions {
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

/// Returns the length of those lines that meet a wall, by strokes of at least some thickness.
fn attached(strokes: &Strokes, least: f64, lines: &[(f64, Bar)]) -> f64 {
    let parts = strokes.thickness.map(|t| f64::from(t) >= least).parts(true);
    let mut walls = vec![0_usize; parts.count + 1];
    for (x, y, n) in parts.pixels() {
        let is_wall = f64::from(strokes.thickness[(x as usize, y as usize)]) >= strokes.wall;
        walls[n as usize] += usize::from(is_wall);
    }
    let wall = (strokes.usual * strokes.usual) as usize;
    let is_on_wall = |bar: &Bar| {
        let [along, across] = [bar.along, bar.across].map(|[a, b]| a.midpoint(b));
        let place = if bar.upright {
            (across, along)
        } else {
            (along, across)
        };
        walls[parts.at(place)] >= wall
    };
    let on = lines.iter().filter(|line| is_on_wall(&line.1));
    on.map(|line| line.1.length()).sum()
}
