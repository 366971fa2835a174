//! Mends as code actions: one each, and all of a text at once.

use super::documents::{Document, Documents};
use super::lines::Encoding;
use super::proto::{Changes, Places};
use crate::diagnostic::{Diagnostic, Language, Mend};
use crate::source::Span;
use crate::text;
use gen_lsp_types as lsp;
use std::collections::BTreeMap;

/// Mends everything that can be mended without further thought.
pub(super) const ALL: &str = "source.fixAll.hsd";

/// What the client can do with actions, and how its columns count.
#[derive(Clone, Copy)]
pub(super) struct Manner {
    pub(super) encoding: Encoding,
    pub(super) language: Language,
    pub(super) versions: bool,
}

/// The actions for a range of a text. Whoever includes the text may have found something in it.
pub(super) fn actions(
    documents: &Documents,
    uri: &str,
    range: lsp::Range,
    only: Option<&[String]>,
    manner: Manner,
) -> Vec<lsp::CodeAction> {
    let wanted = |kind: &str| {
        only.is_none_or(|o| {
            o.iter()
                .any(|o| kind == o || kind.starts_with(&format!("{o}.")))
        })
    };
    let mut found: Vec<lsp::CodeAction> = vec![];
    for document in documents.iter().filter(|_| wanted("quickfix")) {
        for action in quick_fixes(documents, document, uri, range, manner) {
            let same = |f: &lsp::CodeAction| f.title == action.title && f.edit == action.edit;
            if !found.iter().any(same) {
                found.push(action);
            }
        }
    }
    if wanted(ALL) {
        let document = documents.get(uri);
        found.extend(document.and_then(|d| all(documents, d, manner)));
    }
    found
}

/// The mends of what a reading says of a range of a text.
fn quick_fixes(
    documents: &Documents,
    document: &Document,
    uri: &str,
    range: lsp::Range,
    manner: Manner,
) -> Vec<lsp::CodeAction> {
    let Some(analysis) = &document.analysis else {
        return vec![];
    };
    let places = Places::new(documents, document, analysis, manner.encoding);
    let mut found = vec![];
    let mendable = analysis.diagnostics.iter().filter(|d| !d.mends.is_empty());
    for diagnostic in mendable.filter(|d| places.uri(d.span.file) == Some(uri)) {
        let Some((_, shown)) = places.diagnostic(diagnostic, manner.language) else {
            continue;
        };
        if shown.range.start > range.end || shown.range.end < range.start {
            continue;
        }
        for (index, mend) in diagnostic.mends.iter().enumerate() {
            let Some(changes) = places.edits(&mend.edits) else {
                continue;
            };
            found.push(lsp::CodeAction {
                title: mend.title.in_language(manner.language).to_owned(),
                kind: Some(lsp::CodeActionKind::QuickFix),
                diagnostics: Some(vec![shown.clone()]),
                is_preferred: (index == 0).then_some(true),
                edit: Some(changes.finish(manner.versions)),
                ..lsp::CodeAction::default()
            });
        }
    }
    found
}

/// The first mend of each message of a text, as many as do not touch one another.
fn all(documents: &Documents, document: &Document, manner: Manner) -> Option<lsp::CodeAction> {
    let analysis = document.analysis.as_ref()?;
    let places = Places::new(documents, document, analysis, manner.encoding);
    // By their ends: none of them meets another.
    let mut taken: BTreeMap<u32, u32> = BTreeMap::new();
    let mut changes = Changes::default();
    let mut count = 0usize;
    let mends = analysis.diagnostics.iter().filter_map(first_mend);
    for mend in mends {
        let spans = || mend.edits.iter().map(|e| e.span);
        let own = spans().all(|s| s.file == analysis.source.id());
        let meets = |s: Span| {
            let next = taken.range(s.start..).next();
            next.is_some_and(|(_, start)| *start <= s.end)
        };
        let Some(made) = places.edits(&mend.edits) else {
            continue;
        };
        if !own || spans().any(meets) {
            continue;
        }
        taken.extend(spans().map(|s| (s.end, s.start)));
        changes.merge(made);
        count += 1;
    }
    if count == 0 {
        return None;
    }
    let title = text!(
        "Mend all that can be mended ({count})",
        "直せるところをすべて直す({count}か所)"
    );
    Some(lsp::CodeAction {
        title: title.in_language(manner.language).to_owned(),
        kind: Some(lsp::CodeActionKind::from(ALL.to_owned())),
        edit: Some(changes.finish(manner.versions)),
        ..lsp::CodeAction::default()
    })
}

fn first_mend(diagnostic: &Diagnostic) -> Option<&Mend> {
    diagnostic.mends.first()
}
