//! Custom parts as written: `PartDef` with its attributes and bodies, not yet understood. The catalogue reads them, since
//! it knows the elements of bodies; a part with a base is put together from the words of both.

use crate::source::{Span, Spanned};
use serde::Serialize;

/// One `PartDef`.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct WrittenPart {
    /// Its name in the start tag.
    pub span: Span,
    /// All of it with the blanks before it, so that it can be left out.
    #[serde(skip)]
    pub whole: Option<Span>,
    /// The attributes of the start tag.
    pub attributes: Vec<WrittenAttribute>,
    /// Its bodies, and changes of those of its base.
    pub body: Vec<WrittenBody>,
}

/// An attribute.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WrittenAttribute {
    /// Its name.
    pub name: Spanned<String>,
    /// Its text as it is: blanks count in codes.
    pub value: Spanned<String>,
}

/// An element in a part.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WrittenBody {
    /// Its name.
    pub word: Spanned<String>,
    /// Its name again, in its end tag.
    #[serde(skip)]
    pub end: Option<Span>,
    /// The attributes of its start tag.
    pub attributes: Vec<WrittenAttribute>,
    /// The content.
    pub children: Vec<WrittenBody>,
}

/// The attribute of a name.
pub fn attribute_value<'s>(
    attributes: &'s [WrittenAttribute],
    name: &str,
) -> Option<&'s Spanned<String>> {
    let found = attributes.iter().find(|a| a.name.value == name);
    found.map(|a| &a.value)
}
