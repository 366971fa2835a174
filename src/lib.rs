//! A compiler for houses.

pub mod roof;
