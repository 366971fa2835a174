//! A source file with its outline, and the names in its elements.

use crate::parse::syntax::{Attribute, Element, Outline};
use hsd_base::source::FileId;
use std::ops::Range;

/// A source file with its outline.
#[derive(Clone, Copy)]
pub struct File<'a> {
    /// Number of the file in spans.
    pub id: FileId,
    /// Name of the file.
    pub name: &'a str,
    /// Contents.
    pub text: &'a str,
    /// Elements of the file.
    pub outline: &'a Outline,
}

/// Returns the name of an element in the language, if it is one.
pub fn word(element: &Element) -> &'static str {
    element.schema.map_or("", |s| s.name)
}

/// Returns the range of a value without white space at its ends; `None` if it contains references or is empty.
pub fn trimmed(text: &str, attribute: &Attribute) -> Option<Range<usize>> {
    let written = text.get(attribute.inner.clone())?;
    if written != attribute.value || written.trim().is_empty() {
        return None;
    }
    let start = attribute.inner.start + written.len() - written.trim_start().len();
    Some(start..start + written.trim().len())
}

/// Returns the attributes of a `define` or a `use` that are parameters, with their numbers and their names as written.
pub fn parameters<'e>(
    text: &'e str,
    element: &'e Element,
) -> impl Iterator<Item = (usize, &'e str, &'e Attribute)> {
    let all = element.attributes.iter().enumerate();
    let all = all.map(|(number, a)| (number, &text[a.name.clone()], a));
    all.filter(|(_, name, _)| *name != "name" && *name != "xmlns" && !name.contains(':'))
}

/// Returns the attribute that names an element, and its name.
pub fn named(text: &str, element: &Element) -> Option<(usize, Range<usize>)> {
    let mut all = element.attributes.iter().enumerate();
    let (number, name) = all.find(|(_, a)| a.word == "name")?;
    let fixed = name.expressions.is_empty();
    Some((number, trimmed(text, name).filter(|_| fixed)?))
}
