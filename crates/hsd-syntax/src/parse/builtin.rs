//! The built-in catalogue: a file like those of authors, read by the same reader.

use super::parse;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::source::{FileId, Limits, Source};
use hsd_grammar::PARTS;
use hsd_ir::catalog::Catalog;
use std::sync::OnceLock;

/// Returns the built-in catalogue.
pub fn builtin() -> &'static Catalog {
    // Read here and not by a lazy static: a static would bring the whole reader into every program of unit tests.
    static BUILTIN: OnceLock<Catalog> = OnceLock::new();
    BUILTIN.get_or_init(|| {
        let mut out = Diagnostics::new();
        let source = Source::new(FileId(0), "grammar/parts.xml", PARTS.as_bytes());
        let parts = parse(&source, &Limits::default(), &mut out).parts;
        let catalog = Catalog::new(&parts, &mut out);
        debug_assert!(out.iter().next().is_none(), "{:?}", out.into_sorted());
        catalog
    })
}
