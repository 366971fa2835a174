//! What each request gets: positions to offsets, a question to [`ide`], and its answer back.

use super::actions::{self, Manner};
use super::documents::Document;
use super::lines::Encoding;
use super::proto::{Changes, Places};
use super::server::Server;
use super::uri;
use crate::diagnostic::Text;
use crate::ide::{self, Analysis};
use crate::source::FileId;
use crate::{text, view};
use gen_lsp_types as lsp;
use lsp_server::ErrorCode;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::value::{RawValue, to_raw_value};
use serde_json::{Value, json};
use std::ops::Range;

mod complete;
mod tokens;

/// A refusal and its reason.
type Refused = (ErrorCode, String);
type Answer<T> = Result<T, Refused>;

/// The command that shows a text in the live preview: its URI, and whether the server shall open the page.
const VIEW: &str = "hsd.view";

/// What the server can do.
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
pub(super) fn answer(server: &mut Server, method: &str, params: Value) -> Answer<Box<RawValue>> {
    match method {
        "textDocument/completion" => run(server, params, complete::completion),
        "completionItem/resolve" => run(server, params, complete::resolve),
        "textDocument/hover" => run(server, params, hover),
        "textDocument/definition" => run(server, params, definition),
        "textDocument/references" => run(server, params, references),
        "textDocument/documentHighlight" => run(server, params, highlights),
        "textDocument/documentSymbol" => run(server, params, symbols),
        "textDocument/codeAction" => run(server, params, code_actions),
        "textDocument/formatting" => run(server, params, formatting),
        "textDocument/rangeFormatting" => run(server, params, range_formatting),
        "textDocument/prepareRename" => run(server, params, prepare_rename),
        "textDocument/rename" => run(server, params, rename),
        "textDocument/foldingRange" => run(server, params, folding),
        "textDocument/selectionRange" => run(server, params, selection),
        "textDocument/semanticTokens/full" => run(server, params, tokens::full),
        "textDocument/semanticTokens/range" => run(server, params, tokens::range),
        "textDocument/inlayHint" => run(server, params, inlay_hints),
        "workspace/executeCommand" => run(server, params, execute),
        _ => Err((
            ErrorCode::MethodNotFound,
            format!("{method}: not known here"),
        )),
    }
}

/// Reads the parameters, works, writes the result: as text at once, since a tree of it would take longer than all the rest.
fn run<P: DeserializeOwned, R: Serialize>(
    server: &mut Server,
    params: Value,
    work: fn(&mut Server, P) -> Answer<R>,
) -> Answer<Box<RawValue>> {
    let params = serde_json::from_value(params);
    let params = params.map_err(|e| (ErrorCode::InvalidParams, e.to_string()))?;
    let result = work(server, params)?;
    to_raw_value(&result).map_err(|e| (ErrorCode::InternalError, e.to_string()))
}

/// An open text with all that is known of it.
struct View<'s> {
    document: &'s Document,
    analysis: &'s Analysis,
    places: Places<'s>,
    encoding: Encoding,
}

impl Server {
    /// An open text, read if it has changed; `None` where it is not open.
    fn view(&mut self, text: &lsp::TextDocumentIdentifier) -> Option<View<'_>> {
        let uri = text.uri.as_ref();
        self.refresh(uri);
        let encoding = self.client.encoding;
        let document = self.documents.get(uri)?;
        let analysis = document.analysis.as_ref()?;
        Some(View {
            document,
            analysis,
            places: Places::new(&self.documents, document, analysis, encoding),
            encoding,
        })
    }
}

impl View<'_> {
    /// The offset of a position, as [`ide`] counts.
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

    fn text_edits(&self, edits: Vec<ide::format::Edit>) -> Vec<lsp::TextEdit> {
        let edits = edits.into_iter().map(|e| lsp::TextEdit {
            range: self.places.own(&e.range),
            new_text: e.text,
        });
        edits.collect()
    }
}

fn hover(server: &mut Server, params: lsp::HoverParams) -> Answer<Option<lsp::Hover>> {
    let (language, pictures) = (server.settings.language, server.settings.pictures);
    let place = params.text_document_position_params;
    let Some(view) = server.view(&place.text_document) else {
        return Ok(None);
    };
    let at = view.offset(place.position);
    let found = ide::hover::hover(view.analysis, at, language, pictures);
    Ok(found.map(|hover| lsp::Hover {
        range: Some(view.places.own(&hover.range)),
        contents: lsp::Contents::MarkupContent(lsp::MarkupContent {
            kind: lsp::MarkupKind::Markdown,
            value: hover.markdown,
        }),
    }))
}

fn definition(server: &mut Server, params: lsp::DefinitionParams) -> Answer<Vec<lsp::Location>> {
    let place = params.text_document_position_params;
    let Some(view) = server.view(&place.text_document) else {
        return Ok(vec![]);
    };
    let at = view.offset(place.position);
    let found = ide::names::definition(view.analysis, at).into_iter();
    let found = found.filter_map(|p| view.places.location(p.file, &p.range));
    Ok(found.collect())
}

/// The uses in all open texts.
fn references(server: &mut Server, params: lsp::ReferenceParams) -> Answer<Vec<lsp::Location>> {
    let place = params.text_document_position_params;
    let uri = place.text_document.uri.to_string();
    let Some(view) = server.view(&place.text_document) else {
        return Ok(vec![]);
    };
    let at = view.offset(place.position);
    let declared = params.context.include_declaration;
    let found = ide::names::references(view.analysis, at, declared);
    let symbol = ide::names::symbol_at(view.analysis, at);
    let locate = |places: &Places<'_>, found: Vec<ide::Place>| -> Vec<lsp::Location> {
        let found = found.into_iter();
        found
            .filter_map(|p| places.location(p.file, &p.range))
            .collect()
    };
    let mut all = locate(&view.places, found);
    let Some(symbol) = symbol else {
        return Ok(all);
    };
    for uri in server.others(&uri) {
        if let Some(view) = server.view(&uri) {
            let found = ide::names::uses_of(view.analysis, &symbol);
            for location in locate(&view.places, found) {
                if !all.contains(&location) {
                    all.push(location);
                }
            }
        }
    }
    Ok(all)
}

impl Server {
    /// The open texts but one.
    fn others(&self, uri: &str) -> Vec<lsp::TextDocumentIdentifier> {
        let others = self.documents.iter().filter(|d| d.uri != uri);
        let named = others.map(|d| lsp::TextDocumentIdentifier {
            uri: lsp::Uri::from(d.uri.clone()),
        });
        named.collect()
    }
}

fn highlights(
    server: &mut Server,
    params: lsp::DocumentHighlightParams,
) -> Answer<Vec<lsp::DocumentHighlight>> {
    let place = params.text_document_position_params;
    // Clients ask this wherever the cursor comes to rest.
    server.point(&place);
    let Some(view) = server.view(&place.text_document) else {
        return Ok(vec![]);
    };
    let at = view.offset(place.position);
    let found = ide::names::highlights(view.analysis, at).into_iter();
    let made = found.map(|(range, written)| lsp::DocumentHighlight {
        range: view.places.own(&range),
        kind: Some(match written {
            true => lsp::DocumentHighlightKind::Write,
            false => lsp::DocumentHighlightKind::Read,
        }),
    });
    Ok(made.collect())
}

/// Shows a text in the live preview; returns the address of the page.
fn execute(server: &mut Server, params: lsp::ExecuteCommandParams) -> Answer<String> {
    if params.command != VIEW {
        let why = format!("{}: not known here", params.command);
        return Err((ErrorCode::InvalidParams, why));
    }
    let failed = |why: &Text| {
        let why = why.in_language(server.settings.language).to_owned();
        (ErrorCode::RequestFailed, why)
    };
    if !view::there() {
        return Err(failed(&view::how_to_get_it()));
    }
    let given = params.arguments.unwrap_or_default();
    let uri = given.first().and_then(Value::as_str).unwrap_or_default();
    let Some(path) = uri::to_path(uri) else {
        return Err(failed(&text!(
            "save the text in a file first",
            "先にテキストをファイルに保存してください"
        )));
    };
    let (documents, settings) = (&server.documents, &server.settings);
    let (client, say) = (&server.client, server.say());
    let shown = server
        .previews
        .show(&path, documents, settings, (client, &say));
    let url = shown.map_err(|e| (ErrorCode::RequestFailed, e.to_string()))?;
    if server.client.shows_documents && given.get(1) != Some(&Value::Bool(false)) {
        let page = json!({ "uri": url, "external": true });
        server.ask("hsd/page", "window/showDocument", page);
    }
    Ok(url)
}

fn symbols(
    server: &mut Server,
    params: lsp::DocumentSymbolParams,
) -> Answer<Vec<lsp::DocumentSymbol>> {
    let Some(view) = server.view(&params.text_document) else {
        return Ok(vec![]);
    };
    let found = ide::symbols::symbols(view.analysis);
    Ok(found.into_iter().map(|s| symbol(&view, s)).collect())
}

fn symbol(view: &View<'_>, from: ide::symbols::Symbol) -> lsp::DocumentSymbol {
    use ide::symbols::SymbolKind as Kind;
    let children = from.children.into_iter().map(|c| symbol(view, c));
    #[expect(deprecated)] // the field has to be given all the same
    lsp::DocumentSymbol {
        name: from.name,
        detail: (!from.detail.is_empty()).then_some(from.detail),
        kind: match from.kind {
            Kind::House => lsp::SymbolKind::Class,
            Kind::Storey => lsp::SymbolKind::Namespace,
            Kind::Row | Kind::Loop => lsp::SymbolKind::Array,
            Kind::Facade => lsp::SymbolKind::Interface,
            Kind::Roof => lsp::SymbolKind::Event,
            Kind::Piece => lsp::SymbolKind::Function,
            Kind::Parameter => lsp::SymbolKind::Variable,
            Kind::Value => lsp::SymbolKind::Constant,
            Kind::Part => lsp::SymbolKind::EnumMember,
            Kind::File => lsp::SymbolKind::File,
            Kind::Fitting => lsp::SymbolKind::Property,
        },
        tags: None,
        deprecated: None,
        range: view.places.own(&from.range),
        selection_range: view.places.own(&from.selection),
        children: Some(children.collect()),
    }
}

fn code_actions(
    server: &mut Server,
    params: lsp::CodeActionParams,
) -> Answer<Vec<lsp::CodeAction>> {
    let uri = params.text_document.uri.to_string();
    server.refresh(&uri);
    let only = params.context.only;
    let only = only.map(|kinds| kinds.iter().map(ToString::to_string).collect::<Vec<_>>());
    let manner = Manner {
        encoding: server.client.encoding,
        settings: &server.settings,
        versions: server.client.versions,
    };
    let documents = &server.documents;
    Ok(actions::actions(
        documents,
        &uri,
        params.range,
        only.as_deref(),
        manner,
    ))
}

fn formatting(
    server: &mut Server,
    params: lsp::DocumentFormattingParams,
) -> Answer<Option<Vec<lsp::TextEdit>>> {
    let Some(view) = server.view(&params.text_document) else {
        return Ok(None);
    };
    let edits = ide::format::format(view.analysis);
    Ok(edits.map(|e| view.text_edits(e)))
}

fn range_formatting(
    server: &mut Server,
    params: lsp::DocumentRangeFormattingParams,
) -> Answer<Option<Vec<lsp::TextEdit>>> {
    let Some(view) = server.view(&params.text_document) else {
        return Ok(None);
    };
    let edits = ide::format::format_range(view.analysis, view.offsets(params.range));
    Ok(edits.map(|e| view.text_edits(e)))
}

fn prepare_rename(
    server: &mut Server,
    params: lsp::PrepareRenameParams,
) -> Answer<Option<lsp::PrepareRenamePlaceholder>> {
    let place = params.text_document_position_params;
    let Some(view) = server.view(&place.text_document) else {
        return Ok(None);
    };
    let found = ide::names::prepare_rename(view.analysis, view.offset(place.position));
    Ok(
        found.map(|(range, placeholder)| lsp::PrepareRenamePlaceholder {
            range: view.places.own(&range),
            placeholder,
        }),
    )
}

/// A rename in all open texts that mean the same by the name.
fn rename(server: &mut Server, params: lsp::RenameParams) -> Answer<lsp::WorkspaceEdit> {
    let place = params.text_document_position_params;
    let (language, versions) = (server.settings.language, server.client.versions);
    let uri = place.text_document.uri.to_string();
    let Some(view) = server.view(&place.text_document) else {
        let why = format!("{uri}: not open");
        return Err((ErrorCode::InvalidParams, why));
    };
    let (at, new) = (view.offset(place.position), &*params.new_name);
    let mut changes = Changes::default();
    let refuse = |why: crate::diagnostic::Text| {
        let why = why.in_language(language).to_owned();
        (ErrorCode::RequestFailed, why)
    };
    let edits = ide::names::rename(view.analysis, at, new).map_err(refuse)?;
    changes.extend(&view.places, edits);
    let symbol = ide::names::symbol_at(view.analysis, at);
    let others = symbol.as_ref().map(|_| server.others(&uri));
    for other in others.into_iter().flatten() {
        let (Some(view), Some(symbol)) = (server.view(&other), &symbol) else {
            continue;
        };
        let edits = ide::names::rename_symbol(view.analysis, symbol, new).map_err(refuse)?;
        changes.extend(&view.places, edits);
    }
    Ok(changes.finish(versions))
}

impl Changes {
    /// Adds changes that are not there yet: a file may be changed for each text that includes it.
    fn extend(&mut self, places: &Places<'_>, edits: Vec<(FileId, Range<usize>, String)>) {
        for (file, range, text) in edits {
            if let Some(location) = places.location(file, &range) {
                self.add_new(location, places.version(file), text);
            }
        }
    }
}

fn folding(server: &mut Server, params: lsp::FoldingRangeParams) -> Answer<Vec<lsp::FoldingRange>> {
    use ide::folding::FoldKind as Kind;
    let Some(view) = server.view(&params.text_document) else {
        return Ok(vec![]);
    };
    let folds = ide::folding::folds(view.analysis).into_iter();
    let made = folds.map(|fold| {
        let range = view.places.own(&fold.range);
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
    Ok(made.filter(|f| f.start_line < f.end_line).collect())
}

fn selection(
    server: &mut Server,
    params: lsp::SelectionRangeParams,
) -> Answer<Vec<lsp::SelectionRange>> {
    let Some(view) = server.view(&params.text_document) else {
        return Ok(vec![]);
    };
    let positions = params.positions.into_iter();
    let chains = positions.map(|position| {
        let ranges = ide::selection::selection(view.analysis, view.offset(position));
        let mut parent = None;
        for range in ranges.iter().rev() {
            let range = view.places.own(range);
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

fn inlay_hints(server: &mut Server, params: lsp::InlayHintParams) -> Answer<Vec<lsp::InlayHint>> {
    let (language, wanted) = (server.settings.language, server.settings.inlay_hints);
    let Some(view) = server.view(&params.text_document).filter(|_| wanted) else {
        return Ok(vec![]);
    };
    let range = view.offsets(params.range);
    let hints = ide::inlay::inlays(view.analysis, range, language).into_iter();
    let made = hints.map(|hint| lsp::InlayHint {
        position: view.places.position(hint.at),
        label: lsp::Label::String(hint.label),
        kind: None,
        text_edits: None,
        tooltip: Some(lsp::Tooltip::String(
            hint.tooltip.in_language(language).to_owned(),
        )),
        padding_left: Some(true),
        padding_right: None,
        data: None,
    });
    Ok(made.collect())
}
