//! `hsd man`: writes manual pages, which packages install.

use crate::files::output::Committer;
use crate::language::japanese;
use crate::{Cli, Exit, Failure, Outcome};
use clap::{Args, Command, CommandFactory};
use clap_mangen::Man as Page;
use hsd_base::diagnostic::Language;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Write manual pages for `man` to a folder, in the language of `--lang`: hsd.1 and one for each command.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd man ~/.local/share/man/man1    write hsd.1, hsd-build.1 and so on; `man hsd-build` shows them
  hsd --lang ja man ~/.local/share/man/ja/man1    the Japanese ones, which `man` shows in a Japanese locale")]
pub(crate) struct Man {
    /// The folder, which is made if it is not there.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

impl Man {
    pub(crate) fn run(&self, language: Language) -> Outcome {
        let failed = |error| Failure::at(self.folder.display(), error);
        fs::create_dir_all(&self.folder).map_err(failed)?;
        let mut program = Cli::command().disable_help_subcommand(true);
        let program = match language {
            Language::Japanese => japanese::for_pages(program),
            Language::English => {
                program.build();
                program
            }
        };
        let mut pages = vec![];
        add_pages(&program, &self.folder, language, &mut pages)?;
        Committer::default().named_by("DIR").write_all(pages)?;
        Ok(Exit::Done)
    }
}

/// Adds the page of a command and those of its subcommands.
fn add_pages(
    command: &Command,
    folder: &Path,
    language: Language,
    pages: &mut Vec<(PathBuf, Vec<u8>)>,
) -> Result<(), Failure> {
    let page = Page::new(command.clone());
    let path = folder.join(page.get_filename());
    let text = text(&page, language).map_err(|error| Failure::at(path.display(), error))?;
    pages.push((path, text.into_bytes()));
    let shown = command.get_subcommands().filter(|c| !c.is_hide_set());
    shown
        .into_iter()
        .try_for_each(|below| add_pages(below, folder, language, pages))
}

/// Returns the source of a page.
fn text(page: &Page, language: Language) -> io::Result<String> {
    let mut text = vec![];
    page.render(&mut text)?;
    let text = String::from_utf8(text).map_err(io::Error::other)?;
    Ok(match language {
        Language::Japanese => japanese::page(&text),
        Language::English => text,
    })
}
