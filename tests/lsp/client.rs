//! A client that talks to a server in this process.

use hsd::diagnostic::Language;
use lsp_server::{Connection, Message, Notification, Request, RequestId, Response};
use serde_json::{Value, json};
use std::thread::JoinHandle;
use std::time::Duration;

/// A client, and the server in a thread of its own.
pub struct Client {
    connection: Connection,
    server: JoinHandle<bool>,
    last: i32,
    /// What the server said without being asked, oldest first.
    heard: Vec<Notification>,
}

impl Client {
    /// Starts a server, and says hello.
    pub fn start(encoding: &str) -> Client {
        let capabilities = json!({
            "general": { "positionEncodings": [encoding] },
            "workspace": { "workspaceEdit": { "documentChanges": true } },
            "textDocument": { "completion": { "completionItem": { "snippetSupport": true } } },
        });
        Client::with(json!({ "capabilities": capabilities, "locale": "en" }))
    }

    /// The same with these parameters of `initialize`.
    pub fn with(params: Value) -> Client {
        let mut client = Client::raw(vec![]);
        let about = client.request("initialize", params).expect("is answered");
        assert!(about["capabilities"].is_object(), "{about}");
        client.notify("initialized", json!({}));
        client
    }

    /// A server to which these messages were said before it listened.
    pub fn raw(said: Vec<Message>) -> Client {
        let (server, connection) = Connection::memory();
        for message in said {
            connection.sender.send(message).expect("is there");
        }
        // As much as the main thread of a process has.
        let thread = std::thread::Builder::new().stack_size(8 << 20);
        let server = thread.spawn(|| hsd::lsp::serve_on(server, Language::English));
        Client {
            connection,
            server: server.expect("threads can be had"),
            last: 0,
            heard: vec![],
        }
    }

    pub fn notify(&self, method: &str, params: Value) {
        let note = Notification::new(method.to_owned(), params);
        self.connection.sender.send(note.into()).expect("is there");
    }

    /// Sends a request without waiting for its answer.
    pub fn ask(&mut self, method: &str, params: Value) -> RequestId {
        self.last += 1;
        let id = RequestId::from(self.last);
        let request = Request::new(id.clone(), method.to_owned(), params);
        self.connection
            .sender
            .send(request.into())
            .expect("is there");
        id
    }

    /// The answer to a request, or its error.
    pub fn request(&mut self, method: &str, params: Value) -> Result<Value, (i32, String)> {
        let id = self.ask(method, params);
        self.answer(&id)
    }

    pub fn answer(&mut self, id: &RequestId) -> Result<Value, (i32, String)> {
        loop {
            match self.next() {
                Message::Response(Response {
                    id: of,
                    response_result,
                }) if of == *id => {
                    return response_result.map_err(|e| (e.code, e.message));
                }
                Message::Response(other) => panic!("an answer to nothing: {other:?}"),
                Message::Notification(note) => self.heard.push(note),
                Message::Request(_) => {}
            }
        }
    }

    fn next(&mut self) -> Message {
        let wait = Duration::from_secs(60);
        let message = self.connection.receiver.recv_timeout(wait);
        message.expect("the server answers within a minute")
    }

    /// Opens a text.
    pub fn open(&self, uri: &str, text: &str) {
        let document = json!({ "uri": uri, "languageId": "hsd", "version": 1, "text": text });
        self.notify("textDocument/didOpen", json!({ "textDocument": document }));
    }

    /// Changes a text.
    pub fn change(&self, uri: &str, version: i32, changes: Value) {
        let document = json!({ "uri": uri, "version": version });
        let params = json!({ "textDocument": document, "contentChanges": changes });
        self.notify("textDocument/didChange", params);
    }

    pub fn close(&self, uri: &str) {
        let document = json!({ "uri": uri });
        self.notify("textDocument/didClose", json!({ "textDocument": document }));
    }

    /// What the server next says is wrong with a text.
    pub fn diagnostics(&mut self, uri: &str, version: Option<i32>) -> Vec<Value> {
        let fits = |n: &Notification| {
            n.method == "textDocument/publishDiagnostics"
                && n.params["uri"] == uri
                && version.is_none_or(|v| n.params["version"] == v)
        };
        loop {
            if let Some(at) = self.heard.iter().position(fits) {
                let note = self.heard.remove(at);
                let list = note.params["diagnostics"].as_array().cloned();
                return list.expect("is a list");
            }
            match self.next() {
                Message::Notification(note) => self.heard.push(note),
                Message::Response(other) => panic!("an answer to nothing: {other:?}"),
                Message::Request(_) => {}
            }
        }
    }

    /// Forgets what was said of texts so far.
    pub fn forget(&mut self) {
        self.heard.clear();
    }

    /// Says good-bye; whether the server took it well.
    pub fn finish(mut self) -> bool {
        let answer = self.request("shutdown", Value::Null);
        assert_eq!(answer, Ok(Value::Null));
        self.notify("exit", Value::Null);
        self.server.join().expect("the server does not panic")
    }
}

/// A position as the protocol counts, found without the server's help.
pub fn position(text: &str, at: usize, encoding: &str) -> Value {
    let (mut line, mut column) = (0, 0);
    let mut rest = text[..at].chars().peekable();
    while let Some(c) = rest.next() {
        // A carriage return at the very end of what stands before may have its line feed behind it.
        let pair = c == '\r' && rest.peek().copied().or(text[at..].chars().next()) == Some('\n');
        match c {
            '\n' => (line, column) = (line + 1, 0),
            '\r' if !pair => (line, column) = (line + 1, 0),
            c => {
                column += match encoding {
                    "utf-8" => c.len_utf8(),
                    "utf-16" => c.len_utf16(),
                    _ => 1,
                }
            }
        }
    }
    json!({ "line": line, "character": column })
}

pub fn range(text: &str, range: std::ops::Range<usize>, encoding: &str) -> Value {
    let start = position(text, range.start, encoding);
    json!({ "start": start, "end": position(text, range.end, encoding) })
}
