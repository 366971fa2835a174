//! Input and output: files, standard streams, the terminal, and descriptions of I/O errors.

pub(crate) mod diff;
pub(crate) mod input;
pub(crate) mod messages;
pub(crate) mod output;
pub(crate) mod reason;
pub(crate) mod temporary;
pub(crate) mod terminal;
