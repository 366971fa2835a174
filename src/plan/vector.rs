//! Plans as vectors: SVG, DXF and pages of PDF (`spec/plans.md`, section 1).
//!
//! | step | file | result |
//! |---|---|---|
//! | drawings of `hsd draw` come back as they went out | [`own`], `house`, `xml` | the text of the house |
//! | other drawings are read | [`svg`], `style`, [`dxf`], `pairs`, `entity`, [`pdf`] | [`lines::Lines`] |
//! | layers, blocks and colours say what strokes stand for | [`roles`] | [`roles::Means`] |
//! | walls say what the grid is | [`fit`] | [`fit::Grid`] |
//! | strokes are laid over the grid | `edges`, `leaves` | the units of the picture reader |
//! | drawings without layers become pictures | [`paint`] | a [`Picture`](super::Picture) |

pub mod dxf;
mod edges;
mod entity;
pub mod fit;
mod house;
mod leaves;
pub mod lines;
pub mod own;
pub mod paint;
mod pairs;
pub mod pdf;
pub mod roles;
mod style;
pub mod svg;
mod xml;

use super::Unreadable;
use super::shape::Shape;
use super::strokes::Units;
use edges::Covers;
use fit::Grid;
use lines::Lines;
use roles::{Means, Roles};
use std::collections::BTreeMap;

/// Layers, blocks and colours of CAD drawings that need no legend of their own.
pub const CAD: &str = include_str!("../../grammar/legend-cad.xml");

/// Millimetres in a shaku.
const SHAKU: f64 = 10_000.0 / 33.0;
/// The fewest cells of a house.
const LEAST_CELLS: usize = 4;

/// Why a drawing has no plan: what was looked for, and what was found.
#[derive(Clone, Debug, PartialEq)]
pub enum Refused {
    /// Not the XML of an SVG: at which byte, and why.
    NotXml { at: u64, what: String },
    /// No DXF: at which line, and why.
    NotDxf { line: usize, what: String },
    /// A DXF that ends too early, after so many lines.
    Truncated { line: usize },
    /// More of something than is read.
    TooLarge { what: &'static str, most: usize },
    /// No PDF that can be read, and why.
    NotPdf(String),
    /// A PDF without the page that was asked for.
    NoPage { asked: usize, pages: usize },
    /// A PDF with one picture that cannot be read.
    Picture(Unreadable),
    /// A legend that is none.
    Legend(String),
    /// Drawn by `hsd draw` and changed so that it cannot be read: what is not as it should be.
    Unclear(String),
    /// Nothing that is drawn.
    Blank,
    /// No stroke that stands for a wall; the layers and classes that were found.
    NoRoles(Vec<String>),
    /// Walls that keep to no grid: of so many strokes.
    NoGrid(usize),
    /// No walls that close.
    NoHouse,
}

/// What was found in a drawing.
#[derive(Clone, Debug)]
pub struct Found {
    /// What is drawn.
    pub lines: Lines,
    /// What the strokes stand for.
    pub means: Vec<Option<Means>>,
    /// The grid.
    pub grid: Grid,
    /// What stands on its units.
    pub units: Units,
    /// The house.
    pub shape: Shape,
}

impl Found {
    /// Shaku in a unit of the grid, if the drawing says how large the house is.
    pub fn shaku(&self) -> Option<f64> {
        let shaku = self.grid.unit_mm? / SHAKU;
        Some((shaku * 100.0).round() / 100.0)
    }

    /// Layers and groups of which nothing says what they stand for, with how many strokes are in them.
    pub fn unknown(&self) -> BTreeMap<&str, usize> {
        let mut unknown = BTreeMap::new();
        for (stroke, _) in self.lines.strokes.iter().zip(&self.means).filter(|(_, m)| m.is_none()) {
            let name = stroke.layers.first().map_or("", |l| self.lines.named(*l));
            *unknown.entry(name).or_default() += 1;
        }
        unknown
    }
}

/// Finds the house in the lines of a drawing; `unit_mm` are the millimetres of half a ken, if known.
///
/// # Errors
/// If there is none.
pub fn find(lines: Lines, roles: &Roles, unit_mm: Option<f64>) -> Result<Found, Refused> {
    if lines.strokes.is_empty() {
        return Err(Refused::Blank);
    }
    let means = roles.of(&lines);
    let walls = means.iter().filter(|m| **m == Some(Means::Wall)).count();
    if walls == 0 {
        return Err(Refused::NoRoles(lines.names().to_vec()));
    }
    let grid = fit::find(&lines, &means, unit_mm).ok_or(Refused::NoGrid(walls))?;
    let covers = Covers::of(&lines.strokes, &means, &grid).ok_or(Refused::NoGrid(walls))?;
    let units = covers.units();
    let shape = Shape::drawn(&units);
    if shape.cells.len() < LEAST_CELLS {
        return Err(Refused::NoHouse);
    }
    Ok(Found { lines, means, grid, units, shape })
}
