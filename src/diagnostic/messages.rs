//! All wording, in one place and in both languages. One `#[cold]` function a message; a file a stage, as the codes
//! have it.

pub mod catalog;
pub mod file;
pub mod fittings;
pub mod legacy;
pub mod limits;
#[cfg(feature = "maps")]
pub mod maps;
pub mod outline;
pub mod parts;
pub mod pictures;
pub mod plan;
pub mod print;
pub mod roofs;
pub mod views;
pub mod town;
mod words;
pub mod xml;
