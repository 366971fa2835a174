//! Files that the sources of a run include, each read once.

use crate::source::{FileId, Source};
use std::cell::OnceCell;

/// Files in the order of reading. They can be added while others are in use, and stay where they are.
#[derive(Debug)]
pub struct SourceCache {
    slots: Vec<OnceCell<Source>>,
    first: usize,
}

impl SourceCache {
    /// Creates a cache with room for this many files, numbered from `first`.
    pub fn new(first: usize, room: usize) -> SourceCache {
        SourceCache {
            slots: std::iter::repeat_with(OnceCell::new).take(room).collect(),
            first,
        }
    }

    /// Returns the file of this name.
    pub fn find(&self, name: &str) -> Option<&Source> {
        let there = self.slots.iter().map_while(OnceCell::get);
        there.into_iter().find(|s| s.name() == name)
    }

    /// Adds a file; `None` if the cache is full.
    pub fn add(&self, name: &str, bytes: &[u8]) -> Option<&Source> {
        let index = self.slots.iter().position(|s| s.get().is_none())?;
        let id = u32::try_from(self.first + index).ok()?;
        Some(self.slots[index].get_or_init(|| Source::new(FileId(id), name, bytes)))
    }

    /// Returns the files.
    pub fn into_sources(self) -> Vec<Source> {
        let sources = self.slots.into_iter();
        sources.map_while(OnceCell::into_inner).collect()
    }
}
