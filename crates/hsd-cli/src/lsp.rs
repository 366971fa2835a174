//! `hsd lsp`: runs the language server.

use super::{Exit, Outcome};
use clap::Args;
use hsd_base::diagnostic::Language;
use std::io::{self, BufReader};

/// Run the language server for editors.
///
/// It provides diagnostics, completion, hover and more by the Language Server Protocol on standard input and output.
/// Editors start it themselves; the README describes how to set them up.
#[derive(Debug, Args)]
pub(super) struct Lsp {
    /// Use standard input and output; the default, accepted for compatibility with clients.
    #[arg(long)]
    stdio: bool,
}

impl Lsp {
    pub(super) fn run(&self, language: Language) -> Outcome {
        let orderly = hsd_lsp::serve(BufReader::new(io::stdin()), io::stdout(), language);
        // The protocol requires status 1 for `exit` without a preceding `shutdown`.
        Ok(if orderly { Exit::Done } else { Exit::Errors })
    }
}
