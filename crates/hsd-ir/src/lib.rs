//! The trees between the passes of hsd: data, small accessors, invariants in the headers. No pass is in here.
//!
//! A house is an [`ast::House`](ast) as written, a [`program::House`] of steps, and a [`building::House`] of placed
//! walls. The [`catalog`] describes parts, [`material`] their surfaces.

pub mod ast;
pub mod building;
pub mod catalog;
pub mod check;
pub mod material;
pub mod messages;
pub mod program;
