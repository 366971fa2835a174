//! Notices what is saved. Editors write a file in several steps: they are waited for, but no longer than a reader would
//! notice.

use super::hall::{Hall, News};
use notify_debouncer_full::notify::event::{AccessKind, AccessMode, ModifyKind};
use notify_debouncer_full::notify::{
    self, Event, EventKind, RecommendedWatcher, RecursiveMode, Watcher,
};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::sync::{Arc, Weak};
use std::thread;
use std::time::{Duration, Instant};

/// A pause after which a file that nobody has closed counts as written.
const QUIET: Duration = Duration::from_millis(12);
/// How long changes one after the other are gathered.
const PATIENCE: Duration = Duration::from_millis(60);

/// Folders under watch; they are left when it is dropped.
pub(super) struct Watch {
    _watcher: RecommendedWatcher,
}

/// Watches folders, and tells the hall of what is saved in them.
///
/// # Errors
/// Where the system cannot watch a folder.
pub(super) fn watch(
    hall: &Arc<Hall>,
    folders: &[(PathBuf, RecursiveMode)],
) -> notify::Result<Watch> {
    let (sender, events) = mpsc::channel();
    let mut watcher = notify::recommended_watcher(move |event| {
        let _ = sender.send(event);
    })?;
    for (folder, mode) in folders {
        watcher.watch(folder, *mode)?;
    }
    let only = hall.only.as_ref().map(|only| hall.root.join(only));
    let hall = Arc::downgrade(hall);
    thread::Builder::new()
        .name("hsd watch".to_owned())
        .spawn(move || tell(&events, &hall, only.as_deref()))
        .map_err(notify::Error::io)?;
    Ok(Watch { _watcher: watcher })
}

/// Tells the hall until either is gone. `only` is a file that is read whatever its name ends with.
fn tell(events: &Receiver<notify::Result<Event>>, hall: &Weak<Hall>, only: Option<&Path>) {
    let is_read = |path: &Path| only == Some(path) || is_read(path);
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
        let Some(hall) = hall.upgrade() else { return };
        if batch.texts {
            hall.changed();
        }
        if batch.files {
            hall.tell(News::Files);
        }
    }
}

/// What has happened at once.
#[derive(Default)]
struct Batch {
    /// Something that texts are made of has changed.
    texts: bool,
    /// Files have come or gone.
    files: bool,
    /// The last of it is whole: a file was closed, or put in the place of another.
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
            EventKind::Modify(ModifyKind::Name(_)) => (self.files, self.closed) = (true, true),
            EventKind::Create(_) | EventKind::Remove(_) => self.files = true,
            _ => {}
        }
        self.texts = true;
    }
}

/// Whether a file may be read for a text, or shown. A folder that comes or goes may hold some.
fn is_read(path: &Path) -> bool {
    let Some(ending) = path.extension() else {
        return !path.is_file();
    };
    let ending = ending.to_str();
    let read = ["hsd", "xml", "png", "jpg", "jpeg", "ktx2", "glb"];
    ending.is_some_and(|e| read.iter().any(|r| e.eq_ignore_ascii_case(r)))
}
