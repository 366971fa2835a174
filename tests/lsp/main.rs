//! The language server, as its clients see it.

#![expect(unreachable_pub)] // modules of one program

mod client;
mod conformance;
mod files;
mod life;
mod mends;
mod program;
mod speed;
mod stream;
#[path = "../support/mod.rs"]
mod support;
