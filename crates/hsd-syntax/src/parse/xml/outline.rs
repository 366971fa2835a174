//! The elements of a file with their places, for [`Outline`].

use super::DEEPEST;
use super::language::{Segment, segments};
use super::read::{ReadSoFar, Reader};
use super::suggest::Suggest;
use super::tree::{self, Child, Tree};
use crate::parse::reporter::Reporter;
use crate::parse::schema;
use crate::parse::schema::Schema;
use crate::parse::syntax as made;
use crate::parse::xml::tree::chars::is_blank;
use crate::parse::xml::tree::text::Text;
use crate::parse::xml::tree::token::Attribute;
use hsd_base::source::Source;
use hsd_ir::ast::Item;
use made::{Expression, Outline, Words};
use std::ops::Range;

/// Adds the outline of the text from this offset.
pub(in crate::parse) fn outline(source: &Source, at: usize, nesting: usize) -> Outline {
    let mut reporter = Reporter::new(source);
    let tree = tree::read(
        &mut reporter,
        at,
        nesting.min(DEEPEST),
        schema::SCHEMA_HINTS,
    );
    let mut writer = OutlineWriter {
        text: source.text(),
        reader: Reader {
            views: vec![],
            again: ReadSoFar::default(),
            turn: None,
            unit: super::UNIT,
            tree: &tree,
            reporter: &mut reporter,
            suggest: Suggest::new(),
        },
        outline: Outline::default(),
    };
    for root in &tree.roots {
        writer.element(&tree, *root, None);
    }
    writer.outline.comments = comments(source.text(), at);
    writer.outline
}

struct OutlineWriter<'t, 'a> {
    text: &'a str,
    reader: Reader<'t, 'a>,
    outline: Outline,
}

impl OutlineWriter<'_, '_> {
    /// Adds an element and its content.
    fn element(&mut self, tree: &Tree<'_>, index: usize, parent: Option<usize>) {
        let element = &tree.elements[index];
        let own = self.outline.elements.len();
        let schema = schema::named(element.name);
        let attributes = element.attributes.iter();
        let attributes = attributes
            .map(|a| attribute(a, schema, self.text))
            .collect();
        self.outline.elements.push(made::Element {
            schema,
            name: element.name_range.clone(),
            end_name: end_name(self.text, &element.range, &element.tag, element.name),
            tag: element.tag.clone(),
            range: element.range.clone(),
            attributes,
            words: vec![],
            parent,
        });
        for child in &element.children {
            match child {
                Child::Element(index) => self.element(tree, *index, Some(own)),
                Child::Text(text) => {
                    let words = self.words(text);
                    self.outline.elements[own].words.push(words);
                }
            }
        }
    }

    fn words(&mut self, text: &Text<'_>) -> Words {
        let whole = text.as_str();
        let start = whole.len() - whole.trim_start_matches(is_blank).len();
        let end = whole.trim_end_matches(is_blank).len().max(start);
        let mut words = Words {
            range: text.range(start..end),
            codes: vec![],
            expressions: vec![],
        };
        for segment in segments(whole) {
            match segment {
                Segment::Plain(range) => {
                    let mut pieces = vec![];
                    self.reader.codes(&text.part(range), true, &mut pieces);
                    let codes = pieces.iter().filter_map(|item| match item {
                        Item::One(piece) => piece.code(),
                        _ => None,
                    });
                    let source = self.reader.reporter.source;
                    words.codes.extend(codes.map(|c| source.text_range(c.span)));
                }
                Segment::Expression(range) => words.expressions.push(expression(text, range)),
                Segment::Loose(_) => {}
            }
        }
        words
    }
}

fn attribute(from: &Attribute<'_>, schema: Option<&'static Schema>, text: &str) -> made::Attribute {
    let word = schema::canonical(from.name);
    let segments = segments(from.value.as_str()).into_iter();
    let expressions = segments.filter_map(|s| match s {
        Segment::Expression(range) => Some(expression(&from.value, range)),
        Segment::Plain(_) | Segment::Loose(_) => None,
    });
    made::Attribute {
        attribute_schema: schema.and_then(|s| s.attribute(word)),
        word: word.to_owned(),
        name: from.name_range.clone(),
        inner: inner(text, from),
        range: from.range.clone(),
        value: from.value.as_str().to_owned(),
        expressions: expressions.collect(),
    }
}

/// Returns the range between the quotes of a value; the whole range if they are missing.
fn inner(text: &str, attribute: &Attribute<'_>) -> Range<usize> {
    let value = attribute.value.whole();
    if !value.is_empty() {
        return value;
    }
    let range = &attribute.range;
    let written = &text[attribute.name_range.end.min(range.end)..range.end];
    let open = written
        .find(['"', '\''])
        .map(|i| range.end - written.len() + i + 1);
    let at = open.unwrap_or(range.end).min(range.end);
    at..at
}

fn expression(text: &Text<'_>, range: Range<usize>) -> Expression {
    Expression::new(text.as_str(), range, |part| text.range(part))
}

/// Returns the name in the end tag of an element, if it has one.
fn end_name(
    text: &str,
    range: &Range<usize>,
    tag: &Range<usize>,
    name: &str,
) -> Option<Range<usize>> {
    let inside = text.get(tag.end..range.end)?;
    let open = inside.rfind("</")? + 2;
    let written = inside[open..].strip_suffix('>')?.trim_end_matches(is_blank);
    let start = tag.end + open;
    (written == name).then_some(start..start + name.len())
}

/// Returns the comments from an offset on, with their marks.
fn comments(text: &str, from: usize) -> Vec<Range<usize>> {
    let (mut found, mut at) = (vec![], from);
    while let Some(open) = text[at..].find("<!--").map(|i| at + i) {
        let end = text[open + 4..]
            .find("-->")
            .map_or(text.len(), |i| open + 4 + i + 3);
        found.push(open..end);
        at = end;
    }
    found
}
