//! The `hsd` program: hands its arguments to the shell.

use std::process::ExitCode;

fn main() -> ExitCode {
    hsd::cli::run(std::env::args_os())
}
