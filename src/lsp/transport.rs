//! Messages from and to a stream. What is no message is answered as such, and the next one read.

use lsp_server::{Connection, ErrorCode, Message};
use std::io::{self, BufRead, Error, ErrorKind, Read, Write};
use std::thread::{self, JoinHandle};

/// The longest message that is read, bytes; of a longer one nothing is kept.
const LONGEST: u64 = 1 << 28;

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
            match read(&mut input) {
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

/// The next message; `None` at the end of the stream. Room is made for what comes, not for what is announced: a header
/// may say anything.
fn read(input: &mut impl BufRead) -> io::Result<Option<Message>> {
    let broken = |why: &dyn std::fmt::Display| Error::new(ErrorKind::InvalidData, why.to_string());
    let mut length = None;
    loop {
        let mut line = String::new();
        if input.read_line(&mut line)? == 0 {
            return Ok(None);
        }
        let Some(line) = line.strip_suffix("\r\n") else {
            return Err(broken(&"a header without a line end"));
        };
        if line.is_empty() {
            break;
        }
        let Some((name, value)) = line.split_once(':') else {
            return Err(broken(&"a header without a name"));
        };
        if name.eq_ignore_ascii_case("Content-Length") {
            length = Some(value.trim().parse::<u64>().map_err(|e| broken(&e))?);
        }
    }
    let length = length.ok_or_else(|| broken(&"no Content-Length"))?;
    let mut rest = input.take(length);
    let mut body = vec![];
    rest.by_ref().take(LONGEST).read_to_end(&mut body)?;
    if body.len() as u64 == LONGEST {
        io::copy(&mut rest, &mut io::sink())?;
        return Err(broken(&"a message too long"));
    }
    if rest.limit() > 0 {
        return Ok(None);
    }
    serde_json::from_slice(&body)
        .map(Some)
        .map_err(|e| broken(&e))
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
