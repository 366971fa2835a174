//! Tests of the crate as one program, which is compiled and linked once.

#![allow(missing_docs, unreachable_pub)] // modules of one program
#![allow(clippy::unwrap_used)] // a test that panics has failed

mod fmt;
mod outline;
mod parse_legacy;
mod parse_legacy_robust;
mod parse_xml;
