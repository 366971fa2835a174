//! A compiler for houses.

pub mod ast;
pub mod building;
pub mod catalog;
pub mod check;
pub mod diagnostic;
pub mod expand;
pub mod geometry;
pub mod lower;
pub mod material;
pub mod parse;
pub mod program;
pub mod roof;
pub mod scene;
pub mod source;
pub mod texture;
pub mod tessellate;
