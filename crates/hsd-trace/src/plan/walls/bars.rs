//! Straight walls along and across a sheet, and the gaps between them.

use super::field::Field;
use super::mask::Strokes;
use crate::plan::raster::Parts;
use image::{GrayImage, Luma};

/// The least length of a wall, in its thickness.
const LEAST: f64 = 1.5;
/// The share of its box that a straight wall fills.
const SOLID: f64 = 0.7;
/// The share of a band that a wall fills where a gap ends.
const FILLED: f64 = 0.6;
/// The share of a gap along which something has to be drawn for it to be wider than a door.
const DRAWN: f64 = 0.75;
/// The longest doors without anything drawn in them, least and most, and the shortest doors, as shares of the plan's diagonal.
const DOOR_SHARES: [f64; 2] = [0.07, 0.14];
const LEAST_DOOR: f64 = 0.03;
/// The ratio of the widths of doors of one plan, and of the widest door to the usual ones.
const ALIKE: f64 = 1.2;
const WIDER: f64 = 1.15;

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
}

/// An opening between two walls of one line, or between a wall and one across it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// The opening, as if it were a wall.
    pub bar: Bar,
    /// The share of it along which something is drawn.
    pub drawn: f64,
}

impl Gap {
    /// Returns its length.
    pub fn length(&self) -> f64 {
        (self.bar.along[1] - self.bar.along[0] + 1) as f64
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
    let mut opened = GrayImage::new(walls.width as u32, walls.height as u32);
    for line in 0..lines {
        let mut start = 0;
        for k in 0..=length {
            if k < length && walls[place(line, k)] {
                continue;
            }
            if k - start >= least {
                for (x, y) in (start..k).map(|k| place(line, k)) {
                    opened.put_pixel(x as u32, y as u32, Luma([255]));
                }
            }
            start = k + 1;
        }
    }
    let parts = Parts::of(&opened, false);
    let mut boxes = vec![[usize::MAX, usize::MAX, 0, 0]; parts.count];
    let mut areas = vec![0_usize; parts.count];
    for (x, y, part) in parts.pixels() {
        let b = &mut boxes[part as usize - 1];
        let (x, y) = (x as usize, y as usize);
        areas[part as usize - 1] += 1;
        *b = [b[0].min(x), b[1].min(y), b[2].max(x), b[3].max(y)];
    }
    let bar = |b: [usize; 4]| match upright {
        true => Bar {
            upright,
            along: [b[1], b[3]],
            across: [b[0], b[2]],
        },
        false => Bar {
            upright,
            along: [b[0], b[2]],
            across: [b[1], b[3]],
        },
    };
    let all = boxes.into_iter().map(bar).zip(areas);
    let is_straight = |(b, area): &(Bar, usize)| {
        let length = (b.along[1] - b.along[0] + 1) as f64;
        let thickness = b.thickness() as f64;
        length > thickness && *area as f64 > SOLID * length * thickness
    };
    all.filter(is_straight).map(|(b, _)| b).collect()
}

/// Finds the gaps of a plan that are openings: from walls on to what is closed.
///
/// They are as long as a door, or as far as something is drawn.
pub fn gaps(
    (strokes, walls): (&Strokes, &Field<bool>),
    closed: &Field<bool>,
    door: f64,
) -> Vec<Gap> {
    let all = between((strokes, walls), closed).into_iter();
    all.filter(|gap| gap.length() <= door || gap.drawn >= DRAWN)
        .collect()
}

/// Returns the length of the longest opening in which nothing is drawn.
///
/// Doors of a plan are about equally wide, and the commonest gap is a door.
pub fn door(strokes: &Strokes, walls: &Field<bool>, diagonal: f64) -> f64 {
    let [least, most] = DOOR_SHARES.map(|share| share * diagonal);
    let widest = usual_opening(strokes, walls, diagonal);
    widest.map_or(least, |w| WIDER * w).clamp(least, most)
}

/// Returns the length of the widest of the openings of which there are most.
pub fn usual_opening(strokes: &Strokes, walls: &Field<bool>, diagonal: f64) -> Option<f64> {
    let most = DOOR_SHARES[1] * diagonal;
    let all = between((strokes, walls), walls);
    let mut lengths: Vec<f64> = all.iter().map(Gap::length).collect();
    lengths.retain(|l| *l >= LEAST_DOOR * diagonal && *l <= most);
    lengths.sort_by(f64::total_cmp);
    let within = |from: f64| {
        lengths
            .iter()
            .filter(move |l| **l >= from && **l <= ALIKE * from)
    };
    let commonest = lengths.iter().max_by_key(|from| within(**from).count());
    commonest
        .and_then(|from| within(*from).next_back())
        .copied()
}

/// Returns all gaps from the ends of walls to the next wall in their line.
fn between((strokes, walls): (&Strokes, &Field<bool>), closed: &Field<bool>) -> Vec<Gap> {
    let mut out = vec![];
    for upright in [false, true] {
        for bar in bars(walls, strokes.usual, upright) {
            let ends = [false, true].into_iter();
            out.extend(ends.filter_map(|forward| beyond(&bar, forward, (strokes, closed))));
        }
    }
    out
}

/// Returns what lies between the end of a wall and the next wall in its line.
fn beyond(bar: &Bar, forward: bool, (strokes, walls): (&Strokes, &Field<bool>)) -> Option<Gap> {
    let length = if bar.upright {
        walls.height
    } else {
        walls.width
    };
    let place = |k: usize, line: usize| if bar.upright { (line, k) } else { (k, line) };
    let quarter = bar.thickness() / 4;
    let band = bar.across[0] + quarter..=bar.across[1] - quarter;
    let lines = match bar.upright {
        true => walls.width,
        false => walls.height,
    };
    let wide = bar.across[0].saturating_sub(2)..=(bar.across[1] + 2).min(lines - 1);
    let filled = |k: usize| {
        let all = band.clone().count();
        let set = band.clone().filter(|line| walls[place(k, *line)]).count();
        set as f64 >= FILLED * all as f64
    };
    let inked = |k: usize| {
        let mut lines = wide.clone();
        lines.any(|line| strokes.thickness[place(k, line)] > 0.0)
    };
    let end = bar.along[usize::from(forward)];
    let steps = if forward { length - 1 - end } else { end };
    let at = |step: usize| if forward { end + step } else { end - step };
    let hit = (1..=steps).find(|step| filled(at(*step)))?;
    if hit < 2 {
        return None;
    }
    let drawn = (1..hit).filter(|step| inked(at(*step))).count();
    let (a, b) = (at(1), at(hit - 1));
    Some(Gap {
        bar: Bar {
            along: [a.min(b), a.max(b)],
            ..*bar
        },
        drawn: drawn as f64 / (hit - 1) as f64,
    })
}
