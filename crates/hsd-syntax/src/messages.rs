//! Messages about the syntax of source files and about printing them.

pub mod legacy;
pub mod print;
pub mod town;
pub mod views;
