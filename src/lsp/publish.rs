//! Which diagnostics the client is shown. A text may be read for itself and for others that include it; what any of
//! these readings says of it is shown once.

use super::documents::{Document, Documents};
use super::lines::Encoding;
use super::proto::Places;
use crate::diagnostic::Language;
use gen_lsp_types as lsp;
use std::collections::{BTreeMap, BTreeSet};

/// What each reading says of which text.
#[derive(Default)]
pub(super) struct Published {
    readings: BTreeMap<String, BTreeMap<String, Vec<lsp::Diagnostic>>>,
}

impl Published {
    /// Takes what the last reading of a text says; returns what the client is to be shown now.
    pub(super) fn take(
        &mut self,
        documents: &Documents,
        document: &Document,
        encoding: Encoding,
        language: Language,
    ) -> Vec<lsp::PublishDiagnosticsParams> {
        let mut said: BTreeMap<String, Vec<lsp::Diagnostic>> = BTreeMap::new();
        said.insert(document.uri.clone(), vec![]);
        if let Some(analysis) = &document.analysis {
            let places = Places::new(documents, document, analysis, encoding);
            for diagnostic in &analysis.diagnostics {
                if let Some((uri, made)) = places.diagnostic(diagnostic, language) {
                    said.entry(uri).or_default().push(made);
                }
            }
        }
        self.replace(&document.uri, said, documents)
    }

    /// Forgets the readings of a text that was closed.
    pub(super) fn close(
        &mut self,
        uri: &str,
        documents: &Documents,
    ) -> Vec<lsp::PublishDiagnosticsParams> {
        let mut shown = self.replace(uri, BTreeMap::new(), documents);
        self.readings.remove(uri);
        // Nothing is said of the closed text itself any more, unless another one includes it.
        if shown.is_empty() {
            shown.push(self.shown(uri, documents));
        }
        shown
    }

    fn replace(
        &mut self,
        reading: &str,
        said: BTreeMap<String, Vec<lsp::Diagnostic>>,
        documents: &Documents,
    ) -> Vec<lsp::PublishDiagnosticsParams> {
        let mut texts: BTreeSet<String> = said.keys().cloned().collect();
        let before = self.readings.insert(reading.to_owned(), said);
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

    /// All that is said of a text.
    fn shown(&self, uri: &str, documents: &Documents) -> lsp::PublishDiagnosticsParams {
        let mut diagnostics: Vec<lsp::Diagnostic> = vec![];
        for said in self.readings.values().filter_map(|r| r.get(uri)) {
            let alone = diagnostics.is_empty();
            let new = said.iter().filter(|d| alone || !diagnostics.contains(d));
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
