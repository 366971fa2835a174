//! Roofs.
pub mod plan;
