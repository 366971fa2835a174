//! The plan of a storey as its roofs see it: levels, sides, streets, and the regions with their ridges.

pub mod outline;
pub mod ridge;
pub mod street;
pub(in crate::roof) mod level;
pub(in crate::roof) mod report;
pub(in crate::roof) mod sides;
pub(in crate::roof) mod tops;
