//! The language server: what [`ide`](crate::ide) knows, in the words of the Language Server Protocol.
//!
//! Nobody else knows the protocol. The server is one loop on one thread: it takes in all messages that wait, so that a
//! request that was cancelled meanwhile is never begun, and a text that was changed ten times is read once; then it
//! answers the oldest; where nothing waits, it reads a text that has changed and publishes what is wrong with it.
//! A whole check of a text takes milliseconds, so nothing is kept from the state before a change.
//!
//! Whatever a client does, the loop goes on: broken messages, positions outside of texts, texts that are not open,
//! requests in any order. A fault of the program ends a request, never the server.
//!
//! | file | does |
//! |---|---|
//! | `transport` | messages from and to a stream |
//! | `server`, `requests` | the loop; what each request gets |
//! | `client`, `settings` | what the client knows and wishes |
//! | `documents`, `world` | texts that are open, and files round them |
//! | `preview` | the live preview beside the editor |
//! | `publish`, `actions` | diagnostics and their mends |
//! | `proto`, `lines`, `uri` | places, positions and names of the protocol |

mod actions;
mod client;
mod documents;
mod lines;
mod preview;
mod proto;
mod publish;
mod requests;
mod server;
mod settings;
mod transport;
mod uri;
mod world;

use crate::diagnostic::Language;
use lsp_server::Connection;
use std::io::{BufRead, Write};

/// Serves a client on a stream until it says `exit`, or the stream ends. `language` is that of messages where the
/// client names none. Returns whether the client has said good-bye as it should.
pub fn serve(
    input: impl BufRead + Send + 'static,
    output: impl Write + Send + 'static,
    language: Language,
) -> bool {
    let (server, client) = Connection::memory();
    let (written, writer) = transport::start(client, input, output);
    let polite = server::Server::new(server, Some(written.clone()), language).run();
    // What was said last is to be written before the program ends.
    let _ = written.send(transport::END.to_vec());
    let _ = writer.join();
    polite
}

/// The same on messages.
pub fn serve_on(connection: Connection, language: Language) -> bool {
    server::Server::new(connection, None, language).run()
}
