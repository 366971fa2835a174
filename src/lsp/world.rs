//! Texts as they stand in the editor: what is open and not yet saved goes before what lies on disk.

use super::settings::Settings;
use crate::driver::Options;
use crate::expand;
use crate::fs::FolderWorld;
use crate::source::{FileId, IncludeError, Limits, PictureFile, Source, World};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::{fs, io};

/// What a path is known by, however it is written and whatever links lead to it.
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
    // The file may not be there yet while its folder is.
    let real = plain.parent().and_then(|p| p.canonicalize().ok());
    match (real, plain.file_name()) {
        (Some(folder), Some(name)) => folder.join(name),
        _ => plain,
    }
}

/// Open texts by [`key`], each with the mark that says it is UTF-8.
pub(super) type Open = BTreeMap<PathBuf, Arc<str>>;

/// Says that a file is UTF-8, whatever its XML declaration says: editors hand over characters.
pub(super) const MARK: &str = "\u{feff}";

/// A text as others see it that read it.
pub(super) fn marked(text: &str) -> String {
    let mark = if text.starts_with(MARK) { "" } else { MARK };
    [mark, text].concat()
}

/// Files on disk with open texts before them.
pub(super) struct Overlay<'a> {
    /// What lies on disk.
    pub(super) disk: FolderWorld,
    /// Folders below which texts may be included.
    pub(super) roots: Vec<PathBuf>,
    /// Open texts by [`key`].
    pub(super) open: &'a Open,
    /// The files that were asked for, by [`key`], whether they are there or not.
    asked: Mutex<BTreeSet<PathBuf>>,
}

impl<'a> Overlay<'a> {
    /// The files that a text in this folder may use.
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

    /// Returns the files that were asked for, by [`key`], whether they exist or not.
    pub(super) fn into_asked(self) -> BTreeSet<PathBuf> {
        let asked = self.asked.into_inner();
        asked.unwrap_or_else(PoisonError::into_inner)
    }

    fn note(&self, key: PathBuf) {
        let mut asked = self.asked.lock().unwrap_or_else(PoisonError::into_inner);
        asked.insert(key);
    }

    /// The options of a run; files of custom parts that cannot be read are left out.
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
            .zip(1u16..)
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

    /// A text that is open and not on disk, if it may be read.
    fn unsaved(&self, from: &str, href: &str) -> Option<String> {
        let path = Path::new(from).parent()?.join(href);
        let key = key(&path);
        let inside = |root: &PathBuf| root.canonicalize().is_ok_and(|r| key.starts_with(r));
        let there = self.open.contains_key(&key) && self.roots.iter().any(inside);
        there.then(|| key.to_str().map(str::to_owned))?
    }
}

/// The bytes of a file that is not too large.
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

    fn text_bytes(&self, path: &str, limit: usize) -> io::Result<Vec<u8>> {
        let open = self.open.get(&key(Path::new(path)));
        match open {
            Some(text) => Ok(text.as_bytes()[..text.len().min(limit.saturating_add(1))].to_vec()),
            None => self.disk.text_bytes(path, limit),
        }
    }
}
