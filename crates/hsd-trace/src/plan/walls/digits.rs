//! Numbers that are printed on a sheet: dimensions between walls say how large a plan is.

use super::graph::Graph;
use super::measures::{self, Label};
use crate::plan::raster::{Extent, Parts};
use crate::plan::sheet::Ink;
use glam::{DVec2, dvec2};
use image::GrayImage;
use std::collections::BTreeSet;
use std::sync::LazyLock;

/// Digits of 22 typefaces, with and without serifs: digit, width in hundredths of the height, and the ink of 8 by 12 cells in ninths.
const TYPEFACES: &str = include_str!("digits.txt");
/// The cells of a digit.
const CELLS: [usize; 2] = [8, 12];
/// The greatest difference from a digit, mean of all cells.
const UNLIKE: f64 = 0.22;
/// The greatest difference from a digit that is blurred, and the least further difference from any other digit.
const BLURRED: f64 = 0.30;
const APART: f64 = 0.05;
/// The weight of the difference of widths.
const WIDTH: f64 = 0.35;
/// The least and most height of a digit: pixels, and as a share of the diagonal of the plan.
const HEIGHT: (usize, f64) = (6, 0.03);
/// The greatest width of a sign, in its height: `x` between two numbers is broader than high.
const WIDEST: f64 = 1.4;
/// The widest space between digits of a number, in their height.
const SPACE: f64 = 0.45;
/// The greatest distance of a number from the middle of the two walls that it measures, in its height.
const MIDDLE: f64 = 2.0;
/// The greatest difference of lengths and numbers of one scale.
const ALIKE: f64 = 0.012;
/// The fewest dimensions that agree.
const FEWEST: usize = 3;
/// The least and most extent of a house, metres.
const EXTENT: [f64; 2] = [2.5, 80.0];
/// Metres of what numbers count: millimetres, centimetres.
const UNITS: [f64; 2] = [0.001, 0.01];

/// A printed digit.
struct Digit {
    value: u32,
    width: f64,
    cells: Vec<f64>,
}

static DIGITS: LazyLock<Vec<Digit>> = LazyLock::new(|| {
    let read = |line: &str| {
        let mut fields = line.split(' ');
        let number = |text: &str| text.parse::<u32>().ok();
        let (value, width) = (number(fields.next()?)?, number(fields.next()?)?);
        let cells = fields.next()?.bytes().map(|b| f64::from(b - b'0') / 9.0);
        Some(Digit {
            value,
            width: f64::from(width) / 100.0,
            cells: cells.collect(),
        })
    };
    TYPEFACES.lines().filter_map(read).collect()
});

/// A printed number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number {
    /// The value.
    pub value: f64,
    /// The place.
    pub label: Label,
}

/// A small part of the ink, in the direction in which it is read.
pub(super) struct Glyph {
    /// First and last column.
    pub(super) x: [usize; 2],
    /// First and last row.
    pub(super) y: [usize; 2],
    /// The digit that it is, if it is one.
    pub(super) value: Option<u32>,
}

impl Glyph {
    /// Returns its height, pixels.
    pub(super) fn height(&self) -> f64 {
        (self.y[1] - self.y[0] + 1) as f64
    }
}

/// Finds the numbers of three digits and more on a sheet with a plan of the given diagonal.
pub fn numbers(ink: &Ink, diagonal: f64) -> Vec<Number> {
    let level = image::imageops::rotate90(&ink.dark);
    let both = [(&ink.dark, false), (&level, true)];
    let found = both.into_iter().flat_map(|(dark, upright)| {
        let rows = rows(glyphs(dark, ink.threshold, diagonal));
        let height = f64::from(ink.dark.height());
        rows.into_iter().map(move |(value, at, size)| Number {
            value,
            label: Label {
                // A quarter turn to the right takes the foot of the sheet to its left.
                middle: match upright {
                    true => dvec2(at.y, height - at.x),
                    false => at,
                },
                height: size,
                upright,
            },
        })
    });
    found.collect()
}

/// Finds what may be digits.
pub(super) fn glyphs(dark: &GrayImage, threshold: u8, diagonal: f64) -> Vec<Glyph> {
    let black = |x: u32, y: u32| dark.get_pixel(x, y)[0] > threshold;
    let extents = Parts::of_set(dark.dimensions(), black, true).extents();
    let most = (HEIGHT.1 * diagonal) as usize;
    let small = extents.iter().skip(1).filter(|extent| {
        let [w, h] = extent.size();
        h >= HEIGHT.0 && h <= most && w as f64 <= WIDEST * h as f64
    });
    let glyph = |extent: &Extent| Glyph {
        x: extent.x,
        y: extent.y,
        value: recognised(dark, extent),
    };
    small.map(glyph).collect()
}

/// Returns the digit in a box; `None` for anything else.
fn recognised(dark: &GrayImage, extent: &Extent) -> Option<u32> {
    let [w, h] = extent.size().map(|s| s as f64);
    let ([x0, x1], [y0, y1]) = (extent.x, extent.y);
    let darkest = (y0..=y1).flat_map(|y| (x0..=x1).map(move |x| (x, y)));
    let tone = |x: usize, y: usize| f64::from(dark.get_pixel(x as u32, y as u32)[0]);
    let full = darkest.map(|(x, y)| tone(x, y)).fold(1.0, f64::max);
    // The mean of the pixels that a cell covers, each by its part.
    let covered = |k: usize, cells: usize, size: f64| {
        let (from, to) = (
            k as f64 * size / cells as f64,
            (k + 1) as f64 * size / cells as f64,
        );
        (from as usize..(to.ceil() as usize)).map(move |p| {
            let part = (p as f64 + 1.0).min(to) - (p as f64).max(from);
            (p, part)
        })
    };
    let mut cells = Vec::with_capacity(CELLS[0] * CELLS[1]);
    for row in 0..CELLS[1] {
        for column in 0..CELLS[0] {
            let (mut sum, mut all) = (0.0, 0.0);
            for (y, b) in covered(row, CELLS[1], h) {
                for (x, a) in covered(column, CELLS[0], w) {
                    let (x, y) = ((x0 + x).min(x1), (y0 + y).min(y1));
                    sum += a * b * tone(x, y) / full;
                    all += a * b;
                }
            }
            cells.push(sum / all);
        }
    }
    let unlike = |digit: &Digit| {
        let cells = digit.cells.iter().zip(&cells).map(|(a, b)| (a - b).abs());
        let mean = cells.sum::<f64>() / digit.cells.len() as f64;
        mean + WIDTH * (digit.width - w / h).abs()
    };
    let mut best = [(f64::INFINITY, 0); 2];
    for (unlike, value) in DIGITS.iter().map(|d| (unlike(d), d.value)) {
        if unlike < best[0].0 {
            if value != best[0].1 {
                best[1] = best[0];
            }
            best[0] = (unlike, value);
        } else if value != best[0].1 && unlike < best[1].0 {
            best[1] = (unlike, value);
        }
    }
    let [(unlike, value), (second, _)] = best;
    let is_clear = unlike <= BLURRED && second - unlike >= APART;
    (unlike <= UNLIKE || is_clear).then_some(value)
}

/// Puts digits beside each other together: value, middle, height.
fn rows(mut glyphs: Vec<Glyph>) -> Vec<(f64, DVec2, f64)> {
    glyphs.sort_by_key(|g| (g.x[0], g.y[0]));
    let mut used = vec![false; glyphs.len()];
    let mut out = vec![];
    for first in 0..glyphs.len() {
        if used[first] || glyphs[first].value.is_none() {
            continue;
        }
        let mut row = vec![first];
        loop {
            let last = &glyphs[row[row.len() - 1]];
            let height = (last.y[1] - last.y[0] + 1) as f64;
            let follows = |k: &usize| {
                let g = &glyphs[*k];
                let own = (g.y[1] - g.y[0] + 1) as f64;
                let between = g.x[0] as f64 - last.x[1] as f64;
                let foot = last.y[1].abs_diff(g.y[1]) as f64;
                !used[*k]
                    && between > 0.0
                    && between <= SPACE * height
                    && foot <= 0.15 * height + 1.0
                    && (own - height).abs() <= 0.15 * height + 1.0
            };
            let next = (first + 1..glyphs.len())
                .filter(follows)
                .min_by_key(|k| glyphs[*k].x[0]);
            let Some(next) = next.filter(|k| glyphs[*k].value.is_some()) else {
                break;
            };
            row.push(next);
        }
        row.iter().for_each(|k| used[*k] = true);
        if !(3..=6).contains(&row.len()) {
            continue;
        }
        let digits = row.iter().filter_map(|k| glyphs[*k].value);
        let value = digits.fold(0.0, |sum, digit| sum * 10.0 + f64::from(digit));
        let (a, b) = (&glyphs[first], &glyphs[row[row.len() - 1]]);
        let middle = |from: usize, to: usize| (from + to + 1) as f64 / 2.0;
        let at = dvec2(middle(a.x[0], b.x[1]), middle(a.y[0], a.y[1]));
        out.push((value, at, (a.y[1] - a.y[0] + 1) as f64));
    }
    out
}

/// A number with the scale at which it would be the distance of two walls.
#[derive(Clone, Copy)]
struct Vote {
    ratio: f64,
    number: usize,
    /// The axis along which the walls are the outermost ones.
    whole: Option<usize>,
}

/// Returns metres of a pixel by printed dimensions, and how many of them agree. They are numbers between two walls or on a
/// dimension line, or width and depth of the whole.
pub fn metres(numbers: &[Number], (ink, graph): (&Ink, &Graph)) -> Option<(f64, usize)> {
    let places = [0, 1].map(|axis| places(graph, axis));
    let extents = places.iter().filter_map(|p| Some(p.last()? - p.first()?));
    let extent = extents.fold(0.0, f64::max);
    let mut votes = votes(numbers, &places);
    for (number, printed) in numbers.iter().enumerate().filter(|(_, n)| n.value > 0.0) {
        votes.extend(measures::length(ink, &printed.label).map(|length| Vote {
            ratio: printed.value / length,
            number,
            whole: None,
        }));
    }
    let best = votes.iter().map(|vote| agreeing(&votes, vote.ratio));
    let values = |all: &[Vote]| {
        let values = all.iter().map(|v| numbers[v.number].value.to_bits());
        values.collect::<BTreeSet<u64>>().len()
    };
    let is_whole = |all: &[Vote]| {
        [0, 1]
            .iter()
            .all(|axis| all.iter().any(|v| v.whole == Some(*axis)))
    };
    let best = best.max_by_key(|all| (is_whole(all), values(all), all.len()))?;
    if !is_whole(&best) && (best.len() < FEWEST || values(&best) < 2) {
        return None;
    }
    let mut ratios: Vec<f64> = best.iter().map(|v| v.ratio).collect();
    ratios.sort_by(f64::total_cmp);
    let ratio = ratios[ratios.len() / 2];
    let fits = |unit: &&f64| {
        let metres = extent * ratio * **unit;
        (EXTENT[0]..=EXTENT[1]).contains(&metres)
    };
    let unit = UNITS.iter().find(fits)?;
    Some((ratio * unit, best.len()))
}

/// Returns the places of the walls across an axis.
fn places(graph: &Graph, axis: usize) -> Vec<f64> {
    let ends = graph
        .lines
        .iter()
        .map(|line| line.ends.map(|k| graph.corners[k][axis]));
    let across = ends.filter(|[a, b]| (a - b).abs() < 1e-6);
    let mut all: Vec<f64> = across.map(|[a, _]| a).collect();
    all.sort_by(f64::total_cmp);
    all.dedup_by(|a, b| (*a - *b).abs() < 1.0);
    all
}

fn votes(numbers: &[Number], places: &[Vec<f64>; 2]) -> Vec<Vote> {
    let mut votes = vec![];
    for (number, printed) in numbers.iter().enumerate().filter(|(_, n)| n.value > 0.0) {
        for (axis, places) in places.iter().enumerate() {
            for (k, from) in places.iter().enumerate() {
                for (j, to) in places.iter().enumerate().skip(k + 1) {
                    let middle = (from + to) / 2.0;
                    if (middle - printed.label.middle[axis]).abs() <= MIDDLE * printed.label.height
                    {
                        let is_whole = k == 0 && j + 1 == places.len();
                        votes.push(Vote {
                            ratio: printed.value / (to - from),
                            number,
                            whole: is_whole.then_some(axis),
                        });
                    }
                }
            }
        }
    }
    votes
}

/// Returns the votes for a ratio, one of each number.
fn agreeing(votes: &[Vote], ratio: f64) -> Vec<Vote> {
    let near = votes
        .iter()
        .filter(|v| (v.ratio / ratio - 1.0).abs() <= ALIKE);
    let mut all: Vec<Vote> = near.copied().collect();
    all.sort_by_key(|v| (v.number, v.whole.is_none()));
    all.dedup_by_key(|v| v.number);
    all
}
