//! `hsd completions`: writes completion scripts for shells.

pub(super) mod man;

use super::{Exit, Outcome, command};
use clap::Args;
use clap_complete::Shell;
use hsd_base::diagnostic::Language;
use std::io::{self, Write};

/// Generate a completion script for a shell.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd completions bash > ~/.local/share/bash-completion/completions/hsd
  hsd completions fish > ~/.config/fish/completions/hsd.fish")]
pub(super) struct Completions {
    /// The shell to generate the script for.
    #[arg(value_enum)]
    shell: Shell,
}

impl Completions {
    pub(super) fn run(&self, language: Language) -> Outcome {
        let mut script = vec![]; // the generator panics on a closed pipe
        clap_complete::generate(self.shell, &mut command(language), "hsd", &mut script);
        io::stdout().write_all(&script)?;
        Ok(Exit::Done)
    }
}
