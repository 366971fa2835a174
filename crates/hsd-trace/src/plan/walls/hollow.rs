//! Fills hollow walls: two lines with nothing between, as thick as all other lines.

use super::bars::{Bar, bars, widened};
use super::mask::Strokes;

/// Half of what the pen is widened by, so that lines that are not quite straight are one, pixels.
const PEN: usize = 1;
/// The least distance of the two lines of a wall, pixels. Then the greatest, as a share of the diagonal of all ink.
const APART: (f64, f64) = (3.0, 0.03);
/// The least length of a wall, in the distance of its lines.
const LONG: f64 = 2.5;
/// The greatest ratio of the thicknesses of walls of one kind.
const ALIKE: f64 = 1.2;
/// The thinnest and thickest walls of a plan, in thicknesses of most walls.
const KINDS: [f64; 2] = [0.55, 2.2];
/// The least share of the length of all lines that belongs to hollow walls, if a plan has them.
const LEAST: f64 = 0.35;
/// The share of a wall's length along which nothing may be drawn between its lines.
const FREE: f64 = 0.8;

/// The most lines of one direction. A sheet with more is not searched, so that time stays bounded.
const MOST_LINES: usize = 10_000;

/// Two lines of a wall.
#[derive(Clone, Copy)]
struct Pair {
    upright: bool,
    along: [usize; 2],
    across: [usize; 2],
}

impl Pair {
    fn apart(&self) -> f64 {
        (self.across[1] - self.across[0]) as f64
    }

    fn length(&self) -> f64 {
        (self.along[1] - self.along[0] + 1) as f64
    }

    fn place(&self, line: usize, k: usize) -> (usize, usize) {
        if self.upright { (line, k) } else { (k, line) }
    }
}

/// Fills the hollow walls of a plan drawn with one pen; `drawn` is the diagonal of all ink.
pub fn fill(strokes: &mut Strokes, drawn: f64) {
    if !strokes.has_one_pen() {
        return;
    }
    let all = strokes.all();
    let (mut pairs, mut lines) = (vec![], 0.0);
    for upright in [false, true] {
        let wide = widened(&all, PEN, upright);
        let bars = bars(&wide, strokes.usual, upright);
        lines += bars
            .iter()
            .map(|bar| (bar.along[1] - bar.along[0] + 1) as f64)
            .sum::<f64>();
        pairs.extend(paired(strokes, bars, [APART.0, APART.1 * drawn]));
    }
    let alike = |from: f64| {
        let range = from..=ALIKE * from;
        let alike = pairs.iter().filter(|pair| range.contains(&pair.apart()));
        alike.map(Pair::length).sum::<f64>()
    };
    let usual = pairs.iter().map(Pair::apart);
    let Some(usual) = usual.max_by(|a, b| alike(*a).total_cmp(&alike(*b))) else {
        return;
    };
    if 2.0 * alike(usual) < LEAST * lines {
        return;
    }
    let kinds = KINDS.map(|ratio| ratio * usual);
    pairs.retain(|pair| (kinds[0]..=kinds[1]).contains(&pair.apart()));
    for pair in &pairs {
        let thickness = (pair.across[1] - pair.across[0] + 1) as f32;
        for line in pair.across[0]..=pair.across[1] {
            for k in pair.along[0]..=pair.along[1] {
                let pixel = &mut strokes.thickness[pair.place(line, k)];
                *pixel = pixel.max(thickness);
            }
        }
    }
    strokes.set_walls(kinds[0], usual + 1.0);
}

/// Finds pairs of parallel lines with nothing between.
fn paired(strokes: &Strokes, mut lines: Vec<Bar>, [least, most]: [f64; 2]) -> Vec<Pair> {
    let middle = |line: &Bar| (line.across[0] + line.across[1]) / 2;
    lines.sort_by_key(|line| (middle(line), line.along));
    let mut out = vec![];
    if lines.len() > MOST_LINES {
        return out;
    }
    for (k, a) in lines.iter().enumerate() {
        for b in &lines[k + 1..] {
            let pair = Pair {
                upright: a.upright,
                along: [a.along[0].max(b.along[0]), a.along[1].min(b.along[1])],
                across: [middle(a), middle(b)],
            };
            if pair.across[1] - pair.across[0] > most as usize {
                break;
            }
            let overlaps = pair.along[1] > pair.along[0];
            if overlaps
                && pair.apart() >= least
                && pair.length() >= LONG * pair.apart()
                && is_free(strokes, &pair)
            {
                out.push(pair);
            }
        }
    }
    out
}

/// Returns true if nothing is drawn along most of the middle between two lines.
fn is_free(strokes: &Strokes, pair: &Pair) -> bool {
    let middle = (pair.across[0] + pair.across[1]) / 2;
    let along = pair.along[0]..=pair.along[1];
    let free = along.filter(|k| strokes.thickness[pair.place(middle, *k)] == 0.0);
    free.count() as f64 >= FREE * pair.length()
}
