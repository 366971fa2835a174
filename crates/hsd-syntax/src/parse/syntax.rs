//! The outline of a source file as its author sees it: every line, element, attribute, code and expression with its
//! place, before anything is computed. Editors use it; the passes do not.
//!
//! Invariants: ranges are of [`Source::text`](hsd_base::source::Source::text) and lie within it, on borders of characters;
//! elements are in the order of their start tags, each after its parent; codes are in the order of the file. Every file
//! has an outline, however malformed; errors are reported by [`parse`](crate::parse::parse), not here.

use crate::parse::expr;
use crate::parse::schema::{AttributeSchema, Schema};
use std::ops::Range;

/// Returns true if a string is a valid name of a value: letters, digits and `_`, and not a reserved word.
pub fn is_name(text: &str) -> bool {
    expr::is_name(text) && !expr::RESERVED.contains(&text)
}

/// The outline of one source file.
#[derive(Clone, Debug, Default)]
pub struct Outline {
    /// The lines of the legacy form, without their line ends; none in an XML file.
    pub lines: Vec<LegacyLine>,
    /// The elements of the XML form.
    pub elements: Vec<Element>,
    /// The comments of both forms, with their marks.
    pub comments: Vec<Range<usize>>,
}

/// The kind of a line of the legacy form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineKind {
    /// White space only.
    Blank,
    /// A comment.
    Comment,
    /// `%` between houses.
    Separator,
    /// Place, heights or a setting.
    Header,
    /// Codes.
    Wall,
    /// A roof.
    Roof,
}

/// A line of the legacy form.
#[derive(Clone, Debug)]
pub struct LegacyLine {
    /// Without its line end.
    pub range: Range<usize>,
    /// Its kind.
    pub kind: LineKind,
    /// The codes of a wall line.
    pub codes: Vec<Range<usize>>,
    /// The letter at the end of a wall line, or its `^`.
    pub turn: Option<Range<usize>>,
}

/// An element of the XML form.
#[derive(Clone, Debug)]
pub struct Element {
    /// Its schema; `None` = not an element of the language, e.g. a body element.
    pub schema: Option<&'static Schema>,
    /// Its name in the start tag.
    pub name: Range<usize>,
    /// Its name in the end tag, if it has one.
    pub end_name: Option<Range<usize>>,
    /// The start tag.
    pub tag: Range<usize>,
    /// From the start tag to the end tag.
    pub range: Range<usize>,
    /// In the order of the file.
    pub attributes: Vec<Attribute>,
    /// The text directly in it.
    pub words: Vec<Words>,
    /// Its parent.
    pub parent: Option<usize>,
}

impl Element {
    /// Returns the attribute of a name.
    pub fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|a| a.word == name)
    }

    /// Returns the value of an attribute.
    pub fn value(&self, name: &str) -> Option<&str> {
        self.attribute(name).map(|a| &*a.value)
    }
}

/// `name="value"`.
#[derive(Clone, Debug)]
pub struct Attribute {
    /// Its schema.
    pub attribute_schema: Option<&'static AttributeSchema>,
    /// Its canonical name: `texturecode` is `code`.
    pub word: String,
    /// The name as written.
    pub name: Range<usize>,
    /// The value between the quotes.
    pub inner: Range<usize>,
    /// Name, `=` and value with its quotes.
    pub range: Range<usize>,
    /// The value without references.
    pub value: String,
    /// The expressions in it.
    pub expressions: Vec<Expression>,
}

/// A run of text in an element.
#[derive(Clone, Debug)]
pub struct Words {
    /// From its first character that is not white space to its last.
    pub range: Range<usize>,
    /// Codes of five columns, or fewer at a line's end.
    pub codes: Vec<Range<usize>>,
    /// The expressions in it.
    pub expressions: Vec<Expression>,
}

/// An expression in braces.
#[derive(Clone, Debug)]
pub struct Expression {
    /// With its braces.
    pub range: Range<usize>,
    /// The names in it.
    pub names: Vec<Range<usize>>,
}

impl Expression {
    /// Returns the expression at a range of a value, braces included; `place` maps a range of the value to the file. A name
    /// in which a reference such as `&amp;` stands is left out: it is not written there as it is read.
    pub(super) fn new(
        value: &str,
        range: Range<usize>,
        place: impl Fn(Range<usize>) -> Range<usize>,
    ) -> Expression {
        let start = range.start + 1;
        let inner = value.get(start..range.end - 1).unwrap_or_default();
        let names = expr::names(inner).into_iter();
        let names = names.filter_map(|name| {
            let written = place(start + name.start..start + name.end);
            (written.len() == name.len()).then_some(written)
        });
        Expression {
            names: names.collect(),
            range: place(range),
        }
    }
}

impl Outline {
    /// Returns the innermost element whose range contains an offset; at a border the one that begins there.
    pub fn element_at(&self, at: usize) -> Option<usize> {
        let last = self.elements.partition_point(|e| e.range.start <= at);
        let mut next = last.checked_sub(1);
        while let Some(index) = next {
            let element = &self.elements[index];
            if at < element.range.end || (at == element.range.end && element.end_name.is_none()) {
                return Some(index);
            }
            next = element.parent;
        }
        None
    }

    /// Returns the line of the legacy form at an offset.
    pub fn line_at(&self, at: usize) -> Option<usize> {
        let index = self.lines.partition_point(|l| l.range.end < at);
        self.lines
            .get(index)?
            .range
            .contains(&at)
            .then_some(index)
            .or_else(|| (self.lines[index].range.end == at).then_some(index))
    }

    /// Returns an element and its ancestors, innermost first.
    pub fn around(&self, element: usize) -> impl Iterator<Item = usize> + '_ {
        std::iter::successors(Some(element), |e| self.elements[*e].parent)
    }

    /// Returns true if an offset lies in a comment.
    pub fn in_comment(&self, at: usize) -> bool {
        let next = self.comments.partition_point(|c| c.end < at);
        let hit = self.comments.get(next);
        hit.is_some_and(|c| c.start < at && at <= c.end)
    }
}
