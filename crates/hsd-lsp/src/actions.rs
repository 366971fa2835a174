//! Fixes as code actions: individually, and all fixes of a document at once.

use super::documents::{Document, Documents};
use super::lines::Encoding;
use super::proto::{Changes, Places};
use super::settings::Settings;
use gen_lsp_types as lsp;
use hsd_base::text;
use hsd_ide::fix::fix_all;

/// The kind of the action that applies all safe fixes.
pub(super) const ALL: &str = "source.fixAll.hsd";

/// The maximum number of rounds of fixing and analysing, if the client requests the action explicitly.
const ROUNDS: usize = 8;

/// The settings and capabilities that code actions depend on.
#[derive(Clone, Copy)]
pub(super) struct ActionContext<'s> {
    pub(super) encoding: Encoding,
    pub(super) settings: &'s Settings,
    pub(super) versions: bool,
}

/// Returns the actions for a range of a document, including fixes from analyses of documents that include it.
pub(super) fn actions(
    documents: &Documents,
    uri: &str,
    range: lsp::Range,
    only: Option<&[String]>,
    context: ActionContext<'_>,
) -> Vec<lsp::CodeAction> {
    let wanted = |kind: &str| {
        only.is_none_or(|o| {
            o.iter()
                .any(|o| kind == o || kind.starts_with(&format!("{o}.")))
        })
    };
    let mut found: Vec<lsp::CodeAction> = vec![];
    for document in documents.iter().filter(|_| wanted("quickfix")) {
        for action in quick_fixes(documents, document, uri, range, context) {
            let same = |f: &lsp::CodeAction| f.title == action.title && f.edit == action.edit;
            if !found.iter().any(same) {
                found.push(action);
            }
        }
    }
    if wanted(ALL) {
        let document = documents.get(uri);
        found.extend(document.and_then(|d| all(documents, d, only.is_some(), context)));
    }
    found
}

/// Returns the fixes of one analysis for a range of a document.
fn quick_fixes(
    documents: &Documents,
    document: &Document,
    uri: &str,
    range: lsp::Range,
    context: ActionContext<'_>,
) -> Vec<lsp::CodeAction> {
    let Some(analysis) = &document.analysis else {
        return vec![];
    };
    let places = Places::new(documents, document, analysis, context.encoding);
    let mut found = vec![];
    let fixable = analysis.diagnostics.iter().filter(|d| !d.fixes.is_empty());
    for diagnostic in fixable.filter(|d| d.span().and_then(|s| places.uri(s.file)) == Some(uri)) {
        let Some((_, shown)) = places.diagnostic(diagnostic, context.settings.language) else {
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
                title: fix
                    .title
                    .in_language(context.settings.language)
                    .into_owned(),
                kind: Some(lsp::CodeActionKind::QuickFix),
                diagnostics: Some(vec![shown.clone()]),
                is_preferred: (index == 0).then_some(true),
                edit: Some(changes.finish(context.versions)),
                ..lsp::CodeAction::default()
            });
        }
    }
    found
}

/// Returns the action that applies all fixes of a document, if they improve it. Unless `asked`, one round is tried.
fn all(
    documents: &Documents,
    document: &Document,
    asked: bool,
    context: ActionContext<'_>,
) -> Option<lsp::CodeAction> {
    let analysis = document.analysis.as_ref()?;
    let places = Places::new(documents, document, analysis, context.encoding);
    let read = |text: &str| documents.trial(&document.uri, text, context.settings);
    let rounds = if asked { ROUNDS } else { 1 };
    let (count, edits) = fix_all(analysis, &read, rounds)?;
    let (own, mut changes) = (analysis.source.id(), Changes::default());
    for edit in edits {
        let place = places.location(own, &edit.range)?;
        changes.add(place, places.version(own), edit.text);
    }
    let title = text!([count]
        "Apply all fixes ({count})",
        "修正候補をすべて適用({count}か所)"
    );
    Some(lsp::CodeAction {
        title: title.in_language(context.settings.language).into_owned(),
        kind: Some(lsp::CodeActionKind::from(ALL.to_owned())),
        edit: Some(changes.finish(context.versions)),
        ..lsp::CodeAction::default()
    })
}
