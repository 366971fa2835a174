//! The loop: takes messages in, answers them, reads what has changed.

use super::client::Client;
use super::documents::Documents;
use super::preview::{Previews, Say};
use super::publish::Published;
use super::requests;
use super::settings::Settings;
use super::transport::{BROKEN, bytes};
use super::uri;
use super::world::key;
use crate::diagnostic::Language;
use gen_lsp_types as lsp;
use lsp_server::{Connection, ErrorCode, Message, Notification, Request, RequestId, Response};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::value::RawValue;
use serde_json::{Value, json};
use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::mpsc::Sender;

/// The number of the request for settings.
const SETTINGS: &str = "hsd/settings";

/// How far a client has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    /// `initialize` has not come.
    New,
    /// Served.
    Running,
    /// `shutdown` has come.
    Over,
}

/// One client and its texts.
pub(super) struct Server {
    connection: Connection,
    /// Where messages go as bytes, if they do.
    written: Option<Sender<Vec<u8>>>,
    /// Messages that came and are not answered yet.
    queue: VecDeque<Message>,
    phase: Phase,
    pub(super) client: Client,
    pub(super) documents: Documents,
    pub(super) settings: Settings,
    published: Published,
    pub(super) previews: Previews,
    /// Of the machine, where the client has none.
    locale: Language,
}

impl Server {
    pub(super) fn new(
        connection: Connection,
        written: Option<Sender<Vec<u8>>>,
        locale: Language,
    ) -> Server {
        Server {
            connection,
            written,
            queue: VecDeque::new(),
            phase: Phase::New,
            client: Client::default(),
            documents: Documents::default(),
            settings: Settings::new(locale),
            published: Published::default(),
            previews: Previews::default(),
            locale,
        }
    }

    /// Serves until `exit` or the end of the stream; says whether `shutdown` came before.
    pub(super) fn run(mut self) -> bool {
        loop {
            self.drain();
            self.previews.follow(&self.documents, &self.settings);
            let message = match self.queue.pop_front() {
                Some(message) => message,
                None => match self.documents.stale().map(str::to_owned) {
                    Some(uri) => {
                        self.keep_up(&uri);
                        continue;
                    }
                    None => match self.connection.receiver.recv() {
                        Ok(message) => {
                            self.enqueue(message);
                            continue;
                        }
                        Err(_) => return self.phase == Phase::Over,
                    },
                },
            };
            match message {
                Message::Request(request) => self.request(request),
                Message::Notification(note) if note.method == "exit" => {
                    return self.phase == Phase::Over;
                }
                Message::Notification(note) => self.notification(note),
                Message::Response(response) => self.response(response),
            }
        }
    }

    /// Takes in all messages that wait.
    fn drain(&mut self) {
        while let Ok(message) = self.connection.receiver.try_recv() {
            self.enqueue(message);
        }
    }

    /// Takes in a message. A request that is cancelled before its turn is answered at once.
    fn enqueue(&mut self, message: Message) {
        let Message::Notification(note) = &message else {
            return self.queue.push_back(message);
        };
        if note.method != "$/cancelRequest" {
            return self.queue.push_back(message);
        }
        let Ok(id) = serde_json::from_value::<RequestId>(note.params["id"].clone()) else {
            return;
        };
        let same = |m: &Message| matches!(m, Message::Request(r) if r.id == id);
        if let Some(index) = self.queue.iter().position(same) {
            self.queue.remove(index);
            self.refuse(id, ErrorCode::RequestCanceled, "cancelled");
        }
    }

    /// Answers a request.
    fn request(&mut self, request: Request) {
        let Request { id, method, params } = request;
        match (self.phase, &*method) {
            (Phase::New, "initialize") => self.initialize(id, &params),
            (Phase::New, _) => {
                self.refuse(id, ErrorCode::ServerNotInitialized, "not initialized");
            }
            (Phase::Over, _) => self.refuse(id, ErrorCode::InvalidRequest, "shut down"),
            (Phase::Running, "initialize") => {
                self.refuse(id, ErrorCode::InvalidRequest, "initialized already");
            }
            (Phase::Running, "shutdown") => {
                self.phase = Phase::Over;
                self.send(Response::new_ok(id, Value::Null));
            }
            (Phase::Running, method) => {
                // A fault of the program ends this request and no other.
                let answer =
                    catch_unwind(AssertUnwindSafe(|| requests::answer(self, method, params)));
                match answer {
                    Ok(Ok(result)) => self.answer(id, &result),
                    Ok(Err((code, why))) => self.refuse(id, code, &why),
                    Err(_) => {
                        let why = format!("{method}: a fault of the program");
                        self.refuse(id, ErrorCode::InternalError, &why);
                    }
                }
            }
        }
    }

    fn initialize(&mut self, id: RequestId, params: &Value) {
        self.client = Client::read(params);
        self.phase = Phase::Running;
        self.configure(&params["initializationOptions"]);
        let capabilities = requests::capabilities(self.client.encoding);
        let about = json!({
            "capabilities": capabilities,
            "serverInfo": { "name": "hsd", "version": env!("CARGO_PKG_VERSION") },
        });
        self.send(Response::new_ok(id, about));
    }

    /// Takes over wishes; everything is read anew where they differ.
    fn configure(&mut self, said: &Value) {
        let locale = self.client.language.unwrap_or(self.locale);
        let settings = Settings::read(said, locale, self.client.folder.as_ref());
        if settings != self.settings {
            self.settings = settings;
            self.documents.forget_all();
            if self.client.refreshes_hints {
                self.ask("hsd/hints", "workspace/inlayHint/refresh", Value::Null);
            }
        }
    }

    fn response(&mut self, response: Response) {
        if response.id == RequestId::from(SETTINGS.to_owned())
            && let Ok(Value::Array(list)) = &response.response_result
            && let Some(said) = list.first().filter(|v| v.is_object())
        {
            self.configure(&said.clone());
        }
    }

    fn notification(&mut self, note: Notification) {
        if note.method == BROKEN {
            return self.misunderstood(note.params.as_str().unwrap_or_default());
        }
        if self.phase != Phase::Running {
            return;
        }
        let work = AssertUnwindSafe(|| self.take(&note.method, note.params));
        if catch_unwind(work).is_err() {
            self.regret();
        }
    }

    /// Reads a text that has changed. Where the program fails over it, it waits for the next change.
    fn keep_up(&mut self, uri: &str) {
        if catch_unwind(AssertUnwindSafe(|| self.refresh(uri))).is_err() {
            self.documents.give_up(uri);
            self.regret();
        }
    }

    fn regret(&self) {
        let message = json!({ "type": 1, "message": "hsd: a fault of the program" });
        self.notify("window/logMessage", message);
    }

    fn take(&mut self, method: &str, params: Value) {
        match method {
            "initialized" => self.initialized(),
            "textDocument/didOpen" => {
                if let Some(p) = read::<lsp::DidOpenTextDocumentParams>(params) {
                    let text = p.text_document;
                    self.documents
                        .open(text.uri.to_string(), text.version, text.text);
                }
            }
            "textDocument/didChange" => {
                if let Some(p) = read::<lsp::DidChangeTextDocumentParams>(params) {
                    let uri = p.text_document.text_document_identifier.uri.to_string();
                    let (version, encoding) = (p.text_document.version, self.client.encoding);
                    self.documents
                        .edit(&uri, version, p.content_changes, encoding);
                }
            }
            "textDocument/didClose" => {
                if let Some(p) = read::<lsp::DidCloseTextDocumentParams>(params) {
                    let uri = p.text_document.uri.to_string();
                    if self.documents.close(&uri).is_some() {
                        let shown = self.published.close(&uri, &self.documents);
                        self.publish(shown);
                    }
                }
            }
            "hsd/cursor" => {
                if let Some(p) = read::<lsp::TextDocumentPositionParams>(params) {
                    self.point(&p);
                }
            }
            "workspace/didChangeWatchedFiles" => {
                if let Some(p) = read::<lsp::DidChangeWatchedFilesParams>(params) {
                    self.watched(&p.changes);
                }
            }
            "workspace/didChangeConfiguration" => {
                let said = &params["settings"]["hsd"];
                if said.is_object() {
                    self.configure(said);
                } else if self.client.configuration {
                    self.ask_for_settings();
                }
            }
            _ => {}
        }
    }

    fn initialized(&mut self) {
        if self.client.configuration {
            self.ask_for_settings();
        }
        if self.client.watches {
            let watchers = json!([{ "globPattern": "**/*.{hsd,png,jpg,jpeg,PNG,JPG,JPEG}" }]);
            let method = "workspace/didChangeWatchedFiles";
            let registration = json!({ "registrations": [{
                "id": "hsd-files",
                "method": method,
                "registerOptions": { "watchers": watchers },
            }] });
            self.ask("hsd/watch", "client/registerCapability", registration);
        }
    }

    fn ask_for_settings(&mut self) {
        let wanted = json!({ "items": [{ "section": "hsd" }] });
        self.ask(SETTINGS, "workspace/configuration", wanted);
    }

    /// Files were changed by others. Pictures are looked up by name in folders: they may concern anybody.
    fn watched(&mut self, changes: &[lsp::FileEvent]) {
        for change in changes {
            let path = uri::to_path(change.uri.as_ref());
            match path.filter(|p| p.extension().is_some_and(|e| e == "hsd")) {
                Some(path) => self.documents.forget(&key(&path)),
                None => self.documents.forget_all(),
            }
        }
    }

    /// The cursor stands at a place: what is built of it lights up in the preview.
    pub(super) fn point(&self, place: &lsp::TextDocumentPositionParams) {
        let uri = place.text_document.uri.as_ref();
        let path = uri::to_path(uri);
        if let (Some(document), Some(path)) = (self.documents.get(uri), path) {
            let (text, encoding) = (&document.text, self.client.encoding);
            let at = document.lines.offset(text, place.position, encoding);
            self.previews
                .cursor(&path, at.saturating_sub(document.mark()));
        }
    }

    /// How threads beside the loop speak to the client.
    pub(super) fn say(&self) -> Say {
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

    /// Reads a text that has changed, and shows what is wrong with it.
    pub(super) fn refresh(&mut self, uri: &str) {
        if !self.documents.analyse(uri, &self.settings) {
            return;
        }
        let (encoding, language) = (self.client.encoding, self.settings.language);
        if let Some(document) = self.documents.get(uri) {
            let published = &mut self.published;
            let shown = published.take(&self.documents, document, encoding, language);
            self.publish(shown);
        }
    }

    fn publish(&self, shown: Vec<lsp::PublishDiagnosticsParams>) {
        for params in shown {
            self.notify("textDocument/publishDiagnostics", params);
        }
    }

    fn notify(&self, method: &str, params: impl Serialize) {
        match &self.written {
            Some(written) => {
                let message = Note {
                    jsonrpc: VERSION,
                    method,
                    params,
                };
                let _ = written.send(bytes(&message));
            }
            None => self.send(Notification::new(method.to_owned(), params)),
        }
    }

    fn answer(&self, id: RequestId, result: &RawValue) {
        match &self.written {
            Some(written) => {
                let message = Answer {
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

    /// Answers what is no message: nobody knows its number.
    fn misunderstood(&self, why: &str) {
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

    fn refuse(&self, id: RequestId, code: ErrorCode, why: &str) {
        self.send(Response::new_err(id, code as i32, why.to_owned()));
    }

    /// Says something; a client that is gone hears nothing.
    fn send(&self, message: impl Into<Message>) {
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

/// The version of the protocol below this one.
const VERSION: &str = "2.0";

/// A notification whose parameters are written as they are.
#[derive(Serialize)]
struct Note<'m, P> {
    jsonrpc: &'static str,
    method: &'m str,
    params: P,
}

/// A response whose result is written already.
#[derive(Serialize)]
struct Answer<'m> {
    jsonrpc: &'static str,
    id: RequestId,
    result: &'m RawValue,
}

/// What a notification says; one that makes no sense is passed over.
fn read<P: DeserializeOwned>(params: Value) -> Option<P> {
    serde_json::from_value(params).ok()
}
