//! The command line: one module per subcommand, with the modules they share.
//!
//! Exit status (docs/contract.md 5): 0 success, 1 errors in the input, 2 usage error, 3 input or output failed.
//! A closed pipe at standard output is not a failure.

#![cfg_attr(not(feature = "view"), allow(dead_code))] // items that only `hsd view` and `hsd render` use

mod files;
mod build;
mod check;
mod completions;
mod dump;
mod explain;
mod fmt;
mod language;
#[cfg(feature = "lsp")]
mod lsp;
mod new;
mod options;
mod params;
mod parts;
#[cfg(feature = "view")]
mod render;
mod textures;
#[cfg(feature = "view")]
mod view;
use clap::error::{ContextKind, ContextValue, ErrorKind as ClapError};
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
pub use hsd_base::diagnostic::{Language, Text};
use hsd_base::text;
use hsd_syntax::templates::TYPES;
use std::ffi::OsString;
use std::io::{self, ErrorKind, Write};
use std::path::Path;
use std::sync::LazyLock;

/// The exit status of a run that completed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Exit {
    Done = 0,
    Errors = 1,
    /// A file could not be read; the others were processed.
    Unread = 3,
}

impl Exit {
    /// Returns the more severe status of the two.
    fn worse(self, other: Exit) -> Exit {
        if self as u8 >= other as u8 {
            self
        } else {
            other
        }
    }
}

/// The reason a run was aborted.
#[derive(Debug)]
enum Failure {
    /// The command line is invalid (exit status 2).
    Usage(Text),
    /// A file could not be read or written (exit status 3).
    Io(Text),
    /// The reader of standard output closed the pipe (exit status 0).
    Pipe,
}

impl Failure {
    /// An I/O error, with the file or program it concerns.
    fn at(what: impl std::fmt::Display, error: io::Error) -> Failure {
        let (what, why) = (what.to_string(), crate::files::reason::of(&error));
        match error.kind() {
            ErrorKind::BrokenPipe => Failure::Pipe,
            _ => Failure::Io(text!([what, why] "{what}: {why}", "{what}: {why}")),
        }
    }
}

impl Failure {
    /// A value that cannot be written as JSON.
    fn json(error: &serde_json::Error) -> Failure {
        let why = error.to_string();
        Failure::Io(text!([why] "cannot write JSON: {why}", "JSON を書けません: {why}"))
    }

    /// Standard input is named more than once.
    fn stdin_twice() -> Failure {
        Failure::Usage(text!(
            "standard input can be read only once",
            "標準入力を読めるのは一度だけです"
        ))
    }

    /// Two inputs have the same output.
    fn one_output(a: &Path, b: &Path, output: &Path) -> Failure {
        let (a, b, out) = (a.display(), b.display(), output.display());
        Failure::Usage(text!([a, b, out]
            "{a} and {b} would both be written to {out}",
            "{a} と {b} の出力先がどちらも {out} になります"
        ))
    }
}

/// An error at standard output or standard error.
impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        let why = crate::files::reason::of(&error);
        match error.kind() {
            ErrorKind::BrokenPipe => Failure::Pipe,
            _ => Failure::Io(text!([why] "cannot write: {why}", "書き込めません: {why}")),
        }
    }
}

type Outcome = Result<Exit, Failure>;

/// What `--version` tells: the version, and what is in this build; `-V` tells the version alone.
static CONTENTS: LazyLock<String> = LazyLock::new(|| {
    #[cfg(feature = "view")]
    let page = hsd_view::is_built();
    #[cfg(not(feature = "view"))]
    let page = false;
    let in_it = |what| if what { "yes" } else { "no" };
    let rows = [
        ("page of hsd view", in_it(page)),
        ("language server", in_it(cfg!(feature = "lsp"))),
        ("--compress", in_it(cfg!(feature = "compress"))),
        ("GeoPackage", in_it(cfg!(feature = "geopackage"))),
        ("GeoParquet", in_it(cfg!(feature = "geoparquet"))),
    ];
    let mut text = env!("CARGO_PKG_VERSION").to_owned();
    for (what, there) in rows {
        text += &format!("\n{:<18}{there}", format!("{what}:"));
    }
    let (parts, types) = (hsd_syntax::parse::builtin().parts().len(), TYPES.len());
    text + &format!("\n{parts} parts, {types} house types")
});

/// Compile house files into textured 3D models.
#[derive(Debug, Parser)]
#[command(name = "hsd", version, long_version = &**CONTENTS, propagate_version = true, max_term_width = 100)]
#[command(after_help = "\
Examples:
  hsd build examples/machiya.hsd -o machiya.glb    build a model for any glTF viewer
  hsd explain HSD0104                              explain a diagnostic and how to fix it

Exit status: 0 success, 1 errors in the input, 2 usage error, 3 a file could not be read or written.")]
struct Cli {
    /// Set the language of diagnostics and help [default: from the locale].
    #[arg(long, global = true, value_enum, value_name = "LANG")]
    lang: Option<language::Lang>,

    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Build(build::Build),
    Town(build::init::TownCommand),
    Check(check::Check),
    Draw(build::draw::Draw),
    Plan(Box<build::plan::Plan>),
    Facade(Box<build::facade::Facade>),
    Dump(dump::Dump),
    New(new::New),
    Params(params::Params),
    Parts(parts::Parts),
    Explain(explain::Explain),
    Fmt(fmt::Fmt),
    Textures(textures::Textures),
    #[cfg(feature = "view")]
    View(view::View),
    #[cfg(feature = "view")]
    Render(render::Render),
    #[cfg(feature = "lsp")]
    Lsp(lsp::Lsp),
    Completions(completions::Completions),
    Man(completions::man::Man),
}

/// Runs the program and returns its exit status; the first argument is the program name.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let language = language::of(&arguments);
    #[cfg(feature = "view")]
    let arguments = view::first::arguments(arguments, language);
    #[cfg(not(feature = "view"))]
    let arguments = Ok(arguments);
    let outcome = match arguments.map(|arguments| parsed(arguments, language)) {
        Ok(Ok(cli)) => cli.command.run(language),
        Ok(Err(error)) => return print_clap_error(&error, language),
        Err(failure) => Err(failure),
    };
    let (status, message) = status(outcome, language);
    if !message.is_empty() {
        let _ = writeln!(io::stderr(), "hsd: {message}");
    }
    status
}

/// Lists the parts whose code or names hold a word, one a line, as `hsd parts` does; returns an empty text if there is none.
pub fn parts(filter: Option<String>, language: Language) -> String {
    parts::list(filter, language)
}

/// Runs a command line inside of another program: returns the exit status and what it says of a failure, which is not printed.
/// Signals are left to that program, and messages on the texts, which it can ask for.
pub fn call(arguments: Vec<OsString>) -> (u8, String) {
    files::temporary::leave_signals();
    files::messages::leave_people();
    let language = language::of(&arguments);
    match parsed(arguments, language) {
        Ok(cli) => status(cli.command.run(language), language),
        Err(error) => (error.exit_code() as u8, error.to_string()),
    }
}

fn parsed(arguments: Vec<OsString>, language: Language) -> Result<Cli, clap::Error> {
    let matches = command(language).try_get_matches_from(arguments)?;
    Cli::from_arg_matches(&matches)
}

/// Returns the exit status of an outcome, and what is to be said of a failure.
fn status(outcome: Outcome, language: Language) -> (u8, String) {
    let (message, status) = match outcome {
        Ok(exit) => return (exit as u8, String::new()),
        Err(Failure::Pipe) => return (0, String::new()),
        Err(Failure::Usage(message)) => (message, 2),
        Err(Failure::Io(message)) => (message, 3),
    };
    (status, message.in_language(language).into_owned())
}

impl Command {
    fn run(self, language: Language) -> Outcome {
        match self {
            Command::Build(c) => c.run(language),
            Command::Town(c) => c.run(language),
            Command::Check(c) => c.run(language),
            Command::Draw(c) => c.run(language),
            Command::Plan(c) => c.run(language),
            Command::Facade(c) => c.run(language),
            Command::Dump(c) => c.run(language),
            Command::New(c) => c.run(language),
            Command::Params(c) => c.run(language),
            Command::Parts(c) => c.run(language),
            Command::Explain(c) => c.run(language),
            Command::Fmt(c) => c.run(language),
            Command::Textures(c) => c.run(language),
            #[cfg(feature = "view")]
            Command::View(c) => c.run(language),
            #[cfg(feature = "view")]
            Command::Render(c) => c.run(language),
            #[cfg(feature = "lsp")]
            Command::Lsp(c) => c.run(language),
            Command::Completions(c) => c.run(language),
            Command::Man(c) => c.run(language),
        }
    }
}

/// The clap command with help in `language`.
fn command(language: Language) -> clap::Command {
    match language {
        Language::English => Cli::command(),
        Language::Japanese => crate::language::japanese::command(Cli::command()),
    }
}

/// Prints help, the version or a usage error, and returns the exit status.
fn print_clap_error(error: &clap::Error, language: Language) -> u8 {
    if let Some(name) = file_for_command(error) {
        let hint = text!([name]
            "`{name}` is a file; to build a model from it: hsd build {name}",
            "`{name}` はファイルです。モデルを作るには: hsd build {name}"
        );
        let _ = writeln!(io::stderr(), "hsd: {}", hint.in_language(language));
        return 2;
    }
    let helps = matches!(
        error.kind(),
        ClapError::DisplayHelp
            | ClapError::DisplayHelpOnMissingArgumentOrSubcommand
            | ClapError::DisplayVersion
    );
    // Errors of standard output and error are ignored: there is nowhere to report them.
    let _ = match language {
        Language::Japanese if !helps => {
            write!(
                io::stderr(),
                "{}",
                crate::language::japanese::error_message(error)
            )
        }
        _ => error.print(),
    };
    error.exit_code() as u8
}

/// The existing file named in place of a subcommand, if that is the error.
fn file_for_command(error: &clap::Error) -> Option<&str> {
    let word = match error.get(ContextKind::InvalidSubcommand) {
        Some(ContextValue::String(word)) if error.kind() == ClapError::InvalidSubcommand => word,
        _ => return None,
    };
    Path::new(word).is_file().then_some(word)
}
