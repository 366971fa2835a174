//! File access of documents: unsaved texts in the editor take precedence over files on disk.

use super::settings::Settings;
use hsd_base::source::{FileId, IncludeError, Limits, PictureFile, Source, Stream, World};
use hsd_driver::Options;
use hsd_driver::fs::FolderWorld;
use hsd_passes::expand;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::{fs, io};

/// Returns the canonical form of a path, also if the file does not exist.
pub(super) fn key(path: &Path) -> PathBuf {
    if let Ok(real) = path.canonicalize() {
        return real;
    }
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => {
                plain.pop();
            }
            other => plain.push(other),
        }
    }
    // The folder may exist even if the file does not.
    let real = plain.parent().and_then(|p| p.canonicalize().ok());
    match (real, plain.file_name()) {
        (Some(folder), Some(name)) => folder.join(name),
        _ => plain,
    }
}

/// Open texts by [`key`], each with a byte order mark.
pub(super) type Open = BTreeMap<PathBuf, Arc<str>>;

/// The byte order mark, which marks a document as UTF-8 whatever encoding its XML declaration names.
pub(super) const MARK: &str = "\u{feff}";

/// Returns a document with a byte order mark.
pub(super) fn marked(text: &str) -> String {
    let mark = if text.starts_with(MARK) { "" } else { MARK };
    [mark, text].concat()
}

/// Files on disk, overlaid by open texts.
pub(super) struct Overlay<'a> {
    /// Files on disk.
    pub(super) disk: FolderWorld,
    /// Folders below which includes are allowed.
    pub(super) roots: Vec<PathBuf>,
    /// Open texts by [`key`].
    pub(super) open: &'a Open,
    /// The requested files by [`key`], whether they exist or not.
    asked: Mutex<BTreeSet<PathBuf>>,
}

impl<'a> Overlay<'a> {
    /// Creates the file access for a document in this folder.
    pub(super) fn new(folder: Option<&Path>, settings: &Settings, open: &'a Open) -> Overlay<'a> {
        let own = || folder.map(Path::to_owned).into_iter();
        let textures = match &settings.textures[..] {
            [] => own().chain(own().map(|f| f.join("textures"))).collect(),
            given => given.to_vec(),
        };
        let roots: Vec<PathBuf> = match &settings.root {
            Some(root) => vec![root.clone()],
            None => own().collect(),
        };
        Overlay {
            disk: FolderWorld::new(textures, Limits::default().pixels).with_roots(roots.clone()),
            roots,
            open,
            asked: Mutex::default(),
        }
    }

    /// Returns the requested files by [`key`], whether they exist or not.
    pub(super) fn into_asked(self) -> BTreeSet<PathBuf> {
        let asked = self.asked.into_inner();
        asked.unwrap_or_else(PoisonError::into_inner)
    }

    fn note(&self, key: PathBuf) {
        let mut asked = self.asked.lock().unwrap_or_else(PoisonError::into_inner);
        asked.insert(key);
    }

    /// Returns the compiler options; unreadable files of custom parts are left out.
    pub(super) fn options(&self, settings: &Settings) -> Options {
        let read = settings.catalogs.iter().filter_map(|path| {
            let key = key(path);
            let bytes = match self.open.get(&key) {
                Some(text) => Some(text.as_bytes().to_vec()),
                None => small(path),
            };
            self.note(key);
            Some((path, bytes?))
        });
        let catalogs: Vec<Source> = read
            .zip(1..)
            .map(|((path, bytes), id)| Source::new(FileId(id), path.to_string_lossy(), &bytes))
            .collect();
        Options {
            expand: expand::Options {
                seed: settings.seed,
                limits: Limits::default(),
            },
            parameters: settings.parameters.clone(),
            catalogs: catalogs.into(),
            ..Options::default()
        }
    }

    /// Returns the path of an open text that is not on disk, if it may be included.
    fn unsaved(&self, from: &str, href: &str) -> Option<String> {
        let path = Path::new(from).parent()?.join(href);
        let key = key(&path);
        let inside = |root: &PathBuf| root.canonicalize().is_ok_and(|r| key.starts_with(r));
        let there = self.open.contains_key(&key) && self.roots.iter().any(inside);
        there.then(|| key.to_str().map(str::to_owned))?
    }
}

/// Returns the contents of a file, unless it is too large.
fn small(path: &Path) -> Option<Vec<u8>> {
    let limit = Limits::default().bytes as u64;
    let size = fs::metadata(path).ok()?.len();
    (size <= limit).then(|| fs::read(path).ok())?
}

impl World for Overlay<'_> {
    fn picture(&self, name: &str) -> Option<PictureFile> {
        self.disk.picture(name)
    }

    fn picture_bytes(&self, path: &str) -> io::Result<Vec<u8>> {
        self.disk.picture_bytes(path)
    }

    fn image(&self, from: &str, href: &str) -> Result<PictureFile, IncludeError> {
        self.disk.image(from, href)
    }

    fn text(&self, from: &str, href: &str) -> Result<String, IncludeError> {
        let asked = Path::new(from).parent().unwrap_or(Path::new("")).join(href);
        self.note(key(&asked));
        match self.disk.text(from, href) {
            Err(IncludeError::Missing) => self.unsaved(from, href).ok_or(IncludeError::Missing),
            found => found,
        }
    }

    fn names(&self, from: &str, folder: &str) -> Result<Vec<String>, IncludeError> {
        let asked = Path::new(from).parent().unwrap_or(Path::new(""));
        self.note(key(&asked.join(folder)));
        self.disk.names(from, folder)
    }

    fn open(&self, path: &str) -> io::Result<Box<dyn Stream>> {
        self.disk.open(path)
    }

    fn stamp(&self, path: &str) -> Option<u64> {
        self.disk.stamp(path)
    }

    fn on_disk(&self, path: &str) -> Option<PathBuf> {
        self.disk.on_disk(path)
    }

    fn text_bytes(&self, path: &str, limit: usize) -> io::Result<Vec<u8>> {
        let open = self.open.get(&key(Path::new(path)));
        match open {
            Some(text) => Ok(text.as_bytes()[..text.len().min(limit.saturating_add(1))].to_vec()),
            None => self.disk.text_bytes(path, limit),
        }
    }
}
