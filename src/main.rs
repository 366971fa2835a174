//! The `hsd` program: passes its arguments to the command line module.

use std::process::ExitCode;

// A town is millions of small trees that are allocated and freed: with this allocator, parsing to scene takes two
// thirds of the time.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    ExitCode::from(hsd::cli::run(std::env::args_os()))
}
