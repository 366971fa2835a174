//! Messages from and to a stream. What is no message is answered as such, and the next one read.

use lsp_server::{Connection, ErrorCode, Message};
use std::io::{BufRead, ErrorKind, Write};
use std::thread::{self, JoinHandle};

/// Reads and writes in the background. The writer ends when the server is gone.
pub(super) fn start(
    client: Connection,
    mut input: impl BufRead + Send + 'static,
    mut output: impl Write + Send + 'static,
) -> JoinHandle<()> {
    let Connection { sender, receiver } = client;
    // Nobody waits for the reader: it may hang on a stream that never ends.
    thread::spawn(move || {
        loop {
            match Message::read(&mut input) {
                Ok(Some(message)) => {
                    if sender.send(message).is_err() {
                        return;
                    }
                }
                // The stream goes on behind what could not be read.
                Err(error) if error.kind() == ErrorKind::InvalidData => {
                    let broken = lsp_server::Notification {
                        method: BROKEN.into(),
                        params: error.to_string().into(),
                    };
                    if sender.send(broken.into()).is_err() {
                        return;
                    }
                }
                Ok(None) | Err(_) => return,
            }
        }
    });
    thread::spawn(move || {
        for message in receiver {
            let written = match &message {
                Message::Notification(n) if n.method == BROKEN => {
                    refuse(&mut output, n.params.as_str().unwrap_or_default())
                }
                other => other.write(&mut output),
            };
            if written.is_err() {
                return;
            }
        }
    })
}

/// The name under which a broken message is passed on.
pub(super) const BROKEN: &str = "$/broken";

/// Answers what is no message: nobody knows its number.
fn refuse(output: &mut dyn Write, why: &str) -> std::io::Result<()> {
    let code = ErrorCode::ParseError as i32;
    let body = serde_json::json!({
        "jsonrpc": "2.0",
        "id": null,
        "error": { "code": code, "message": why },
    });
    let body = body.to_string();
    write!(output, "Content-Length: {}\r\n\r\n{body}", body.len())?;
    output.flush()
}
