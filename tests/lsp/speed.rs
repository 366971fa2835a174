//! How long a key takes and what memory it leaves behind; measured where the program is optimized. `cargo bench --bench
//! lsp` tells more.

use crate::stream::Program;
use crate::support::clock::slowness;
use serde_json::{Value, json};
use std::fs;
use std::time::Duration;

const HOUSE: &str = include_str!("../../examples/machiya.hsd");

/// Processor time and memory (KiB) of a program, where the system tells it.
fn used(program: &Program) -> Option<(Duration, u64)> {
    let id = program.child.id();
    let stat = fs::read_to_string(format!("/proc/{id}/stat")).ok()?;
    let mut fields = stat.rsplit_once(')')?.1.split_whitespace().skip(11);
    let mut ticks = || fields.next()?.parse::<u64>().ok();
    let worked = Duration::from_millis((ticks()? + ticks()?) * 10);
    let status = fs::read_to_string(format!("/proc/{id}/status")).ok()?;
    let line = status.lines().find(|l| l.starts_with("VmRSS"))?;
    Some((worked, line.split_whitespace().nth(1)?.parse().ok()?))
}

/// Types so many keys into a text, and waits for the diagnostics of each.
fn keys(program: &mut Program, first: usize, count: usize, lines: usize) {
    for key in first..first + count {
        let line = 8 + (key / 2 * 7919) % (lines / 21) * 21;
        let place = |character: usize| json!({ "line": line, "character": character });
        let change = json!([{
            "range": { "start": place(1), "end": place(2) },
            "text": if key % 2 == 0 { "Q" } else { "P" },
        }]);
        let params = json!({
            "textDocument": { "uri": "file:///speed.hsd", "version": key + 2 }, "contentChanges": change,
        });
        program
            .say(json!({ "jsonrpc": "2.0", "method": "textDocument/didChange", "params": params }));
        while program.hear()["params"]["version"] != key + 2 {}
    }
}

fn open(lines: usize) -> Program {
    let text = vec![HOUSE.trim_end(); lines / 21].join("\n%\n");
    let mut program = Program::start();
    program.ask(1, "initialize", json!({ "capabilities": {} }));
    let document = json!({
        "uri": "file:///speed.hsd", "languageId": "hsd", "version": 1, "text": text,
    });
    let params = json!({ "textDocument": document });
    program.say(json!({ "jsonrpc": "2.0", "method": "textDocument/didOpen", "params": params }));
    while program.hear()["params"]["version"] != 1 {}
    program
}

fn close(mut program: Program) {
    program.ask(2, "shutdown", Value::Null);
    program.say(json!({ "jsonrpc": "2.0", "method": "exit" }));
    assert!(program.child.wait().expect("it ends").success());
}

#[test]
fn a_key_takes_milliseconds() {
    if cfg!(debug_assertions) {
        return;
    }
    for (lines, bound) in [(2_000, 10), (20_000, 50)] {
        let mut program = open(lines);
        let Some((before, _)) = used(&program) else {
            return;
        };
        let count = 200;
        keys(&mut program, 0, count, lines);
        let (after, _) = used(&program).expect("was told before");
        let each = (after - before) / count as u32;
        let bound = Duration::from_millis(bound).mul_f64(slowness());
        assert!(
            each < bound,
            "{lines} lines: {each:?} of processor time a key, more than {bound:?}"
        );
        close(program);
    }
}

#[test]
fn ten_thousand_keys_leave_no_memory_behind() {
    if cfg!(debug_assertions) {
        return;
    }
    let lines = 210;
    let mut program = open(lines);
    keys(&mut program, 0, 1000, lines);
    let Some((_, before)) = used(&program) else {
        return;
    };
    keys(&mut program, 1000, 10_000, lines);
    let (_, after) = used(&program).expect("was told before");
    assert!(after < before + 8 * 1024, "{before} KiB became {after} KiB");
    close(program);
}
