//! A compiler for houses.
