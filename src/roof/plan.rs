//! The plan of a storey as its roofs see it: levels, outlines, the street, and the regions with their roles.

pub(in crate::roof) mod level;
pub mod outline;
pub(in crate::roof) mod report;
pub mod roles;
pub(in crate::roof) mod sides;
pub mod street;
pub(in crate::roof) mod tops;

/// The most corners, under the open sky or of slanting rings, that a storey may have and still get sloped roofs; one
/// with more gets a single flat roof, since sloped roofs over so many parts are slow and rarely meant.
pub(in crate::roof) const MOST_CORNERS: usize = 1000;
