//! The tests of maps in a program that reads GeoPackage and GeoParquet too.

#![allow(clippy::unwrap_used, clippy::print_stdout, missing_docs)]
#![allow(dead_code, unreachable_pub, reason = "what other tests need")]

mod maps;
mod support;
