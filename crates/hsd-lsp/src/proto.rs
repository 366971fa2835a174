//! Conversion of locations, diagnostics and edits to protocol types.

use super::documents::{Document, Documents};
use super::lines::{Encoding, Lines};
use super::uri;
use gen_lsp_types as lsp;
use hsd_base::diagnostic::{self, Language, Severity};
use hsd_base::source::{FileId, Source, Span};
use hsd_base::text;
use hsd_ide::Analysis;
use hsd_syntax::templates::Template;
use std::cell::OnceCell;
use std::collections::{BTreeMap, HashMap};
use std::ops;
use std::path::Path;

/// The files of one analysis, open or on disk, for conversion of locations.
pub(super) struct Places<'a> {
    document: &'a Document,
    analysis: &'a Analysis,
    encoding: Encoding,
    files: BTreeMap<FileId, File<'a>>,
}

/// An included file.
struct File<'a> {
    uri: String,
    source: &'a Source,
    /// The open document of the file, if any.
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
        // No editor can open a type of the library.
        let included = included.filter(|source| !Template::is_source(source.name()));
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

    /// Returns the URI of a file.
    pub(super) fn uri(&self, file: FileId) -> Option<&str> {
        if file == self.analysis.source.id() {
            return Some(&self.document.uri);
        }
        self.files.get(&file).map(|f| &*f.uri)
    }

    /// Returns the version of a file that is open.
    pub(super) fn version(&self, file: FileId) -> Option<i32> {
        if file == self.analysis.source.id() {
            return Some(self.document.version);
        }
        self.files.get(&file)?.open.map(|d| d.version)
    }

    /// Converts a range of offsets in a file.
    pub(super) fn range(&self, file: FileId, range: &ops::Range<usize>) -> Option<lsp::Range> {
        if file == self.analysis.source.id() {
            return Some(self.range_here(range));
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

    /// Converts a range of offsets in the document itself.
    pub(super) fn range_here(&self, range: &ops::Range<usize>) -> lsp::Range {
        in_document(self.document, range, self.encoding)
    }

    /// Converts an offset in the document itself.
    pub(super) fn position(&self, at: usize) -> lsp::Position {
        self.range_here(&(at..at)).start
    }

    /// Returns a location in any of the files.
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

    /// Converts a span.
    pub(super) fn span(&self, span: Span) -> Option<lsp::Location> {
        let source = self.analysis.file(span.file)?;
        self.location(span.file, &source.text_range(span))
    }

    /// Converts a diagnostic; returns it with the URI of its file.
    pub(super) fn diagnostic(
        &self,
        d: &diagnostic::Diagnostic,
        language: Language,
    ) -> Option<(String, lsp::Diagnostic)> {
        let place = self.analysis.place_of(d).and_then(|span| self.span(span));
        let place = match place {
            Some(place) => place,
            // No place of the document is to blame, but somewhere it must stand.
            None => self.location(self.analysis.source.id(), &(0..0))?,
        };
        let related = d.labels.iter().filter_map(|label| {
            Some(lsp::DiagnosticRelatedInformation {
                location: self.span(label.span)?,
                message: label.message.in_language(language).into_owned(),
            })
        });
        let related: Vec<_> = related.collect();
        let converted = lsp::Diagnostic {
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
        Some((place.uri.to_string(), converted))
    }

    /// Converts edits.
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

/// Returns the message of a diagnostic, followed by a line with its help.
fn message(d: &diagnostic::Diagnostic, language: Language) -> String {
    let (message, help) = (&d.full_message(), &d.help);
    let whole = match help.is_empty() {
        true => message,
        false => &text!([message, help] "{message}\nhelp: {help}", "{message}\n対処: {help}"),
    };
    whole.in_language(language).into_owned()
}

/// Edits of several files, ordered by URI.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Changes {
    texts: BTreeMap<String, (Option<i32>, Vec<lsp::TextEdit>)>,
}

impl Changes {
    /// Adds an edit.
    pub(super) fn add(&mut self, place: lsp::Location, version: Option<i32>, new_text: String) {
        let entry = self.texts.entry(place.uri.to_string());
        let range = place.range;
        let (_, edits) = entry.or_insert_with(|| (version, vec![]));
        edits.push(lsp::TextEdit { range, new_text });
    }

    /// Adds an edit unless it is present already.
    pub(super) fn add_new(&mut self, place: lsp::Location, version: Option<i32>, text: String) {
        let there = self.texts.get(place.uri.as_ref());
        let same = |e: &lsp::TextEdit| e.range == place.range && e.new_text == text;
        if !there.is_some_and(|(_, edits)| edits.iter().any(same)) {
            self.add(place, version, text);
        }
    }

    /// Converts the edits to the format that the client supports.
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
