//! Sizes that are printed in rooms, such as `15 x 20` in feet, `4.94 x 4.63` in metres or `18 m2`.
//!
//! A size counts if its two numbers have the ratio of the sides of the room, or of the distances between the walls around it.
//! A scale counts if several rooms agree on it. So neither the unit nor the sign between the numbers has to be recognised.

use super::digits::{Glyph, inches, value};
use super::dimensions::{INCH, NEAR};
use super::field::Field;
use super::{Divided, Stuff};
use crate::plan::raster::Extent;
use std::collections::BTreeSet;

/// Metres of a foot.
const FOOT: f64 = 12.0 * INCH;
/// The widest space between digits of a number, across its decimal point, and between the signs of a size, in their height.
const SPACE: [f64; 3] = [0.45, 0.9, 1.6];
/// The greatest difference of the heights and feet of two signs, in their height.
const LEVEL: f64 = 0.2;
/// The greatest difference of the ratio of two numbers and that of two sides.
const RATIO: f64 = 0.08;
/// The greatest difference of the scales of rooms that agree.
const AGREE: f64 = 0.05;
/// The greatest difference of the scales of rooms with an area alone.
const AGREE_BY_AREA: f64 = 0.03;
/// Square metres of a mat in plans of dwellings for sale.
pub(super) const MAT: f64 = 1.62;
/// The greatest difference of the scales by mats and by square metres of one sheet: mats of other lengths are counted too.
pub(super) const AGREE_OF_MATS: f64 = 0.05;
/// The fewest sizes that agree: by two sides, by an area with a decimal point, by an area.
const FEWEST: [usize; 3] = [3, 3, 4];
/// The fewest sizes that agree by two sides if openings have a scale.
const FEWEST_NEAR: usize = 2;
/// The shortest and longest side of a room, metres.
const SIDES: [f64; 2] = [0.6, 25.0];
/// The most scales that are compared. A sheet with more numbers is a table.
const MOST_VOTES: usize = 1_000;
/// The least share of its box that a room with a size fills.
const FILLED: f64 = 0.85;

/// Signs side by side.
type Row<'g> = Vec<&'g Glyph>;

/// A scale by a printed size.
#[derive(Clone, Copy)]
struct Vote {
    /// Metres of a pixel.
    metres: f64,
    /// The number of the row of signs that is read as the size.
    row: u32,
    /// The area, or the product of both numbers: equal sizes count once.
    value: u64,
}

/// The scale that printed sizes of rooms agree on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Agreed {
    /// Metres of a pixel.
    pub(super) metres: f64,
    /// The number of sizes that agree.
    pub(super) count: usize,
    /// True if they may count mats instead of square metres.
    pub(super) may_be_mats: bool,
}

/// The scales by the sizes that are printed in rooms.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sizes {
    /// By both sides of rooms.
    pub(super) sides: Option<Agreed>,
    /// By their areas.
    pub(super) areas: Option<Agreed>,
}

/// Returns the scales by the sizes that are printed in rooms.
///
/// If openings have a scale, only scales near to it count, and two sizes are enough.
pub(super) fn printed(glyphs: &[Glyph], divided: &Divided, about: Option<f64>) -> Sizes {
    let rooms = rooms(divided);
    let (mut by_sides, mut by_decimal, mut by_area) = (vec![], vec![], vec![]);
    for (id, row) in (0..).zip(rows(glyphs)) {
        let Some(first) = row.first() else { continue };
        let at = (first.x[0], first.y[1]);
        let Some(room) = divided.faces.of.get(at.0 as isize, at.1 as isize) else {
            continue;
        };
        let Some(extent) = rooms.get(room as usize).filter(|_| room != 0) else {
            continue;
        };
        let [width, depth] = extent.size();
        if extent.area as f64 >= FILLED * (width * depth) as f64 {
            by_sides.extend(sides(&row, id, [width, depth].map(|s| s as f64)));
        }
        for clear in clear_sides(&row, &divided.stuff) {
            by_sides.extend(sides(&row, id, clear));
        }
        by_decimal.extend(areas(&row, id, (extent, true)));
        by_area.extend(areas(&row, id, (extent, false)));
    }
    if let Some(about) = about {
        for votes in [&mut by_sides, &mut by_decimal, &mut by_area] {
            votes.retain(|vote| NEAR.contains(&(vote.metres / about)));
        }
    }
    let fewest = about.map_or(FEWEST[0], |_| FEWEST_NEAR);
    Sizes {
        sides: agreed(&by_sides, (AGREE, fewest)),
        areas: by_areas(&by_decimal, FEWEST[1]).or_else(|| by_areas(&by_area, FEWEST[2])),
    }
}

/// Returns the scale by areas. Where square metres and mats are printed, square metres give the larger scale.
fn by_areas(votes: &[Vote], fewest: usize) -> Option<Agreed> {
    let found = agreed(votes, (AGREE_BY_AREA, fewest))?;
    let larger = found.metres * MAT.sqrt();
    let near = |vote: &&Vote| (vote.metres / larger - 1.0).abs() <= AGREE_OF_MATS;
    let others: Vec<Vote> = votes.iter().filter(near).copied().collect();
    agreed(&others, (AGREE_BY_AREA, FEWEST_NEAR)).or(Some(Agreed {
        may_be_mats: true,
        ..found
    }))
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
            // The sign between two numbers may be a low one.
            let height = row.iter().map(|g| g.height()).fold(0.0, f64::max);
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
    /// Reads signs as a number; `None` if a sign is not a digit, the first digit is 0 or a space is too wide.
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

    /// Returns the lengths that it may mean, metres. Each has a number for its unit: 0 feet, 1 metres, 2 millimetres.
    fn lengths(&self) -> Vec<(usize, f64)> {
        let whole = value(&self.whole);
        let in_feet = |feet: &[u32], rest: &[u32]| Some((0, inches(feet, rest)? * INCH));
        if !self.part.is_empty() {
            let feet = in_feet(&self.whole, &self.part).into_iter();
            return feet.chain([(1, self.decimal())]).collect();
        }
        let split = |at: usize| in_feet(&self.whole[..at], &self.whole[at..]);
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
    // Signs side by side are a pixel apart, and half a pixel belongs to their blurred edges.
    (b.x[0] as f64 - a.x[1] as f64 - 1.5) / a.height()
}

/// Returns the scales at which two numbers of a row are the sides of its room.
fn sides(row: &[&Glyph], id: u32, [width, depth]: [f64; 2]) -> Vec<Vote> {
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
                                row: id,
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

/// Returns the clear width and depth at a row of signs: between whatever divides rooms, and between walls.
///
/// The walls around a size may be right even if the room was not found as a whole.
fn clear_sides(row: &[&Glyph], stuff: &Field<Stuff>) -> Vec<[f64; 2]> {
    let (Some(first), Some(last)) = (row.first(), row.last()) else {
        return vec![];
    };
    let middle = [(first.x[0] + last.x[1]) / 2, (first.y[0] + first.y[1]) / 2];
    let step = first.y[1] - first.y[0] + 1;
    let clear = |axis: usize, is_end: fn(Stuff) -> bool| -> Option<f64> {
        let mut lengths: Vec<usize> = (-2..=2)
            .filter_map(|k: isize| {
                let mut at = middle.map(|m| m as isize);
                at[1 - axis] += k * step as isize;
                let reach = |way: isize| {
                    (1..).find_map(|far: isize| {
                        let mut p = at;
                        p[axis] += way * far;
                        match stuff.get(p[0], p[1]) {
                            None => Some(None),
                            Some(found) => is_end(found).then_some(Some(far as usize)),
                        }
                    })?
                };
                Some(reach(-1)? + reach(1)? - 1)
            })
            .collect();
        lengths.sort_unstable();
        lengths.get(lengths.len() / 2).map(|length| *length as f64)
    };
    let ends: [fn(Stuff) -> bool; 2] = [
        |stuff| stuff != Stuff::Free,
        |stuff| matches!(stuff, Stuff::Wall | Stuff::Tinted),
    ];
    ends.into_iter()
        .filter_map(|is_end| Some([clear(0, is_end)?, clear(1, is_end)?]))
        .collect()
}

/// Returns true if no further digit follows or precedes some signs of a row.
fn stands_alone(row: &[&Glyph], from: usize, to: usize) -> bool {
    let is_end = |a: usize, b: usize, outer: usize| {
        row[outer].value.is_none() || space(row[a], row[b]) > SPACE[1]
    };
    (from == 0 || is_end(from - 1, from, from - 1)) && (to == row.len() || is_end(to - 1, to, to))
}

/// Returns the scales at which a number of a row, with or without a decimal point, is the area of its room.
fn areas(row: &[&Glyph], id: u32, (extent, decimal): (&Extent, bool)) -> Vec<Vote> {
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
                    row: id,
                    value: square.to_bits(),
                });
            }
        }
    }
    out
}

/// Returns the scale on which most sizes agree.
fn agreed(votes: &[Vote], (most, fewest): (f64, usize)) -> Option<Agreed> {
    if votes.len() > MOST_VOTES {
        return None;
    }
    let near = |metres: f64| {
        votes
            .iter()
            .filter(move |vote| (vote.metres / metres - 1.0).abs() <= most)
    };
    let count = |metres: f64| {
        let rows: BTreeSet<u32> = near(metres).map(|vote| vote.row).collect();
        let values: BTreeSet<u64> = near(metres).map(|vote| vote.value).collect();
        rows.len().min(values.len())
    };
    let all = votes.iter().map(|vote| (count(vote.metres), vote.metres));
    let (found, metres) = all.max_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)))?;
    if found < fewest {
        return None;
    }
    let mut scales: Vec<f64> = near(metres).map(|vote| vote.metres).collect();
    scales.sort_by(f64::total_cmp);
    Some(Agreed {
        metres: scales[scales.len() / 2],
        count: found,
        may_be_mats: false,
    })
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
            votes.extend(sides(&signs, k as u32, extent.size().map(|s| s as f64)));
            votes.extend(areas(&signs, k as u32, (extent, true)));
        }
        agreed(&votes, (AGREE, fewest)).map(|found| found.metres)
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
    fn square_metres_count_where_mats_are_printed_too() {
        // 3 cm a pixel: 10.0, 8.1, 13.0 and 5.0 square metres.
        let rooms = [room(120, 93), room(100, 90), room(120, 120), room(80, 69)];
        let square = ["10.0", "8.1", "13.0", "5.0"];
        let mats = ["6.2", "5.0", "8.0", "3.1"];
        let votes = |texts: &[&str], first: u32| -> Vec<Vote> {
            let rows = (first..).zip(texts.iter().zip(&rooms));
            rows.flat_map(|(id, (text, extent))| {
                let glyphs = row(text);
                areas(&glyphs.iter().collect::<Vec<_>>(), id, (extent, true))
            })
            .collect()
        };
        let both = [votes(&square, 0), votes(&mats, 4)].concat();
        for all in [&both, &votes(&square, 0)] {
            let found = by_areas(all, 3).expect("the rooms agree");
            assert!((found.metres / 0.03 - 1.0).abs() < 0.03, "{found:?}");
        }
        let found = by_areas(&votes(&mats, 0), 3).expect("the rooms agree");
        let metres = found.metres * MAT.sqrt();
        assert!(
            found.may_be_mats && (metres / 0.03 - 1.0).abs() < 0.03,
            "{found:?}"
        );
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
