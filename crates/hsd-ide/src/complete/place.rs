//! The surroundings of a place in a file in the XML form, by its characters alone: the file is being edited, and
//! unclosed tags would mislead a reader of the whole.

use hsd_syntax::parse::schema;
use hsd_syntax::parse::schema::Schema;
use std::ops::Range;

/// The syntactic role of a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum CursorPlace {
    /// A place without proposals: in a comment, a declaration, after the name of an end tag.
    Nowhere,
    /// Among elements and codes.
    Content,
    /// In the name of a start tag, after `<`.
    TagName(Tag),
    /// In an end tag, with its range.
    EndTag(Range<usize>),
    /// In the name of an attribute, or where one may begin.
    AttributeName(Tag, Range<usize>),
    /// In the value of an attribute.
    Value(Tag, usize),
}

/// A start tag, possibly incomplete.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Tag {
    pub(crate) name: Range<usize>,
    pub(crate) attributes: Vec<TagAttribute>,
    /// The offset after `>`, or where it breaks off.
    pub(crate) end: usize,
    /// True if it ends with `/>`.
    pub(crate) empty: bool,
    /// True if it ends with `>`.
    pub(crate) closed: bool,
}

/// An attribute in a tag.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct TagAttribute {
    pub(crate) name: Range<usize>,
    /// The value between the quotes, or the place for it.
    pub(crate) inner: Option<Range<usize>>,
    /// True if it has quotes.
    pub(crate) quoted: bool,
}

/// The open elements around a place, outermost first: their names and start tags.
pub(crate) type Open<'t> = Vec<(&'t str, usize)>;

/// Returns the role of an offset, and the elements open around it.
pub(crate) fn place(text: &str, at: usize) -> (CursorPlace, Open<'_>) {
    let mut open: Open<'_> = vec![];
    let mut from = 0;
    while let Some(start) = text[from..].find('<').map(|i| from + i) {
        if start >= at {
            break;
        }
        let rest = &text[start..];
        let skipped = [
            ("<!--", "-->"),
            ("<![CDATA[", "]]>"),
            ("<?", "?>"),
            ("<!", ">"),
        ];
        if let Some((mark, end)) = skipped.iter().find(|(mark, _)| rest.starts_with(mark)) {
            let end = rest
                .get(mark.len()..)
                .and_then(|r| r.find(end).map(|i| start + mark.len() + i + end.len()));
            match end.filter(|end| *end <= at) {
                Some(end) => from = end,
                None => return (CursorPlace::Nowhere, open),
            }
            continue;
        }
        if rest.starts_with("</") {
            let end = start + 2 + word(&text[start + 2..]);
            if at <= end {
                return (CursorPlace::EndTag(start..end), open);
            }
            let name = &text[start + 2..end];
            if let Some(depth) = open.iter().rposition(|(n, _)| *n == name) {
                open.truncate(depth);
            }
            let close = text[end..].find(['>', '<']).map_or(text.len(), |i| end + i);
            let ended = text[close..].starts_with('>');
            if at <= close && ended {
                return (CursorPlace::Nowhere, open);
            }
            from = if ended { close + 1 } else { close };
            continue;
        }
        let tag = tag(text, start);
        if at < tag.end || at == tag.end && !tag.closed {
            return (within(tag, at), open);
        }
        from = tag.end.max(start + 1);
        enter(&mut open, text, start, &tag);
    }
    (CursorPlace::Content, open)
}

/// Opens an element, unless it is empty, nameless or a leaf.
fn enter<'t>(open: &mut Open<'t>, text: &'t str, start: usize, tag: &Tag) {
    let name = &text[tag.name.clone()];
    if tag.empty || name.is_empty() || schema::named(name).is_some_and(Schema::is_leaf) {
        return;
    }
    // An element that cannot contain its own kind ends where the next begins.
    if let Some(last) = open
        .iter()
        .rposition(|(n, _)| *n == name && SINGLE.contains(n))
    {
        open.truncate(last);
    }
    open.push((name, start));
}

/// Elements that never contain their own kind.
const SINGLE: [&str; 8] = [
    "Row", "Storey", "House", "Floor", "Facade", "Loop", "Roofs", "PartDef",
];

/// Returns the start tag that begins here.
pub(crate) fn tag(text: &str, start: usize) -> Tag {
    let name = start + 1..start + 1 + word(&text[start + 1..]);
    let mut tag = Tag {
        end: name.end,
        name,
        ..Tag::default()
    };
    loop {
        let at = tag.end + blanks(&text[tag.end..]);
        let rest = &text[at..];
        if rest.starts_with("/>") {
            (tag.end, tag.empty, tag.closed) = (at + 2, true, true);
            return tag;
        }
        match rest.chars().next() {
            None | Some('<') => {
                tag.end = at;
                return tag;
            }
            Some('>') => {
                (tag.end, tag.closed) = (at + 1, true);
                return tag;
            }
            Some(c) => {
                let len = word(rest);
                if len == 0 {
                    tag.end = at + c.len_utf8();
                    continue;
                }
                let said = attribute(text, at..at + len);
                let value = said.inner.as_ref().map(|i| i.end);
                let quote =
                    value.is_some_and(|v| text[v..].starts_with(['"', '\'']) && said.quoted);
                tag.end = value.map_or(at + len, |v| v + usize::from(quote));
                tag.attributes.push(said);
            }
        }
    }
}

fn attribute(text: &str, name: Range<usize>) -> TagAttribute {
    let equals = name.end + blanks(&text[name.end..]);
    if !text[equals..].starts_with('=') {
        return TagAttribute {
            name,
            ..TagAttribute::default()
        };
    }
    let at = equals + 1 + blanks(&text[equals + 1..]);
    let Some(quote) = text[at..]
        .chars()
        .next()
        .filter(|c| matches!(c, '"' | '\''))
    else {
        let len = word(&text[at..]);
        // After a lone `=` the next word is the next attribute.
        let here = if at > equals + 1 {
            equals + 1..equals + 1
        } else {
            at..at + len
        };
        return TagAttribute {
            name,
            inner: Some(here),
            quoted: false,
        };
    };
    let start = at + 1;
    let end = text[start..].find(quote).map(|i| start + i);
    let wild = text[start..].find('<').map_or(text.len(), |i| start + i);
    let end = end.filter(|end| *end <= wild).unwrap_or_else(|| {
        let line = text[start..wild]
            .find(['\n', '\r'])
            .map_or(wild, |i| start + i);
        let tag = text[start..line].rfind('>').map_or(line, |i| start + i);
        tag - usize::from(text[start..tag].ends_with('/'))
    });
    TagAttribute {
        name,
        inner: Some(start..end),
        quoted: true,
    }
}

/// Returns the role of an offset in a tag.
fn within(tag: Tag, at: usize) -> CursorPlace {
    if at <= tag.name.end {
        return CursorPlace::TagName(tag);
    }
    let here = |r: &Range<usize>| r.start <= at && at <= r.end;
    if let Some(index) = tag
        .attributes
        .iter()
        .position(|a| a.inner.as_ref().is_some_and(here))
    {
        return CursorPlace::Value(tag, index);
    }
    let named = tag.attributes.iter().find(|a| here(&a.name));
    let range = named.map_or(at..at, |a| a.name.clone());
    CursorPlace::AttributeName(tag, range)
}

/// Returns the length of the word at the start of a string.
fn word(text: &str) -> usize {
    let ends = |c: char| c.is_whitespace() || matches!(c, '<' | '>' | '/' | '=' | '"' | '\'');
    text.find(ends).unwrap_or(text.len())
}

fn blanks(text: &str) -> usize {
    text.len() - text.trim_start().len()
}

/// Returns the expression at a place of a source file, by the offset after its opening brace; `from` = the start of its
/// run of text.
pub(crate) fn braces(text: &str, from: usize, at: usize) -> Option<usize> {
    let before = text.get(from..at)?;
    let open = before.rfind('{')?;
    let inside = &before[open + 1..];
    let ended = inside.contains(['}', '\n', '\r']);
    (!ended).then_some(from + open + 1)
}

/// Returns true if `k`, the number of a storey, is defined within these elements.
pub(super) fn is_numbered(open: &[(&str, usize)]) -> bool {
    open.iter()
        .any(|(name, _)| matches!(*name, "Storey" | "Floor" | "define"))
}
