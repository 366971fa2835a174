//! The language server: exposes [`ide`](hsd_ide) through the Language Server Protocol.
//!
//! The server is a loop on one thread. It first receives all pending messages, so that cancelled requests are never started
//! and a document with several changes is analysed once. Then it answers the oldest request. If there is none, it
//! analyses a changed document and publishes its diagnostics. A full check takes milliseconds, so analyses are not
//! incremental. Only a town is checked with its maps behind the loop, since that takes as long as its maps are large; its
//! diagnostics are published when that is done.
//!
//! The loop tolerates malformed messages, invalid positions, unknown documents and requests in any order. A panic fails a
//! request, never the server.
//!
//! | file | purpose |
//! |---|---|
//! | `transport` | reads and writes messages |
//! | `server`, `requests` | the loop; request handlers |
//! | `session` | the state of a client connection |
//! | `client`, `settings` | capabilities and settings of the client |
//! | `documents`, `world` | open documents, and the files around them |
//! | `towns` | towns checked with their maps, on another thread |
//! | `preview` | the live preview beside the editor |
//! | `publish`, `actions` | diagnostics and their fixes |
//! | `proto`, `lines`, `uri` | conversion of locations, positions and file names |

mod actions;
mod client;
mod documents;
mod lines;
mod preview;
mod proto;
mod publish;
mod requests;
mod server;
mod session;
mod settings;
mod towns;
mod transport;
mod uri;
mod world;

use hsd_base::diagnostic::Language;
use lsp_server::Connection;
use std::io::{BufRead, Write};
use std::time::Duration;

/// The longest time that a client which no longer reads keeps the program from ending.
const LAST_WORDS: Duration = Duration::from_secs(2);

/// Serves a client on a stream until `exit` or the end of the stream. `language` applies if the client names none. Returns
/// whether the client has sent `shutdown` before.
pub fn serve(
    input: impl BufRead + Send + 'static,
    output: impl Write + Send + 'static,
    language: Language,
) -> bool {
    let (server, client) = Connection::memory();
    let (written, ended) = transport::start(client, input, output);
    let orderly = server::Server::new(server, Some(written.clone()), language).run();
    // Writes all pending messages before the program ends.
    let _ = written.send(transport::END.to_vec());
    let _ = ended.recv_timeout(LAST_WORDS);
    orderly
}

/// Like [`serve`], on messages.
pub fn serve_on(connection: Connection, language: Language) -> bool {
    server::Server::new(connection, None, language).run()
}
