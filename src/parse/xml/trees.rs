//! The elements of files that are read again and again, each time with another seed: they stay the same, whatever is
//! drawn from them.

use super::tree::Tree;
use crate::source::FileId;
use std::rc::Rc;

/// The content of the files that were read.
#[derive(Default)]
pub struct Trees<'a> {
    /// Of which file, and from which offset on.
    read: Vec<((FileId, usize), Rc<Tree<'a>>)>,
}

impl<'a> Trees<'a> {
    /// The elements of a file from this place on, if they were read before.
    pub(super) fn find(&self, file: FileId, at: usize) -> Option<Rc<Tree<'a>>> {
        let found = self.read.iter().find(|(place, _)| *place == (file, at));
        found.map(|(_, tree)| Rc::clone(tree))
    }

    /// Keeps the elements of a file.
    pub(super) fn keep(&mut self, file: FileId, at: usize, tree: Tree<'a>) -> Rc<Tree<'a>> {
        let tree = Rc::new(tree);
        self.read.push(((file, at), Rc::clone(&tree)));
        tree
    }
}
