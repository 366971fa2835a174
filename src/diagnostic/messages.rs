//! All wording, in one place, so that another language can follow. One `#[cold]` function a message;
//! a file a stage, as the codes have it.

pub mod file;
pub mod legacy;
pub mod parts;
pub mod pictures;
pub mod plan;
pub mod roofs;
pub mod xml;
