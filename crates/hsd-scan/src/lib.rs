//! Scans of plans: flattens the sheet on an image, parts ink from paper, and finds the grid of half ken. `hsd-trace` makes a
//! house of it; `hsd-front` reads photographs of facades.
//!
//! | step | module | result |
//! |---|---|---|
//! | bytes of an image are decoded and turned upright | [`picture`] | [`picture::Picture`] |
//! | perspective and skew are taken away | [`flatten`] | [`flatten::Flat`] |
//! | ink is parted from paper | [`sheet`] | [`sheet::Ink`] |
//! | the grid of half ken is found | [`grid`] | [`grid::Grid`] |
//! | strokes on each unit are compared with a legend | [`strokes`], [`legend`] | [`strokes::Units`] |
//! | outline and rooms follow | [`shape`] | [`shape::Shape`] |
//!
//! Lengths are pixels of the sheet or units of the grid (half a ken); places run to the right and down.

pub mod flatten;
pub mod grid;
pub mod legend;
pub mod picture;
pub mod raster;
pub mod shape;
pub mod sheet;
pub mod strokes;
