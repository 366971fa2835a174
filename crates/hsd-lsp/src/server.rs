//! The message loop: receives messages, answers them, and analyses changed documents.

use super::client::Client;
use super::requests;
use super::session::Session;
use super::transport::BROKEN;
use super::uri;
use super::world::key;
use gen_lsp_types as lsp;
use hsd_base::diagnostic::Language;
use lsp_server::{Connection, ErrorCode, Message, Notification, Request, RequestId, Response};
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::Sender;
use std::time::Duration;

/// The ID of the request for settings.
const SETTINGS: &str = "hsd/settings";

/// The files that the client watches: sources, images, tables and maps.
const WATCHED: &str = "**/*.{hsd,png,jpg,jpeg,PNG,JPG,JPEG,csv,geojson,geojsonl,json,shp,dbf,prj,cpg,gpkg,fgb,parquet,osm,pbf,xml,gml,tif,tiff,asc,txt,tsv,gz}";

/// How often the result of a town that is being checked is asked for.
const PATIENCE: Duration = Duration::from_millis(10);

/// The phase of the protocol.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    /// Before `initialize`.
    New,
    /// Between `initialize` and `shutdown`.
    Running,
    /// After `shutdown`.
    ShutDown,
}

/// The server of one client.
pub(super) struct Server {
    session: Session,
    /// Received messages that are not handled yet.
    queue: VecDeque<Message>,
    phase: Phase,
}

impl Server {
    pub(super) fn new(
        connection: Connection,
        written: Option<Sender<Vec<u8>>>,
        locale: Language,
    ) -> Server {
        Server {
            session: Session::new(connection, written, locale),
            queue: VecDeque::new(),
            phase: Phase::New,
        }
    }

    /// Serves until `exit` or the end of the stream; returns whether `shutdown` came before.
    pub(super) fn run(mut self) -> bool {
        loop {
            self.drain();
            self.session.take_towns();
            self.session
                .previews
                .follow(&self.session.documents, &self.session.settings);
            let message = match self.queue.pop_front() {
                Some(message) => message,
                None => match self.session.documents.stale().map(str::to_owned) {
                    Some(uri) => {
                        self.refresh_or_give_up(&uri);
                        continue;
                    }
                    None if self.receive() => continue,
                    None => return self.phase == Phase::ShutDown,
                },
            };
            match message {
                Message::Request(request) => self.request(request),
                Message::Notification(notification) if notification.method == "exit" => {
                    return self.phase == Phase::ShutDown;
                }
                Message::Notification(notification) => self.notification(notification),
                Message::Response(response) => self.response(response),
            }
        }
    }

    /// Waits for a message, or for a town that is being checked; returns false at the end of the stream.
    fn receive(&mut self) -> bool {
        let receiver = &self.session.connection.receiver;
        let message = match self.session.towns.is_busy() {
            true => match receiver.recv_timeout(PATIENCE) {
                Err(error) if error.is_timeout() => return true,
                other => other.ok(),
            },
            false => receiver.recv().ok(),
        };
        let is_open = message.is_some();
        message.into_iter().for_each(|m| self.enqueue(m));
        is_open
    }

    /// Receives all pending messages.
    fn drain(&mut self) {
        while let Ok(message) = self.session.connection.receiver.try_recv() {
            self.enqueue(message);
        }
    }

    /// Queues a message. A cancelled request that is still queued is answered immediately.
    fn enqueue(&mut self, message: Message) {
        let Message::Notification(notification) = &message else {
            return self.queue.push_back(message);
        };
        if notification.method != "$/cancelRequest" {
            return self.queue.push_back(message);
        }
        let Ok(id) = serde_json::from_value::<RequestId>(notification.params["id"].clone()) else {
            return;
        };
        let same = |m: &Message| matches!(m, Message::Request(r) if r.id == id);
        if let Some(index) = self.queue.iter().position(same) {
            self.queue.remove(index);
            self.session
                .refuse(id, ErrorCode::RequestCanceled, "cancelled");
        }
    }

    /// Answers a request.
    fn request(&mut self, request: Request) {
        let Request { id, method, params } = request;
        match (self.phase, &*method) {
            (Phase::New, "initialize") => self.initialize(id, &params),
            (Phase::New, _) => {
                self.session
                    .refuse(id, ErrorCode::ServerNotInitialized, "not initialized");
            }
            (Phase::ShutDown, _) => self
                .session
                .refuse(id, ErrorCode::InvalidRequest, "shut down"),
            (Phase::Running, "initialize") => {
                self.session
                    .refuse(id, ErrorCode::InvalidRequest, "already initialized");
            }
            (Phase::Running, "shutdown") => {
                self.phase = Phase::ShutDown;
                self.session.send(Response::new_ok(id, Value::Null));
            }
            (Phase::Running, method) => {
                // A panic fails only this request.
                let answer = catch_unwind(AssertUnwindSafe(|| {
                    requests::answer(&mut self.session, method, params)
                }));
                match answer {
                    Ok(Ok(result)) => self.session.answer(id, &result),
                    Ok(Err((code, why))) => self.session.refuse(id, code, &why),
                    Err(_) => {
                        let why = format!("{method}: internal error");
                        self.session.refuse(id, ErrorCode::InternalError, &why);
                    }
                }
            }
        }
    }

    fn initialize(&mut self, id: RequestId, params: &Value) {
        self.session.client = Client::read(params);
        self.phase = Phase::Running;
        self.session.configure(&params["initializationOptions"]);
        let capabilities = requests::capabilities(self.session.client.encoding);
        let result = json!({
            "capabilities": capabilities,
            "serverInfo": { "name": "hsd", "version": env!("CARGO_PKG_VERSION") },
        });
        self.session.send(Response::new_ok(id, result));
    }

    fn response(&mut self, response: Response) {
        if response.id == RequestId::from(SETTINGS.to_owned())
            && let Ok(Value::Array(list)) = &response.response_result
            && let Some(values) = list.first().filter(|v| v.is_object())
        {
            self.session.configure(&values.clone());
        }
    }

    fn notification(&mut self, notification: Notification) {
        if notification.method == BROKEN {
            return self
                .session
                .reply_parse_error(notification.params.as_str().unwrap_or_default());
        }
        if self.phase != Phase::Running {
            return;
        }
        let work = AssertUnwindSafe(|| self.handle(&notification.method, notification.params));
        if catch_unwind(work).is_err() {
            self.log_internal_error();
        }
    }

    /// Analyses a changed document. After a panic it is not analysed again until it changes.
    fn refresh_or_give_up(&mut self, uri: &str) {
        if catch_unwind(AssertUnwindSafe(|| self.session.refresh(uri))).is_err() {
            self.session.documents.give_up(uri);
            self.log_internal_error();
        }
    }

    fn log_internal_error(&self) {
        let message = json!({ "type": 1, "message": "hsd: internal error" });
        self.session.notify("window/logMessage", message);
    }

    fn handle(&mut self, method: &str, params: Value) {
        match method {
            "initialized" => self.initialized(),
            "textDocument/didOpen" => {
                if let Some(p) = read::<lsp::DidOpenTextDocumentParams>(params) {
                    let text = p.text_document;
                    self.session
                        .documents
                        .open(text.uri.to_string(), text.version, text.text);
                }
            }
            "textDocument/didChange" => {
                if let Some(p) = read::<lsp::DidChangeTextDocumentParams>(params) {
                    let uri = p.text_document.text_document_identifier.uri.to_string();
                    let (version, encoding) =
                        (p.text_document.version, self.session.client.encoding);
                    self.session
                        .documents
                        .edit(&uri, version, p.content_changes, encoding);
                }
            }
            "textDocument/didClose" => {
                if let Some(p) = read::<lsp::DidCloseTextDocumentParams>(params) {
                    let uri = p.text_document.uri.to_string();
                    if self.session.documents.close(&uri).is_some() {
                        let reports = self.session.published.close(&uri, &self.session.documents);
                        self.session.publish(reports);
                    }
                }
            }
            "hsd/cursor" => {
                if let Some(p) = read::<lsp::TextDocumentPositionParams>(params) {
                    self.session.show_cursor(&p);
                }
            }
            "workspace/didChangeWatchedFiles" => {
                if let Some(p) = read::<lsp::DidChangeWatchedFilesParams>(params) {
                    self.watched(&p.changes);
                }
            }
            "workspace/didChangeConfiguration" => {
                let values = &params["settings"]["hsd"];
                if values.is_object() {
                    self.session.configure(values);
                } else if self.session.client.configuration {
                    self.ask_for_settings();
                }
            }
            _ => {}
        }
    }

    fn initialized(&mut self) {
        if self.session.client.configuration {
            self.ask_for_settings();
        }
        if self.session.client.watches {
            let watchers = json!([{ "globPattern": WATCHED }]);
            let method = "workspace/didChangeWatchedFiles";
            let registration = json!({ "registrations": [{
                "id": "hsd-files",
                "method": method,
                "registerOptions": { "watchers": watchers },
            }] });
            self.session
                .ask("hsd/watch", "client/registerCapability", registration);
        }
    }

    fn ask_for_settings(&mut self) {
        let wanted = json!({ "items": [{ "section": "hsd" }] });
        self.session
            .ask(SETTINGS, "workspace/configuration", wanted);
    }

    /// Handles changed files. Images are searched by name in folders, so they may affect any document.
    fn watched(&mut self, changes: &[lsp::FileEvent]) {
        for change in changes {
            let path = uri::to_path(change.uri.as_ref());
            match path.filter(|p| p.extension().is_some_and(|e| e == "hsd")) {
                Some(path) => self.session.documents.forget(&key(&path)),
                None => self.session.documents.forget_all(),
            }
        }
    }
}

/// Parses the parameters of a notification; `None` if they are invalid.
fn read<P: DeserializeOwned>(params: Value) -> Option<P> {
    serde_json::from_value(params).ok()
}
