//! Sizes that are printed in rooms, such as `15 x 20` in feet, `4.94 x 4.63` in metres or `18 m2`.
//!
//! A size counts if its two numbers have the ratio of the sides of the room, and a scale if several rooms agree on it. So neither
//! the unit nor the sign between the numbers has to be recognised.

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
/// The most scales that are compared. A sheet with more numbers is a table.
const MOST_VOTES: usize = 1_000;
/// The least share of its box that a room with a size fills.
const FILLED: f64 = 0.85;

/// Signs side by side.
type Row<'g> = Vec<&'g Glyph>;

/// A scale that a room has by its size.
#[derive(Clone, Copy)]
struct Vote {
    /// Metres of a pixel.
    metres: f64,
    room: u32,
    /// The area, or the product of both numbers: equal sizes count once.
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

/// A number: its digits before and after the widest space, where a decimal point or the mark of feet may be.
struct Number {
    whole: Vec<u32>,
    part: Vec<u32>,
}

impl Number {
    /// Reads signs as a number; `None` if one is not a digit, the first is 0 or they stand apart.
    fn read(glyphs: &[&Glyph]) -> Option<Number> {
        let mut number = Number {
            whole: vec![],
            part: vec![],
        };
        let mut is_part = false;
        for (k, glyph) in glyphs.iter().enumerate() {
            let space = k
                .checked_sub(1)
                .map_or(0.0, |last| space(glyphs[last], glyph));
            if space > SPACE[0] {
                if is_part || space > SPACE[1] {
                    return None;
                }
                is_part = true;
            }
            let digits = if is_part {
                &mut number.part
            } else {
                &mut number.whole
            };
            digits.push(glyph.value?);
        }
        number
            .whole
            .first()
            .is_some_and(|first| *first != 0)
            .then_some(number)
    }

    /// Returns the value with a decimal point in the space.
    fn decimal(&self) -> f64 {
        value(&self.whole) + value(&self.part) / 10_f64.powi(self.part.len() as i32)
    }

    /// Returns the lengths that it may stand for, metres, each with the number of its unit.
    fn lengths(&self) -> Vec<(usize, f64)> {
        let whole = value(&self.whole);
        let inches = |feet: &[u32], inches: &[u32]| {
            let is_inches = value(inches) < 12.0 && (inches.len() == 1 || inches[0] != 0);
            is_inches.then(|| (0, value(feet) * FOOT + value(inches) * INCH))
        };
        if !self.part.is_empty() {
            let feet = inches(&self.whole, &self.part).into_iter();
            return feet.chain([(1, self.decimal())]).collect();
        }
        let split = |at: usize| inches(&self.whole[..at], &self.whole[at..]);
        match self.whole.len() {
            1 | 2 => vec![(0, whole * FOOT)],
            3 => {
                let feet = [1, 2].into_iter().filter_map(split);
                feet.chain([(1, whole / 100.0)]).collect()
            }
            4 => split(2).into_iter().chain([(2, whole / 1000.0)]).collect(),
            _ => vec![],
        }
    }
}

/// Returns the space between two signs, in the height of the first.
fn space(a: &Glyph, b: &Glyph) -> f64 {
    // Signs side by side are a pixel apart.
    (b.x[0] as f64 - a.x[1] as f64 - 1.0) / a.height()
}

fn value(digits: &[u32]) -> f64 {
    digits
        .iter()
        .fold(0.0, |sum, digit| sum * 10.0 + f64::from(*digit))
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
                if !stands_alone(row, from, to) {
                    continue;
                }
                let both = [&row[from..between], &row[between + 1..to]].map(Number::read);
                let [Some(a), Some(b)] = both else { continue };
                for ((unit, a), (other, b)) in a
                    .lengths()
                    .into_iter()
                    .flat_map(|a| b.lengths().into_iter().map(move |b| (a, b)))
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

/// Returns true if no further digit follows or precedes some signs of a row.
fn stands_alone(row: &[&Glyph], from: usize, to: usize) -> bool {
    let is_end = |a: usize, b: usize, outer: usize| {
        row[outer].value.is_none() || space(row[a], row[b]) > SPACE[1]
    };
    (from == 0 || is_end(from - 1, from, from - 1)) && (to == row.len() || is_end(to - 1, to, to))
}

/// Returns the scales at which a number of a row, with or without a decimal point, is the area of its room.
fn areas(row: &[&Glyph], room: u32, (extent, decimal): (&Extent, bool)) -> Vec<Vote> {
    let mut out = vec![];
    for from in 0..row.len() {
        for to in from + 1..=(from + 4).min(row.len()) {
            if !stands_alone(row, from, to) {
                continue;
            }
            let number = Number::read(&row[from..to]);
            let Some(number) = number.filter(|number| number.part.is_empty() != decimal) else {
                continue;
            };
            let square = number.decimal();
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
    if votes.len() > MOST_VOTES {
        return None;
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The signs of a text 10 pixels high; a point leaves its space, and other letters have no value.
    fn row(text: &str) -> Vec<Glyph> {
        let mut x = 0;
        let mut out = vec![];
        for letter in text.chars() {
            match letter {
                '.' => x += 5,
                ' ' => x += 6,
                _ => {
                    out.push(Glyph {
                        x: [x, x + 5],
                        y: [0, 9],
                        value: letter.to_digit(10),
                    });
                    x += 8;
                }
            }
        }
        out
    }

    fn room(width: usize, depth: usize) -> Extent {
        Extent {
            x: [0, width - 1],
            y: [0, depth - 1],
            area: width * depth,
        }
    }

    /// The scale of rooms with a size each.
    fn scale(rooms: &[(&str, Extent)], fewest: usize) -> Option<f64> {
        let mut votes = vec![];
        for (k, (text, extent)) in rooms.iter().enumerate() {
            let glyphs = row(text);
            let signs: Vec<&Glyph> = glyphs.iter().collect();
            votes.extend(sides(&signs, k as u32 + 1, extent));
            votes.extend(areas(&signs, k as u32 + 1, (extent, true)));
        }
        agreed(&votes, (AGREE, fewest)).map(|found| found.0)
    }

    #[test]
    fn sides_and_areas_of_three_rooms_give_a_scale() {
        // 3 cm a pixel.
        let feet = [
            ("15 x 20", room(152, 203)),
            ("10 x 12", room(122, 102)),
            ("9.6 x 8", room(97, 81)),
        ];
        let metric = [
            ("4.94 x 4.63", room(165, 154)),
            ("3.60 x 2.10", room(120, 70)),
            ("1.80 x 2.70", room(60, 90)),
        ];
        let areas = [
            ("17.3 m", room(160, 120)),
            ("6.9 m", room(80, 96)),
            ("12.1 m", room(112, 120)),
        ];
        for rooms in [feet, metric, areas] {
            let found = scale(&rooms, 3).expect("the rooms agree");
            assert!((found / 0.03 - 1.0).abs() < 0.03, "{found}: {rooms:?}");
            assert_eq!(scale(&rooms[..2], 3), None);
        }
    }

    #[test]
    fn numbers_that_do_not_suit_their_rooms_give_none() {
        let rooms = [
            ("15 x 20", room(150, 150)),
            ("30 x 12", room(120, 100)),
            ("FL 250", room(100, 80)),
        ];
        assert_eq!(scale(&rooms, 3), None);
    }
}
