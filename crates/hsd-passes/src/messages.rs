//! Messages about the plan of a house and its fittings.

pub mod fittings;
pub mod meanings;
pub mod outline;
pub mod pictures;
pub mod plan;
