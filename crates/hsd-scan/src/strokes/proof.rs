//! What tells a symbol from others that look much like it: leaves that change sides, ticks, lines between lines. Each of them
//! has a counterpart that puts the same ink where none should be; the ink of a sheet must prefer the symbol.

use super::super::legend::{Mark, Pen, Symbol};
use super::patch::Patch;
use super::tones::ALONG;

/// Ink that counts as noise on a unit, full samples.
pub(super) const NOISE: f64 = 3.0;

/// The difference between a symbol and its counterpart. Both halves of the symbol have to show it: a line of something else
/// beside a wall may look like one leaf.
#[derive(Clone)]
pub(super) struct Proof {
    /// By units and halves of the symbol.
    differences: Vec<[Difference; 2]>,
    /// What perfect ink would come to, for each half.
    pub(super) whole: [f64; 2],
}

impl Proof {
    /// Of the ink that should be there and that which should not; both count alike.
    pub(super) fn of(symbol: &[Vec<i16>], counter: &[Vec<i16>]) -> Proof {
        let sum = |ink: &[Vec<i16>]| ink.iter().flatten().map(|d| f64::from(*d)).sum::<f64>();
        let scale = sum(symbol) / sum(counter).max(1.0);
        let middle = symbol.len() * ALONG / 2;
        let mut whole = [0.0; 2];
        let mut differences = Vec::new();
        for (unit, (mine, other)) in symbol.iter().zip(counter).enumerate() {
            let half = |is_second: bool| -> Vec<i16> {
                let is_mine = |k: usize| (unit * ALONG + k % ALONG >= middle) == is_second;
                let at = |k: usize| match is_mine(k) {
                    true => mine[k] - (f64::from(other[k]) * scale).round() as i16,
                    false => 0,
                };
                (0..mine.len()).map(at).collect()
            };
            let halves = [half(false), half(true)];
            // What the symbol itself shows.
            (0..2).for_each(|k| whole[k] += product(&halves[k], mine).max(0.0));
            differences.push(halves.map(|half| Difference::of(&half)));
        }
        Proof { differences, whole }
    }

    /// How much of it the ink of a unit shows, for each half, so many samples to the side (-1, 0 or 1).
    pub(super) fn shown(&self, unit: usize, patch: &Patch, shift: i32) -> [f32; 2] {
        [0, 1].map(|half| self.differences[unit][half].shown(&patch.ink, shift) as f32)
    }
}

/// The ink that should be there less that of the counterpart, by place, without the rows in which both are equal.
#[derive(Clone)]
struct Difference {
    /// The first place.
    from: usize,
    by_place: Vec<i16>,
}

impl Difference {
    fn of(all: &[i16]) -> Difference {
        let is_some = |row: &[i16]| row.iter().any(|d| *d != 0);
        let first = all.chunks_exact(ALONG).position(is_some).unwrap_or(0);
        let last = all.chunks_exact(ALONG).rposition(is_some);
        let rows = first..last.map_or(first, |last| last + 1);
        Difference {
            from: rows.start * ALONG,
            by_place: all[rows.start * ALONG..rows.end * ALONG].to_vec(),
        }
    }

    /// The sum of products with ink a number of rows back.
    fn shown(&self, ink: &[i16], back: i32) -> f64 {
        let (mut mine, mut from) = (&self.by_place[..], self.from as isize);
        from -= back as isize * ALONG as isize;
        if from < 0 {
            mine = &mine[mine.len().min(ALONG)..];
            from += ALONG as isize;
        }
        let theirs = &ink[(from as usize).min(ink.len())..];
        product(mine, theirs)
    }
}

/// The sum of products, in full samples.
fn product(a: &[i16], b: &[i16]) -> f64 {
    let sum: i32 = a
        .iter()
        .zip(b)
        .map(|(a, b)| i32::from(*a) * i32::from(*b))
        .sum();
    f64::from(sum) / (255.0 * 255.0)
}

/// What tells a symbol from others, as two symbols: one with what should be there, one with the same where spaces and gaps
/// should be.
pub(super) fn opposites(symbol: &Symbol) -> Option<[Symbol; 2]> {
    let with = |marks: Vec<(Mark, Pen)>| Symbol {
        marks,
        ..symbol.clone()
    };
    let ticks = || {
        symbol
            .marks
            .iter()
            .filter(|(m, _)| matches!(m, Mark::Ticks { .. }))
    };
    if ticks().next().is_some() {
        let own = ticks().copied().collect();
        let other = ticks().map(|(m, p)| (shifted(*m), *p)).collect();
        return Some([with(own), with(other)]);
    }
    let (inner, gaps) = lines_and_gaps(symbol)?;
    Some([with(inner), with(gaps)])
}

fn shifted(mark: Mark) -> Mark {
    match mark {
        Mark::Ticks {
            at,
            count,
            width,
            between_posts: true,
        } => Mark::Ticks {
            at,
            count: count + 1,
            width,
            between_posts: false,
        },
        Mark::Ticks {
            at, count, width, ..
        } if count > 1 => Mark::Ticks {
            at,
            count: count - 1,
            width,
            between_posts: true,
        },
        other => other,
    }
}

type Marks = Vec<(Mark, Pen)>;

/// The inner ones of three or more lines, and a line in each gap between lines.
fn lines_and_gaps(symbol: &Symbol) -> Option<(Marks, Marks)> {
    let place = |mark: &Mark| match *mark {
        Mark::Line { at, from, to, .. } if from <= 0.0 && to >= 1.0 => Some(at),
        _ => None,
    };
    let mut lines: Vec<(f64, (Mark, Pen))> = Vec::new();
    for mark in &symbol.marks {
        lines.push((place(&mark.0)?, *mark));
    }
    if lines.len() < 3 {
        return None;
    }
    lines.sort_by(|a, b| a.0.total_cmp(&b.0));
    let inner = lines[1..lines.len() - 1].iter().map(|(_, m)| *m).collect();
    let gaps = lines.windows(2).map(|pair| {
        let line = Mark::Line {
            at: (pair[0].0 + pair[1].0) / 2.0,
            from: 0.0,
            to: 1.0,
            width: 1.0,
        };
        (line, pair[0].1.1)
    });
    Some((inner, gaps.collect()))
}
