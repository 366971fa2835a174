//! The program `hsd lsp` in a process of its own, and one who talks to it; the bench talks to it too.

use serde_json::{Value, json};
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// Attempts, ten per second, before a program that does not end is killed.
const ATTEMPTS: usize = 600;

pub struct Program {
    child: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
}

impl Program {
    pub fn start() -> Program {
        let mut command = Command::new(env!("CARGO_BIN_EXE_hsd"));
        command.args(["lsp", "--stdio"]).stdin(Stdio::piped());
        let mut child = command
            .stdout(Stdio::piped())
            .spawn()
            .expect("the program runs");
        let input = child.stdin.take().expect("is piped");
        let output = BufReader::new(child.stdout.take().expect("is piped"));
        Program {
            child,
            input,
            output,
        }
    }

    pub fn raw(&mut self, bytes: &[u8]) {
        self.input.write_all(bytes).expect("the program listens");
        self.input.flush().expect("the program listens");
    }

    pub fn say(&mut self, message: Value) {
        let body = message.to_string();
        self.raw(format!("Content-Length: {}\r\n\r\n{body}", body.len()).as_bytes());
    }

    pub fn notify(&mut self, method: &str, params: Value) {
        self.say(json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    pub fn hear(&mut self) -> Value {
        let mut length = 0;
        loop {
            let mut line = String::new();
            self.output
                .read_line(&mut line)
                .expect("the program speaks");
            assert!(!line.is_empty(), "the program has ended");
            match line.trim_end().split_once(": ") {
                Some(("Content-Length", number)) => length = number.parse().expect("a number"),
                _ => break,
            }
        }
        let mut body = vec![0; length];
        self.output
            .read_exact(&mut body)
            .expect("the program speaks");
        serde_json::from_slice(&body).expect("is JSON")
    }

    pub fn ask(&mut self, id: i32, method: &str, params: Value) -> Value {
        self.say(json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }));
        loop {
            let heard = self.hear();
            if heard["id"] == id {
                return heard;
            }
        }
    }
    /// Opens a text, and waits for its diagnostics.
    pub fn open(&mut self, uri: &str, text: &str) {
        self.ask(
            1,
            "initialize",
            json!({ "capabilities": {}, "processId": null }),
        );
        self.notify("initialized", json!({}));
        let document = json!({ "uri": uri, "languageId": "hsd", "version": 1, "text": text });
        self.notify("textDocument/didOpen", json!({ "textDocument": document }));
        self.wait(1);
    }

    /// Changes a text, and waits for its diagnostics.
    pub fn change(&mut self, uri: &str, version: usize, changes: Value) {
        let document = json!({ "uri": uri, "version": version });
        let params = json!({ "textDocument": document, "contentChanges": changes });
        self.notify("textDocument/didChange", params);
        self.wait(version);
    }

    fn wait(&mut self, version: usize) {
        while self.hear()["params"]["version"] != version {}
    }

    /// Processor time and memory (KiB) of the program so far, where the system tells it.
    pub fn used(&self) -> Option<(Duration, u64)> {
        let id = self.child.id();
        let stat = fs::read_to_string(format!("/proc/{id}/stat")).ok()?;
        let mut fields = stat.rsplit_once(')')?.1.split_whitespace().skip(11);
        let mut ticks = || fields.next()?.parse::<u64>().ok();
        let worked = Duration::from_millis((ticks()? + ticks()?) * 10);
        let status = fs::read_to_string(format!("/proc/{id}/status")).ok()?;
        let line = status.lines().find(|l| l.starts_with("VmRSS"))?;
        Some((worked, line.split_whitespace().nth(1)?.parse().ok()?))
    }

    /// Closes the output, keeps the input open and repeats a request until the program ends. Returns its exit code.
    ///
    /// A single request is not enough. A process that another test starts at this moment holds a copy of the output until
    /// it executes its program. The first answer then goes into the pipe without an error.
    #[allow(dead_code)] // not in the bench
    pub fn left_alone(self) -> Option<i32> {
        let Program {
            mut child,
            mut input,
            output,
        } = self;
        drop(output);
        let body = r#"{ "jsonrpc": "2.0", "id": 0, "method": "no/such/method" }"#;
        let request = format!("Content-Length: {}\r\n\r\n{body}", body.len());
        ended(&mut child, || {
            // Fails if the program has just ended.
            let _ = input.write_all(request.as_bytes());
        })
    }

    /// Closes the input and returns the exit code of the program.
    pub fn end(self) -> Option<i32> {
        let Program {
            mut child,
            input,
            output: _unread,
        } = self;
        drop(input);
        ended(&mut child, || ())
    }
}

/// Waits until a program has ended and returns its exit code. Calls `ask` ten times per second.
///
/// # Panics
/// If the program does not end in time. It is killed first.
fn ended(child: &mut Child, mut ask: impl FnMut()) -> Option<i32> {
    for _ in 0..ATTEMPTS {
        ask();
        for _ in 0..10 {
            if let Some(status) = child.try_wait().expect("it can be waited for") {
                return status.code();
            }
            sleep(Duration::from_millis(10));
        }
    }
    let _ = child.kill();
    let _ = child.wait();
    panic!("the program does not end after {ATTEMPTS} attempts");
}
