//! The markup of a well-formed file as written: nothing is resolved, nothing is left out.

use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;
use std::ops::Range;

/// The maximum depth of elements, as in the reader of the language, since the printer recurses.
const DEEPEST: usize = 256;

/// A node of the file.
pub(super) enum RawNode<'a> {
    /// Text with its references.
    Text(&'a str),
    /// `<![CDATA[...]]>`.
    Verbatim(&'a str),
    /// `<?...?>`, including the declaration.
    Instruction(&'a str),
    /// `<!--...-->`.
    Comment {
        /// With its marks.
        text: &'a str,
        /// Columns before it on its line.
        column: usize,
    },
    /// `<x ...>...</x>` or `<x .../>`.
    Element(Element<'a>),
}

/// An element.
pub(super) struct Element<'a> {
    pub(super) name: &'a str,
    pub(super) attributes: Vec<Attribute<'a>>,
    pub(super) children: Vec<RawNode<'a>>,
}

/// `name="value"`.
pub(super) struct Attribute<'a> {
    pub(super) name: &'a str,
    /// With its quotes.
    pub(super) value: &'a str,
}

/// Returns the nodes of a source file; `None` if it is not well-formed, has a document type, or nests too deep.
pub(super) fn read(text: &str) -> Option<Vec<RawNode<'_>>> {
    let mut reader = Reader::from_str(text);
    let mut open: Vec<Element<'_>> = vec![];
    let mut nodes = vec![];
    let mut run: Option<Range<usize>> = None;
    loop {
        let start = reader.buffer_position() as usize;
        let event = reader.read_event().ok()?;
        let range = start..reader.buffer_position() as usize;
        if matches!(event, Event::Text(_) | Event::GeneralRef(_)) {
            run = Some(run.map_or(range.start, |r| r.start)..range.end);
            continue;
        }
        if let Some(run) = run.take() {
            nodes.push(RawNode::Text(&text[run]));
        }
        let raw = &text[range.clone()];
        match event {
            Event::Start(tag) => {
                let mut element = element(text, &tag)?;
                // The preceding siblings are kept in `children` until the end tag.
                std::mem::swap(&mut element.children, &mut nodes);
                open.push(element);
                (open.len() <= DEEPEST).then_some(())?;
            }
            Event::Empty(tag) => nodes.push(RawNode::Element(element(text, &tag)?)),
            Event::End(_) => {
                let mut element = open.pop()?;
                std::mem::swap(&mut element.children, &mut nodes);
                nodes.push(RawNode::Element(element));
            }
            Event::CData(_) => nodes.push(RawNode::Verbatim(raw)),
            Event::Decl(_) | Event::PI(_) => nodes.push(RawNode::Instruction(raw)),
            Event::Comment(_) => nodes.push(RawNode::Comment {
                text: raw,
                column: column(text, range.start),
            }),
            Event::Eof => return open.is_empty().then_some(nodes),
            _ => return None,
        }
    }
}

/// Returns the places of the comments.
pub(super) fn comments(text: &str) -> Vec<Range<usize>> {
    let mut found = vec![];
    each(text, |event, range| {
        if let Event::Comment(_) = event {
            found.push(range);
        }
    });
    found
}

/// Returns the places of the tags of a name, and the value of the first attribute of each with its quotes.
pub(super) fn elements<'a>(text: &'a str, name: &str) -> Vec<(Range<usize>, &'a str)> {
    let mut found = vec![];
    each(text, |event, range| {
        if let Event::Start(tag) | Event::Empty(tag) = event
            && let Some(element) = element(text, &tag)
            && element.name == name
        {
            found.push((range, element.attributes.first().map_or("", |a| a.value)));
        }
    });
    found
}

/// Visits every event of a source file with its range, up to the first error.
fn each<'a>(text: &'a str, mut see: impl FnMut(Event<'a>, Range<usize>)) {
    let mut reader = Reader::from_str(text);
    loop {
        let start = reader.buffer_position() as usize;
        match reader.read_event() {
            Err(_) | Ok(Event::Eof) => return,
            Ok(event) => see(event, start..reader.buffer_position() as usize),
        }
    }
}

fn element<'a>(text: &'a str, tag: &BytesStart<'_>) -> Option<Element<'a>> {
    let part = |part: &str| {
        let start = (part.as_ptr() as usize).checked_sub(text.as_ptr() as usize)?;
        (start + part.len() <= text.len()).then_some(start..start + part.len())
    };
    let mut attributes = vec![];
    for attribute in tag.attributes() {
        let attribute = attribute.ok()?;
        let (name, value) = (part(attribute.key.as_ref())?, part(&attribute.value)?);
        attributes.push(Attribute {
            name: &text[name],
            value: text.get(value.start.checked_sub(1)?..value.end + 1)?,
        });
    }
    Some(Element {
        name: &text[part(tag.name().as_ref())?],
        attributes,
        children: vec![],
    })
}

/// Returns the number of columns before an offset on its line.
fn column(text: &str, at: usize) -> usize {
    let line = text[..at].rfind(['\n', '\r']).map_or(0, |i| i + 1);
    super::columns(&text[line..at])
}
