//! The files below a folder. Each is compiled when first requested, and recompiled when its inputs change while a page
//! shows it.

mod towns;

use super::editor_host::{EditorHost, FrontHost};
use super::history::History;
use super::locked::lock;
use super::model_file;
use super::snapshot::parameters::{self, Given};
use super::snapshot::{ReadAs, Snapshot, slashed};
use super::town::{BuiltTown, TILESET, TownProgress, TownSlot};
use hsd_base::diagnostic::Language;
use hsd_base::source::{FileId, Span};
use hsd_driver::Options;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Component, Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, Weak};
use tokio::sync::broadcast;

/// Limits of the file list: number of files and depth of folders.
const LISTED: usize = 2000;
const DEPTH: usize = 6;

/// File kinds, as in the API.
pub(super) const TEXT: &str = "text";
pub(super) const MODEL: &str = "model";
const TILES: &str = "tiles";

/// Notifications to pages.
#[derive(Clone, Debug)]
pub(super) enum Update {
    /// A file has a new snapshot.
    State { file: Arc<str>, revision: u64 },
    /// The cursor of the editor has moved; `None` if it is in another file.
    Cursor {
        file: Arc<str>,
        place: Option<Cursor>,
    },
    /// The build of a town goes on.
    Town {
        file: Arc<str>,
        progress: TownProgress,
    },
    /// The list of files has changed.
    Files,
}

/// A location in one of the sources of a document.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub(super) struct Cursor {
    /// The source; 0 for the file itself.
    id: u32,
    /// Byte offsets.
    span: [u32; 2],
}

/// An entry of the file list.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(super) struct FileEntry {
    /// The path relative to the root, with `/`.
    pub(super) path: String,
    pub(super) kind: &'static str,
}

/// The documents of a folder and their viewers.
pub(super) struct Workspace {
    /// The canonical path of the folder; nothing outside it is read.
    pub(super) root: PathBuf,
    /// The only files shown, if not all of them are.
    pub(super) only: Vec<String>,
    pub(super) language: Language,
    pub(super) host: Box<dyn EditorHost>,
    /// The photographs that become a front in the page.
    pub(super) front: Option<Box<dyn FrontHost>>,
    documents: Mutex<BTreeMap<String, Arc<Document>>>,
    updates: broadcast::Sender<Update>,
    revision: AtomicU64,
    /// Itself, for threads that build towns.
    me: Weak<Workspace>,
}

/// External textures of a model, by their names in it.
type Pictures = Arc<BTreeMap<String, Vec<u8>>>;

/// A file that has been requested.
pub(super) struct Document {
    pub(super) file: Arc<str>,
    snapshot: Mutex<Option<Arc<Snapshot>>>,
    /// The textures of the previous revision, which a page may still be loading.
    before: Mutex<Option<(u64, Pictures)>>,
    /// True if inputs have changed since the last snapshot.
    stale: AtomicBool,
    /// Held while compiling, so that a file is compiled once and readers of the last snapshot need not wait.
    building: Mutex<()>,
    /// The number of pages that show it.
    viewers: AtomicUsize,
    /// Strokes that can be undone and redone.
    pub(super) history: Mutex<History>,
    /// The parameters that a page has set.
    given: Mutex<Given>,
    /// Its number among the documents.
    pub(super) id: u64,
    /// What is built of it, if it is a town.
    pub(super) town: TownSlot,
    /// True if inputs have changed since the last build of the town was started.
    town_stale: AtomicBool,
}

impl Document {
    /// Returns the options for reading it, with the parameters that a page has set.
    pub(super) fn options(&self, options: &Options) -> Options {
        parameters::with(options, &lock(&self.given))
    }

    /// Returns the last snapshot, if there is one.
    pub(super) fn last(&self) -> Option<Arc<Snapshot>> {
        lock(&self.snapshot).clone()
    }
}

/// A page that shows a document; counted while it exists.
pub(super) struct Viewer(Arc<Document>);

impl Drop for Viewer {
    fn drop(&mut self) {
        self.0.viewers.fetch_sub(1, Ordering::AcqRel);
    }
}

impl Workspace {
    /// Creates a workspace of all files below a folder, or of some of them.
    pub(super) fn new(
        root: PathBuf,
        only: Vec<String>,
        language: Language,
        (host, front): (Box<dyn EditorHost>, Option<Box<dyn FrontHost>>),
    ) -> Arc<Workspace> {
        Arc::new_cyclic(|me| Workspace {
            me: me.clone(),
            root,
            only,
            language,
            host,
            front,
            documents: Mutex::default(),
            updates: broadcast::channel(64).0,
            revision: AtomicU64::new(1),
        })
    }

    /// Returns the files that can be shown.
    pub(super) fn files(&self) -> Vec<FileEntry> {
        let mut list = vec![];
        if self.only.is_empty() {
            walk(&self.root, &self.root, DEPTH, &mut list);
        }
        list.extend(self.only.iter().map(|file| FileEntry {
            path: file.clone(),
            kind: self.kind(file).unwrap_or(TEXT),
        }));
        list
    }

    /// Returns the kind of a file that can be shown. A file opened by name is a source file whatever its extension.
    fn kind(&self, file: &str) -> Option<&'static str> {
        match self.only.iter().any(|only| only == file) {
            true => kind_of(file).or(Some(TEXT)),
            false if self.only.is_empty() => kind_of(file),
            false => None,
        }
    }

    /// Returns the one name of a file that is written in several ways: below the root, without dots and links.
    fn name_of(&self, file: &str) -> String {
        let written = Path::new(file).components();
        let plain: PathBuf = written.filter(|c| *c != Component::CurDir).collect();
        let real = self.root.join(&plain).canonicalize().ok();
        let real = real
            .as_deref()
            .and_then(|p| p.strip_prefix(&self.root).ok());
        let real = real.map(slashed).filter(|name| self.kind(name).is_some());
        real.unwrap_or_else(|| slashed(&plain))
    }

    /// Returns the document of a file.
    ///
    /// # Errors
    /// If the file is outside the folder, or is neither a source file nor a model.
    pub(super) fn document(&self, file: &str) -> io::Result<Arc<Document>> {
        if let Some(document) = lock(&self.documents).get(file) {
            return Ok(document.clone());
        }
        let file = &*self.name_of(file);
        let path = Path::new(file);
        let plain = path.components().all(|c| matches!(c, Component::Normal(_)));
        let known = plain && !file.contains('\\') && self.kind(file).is_some();
        let inside = |p: PathBuf| p.starts_with(&self.root) && p.is_file();
        // The host can read a file that the editor has not saved yet.
        let real = self.root.join(path).canonicalize();
        let exists = real.map_or_else(|_| self.host.bytes(&self.root.join(path)).is_ok(), inside);
        if !known || !exists {
            return Err(io::ErrorKind::NotFound.into());
        }
        let document = Arc::new(Document {
            file: file.into(),
            snapshot: Mutex::default(),
            before: Mutex::default(),
            stale: AtomicBool::new(false),
            building: Mutex::default(),
            viewers: AtomicUsize::new(0),
            history: Mutex::default(),
            given: Mutex::default(),
            id: self.revision.fetch_add(1, Ordering::Relaxed),
            town: TownSlot::default(),
            town_stale: AtomicBool::new(false),
        });
        let mut documents = lock(&self.documents);
        Ok(documents.entry(file.to_owned()).or_insert(document).clone())
    }

    /// Returns the path of a file below the root. It is checked at each use, because a link may have taken the place of
    /// a file since it was opened.
    ///
    /// # Errors
    /// If the file is outside the folder now.
    pub(super) fn path(&self, file: &str) -> io::Result<PathBuf> {
        let path = self.root.join(file);
        match path.canonicalize() {
            Ok(real) if !real.starts_with(&self.root) => Err(io::ErrorKind::NotFound.into()),
            // The host can read a file that the editor has not saved yet.
            Ok(_) | Err(_) => Ok(path),
        }
    }

    /// Returns the snapshot of a document, compiled if it is not up to date.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub(super) fn snapshot(&self, document: &Document) -> io::Result<Arc<Snapshot>> {
        // A snapshot with missing textures is never reused: they may exist now.
        let fresh = || {
            let last = document.last().filter(|snapshot| !snapshot.lacks);
            last.filter(|_| !document.stale.load(Ordering::Acquire))
        };
        if let Some(snapshot) = fresh() {
            // A page may have come since.
            self.start_town(document);
            return Ok(snapshot);
        }
        let _alone = lock(&document.building);
        let snapshot = match fresh() {
            Some(snapshot) => snapshot,
            None => {
                document.town_stale.store(true, Ordering::Release);
                self.renew(document)?.0
            }
        };
        self.start_town(document);
        Ok(snapshot)
    }

    /// Recompiles a document; returns whether the result differs. If not, the revision stays. The caller holds the
    /// `building` lock.
    fn renew(&self, document: &Document) -> io::Result<(Arc<Snapshot>, bool)> {
        // Changes from here on may not be in the result.
        document.stale.store(false, Ordering::Release);
        let new = self
            .build(document)
            .inspect_err(|_| document.stale.store(true, Ordering::Release))?;
        let mut snapshot = lock(&document.snapshot);
        if let Some(old) = snapshot.as_ref().filter(|old| old.same(&new)) {
            return Ok((old.clone(), false));
        }
        let new = Arc::new(new);
        let old = snapshot.replace(new.clone());
        *lock(&document.before) = old.map(|old| (old.revision, old.pictures.clone()));
        Ok((new, true))
    }

    /// Returns an external texture of a revision.
    pub(super) fn picture(&self, revision: u64, name: &str) -> Option<Vec<u8>> {
        let documents: Vec<Arc<Document>> = lock(&self.documents).values().cloned().collect();
        let both = |document: &Arc<Document>| {
            let now = document
                .last()
                .map(|snapshot| (snapshot.revision, snapshot.pictures.clone()));
            [now, lock(&document.before).clone()]
        };
        let mut known = documents.iter().flat_map(both).flatten();
        let (_, pictures) = known.find(|(own, _)| *own == revision)?;
        let mut pictures = pictures.iter();
        let found =
            pictures.find(|(own, _)| *own == name || model_file::requested_path(own) == name);
        found.map(|(_, bytes)| bytes.clone())
    }

    /// Opens the editor at a location in one of the sources of a document.
    ///
    /// # Errors
    /// If there is no such source or no editor.
    pub(super) fn open(
        &self,
        document: &Document,
        id: u32,
        [start, end]: [u32; 2],
    ) -> io::Result<()> {
        let snapshot = self.snapshot(document)?;
        let source = snapshot.sources.iter().find(|s| s.id() == FileId(id));
        let source = source.ok_or(io::ErrorKind::NotFound)?;
        let file = source.id();
        self.host.open(source, Span { file, start, end })
    }

    /// Notifies the pages of all documents that read a file of the cursor position in it, as a byte offset.
    pub(super) fn cursor(&self, path: &Path, at: usize) {
        let documents: Vec<Arc<Document>> = lock(&self.documents).values().cloned().collect();
        for document in documents {
            let snapshot = document.last();
            let sources = snapshot.iter().flat_map(|snapshot| &snapshot.sources);
            let mut read = sources.filter(|s| {
                let name = Path::new(s.name());
                name == path || name.canonicalize().is_ok_and(|real| real == path)
            });
            let place = read.next().map(|source| {
                let Span { start, end, .. } = source.span(at..at);
                let id = source.id().0;
                Cursor {
                    id,
                    span: [start, end],
                }
            });
            let file = document.file.clone();
            self.send(Update::Cursor { file, place });
        }
    }

    /// Compiles a file. A panic becomes an error.
    fn build(&self, document: &Document) -> io::Result<Snapshot> {
        let built = catch_unwind(AssertUnwindSafe(|| self.compile(document)));
        built.unwrap_or_else(|_| Err(io::Error::other("internal error")))
    }

    fn compile(&self, document: &Document) -> io::Result<Snapshot> {
        let file = &*document.file;
        let path = self.path(file)?;
        let revision = self.revision.fetch_add(1, Ordering::Relaxed);
        let place = (&*self.root, file);
        match self.kind(file) {
            Some(MODEL) => Snapshot::of_model(place, self.language, revision),
            Some(TILES) => {
                let folder = path.parent().unwrap_or(&self.root);
                let built = Arc::new(BuiltTown::of_folder(document.id, folder));
                *lock(&document.town.built) = Some(built.clone());
                Snapshot::of_tiles(file, &built, revision)
            }
            _ => {
                let text = || {
                    let town = (document.id, lock(&document.town.built).clone());
                    let read_as = |options: &Options| document.options(options);
                    let of = (&*self.host, &read_as as &ReadAs<'_>);
                    Snapshot::of_text(of, place, (self.language, revision), town)
                };
                let snapshot = text()?;
                // A parameter that the text no longer has is forgotten.
                let mut given = lock(&document.given);
                let before = given.len();
                given.retain(|name, _| snapshot.parameters.contains(name));
                let is_less = given.len() < before;
                drop(given);
                if is_less { text() } else { Ok(snapshot) }
            }
        }
    }

    /// Registers a viewer, which keeps the document up to date.
    pub(super) fn add_viewer(
        &self,
        document: &Arc<Document>,
    ) -> (Viewer, broadcast::Receiver<Update>) {
        document.viewers.fetch_add(1, Ordering::AcqRel);
        (Viewer(document.clone()), self.updates.subscribe())
    }

    /// Marks all documents as changed and recompiles those with viewers.
    pub(super) fn changed(&self) {
        let documents: Vec<Arc<Document>> = lock(&self.documents).values().cloned().collect();
        for document in documents {
            document.stale.store(true, Ordering::Release);
            document.town_stale.store(true, Ordering::Release);
            if document.viewers.load(Ordering::Acquire) == 0 {
                continue;
            }
            // Errors are ignored: editors briefly remove files while saving.
            let _ = self.renew_and_tell(&document);
            self.start_town(&document);
        }
    }

    /// Sets the parameters of a document, in place of all that were set before, and recompiles it.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub(super) fn set_parameters(&self, document: &Document, given: Given) -> io::Result<()> {
        let before = std::mem::replace(&mut *lock(&document.given), given.clone());
        if before == given {
            return Ok(());
        }
        document.stale.store(true, Ordering::Release);
        document.town_stale.store(true, Ordering::Release);
        self.renew_and_tell(document)?;
        self.start_town(document);
        Ok(())
    }

    /// Recompiles a document and tells the pages that show it, if it differs.
    fn renew_and_tell(&self, document: &Document) -> io::Result<()> {
        let _alone = lock(&document.building);
        let (snapshot, is_new) = self.renew(document)?;
        if is_new {
            let (file, revision) = (document.file.clone(), snapshot.revision);
            self.send(Update::State { file, revision });
        }
        Ok(())
    }

    /// Sends an update to all pages.
    pub(super) fn send(&self, updates: Update) {
        let _ = self.updates.send(updates);
    }
}

/// Returns the kind of a file by its name.
fn kind_of(file: &str) -> Option<&'static str> {
    if file == TILESET || file.ends_with("/tileset.json") {
        return Some(TILES);
    }
    let ending = Path::new(file).extension()?.to_str()?.to_ascii_lowercase();
    match &*ending {
        "hsd" | "xml" => Some(TEXT),
        "glb" => Some(MODEL),
        _ => None,
    }
}

/// Lists the files below a folder in alphabetical order, without hidden and build folders.
fn walk(root: &Path, folder: &Path, depth: usize, list: &mut Vec<FileEntry>) {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut paths: Vec<(PathBuf, fs::FileType)> = entries
        .filter_map(|e| Some((e.path(), e.file_type().ok()?)))
        .collect();
    paths.sort_by(|(a, _), (b, _)| a.cmp(b));
    // The models beside the root of tiles are its own.
    let is_tiles = |(path, _): &(PathBuf, fs::FileType)| path.ends_with(TILESET);
    if paths.iter().any(is_tiles) {
        paths.retain(is_tiles);
    }
    for (path, kind) in &paths {
        if kind.is_file() && list.len() < LISTED {
            let below = path.strip_prefix(root).ok();
            list.extend(below.and_then(|p| {
                let path = slashed(p);
                kind_of(&path).map(|kind| FileEntry { path, kind })
            }));
        }
    }
    for (path, kind) in paths {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let passed = name.starts_with('.') || name == "node_modules" || name == "target";
        if kind.is_dir() && depth > 0 && !passed {
            walk(root, &path, depth - 1, list);
        }
    }
}
