//! Files that the sources of a run include, each read once.

use crate::source::{FileId, Source};
use std::cell::{Cell, OnceCell};

/// The limit that a file would exceed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CacheFull {
    /// That of files.
    Files,
    /// That of bytes of all files.
    Bytes,
}

/// The number of files that the program itself may add: the types of the library and the examples.
const OWN: usize = 64;

/// Files in the order of reading. They can be added while others are in use, and stay where they are.
#[derive(Debug)]
pub struct SourceCache {
    slots: Vec<OnceCell<Source>>,
    first: usize,
    /// The number of files that may still be added, beside those of the program itself.
    files: Cell<usize>,
    /// The number of bytes that may still be added.
    room: Cell<usize>,
}

impl SourceCache {
    /// Creates a cache with room for this many files and bytes; files are numbered from `first`.
    pub fn new(first: usize, files: usize, bytes: usize) -> SourceCache {
        SourceCache {
            slots: std::iter::repeat_with(OnceCell::new)
                .take(files + OWN)
                .collect(),
            first,
            files: Cell::new(files),
            room: Cell::new(bytes),
        }
    }

    /// Returns the file of this name.
    pub fn find(&self, name: &str) -> Option<&Source> {
        let there = self.slots.iter().map_while(OnceCell::get);
        there.into_iter().find(|s| s.name() == name)
    }

    /// Adds a file.
    ///
    /// # Errors
    /// If there is no room for it.
    pub fn add(&self, name: &str, bytes: &[u8]) -> Result<&Source, CacheFull> {
        let files = self.files.get().checked_sub(1).ok_or(CacheFull::Files)?;
        let room = self.room.get().checked_sub(bytes.len());
        let room = room.ok_or(CacheFull::Bytes)?;
        let added = self.add_own(name, bytes)?;
        self.files.set(files);
        self.room.set(room);
        Ok(added)
    }

    /// Adds a file that is part of the program, which counts towards no limit.
    ///
    /// # Errors
    /// If there are more of them than expected.
    pub fn add_own(&self, name: &str, bytes: &[u8]) -> Result<&Source, CacheFull> {
        let index = self.slots.iter().position(|s| s.get().is_none());
        let index = index.ok_or(CacheFull::Files)?;
        let id = u32::try_from(self.first + index).map_err(|_| CacheFull::Files)?;
        Ok(self.slots[index].get_or_init(|| Source::new(FileId(id), name, bytes)))
    }

    /// Returns the files.
    pub fn into_sources(self) -> Vec<Source> {
        let sources = self.slots.into_iter();
        sources.map_while(OnceCell::into_inner).collect()
    }
}
