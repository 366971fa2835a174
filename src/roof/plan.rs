//! The plan of a storey for its roofs: levels, outlines, the street, and the regions with their roles.

pub(in crate::roof) mod level;
pub(in crate::roof) mod necks;
pub mod outline;
pub(in crate::roof) mod report;
pub mod roles;
pub(in crate::roof) mod sides;
pub(in crate::roof) mod spans;
pub mod street;
pub(in crate::roof) mod tops;

/// Maximum number of corners, exposed to the sky or in slanting rings, for a storey to get sloped roofs. A storey with
/// more gets a single flat roof, since sloped roofs over that many parts are slow and rarely intended.
pub(in crate::roof) const MOST_CORNERS: usize = 1000;
