//! Dimension lines: the lengths that printed numbers measure (plans.md 2).

use crate::plan::sheet::Ink;
use glam::DVec2;

/// The space between the middle of a number and its line, in the height of its digits.
const SPACE: [f64; 2] = [0.55, 2.2];
/// The thickest line, in the height of digits, and pixels.
const THICK: (f64, f64) = (0.35, 3.0);
/// The reach beyond a line of a dot, a tick or an extension line at its end, pixels. Then the longest dot, in the height of digits.
const BEYOND: isize = 1;
const DOT: f64 = 1.2;
/// The shortest piece, in the height of digits.
const SHORT: f64 = 1.5;
/// The greatest distance of a number from the middle of a piece, as a share of the piece and in the height of digits.
const MIDDLE: (f64, f64) = (0.2, 0.6);

/// The place of a printed number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Label {
    /// The middle, pixels.
    pub middle: DVec2,
    /// The height of its digits, pixels.
    pub height: f64,
    /// True if it is read upwards.
    pub upright: bool,
}

/// Returns the length of the piece of a dimension line in the middle of which a number is, pixels.
pub(super) fn length(ink: &Ink, number: &Label) -> Option<f64> {
    let lines = [-1, 1].map(|side| Line::beside(ink, number, side));
    let mut lines: Vec<Line<'_>> = lines.into_iter().flatten().collect();
    lines.sort_by_key(|line| line.off);
    lines.iter().find_map(Line::piece)
}

/// A line beside a number, in the direction in which the number is read.
struct Line<'i> {
    ink: &'i Ink,
    upright: bool,
    /// The middle of the number along the line, and the middle of the line across it.
    at: [isize; 2],
    /// The distance between them.
    off: isize,
    thickness: isize,
    height: f64,
}

impl<'i> Line<'i> {
    /// Finds the nearest line on one side of a number.
    fn beside(ink: &'i Ink, number: &Label, side: isize) -> Option<Line<'i>> {
        let [along, across] = match number.upright {
            true => [number.middle.y, number.middle.x],
            false => [number.middle.x, number.middle.y],
        };
        let mut line = Line {
            ink,
            upright: number.upright,
            at: [along as isize, across as isize],
            off: 0,
            thickness: 0,
            height: number.height,
        };
        let [near, far] = SPACE.map(|space| (space * number.height) as isize);
        let start = (near..=far).find(|d| line.is_dark(line.at[0], line.at[1] + side * d))?;
        let mut end = start;
        while line.is_dark(line.at[0], line.at[1] + side * (end + 1)) {
            end += 1;
        }
        line.off = start;
        line.thickness = end - start + 1;
        line.at[1] += side * (start + end) / 2;
        let most = (THICK.0 * number.height).max(THICK.1);
        (line.thickness as f64 <= most).then_some(line)
    }

    fn is_dark(&self, along: isize, across: isize) -> bool {
        let (x, y) = match self.upright {
            true => (across, along),
            false => (along, across),
        };
        let inside = |k: isize, size: u32| (0..size as isize).contains(&k);
        let (width, height) = self.ink.dark.dimensions();
        inside(x, width) && inside(y, height) && self.ink.is(x as u32, y as u32)
    }

    /// Returns true if the line is at a place.
    fn has(&self, along: isize) -> bool {
        (-1..=1).any(|d| self.is_dark(along, self.at[1] + d))
    }

    /// Returns true if a dot, a tick or another line crosses the line at a place.
    fn is_crossed(&self, along: isize) -> bool {
        let beyond = |side: isize| {
            let from = self.thickness / 2 + 1;
            (from..from + BEYOND).all(|d| self.is_dark(along, self.at[1] + side * d))
        };
        beyond(1) && beyond(-1)
    }

    /// Returns the place where the line ends or is crossed, from the middle of the number on.
    fn stop(&self, step: isize) -> f64 {
        let mut at = self.at[0];
        while self.has(at + step) {
            at += step;
            if self.is_crossed(at) {
                let first = at;
                while self.is_crossed(at + step) && ((at - first).abs() as f64) < DOT * self.height
                {
                    at += step;
                }
                return (first + at) as f64 / 2.0;
            }
        }
        at as f64
    }

    /// Returns the length of the piece in the middle of which the number is.
    fn piece(&self) -> Option<f64> {
        let [from, to] = [-1, 1].map(|step| self.stop(step));
        let length = to - from;
        let off = ((from + to) / 2.0 - self.at[0] as f64).abs();
        let is_long = length >= SHORT * self.height;
        (is_long && off <= MIDDLE.0 * length + MIDDLE.1 * self.height).then_some(length)
    }
}
