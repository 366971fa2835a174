//! Tokens of a file: tags with their attributes, and text.

use crate::parse::xml::tree::text::Text;
use std::ops::Range;

/// `name="value"`.
#[derive(Clone)]
pub(in crate::parse::xml) struct Attribute<'a> {
    pub(in crate::parse::xml) name: &'a str,
    pub(in crate::parse::xml) name_range: Range<usize>,
    pub(in crate::parse::xml) value: Text<'a>,
    /// Name, `=` and value with its quotes.
    pub(in crate::parse::xml) range: Range<usize>,
    /// True if a problem with it was already reported, so that it is not reported again.
    pub(in crate::parse::xml) faulty: bool,
}

impl Attribute<'_> {
    /// Returns true if it belongs to other programs: name spaces, schema locations, xml:lang.
    pub(in crate::parse::xml) fn is_foreign(&self) -> bool {
        self.name.contains(':') || self.name == "xmlns"
    }
}

/// A token of the file.
pub(in crate::parse::xml) enum Token<'a> {
    /// `<name ...>` or `<name .../>`.
    Start(StartTag<'a>),
    /// `</name>`.
    End(EndTag<'a>),
    /// Text that may contain references.
    Text(Range<usize>),
    /// Text without references.
    Verbatim(Range<usize>),
}

/// `<name ...>` or `<name .../>`.
pub(in crate::parse::xml) struct StartTag<'a> {
    pub(in crate::parse::xml) name: &'a str,
    pub(in crate::parse::xml) name_range: Range<usize>,
    pub(in crate::parse::xml) range: Range<usize>,
    pub(in crate::parse::xml) attributes: Vec<Attribute<'a>>,
    pub(in crate::parse::xml) empty: bool,
    /// True if the `>` is present.
    pub(in crate::parse::xml) closed: bool,
}

/// `</name>`.
pub(in crate::parse::xml) struct EndTag<'a> {
    pub(in crate::parse::xml) name: &'a str,
    pub(in crate::parse::xml) range: Range<usize>,
}
