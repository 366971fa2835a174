//! A compiler for houses.

pub mod ast;
pub mod backend;
pub mod building;
pub mod catalog;
pub mod check;
pub mod cli;
pub mod diagnostic;
pub mod driver;
pub mod expand;
pub mod geometry;
pub mod lower;
pub mod material;
pub mod parse;
pub mod program;
pub mod report;
pub mod roof;
pub mod scene;
pub mod source;
pub mod tessellate;
pub mod texture;

pub use driver::{Compiled, compile, compile_bytes};
