//! The live preview beside an editor. It shows documents as they are in the editor, saved or not, opens clicked locations
//! there, and edits through the editor, so that the editor can undo strokes.

use super::client::Client;
use super::documents::Documents;
use super::lines::Lines;
use super::settings::Settings;
use super::uri;
use super::world::{MARK, Open, Overlay, key};
use hsd_base::source::{FileId, Limits, Source, Span, World};
use hsd_driver::Options;
use hsd_ide::format;
use hsd_view::{EditorHost, Preview, PreviewOptions};
use lsp_server::{Request, RequestId};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::fs::File;
use std::io::{self, Read};
use std::path::{MAIN_SEPARATOR, Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::mpsc::{self, Sender};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;
use tempfile::TempDir;

/// The maximum time for a client to apply an edit.
const PATIENCE: Duration = Duration::from_secs(3);

/// Sends a request to the client.
pub(super) type RequestSender = Arc<dyn Fn(Request) + Send + Sync>;

/// The previews of a server, one per folder.
#[derive(Default)]
pub(super) struct Previews {
    running: Option<Running>,
}

/// Previews by folder.
type Folders = BTreeMap<PathBuf, Arc<Preview>>;

struct Running {
    shared: Arc<Shared>,
    folders: Arc<Mutex<Folders>>,
    /// Wakes the compiling thread.
    wake: Sender<()>,
    /// The edition of the documents that is shown.
    edition: u64,
}

/// The state shared by the server and the preview threads.
struct Shared {
    texts: Mutex<Texts>,
    /// Signals changed texts.
    changed: Condvar,
    client: Client,
    sender: RequestSender,
    /// The number of requests sent.
    asked: AtomicU32,
    /// The folders in which towns are built.
    scratch: Mutex<Vec<TempDir>>,
}

impl Drop for Previews {
    /// Removes the folders of towns: the threads of previews run until the program ends, and would keep them.
    fn drop(&mut self) {
        if let Some(running) = &self.running {
            lock(&running.shared.scratch).clear();
        }
    }
}

/// The texts in the editor.
struct Texts {
    open: Open,
    /// The URIs by the same keys, and whether the texts start with a byte order mark.
    names: BTreeMap<PathBuf, (String, bool)>,
    settings: Settings,
}

impl Texts {
    fn of(documents: &Documents, settings: &Settings) -> Texts {
        Texts {
            open: documents.files.clone(),
            names: documents.names(),
            settings: settings.clone(),
        }
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Previews {
    /// Shows a file; returns the address of its page.
    ///
    /// # Errors
    /// If no server can be started.
    pub(super) fn show(
        &mut self,
        path: &Path,
        documents: &Documents,
        settings: &Settings,
        (client, sender): (&Client, &RequestSender),
    ) -> io::Result<String> {
        let path = key(path);
        let own = path.parent().unwrap_or(Path::new("/"));
        let work = client.folder.as_deref().map(key);
        let root = work.filter(|w| path.starts_with(w));
        let root = root.unwrap_or_else(|| own.to_owned());
        let running = self.running.get_or_insert_with(|| {
            let shared = Arc::new(Shared {
                texts: Mutex::new(Texts::of(documents, settings)),
                changed: Condvar::new(),
                client: client.clone(),
                sender: sender.clone(),
                asked: AtomicU32::new(0),
                scratch: Mutex::default(),
            });
            Running::new(shared, documents.edition)
        });
        let below = path.strip_prefix(&root).unwrap_or(&path).to_string_lossy();
        let file = below.replace(MAIN_SEPARATOR, "/");
        let mut folders = lock(&running.folders);
        let preview = match folders.entry(root) {
            Entry::Occupied(there) => there.into_mut(),
            Entry::Vacant(free) => {
                let options = PreviewOptions {
                    root: free.key().clone(),
                    only: vec![],
                    language: settings.language,
                    host: Box::new(LspHost(running.shared.clone())),
                    front: None,
                    port: 0,
                    // The client reports changed files.
                    watched: vec![],
                };
                free.insert(Arc::new(Preview::start(options)?))
            }
        };
        Ok(preview.page(&file))
    }

    /// Updates the previews if documents have changed.
    pub(super) fn follow(&mut self, documents: &Documents, settings: &Settings) {
        let Some(running) = &mut self.running else {
            return;
        };
        if running.edition != documents.edition {
            running.edition = documents.edition;
            *lock(&running.shared.texts) = Texts::of(documents, settings);
            running.shared.changed.notify_all();
            let _ = running.wake.send(());
        }
    }

    /// Shows the position of the cursor, as an offset without the byte order mark.
    pub(super) fn cursor(&self, path: &Path, at: usize) {
        let Some(running) = &self.running else {
            return;
        };
        let path = key(path);
        for preview in lock(&running.folders).values() {
            preview.cursor(&path, at);
        }
    }
}

impl Running {
    fn new(shared: Arc<Shared>, edition: u64) -> Running {
        let folders: Arc<Mutex<Folders>> = Arc::default();
        let (wake, wakeups) = mpsc::channel();
        let built = folders.clone();
        // The server continues to handle messages while a house is compiled.
        thread::spawn(move || {
            while wakeups.recv().is_ok() {
                while wakeups.try_recv().is_ok() {}
                let all: Vec<Arc<Preview>> = lock(&built).values().cloned().collect();
                all.iter().for_each(|preview| preview.changed());
            }
        });
        Running {
            shared,
            folders,
            wake,
            edition,
        }
    }
}

/// The editor connected to the language server.
struct LspHost(Arc<Shared>);

impl LspHost {
    /// Sends a request to the client without waiting for the response.
    fn ask(&self, method: &str, params: Value) {
        let number = self.0.asked.fetch_add(1, Ordering::Relaxed);
        let id = RequestId::from(format!("hsd/preview {number}"));
        (self.0.sender)(Request::new(id, method.to_owned(), params));
    }

    /// Returns the URI of a file and its text as the client counts it.
    fn named(&self, path: &Path, text: &str) -> (String, String) {
        let texts = lock(&self.0.texts);
        let plain = text.strip_prefix(MARK).unwrap_or(text);
        match texts.names.get(&key(path)) {
            Some((uri, true)) => (uri.clone(), format!("{MARK}{plain}")),
            Some((uri, false)) => (uri.clone(), plain.to_owned()),
            None => (uri::from_path(path), plain.to_owned()),
        }
    }
}

impl EditorHost for LspHost {
    fn read(
        &self,
        path: &Path,
        work: &mut dyn FnMut(Source, &dyn World, &Options),
    ) -> io::Result<()> {
        let bytes = self.bytes(path)?;
        let texts = lock(&self.0.texts);
        let (open, settings) = (texts.open.clone(), texts.settings.clone());
        drop(texts);
        let world = Overlay::new(path.parent(), &settings, &open);
        let source = Source::new(FileId(0), path.to_string_lossy(), &bytes);
        work(source, &world, &world.options(&settings));
        Ok(())
    }

    fn scratch(&self) -> io::Result<PathBuf> {
        let made = tempfile::Builder::new().prefix("hsd-view-").tempdir()?;
        let path = made.path().to_owned();
        lock(&self.0.scratch).push(made);
        Ok(path)
    }

    fn bytes(&self, path: &Path) -> io::Result<Vec<u8>> {
        if let Some(text) = lock(&self.0.texts).open.get(&key(path)) {
            return Ok(text.as_bytes().to_vec());
        }
        let mut bytes = vec![];
        let limit = Limits::default().bytes as u64;
        File::open(path)?.take(limit + 1).read_to_end(&mut bytes)?;
        Ok(bytes)
    }

    fn writes(&self) -> bool {
        self.0.client.applies_edits
    }

    fn write(&self, path: &Path, before: &[u8], after: &[u8]) -> io::Result<()> {
        let text = |bytes: &[u8]| Source::new(FileId(0), "", bytes).text().to_owned();
        let (uri, old) = self.named(path, &text(before));
        let (_, new) = self.named(path, &text(after));
        let (lines, encoding) = (Lines::new(&old), self.0.client.encoding);
        let edits = format::edits(&old, &new).into_iter().map(|edit| {
            let range = lines.range(&old, &edit.range, encoding);
            json!({ "range": range, "newText": edit.text })
        });
        let changes = json!({ uri: edits.collect::<Vec<_>>() });
        self.ask(
            "workspace/applyEdit",
            json!({ "edit": { "changes": changes } }),
        );
        let key = key(path);
        let waits = |texts: &mut Texts| {
            texts
                .open
                .get(&key)
                .is_none_or(|t| text(t.as_bytes()) != text(after))
        };
        let texts = lock(&self.0.texts);
        let waited = self.0.changed.wait_timeout_while(texts, PATIENCE, waits);
        match waited.unwrap_or_else(PoisonError::into_inner).1.timed_out() {
            true => Err(io::Error::other("the editor did not apply the edit")),
            false => Ok(()),
        }
    }

    fn opens(&self) -> bool {
        self.0.client.shows_documents
    }

    fn open(&self, source: &Source, span: Span) -> io::Result<()> {
        let range = source.text_range(span);
        let (uri, text) = self.named(Path::new(source.name()), source.text());
        let shift = text.len() - source.text().len();
        let range = range.start + shift..range.end + shift;
        let selection = Lines::new(&text).range(&text, &range, self.0.client.encoding);
        let params = json!({ "uri": uri, "takeFocus": true, "selection": selection });
        self.ask("window/showDocument", params);
        Ok(())
    }
}
