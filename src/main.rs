//! The `hsd` program: hands its arguments to the shell.

use std::process::ExitCode;

// A town is millions of small trees that are made and dropped: parse to scene takes two thirds of the time with it.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    hsd::cli::run(std::env::args_os())
}
