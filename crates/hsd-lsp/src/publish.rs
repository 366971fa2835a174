//! Publishing of diagnostics. A file can be analysed on its own and as an include of other documents; the diagnostics of
//! all these analyses are merged.

use super::documents::{Document, Documents};
use super::lines::Encoding;
use super::proto::Places;
use gen_lsp_types as lsp;
use hsd_base::diagnostic::Language;
use std::collections::{BTreeMap, BTreeSet};

/// The diagnostics of each analysis by file.
#[derive(Default)]
pub(super) struct Published {
    readings: BTreeMap<String, BTreeMap<String, Vec<lsp::Diagnostic>>>,
}

impl Published {
    /// Records the diagnostics of an analysis; returns the updates for the client.
    pub(super) fn take(
        &mut self,
        documents: &Documents,
        document: &Document,
        encoding: Encoding,
        language: Language,
    ) -> Vec<lsp::PublishDiagnosticsParams> {
        let mut reported: BTreeMap<String, Vec<lsp::Diagnostic>> = BTreeMap::new();
        reported.insert(document.uri.clone(), vec![]);
        if let Some(analysis) = &document.analysis {
            let places = Places::new(documents, document, analysis, encoding);
            for diagnostic in &analysis.diagnostics {
                if let Some((uri, converted)) = places.diagnostic(diagnostic, language) {
                    reported.entry(uri).or_default().push(converted);
                }
            }
        }
        self.replace(&document.uri, reported, documents)
    }

    /// Removes the diagnostics of a closed document; returns the updates for the client.
    pub(super) fn close(
        &mut self,
        uri: &str,
        documents: &Documents,
    ) -> Vec<lsp::PublishDiagnosticsParams> {
        let mut shown = self.replace(uri, BTreeMap::new(), documents);
        self.readings.remove(uri);
        // Clears the diagnostics of the closed document, unless another one includes it.
        if shown.is_empty() {
            shown.push(self.shown(uri, documents));
        }
        shown
    }

    fn replace(
        &mut self,
        reading: &str,
        reported: BTreeMap<String, Vec<lsp::Diagnostic>>,
        documents: &Documents,
    ) -> Vec<lsp::PublishDiagnosticsParams> {
        let mut texts: BTreeSet<String> = reported.keys().cloned().collect();
        let before = self.readings.insert(reading.to_owned(), reported);
        for (text, old) in before.into_iter().flatten() {
            let same = self.readings[reading].get(&text) == Some(&old);
            if same && text != reading {
                texts.remove(&text);
            } else {
                texts.insert(text);
            }
        }
        texts.iter().map(|t| self.shown(t, documents)).collect()
    }

    /// Returns all diagnostics of a file.
    fn shown(&self, uri: &str, documents: &Documents) -> lsp::PublishDiagnosticsParams {
        let mut diagnostics: Vec<lsp::Diagnostic> = vec![];
        for reported in self.readings.values().filter_map(|r| r.get(uri)) {
            let alone = diagnostics.is_empty();
            let new = reported
                .iter()
                .filter(|d| alone || !diagnostics.contains(d));
            let new: Vec<lsp::Diagnostic> = new.cloned().collect();
            diagnostics.extend(new);
        }
        lsp::PublishDiagnosticsParams {
            uri: lsp::Uri::from(uri.to_owned()),
            version: documents.get(uri).map(|d| d.version),
            diagnostics,
        }
    }
}
