//! Straight walls along and across a sheet.

use super::field::Field;

/// The least length of a wall, in its thickness.
const LEAST: f64 = 1.5;
/// The share of its box that a straight wall fills.
const SOLID: f64 = 0.7;
/// The least length of a part that is cut in two, in the least length of a straight wall: letters are shorter.
const SPLIT: usize = 6;
/// The least length of a line of pixels in a wall, as a share of its longest line.
const LONG: f64 = 0.5;

/// A straight wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bar {
    /// True if it runs down the sheet.
    pub upright: bool,
    /// First and last pixel along it.
    pub along: [usize; 2],
    /// First and last pixel across it.
    pub across: [usize; 2],
}

impl Bar {
    /// Returns its thickness.
    pub fn thickness(&self) -> usize {
        self.across[1] - self.across[0] + 1
    }

    /// Returns its length.
    pub fn length(&self) -> f64 {
        (self.along[1] - self.along[0] + 1) as f64
    }
}

/// Finds the straight walls of one direction.
pub fn bars(walls: &Field<bool>, usual: f64, upright: bool) -> Vec<Bar> {
    let least = (LEAST * usual).ceil().max(3.0) as usize;
    let (lines, length) = match upright {
        true => (walls.width, walls.height),
        false => (walls.height, walls.width),
    };
    let place = |line: usize, k: usize| if upright { (line, k) } else { (k, line) };
    let mut opened = walls.map(|_| false);
    for line in 0..lines {
        let mut start = 0;
        for k in 0..=length {
            if k < length && walls[place(line, k)] {
                continue;
            }
            if k - start >= least {
                (start..k).for_each(|k| opened[place(line, k)] = true);
            }
            start = k + 1;
        }
    }
    let parts = opened.parts(false);
    let mut pixels: Vec<Vec<(u32, u32)>> = vec![vec![]; parts.count + 1];
    for (x, y, part) in parts.pixels() {
        pixels[part as usize].push(if upright { (x, y) } else { (y, x) });
    }
    let mut out = vec![];
    for part in pixels.iter().skip(1) {
        straight(part, (upright, least), &mut out);
    }
    out
}

/// Finds the straight walls in a connected part, given by its pixels across and along. A curved or stepped part becomes a row of
/// walls.
fn straight(part: &[(u32, u32)], (upright, least): (bool, usize), out: &mut Vec<Bar>) {
    let lines = Lines::of(part);
    if let Some(bar) = Bar::of(&lines, upright) {
        out.push(bar);
        return;
    }
    // Lines of pixels that do not touch are separate walls.
    let mut starts: Vec<usize> = vec![];
    let mut last = None;
    for (line, _) in lines.all() {
        if last.is_none_or(|last| line > last + 1) {
            starts.push(line);
        }
        last = Some(line);
    }
    if starts.len() > 1 {
        let mut groups = vec![vec![]; starts.len()];
        for pixel in part {
            groups[starts.partition_point(|start| *start <= pixel.0 as usize) - 1].push(*pixel);
        }
        for group in groups {
            straight(&group, (upright, least), out);
        }
        return;
    }
    let ends = lines.all().map(|(_, line)| line.along);
    let Some([from, to]) = ends.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]) else {
        return;
    };
    if to - from < SPLIT * least {
        return;
    }
    let middle = (from + to) / 2;
    let (before, after): (Vec<_>, Vec<_>) = part.iter().partition(|(_, k)| *k as usize <= middle);
    straight(&before, (upright, least), out);
    straight(&after, (upright, least), out);
}

/// The pixels of a part in one line along it.
#[derive(Clone, Copy)]
struct Line {
    along: [usize; 2],
    count: usize,
}

impl Default for Line {
    fn default() -> Line {
        let along = [usize::MAX, 0];
        Line { along, count: 0 }
    }
}

impl Line {
    fn add(&mut self, k: usize) {
        self.along = [self.along[0].min(k), self.along[1].max(k)];
        self.count += 1;
    }
}

/// The lines of pixels of a part.
struct Lines {
    /// The number of the first.
    first: usize,
    lines: Vec<Line>,
}

impl Lines {
    fn of(part: &[(u32, u32)]) -> Lines {
        let across = part.iter().map(|pixel| pixel.0 as usize);
        let first = across.clone().min().unwrap_or(0);
        let last = across.max().unwrap_or(0);
        let mut lines = vec![Line::default(); last + 1 - first];
        for (line, k) in part {
            lines[*line as usize - first].add(*k as usize);
        }
        Lines { first, lines }
    }

    /// Returns all that have pixels, with their numbers.
    fn all(&self) -> impl DoubleEndedIterator<Item = (usize, &Line)> {
        let numbered = self.lines.iter().enumerate();
        numbered
            .filter(|(_, line)| line.count > 0)
            .map(|(k, line)| (self.first + k, line))
    }
}

impl Bar {
    /// Returns the straight wall in a connected part, given by its lines of pixels, without posts that protrude from it.
    fn of(lines: &Lines, upright: bool) -> Option<Bar> {
        let longest = lines.all().map(|(_, line)| line.count).max()?;
        let is_long = |line: &Line| line.count as f64 >= LONG * longest as f64;
        let long = || lines.all().filter(|(_, line)| is_long(line));
        let across = [long().next()?.0, long().next_back()?.0];
        let along = long().map(|(_, line)| line.along);
        let along = along.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])?;
        let bar = Bar {
            upright,
            along,
            across,
        };
        let length = (along[1] - along[0] + 1) as f64;
        let thickness = bar.thickness() as f64;
        let within = lines
            .all()
            .filter(|(k, _)| (across[0]..=across[1]).contains(k));
        let filled = within.map(|(_, line)| line.count).sum::<usize>() as f64;
        (length > thickness && filled > SOLID * length * thickness).then_some(bar)
    }
}

/// Returns the strokes, each as wide as if it were drawn with a thicker pen.
pub fn widened(all: &Field<bool>, half: usize, upright: bool) -> Field<bool> {
    Field::new(all.width, all.height, |x, y| {
        let around = |k: usize, most: usize| k.saturating_sub(half)..=(k + half).min(most - 1);
        match upright {
            true => around(x, all.width).any(|x| all[(x, y)]),
            false => around(y, all.height).any(|y| all[(x, y)]),
        }
    })
}
