//! Fills hollow walls: two lines with nothing between, drawn with the pen of all lines or with a thicker one.

use super::bars::{Bar, bars, widened};
use super::mask::Strokes;
use crate::plan::thicknesses::{ALIKE, Thicknesses};

/// Half of what the pen is widened by, so that lines that are not quite straight are one, pixels.
const PEN: usize = 1;
/// The least distance of the two lines of a wall, pixels. Then the greatest, as a share of the diagonal of all ink.
const APART: (f64, f64) = (3.0, 0.03);
/// The least length of a wall where thicknesses are measured, and of any wall, in the distance of its lines.
const LONG: f64 = 2.5;
const SHORT: f64 = 1.0;
/// The thinnest and thickest walls of a plan, in thicknesses of most walls: drawn with the pen of all lines, and with a thicker one.
const KINDS: [f64; 2] = [0.55, 2.2];
const KINDS_BY_PEN: [f64; 2] = [0.25, 3.5];
/// The least length of all walls of a kind that are drawn with a thicker pen, as a share of the commonest kind.
const COMMON: f64 = 0.15;
/// The greatest distance from the end of a wall to the wall that it meets, in the thickness of that.
const CORNER: f64 = 0.6;
/// The least share of the length of lines that belongs to hollow walls, if a plan has them. First for one pen, then for lines of a
/// thicker one.
const LEAST: [f64; 2] = [0.35, 0.25];
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

    /// Returns this pair, longer where it ends at one that crosses it.
    fn to_corners<'p>(self, crossing: impl Iterator<Item = &'p Pair>) -> Pair {
        let mut out = self;
        for other in crossing {
            let reach = |pair: &Pair| (CORNER * pair.apart()) as usize + 2;
            let meets = self.across[0] <= other.along[1] + reach(&self)
                && other.along[0] <= self.across[1] + reach(&self);
            if meets && self.along[0].abs_diff(other.across[1]) <= reach(other) {
                out.along[0] = out.along[0].min(other.across[0]);
            }
            if meets && self.along[1].abs_diff(other.across[0]) <= reach(other) {
                out.along[1] = out.along[1].max(other.across[1]);
            }
        }
        out
    }
}

/// Fills the hollow walls of a plan; `drawn` is the diagonal of all ink.
pub fn fill(strokes: &mut Strokes, drawn: f64) {
    let has_one_pen = strokes.has_one_pen();
    let ink = if has_one_pen {
        strokes.all()
    } else {
        strokes.walls()
    };
    let sides = [false, true].map(|upright| {
        let wide = widened(&ink, PEN, upright);
        bars(&wide, strokes.usual, upright)
    });
    let found = |long: f64| -> Vec<Pair> {
        let apart = [APART.0, APART.1 * drawn];
        let sides = sides.iter().cloned();
        sides
            .flat_map(|lines| paired(strokes, lines, (apart, long)))
            .collect()
    };
    let measured = found(LONG);
    let thicknesses = Thicknesses::of(measured.iter().map(|pair| (pair.apart(), pair.length())));
    let Some((usual, length)) = thicknesses.commonest() else {
        return;
    };
    let lengths = sides.iter().flatten().map(Bar::length);
    // Strokes of letters are shorter.
    let lines: f64 = lengths.filter(|length| *length >= LONG * usual).sum();
    let least = LEAST[usize::from(!has_one_pen)];
    if 2.0 * length < least * lines {
        return;
    }
    let kinds = if has_one_pen { KINDS } else { KINDS_BY_PEN }.map(|ratio| ratio * usual);
    let is_common = |apart: f64| {
        has_one_pen || thicknesses.length(apart / ALIKE, ALIKE * apart) >= COMMON * length
    };
    let mut pairs = found(if has_one_pen { LONG } else { SHORT });
    pairs.retain(|pair| (kinds[0]..=kinds[1]).contains(&pair.apart()) && is_common(pair.apart()));
    for pair in &to_corners(&pairs) {
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

/// Returns walls, longer where they end at others that cross them, so that corners are filled.
fn to_corners(pairs: &[Pair]) -> Vec<Pair> {
    let mut sides = [false, true].map(|upright| {
        let side = pairs.iter().filter(|pair| pair.upright == upright);
        side.copied().collect::<Vec<Pair>>()
    });
    let of_place = |pair: &Pair| pair.across[0];
    sides.iter_mut().for_each(|side| side.sort_by_key(of_place));
    let widest = pairs.iter().map(Pair::apart).fold(0.0, f64::max);
    let reach = (2.0 * widest) as usize + 2;
    let longer = |pair: &Pair| {
        let others = &sides[usize::from(!pair.upright)];
        let near = |end: usize| {
            let first = others.partition_point(|o| of_place(o) + reach < end);
            let end = others.partition_point(|o| of_place(o) <= end + reach);
            others[first..end].iter()
        };
        pair.to_corners(near(pair.along[0]).chain(near(pair.along[1])))
    };
    pairs.iter().map(longer).collect()
}

/// Finds pairs of parallel lines with nothing between.
fn paired(
    strokes: &Strokes,
    mut lines: Vec<Bar>,
    ([least, most], long): ([f64; 2], f64),
) -> Vec<Pair> {
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
                && pair.length() >= long * pair.apart()
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
