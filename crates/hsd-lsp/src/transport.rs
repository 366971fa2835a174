//! Reads and writes messages. Malformed messages are reported to the server, and reading continues.

use lsp_server::{Connection, Message};
use serde::Serialize;
use std::io::{self, BufRead, Error, ErrorKind, Read, Write};
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread;

/// The maximum length of a message in bytes; longer ones are skipped.
const LONGEST: u64 = 1 << 28;

/// The maximum length of a line of a header in bytes.
const LONGEST_LINE: u64 = 1 << 12;

/// Starts the reader and writer threads. The writer takes messages serialized by [`bytes`] and ends with [`END`], since
/// previews may keep its channel open; the receiver is disconnected when it has ended. A client that takes no messages
/// any more is gone, so the server gets an `exit` then.
pub(super) fn start(
    client: Connection,
    mut input: impl BufRead + Send + 'static,
    mut output: impl Write + Send + 'static,
) -> (Sender<Vec<u8>>, Receiver<()>) {
    let sender = client.sender;
    let gone = sender.clone();
    // The reader is not joined: its stream may never end.
    thread::spawn(move || {
        loop {
            let message = match read(&mut input) {
                Ok(Some(message)) => message,
                // Continues after a malformed message.
                Err(error) if error.kind() == ErrorKind::InvalidData => lsp_server::Notification {
                    method: BROKEN.into(),
                    params: error.to_string().into(),
                }
                .into(),
                Ok(None) | Err(_) => exit(),
            };
            let last = matches!(&message, Message::Notification(n) if n.method == "exit");
            if sender.send(message).is_err() || last {
                return;
            }
        }
    });
    let (written, messages) = mpsc::channel::<Vec<u8>>();
    let (open, ended) = mpsc::channel();
    thread::spawn(move || {
        let _open: Sender<()> = open;
        for message in messages {
            if message == END {
                return;
            }
            let done = output.write_all(&message).and_then(|()| output.flush());
            if done.is_err() {
                let _ = gone.send(exit());
                return;
            }
        }
    });
    (written, ended)
}

/// The message that ends the server, as from a client that is gone without a word.
fn exit() -> Message {
    lsp_server::Notification::new("exit".into(), ()).into()
}

/// The marker that ends the writer.
pub(super) const END: &[u8] = &[];

/// Serializes a message with its header.
pub(super) fn bytes(message: &impl Serialize) -> Vec<u8> {
    let body = serde_json::to_vec(message).unwrap_or_default();
    let mut whole = format!("Content-Length: {}\r\n\r\n", body.len()).into_bytes();
    whole.extend(body);
    whole
}

/// Reads a message; `None` at the end of the stream. Memory is allocated for received data only, whatever length the
/// header announces.
fn read(input: &mut impl BufRead) -> io::Result<Option<Message>> {
    let broken = |why: &dyn std::fmt::Display| Error::new(ErrorKind::InvalidData, why.to_string());
    let mut length = None;
    loop {
        let mut line = String::new();
        if input.by_ref().take(LONGEST_LINE).read_line(&mut line)? == 0 {
            return Ok(None);
        }
        if line.len() as u64 == LONGEST_LINE && !line.ends_with('\n') {
            input.skip_until(b'\n')?;
            return Err(broken(&"a header line too long"));
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

/// Placeholder method name for a malformed message.
pub(super) const BROKEN: &str = "$/broken";
