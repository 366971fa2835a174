//! `hsd man`: writes manual pages, which packages install.

use crate::cli::{Cli, Exit, Failure, Outcome};
use clap::{Args, Command, CommandFactory};
use clap_mangen::Man as Page;
use std::fs;
use std::path::{Path, PathBuf};

/// Write manual pages for `man` to a folder, in English: hsd.1 and one for each command.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd man ~/.local/share/man/man1    write hsd.1, hsd-build.1 and so on; `man hsd-build` shows them")]
pub(in crate::cli) struct Man {
    /// The folder, which is made if it is not there.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

impl Man {
    pub(in crate::cli) fn run(&self) -> Outcome {
        let failed = |error| Failure::at(self.folder.display(), error);
        fs::create_dir_all(&self.folder).map_err(failed)?;
        let mut program = Cli::command().disable_help_subcommand(true);
        program.build();
        write(&program, &self.folder)?;
        Ok(Exit::Done)
    }
}

/// Writes the page of a command and those of the commands below it.
fn write(command: &Command, folder: &Path) -> Result<(), Failure> {
    let page = Page::new(command.clone());
    let path = folder.join(page.get_filename());
    let mut text = vec![];
    let made = page.render(&mut text).and_then(|()| fs::write(&path, text));
    made.map_err(|error| Failure::at(path.display(), error))?;
    let shown = command.get_subcommands().filter(|c| !c.is_hide_set());
    shown.into_iter().try_for_each(|below| write(below, folder))
}
