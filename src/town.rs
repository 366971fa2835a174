//! Towns: from layers of maps to houses (docs/contract.md 10).
//!
//! | step | file |
//! |---|---|
//! | maps and tables are read into one frame | `layer`, `table` |
//! | streets and outlines are indexed | `plan`, `street`, `grid` |
//! | a feature knows its fields, measures and neighbours | `site`, `neighbour` |
//! | its front is found, by the rule of the contract or the published one | `frontage`, `published` |
//! | a house is put on it: a rectangle, or its walls | `plot`, `over` |
//! | the rules of the town file make the houses | `run` |
//! | every decision is recorded | `decision`, `stream` |
//!
//! Frame: metres east and north of the town's origin, z up. Rings run counter-clockwise.

pub mod decision;
pub mod frontage;
pub mod grid;
pub mod layer;
pub mod neighbour;
pub mod over;
pub mod plan;
pub mod plot;
pub mod published;
pub mod run;
pub mod shape;
pub mod site;
pub mod stream;
pub mod street;
pub mod table;

use crate::diagnostic::Diagnostics;
use crate::driver;

/// Checks a town file with its maps: evaluates its rules at every feature, and makes nothing. Returns the number of houses
/// that they ask for; `None` if the file is no town.
pub fn check(input: TownInput<'_>, out: &mut Diagnostics) -> Option<usize> {
    let mut known = Diagnostics::new();
    let read = driver::documents(&[input.source], input.world, input.options, &mut known);
    let town = read.documents.into_iter().find_map(|d| d.town)?;
    if known.has_errors() {
        return Some(0);
    }
    let plan = run::plan(input, &town, out)?;
    let mut houses = stream::TownStream::new(input, &plan);
    let count = houses.by_ref().count();
    houses.finish(out);
    Some(count)
}

pub use decision::TownReport;
pub use plan::Plan;
pub use run::{TownHouses, TownInput};
