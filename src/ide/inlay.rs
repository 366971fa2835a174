//! What a text does not say and its reader wants to know: how long a line is, where the walk stands after it.

use super::Analysis;
use crate::diagnostic::{Language, Text};
use std::ops::Range;

/// A few words behind a place of the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Inlay {
    /// Behind what.
    pub at: usize,
    /// The words.
    pub label: String,
    /// What they mean.
    pub tooltip: Text,
}

/// The hints of a range, in the order of the text.
pub fn inlays(a: &Analysis, range: Range<usize>, language: Language) -> Vec<Inlay> {
    let _ = (a, range, language);
    vec![]
}
