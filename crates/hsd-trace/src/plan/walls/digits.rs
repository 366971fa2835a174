//! Numbers that are printed on a sheet.

use super::measures::Label;
use crate::plan::raster::{Extent, Parts};
use crate::plan::sheet::Ink;
use glam::{DVec2, dvec2};
use image::GrayImage;
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
/// The widest space across a decimal point, and across the marks between feet and inches.
const POINT: f64 = 0.95;
const FEET: f64 = 1.5;
/// The most digits of a number.
const MOST_DIGITS: usize = 6;
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

/// The numbers on a sheet.
#[derive(Debug, Default)]
pub struct Numbers {
    /// Millimetres or centimetres: three digits and more.
    pub plain: Vec<Number>,
    /// Millimetres or centimetres, and metres with two or three digits after a decimal point or a space.
    pub metric: Vec<Number>,
    /// Feet and inches, as inches.
    pub inches: Vec<Number>,
}

/// Finds the numbers on a sheet with a plan of the given diagonal.
pub fn numbers(ink: &Ink, diagonal: f64) -> Numbers {
    let level = image::imageops::rotate90(&ink.dark);
    let height = f64::from(ink.dark.height());
    let mut found = Numbers::default();
    for (dark, upright) in [(&ink.dark, false), (&level, true)] {
        let groups = groups(glyphs(dark, ink.threshold, diagonal));
        let number = |(value, at, size): (f64, DVec2, f64)| Number {
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
        };
        for (k, group) in groups.iter().enumerate() {
            let next = group.next(&groups[k + 1..]);
            found.plain.extend(group.plain().map(number));
            let metric = group.plain().into_iter().chain(group.joined(next));
            found.metric.extend(metric.map(number));
            found
                .inches
                .extend(group.inches(next).into_iter().map(number));
        }
    }
    found
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

/// Digits side by side.
struct Group {
    digits: Vec<u32>,
    x: [usize; 2],
    y: [usize; 2],
}

/// A number, its middle and the height of its digits.
type Printed = (f64, DVec2, f64);

impl Group {
    fn height(&self) -> f64 {
        (self.y[1] - self.y[0] + 1) as f64
    }

    /// Returns the group that follows in its row after a decimal point, a mark of feet or a space, and that space in heights. Groups
    /// are sorted by their first column.
    fn next<'g>(&self, groups: &'g [Group]) -> Option<(&'g Group, f64)> {
        let height = self.height();
        let reach = self.x[1] as f64 + FEET * height;
        let slack = 0.15 * height + 1.0;
        let near = groups.iter().take_while(|g| g.x[0] as f64 <= reach);
        let mut follows = near.filter(|g| {
            g.x[0] > self.x[1]
                && g.y[1].abs_diff(self.y[1]) as f64 <= slack
                && (g.height() - height).abs() <= slack
        });
        let next = follows.next()?;
        Some((next, (next.x[0] - self.x[1]) as f64 / height))
    }

    /// Returns a number of this group and those that belong to it.
    fn number(&self, value: f64, last: &Group) -> Printed {
        let middle = |from: usize, to: usize| (from + to + 1) as f64 / 2.0;
        let at = dvec2(middle(self.x[0], last.x[1]), middle(self.y[0], self.y[1]));
        (value, at, self.height())
    }

    /// Returns its number, if it has three digits or more.
    fn plain(&self) -> Option<Printed> {
        (self.digits.len() >= 3).then(|| self.number(value(&self.digits), self))
    }

    /// Returns its number with the digits that follow a space or a decimal point.
    fn joined(&self, next: Option<(&Group, f64)>) -> Option<Printed> {
        let (next, space) = next?;
        let fits = self.digits.len() <= 2 && (2..=3).contains(&next.digits.len());
        let both = [&self.digits[..], &next.digits].concat();
        (space <= POINT && fits).then(|| self.number(value(&both), next))
    }

    /// Returns the lengths in feet and inches, as inches: of this group, and with what follows the mark of feet.
    fn inches(&self, next: Option<(&Group, f64)>) -> Vec<Printed> {
        // Dimensions have feet of one or two digits.
        let inches = |feet: &[u32], rest: &[u32]| inches(feet, rest).filter(|_| feet.len() <= 2);
        // The mark of feet is narrow. Two digits side by side are feet alone.
        let ends = 1..self.digits.len().max(1);
        let ends = ends.filter(|_| self.digits.len() > 2);
        let splits = ends.filter_map(|at| {
            let (feet, rest) = self.digits.split_at(at);
            Some(self.number(inches(feet, rest)?, self))
        });
        let joined =
            next.and_then(|(next, _)| Some(self.number(inches(&self.digits, &next.digits)?, next)));
        splits.chain(joined).collect()
    }
}

/// Returns a length in inches by the digits of its feet and inches; `None` for other digits.
pub(super) fn inches(feet: &[u32], rest: &[u32]) -> Option<f64> {
    let is_length = feet.first() != Some(&0) && (rest.len() == 1 || rest.first() == Some(&1));
    let rest = Some(value(rest)).filter(|rest| is_length && *rest < 12.0)?;
    Some(12.0 * value(feet) + rest)
}

/// Returns the number that digits are.
pub(super) fn value(digits: &[u32]) -> f64 {
    digits
        .iter()
        .fold(0.0, |sum, digit| sum * 10.0 + f64::from(*digit))
}

/// Puts digits beside each other together, sorted by their first column.
fn groups(mut glyphs: Vec<Glyph>) -> Vec<Group> {
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
            let height = last.height();
            let follows = |k: &usize| {
                let g = &glyphs[*k];
                let between = g.x[0] as f64 - last.x[1] as f64;
                let foot = last.y[1].abs_diff(g.y[1]) as f64;
                !used[*k]
                    && between > 0.0
                    && between <= SPACE * height
                    && foot <= 0.15 * height + 1.0
                    && (g.height() - height).abs() <= 0.15 * height + 1.0
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
        if row.len() > MOST_DIGITS {
            continue;
        }
        let (a, b) = (&glyphs[first], &glyphs[row[row.len() - 1]]);
        out.push(Group {
            digits: row.iter().filter_map(|k| glyphs[*k].value).collect(),
            x: [a.x[0], b.x[1]],
            y: a.y,
        });
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The groups of a text with digits 6 pixels wide and 10 high: a point, a mark and a blank leave their spaces.
    fn groups_of(text: &str) -> Vec<Group> {
        let mut x = 0;
        let mut glyphs = vec![];
        for letter in text.chars() {
            let width = match letter {
                '.' | '\'' | ' ' => 5,
                _ => 8,
            };
            if width == 8 {
                glyphs.push(Glyph {
                    x: [x, x + 5],
                    y: [0, 9],
                    value: letter.to_digit(10),
                });
            }
            x += width;
        }
        groups(glyphs)
    }

    /// The metric lengths and those in inches of the first number of a text.
    fn lengths(text: &str) -> [Vec<f64>; 2] {
        let groups = groups_of(text);
        let next = groups[0].next(&groups[1..]);
        let metric = groups[0].plain().into_iter().chain(groups[0].joined(next));
        [
            metric.map(|n| n.0).collect(),
            groups[0].inches(next).iter().map(|n| n.0).collect(),
        ]
    }

    #[test]
    fn numbers_in_parts_are_read_with_all_their_parts() {
        assert_eq!(lengths("3640")[0], [3640.0]);
        assert_eq!(lengths("3.45")[0], [345.0]);
        assert_eq!(lengths("1 925")[0], [1925.0]);
        assert_eq!(lengths("12'6")[1], [150.0]);
        assert_eq!(lengths("9'10")[1], [118.0]);
        assert_eq!(lengths("126")[1], [150.0]);
    }

    #[test]
    fn numbers_apart_and_impossible_inches_stay_apart() {
        assert_eq!(lengths("36   40")[0], Vec::<f64>::new());
        assert_eq!(lengths("12'34")[1], Vec::<f64>::new());
        assert_eq!(lengths("8.9999")[0], Vec::<f64>::new());
    }
}
