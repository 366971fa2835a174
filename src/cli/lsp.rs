//! `hsd lsp`: the language server, for editors.

use super::{Exit, Outcome};
use crate::diagnostic::Language;
use crate::lsp;
use clap::Args;
use std::io::{self, BufReader};

/// Serve an editor: diagnostics, completion, hover and more by the Language Server Protocol.
///
/// Editors start it by themselves; it reads standard input and writes standard output. How to set up an editor
/// stands in the README.
#[derive(Debug, Args)]
pub(super) struct Lsp {
    /// Speak on standard input and output, as is done anyway; clients say so by habit.
    #[arg(long)]
    stdio: bool,
}

impl Lsp {
    pub(super) fn run(&self, language: Language) -> Outcome {
        let polite = lsp::serve(BufReader::new(io::stdin()), io::stdout(), language);
        // What the protocol wants of a server that was told to end without a word before.
        Ok(if polite { Exit::Done } else { Exit::Errors })
    }
}
