//! Completion. Cards and pictures of parts are made for the one proposal that is looked at.

use super::{Answer, View};
use crate::ide::complete::{self as ide, CompletionKind as Kind, PartKey};
use crate::lsp::documents::Document;
use crate::lsp::server::Server;
use gen_lsp_types as lsp;
use serde_json::{Value, json};
use std::path::Path;

/// Files that are listed, how deep below the folder of a text, and how many names are looked at for them.
const FILES: usize = 1000;
const DEEP: usize = 3;
const NAMES: usize = 20_000;

pub(super) fn completion(
    server: &mut Server,
    params: lsp::CompletionParams,
) -> Answer<lsp::CompletionList> {
    let place = params.text_document_position_params;
    let (language, client) = (server.settings.language, &server.client);
    let (snippets, details) = (client.snippets, client.label_details);
    let mut list = lsp::CompletionList {
        // What fits depends on what was typed, in whatever script.
        is_incomplete: true,
        item_defaults: None,
        apply_kind: None,
        items: vec![],
    };
    let Some(view) = server.view(&place.text_document) else {
        return Ok(list);
    };
    let files = beside(view.document);
    let found = ide::complete(view.analysis, view.offset(place.position), &files);
    let uri = &view.document.uri;
    let items = found.into_iter().map(|c| {
        let data = c.part.as_ref();
        let data = data.map(|part| json!({ "uri": uri, "part": part.code }));
        let (text, format) = match c.snippet.clone().filter(|_| snippets) {
            Some(snippet) => (snippet, lsp::InsertTextFormat::Snippet),
            None => (c.insert.clone(), lsp::InsertTextFormat::PlainText),
        };
        let detail = c.detail.in_language(language).to_owned();
        // What a part is called is to be seen in every row of the list.
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

fn edit(view: &View<'_>, from: &ide::Completion, new_text: String) -> lsp::TextEdit {
    lsp::TextEdit {
        range: view.places.own(&from.replace),
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

/// Adds the card of the part that a proposal stands for.
pub(super) fn resolve(
    server: &mut Server,
    mut item: lsp::CompletionItem,
) -> Answer<lsp::CompletionItem> {
    let (language, pictures) = (server.settings.language, server.settings.pictures);
    let data = item
        .data
        .as_ref()
        .and_then(|d| serde_json::to_value(d).ok());
    let said = |key: &str| data.as_ref()?.get(key).and_then(Value::as_str);
    let (Some(uri), Some(code)) = (said("uri"), said("part")) else {
        return Ok(item);
    };
    let text = lsp::TextDocumentIdentifier {
        uri: lsp::Uri::from(uri.to_owned()),
    };
    let key = PartKey {
        code: code.to_owned(),
    };
    let card = server
        .view(&text)
        .and_then(|view| ide::documentation(view.analysis, &key, language, pictures));
    item.documentation = card.map(|value| {
        lsp::Documentation::MarkupContent(lsp::MarkupContent {
            kind: lsp::MarkupKind::Markdown,
            value,
        })
    });
    Ok(item)
}

/// Lists the files of an ending below the folder of a text, by their paths from there.
fn beside(document: &Document) -> impl Fn(&str) -> Vec<String> + use<> {
    let path = crate::lsp::uri::to_path(&document.uri);
    let folder = path.as_deref().and_then(Path::parent).map(Path::to_owned);
    move |ending: &str| {
        let mut list = List {
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

/// Files with an ending.
struct List<'e> {
    ending: &'e str,
    /// Names that were looked at.
    names: usize,
    found: Vec<String>,
}

impl List<'_> {
    /// Adds those of a folder, then those of the folders in it; `before` = what their paths begin with.
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
            // Links are not followed: they may lead round in circles.
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
