//! Selection ranges around a place: from the word to the house.

use super::{Analysis, sections};
use hsd_syntax::parse::syntax::{Attribute, Element, Outline};
use std::ops::Range;

/// Returns the ranges that contain an offset, innermost first; each is smaller than the next and lies within it.
pub fn selection(a: &Analysis, at: usize) -> Vec<Range<usize>> {
    let (outline, text) = (a.outline(), a.text());
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    let mut found = vec![0..text.len(), word(text, at), line(text, at)];
    legacy(outline, text, at, &mut found);
    if let Some(number) = outline.element_at(at) {
        for (depth, own) in outline.around(number).enumerate() {
            let element = &outline.elements[own];
            if depth == 0 {
                inside(element, text, at, &mut found);
            }
            around(element, &mut found);
        }
    }
    let comment = outline.comments.iter().find(|c| c.start < at && at < c.end);
    found.extend(comment.cloned());
    nested(found, at)
}

/// Returns the ranges that contain an offset and are nested, innermost first.
fn nested(mut ranges: Vec<Range<usize>>, at: usize) -> Vec<Range<usize>> {
    ranges.retain(|r| !r.is_empty() && r.start <= at && at <= r.end);
    ranges.sort_by_key(|r| (r.len(), r.start));
    let mut kept: Vec<Range<usize>> = vec![];
    // From the outside in, so that a range that crosses a larger one is removed.
    for range in ranges.into_iter().rev() {
        let fits = |outer: &Range<usize>| {
            outer.start <= range.start && range.end <= outer.end && *outer != range
        };
        if kept.last().is_none_or(fits) {
            kept.push(range);
        }
    }
    kept.reverse();
    kept
}

/// Returns the word at an offset.
fn word(text: &str, at: usize) -> Range<usize> {
    let fits = |c: char| c.is_alphanumeric() || c == '_';
    let before = &text[..at];
    let start = before.trim_end_matches(fits).len();
    let end = text[at..].find(|c| !fits(c)).map_or(text.len(), |i| at + i);
    start..end
}

/// Returns the content of the line at an offset.
fn line(text: &str, at: usize) -> Range<usize> {
    let start = text[..at].rfind(['\n', '\r']).map_or(0, |i| i + 1);
    let end = text[at..].find(['\n', '\r']).map_or(text.len(), |i| at + i);
    let written = &text[start..end];
    let indent = written.len() - written.trim_start().len();
    start + indent..start + indent + written.trim().len()
}

/// Adds codes, lines, storeys and houses of the legacy form.
fn legacy(outline: &Outline, text: &str, at: usize, found: &mut Vec<Range<usize>>) {
    let Some(number) = outline.line_at(at) else {
        return;
    };
    let line = &outline.lines[number];
    found.push(line.range.clone());
    found.extend(line.turn.clone());
    codes(&line.codes, text, at, found);
    for house in sections::houses(outline, text) {
        if !house.lines.contains(&number) {
            continue;
        }
        let sections = house
            .storeys
            .iter()
            .chain(&house.roofs)
            .chain(&house.header);
        let all = sections
            .chain([&house.lines])
            .filter(|l| l.contains(&number));
        found.extend(all.map(|lines| sections::text_range(outline, lines)));
    }
}

/// Adds the code at an offset, and the run of equal ones around it.
fn codes(codes: &[Range<usize>], text: &str, at: usize, found: &mut Vec<Range<usize>>) {
    let last = codes.partition_point(|c| c.start <= at);
    let Some(own) = last.checked_sub(1).filter(|i| at <= codes[*i].end) else {
        return;
    };
    let code = |i: usize| text[codes[i].clone()].trim_end();
    let beside = |i: usize, j: usize| codes[i].end == codes[j].start && code(i) == code(j);
    let (mut first, mut last) = (own, own);
    while first > 0 && beside(first - 1, first) {
        first -= 1;
    }
    while last + 1 < codes.len() && beside(last, last + 1) {
        last += 1;
    }
    found.push(codes[own].clone());
    found.push(codes[first].start..codes[last].end);
}

/// Adds the names, attributes and codes of an element.
fn inside(element: &Element, text: &str, at: usize, found: &mut Vec<Range<usize>>) {
    found.push(element.name.clone());
    found.extend(element.end_name.clone());
    for attribute in &element.attributes {
        if attribute.range.start <= at && at <= attribute.range.end {
            value(attribute, text, at, found);
        }
    }
    for words in &element.words {
        if words.range.start <= at && at <= words.range.end {
            found.push(words.range.clone());
            codes(&words.codes, text, at, found);
            expressions(&words.expressions, found);
        }
    }
}

fn value(attribute: &Attribute, text: &str, at: usize, found: &mut Vec<Range<usize>>) {
    let (inner, range) = (&attribute.inner, &attribute.range);
    found.extend([attribute.name.clone(), inner.clone(), range.clone()]);
    expressions(&attribute.expressions, found);
    // An item of a list.
    if attribute.expressions.is_empty() && (inner.start..=inner.end).contains(&at) {
        let start = text[inner.start..at]
            .rfind(',')
            .map_or(inner.start, |i| inner.start + i + 1);
        let end = text[at..inner.end].find(',').map_or(inner.end, |i| at + i);
        let written = &text[start..end];
        let indent = written.len() - written.trim_start().len();
        found.push(start + indent..start + indent + written.trim().len());
    }
}

fn expressions(all: &[hsd_syntax::parse::syntax::Expression], found: &mut Vec<Range<usize>>) {
    for expression in all {
        let range = &expression.range;
        found.push(range.clone());
        found.push(
            (range.start + 1).min(range.end)..range.end.saturating_sub(1).max(range.start + 1),
        );
        found.extend(expression.names.iter().cloned());
    }
}

/// Adds an element: its tag, its content, the whole.
fn around(element: &Element, found: &mut Vec<Range<usize>>) {
    found.push(element.tag.clone());
    found.push(element.range.clone());
    if let Some(name) = &element.end_name {
        let tag = name.start.saturating_sub(2);
        found.push(element.tag.end..tag.max(element.tag.end));
        found.push(tag..element.range.end);
    }
}
