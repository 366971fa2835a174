//! Both forms of the house language: [`parse`] reads a source file, [`mod@print`] formats and converts one.

pub mod messages;
pub mod parse;
pub mod print;
pub mod templates;
