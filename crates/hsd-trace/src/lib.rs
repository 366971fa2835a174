//! House files out of drawn floor plans: [`plan`] reads images and drawings in lines.

pub mod messages;
pub mod plan;
