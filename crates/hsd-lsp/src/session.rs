//! The state of a client connection, and the messages sent to the client.

use super::client::Client;
use super::documents::Documents;
use super::preview::{Previews, RequestSender};
use super::publish::Published;
use super::settings::Settings;
use super::towns::Towns;
use super::transport::bytes;
use super::uri;
use gen_lsp_types as lsp;
use hsd_base::diagnostic::Language;
use lsp_server::{Connection, ErrorCode, Message, Notification, Request, RequestId, Response};
use serde::Serialize;
use serde_json::value::RawValue;
use serde_json::{Value, json};
use std::sync::Arc;
use std::sync::mpsc::Sender;

/// A client, its documents and settings.
pub(super) struct Session {
    pub(super) connection: Connection,
    /// The writer of serialized messages, if the connection is a stream.
    written: Option<Sender<Vec<u8>>>,
    pub(super) client: Client,
    pub(super) documents: Documents,
    pub(super) settings: Settings,
    pub(super) published: Published,
    pub(super) previews: Previews,
    pub(super) towns: Towns,
    /// The default language, if the client names none.
    locale: Language,
}

impl Session {
    pub(super) fn new(
        connection: Connection,
        written: Option<Sender<Vec<u8>>>,
        locale: Language,
    ) -> Session {
        Session {
            connection,
            written,
            client: Client::default(),
            documents: Documents::default(),
            settings: Settings::new(locale),
            published: Published::default(),
            previews: Previews::default(),
            towns: Towns::default(),
            locale,
        }
    }

    /// Applies settings; all documents are analysed again if they have changed.
    pub(super) fn configure(&mut self, values: &Value) {
        let locale = self.client.language.unwrap_or(self.locale);
        let settings = Settings::read(values, locale, self.client.folder.as_ref());
        if settings != self.settings {
            self.settings = settings;
            self.documents.forget_all();
            if self.client.refreshes_hints {
                self.ask("hsd/hints", "workspace/inlayHint/refresh", Value::Null);
            }
        }
    }

    /// Shows the position of the cursor in the preview.
    pub(super) fn show_cursor(&self, place: &lsp::TextDocumentPositionParams) {
        let uri = place.text_document.uri.as_ref();
        let path = uri::to_path(uri);
        if let (Some(document), Some(path)) = (self.documents.get(uri), path) {
            let (text, encoding) = (&document.text, self.client.encoding);
            let at = document.lines.offset(text, place.position, encoding);
            self.previews
                .cursor(&path, at.saturating_sub(document.mark()));
        }
    }

    /// Returns a function that sends requests to the client from other threads.
    pub(super) fn request_sender(&self) -> RequestSender {
        match self.written.clone() {
            Some(written) => Arc::new(move |request| {
                let mut bytes = vec![];
                let _ = Message::from(request).write(&mut bytes);
                let _ = written.send(bytes);
            }),
            None => {
                let sender = self.connection.sender.clone();
                Arc::new(move |request| {
                    let _ = sender.send(request.into());
                })
            }
        }
    }

    /// Analyses a document if it has changed, and publishes its diagnostics; those of a town once it is checked with its
    /// maps too.
    pub(super) fn refresh(&mut self, uri: &str) {
        if !self.documents.analyse(uri, &self.settings) {
            return;
        }
        match self.documents.town(uri, &self.settings) {
            Some(job) => self.towns.start(job),
            None => self.publish_document(uri),
        }
    }

    /// Takes over the results of checked towns.
    pub(super) fn take_towns(&mut self) {
        while let Some((uri, made)) = self.towns.take() {
            let is_current = made.is_none_or(|made| self.documents.add_town(made));
            if is_current {
                self.publish_document(&uri);
            }
        }
    }

    /// Publishes the diagnostics of a document.
    fn publish_document(&mut self, uri: &str) {
        let (encoding, language) = (self.client.encoding, self.settings.language);
        if let Some(document) = self.documents.get(uri) {
            let published = &mut self.published;
            let reports = published.take(&self.documents, document, encoding, language);
            self.publish(reports);
        }
    }

    pub(super) fn publish(&self, reports: Vec<lsp::PublishDiagnosticsParams>) {
        for params in reports {
            self.notify("textDocument/publishDiagnostics", params);
        }
    }

    pub(super) fn notify(&self, method: &str, params: impl Serialize) {
        match &self.written {
            Some(written) => {
                let message = OutgoingNotification {
                    jsonrpc: VERSION,
                    method,
                    params,
                };
                let _ = written.send(bytes(&message));
            }
            None => self.send(Notification::new(method.to_owned(), params)),
        }
    }

    pub(super) fn answer(&self, id: RequestId, result: &RawValue) {
        match &self.written {
            Some(written) => {
                let message = OutgoingResponse {
                    jsonrpc: VERSION,
                    id,
                    result,
                };
                let _ = written.send(bytes(&message));
            }
            None => {
                let result: Value = serde_json::from_str(result.get()).unwrap_or_default();
                self.send(Response::new_ok(id, result));
            }
        }
    }

    /// Answers a malformed message, whose ID is unknown.
    pub(super) fn reply_parse_error(&self, why: &str) {
        let error = json!({ "code": ErrorCode::ParseError as i32, "message": why });
        if let Some(written) = &self.written {
            let message = json!({ "jsonrpc": VERSION, "id": null, "error": error });
            let _ = written.send(bytes(&message));
        }
    }

    pub(super) fn ask(&self, id: &str, method: &str, params: Value) {
        let id = RequestId::from(id.to_owned());
        self.send(Request::new(id, method.to_owned(), params));
    }

    pub(super) fn refuse(&self, id: RequestId, code: ErrorCode, why: &str) {
        self.send(Response::new_err(id, code as i32, why.to_owned()));
    }

    /// Sends a message. Errors are ignored: the client may have disconnected.
    pub(super) fn send(&self, message: impl Into<Message>) {
        let message = message.into();
        let _ = match &self.written {
            Some(written) => {
                let mut bytes = vec![];
                let _ = message.write(&mut bytes);
                written.send(bytes).is_ok()
            }
            None => self.connection.sender.send(message).is_ok(),
        };
    }
}

/// The version of JSON-RPC.
const VERSION: &str = "2.0";

/// A notification, serialized without an intermediate value.
#[derive(Serialize)]
struct OutgoingNotification<'m, P> {
    jsonrpc: &'static str,
    method: &'m str,
    params: P,
}

/// A response with a serialized result.
#[derive(Serialize)]
struct OutgoingResponse<'m> {
    jsonrpc: &'static str,
    id: RequestId,
    result: &'m RawValue,
}
