//! The built-in catalogue: a file like those of authors, read by the same reader.

use super::parse;
use crate::catalog::Catalog;
use crate::diagnostic::Diagnostics;
use crate::source::{FileId, Limits, Source};
use std::sync::LazyLock;

static BUILTIN: LazyLock<Catalog> = LazyLock::new(|| {
    let mut out = Diagnostics::new();
    let text = include_bytes!("../../grammar/parts.xml");
    let source = Source::new(FileId(0), "grammar/parts.xml", text);
    let parts = parse(&source, &Limits::default(), &mut out).parts;
    let catalog = Catalog::new(&parts, &mut out);
    debug_assert!(out.iter().next().is_none(), "{:?}", out.into_sorted());
    catalog
});

/// Returns the built-in catalogue.
pub fn builtin() -> &'static Catalog {
    &BUILTIN
}
