//! Own parts as written: `PartDef` with its attributes and bodies, not yet understood. The catalogue reads them, since
//! it knows the elements of bodies; a part with a base is put together from the words of both.

use crate::source::{Span, Spanned};
use serde::Serialize;

/// One `PartDef`.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PartEntry {
    /// Its name in the start tag.
    pub span: Span,
    /// All of it with the blanks before it, so that it can be left out.
    #[serde(skip)]
    pub whole: Option<Span>,
    /// What the start tag says.
    pub attributes: Vec<Said>,
    /// Its bodies, and changes of those of its base.
    pub body: Vec<BodyEntry>,
}

/// An attribute.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Said {
    /// Its name.
    pub name: Spanned<String>,
    /// Its text as it stands: blanks count in codes.
    pub value: Spanned<String>,
}

/// An element in a part.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BodyEntry {
    /// Its name.
    pub word: Spanned<String>,
    /// Its name again, in its end tag.
    #[serde(skip)]
    pub end: Option<Span>,
    /// What its start tag says.
    pub attributes: Vec<Said>,
    /// What stands in it.
    pub children: Vec<BodyEntry>,
}

/// The attribute of a name.
pub fn said<'s>(attributes: &'s [Said], name: &str) -> Option<&'s Spanned<String>> {
    let found = attributes.iter().find(|a| a.name.value == name);
    found.map(|a| &a.value)
}
