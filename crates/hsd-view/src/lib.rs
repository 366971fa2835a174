//! The live preview: a local web page that shows the models of source files and follows their changes.
//!
//! The server listens on loopback only, rejects requests of other pages, reads no file outside the opened folder and makes
//! no network requests. The page is written in TypeScript in `view/` and embedded by `build.rs`; `view/src/server/api.ts`
//! defines the API.
//!
//! | file | purpose |
//! |---|---|
//! | `editor_host` | access to source files, the editor, and photographs of a front |
//! | `workspace`, `snapshot` | the files that can be shown; the compiled state of each |
//! | `town` | the tiles of towns, built behind the page |
//! | `snapshot/parameters` | the parameters of a file, which the page shows and sets |
//! | `houses` | models house by house, so that a page loads only what has changed |
//! | `watch` | notices saved files |
//! | `routes`, `guard` | the API; access control |
//! | `strokes`, `history` | edits drawn in the page; undo and redo |
//! | `screenshots` | receives the images that the page renders for documents |
//! | `scan` | the scans that a house was read from |
//! | `model_file` | existing models and their external textures |
//! | `page` | the embedded files of the page |
//! | `fingerprint` | content hashes |
//! | `locked` | locks that outlive a panic |

mod editor_host;
mod fingerprint;
mod guard;
mod history;
mod houses;
mod locked;
mod model_file;
mod page;
mod routes;
mod scan;
mod screenshots;
mod snapshot;
mod strokes;
mod town;
mod watch;
mod workspace;

pub use editor_host::{EditorHost, FrontHost};
pub use notify_debouncer_full::notify::RecursiveMode;
pub use page::{how_to_build, is_built};
pub use screenshots::Screenshot;
pub use town::map_folders;

use hsd_base::diagnostic::{Diagnostic, Language};
use hsd_base::source::{Source, reference};
use std::collections::BTreeSet;
use std::io;
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::Sender;
use std::thread::{self, JoinHandle};
use watch::Watch;
use workspace::Workspace;

/// Options of a preview.
pub struct PreviewOptions {
    /// The folder that contains all readable files.
    pub root: PathBuf,
    /// The only files to show, as paths relative to the root with `/`; all files below it without any.
    pub only: Vec<String>,
    /// The language of diagnostics and of the page.
    pub language: Language,
    /// Access to source files and the editor.
    pub host: Box<dyn EditorHost>,
    /// The photographs that become a front in the page.
    pub front: Option<Box<dyn FrontHost>>,
    /// The port; 0 for any free port.
    pub port: u16,
    /// Folders to watch for changes.
    pub watched: Vec<(PathBuf, RecursiveMode)>,
}

/// Checks the external textures of an existing model. Returns the model as a source without text, and the diagnostics.
///
/// # Errors
/// If the model cannot be read.
pub fn check_model(model: &Path) -> io::Result<(Source, Vec<Diagnostic>)> {
    let path = model.canonicalize()?;
    let root = path.parent().unwrap_or(Path::new("/"));
    let read = model_file::ModelFile::read(root, &path)?;
    // Diagnostics show the path as given.
    let source = Source::new(read.source.id(), model.to_string_lossy(), b"");
    Ok((source, read.diagnostics))
}

/// Returns the paths of the external textures of a model.
pub fn texture_files(model: &Path) -> Vec<PathBuf> {
    model_file::textures(model)
}

/// Returns the folders of the external textures of a model, to be watched. `model` is a canonical path.
pub fn texture_folders(model: &Path) -> BTreeSet<PathBuf> {
    model_file::folders(model)
}

/// A running preview. Its threads run until the program ends.
pub struct Preview {
    workspace: Arc<Workspace>,
    address: SocketAddr,
    server: JoinHandle<io::Result<()>>,
    _watch: Option<Watch>,
}

impl Preview {
    /// Starts a preview.
    ///
    /// # Errors
    /// If the root does not exist, the port is in use, or a folder cannot be watched.
    pub fn start(options: PreviewOptions) -> io::Result<Preview> {
        Preview::begin(options, None)
    }

    /// Starts a preview whose page renders images for documents and sends them to `sink`.
    ///
    /// # Errors
    /// As [`Preview::start`].
    pub fn with_screenshots(
        options: PreviewOptions,
        sink: Sender<Screenshot>,
    ) -> io::Result<Preview> {
        Preview::begin(options, Some(sink))
    }

    fn begin(
        options: PreviewOptions,
        screenshots: Option<Sender<Screenshot>>,
    ) -> io::Result<Preview> {
        let root = options.root.canonicalize()?;
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, options.port))?;
        listener.set_nonblocking(true)?;
        let address = listener.local_addr()?;
        let workspace = Workspace::new(
            root,
            options.only,
            options.language,
            (options.host, options.front),
        );
        let watch = match &options.watched[..] {
            [] => None,
            folders => Some(watch::watch(&workspace, folders).map_err(io::Error::other)?),
        };
        let routes = routes::routes(workspace.clone(), address.port(), screenshots);
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
            workspace,
            address,
            server,
            _watch: watch,
        })
    }

    /// Returns the address of the page.
    pub fn url(&self) -> String {
        format!("http://{}/", self.address)
    }

    /// Returns the address of the page for a file, given as a path relative to the root with `/`.
    pub fn page(&self, file: &str) -> String {
        format!("{}?file={}", self.url(), reference(file))
    }

    /// Notifies the preview of a change outside the watched folders.
    pub fn changed(&self) {
        self.workspace.changed();
    }

    /// Notifies the preview of the cursor position in a file, as a byte offset.
    pub fn cursor(&self, path: &Path, at: usize) {
        self.workspace.cursor(path, at);
    }

    /// Waits until the server fails.
    ///
    /// # Errors
    /// The failure of the server.
    pub fn wait(self) -> io::Result<()> {
        let fault = || io::Error::other("internal error");
        self.server.join().map_err(|_| fault())?
    }
}
