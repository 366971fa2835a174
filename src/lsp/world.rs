//! Texts as they stand in the editor: what is open and not yet saved goes before what lies on disk.

use crate::disk::FolderWorld;
use crate::source::{NoText, PictureFile, World};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Component, Path, PathBuf};

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

/// Files on disk with open texts before them.
pub(super) struct Overlay<'a> {
    /// What lies on disk.
    pub(super) disk: FolderWorld,
    /// Folders below which texts may be included.
    pub(super) roots: Vec<PathBuf>,
    /// Open texts by [`key`].
    pub(super) open: &'a BTreeMap<PathBuf, String>,
    /// The texts that were asked for, by [`key`], whether they are there or not.
    pub(super) asked: RefCell<BTreeSet<PathBuf>>,
}

impl Overlay<'_> {
    /// A text that is open and not on disk, if it may be read.
    fn unsaved(&self, from: &str, href: &str) -> Option<String> {
        let path = Path::new(from).parent()?.join(href);
        let key = key(&path);
        let inside = |root: &PathBuf| root.canonicalize().is_ok_and(|r| key.starts_with(r));
        let there = self.open.contains_key(&key) && self.roots.iter().any(inside);
        there.then(|| key.to_str().map(str::to_owned))?
    }
}

impl World for Overlay<'_> {
    fn picture(&self, name: &str) -> Option<PictureFile> {
        self.disk.picture(name)
    }

    fn picture_bytes(&self, path: &str) -> io::Result<Vec<u8>> {
        self.disk.picture_bytes(path)
    }

    fn image(&self, from: &str, href: &str) -> Result<PictureFile, NoText> {
        self.disk.image(from, href)
    }

    fn text(&self, from: &str, href: &str) -> Result<String, NoText> {
        let asked = Path::new(from).parent().unwrap_or(Path::new("")).join(href);
        self.asked.borrow_mut().insert(key(&asked));
        match self.disk.text(from, href) {
            Err(NoText::Missing) => self.unsaved(from, href).ok_or(NoText::Missing),
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
