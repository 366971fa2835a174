//! The foundations of hsd: source files and spans, diagnostics, plane geometry, lettering, seeded random numbers.

pub mod budget;
pub mod diagnostic;
pub mod geometry;
pub mod lettering;
pub mod rng;
pub mod source;
