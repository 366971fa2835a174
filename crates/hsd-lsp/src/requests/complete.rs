//! Completion. Cards and images of parts are produced only for the selected item.

use super::{DocumentView, RequestResult};
use crate::documents::Document;
use crate::session::Session;
use gen_lsp_types as lsp;
use hsd_ide::complete::{self as ide, CompletionKind as Kind, PartKey};
use serde_json::{Value, json};
use std::path::Path;

/// Limits of file completion: number of files, folder depth, and number of directory entries read.
const FILES: usize = 1000;
const DEEP: usize = 3;
const NAMES: usize = 20_000;

pub(super) fn completion(
    session: &mut Session,
    params: lsp::CompletionParams,
) -> RequestResult<lsp::CompletionList> {
    let place = params.text_document_position_params;
    let (language, client) = (session.settings.language, &session.client);
    let (snippets, details) = (client.snippets, client.label_details);
    let mut list = lsp::CompletionList {
        // Matching depends on the typed text, in any script.
        is_incomplete: true,
        item_defaults: None,
        apply_kind: None,
        items: vec![],
    };
    let Some(view) = session.document_view(&place.text_document) else {
        return Ok(list);
    };
    let files = sibling_files(view.document);
    let found = ide::complete(view.analysis, view.offset(place.position), &files);
    let uri = &view.document.uri;
    let items = found.into_iter().map(|c| {
        let data = c.part.as_ref();
        let data = data.map(|part| json!({ "uri": uri, "part": part.code }));
        let (text, format) = match c.snippet.clone().filter(|_| snippets) {
            Some(snippet) => (snippet, lsp::InsertTextFormat::Snippet),
            None => (c.insert.clone(), lsp::InsertTextFormat::PlainText),
        };
        let detail = c.detail.in_language(language).into_owned();
        // Shows the name of a part in every row of the list.
        let label_details = details.then(|| lsp::CompletionItemLabelDetails {
            detail: None,
            description: Some(detail.clone()),
        });
        lsp::CompletionItem {
            label_details,
            detail: Some(detail),
            kind: Some(kind(c.kind)),
            sort_text: Some(c.sort.clone()),
            filter_text: Some(c.filter.clone()),
            insert_text_format: Some(format),
            text_edit: Some(lsp::CompletionItemTextEdit::TextEdit(edit(&view, &c, text))),
            data,
            label: c.label,
            ..lsp::CompletionItem::default()
        }
    });
    list.items = items.collect();
    Ok(list)
}

fn edit(view: &DocumentView<'_>, from: &ide::Completion, new_text: String) -> lsp::TextEdit {
    lsp::TextEdit {
        range: view.places.range_here(&from.replace),
        new_text,
    }
}

fn kind(kind: Kind) -> lsp::CompletionItemKind {
    use lsp::CompletionItemKind as To;
    match kind {
        Kind::Part => To::EnumMember,
        Kind::OwnPart => To::Constant,
        Kind::Element | Kind::EndTag => To::Class,
        Kind::Attribute => To::Property,
        Kind::Value => To::Value,
        Kind::Name => To::Variable,
        Kind::Function => To::Function,
        Kind::Piece => To::Method,
        Kind::File => To::File,
        Kind::Key => To::Keyword,
        Kind::Turn => To::Operator,
        Kind::Reference => To::Reference,
    }
}

/// Adds the card of a part to a completion item.
pub(super) fn resolve(
    session: &mut Session,
    mut item: lsp::CompletionItem,
) -> RequestResult<lsp::CompletionItem> {
    let (language, pictures) = (session.settings.language, session.settings.pictures);
    let data = item
        .data
        .as_ref()
        .and_then(|d| serde_json::to_value(d).ok());
    let field = |key: &str| data.as_ref()?.get(key).and_then(Value::as_str);
    let (Some(uri), Some(code)) = (field("uri"), field("part")) else {
        return Ok(item);
    };
    let text = lsp::TextDocumentIdentifier {
        uri: lsp::Uri::from(uri.to_owned()),
    };
    let key = PartKey {
        code: code.to_owned(),
    };
    let card = session
        .document_view(&text)
        .and_then(|view| ide::documentation(view.analysis, &key, language, pictures));
    item.documentation = card.map(|value| {
        lsp::Documentation::MarkupContent(lsp::MarkupContent {
            kind: lsp::MarkupKind::Markdown,
            value,
        })
    });
    Ok(item)
}

/// Returns a function that lists the files with an extension below the folder of a document, as relative paths.
fn sibling_files(document: &Document) -> impl Fn(&str) -> Vec<String> + use<> {
    let path = crate::uri::to_path(&document.uri);
    let folder = path.as_deref().and_then(Path::parent).map(Path::to_owned);
    move |ending: &str| {
        let mut list = FileList {
            ending,
            names: 0,
            found: vec![],
        };
        if let Some(folder) = &folder {
            list.add(folder, "", DEEP);
        }
        list.found.sort();
        list.found
    }
}

/// A recursive search for files with an extension.
struct FileList<'e> {
    ending: &'e str,
    /// The number of directory entries read.
    names: usize,
    found: Vec<String>,
}

impl FileList<'_> {
    /// Adds the files of a folder, then those of its subfolders; `before` is the prefix of their paths.
    fn add(&mut self, folder: &Path, before: &str, deep: usize) {
        let mut folders = vec![];
        let Ok(entries) = std::fs::read_dir(folder) else {
            return;
        };
        for entry in entries.flatten() {
            self.names += 1;
            if self.names > NAMES || self.found.len() >= FILES {
                return;
            }
            let Ok(name) = entry.file_name().into_string() else {
                continue;
            };
            if name.starts_with('.') {
                continue;
            }
            let path = format!("{before}{name}");
            // Links are not followed, because they may be circular.
            match entry.file_type() {
                Ok(kind) if kind.is_dir() && deep > 0 => {
                    folders.push((entry.path(), format!("{path}/")));
                }
                Ok(kind) if kind.is_file() => {
                    let own = Path::new(&name).extension();
                    if own.is_some_and(|e| e.eq_ignore_ascii_case(self.ending)) {
                        self.found.push(path);
                    }
                }
                _ => {}
            }
        }
        for (folder, before) in folders {
            self.add(&folder, &before, deep - 1);
        }
    }
}
