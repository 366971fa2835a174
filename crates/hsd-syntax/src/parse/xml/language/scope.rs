//! The names and definitions known at each place: nested frames, each with the names that one element defines.

use super::super::tree::Tree;
use hsd_base::source::Span;
use hsd_ir::ast::Value;
use std::cell::RefCell;
use std::collections::{BTreeMap, HashSet};
use std::rc::Rc;

/// The most names that are compared with a misspelt one: far more than anybody chooses among.
const MOST_NAMES: usize = 1000;

/// A shared frame.
pub(super) type Scope<'a> = Rc<Frame<'a>>;

/// The names that an element defines, and the frame around it.
#[derive(Default)]
pub(super) struct Frame<'a> {
    outer: Option<Scope<'a>>,
    names: RefCell<BTreeMap<String, Bound>>,
    pieces: RefCell<BTreeMap<String, DefinedPiece<'a>>>,
    /// Files included here and by these, each once.
    files: RefCell<Vec<Scope<'a>>>,
    /// True if the fields and measures of a feature are known in it.
    feature: bool,
}

/// The value of a name.
#[derive(Clone)]
pub(super) struct Bound {
    /// `None` = an error was reported.
    pub(super) value: Option<Value>,
    pub(super) place: Span,
}

/// A `define`.
#[derive(Clone)]
pub(super) struct DefinedPiece<'a> {
    pub(super) tree: Rc<Tree<'a>>,
    pub(super) index: usize,
    pub(super) place: Span,
}

impl DefinedPiece<'_> {
    /// Returns true if it is the same element.
    pub(super) fn is(&self, other: &DefinedPiece<'_>) -> bool {
        std::ptr::addr_eq(Rc::as_ptr(&self.tree), Rc::as_ptr(&other.tree))
            && self.index == other.index
    }
}

impl<'a> Frame<'a> {
    /// Creates the frame of a file.
    pub(super) fn outermost() -> Scope<'a> {
        Rc::new(Frame::default())
    }

    /// Creates a frame inside this one.
    pub(super) fn within(outer: &Scope<'a>) -> Scope<'a> {
        Rc::new(Frame {
            outer: Some(Rc::clone(outer)),
            ..Frame::default()
        })
    }

    /// Creates a frame inside this one in which the names of a feature are known.
    pub(super) fn of_feature(outer: &Scope<'a>) -> Scope<'a> {
        Rc::new(Frame {
            outer: Some(Rc::clone(outer)),
            feature: true,
            ..Frame::default()
        })
    }

    /// Returns true if the names of a feature are known here.
    pub(super) fn knows_feature(&self) -> bool {
        self.frames().any(|frame| frame.feature)
    }

    /// Returns the value of a name that is bound nearer than the names of the feature.
    pub(super) fn nearer_value(&self, name: &str) -> Option<Bound> {
        let mut feature = false;
        let near = self
            .frames()
            .take_while(|frame| !std::mem::replace(&mut feature, frame.feature));
        near.into_iter()
            .find_map(|frame| frame.names.borrow().get(name).cloned())
    }

    /// Binds a name; if it is bound in this frame already, returns its place.
    pub(super) fn bind(&self, name: &str, bound: Bound) -> Option<Span> {
        let mut names = self.names.borrow_mut();
        if let Some(before) = names.get(name) {
            return Some(before.place);
        }
        names.insert(name.to_owned(), bound);
        None
    }

    /// Names a definition; if another has the name in this frame, returns its place.
    pub(super) fn define(&self, name: &str, piece: DefinedPiece<'a>) -> Option<Span> {
        let mut pieces = self.pieces.borrow_mut();
        if let Some(before) = pieces.get(name) {
            return (!before.is(&piece)).then_some(before.place);
        }
        pieces.insert(name.to_owned(), piece);
        None
    }

    /// Imports the names of a file.
    pub(super) fn import(&self, file: &Scope<'a>) {
        let mut files = self.files.borrow_mut();
        let further = file.files.borrow();
        for file in std::iter::once(file).chain(further.iter()) {
            if !files.iter().any(|f| Rc::ptr_eq(f, file)) {
                files.push(Rc::clone(file));
            }
        }
    }

    /// Returns the value of a name.
    pub(super) fn value(&self, name: &str) -> Option<Bound> {
        let own = |frame: &Frame<'a>| frame.names.borrow().get(name).cloned();
        self.frames().find_map(|frame| {
            let files = frame.files.borrow();
            own(frame).or_else(|| files.iter().find_map(|f| own(f)))
        })
    }

    /// Returns a definition, and the frame that contains it.
    pub(super) fn piece(self: &Rc<Self>, name: &str) -> Option<(DefinedPiece<'a>, Scope<'a>)> {
        let own = |frame: &Scope<'a>| {
            let found = frame.pieces.borrow().get(name).cloned();
            found.map(|piece| (piece, Rc::clone(frame)))
        };
        let mut next = Some(self);
        while let Some(frame) = next {
            let files = frame.files.borrow();
            let found = own(frame).or_else(|| files.iter().find_map(own));
            if found.is_some() {
                return found;
            }
            next = frame.outer.as_ref();
        }
        None
    }

    /// Returns all names known here, the nearest first.
    pub(super) fn names(&self) -> Vec<String> {
        let keys = |frame: &Frame<'a>| {
            frame
                .names
                .borrow()
                .keys()
                .take(MOST_NAMES)
                .cloned()
                .collect()
        };
        self.gather(keys)
    }

    /// Returns all definitions known here, the nearest first.
    pub(super) fn pieces(&self) -> Vec<String> {
        let keys = |frame: &Frame<'a>| {
            frame
                .pieces
                .borrow()
                .keys()
                .take(MOST_NAMES)
                .cloned()
                .collect()
        };
        self.gather(keys)
    }

    fn gather(&self, keys: impl Fn(&Frame<'a>) -> Vec<String>) -> Vec<String> {
        let (mut found, mut known) = (vec![], HashSet::new());
        for frame in self.frames() {
            let files = frame.files.borrow();
            let files = files.iter().flat_map(|f| keys(f));
            for name in keys(frame).into_iter().chain(files) {
                if found.len() == MOST_NAMES {
                    return found;
                }
                if known.insert(name.clone()) {
                    found.push(name);
                }
            }
        }
        found
    }

    /// Returns this frame and those around it.
    fn frames(&self) -> impl Iterator<Item = &Frame<'a>> {
        std::iter::successors(Some(self), |frame| frame.outer.as_deref())
    }
}
