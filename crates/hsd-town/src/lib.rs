//! Towns: from layers of maps to houses (docs/contract.md 10).
//!
//! | step | file |
//! |---|---|
//! | maps and tables are read into one frame | `layer`, `table` |
//! | areas are divided into blocks, streets and plots, if asked for | `layer/divide` |
//! | streets and outlines are indexed | `plan`, `street`, `grid` |
//! | a feature knows its fields, measures and neighbours | `site`, `neighbour` |
//! | its front is found, by the rule of the contract or the published one | `frontage`, `site/published` |
//! | a house is put on it: a rectangle, or its walls | `plot` |
//! | houses are put behind it | `rear` |
//! | the rules of the town file make the houses | `run` |
//! | a house is written as a text, if asked for | `text` |
//! | every decision is recorded | `decision`, `stream` |
//! | or nothing is kept of the houses but what was found, and what an editor asks for | `check`, `layer/kept` |
//!
//! Frame: metres east and north of the town's origin, z up. Rings run counter-clockwise.

pub mod tiles;
pub mod survey;
mod check;
pub mod decision;
pub mod frontage;
pub mod layer;
pub mod neighbour;
pub mod plan;
pub mod plot;
pub mod rear;
pub mod run;
pub mod shape;
pub mod site;
pub mod stream;
pub mod street;
pub mod table;
mod text;

pub use check::{CheckDepth, FieldFacts, LayerFacts, TownFacts, adopt, check};
pub use decision::TownReport;
pub use layer::KeptMaps;
pub use plan::Plan;
pub use run::{TownHouses, TownInput};
