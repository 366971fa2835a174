//! Fixes for elements: their tags, attributes, and duplicates.

use super::suggest::alike;
use super::tree::{Element, Tree};
use crate::parse::reporter::Reporter;
use crate::parse::schema::{AttributeSchema, Kind, canonical};
use crate::parse::xml::tree::chars::is_blank;
use crate::parse::xml::tree::token::Attribute;
use hsd_base::diagnostic::Edit;
use hsd_base::source::Span;
use hsd_ir::messages::xml::Tags;
use std::ops::Range;

/// The maximum number of words that fixes offer one by one.
const FEW: usize = 8;

/// Returns the end tag of an element, and the name in it.
fn end_tag(reporter: &Reporter<'_>, element: &Element<'_>) -> Option<(Range<usize>, Range<usize>)> {
    /// The maximum length of an end tag.
    const LONGEST: usize = 256;
    if element.tag.end >= element.range.end || !reporter.wanted() {
        return None;
    }
    let written = reporter.quote(&element.range);
    let tail = written.len().saturating_sub(LONGEST);
    let at = written.as_bytes()[tail..]
        .windows(2)
        .rposition(|w| w == b"</")?
        + tail;
    let name = written[at + 2..].strip_suffix('>')?.trim_matches(is_blank);
    if name != element.name && !alike(name, element.name) {
        return None; // of another element, since the own one is missing
    }
    let start = element.range.start + at;
    let inside = written[at + 2..].find(name)? + start + 2;
    Some((start..element.range.end, inside..inside + name.len()))
}

/// Returns the tags of an element.
pub(super) fn tags(reporter: &Reporter<'_>, element: &Element<'_>) -> Tags {
    let mut tags = Tags {
        names: vec![reporter.span(&element.name_range)],
        whole: vec![reporter.span(&element.tag)],
    };
    if let Some((whole, name)) = end_tag(reporter, element) {
        tags.names.push(reporter.span(&name));
        tags.whole.push(reporter.span(&whole));
    }
    tags
}

/// Returns the name of an element in its end tag.
pub(super) fn end_name(reporter: &Reporter<'_>, element: &Element<'_>) -> Option<Span> {
    end_tag(reporter, element).map(|(_, name)| reporter.span(&name))
}

/// Returns the words that an attribute allows, if they are few.
pub(super) fn few_words(attribute_schema: &AttributeSchema) -> &'static [&'static str] {
    match attribute_schema.kind {
        Kind::YesNo => &["yes", "no"],
        Kind::Choice(words) if words.len() <= FEW => words,
        _ => &[],
    }
}

/// Returns the fixes that merge a second element into the first, or remove it.
pub(super) fn of_two(
    reporter: &Reporter<'_>,
    tree: &Tree<'_>,
    first: Span,
    second: &Element<'_>,
) -> [Option<Vec<Edit>>; 2] {
    if !reporter.wanted() {
        return [None, None];
    }
    let removed = Edit::new(reporter.with_gap(&second.range), "");
    // If elements are not in the order of the file, since they come from definitions, the search finds none.
    let before = |e: &Element<'_>| reporter.span(&e.name_range).start < first.start;
    let found = tree.elements.get(tree.elements.partition_point(before));
    let is_first = |e: &&Element<'_>| {
        let place = reporter.span(&e.name_range);
        place.file == first.file && place.end <= first.end
    };
    let first = found.filter(is_first);
    let joined = first.and_then(|first| joined(reporter, first, second));
    let joined = joined.map(|edits| edits.into_iter().chain([removed.clone()]).collect());
    [joined, Some(vec![removed])]
}

/// Returns the fix that moves the attributes and the content of an element into an earlier one, if nothing is given
/// twice then.
fn joined(reporter: &Reporter<'_>, first: &Element<'_>, second: &Element<'_>) -> Option<Vec<Edit>> {
    let attribute_schema = |of: &Attribute<'_>| {
        let mut all = first.attributes.iter();
        all.any(|a| canonical(a.name) == canonical(of.name))
    };
    let apart = reporter.span(&first.range).file == reporter.span(&second.range).file
        && first.range.end <= second.range.start
        && first.name == second.name
        && !second.attributes.iter().any(attribute_schema);
    if !apart {
        return None;
    }
    let written = |a: &Attribute<'_>| format!(" {}", reporter.quote(&a.range));
    let attributes: String = second.attributes.iter().map(written).collect();
    let end = end_tag(reporter, second).map_or(second.tag.end, |(end, _)| end.start);
    let content = reporter.quote(&(second.tag.end..end.max(second.tag.end)));
    let content = content.trim_end_matches(is_blank);
    let start = reporter.quote(&first.tag);
    // A tag that is not closed has no place for anything.
    let (head, is_empty) = match start.strip_suffix("/>") {
        Some(head) => (head, true),
        None => (start.strip_suffix('>')?, false),
    };
    let head = head.trim_end_matches(is_blank);
    let head = first.tag.start + head.len()..first.tag.end;
    let edit = |range: Range<usize>, text: String| Edit::new(reporter.span(&range), text);
    if content.is_empty() {
        return Some(vec![edit(head.start..head.start, attributes)]);
    }
    if is_empty {
        let text = format!("{attributes}>{content}</{}>", first.name);
        return Some(vec![edit(head, text)]);
    }
    let (end, _) = end_tag(reporter, first)?;
    let inside = reporter.quote(&(first.tag.end..end.start));
    let at = first.tag.end + inside.trim_end_matches(is_blank).len();
    let mut edits = vec![edit(at..at, content.to_owned())];
    if !attributes.is_empty() {
        edits.insert(0, edit(head.start..head.start, attributes));
    }
    Some(edits)
}
