//! Places, positions and changes in the words of the protocol.

use super::documents::{Document, Documents};
use super::lines::{Encoding, Lines};
use super::uri;
use crate::diagnostic::{self, Language, Severity};
use crate::ide::Analysis;
use crate::source::{FileId, Source, Span};
use crate::text;
use gen_lsp_types as lsp;
use std::cell::OnceCell;
use std::collections::{BTreeMap, HashMap};
use std::ops;
use std::path::Path;

/// The places of one analysis: those in open texts, and those in files on disk.
pub(super) struct Places<'a> {
    document: &'a Document,
    analysis: &'a Analysis,
    encoding: Encoding,
    files: BTreeMap<FileId, File<'a>>,
}

/// A text with its lines.
struct File<'a> {
    uri: String,
    source: &'a Source,
    /// The text as the client has it.
    open: Option<&'a Document>,
    lines: OnceCell<Lines>,
}

impl<'a> Places<'a> {
    pub(super) fn new(
        documents: &'a Documents,
        document: &'a Document,
        analysis: &'a Analysis,
        encoding: Encoding,
    ) -> Places<'a> {
        let included = analysis.checked.included.iter();
        let files = included.map(|source| {
            let path = Path::new(source.name());
            let open = documents.of_file(path);
            let uri = open.map_or_else(|| uri::from_path(path), |d| d.uri.clone());
            let lines = OnceCell::new();
            let file = File {
                uri,
                source,
                open,
                lines,
            };
            (source.id(), file)
        });
        Places {
            document,
            analysis,
            encoding,
            files: files.collect(),
        }
    }

    /// The text as a client names it.
    pub(super) fn uri(&self, file: FileId) -> Option<&str> {
        if file == self.analysis.source.id() {
            return Some(&self.document.uri);
        }
        self.files.get(&file).map(|f| &*f.uri)
    }

    /// The client's count of changes of a text that is open.
    pub(super) fn version(&self, file: FileId) -> Option<i32> {
        if file == self.analysis.source.id() {
            return Some(self.document.version);
        }
        self.files.get(&file)?.open.map(|d| d.version)
    }

    /// A range of a text's offsets.
    pub(super) fn range(&self, file: FileId, range: &ops::Range<usize>) -> Option<lsp::Range> {
        if file == self.analysis.source.id() {
            return Some(self.own(range));
        }
        let file = self.files.get(&file)?;
        Some(match file.open {
            Some(document) => in_document(document, range, self.encoding),
            None => {
                let text = file.source.text();
                let lines = file.lines.get_or_init(|| Lines::new(text));
                lines.range(text, range, self.encoding)
            }
        })
    }

    /// A range of the text itself.
    pub(super) fn own(&self, range: &ops::Range<usize>) -> lsp::Range {
        in_document(self.document, range, self.encoding)
    }

    /// An offset of the text itself.
    pub(super) fn position(&self, at: usize) -> lsp::Position {
        self.own(&(at..at)).start
    }

    /// A place in any of the texts.
    pub(super) fn location(
        &self,
        file: FileId,
        range: &ops::Range<usize>,
    ) -> Option<lsp::Location> {
        Some(lsp::Location {
            uri: lsp::Uri::from(self.uri(file)?.to_owned()),
            range: self.range(file, range)?,
        })
    }

    /// The place of a span.
    pub(super) fn span(&self, span: Span) -> Option<lsp::Location> {
        let source = self.analysis.file(span.file)?;
        self.location(span.file, &source.text_range(span))
    }

    /// A diagnostic and the text it is about.
    pub(super) fn diagnostic(
        &self,
        d: &diagnostic::Diagnostic,
        language: Language,
    ) -> Option<(String, lsp::Diagnostic)> {
        let place = self.span(d.span)?;
        let related = d.labels.iter().filter_map(|label| {
            Some(lsp::DiagnosticRelatedInformation {
                location: self.span(label.span)?,
                message: label.message.in_language(language).to_owned(),
            })
        });
        let related: Vec<_> = related.collect();
        let made = lsp::Diagnostic {
            range: place.range,
            severity: Some(match d.severity {
                Severity::Error => lsp::DiagnosticSeverity::Error,
                Severity::Warning => lsp::DiagnosticSeverity::Warning,
                Severity::Note => lsp::DiagnosticSeverity::Information,
            }),
            code: Some(lsp::Code::String(d.code.to_string())),
            source: Some("hsd".to_owned()),
            message: lsp::Message::String(message(d, language)),
            related_information: (!related.is_empty()).then_some(related),
            ..lsp::Diagnostic::default()
        };
        Some((place.uri.to_string(), made))
    }

    /// Changes of texts; each stands at a span.
    pub(super) fn edits(&self, edits: &[diagnostic::Edit]) -> Option<Changes> {
        let mut changes = Changes::default();
        for edit in edits {
            let place = self.span(edit.span)?;
            changes.add(place, self.version(edit.span.file), edit.text.clone());
        }
        Some(changes)
    }
}

fn in_document(document: &Document, range: &ops::Range<usize>, encoding: Encoding) -> lsp::Range {
    let mark = document.mark();
    let range = range.start + mark..range.end + mark;
    document.lines.range(&document.text, &range, encoding)
}

/// What an editor shows of a message: what is wrong, and in a line of its own how to mend it.
fn message(d: &diagnostic::Diagnostic, language: Language) -> String {
    let (message, help) = (&d.message, &d.help);
    let whole = match help.is_empty() {
        true => message.clone(),
        false => text!([message, help] "{message}\nhelp: {help}", "{message}\n対処: {help}"),
    };
    whole.in_language(language).to_owned()
}

/// Changes of several texts, in the order of their names.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Changes {
    texts: BTreeMap<String, (Option<i32>, Vec<lsp::TextEdit>)>,
}

impl Changes {
    /// Adds one.
    pub(super) fn add(&mut self, place: lsp::Location, version: Option<i32>, new_text: String) {
        let entry = self.texts.entry(place.uri.to_string());
        let range = place.range;
        let (_, edits) = entry.or_insert_with(|| (version, vec![]));
        edits.push(lsp::TextEdit { range, new_text });
    }

    /// Adds one that is not there yet.
    pub(super) fn add_new(&mut self, place: lsp::Location, version: Option<i32>, text: String) {
        let there = self.texts.get(place.uri.as_ref());
        let same = |e: &lsp::TextEdit| e.range == place.range && e.new_text == text;
        if !there.is_some_and(|(_, edits)| edits.iter().any(same)) {
            self.add(place, version, text);
        }
    }

    /// As the client can take them.
    pub(super) fn finish(self, versions: bool) -> lsp::WorkspaceEdit {
        if !versions {
            let texts = self.texts.into_iter();
            let changes: HashMap<_, _> = texts
                .map(|(uri, (_, edits))| (lsp::Uri::from(uri), edits))
                .collect();
            return lsp::WorkspaceEdit {
                changes: Some(changes),
                ..lsp::WorkspaceEdit::default()
            };
        }
        let texts = self.texts.into_iter();
        let changes = texts.map(|(uri, (version, edits))| {
            let text_document = lsp::OptionalVersionedTextDocumentIdentifier {
                version,
                text_document_identifier: lsp::TextDocumentIdentifier {
                    uri: lsp::Uri::from(uri),
                },
            };
            let edits = edits.into_iter().map(lsp::Edit::TextEdit).collect();
            lsp::DocumentChange::TextDocumentEdit(lsp::TextDocumentEdit {
                text_document,
                edits,
            })
        });
        lsp::WorkspaceEdit {
            document_changes: Some(changes.collect()),
            ..lsp::WorkspaceEdit::default()
        }
    }
}
