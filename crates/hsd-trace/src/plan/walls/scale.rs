//! The size of a plan, and its evidence.

use super::graph::Graph;
use super::writing::UNIT;
use super::{Divided, Reading, digits, dimensions, gaps, openings, sizes};
use crate::plan::sheet::Ink;
use glam::{DVec2, dvec2};
use std::cell::LazyCell;

/// The width of the opening of a door, metres.
const DOOR: f64 = 0.85;
/// The least mean area of the rooms of a house where doors show its size, square metres: with cupboards, small flats reach 1.4.
const LEAST_ROOM: f64 = 1.0;
/// The fewest doors, and the fewest openings of one width, that say how large a plan is.
const FEWEST: usize = 2;
const FEWEST_OPENINGS: usize = 3;
/// The least scale of openings where areas count mats, as a share of that of square metres.
const LARGER: f64 = 1.24;
/// A quarter of a ken, metres, and the least and greatest length at the scale by doors that is tried for it, as shares.
const QUARTER_KEN: f64 = UNIT / 2.0;
const NEAR: [f64; 2] = [0.8, 1.25];
/// The factor between two lengths that are tried.
const STEP: f64 = 1.002;
/// The fewest walls across both axes together, and the least agreement of their places with a grid.
const FEWEST_WALLS: usize = 8;
const AGREE: f64 = 0.85;

/// The diagonals of houses and the thicknesses of their walls, metres.
const HOUSES: std::ops::RangeInclusive<f64> = 4.0..=80.0;
const WALLS: std::ops::RangeInclusive<f64> = 0.04..=0.7;

/// The evidence for the size of a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Evidence {
    /// The author.
    Given,
    /// Printed dimensions, by their number.
    Printed(usize),
    /// Sizes printed in rooms, by their number.
    Rooms(usize),
    /// Numbers of mats printed in rooms, by their number.
    Mats(usize),
    /// Swinging doors, by their number, taken for usual ones.
    Doors(usize),
    /// The commonest opening, taken for a door.
    Openings,
    /// Walls at quarters of a ken, at a scale near to that by doors.
    HalfKen,
    /// A drawing as large as the house, in the only unit that makes its walls as thick as walls: the length of that unit, millimetres.
    Unit(f64),
}

impl Evidence {
    /// Returns the rank of the evidence, weakest first, and its count.
    fn rank(self) -> (u8, usize) {
        match self {
            Evidence::Openings => (0, 0),
            Evidence::Doors(count) => (1, count),
            Evidence::Mats(count) => (2, count),
            // Half ken is found from the scale by doors, or decides between areas and mats.
            Evidence::HalfKen => (3, 0),
            Evidence::Unit(_) => (4, 0),
            Evidence::Rooms(count) => (5, count),
            Evidence::Printed(count) => (6, count),
            Evidence::Given => (7, 0),
        }
    }
}

/// The size of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// Metres of a pixel.
    pub metres: f64,
    /// The evidence.
    pub evidence: Evidence,
}

impl Scale {
    /// Returns true if the author, the file or printed dimensions give it.
    pub fn is_sure(&self) -> bool {
        matches!(self.evidence, Evidence::Given | Evidence::Printed(_))
    }

    /// Returns the scale with the stronger evidence; `self` if they are equal.
    pub fn surer(self, other: Scale) -> Scale {
        match other.evidence.rank() > self.evidence.rank() {
            true => other,
            false => self,
        }
    }
}

/// Returns the size of the pixels of a plan: as it was given, or by what is drawn; `None` if nothing says it.
pub fn of(reading: &Reading, ink: &Ink, given: Option<f64>) -> Option<Scale> {
    let given = given.map(|metres| Scale {
        metres,
        evidence: Evidence::Given,
    });
    let about = by_doors(&reading.divided).or_else(|| by_openings(&reading.divided));
    let about = about.map(|scale| scale.metres);
    let diagonal = reading.divided.diagonal;
    let numbers = LazyCell::new(|| digits::numbers(ink, diagonal));
    let agreed = |numbers: &[digits::Number], units: &[f64], about: Option<f64>| {
        dimensions::metres(numbers, (units, about), (ink, &reading.graph))
    };
    let scale = |found: dimensions::Dimensions| Scale {
        metres: found.metres,
        evidence: Evidence::Printed(found.count),
    };
    let in_parts = LazyCell::new(|| {
        about?;
        let metric = agreed(&numbers.metric, &dimensions::METRIC, about);
        metric.or_else(|| agreed(&numbers.inches, &[dimensions::INCH], about))
    });
    let of_whole = || {
        let metric = agreed(&numbers.metric, &dimensions::METRIC, None);
        metric.filter(|found| found.is_whole)
    };
    let plain = || agreed(&numbers.plain, &dimensions::METRIC, None);
    let sizes = LazyCell::new(|| {
        let glyphs = digits::glyphs(&ink.dark, ink.threshold, diagonal);
        sizes::printed(&glyphs, &reading.divided, about)
    });
    let by_rooms = |found: Option<sizes::Agreed>| {
        let found = found?;
        Some(by_areas(&reading.graph, found, about).unwrap_or(Scale {
            metres: found.metres,
            evidence: Evidence::Rooms(found.count),
        }))
    };
    let by_doors = || {
        let divided = &reading.divided;
        let about = by_doors(divided).or_else(|| by_openings(divided))?;
        let scale = by_half_ken(&reading.graph, about.metres).unwrap_or(about);
        // Openings of tiny rooms are not doors.
        let room = reading.room() * scale.metres * scale.metres;
        (room >= LEAST_ROOM).then_some(scale)
    };
    given
        .or_else(|| of_whole().or_else(plain).map(scale))
        .or_else(|| by_rooms(sizes.sides))
        .or_else(|| in_parts.map(scale))
        .or_else(|| by_rooms(sizes.areas))
        .or_else(by_doors)
}

/// Returns another scale for areas that may count mats.
///
/// Walls at quarters of a ken decide if their scale is that of square metres or of mats. Otherwise areas count mats if the scale by
/// openings is much larger than that by square metres.
fn by_areas(graph: &Graph, found: sizes::Agreed, about: Option<f64>) -> Option<Scale> {
    let about = about.filter(|_| found.may_be_mats)?;
    let mats = found.metres * sizes::MAT.sqrt();
    let fits = |scale: &Scale| {
        let is_near = |metres: f64| (scale.metres / metres - 1.0).abs() <= sizes::AGREE_OF_MATS;
        is_near(found.metres) || is_near(mats)
    };
    // Doors are often narrower than assumed, which makes the scale by them too large.
    let by_mats = || {
        let is_mats = about > LARGER * found.metres;
        is_mats.then_some(Scale {
            metres: mats,
            evidence: Evidence::Mats(found.count),
        })
    };
    by_half_ken(graph, about).filter(fits).or_else(by_mats)
}

/// Returns the scale by the only unit of a drawing in which its plan is a house; `None` if there are several or none.
///
/// Each unit is its millimetres and the metres of a pixel.
pub fn by_unit(reading: &Reading, units: &[(f64, f64)]) -> Option<Scale> {
    let Divided {
        strokes, diagonal, ..
    } = &reading.divided;
    let mut fitting = units.iter().filter(|(_, metres)| {
        HOUSES.contains(&(metres * diagonal)) && WALLS.contains(&(metres * strokes.usual))
    });
    let (unit, metres) = *fitting.next()?;
    fitting.next().is_none().then_some(Scale {
        metres,
        evidence: Evidence::Unit(unit),
    })
}

/// Returns the scale by the commonest opening, taken for a door.
fn by_openings(divided: &Divided) -> Option<Scale> {
    let (usual, count) =
        gaps::usual_opening(&divided.strokes, &divided.strokes.walls(), divided.diagonal)?;
    (count >= FEWEST_OPENINGS).then_some(Scale {
        metres: DOOR / usual,
        evidence: Evidence::Openings,
    })
}

/// Returns the scale near to that by doors at which walls stand at quarters of a ken, if there is one.
fn by_half_ken(graph: &Graph, about: f64) -> Option<Scale> {
    let walls = [0, 1].map(|axis| walls(graph, axis));
    if walls.iter().map(Vec::len).sum::<usize>() < FEWEST_WALLS {
        return None;
    }
    let all = walls.iter().flatten().map(|wall| wall.1).sum::<f64>();
    let agreement = |quarter: f64| {
        let axis = |walls: &Vec<(f64, f64)>| {
            let turn = |(at, length): &(f64, f64)| {
                let angle = std::f64::consts::TAU * at / quarter;
                *length * dvec2(libm::cos(angle), libm::sin(angle))
            };
            walls.iter().map(turn).sum::<DVec2>().length()
        };
        walls.iter().map(axis).sum::<f64>() / all
    };
    let steps = (libm::log(NEAR[1] / NEAR[0]) / libm::log(STEP)) as i32;
    let tried = (0..=steps).map(|k| NEAR[0] * libm::pow(STEP, f64::from(k)) * QUARTER_KEN / about);
    let tried = tried.map(|quarter| (agreement(quarter), quarter));
    let (agrees, quarter) = tried.max_by(|a, b| a.0.total_cmp(&b.0))?;
    (agrees >= AGREE).then_some(Scale {
        metres: QUARTER_KEN / quarter,
        evidence: Evidence::HalfKen,
    })
}

/// Returns the places of the walls across an axis, each with the length of all walls there.
fn walls(graph: &Graph, axis: usize) -> Vec<(f64, f64)> {
    let mut out: Vec<(f64, f64)> = vec![];
    let ends = graph
        .lines
        .iter()
        .map(|line| line.ends.map(|k| graph.corners[k]));
    for [a, b] in ends.filter(|[a, b]| (a[axis] - b[axis]).abs() < 1e-6) {
        match out.iter_mut().find(|wall| (wall.0 - a[axis]).abs() < 1.0) {
            Some(wall) => wall.1 += a.distance(b),
            None => out.push((a[axis], a.distance(b))),
        }
    }
    out
}

/// Returns the scale by swinging doors.
fn by_doors(divided: &Divided) -> Option<Scale> {
    let mut widths = openings::swinging(divided);
    widths.sort_by(f64::total_cmp);
    let middle = *widths.get(widths.len() / 2)?;
    (widths.len() >= FEWEST).then_some(Scale {
        metres: DOOR / middle,
        evidence: Evidence::Doors(widths.len()),
    })
}
