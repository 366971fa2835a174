//! Request handlers: convert positions to offsets, query [`ide`] and convert the result.

use super::actions::{self, ActionContext};
use super::documents::Document;
use super::lines::Encoding;
use super::proto::{Changes, Places};
use super::session::Session;
use super::uri;
use gen_lsp_types as lsp;
use hsd_base::diagnostic::Text;
use hsd_base::source::FileId;
use hsd_base::text;
use hsd_ide::Analysis;
use lsp_server::ErrorCode;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::value::{RawValue, to_raw_value};
use serde_json::{Value, json};
use std::ops::Range;

mod complete;
mod symbols;
mod tokens;

/// An error code and its message.
type RequestError = (ErrorCode, String);
type RequestResult<T> = Result<T, RequestError>;

/// The command that shows a document in the live preview. Its arguments are the URI, and whether the server opens the page.
const VIEW: &str = "hsd.view";

/// Returns the capabilities of the server.
pub(super) fn capabilities(encoding: Encoding) -> Value {
    json!({
        "positionEncoding": encoding.name(),
        "textDocumentSync": { "openClose": true, "change": 2, "save": false },
        "completionProvider": {
            "triggerCharacters": ["<", " ", "\"", "'", "/", "{", "="],
            "resolveProvider": true,
        },
        "hoverProvider": true,
        "definitionProvider": true,
        "referencesProvider": true,
        "documentHighlightProvider": true,
        "documentSymbolProvider": true,
        "codeActionProvider": { "codeActionKinds": ["quickfix", actions::ALL] },
        "documentFormattingProvider": true,
        "documentRangeFormattingProvider": true,
        "renameProvider": { "prepareProvider": true },
        "foldingRangeProvider": true,
        "selectionRangeProvider": true,
        "semanticTokensProvider": {
            "legend": tokens::legend(),
            "full": true,
            "range": true,
        },
        "inlayHintProvider": true,
        "executeCommandProvider": { "commands": [VIEW] },
    })
}

/// Answers a request.
pub(super) fn answer(
    session: &mut Session,
    method: &str,
    params: Value,
) -> RequestResult<Box<RawValue>> {
    match method {
        "textDocument/completion" => run(session, params, complete::completion),
        "completionItem/resolve" => run(session, params, complete::resolve),
        "textDocument/hover" => run(session, params, hover),
        "textDocument/definition" => run(session, params, definition),
        "textDocument/references" => run(session, params, references),
        "textDocument/documentHighlight" => run(session, params, highlights),
        "textDocument/documentSymbol" => run(session, params, symbols::symbols),
        "textDocument/codeAction" => run(session, params, code_actions),
        "textDocument/formatting" => run(session, params, formatting),
        "textDocument/rangeFormatting" => run(session, params, range_formatting),
        "textDocument/prepareRename" => run(session, params, prepare_rename),
        "textDocument/rename" => run(session, params, rename),
        "textDocument/foldingRange" => run(session, params, folding),
        "textDocument/selectionRange" => run(session, params, selection),
        "textDocument/semanticTokens/full" => run(session, params, tokens::full),
        "textDocument/semanticTokens/range" => run(session, params, tokens::range),
        "textDocument/inlayHint" => run(session, params, inlay_hints),
        "workspace/executeCommand" => run(session, params, execute),
        _ => Err((
            ErrorCode::MethodNotFound,
            format!("{method}: unknown method"),
        )),
    }
}

/// Parses the parameters, runs a handler and serializes the result, without an intermediate value for speed.
fn run<P: DeserializeOwned, R: Serialize>(
    session: &mut Session,
    params: Value,
    work: fn(&mut Session, P) -> RequestResult<R>,
) -> RequestResult<Box<RawValue>> {
    let params = serde_json::from_value(params);
    let params = params.map_err(|e| (ErrorCode::InvalidParams, e.to_string()))?;
    let result = work(session, params)?;
    to_raw_value(&result).map_err(|e| (ErrorCode::InternalError, e.to_string()))
}

/// An open document with its analysis.
struct DocumentView<'s> {
    document: &'s Document,
    analysis: &'s Analysis,
    places: Places<'s>,
    encoding: Encoding,
}

impl Session {
    /// Returns an open document, analysed if it has changed; `None` if it is not open.
    fn document_view(&mut self, text: &lsp::TextDocumentIdentifier) -> Option<DocumentView<'_>> {
        let uri = text.uri.as_ref();
        self.refresh(uri);
        let encoding = self.client.encoding;
        let document = self.documents.get(uri)?;
        let analysis = document.analysis.as_ref()?;
        Some(DocumentView {
            document,
            analysis,
            places: Places::new(&self.documents, document, analysis, encoding),
            encoding,
        })
    }
}

impl DocumentView<'_> {
    /// Returns the offset of a position in the text of the analysis.
    fn offset(&self, position: lsp::Position) -> usize {
        let document = self.document;
        let lines = &document.lines;
        let at = lines.offset(&document.text, position, self.encoding);
        at.saturating_sub(document.mark())
    }

    fn offsets(&self, range: lsp::Range) -> Range<usize> {
        let start = self.offset(range.start);
        start..self.offset(range.end).max(start)
    }

    fn text_edits(&self, edits: Vec<hsd_ide::format::Edit>) -> Vec<lsp::TextEdit> {
        let edits = edits.into_iter().map(|e| lsp::TextEdit {
            range: self.places.range_here(&e.range),
            new_text: e.text,
        });
        edits.collect()
    }
}

fn hover(session: &mut Session, params: lsp::HoverParams) -> RequestResult<Option<lsp::Hover>> {
    let (language, pictures) = (session.settings.language, session.settings.pictures);
    let place = params.text_document_position_params;
    let Some(document) = session.document_view(&place.text_document) else {
        return Ok(None);
    };
    let at = document.offset(place.position);
    let found = hsd_ide::hover::hover(document.analysis, at, language, pictures);
    Ok(found.map(|hover| lsp::Hover {
        range: Some(document.places.range_here(&hover.range)),
        contents: lsp::Contents::MarkupContent(lsp::MarkupContent {
            kind: lsp::MarkupKind::Markdown,
            value: hover.markdown,
        }),
    }))
}

fn definition(
    session: &mut Session,
    params: lsp::DefinitionParams,
) -> RequestResult<Vec<lsp::Location>> {
    let place = params.text_document_position_params;
    let Some(document) = session.document_view(&place.text_document) else {
        return Ok(vec![]);
    };
    let at = document.offset(place.position);
    let found = hsd_ide::names::definition(document.analysis, at).into_iter();
    let found = found.filter_map(|p| document.places.location(p.file, &p.range));
    Ok(found.collect())
}

/// Returns the uses in all open documents.
fn references(
    session: &mut Session,
    params: lsp::ReferenceParams,
) -> RequestResult<Vec<lsp::Location>> {
    let place = params.text_document_position_params;
    let uri = place.text_document.uri.to_string();
    let Some(document) = session.document_view(&place.text_document) else {
        return Ok(vec![]);
    };
    let at = document.offset(place.position);
    let declared = params.context.include_declaration;
    let found = hsd_ide::names::references(document.analysis, at, declared);
    let symbol = hsd_ide::names::symbol_at(document.analysis, at);
    let locate = |places: &Places<'_>, found: Vec<hsd_ide::SourcePlace>| -> Vec<lsp::Location> {
        let found = found.into_iter();
        found
            .filter_map(|p| places.location(p.file, &p.range))
            .collect()
    };
    let mut all = locate(&document.places, found);
    let Some(symbol) = symbol else {
        return Ok(all);
    };
    for uri in session.others(&uri) {
        if let Some(document) = session.document_view(&uri) {
            let found = hsd_ide::names::uses_of(document.analysis, &symbol);
            for location in locate(&document.places, found) {
                if !all.contains(&location) {
                    all.push(location);
                }
            }
        }
    }
    Ok(all)
}

impl Session {
    /// Returns all open documents except one.
    fn others(&self, uri: &str) -> Vec<lsp::TextDocumentIdentifier> {
        let others = self.documents.iter().filter(|d| d.uri != uri);
        let named = others.map(|d| lsp::TextDocumentIdentifier {
            uri: lsp::Uri::from(d.uri.clone()),
        });
        named.collect()
    }
}

fn highlights(
    session: &mut Session,
    params: lsp::DocumentHighlightParams,
) -> RequestResult<Vec<lsp::DocumentHighlight>> {
    let place = params.text_document_position_params;
    // Clients send this request whenever the cursor rests.
    session.show_cursor(&place);
    let Some(document) = session.document_view(&place.text_document) else {
        return Ok(vec![]);
    };
    let at = document.offset(place.position);
    let found = hsd_ide::names::highlights(document.analysis, at).into_iter();
    let converted = found.map(|(range, written)| lsp::DocumentHighlight {
        range: document.places.range_here(&range),
        kind: Some(match written {
            true => lsp::DocumentHighlightKind::Write,
            false => lsp::DocumentHighlightKind::Read,
        }),
    });
    Ok(converted.collect())
}

/// Shows a document in the live preview; returns the address of the page.
fn execute(session: &mut Session, params: lsp::ExecuteCommandParams) -> RequestResult<String> {
    if params.command != VIEW {
        let why = format!("{}: unknown command", params.command);
        return Err((ErrorCode::InvalidParams, why));
    }
    let failed = |why: &Text| {
        let why = why.in_language(session.settings.language).into_owned();
        (ErrorCode::RequestFailed, why)
    };
    if !hsd_view::is_built() {
        return Err(failed(&hsd_view::how_to_build()));
    }
    let given = params.arguments.unwrap_or_default();
    let uri = given.first().and_then(Value::as_str).unwrap_or_default();
    let Some(path) = uri::to_path(uri) else {
        return Err(failed(&text!(
            "save the document to a file first",
            "先にテキストをファイルに保存してください"
        )));
    };
    let (documents, settings) = (&session.documents, &session.settings);
    let (client, sender) = (&session.client, session.request_sender());
    let shown = session
        .previews
        .show(&path, documents, settings, (client, &sender));
    let url = shown.map_err(|e| (ErrorCode::RequestFailed, e.to_string()))?;
    if session.client.shows_documents && given.get(1) != Some(&Value::Bool(false)) {
        let page = json!({ "uri": url, "external": true });
        session.ask("hsd/page", "window/showDocument", page);
    }
    Ok(url)
}

fn code_actions(
    session: &mut Session,
    params: lsp::CodeActionParams,
) -> RequestResult<Vec<lsp::CodeAction>> {
    let uri = params.text_document.uri.to_string();
    session.refresh(&uri);
    let only = params.context.only;
    let only = only.map(|kinds| kinds.iter().map(ToString::to_string).collect::<Vec<_>>());
    let context = ActionContext {
        encoding: session.client.encoding,
        settings: &session.settings,
        versions: session.client.versions,
    };
    let documents = &session.documents;
    Ok(actions::actions(
        documents,
        &uri,
        params.range,
        only.as_deref(),
        context,
    ))
}

fn formatting(
    session: &mut Session,
    params: lsp::DocumentFormattingParams,
) -> RequestResult<Option<Vec<lsp::TextEdit>>> {
    let Some(document) = session.document_view(&params.text_document) else {
        return Ok(None);
    };
    let edits = hsd_ide::format::format(document.analysis);
    Ok(edits.map(|e| document.text_edits(e)))
}

fn range_formatting(
    session: &mut Session,
    params: lsp::DocumentRangeFormattingParams,
) -> RequestResult<Option<Vec<lsp::TextEdit>>> {
    let Some(document) = session.document_view(&params.text_document) else {
        return Ok(None);
    };
    let edits = hsd_ide::format::format_range(document.analysis, document.offsets(params.range));
    Ok(edits.map(|e| document.text_edits(e)))
}

fn prepare_rename(
    session: &mut Session,
    params: lsp::PrepareRenameParams,
) -> RequestResult<Option<lsp::PrepareRenamePlaceholder>> {
    let place = params.text_document_position_params;
    let Some(document) = session.document_view(&place.text_document) else {
        return Ok(None);
    };
    let found = hsd_ide::names::prepare_rename(document.analysis, document.offset(place.position));
    Ok(
        found.map(|(range, placeholder)| lsp::PrepareRenamePlaceholder {
            range: document.places.range_here(&range),
            placeholder,
        }),
    )
}

/// Renames a symbol in all open documents that share it.
fn rename(session: &mut Session, params: lsp::RenameParams) -> RequestResult<lsp::WorkspaceEdit> {
    let place = params.text_document_position_params;
    let (language, versions) = (session.settings.language, session.client.versions);
    let uri = place.text_document.uri.to_string();
    let Some(document) = session.document_view(&place.text_document) else {
        let why = format!("{uri}: not open");
        return Err((ErrorCode::InvalidParams, why));
    };
    let (at, new) = (document.offset(place.position), &*params.new_name);
    let mut changes = Changes::default();
    let refuse = |why: hsd_base::diagnostic::Text| {
        let why = why.in_language(language).into_owned();
        (ErrorCode::RequestFailed, why)
    };
    let edits = hsd_ide::names::rename(document.analysis, at, new).map_err(refuse)?;
    changes.extend(&document.places, edits);
    let symbol = hsd_ide::names::symbol_at(document.analysis, at);
    let others = symbol.as_ref().map(|_| session.others(&uri));
    for other in others.into_iter().flatten() {
        let (Some(document), Some(symbol)) = (session.document_view(&other), &symbol) else {
            continue;
        };
        let edits =
            hsd_ide::names::rename_symbol(document.analysis, symbol, new).map_err(refuse)?;
        changes.extend(&document.places, edits);
    }
    Ok(changes.finish(versions))
}

impl Changes {
    /// Adds edits that are not present yet: a file may be edited for each document that includes it.
    fn extend(&mut self, places: &Places<'_>, edits: Vec<(FileId, Range<usize>, String)>) {
        for (file, range, text) in edits {
            if let Some(location) = places.location(file, &range) {
                self.add_new(location, places.version(file), text);
            }
        }
    }
}

fn folding(
    session: &mut Session,
    params: lsp::FoldingRangeParams,
) -> RequestResult<Vec<lsp::FoldingRange>> {
    use hsd_ide::folding::FoldKind as Kind;
    let Some(document) = session.document_view(&params.text_document) else {
        return Ok(vec![]);
    };
    let folds = hsd_ide::folding::folds(document.analysis).into_iter();
    let converted = folds.map(|fold| {
        let range = document.places.range_here(&fold.range);
        lsp::FoldingRange {
            start_line: range.start.line,
            end_line: range.end.line,
            kind: Some(match fold.kind {
                Kind::Comment => lsp::FoldingRangeKind::Comment,
                Kind::Region => lsp::FoldingRangeKind::Region,
                Kind::Imports => lsp::FoldingRangeKind::Imports,
            }),
            ..lsp::FoldingRange::default()
        }
    });
    Ok(converted.filter(|f| f.start_line < f.end_line).collect())
}

fn selection(
    session: &mut Session,
    params: lsp::SelectionRangeParams,
) -> RequestResult<Vec<lsp::SelectionRange>> {
    let Some(document) = session.document_view(&params.text_document) else {
        return Ok(vec![]);
    };
    let positions = params.positions.into_iter();
    let chains = positions.map(|position| {
        let ranges = hsd_ide::selection::selection(document.analysis, document.offset(position));
        let mut parent = None;
        for range in ranges.iter().rev() {
            let range = document.places.range_here(range);
            parent = Some(Box::new(lsp::SelectionRange { range, parent }));
        }
        let here = lsp::Range {
            start: position,
            end: position,
        };
        parent.map_or(
            lsp::SelectionRange {
                range: here,
                parent: None,
            },
            |p| *p,
        )
    });
    Ok(chains.collect())
}

fn inlay_hints(
    session: &mut Session,
    params: lsp::InlayHintParams,
) -> RequestResult<Vec<lsp::InlayHint>> {
    let (language, wanted) = (session.settings.language, session.settings.inlay_hints);
    let Some(document) = session
        .document_view(&params.text_document)
        .filter(|_| wanted)
    else {
        return Ok(vec![]);
    };
    let range = document.offsets(params.range);
    let hints = hsd_ide::inlay::inlays(document.analysis, range, language).into_iter();
    let converted = hints.map(|hint| lsp::InlayHint {
        position: document.places.position(hint.at),
        label: lsp::Label::String(hint.label),
        kind: None,
        text_edits: None,
        tooltip: Some(lsp::Tooltip::String(
            hint.tooltip.in_language(language).into_owned(),
        )),
        padding_left: Some(true),
        padding_right: None,
        data: None,
    });
    Ok(converted.collect())
}
