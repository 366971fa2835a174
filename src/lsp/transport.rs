//! Messages from and to a stream. What is no message is answered as such, and the next one read.

use lsp_server::{Connection, Message};
use serde::Serialize;
use std::io::{self, BufRead, Error, ErrorKind, Read, Write};
use std::sync::mpsc::{self, Sender};
use std::thread::{self, JoinHandle};

/// The longest message that is read, bytes; of a longer one nothing is kept.
const LONGEST: u64 = 1 << 28;

/// Reads and writes in the background. The writer takes messages as [`bytes`] has them, and ends with [`END`]: others than
/// the server may hold on to its channel, as previews do.
pub(super) fn start(
    client: Connection,
    mut input: impl BufRead + Send + 'static,
    mut output: impl Write + Send + 'static,
) -> (Sender<Vec<u8>>, JoinHandle<()>) {
    let sender = client.sender;
    // Nobody waits for the reader: it may hang on a stream that never ends.
    thread::spawn(move || {
        loop {
            let message = match read(&mut input) {
                Ok(Some(message)) => message,
                // The stream goes on behind what could not be read.
                Err(error) if error.kind() == ErrorKind::InvalidData => lsp_server::Notification {
                    method: BROKEN.into(),
                    params: error.to_string().into(),
                }
                .into(),
                Ok(None) | Err(_) => return,
            };
            if sender.send(message).is_err() {
                return;
            }
        }
    });
    let (written, messages) = mpsc::channel::<Vec<u8>>();
    let writer = thread::spawn(move || {
        for message in messages {
            if message == END {
                return;
            }
            let done = output.write_all(&message).and_then(|()| output.flush());
            if done.is_err() {
                return;
            }
        }
    });
    (written, writer)
}

/// The last message, which is none.
pub(super) const END: &[u8] = &[];

/// A message as it goes over a stream.
pub(super) fn bytes(message: &impl Serialize) -> Vec<u8> {
    let body = serde_json::to_vec(message).unwrap_or_default();
    let mut whole = format!("Content-Length: {}\r\n\r\n", body.len()).into_bytes();
    whole.extend(body);
    whole
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
