//! The language server, as its clients see it.

mod client;
mod conformance;
mod files;
mod life;
mod fixes;
mod program;
mod speed;
mod stream;
mod towns;
