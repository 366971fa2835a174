//! The program on a stream: whatever comes in, it goes on.

use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

pub struct Program {
    pub child: Child,
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

    fn raw(&mut self, bytes: &[u8]) {
        self.input.write_all(bytes).expect("the program listens");
        self.input.flush().expect("the program listens");
    }

    pub fn say(&mut self, message: Value) {
        let body = message.to_string();
        self.raw(format!("Content-Length: {}\r\n\r\n{body}", body.len()).as_bytes());
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
}

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
    program.say(json!({ "jsonrpc": "2.0", "method": "exit" }));
    assert_eq!(program.child.wait().expect("it ends").code(), Some(0));
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
        drop(program.input);
        let ended = program.child.wait().expect("it ends");
        assert_eq!(ended.code(), Some(1), "{length}");
    }
}

#[test]
fn the_end_of_the_stream_is_the_end_of_the_program() {
    let mut program = Program::start();
    program.ask(1, "initialize", json!({ "capabilities": {} }));
    let Program {
        mut child, input, ..
    } = program;
    drop(input);
    assert_eq!(child.wait().expect("it ends").code(), Some(1));
}
