//! Plans as vectors: SVG, DXF and pages of PDF (docs/contract.md 11).
//!
//! | step | file | result |
//! |---|---|---|
//! | drawings of `hsd draw` come back as they went out | [`own`], `told`, `xml` | the text of the house |
//! | other drawings are read | [`svg`], `style`, [`dxf`], `pairs`, `entity`, [`pdf`] | [`lines::Lines`] |
//! | layers, blocks and colours say what strokes stand for | [`roles`] | [`roles::Means`] |
//! | walls say what the grid is | [`fit`] | [`fit::Grid`] |
//! | strokes are laid over the grid | `edges`, `leaves` | the units of the picture reader |
//! | drawings without layers become pictures | [`paint`] | a [`Picture`](super::Picture) |

pub mod dxf;
mod edges;
mod entity;
pub mod fit;
pub(super) mod hollow;
mod leaves;
pub mod lines;
pub mod own;
pub mod paint;
mod pairs;
pub mod pdf;
mod refused;
pub mod roles;
mod style;
pub mod svg;
mod told;
mod xml;

use super::shape::Shape;
use super::strokes::Units;
pub use refused::Refused;

use edges::Covers;
use fit::Grid;
use lines::Lines;
use roles::{Means, Roles};
use std::collections::BTreeMap;

/// Layers, blocks and colours of CAD drawings that need no legend of their own.
pub use hsd_grammar::LEGEND_CAD as CAD;

/// Millimetres in a shaku.
const SHAKU: f64 = 10_000.0 / 33.0;
/// The fewest cells of a house.
const LEAST_CELLS: usize = 4;

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
        for (stroke, _) in self
            .lines
            .strokes
            .iter()
            .zip(&self.means)
            .filter(|(_, m)| m.is_none())
        {
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
    Ok(Found {
        lines,
        means,
        grid,
        units,
        shape,
    })
}
