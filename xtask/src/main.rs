//! Tasks for developers of `hsd`: `cargo run -p xtask -- TASK`.

#![cfg_attr(test, allow(clippy::unwrap_used))] // a test that panics has failed

mod mutate;
mod style;
mod textures;

use std::io::{self, ErrorKind, Write};
use std::process::ExitCode;

const USAGE: &str = "\
Usage: cargo run -p xtask -- TASK

Tasks:
  mutate      Give damaged maps and plans to the program
  style       Check comments, messages and Markdown against the style guide
  textures    Draw the files of textures/
";

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let task = arguments.next().unwrap_or_default();
    let rest: Vec<String> = arguments.collect();
    let mut out = io::stdout().lock();
    let result = match task.as_str() {
        "mutate" => mutate::run(&rest, &mut out),
        "style" => style::run(&rest, &mut out),
        "textures" => textures::run(&rest, &mut out),
        "" | "help" | "-h" | "--help" => {
            out.write_all(USAGE.as_bytes()).map(|()| ExitCode::SUCCESS)
        }
        other => Err(io::Error::other(format!(
            "unknown task `{other}`\n\n{USAGE}"
        ))),
    };
    result.unwrap_or_else(report)
}

/// Prints an error of a task and returns exit code 2. A closed pipe, as of `| head`, is not an error.
fn report(error: io::Error) -> ExitCode {
    if error.kind() == ErrorKind::BrokenPipe {
        return ExitCode::SUCCESS;
    }
    // A standard error that cannot be written to leaves the exit code as the only report.
    let _ = writeln!(io::stderr(), "xtask: {error}");
    ExitCode::from(2)
}
