//! The scopes of names: each element that defines names is a frame, and so is each file; a place sees the names that
//! its frame defines before it, then those of the enclosing frames, and those of the files they include.

use crate::parse::names::file::word;
use crate::parse::syntax::Outline;
use std::collections::{BTreeMap, BTreeSet};

/// The frames of a source file and of the files that were read for it.
#[derive(Clone, Debug, Default)]
pub struct Scopes {
    pub frames: Vec<Frame>,
    /// The frames of each file.
    pub of: Vec<Frames>,
}

/// The names that an element defines.
#[derive(Clone, Debug, Default)]
pub struct Frame {
    outer: Option<usize>,
    /// True for the frame of a definition: its surroundings are evaluated where it is used.
    piece: bool,
    pub values: BTreeMap<String, Binding>,
    pub pieces: BTreeMap<String, Binding>,
    /// The frames of included files, and the offset from which each is known.
    pub files: Vec<(usize, usize)>,
}

/// A name in a frame.
#[derive(Clone, Debug)]
pub struct Binding {
    /// Its number in the index.
    pub symbol: usize,
    /// Its definitions: in several branches, or again further on.
    pub given: Vec<Definition>,
}

/// The place of a definition.
#[derive(Clone, Copy, Debug)]
pub struct Definition {
    /// The number of the file.
    pub file: usize,
    /// The `let`, `Param` or `define`.
    pub element: usize,
    /// The attribute that names it: `name`, or of a `define` the parameter itself.
    pub attribute: usize,
    /// The offset from which it is known.
    pub from: usize,
}

/// The frames of one file: around each element, and in it.
#[derive(Clone, Debug, Default)]
pub struct Frames {
    pub around: Vec<usize>,
    pub inside: Vec<usize>,
    /// The frame around all of them.
    pub outermost: usize,
}

impl Scopes {
    /// Creates a frame.
    pub fn frame(&mut self, outer: Option<usize>, piece: bool) -> usize {
        self.frames.push(Frame {
            outer,
            piece,
            ..Frame::default()
        });
        self.frames.len() - 1
    }

    /// Returns the frame of an offset of a file.
    pub fn at(&self, file: usize, outline: &Outline, at: usize) -> usize {
        let frames = &self.of[file];
        let Some(own) = outline.element_at(at) else {
            return frames.outermost;
        };
        let element = &outline.elements[own];
        let inside = at >= element.tag.end || word(element) == "define";
        if inside {
            frames.inside[own]
        } else {
            frames.around[own]
        }
    }

    /// Returns the frames known at a place, the innermost first, each with the offset up to which it counts; `None` =
    /// all of it.
    fn known(&self, frame: usize, at: Option<usize>) -> Vec<(usize, Option<usize>)> {
        let (mut found, mut next, mut at) = (vec![], Some(frame), at);
        while let Some(index) = next {
            let frame = &self.frames[index];
            found.push((index, at));
            self.included(frame, at, &mut found);
            // Around a definition, the names at its use are known, which are not visible from here.
            if frame.piece {
                at = None;
            }
            next = frame.outer;
        }
        found
    }

    /// Adds the frames of the files that a frame includes before a place.
    fn included(&self, frame: &Frame, at: Option<usize>, found: &mut Vec<(usize, Option<usize>)>) {
        for (file, from) in &frame.files {
            let new = found.iter().all(|f| f != &(*file, None));
            if new && at.is_none_or(|at| *from <= at) {
                found.push((*file, None));
                self.included(&self.frames[*file], None, found);
            }
        }
    }

    /// Returns the meaning of a name in a frame at a place.
    pub fn value(&self, frame: usize, name: &str, at: usize) -> Option<usize> {
        let known = self.known(frame, Some(at)).into_iter();
        let mut values = known.filter_map(|(f, at)| Some((self.frames[f].values.get(name)?, at)));
        let value = values.find(|(value, at)| value.before(*at).is_some());
        value.map(|(value, _)| value.symbol)
    }

    /// Returns the values known in a frame at a place, the nearest first; each name once.
    pub fn values(&self, frame: usize, at: usize) -> Vec<Definition> {
        let (mut names, mut found) = (BTreeSet::new(), vec![]);
        for (frame, at) in self.known(frame, Some(at)) {
            let all = self.frames[frame].values.iter();
            let all = all.filter_map(|(name, value)| Some((name, value.before(at)?)));
            let mut new: Vec<Definition> = all
                .filter(|(n, _)| names.insert(*n))
                .map(|(_, g)| g)
                .collect();
            new.sort_by_key(|g| std::cmp::Reverse(g.from));
            found.extend(new);
        }
        found
    }

    /// Returns the definition of a name.
    pub fn piece(&self, frame: usize, name: &str) -> Option<usize> {
        let mut known = self.known(frame, None).into_iter();
        let piece = known.find_map(|(f, _)| self.frames[f].pieces.get(name));
        piece.map(|p| p.symbol)
    }

    /// Returns the definitions known in a frame, the nearest first; each name once.
    pub fn pieces(&self, frame: usize) -> Vec<(&str, &Binding)> {
        let (mut names, mut found) = (BTreeSet::new(), vec![]);
        for (frame, _) in self.known(frame, None) {
            let all = self.frames[frame].pieces.iter();
            let new = all.filter(|(name, _)| names.insert(*name));
            found.extend(new.map(|(name, piece)| (name.as_str(), piece)));
        }
        found
    }
}

impl Binding {
    /// Returns the last place that defines it before an offset; `None` = anywhere.
    fn before(&self, at: Option<usize>) -> Option<Definition> {
        let known = |g: &&Definition| at.is_none_or(|at| g.from <= at);
        self.given.iter().rfind(known).copied()
    }
}
