//! A compiler for houses.

pub mod ast;
pub mod building;
pub mod catalog;
pub mod check;
pub mod diagnostic;
pub mod geometry;
pub mod program;
pub mod roof;
pub mod scene;
pub mod source;
