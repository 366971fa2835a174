//! The plan of a storey for its roofs: levels, outlines, the street, and the regions with their roles.

pub(crate) mod level;
pub(crate) mod necks;
pub mod outline;
pub(crate) mod report;
pub mod roles;
pub(crate) mod sides;
pub(crate) mod spans;
pub mod street;
pub(crate) mod tops;

/// Maximum number of corners, exposed to the sky or in slanting rings, for a storey to get sloped roofs. A storey with
/// more gets a single flat roof, since sloped roofs over that many parts are slow and rarely intended.
pub(crate) const MOST_CORNERS: usize = 1000;
