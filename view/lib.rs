//! The page of `hsd view`, compressed with gzip; without files if it was not built.

/// Files of the page by name, such as `index.html`, compressed with gzip.
pub static FILES: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/page.rs"));
