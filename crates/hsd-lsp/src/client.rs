//! Capabilities of the client.

use super::lines::Encoding;
use hsd_base::diagnostic::Language;
use serde_json::Value;
use std::path::PathBuf;

/// The relevant capabilities of a client. Unknown or malformed values are ignored.
#[derive(Clone, Debug, Default)]
pub(super) struct Client {
    /// The unit of columns.
    pub(super) encoding: Encoding,
    /// The language of the client, if known.
    pub(super) language: Option<Language>,
    /// The workspace folder.
    pub(super) folder: Option<PathBuf>,
    /// True if completions may be snippets.
    pub(super) snippets: bool,
    /// True if completion items can have label details.
    pub(super) label_details: bool,
    /// True if edits can be versioned.
    pub(super) versions: bool,
    /// True if settings can be requested.
    pub(super) configuration: bool,
    /// True if it can watch files.
    pub(super) watches: bool,
    /// True if inlay hints can be refreshed.
    pub(super) refreshes_hints: bool,
    /// True if it can apply edits.
    pub(super) applies_edits: bool,
    /// True if it can show documents.
    pub(super) shows_documents: bool,
}

impl Client {
    /// Reads the parameters of `initialize`.
    pub(super) fn read(params: &Value) -> Client {
        let can = |path: &str| {
            let found = params["capabilities"].pointer(path);
            found.and_then(Value::as_bool).unwrap_or(false)
        };
        let encodings = params["capabilities"].pointer("/general/positionEncodings");
        let encodings: Vec<String> = encodings
            .and_then(Value::as_array)
            .into_iter()
            .flatten()
            .filter_map(|e| e.as_str().map(str::to_owned))
            .collect();
        let locale = params["locale"].as_str();
        let folders = params["workspaceFolders"].as_array();
        let first = folders.and_then(|f| f.first()?["uri"].as_str());
        let root = first.or(params["rootUri"].as_str());
        Client {
            encoding: Encoding::choose(&encodings),
            language: locale.map(|l| match l.starts_with("ja") {
                true => Language::Japanese,
                false => Language::English,
            }),
            folder: root.and_then(super::uri::to_path),
            snippets: can("/textDocument/completion/completionItem/snippetSupport"),
            label_details: can("/textDocument/completion/completionItem/labelDetailsSupport"),
            versions: can("/workspace/workspaceEdit/documentChanges"),
            configuration: can("/workspace/configuration"),
            watches: can("/workspace/didChangeWatchedFiles/dynamicRegistration"),
            refreshes_hints: can("/workspace/inlayHint/refreshSupport"),
            applies_edits: can("/workspace/applyEdit"),
            shows_documents: can("/window/showDocument/support"),
        }
    }
}
