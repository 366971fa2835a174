//! Fixes as code actions: one each, and all of a text at once.

use super::documents::{Document, Documents};
use super::lines::Encoding;
use super::proto::{Changes, Places};
use super::settings::Settings;
use crate::ide::fix::fix_all;
use crate::text;
use gen_lsp_types as lsp;

/// Fixes everything that can be mended without further thought.
pub(super) const ALL: &str = "source.fixAll.hsd";

/// How often a text is mended and read again, where that is asked for.
const ROUNDS: usize = 8;

/// What the client can do with actions, and how its columns count.
#[derive(Clone, Copy)]
pub(super) struct Manner<'s> {
    pub(super) encoding: Encoding,
    pub(super) settings: &'s Settings,
    pub(super) versions: bool,
}

/// The actions for a range of a text. Whoever includes the text may have found something in it.
pub(super) fn actions(
    documents: &Documents,
    uri: &str,
    range: lsp::Range,
    only: Option<&[String]>,
    manner: Manner<'_>,
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
        found.extend(document.and_then(|d| all(documents, d, only.is_some(), manner)));
    }
    found
}

/// The mends of what a reading says of a range of a text.
fn quick_fixes(
    documents: &Documents,
    document: &Document,
    uri: &str,
    range: lsp::Range,
    manner: Manner<'_>,
) -> Vec<lsp::CodeAction> {
    let Some(analysis) = &document.analysis else {
        return vec![];
    };
    let places = Places::new(documents, document, analysis, manner.encoding);
    let mut found = vec![];
    let fixable = analysis.diagnostics.iter().filter(|d| !d.fixes.is_empty());
    for diagnostic in fixable.filter(|d| places.uri(d.span.file) == Some(uri)) {
        let Some((_, shown)) = places.diagnostic(diagnostic, manner.settings.language) else {
            continue;
        };
        if shown.range.start > range.end || shown.range.end < range.start {
            continue;
        }
        for (index, fix) in diagnostic.fixes.iter().enumerate() {
            let Some(changes) = places.edits(&fix.edits) else {
                continue;
            };
            found.push(lsp::CodeAction {
                title: fix.title.in_language(manner.settings.language).to_owned(),
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

/// All mends of a text at once, if they make it better. Where nobody has asked for them, one round has to do.
fn all(
    documents: &Documents,
    document: &Document,
    asked: bool,
    manner: Manner<'_>,
) -> Option<lsp::CodeAction> {
    let analysis = document.analysis.as_ref()?;
    let places = Places::new(documents, document, analysis, manner.encoding);
    let read = |text: &str| documents.trial(&document.uri, text, manner.settings);
    let rounds = if asked { ROUNDS } else { 1 };
    let (count, edits) = fix_all(analysis, &read, rounds)?;
    let (own, mut changes) = (analysis.source.id(), Changes::default());
    for edit in edits {
        let place = places.location(own, &edit.range)?;
        changes.add(place, places.version(own), edit.text);
    }
    let title = text!(
        "Fix all that can be mended ({count})",
        "直せるところをすべて直す({count}か所)"
    );
    Some(lsp::CodeAction {
        title: title.in_language(manner.settings.language).to_owned(),
        kind: Some(lsp::CodeActionKind::from(ALL.to_owned())),
        edit: Some(changes.finish(manner.versions)),
        ..lsp::CodeAction::default()
    })
}
