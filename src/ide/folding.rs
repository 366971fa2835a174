//! What of a text can be folded away.

use super::Analysis;
use std::ops::Range;

/// What is folded away.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FoldKind {
    /// A comment, or several lines of them.
    Comment,
    /// An element, or a house or section of the legacy form.
    Region,
    /// Several includes.
    Imports,
}

/// Something that can be folded away; it covers more than one line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fold {
    /// From the first character of its first line on that stays, to the last that vanishes.
    pub range: Range<usize>,
    /// What it is.
    pub kind: FoldKind,
}

/// What can be folded away, in the order of the text.
pub fn folds(a: &Analysis) -> Vec<Fold> {
    let _ = a;
    vec![]
}
