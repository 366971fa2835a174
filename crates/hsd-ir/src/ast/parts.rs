//! Custom parts as written: `PartDef` with its attributes and bodies, not yet interpreted. The catalogue reads them,
//! since it knows the elements of bodies; a part with a base is merged from the attributes and bodies of both.

use hsd_base::source::{Span, Spanned};
use serde::Serialize;

/// One `PartDef`.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct WrittenPart {
    /// The element name in the start tag.
    pub span: Span,
    /// The whole element with the blanks before it, so that it can be removed.
    #[serde(skip)]
    pub whole: Option<Span>,
    /// The attributes of the start tag.
    pub attributes: Vec<WrittenAttribute>,
    /// Its bodies, and changes to those of its base.
    pub body: Vec<WrittenBody>,
}

/// An attribute.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WrittenAttribute {
    /// The name of the attribute.
    pub name: Spanned<String>,
    /// Its value unchanged: blanks count in codes.
    pub value: Spanned<String>,
}

/// An element in a part.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WrittenBody {
    /// The element name.
    pub word: Spanned<String>,
    /// The element name in its end tag.
    #[serde(skip)]
    pub end: Option<Span>,
    /// The attributes of its start tag.
    pub attributes: Vec<WrittenAttribute>,
    /// Its child elements.
    pub children: Vec<WrittenBody>,
}

/// Returns the attribute of a name.
pub fn attribute_value<'s>(
    attributes: &'s [WrittenAttribute],
    name: &str,
) -> Option<&'s Spanned<String>> {
    let found = attributes.iter().find(|a| a.name.value == name);
    found.map(|a| &a.value)
}
