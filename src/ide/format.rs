//! A text laid out anew, as edits of those lines only that change.

use super::Analysis;
use std::ops::Range;

/// What takes the place of a range.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// What goes.
    pub range: Range<usize>,
    /// What comes.
    pub text: String,
}

/// The edits that lay the text out, in its order; `None` where its meaning is in doubt.
pub fn format(a: &Analysis) -> Option<Vec<Edit>> {
    let _ = a;
    None
}

/// Those of them that touch the lines of a range.
pub fn format_range(a: &Analysis, range: Range<usize>) -> Option<Vec<Edit>> {
    let _ = (a, range);
    None
}
