//! Reading inputs and writing outputs: files, standard streams, the terminal, and the reasons why one fails.

pub(in crate::cli) mod diff;
pub(in crate::cli) mod input;
pub(in crate::cli) mod output;
pub(in crate::cli) mod reason;
pub(in crate::cli) mod terminal;
