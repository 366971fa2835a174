//! The program on a stream: whatever comes in, it goes on.

use crate::lsp::program::Program;
use serde_json::{Value, json};
use std::process::Command;
use std::sync::atomic::{AtomicBool, Ordering};

#[test]
fn broken_messages_are_answered_and_the_next_ones_read() {
    let mut program = Program::start();
    let about = program.ask(
        1,
        "initialize",
        json!({ "capabilities": {}, "processId": null }),
    );
    assert_eq!(
        about["result"]["capabilities"]["positionEncoding"],
        "utf-16"
    );
    program.raw(b"Content-Length: 7\r\n\r\n{\"a\": \xff");
    assert_eq!(program.hear()["error"]["code"], -32700);
    program.raw(b"Content-Length: 4\r\n\r\n[1,]");
    assert_eq!(program.hear()["error"]["code"], -32700);
    program.raw(b"no header at all\r\n");
    assert_eq!(program.hear()["error"]["code"], -32700);
    program.raw(b"Content-Length: -1\r\n");
    assert_eq!(program.hear()["error"]["code"], -32700);
    let unknown = program.ask(3, "no/such", json!({}));
    assert_eq!(unknown["error"]["code"], -32601);
    assert_eq!(
        program.ask(4, "shutdown", Value::Null)["result"],
        Value::Null
    );
    program.notify("exit", Value::Null);
    assert_eq!(program.end(), Some(0));
}

#[test]
fn room_is_not_made_for_what_never_comes() {
    for length in [
        "18446744073709551615",
        "4611686018427387904",
        "1000000000000",
    ] {
        let mut program = Program::start();
        program.ask(1, "initialize", json!({ "capabilities": {} }));
        program.raw(format!("Content-Length: {length}\r\n\r\n{{").as_bytes());
        assert_eq!(program.end(), Some(1), "{length}");
    }
}

#[test]
fn the_end_of_the_stream_is_the_end_of_the_program() {
    let mut program = Program::start();
    program.ask(1, "initialize", json!({ "capabilities": {} }));
    assert_eq!(program.end(), Some(1));
}

#[test]
fn a_header_without_end_is_skipped() {
    let mut program = Program::start();
    program.ask(1, "initialize", json!({ "capabilities": {} }));
    let (_, before) = program.used().unwrap_or_default();
    for _ in 0..64 {
        program.raw(&[b'x'; 1 << 20]);
    }
    program.raw(b"\n");
    assert_eq!(program.hear()["error"]["code"], -32700);
    let (_, after) = program.used().unwrap_or_default();
    assert!(after < before + (8 << 10), "{before} KiB, then {after}");
    assert_eq!(
        program.ask(2, "no/such", json!({}))["error"]["code"],
        -32601
    );
}

#[test]
fn a_client_that_no_longer_reads_ends_the_program() {
    // It reads nothing, and its answers are more than a pipe holds.
    let mut program = Program::start();
    program.ask(1, "initialize", json!({ "capabilities": {} }));
    for id in 2..4000 {
        program.say(json!({ "jsonrpc": "2.0", "id": id, "method": "no/such/method" }));
    }
    assert_eq!(program.end(), Some(1));
    // It is gone, but something else keeps the stream open.
    let mut program = Program::start();
    program.ask(1, "initialize", json!({ "capabilities": {} }));
    assert_eq!(program.left_alone(), Some(1));
}

/// A process that is starting holds a copy of every pipe of this one until it executes its program.
#[test]
fn a_client_that_is_gone_ends_the_program_while_processes_start() {
    let is_done = AtomicBool::new(false);
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                // Bounded, so that a failure of the other thread ends this one.
                for _ in 0..2_000 {
                    if is_done.load(Ordering::Relaxed) {
                        return;
                    }
                    let mut command = Command::new(env!("CARGO_BIN_EXE_hsd"));
                    command.arg("-V").output().expect("the program runs");
                }
            });
        }
        for _ in 0..10 {
            let mut program = Program::start();
            program.ask(1, "initialize", json!({ "capabilities": {} }));
            assert_eq!(program.left_alone(), Some(1));
        }
        is_done.store(true, Ordering::Relaxed);
    });
}
