//! The live preview: a page on loopback that shows what texts make, and keeps up with them.
//!
//! It answers on loopback, to no foreign page, reads no file outside of the folder that is shown, and asks nothing of any
//! network. The page itself is written in TypeScript in `view/` and embedded by `build.rs`; what both say to one another
//! stands in `view/src/server/api.ts`.
//!
//! | file | does |
//! |---|---|
//! | `desk` | where texts lie as they are written, and where the editor is |
//! | `hall`, `made` | which files are shown; what each makes |
//! | `houses` | its model house by house, so that a page reads again only what has changed |
//! | `watch` | notices what is saved |
//! | `routes`, `guard` | what the page asks for; who may ask |
//! | `strokes` | what was drawn in the page, so that it can be taken back |
//! | `studio` | takes the pictures that the page draws for documents |
//! | `beside` | models that were made before, and the pictures beside them |
//! | `page` | the files of the page |

mod beside;
mod desk;
mod guard;
mod hall;
mod houses;
mod made;
mod page;
mod routes;
mod strokes;
mod studio;
mod watch;

pub use desk::Desk;
pub use notify_debouncer_full::notify::RecursiveMode;
pub use page::{how_to_get_it, there};
pub use studio::Still;

use crate::diagnostic::{Diagnostic, Language};
use crate::source::{Source, reference};
use hall::Hall;
use std::collections::BTreeSet;
use std::io;
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::Sender;
use std::thread::{self, JoinHandle};
use watch::Watch;

/// What is to be shown, and how.
pub struct Show {
    /// The folder below which all files lie that may be read.
    pub root: PathBuf,
    /// The only file that is shown, by its path below the root with `/`.
    pub only: Option<String>,
    /// Of messages and of the page.
    pub language: Language,
    /// Where texts lie as they are written, and where the editor is.
    pub desk: Box<dyn Desk>,
    /// The port; 0 = any that is free.
    pub port: u16,
    /// Folders in which files may be saved that matter.
    pub watched: Vec<(PathBuf, RecursiveMode)>,
}

/// What is wrong with the pictures beside a model that was made before, and the model as a file that messages speak of.
///
/// # Errors
/// Where the model cannot be read.
pub fn complaints(model: &Path) -> io::Result<(Source, Vec<Diagnostic>)> {
    let path = model.canonicalize()?;
    let root = path.parent().unwrap_or(Path::new("/"));
    let read = beside::Model::read(root, &path)?;
    // As the author named it.
    let source = Source::new(read.source.id(), model.to_string_lossy(), b"");
    Ok((source, read.said))
}

/// The folders below that of a model in which its pictures lie: whoever shows it watches them. `model` = a real path.
pub fn picture_folders(model: &Path) -> BTreeSet<PathBuf> {
    beside::folders(model)
}

/// A preview that runs, on threads of its own, until the program ends.
pub struct Preview {
    hall: Arc<Hall>,
    address: SocketAddr,
    server: JoinHandle<io::Result<()>>,
    _watch: Option<Watch>,
}

impl Preview {
    /// Begins to show.
    ///
    /// # Errors
    /// Where the root is not there, the port is taken, or folders cannot be watched.
    pub fn start(show: Show) -> io::Result<Preview> {
        Preview::begin(show, None)
    }

    /// Begins to show to a page that draws pictures for documents; `taker` gets them.
    ///
    /// # Errors
    /// As [`Preview::start`].
    pub fn with_stills(show: Show, taker: Sender<Still>) -> io::Result<Preview> {
        Preview::begin(show, Some(taker))
    }

    fn begin(show: Show, stills: Option<Sender<Still>>) -> io::Result<Preview> {
        let root = show.root.canonicalize()?;
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, show.port))?;
        listener.set_nonblocking(true)?;
        let address = listener.local_addr()?;
        let hall = Arc::new(Hall::new(root, show.only, show.language, show.desk));
        let watch = match &show.watched[..] {
            [] => None,
            folders => Some(watch::watch(&hall, folders).map_err(io::Error::other)?),
        };
        let routes = routes::routes(hall.clone(), address.port(), stills);
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_io()
            .enable_time()
            .build()?;
        let server = thread::Builder::new()
            .name("hsd view".to_owned())
            .spawn(move || {
                runtime.block_on(async {
                    let listener = tokio::net::TcpListener::from_std(listener)?;
                    axum::serve(listener, routes).await
                })
            })?;
        Ok(Preview {
            hall,
            address,
            server,
            _watch: watch,
        })
    }

    /// Where the page is.
    pub fn url(&self) -> String {
        format!("http://{}/", self.address)
    }

    /// The page of a file, by its path below the root with `/`.
    pub fn page(&self, file: &str) -> String {
        format!("{}?file={}", self.url(), reference(file))
    }

    /// Something has changed that is not noticed by itself.
    pub fn changed(&self) {
        self.hall.changed();
    }

    /// The editor stands at an offset of the text of a file.
    pub fn cursor(&self, path: &Path, at: usize) {
        self.hall.cursor(path, at);
    }

    /// Waits until it ends, which it does for a failure only.
    ///
    /// # Errors
    /// That failure.
    pub fn wait(self) -> io::Result<()> {
        let fault = || io::Error::other("a fault of the program");
        self.server.join().map_err(|_| fault())?
    }
}
