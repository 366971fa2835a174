//! Input and output: files, standard streams, the terminal, and descriptions of I/O errors.

pub(in crate::cli) mod diff;
pub(in crate::cli) mod input;
pub(in crate::cli) mod messages;
pub(in crate::cli) mod output;
pub(in crate::cli) mod reason;
pub(in crate::cli) mod temporary;
pub(in crate::cli) mod terminal;
