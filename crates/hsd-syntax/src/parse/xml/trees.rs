//! The elements of files that are read repeatedly, each time with another seed: they do not depend on the seed.

use super::tree::Tree;
use hsd_base::source::FileId;
use std::rc::Rc;

/// The trees of the files that were read.
#[derive(Default)]
pub struct Trees<'a> {
    /// The trees by file and start offset.
    read: Vec<((FileId, usize), Rc<Tree<'a>>)>,
}

impl<'a> Trees<'a> {
    /// Returns the tree of a file from this offset on, if it was read before.
    pub(super) fn find(&self, file: FileId, at: usize) -> Option<Rc<Tree<'a>>> {
        let found = self.read.iter().find(|(place, _)| *place == (file, at));
        found.map(|(_, tree)| Rc::clone(tree))
    }

    /// Keeps the tree of a file.
    pub(super) fn keep(&mut self, file: FileId, at: usize, tree: Tree<'a>) -> Rc<Tree<'a>> {
        let tree = Rc::new(tree);
        self.read.push(((file, at), Rc::clone(&tree)));
        tree
    }
}
