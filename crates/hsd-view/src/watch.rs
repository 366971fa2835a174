//! Watches folders for saved files. Editors write a file in several steps, which are gathered into one update.

use super::workspace::{Update, Workspace};
use notify_debouncer_full::notify::event::{AccessKind, AccessMode, ModifyKind};
use notify_debouncer_full::notify::{
    self, Event, EventKind, RecommendedWatcher, RecursiveMode, Watcher,
};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::sync::{Arc, Weak};
use std::thread;
use std::time::{Duration, Instant};

/// The pause after which a file counts as written, even if it was not closed. Linux announces the closing, and a file that
/// has just been emptied is not taken for its new content while the writer waits for a processor.
const QUIET: Duration = Duration::from_millis(if cfg!(target_os = "linux") { 250 } else { 12 });
/// The maximum time that consecutive changes are gathered.
const PATIENCE: Duration = Duration::from_millis(if cfg!(target_os = "linux") { 500 } else { 60 });

/// The extensions of maps, of the tables of towns and of the roots of tiles.
const MAPS: &[&str] = &[
    "csv", "geojson", "geojsonl", "json", "shp", "dbf", "prj", "cpg", "gpkg", "fgb", "parquet",
    "osm", "pbf", "gml", "gz", "tif", "tiff", "asc", "txt", "tsv",
];

/// The watched folders; watching ends on drop.
pub(super) struct Watch {
    _watcher: RecommendedWatcher,
}

/// Watches folders and notifies the workspace of saved files.
///
/// # Errors
/// If a folder cannot be watched.
pub(super) fn watch(
    workspace: &Arc<Workspace>,
    folders: &[(PathBuf, RecursiveMode)],
) -> notify::Result<Watch> {
    let (sender, events) = mpsc::channel();
    let mut watcher = notify::recommended_watcher(move |event| {
        let _ = sender.send(event);
    })?;
    for (folder, mode) in folders {
        watcher.watch(folder, *mode)?;
    }
    let only = workspace.only.iter().map(|only| workspace.root.join(only));
    let only: Vec<PathBuf> = only.collect();
    let workspace = Arc::downgrade(workspace);
    thread::Builder::new()
        .name("hsd watch".to_owned())
        .spawn(move || send(&events, &workspace, &only))
        .map_err(notify::Error::io)?;
    Ok(Watch { _watcher: watcher })
}

/// Forwards events until the watcher or the workspace is dropped. Those of `only` are read whatever their extension.
fn send(events: &Receiver<notify::Result<Event>>, workspace: &Weak<Workspace>, only: &[PathBuf]) {
    let is_read = |path: &Path| only.iter().any(|only| only == path) || is_read(path);
    while let Ok(first) = events.recv() {
        let mut batch = Batch::default();
        batch.take(&first, is_read);
        let until = Instant::now() + PATIENCE;
        while !batch.closed && Instant::now() < until {
            match events.recv_timeout(QUIET) {
                Ok(event) => batch.take(&event, is_read),
                Err(RecvTimeoutError::Timeout) => break,
                Err(RecvTimeoutError::Disconnected) => return,
            }
        }
        let Some(workspace) = workspace.upgrade() else {
            return;
        };
        if batch.texts {
            workspace.changed();
        }
        if batch.files {
            workspace.send(Update::Files);
        }
    }
}

/// The changes of an update.
#[derive(Default)]
struct Batch {
    /// A source file, an included file or an image has changed.
    texts: bool,
    /// Files have been added or removed.
    files: bool,
    /// The last change is complete: a file was closed or renamed.
    closed: bool,
}

impl Batch {
    fn take(&mut self, event: &notify::Result<Event>, is_read: impl Fn(&Path) -> bool) {
        let Ok(event) = event else { return };
        if !event.paths.iter().any(|p| is_read(p)) {
            return;
        }
        self.closed = false;
        match event.kind {
            EventKind::Access(AccessKind::Close(AccessMode::Write)) => self.closed = true,
            EventKind::Access(_) => return,
            EventKind::Modify(ModifyKind::Name(_)) | EventKind::Remove(_) => {
                (self.files, self.closed) = (true, true);
            }
            EventKind::Create(_) => self.files = true,
            _ => {}
        }
        self.texts = true;
    }
}

/// Returns whether a file can be shown or read by a source file. Folders may contain such files.
fn is_read(path: &Path) -> bool {
    let Some(ending) = path.extension() else {
        return !path.is_file();
    };
    let ending = ending.to_str();
    let read = ["hsd", "xml", "png", "jpg", "jpeg", "ktx2", "glb"];
    let mut all = read.iter().chain(MAPS);
    ending.is_some_and(|e| all.any(|r| e.eq_ignore_ascii_case(r)))
}
