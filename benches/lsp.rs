//! From keystroke to diagnostics, through the protocol: `cargo bench --bench lsp`.
//!
//! A client starts `hsd lsp`, types into texts of 2,000 and 20,000 lines of both forms, and waits after each key for the
//! diagnostics of its version. Printed are percentiles of the time from the key to the last byte of the answer, by the
//! clock; processor time of the server a key; and its memory before and after.

#![expect(clippy::print_stdout)] // that is what it is for

use serde_json::{Value, json};
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::{Duration, Instant};

mod texts;

/// Keys typed into each text; `HSD_KEYS` sets another number.
const KEYS: usize = 1000;

struct Client {
    child: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
}

impl Client {
    fn start() -> Client {
        let mut command = Command::new(env!("CARGO_BIN_EXE_hsd"));
        command
            .arg("lsp")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped());
        let mut child = command.spawn().expect("the program runs");
        let input = child.stdin.take().expect("is piped");
        let output = BufReader::new(child.stdout.take().expect("is piped"));
        let mut client = Client {
            child,
            input,
            output,
        };
        let params = json!({ "capabilities": {}, "processId": null });
        client.say(json!({ "jsonrpc": "2.0", "id": 1, "method": "initialize", "params": params }));
        client.hear();
        client.note("initialized", json!({}));
        client
    }

    fn say(&mut self, message: Value) {
        let body = message.to_string();
        let head = format!("Content-Length: {}\r\n\r\n", body.len());
        self.input
            .write_all((head + &body).as_bytes())
            .expect("it listens");
        self.input.flush().expect("it listens");
    }

    fn note(&mut self, method: &str, params: Value) {
        self.say(json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    fn hear(&mut self) -> Value {
        let mut length = 0;
        loop {
            let mut line = String::new();
            self.output.read_line(&mut line).expect("it speaks");
            match line.trim_end().split_once(": ") {
                Some(("Content-Length", number)) => length = number.parse().expect("a number"),
                _ => break,
            }
        }
        let mut body = vec![0; length];
        self.output.read_exact(&mut body).expect("it speaks");
        serde_json::from_slice(&body).expect("is JSON")
    }

    /// Waits for the diagnostics of a version.
    fn wait(&mut self, version: usize) {
        while self.hear()["params"]["version"] != version {}
    }

    /// Processor time of the server so far, from a system that tells it.
    fn worked(&self) -> Option<Duration> {
        let stat = fs::read_to_string(format!("/proc/{}/stat", self.child.id())).ok()?;
        let fields = stat.rsplit_once(')')?.1;
        let mut fields = fields.split_whitespace().skip(11);
        let mut ticks = || fields.next()?.parse::<u64>().ok();
        Some(Duration::from_millis((ticks()? + ticks()?) * 10))
    }

    /// Memory of the server in KiB.
    fn memory(&self) -> Option<u64> {
        let status = fs::read_to_string(format!("/proc/{}/status", self.child.id())).ok()?;
        let line = status.lines().find(|l| l.starts_with("VmRSS"))?;
        line.split_whitespace().nth(1)?.parse().ok()
    }
}

/// Types into a text and reports.
fn type_into(name: &str, text: &str, keys: usize) {
    let mut client = Client::start();
    let uri = "file:///bench/bench.hsd";
    let document = json!({ "uri": uri, "languageId": "hsd", "version": 1, "text": text });
    client.note("textDocument/didOpen", json!({ "textDocument": document }));
    client.wait(1);
    let lines: Vec<&str> = text.lines().collect();
    let walls: Vec<usize> = (0..lines.len())
        .filter(|l| lines[*l].contains("KSK  "))
        .collect();
    let (mut times, before, memory) = (vec![], client.worked(), client.memory());
    for key in 0..keys {
        // A letter of a code goes wrong and comes right again, all over the text.
        let line = walls[(key / 2) * 7919 % walls.len()];
        let column = lines[line].find("KSK  ").expect("is there");
        let place = |character: usize| json!({ "line": line, "character": character });
        let change = json!([{
            "range": { "start": place(column + 1), "end": place(column + 2) },
            "text": if key % 2 == 0 { "Q" } else { "S" },
        }]);
        let version = key + 2;
        let document = json!({ "uri": uri, "version": version });
        let begun = Instant::now();
        let params = json!({ "textDocument": document, "contentChanges": change });
        client.note("textDocument/didChange", params);
        client.wait(version);
        times.push(begun.elapsed());
    }
    times.sort();
    let at = |share: f64| times[((times.len() - 1) as f64 * share) as usize].as_secs_f64() * 1e3;
    let worked = client.worked().zip(before);
    let each = worked.map(|(after, before)| (after - before).as_secs_f64() * 1e3 / keys as f64);
    println!(
        "{name:22} {:6} lines {:5} kB  p50 {:6.2} ms  p90 {:6.2} ms  p99 {:6.2} ms  max {:6.2} ms  processor {:5.2} ms  memory {} -> {} KiB",
        lines.len(),
        text.len() / 1000,
        at(0.5),
        at(0.9),
        at(0.99),
        at(1.0),
        each.unwrap_or(f64::NAN),
        memory.unwrap_or(0),
        client.memory().unwrap_or(0),
    );
    client.note("exit", Value::Null);
    let _ = client.child.wait();
}

fn main() {
    let keys = std::env::var("HSD_KEYS").ok().and_then(|k| k.parse().ok());
    let keys = keys.unwrap_or(KEYS);
    for lines in [2_000, 20_000] {
        type_into("legacy, a street", &texts::legacy_lines(lines), keys);
        type_into("XML, a street", &texts::xml_lines(lines), keys);
    }
}
