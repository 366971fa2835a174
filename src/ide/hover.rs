//! What stands at a place of a text, told in Markdown.

use super::Analysis;
use crate::diagnostic::Language;
use std::ops::Range;

/// What is told of a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hover {
    /// What it is told of; holds the place.
    pub range: Range<usize>,
    /// In Markdown.
    pub markdown: String,
}

/// What stands at an offset. `pictures` = cards of parts show a picture, as a `data:` URI; some clients show its raw text.
pub fn hover(a: &Analysis, at: usize, language: Language, pictures: bool) -> Option<Hover> {
    let _ = (a, at, language, pictures);
    None
}
