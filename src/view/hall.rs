//! What is shown: the files below a folder, each built when it is first asked for, and again when something that it is
//! made of has changed while a page looks at it.

use super::beside;
use super::desk::Desk;
use super::made::{Made, slashed};
use super::strokes::History;
use crate::diagnostic::Language;
use crate::source::{FileId, Span};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Component, Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tokio::sync::broadcast;

/// Files of a folder that are listed at most, and how deep folders are searched.
const LISTED: usize = 2000;
const DEPTH: usize = 6;

/// Kinds of files.
pub(super) const TEXT: &str = "text";
pub(super) const MODEL: &str = "model";

/// What pages hear of.
#[derive(Clone, Debug)]
pub(super) enum News {
    /// A file makes something else now.
    State { file: Arc<str>, revision: u64 },
    /// The editor stands at another place of a file, or in none.
    Cursor {
        file: Arc<str>,
        place: Option<Cursor>,
    },
    /// There are other files.
    Files,
}

/// A place in one of the texts that were read for a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub(super) struct Cursor {
    /// Which text; 0 = the file itself.
    id: u16,
    /// Bytes of it.
    span: [u32; 2],
}

/// A file that may be shown.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(super) struct Listed {
    /// Below the root, with `/`.
    pub(super) path: String,
    pub(super) kind: &'static str,
}

/// Everything that is shown, and who looks at it.
pub(super) struct Hall {
    /// All links followed; nothing above it is read.
    pub(super) root: PathBuf,
    /// The only file that is shown, if it is one.
    pub(super) only: Option<String>,
    pub(super) language: Language,
    pub(super) desk: Box<dyn Desk>,
    rooms: Mutex<BTreeMap<String, Arc<Room>>>,
    news: broadcast::Sender<News>,
    revision: AtomicU64,
}

/// Pictures beside a model, by their names in it.
type Pictures = Arc<BTreeMap<String, Vec<u8>>>;

/// A file that was asked for.
pub(super) struct Room {
    pub(super) file: Arc<str>,
    made: Mutex<Option<Arc<Made>>>,
    /// Its pictures of the revision before: a page may still be fetching them.
    before: Mutex<Option<(u64, Pictures)>>,
    /// Whether something has changed since.
    stale: AtomicBool,
    /// Held while it is built, so that nobody builds it twice and whoever looks at what there is need not wait.
    building: Mutex<()>,
    /// How many pages look at it.
    eyes: AtomicUsize,
    /// What was drawn in it.
    pub(super) history: Mutex<History>,
}

impl Room {
    /// What was made of it last, as far as is known.
    pub(super) fn last(&self) -> Option<Arc<Made>> {
        lock(&self.made).clone()
    }
}

/// Somebody who looks at a file.
pub(super) struct Eye(Arc<Room>);

impl Drop for Eye {
    fn drop(&mut self) {
        self.0.eyes.fetch_sub(1, Ordering::AcqRel);
    }
}

/// Takes a lock; what a thread that failed has left is as good as before, since whole values are put in.
pub(super) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Hall {
    /// A hall of all files below a folder, or of one of them.
    pub(super) fn new(
        root: PathBuf,
        only: Option<String>,
        language: Language,
        desk: Box<dyn Desk>,
    ) -> Hall {
        Hall {
            root,
            only,
            language,
            desk,
            rooms: Mutex::default(),
            news: broadcast::channel(64).0,
            revision: AtomicU64::new(1),
        }
    }

    /// The files that may be shown.
    pub(super) fn files(&self) -> Vec<Listed> {
        let mut list = vec![];
        match &self.only {
            Some(file) => list.push(Listed {
                path: file.clone(),
                kind: self.kind(file).unwrap_or(TEXT),
            }),
            None => walk(&self.root, &self.root, DEPTH, &mut list),
        }
        list
    }

    /// What a file is, if it may be shown. The only one that was asked for is a text whatever its name ends with.
    fn kind(&self, file: &str) -> Option<&'static str> {
        match &self.only {
            Some(only) if only == file => kind_of(file).or(Some(TEXT)),
            Some(_) => None,
            None => kind_of(file),
        }
    }

    /// The room of a file.
    ///
    /// # Errors
    /// Where it may not be shown: it lies elsewhere, or is no text or model.
    pub(super) fn room(&self, file: &str) -> io::Result<Arc<Room>> {
        if let Some(room) = lock(&self.rooms).get(file) {
            return Ok(room.clone());
        }
        let path = Path::new(file);
        let plain = path.components().all(|c| matches!(c, Component::Normal(_)));
        let known = plain && !file.contains('\\') && self.kind(file).is_some();
        let inside = |p: PathBuf| p.starts_with(&self.root) && p.is_file();
        // A file that an editor has not saved yet is read by the desk.
        let real = self.root.join(path).canonicalize();
        let there = real.map_or_else(|_| self.desk.bytes(&self.root.join(path)).is_ok(), inside);
        if !known || !there {
            return Err(io::ErrorKind::NotFound.into());
        }
        let room = Arc::new(Room {
            file: file.into(),
            made: Mutex::default(),
            before: Mutex::default(),
            stale: AtomicBool::new(false),
            building: Mutex::default(),
            eyes: AtomicUsize::new(0),
            history: Mutex::default(),
        });
        let mut rooms = lock(&self.rooms);
        Ok(rooms.entry(file.to_owned()).or_insert(room).clone())
    }

    /// What a file makes; built unless it is known.
    ///
    /// # Errors
    /// Where it cannot be read.
    pub(super) fn made(&self, room: &Room) -> io::Result<Arc<Made>> {
        // What is missing may be there now: whoever looks again is shown that.
        let fresh = || {
            let last = room.last().filter(|made| !made.lacks);
            last.filter(|_| !room.stale.load(Ordering::Acquire))
        };
        if let Some(made) = fresh() {
            return Ok(made);
        }
        let _alone = lock(&room.building);
        match fresh() {
            Some(made) => Ok(made),
            None => self.renew(room).map(|(made, _)| made),
        }
    }

    /// Builds a file again; whether it makes something else now. Where it does not, its revision stays. The lock of its
    /// building is held.
    fn renew(&self, room: &Room) -> io::Result<(Arc<Made>, bool)> {
        // What changes from here on is not yet in what is built.
        room.stale.store(false, Ordering::Release);
        let new = self
            .build(&room.file)
            .inspect_err(|_| room.stale.store(true, Ordering::Release))?;
        let mut made = lock(&room.made);
        if let Some(old) = made.as_ref().filter(|old| old.same(&new)) {
            return Ok((old.clone(), false));
        }
        let new = Arc::new(new);
        let old = made.replace(new.clone());
        *lock(&room.before) = old.map(|old| (old.revision, old.pictures.clone()));
        Ok((new, true))
    }

    /// A picture beside the model of a revision.
    pub(super) fn picture(&self, revision: u64, name: &str) -> Option<Vec<u8>> {
        let rooms: Vec<Arc<Room>> = lock(&self.rooms).values().cloned().collect();
        let both = |room: &Arc<Room>| {
            let now = room
                .last()
                .map(|made| (made.revision, made.pictures.clone()));
            [now, lock(&room.before).clone()]
        };
        let mut known = rooms.iter().flat_map(both).flatten();
        let (_, pictures) = known.find(|(own, _)| *own == revision)?;
        let mut pictures = pictures.iter();
        let found = pictures.find(|(own, _)| *own == name || beside::asked(own) == name);
        found.map(|(_, bytes)| bytes.clone())
    }

    /// Sends the editor to a place of a text that was read for a file.
    ///
    /// # Errors
    /// Where there is no such text, or no editor.
    pub(super) fn open(&self, room: &Room, id: u16, [start, end]: [u32; 2]) -> io::Result<()> {
        let made = self.made(room)?;
        let source = made.sources.iter().find(|s| s.id() == FileId(id));
        let source = source.ok_or(io::ErrorKind::NotFound)?;
        let file = source.id();
        self.desk.open(source, Span { file, start, end })
    }

    /// The editor stands at an offset of a text: whatever is shown that was read from it hears of that.
    pub(super) fn cursor(&self, path: &Path, at: usize) {
        let rooms: Vec<Arc<Room>> = lock(&self.rooms).values().cloned().collect();
        for room in rooms {
            let made = room.last();
            let sources = made.iter().flat_map(|made| &made.sources);
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
            let file = room.file.clone();
            self.tell(News::Cursor { file, place });
        }
    }

    /// Builds a file. A fault of the program is one of this file, and ends no thread.
    fn build(&self, file: &str) -> io::Result<Made> {
        let built = catch_unwind(AssertUnwindSafe(|| self.build_it(file)));
        built.unwrap_or_else(|_| Err(io::Error::other("a fault of the program")))
    }

    fn build_it(&self, file: &str) -> io::Result<Made> {
        let revision = self.revision.fetch_add(1, Ordering::Relaxed);
        let place = (&*self.root, file);
        match self.kind(file) {
            Some(MODEL) => Made::of_model(place, self.language, revision),
            _ => Made::of_text(&*self.desk, place, self.language, revision),
        }
    }

    /// Looks at a file: it is kept up from now on.
    pub(super) fn look(&self, room: &Arc<Room>) -> (Eye, broadcast::Receiver<News>) {
        room.eyes.fetch_add(1, Ordering::AcqRel);
        (Eye(room.clone()), self.news.subscribe())
    }

    /// Something has changed: what is looked at is built anew, the rest when it is asked for.
    pub(super) fn changed(&self) {
        let rooms: Vec<Arc<Room>> = lock(&self.rooms).values().cloned().collect();
        for room in rooms {
            room.stale.store(true, Ordering::Release);
            if room.eyes.load(Ordering::Acquire) == 0 {
                continue;
            }
            let _alone = lock(&room.building);
            // A file that is gone for a moment, as editors do it, is shown as it was.
            if let Ok((made, true)) = self.renew(&room) {
                let (file, revision) = (room.file.clone(), made.revision);
                self.tell(News::State { file, revision });
            }
        }
    }

    /// Tells all pages; where nobody looks, nobody hears.
    pub(super) fn tell(&self, news: News) {
        let _ = self.news.send(news);
    }
}

/// What a file is, if its ending says so.
fn kind_of(file: &str) -> Option<&'static str> {
    let ending = Path::new(file).extension()?.to_str()?.to_ascii_lowercase();
    match &*ending {
        "hsd" | "xml" => Some(TEXT),
        "glb" => Some(MODEL),
        _ => None,
    }
}

/// The files below a folder, in the order of their names; hidden folders and those of programs are passed over.
fn walk(root: &Path, folder: &Path, depth: usize, list: &mut Vec<Listed>) {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut paths: Vec<(PathBuf, fs::FileType)> = entries
        .filter_map(|e| Some((e.path(), e.file_type().ok()?)))
        .collect();
    paths.sort_by(|(a, _), (b, _)| a.cmp(b));
    for (path, kind) in &paths {
        if kind.is_file() && list.len() < LISTED {
            let below = path.strip_prefix(root).ok();
            list.extend(below.and_then(|p| {
                let path = slashed(p);
                kind_of(&path).map(|kind| Listed { path, kind })
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
