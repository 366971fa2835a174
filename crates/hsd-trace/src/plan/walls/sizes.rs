//! Sizes that are printed in rooms, such as `15 x 20` in feet, `4.94 x 4.63` in metres or `18 m2`.
//!
//! A size counts if its two numbers have the ratio of the sides of the room, and a scale if several rooms agree on it. So the
//! unit need not be read, nor what stands between the numbers.

use super::digits::Glyph;
use super::{Divided, Stuff};
use crate::plan::raster::Extent;
use std::collections::BTreeSet;

/// Metres of a foot and of an inch.
const FOOT: f64 = 0.3048;
const INCH: f64 = FOOT / 12.0;
/// The widest space between digits of a number, across its decimal point, and between the signs of a size, in their height.
const SPACE: [f64; 3] = [0.45, 0.9, 1.3];
/// The greatest difference of the heights and feet of two signs, in their height.
const LEVEL: f64 = 0.2;
/// The greatest difference of the ratio of two numbers and that of two sides.
const RATIO: f64 = 0.08;
/// The greatest difference of the scales of rooms that agree.
const AGREE: f64 = 0.05;
/// The greatest difference of the scales of rooms with an area alone.
const AGREE_BY_AREA: f64 = 0.03;
/// The fewest rooms that agree: by two sides, by an area with a decimal point, by an area.
const FEWEST: [usize; 3] = [3, 3, 4];
/// The shortest and longest side of a room, metres.
const SIDES: [f64; 2] = [0.6, 25.0];
/// The least share of its box that a room with a size fills.
const FILLED: f64 = 0.85;

/// A row of signs that stand side by side.
type Row<'g> = Vec<&'g Glyph>;

/// A scale that a room has by its size.
#[derive(Clone, Copy)]
struct Vote {
    /// Metres of a pixel.
    metres: f64,
    room: u32,
    /// The number as it is read, for sizes of several rooms that are the same.
    value: u64,
}

/// Returns metres of a pixel by the sizes printed in rooms, and how many rooms agree on it.
pub(super) fn metres(glyphs: &[Glyph], divided: &Divided) -> Option<(f64, usize)> {
    let rooms = rooms(divided);
    let (mut by_sides, mut by_decimal, mut by_area) = (vec![], vec![], vec![]);
    for row in rows(glyphs) {
        let Some(first) = row.first() else { continue };
        let at = (first.x[0], first.y[1]);
        let Some(room) = divided.faces.of.get(at.0 as isize, at.1 as isize) else {
            continue;
        };
        let Some(extent) = rooms.get(room as usize).filter(|_| room != 0) else {
            continue;
        };
        by_sides.extend(sides(&row, room, extent));
        by_decimal.extend(areas(&row, room, (extent, true)));
        by_area.extend(areas(&row, room, (extent, false)));
    }
    agreed(&by_sides, (AGREE, FEWEST[0]))
        .or_else(|| agreed(&by_decimal, (AGREE_BY_AREA, FEWEST[1])))
        .or_else(|| agreed(&by_area, (AGREE_BY_AREA, FEWEST[2])))
}

/// Returns the inner extent of each room.
fn rooms(divided: &Divided) -> Vec<Extent> {
    let mut extents = vec![Extent::default(); divided.faces.count + 1];
    for y in 0..divided.stuff.height {
        for x in 0..divided.stuff.width {
            if divided.stuff[(x, y)] == Stuff::Free {
                extents[divided.faces.of[(x, y)] as usize].add(x, y);
            }
        }
    }
    extents
}

/// Puts signs into rows.
fn rows(glyphs: &[Glyph]) -> Vec<Row<'_>> {
    let mut all: Vec<&Glyph> = glyphs.iter().collect();
    all.sort_by_key(|g| (g.x[0], g.y[0]));
    let mut used = vec![false; all.len()];
    let mut out = vec![];
    for first in 0..all.len() {
        if used[first] {
            continue;
        }
        let mut row = vec![all[first]];
        let mut from = first;
        loop {
            let last = all[from];
            let height = last.height();
            let reach = last.x[1] + (SPACE[2] * height) as usize + 1;
            let near = (from + 1..all.len()).take_while(|k| all[*k].x[0] <= reach);
            let slack = LEVEL * height + 1.0;
            let next = near.filter(|k| !used[*k]).find(|k| {
                let g = all[*k];
                g.x[0] > last.x[1]
                    && (g.y[1].abs_diff(last.y[1]) as f64) <= slack
                    && (g.height() - height).abs() <= slack
            });
            let Some(next) = next else { break };
            used[next] = true;
            row.push(all[next]);
            from = next;
        }
        out.push(row);
    }
    out
}

/// Returns the digits of a number, of which the first is not 0; `None` if a sign is not a digit or they stand apart.
fn digits(glyphs: &[&Glyph]) -> Option<Vec<u32>> {
    digits_after(glyphs).filter(|digits| digits.first().is_some_and(|first| *first != 0))
}

/// Returns the digits after a decimal point.
fn digits_after(glyphs: &[&Glyph]) -> Option<Vec<u32>> {
    let is_near = glyphs.windows(2).all(|pair| {
        let space = pair[1].x[0] as f64 - pair[0].x[1] as f64;
        space <= SPACE[0] * pair[0].height() + 1.0
    });
    let digits = glyphs.iter().map(|g| g.value).collect::<Option<Vec<u32>>>();
    digits.filter(|_| is_near)
}

fn value(digits: &[u32]) -> f64 {
    digits
        .iter()
        .fold(0.0, |sum, digit| sum * 10.0 + f64::from(*digit))
}

/// Returns the lengths that a number may stand for, each with the number of its unit, metres.
fn lengths(digits: &[u32]) -> Vec<(usize, f64)> {
    let inches = |at: usize| {
        let (feet, inches) = digits.split_at(at);
        let is_inches = value(inches) < 12.0 && (inches.len() == 1 || inches[0] != 0);
        is_inches.then(|| (0, value(feet) * FOOT + value(inches) * INCH))
    };
    match digits.len() {
        1 | 2 => vec![(0, value(digits) * FOOT)],
        3 => {
            let feet = [1, 2].into_iter().filter_map(inches);
            feet.chain([(1, value(digits) / 100.0)]).collect()
        }
        4 => inches(2)
            .into_iter()
            .chain([(2, value(digits) / 1000.0)])
            .collect(),
        _ => vec![],
    }
}

/// Returns the scales at which two numbers of a row are the sides of its room.
fn sides(row: &[&Glyph], room: u32, extent: &Extent) -> Vec<Vote> {
    let [width, depth] = extent.size().map(|s| s as f64);
    if (extent.area as f64) < FILLED * width * depth {
        return vec![];
    }
    let mut out = vec![];
    // A sign between two numbers may look like a digit.
    for between in 1..row.len().saturating_sub(1) {
        for from in between.saturating_sub(4)..between {
            for to in between + 2..=(between + 5).min(row.len()) {
                let is_apart = |a: usize, b: usize| {
                    let space = row[b].x[0] as f64 - row[a].x[1] as f64;
                    space > SPACE[0] * row[a].height()
                };
                let starts = from == 0 || is_apart(from - 1, from) || row[from - 1].value.is_none();
                let ends = to == row.len() || is_apart(to - 1, to) || row[to].value.is_none();
                let both = [&row[from..between], &row[between + 1..to]].map(digits);
                let [Some(a), Some(b)] = both else { continue };
                if !starts || !ends {
                    continue;
                }
                for ((unit, a), (other, b)) in lengths(&a)
                    .into_iter()
                    .flat_map(|a| lengths(&b).into_iter().map(move |b| (a, b)))
                {
                    let is_side = |length: f64| (SIDES[0]..=SIDES[1]).contains(&length);
                    if unit != other || !is_side(a) || !is_side(b) {
                        continue;
                    }
                    for [across, down] in [[a, b], [b, a]] {
                        let (s, t) = (across / width, down / depth);
                        if (s / t - 1.0).abs() <= RATIO {
                            out.push(Vote {
                                metres: (s * t).sqrt(),
                                room,
                                value: (a * b).to_bits(),
                            });
                        }
                    }
                }
            }
        }
    }
    out
}

/// Returns the scales at which a number of a row is the area of its room. A decimal point is too small to be seen, but for its space.
fn areas(row: &[&Glyph], room: u32, (extent, decimal): (&Extent, bool)) -> Vec<Vote> {
    let space = |at: usize| (row[at].x[0] - row[at - 1].x[1]) as f64 / row[at].height();
    let is_point = |at: usize| (SPACE[0]..=SPACE[1]).contains(&space(at));
    let mut out = vec![];
    for from in 0..row.len() {
        for to in from + 1..=(from + 4).min(row.len()) {
            let starts = from == 0 || row[from - 1].value.is_none() || space(from) > SPACE[1];
            let ends = to == row.len() || row[to].value.is_none() || space(to) > SPACE[1];
            if !starts || !ends {
                continue;
            }
            let point = (from + 1..to).find(|at| decimal && is_point(*at));
            if decimal && point.is_none() {
                continue;
            }
            let whole = digits(&row[from..point.unwrap_or(to)]);
            let part = point.map(|at| digits_after(&row[at..to]));
            let (Some(whole), Some(part)) = (whole, part.unwrap_or(Some(vec![]))) else {
                continue;
            };
            let square = value(&whole) + value(&part) / 10f64.powi(part.len() as i32);
            if (SIDES[0] * SIDES[0]..=SIDES[1] * SIDES[1]).contains(&square) {
                out.push(Vote {
                    metres: (square / extent.area as f64).sqrt(),
                    room,
                    value: square.to_bits(),
                });
            }
        }
    }
    out
}

/// Returns the scale on which most rooms agree, and their number.
fn agreed(votes: &[Vote], (most, fewest): (f64, usize)) -> Option<(f64, usize)> {
    let near = |metres: f64| {
        votes
            .iter()
            .filter(move |vote| (vote.metres / metres - 1.0).abs() <= most)
    };
    let count = |metres: f64| {
        let rooms: BTreeSet<u32> = near(metres).map(|vote| vote.room).collect();
        let values: BTreeSet<u64> = near(metres).map(|vote| vote.value).collect();
        rooms.len().min(values.len())
    };
    let all = votes.iter().map(|vote| (count(vote.metres), vote.metres));
    let (rooms, metres) = all.max_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)))?;
    if rooms < fewest {
        return None;
    }
    let mut scales: Vec<f64> = near(metres).map(|vote| vote.metres).collect();
    scales.sort_by(f64::total_cmp);
    Some((scales[scales.len() / 2], rooms))
}
