//! The catalogue of a run: the built-in parts, those of files given on the command line or found beside a source, and
//! those of the sources.

use hsd_base::diagnostic::Diagnostics;
use hsd_base::source::Source;
use hsd_ir::ast::Document;
use hsd_ir::catalog::{Catalog, ScopeId};
use hsd_ir::messages::catalog as say;
use hsd_syntax::parse::xml::Trees;
use hsd_syntax::parse::{self, ReadContext};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// The name of the file whose parts are known to the sources beside it.
pub const BESIDE: &str = "catalog.hsd";

/// Returns the catalogue of a run and records which parts each house knows. `given` are files for all sources.
pub fn catalog<'a>(
    sources: &[&Source],
    documents: &[Document],
    given: &'a [Source],
    (setting, trees): (ReadContext<'a>, &mut Trees<'a>),
    out: &mut Diagnostics,
) -> Cow<'static, Catalog> {
    let builtin = parse::builtin();
    let given: Vec<(&Source, Document)> = given
        .iter()
        .map(|s| (s, parse::parse_in(s, setting, trees, out)))
        .collect();
    for (source, document) in &given {
        if document.parts.is_empty() {
            out.push(say::no_parts(source.span(0..0)));
        }
    }
    let beside: Vec<Option<&Source>> = sources.iter().map(|s| beside(s, setting)).collect();
    let own = |d: &Document| !d.parts.is_empty() || d.houses.iter().any(|h| !h.parts.is_empty());
    let any = documents.iter().any(own) || given.iter().any(|(_, d)| own(d));
    if !any && beside.iter().all(Option::is_none) {
        return Cow::Borrowed(builtin);
    }
    let mut catalog = builtin.clone();
    // Grouped by file: sources in one folder share the file beside them.
    let mut folders: BTreeMap<Option<&str>, ScopeId> = BTreeMap::new();
    // With variants, the documents of all sources occur several times.
    let all = sources.iter().zip(beside).cycle();
    for (document, (source, file)) in documents.iter().zip(all) {
        let known = folders.get(&file.map(Source::name)).copied();
        let scope = known.unwrap_or_else(|| {
            let mut scope = ScopeId::default();
            if let Some(file) = file {
                let parts = parse::parse_in(file, setting, trees, out).parts;
                if parts.is_empty() {
                    out.push(say::no_parts(file.span(0..0)));
                }
                scope = catalog.extend(scope, file.id(), &parts, out);
            }
            for (source, document) in &given {
                scope = catalog.extend(scope, source.id(), &document.parts, out);
            }
            folders.insert(file.map(Source::name), scope);
            scope
        });
        let scope = catalog.extend(scope, source.id(), &document.parts, out);
        let mut houses = vec![];
        for house in &document.houses {
            houses.push(catalog.extend(scope, source.id(), &house.parts, out));
        }
        catalog.settle(houses);
    }
    Cow::Owned(catalog)
}

/// Returns the file of parts beside a source, unless the source is that file itself.
fn beside<'a>(source: &Source, setting: ReadContext<'a>) -> Option<&'a Source> {
    let path = setting.world.text(source.name(), BESIDE).ok()?;
    if path == source.name() {
        return None;
    }
    if let Some(there) = setting.cache.find(&path) {
        return Some(there);
    }
    let bytes = setting.world.text_bytes(&path, setting.limits.bytes).ok()?;
    setting.cache.add(&path, &bytes).ok()
}
