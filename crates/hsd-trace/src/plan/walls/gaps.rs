//! Openings: gaps between walls in one line, or between a wall and one across it.

use super::bars::{Bar, bars};
use super::field::Field;
use super::mask::Strokes;
use super::swing::swings;
use std::collections::BTreeSet;

/// The share of a band that a wall fills where a gap ends.
const FILLED: f64 = 0.6;
/// The share of a gap along which something has to be drawn for it to be wider than a door.
const DRAWN: f64 = 0.75;
/// The share of a wall that is drawn; dashed lines have less.
const WHOLE: f64 = 0.85;
/// The longest doors without anything drawn in them, least and most, and the shortest doors, as shares of the plan's diagonal.
const DOOR_SHARES: [f64; 2] = [0.07, 0.14];
const LEAST_DOOR: f64 = 0.03;
/// The ratio of the widths of doors of one plan, and of the widest door to the usual ones.
const ALIKE: f64 = 1.2;
const WIDER: f64 = 1.15;

/// An opening between two walls of one line, or between a wall and one across it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// The opening, as if it were a wall.
    pub bar: Bar,
    /// The share of it along which something is drawn.
    pub drawn: f64,
    /// The kind of its ends.
    pub ends: Ends,
}

/// The ends of a gap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// A wall ends, and another begins in its line or runs across it.
    Walls,
    /// A wall meets one across it, and continues beyond the gap.
    Corner,
    /// A wall meets one across it, or is dashed, and the gap ends at a wall across.
    Corners,
}

impl Gap {
    /// Returns its length.
    pub fn length(&self) -> f64 {
        (self.bar.along[1] - self.bar.along[0] + 1) as f64
    }
}

/// Finds the openings of a plan: gaps from the ends of `walls` to `closed` walls.
///
/// They are as long as a door, or as far as something is drawn. Between two corners, where no wall continues in their line, only a
/// swinging door shows an opening.
pub fn gaps(
    (strokes, walls): (&Strokes, &Field<bool>),
    closed: &Field<bool>,
    (door, diagonal): (&Door, f64),
) -> Vec<Gap> {
    let is_opening = |gap: &Gap| match gap.ends {
        Ends::Walls => gap.length() <= door.widest || gap.drawn >= DRAWN,
        Ends::Corner => gap.length() <= door.usual || gap.drawn >= DRAWN,
        Ends::Corners => gap.length() <= door.widest && swings(strokes, &gap.bar, diagonal),
    };
    let all = between((strokes, walls), closed).into_iter();
    all.filter_map(|gaps| gaps.into_iter().flatten().find(is_opening))
        .collect()
}

/// The lengths of the longest openings in which nothing is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Door {
    /// By the commonest opening.
    pub usual: f64,
    /// That length, limited to widths that doors have.
    pub widest: f64,
}

/// Returns the greatest lengths of openings in which nothing is drawn.
///
/// Doors of a plan are about equally wide, and the commonest gap is a door.
pub fn door(strokes: &Strokes, walls: &Field<bool>, diagonal: f64) -> Door {
    let [least, most] = DOOR_SHARES.map(|share| share * diagonal);
    let usual = usual_opening(strokes, walls, diagonal);
    let usual = usual.map_or(least, |(width, _)| WIDER * width);
    Door {
        usual,
        widest: usual.clamp(least, most),
    }
}

/// Returns the widest of the commonest openings, pixels, and their number.
pub fn usual_opening(
    strokes: &Strokes,
    walls: &Field<bool>,
    diagonal: f64,
) -> Option<(f64, usize)> {
    let most = DOOR_SHARES[1] * diagonal;
    let all = between((strokes, walls), walls).into_iter();
    let mut all: Vec<Gap> = all.filter_map(|gaps| gaps[0]).collect();
    all.retain(|gap| gap.length() >= LEAST_DOOR * diagonal && gap.length() <= most);
    all.sort_by(|a, b| a.length().total_cmp(&b.length()));
    let within = |from: f64| {
        let range = from..=ALIKE * from;
        all.iter().filter(move |gap| range.contains(&gap.length()))
    };
    // An opening in a wall is found from both sides, and counts twice.
    let commonest = all.iter().max_by_key(|gap| within(gap.length()).count())?;
    let alike = || within(commonest.length());
    let place = |gap: &Gap| (gap.bar.upright, gap.bar.along);
    let count = alike().map(place).collect::<BTreeSet<_>>().len();
    Some((alike().next_back()?.length(), count))
}

/// Returns two gaps from each end of a wall: to the next wall in its line, and to a nearer one that begins beside it.
fn between(
    (strokes, walls): (&Strokes, &Field<bool>),
    closed: &Field<bool>,
) -> Vec<[Option<Gap>; 2]> {
    let mut out = vec![];
    for upright in [false, true] {
        for bar in bars(walls, strokes.usual, upright) {
            out.extend([false, true].map(|forward| beyond(&bar, forward, (strokes, closed))));
        }
    }
    out
}

/// The line of a wall, extended over the sheet.
struct Across<'a> {
    walls: &'a Field<bool>,
    bar: &'a Bar,
    /// Pixels of the sheet along the line and across it.
    size: [usize; 2],
}

impl<'a> Across<'a> {
    fn of(walls: &'a Field<bool>, bar: &'a Bar) -> Across<'a> {
        let (length, lines) = match bar.upright {
            true => (walls.height, walls.width),
            false => (walls.width, walls.height),
        };
        let size = [length, lines];
        Across { walls, bar, size }
    }

    fn is_wall(&self, k: usize, line: usize) -> bool {
        let inside = k < self.size[0] && line < self.size[1];
        inside
            && self.walls[if self.bar.upright {
                (line, k)
            } else {
                (k, line)
            }]
    }

    /// Returns true if walls fill most of the line's thickness at a place.
    fn is_filled(&self, k: usize) -> bool {
        let quarter = self.bar.thickness() / 4;
        let band = self.bar.across[0] + quarter..=self.bar.across[1] - quarter;
        let all = band.clone().count();
        let set = band.filter(|line| self.is_wall(k, *line)).count();
        set as f64 >= FILLED * all as f64
    }

    /// Returns true if a wall across the line begins at a place, or nearly reaches it, on either side.
    fn begins(&self, k: usize) -> bool {
        let thick = self.bar.thickness().max(2);
        let reach = thick + 1;
        let [first, last] = self.bar.across;
        let runs = |line: &dyn Fn(usize) -> Option<usize>| {
            let at = |d: usize, k: usize| line(d).is_some_and(|line| self.is_wall(k, line));
            let Some(from) = (1..=reach).find(|d| at(*d, k)) else {
                return false;
            };
            // Dashes are walls too.
            let on = (from..from + 3 * thick).filter(|d| at(*d, k)).count();
            let on = on as f64 >= FILLED * (3 * thick) as f64;
            // A wall that runs along the line is wide here too.
            let far = from + 2 * thick;
            let wide = |k: usize| at(far, k);
            on && !(wide(k.wrapping_sub(3 * thick)) || wide(k + 3 * thick))
        };
        runs(&|d| first.checked_sub(d)) || runs(&|d| Some(last + d))
    }
}

/// Returns the two gaps beyond an end of a wall, as in `between`.
fn beyond(
    bar: &Bar,
    forward: bool,
    (strokes, walls): (&Strokes, &Field<bool>),
) -> [Option<Gap>; 2] {
    let line = Across::of(walls, bar);
    let place = |k: usize, line: usize| if bar.upright { (line, k) } else { (k, line) };
    // Sliding screens run in two grooves, side by side.
    let beside = bar.thickness().max(2);
    let [first, last] = bar.across;
    let wide = first.saturating_sub(beside)..=(last + beside).min(line.size[1] - 1);
    let inked = |k: usize| {
        let mut lines = wide.clone();
        lines.any(|line| strokes.thickness[place(k, line)] > 0.0)
    };
    let end = bar.along[usize::from(forward)];
    let steps = if forward { line.size[0] - 1 - end } else { end };
    let at = |step: usize| if forward { end + step } else { end - step };
    let thick = bar.thickness();
    let corner = |step: usize| line.begins(if forward { end - step } else { end + step });
    let starts_at_corner = (0..thick.min(bar.along[1] - bar.along[0])).any(corner);
    // Dashes show something above or below, which has no openings.
    let middle = (first + last) / 2;
    let along = bar.along[0]..=bar.along[1];
    let full = along.filter(|k| f64::from(strokes.thickness[place(*k, middle)]) >= strokes.wall);
    let is_dashed = (full.count() as f64) < WHOLE * (bar.along[1] - bar.along[0] + 1) as f64;
    let gap = |hit: usize| {
        let drawn = (1..hit).filter(|step| inked(at(*step))).count();
        let (a, b) = (at(1), at(hit - 1));
        let mut beyond = hit..=(hit + 2 * thick + 1).min(steps);
        let goes_on = beyond.all(|step| line.is_filled(at(step)));
        Gap {
            bar: Bar {
                along: [a.min(b), a.max(b)],
                ..*bar
            },
            drawn: drawn as f64 / (hit - 1) as f64,
            ends: match (starts_at_corner, goes_on) {
                (true, true) => Ends::Corner,
                (true, false) => Ends::Corners,
                (false, false) if is_dashed && hit > 3 * thick => Ends::Corners,
                (false, _) => Ends::Walls,
            },
        }
    };
    let Some(hit) = (1..=steps).find(|step| line.is_filled(at(*step))) else {
        let begins = (2 * thick + 1..=steps).find(|step| line.begins(at(*step)));
        return [None, begins.map(gap)];
    };
    let begins = (2 * thick + 1..hit).find(|step| line.begins(at(*step)));
    [(hit > 1).then(|| gap(hit)), begins.map(gap)]
}
