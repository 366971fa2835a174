//! What the client is able to do.

use super::lines::Encoding;
use crate::diagnostic::Language;
use serde_json::Value;
use std::path::PathBuf;

/// The abilities of a client that matter here. They are read leniently: what a client says in a way of its own does
/// not keep the server from serving it.
#[derive(Clone, Debug, Default)]
pub(super) struct Client {
    /// What columns count.
    pub(super) encoding: Encoding,
    /// Its language, if it says so.
    pub(super) language: Option<Language>,
    /// The folder it was opened on.
    pub(super) folder: Option<PathBuf>,
    /// Whether completions may hold places to jump to.
    pub(super) snippets: bool,
    /// Whether every row of a list of completions can say more than its label.
    pub(super) label_details: bool,
    /// Whether edits may name versions.
    pub(super) versions: bool,
    /// Whether it can be asked for settings.
    pub(super) configuration: bool,
    /// Whether it tells of changed files where it is asked to.
    pub(super) watches: bool,
    /// Whether inlay hints can be asked for anew.
    pub(super) refreshes_hints: bool,
    /// Whether it changes texts where it is asked to.
    pub(super) applies_edits: bool,
    /// Whether it can be sent to places.
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
