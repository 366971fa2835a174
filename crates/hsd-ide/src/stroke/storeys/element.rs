//! Adds, changes and removes the elements of a storey, for the strokes of rooms, fixtures and inner walls alike.

use crate::format::Edit;
use crate::stroke::change::tidy;
use crate::stroke::find;
use crate::stroke::refuse;
use crate::stroke::sheet::{Reason, Sheet, name};
use crate::stroke::xml::{gap_before, gone, without};
use hsd_base::diagnostic::Text;
use hsd_base::source::{FileId, Span};
use hsd_ir::building::Storey;

/// Attributes with their values; empty ones are not written.
type Words = Vec<(&'static str, String)>;

/// Returns the edits that add an element with these attributes to a storey; those that are `usual` are not written.
pub(super) fn added(
    sheet: &Sheet<'_>,
    storey: &Storey,
    called: &str,
    words: Words,
    usual: fn(&str) -> Option<&'static str>,
) -> Result<Vec<Edit>, Text> {
    let mut element = format!("<{called}");
    for (word, value) in words {
        if !value.is_empty() && usual(word) != Some(&*value) {
            element += &format!(" {word}=\"{value}\"");
        }
    }
    element += "/>";
    let lines = |_: &str, _: &str| element.clone();
    Ok(vec![put(sheet, storey, &[], &lines)?])
}

/// Returns the edits that remove an element.
pub(super) fn removed(sheet: &Sheet<'_>, element: usize) -> Vec<Edit> {
    let range = sheet.outline.elements[element].range.clone();
    tidy(gone(sheet, range))
}

/// Returns the element of a span, or why no stroke can change it.
pub(super) fn own_element(sheet: &Sheet<'_>, span: Span, called: &str) -> Result<usize, Text> {
    match fixed(sheet, span, called) {
        Some(reason) => Err(reason.text()),
        None => find::element(sheet, span).ok_or_else(refuse::no_such_place),
    }
}

/// Returns the reason why no stroke can change the element of a span.
pub(super) fn fixed(sheet: &Sheet<'_>, span: Span, called: &str) -> Option<Reason> {
    if span.file != FileId(0) {
        return Some(Reason::Include);
    }
    match find::element(sheet, span) {
        Some(element) if name(&sheet.outline.elements[element]) == called => {
            sheet.around_fixed(element)
        }
        _ => Some(sheet.made_by(sheet.a.source.text_range(span).start)),
    }
}

/// Returns the edits that give attributes of an element these values; empty ones remove them, those that are `usual` need
/// not be written.
pub(super) fn rewritten(
    sheet: &Sheet<'_>,
    element: usize,
    words: Words,
    usual: fn(&str) -> Option<&'static str>,
) -> Result<Vec<Edit>, Text> {
    let own = &sheet.outline.elements[element];
    let end = own.attributes.iter().map(|a| a.range.end).max();
    let end = end.unwrap_or(own.name.end);
    let mut edits = vec![];
    for (word, value) in words {
        match own.attribute(word) {
            Some(given) if !given.expressions.is_empty() => return Err(Reason::Computed.text()),
            Some(given) if value.is_empty() => edits.push(without(sheet, &given.range)),
            Some(given) if sheet.text.get(given.inner.clone()) == Some(&*value) => {}
            Some(given) => edits.push(Edit {
                range: given.inner.clone(),
                text: value,
            }),
            None if value.is_empty() || usual(word) == Some(&*value) => {}
            None => edits.push(Edit {
                range: end..end,
                text: format!(" {word}=\"{value}\""),
            }),
        }
    }
    match edits.is_empty() {
        true => Err(refuse::nothing()),
        false => Ok(tidy(edits)),
    }
}

/// Checks that a word is one of those that are known.
pub(super) fn one_of(word: &str, known: &[&str]) -> Result<String, Text> {
    match known.contains(&word) {
        true => Ok(word.to_owned()),
        false => Err(refuse::no_such_place()),
    }
}

/// Returns the edit that puts an element into a storey: behind the last child of these names, or of any if none is given.
/// `lines` makes the element from the line end and blanks before it, and one step more of blanks.
pub(super) fn put(
    sheet: &Sheet<'_>,
    storey: &Storey,
    behind: &[&str],
    lines: &dyn Fn(&str, &str) -> String,
) -> Result<Edit, Text> {
    let at = sheet.a.source.text_range(storey.span).start;
    if storey.span.file == FileId(0) && sheet.outline.line_at(at).is_some() {
        return Err(refuse::no_rooms());
    }
    let element = find::storey_element(sheet, storey)?;
    let own = &sheet.outline.elements[element];
    let outer = gap_before(sheet.text, own.range.start);
    let step = if outer.is_empty() { "" } else { "  " };
    let last = sheet
        .children(element)
        .filter(|c| {
            let name = name(&sheet.outline.elements[*c]);
            behind.is_empty() || behind.contains(&name)
        })
        .last();
    let insert = |at: usize, text: String| Edit {
        range: at..at,
        text,
    };
    if let Some(last) = last {
        let last = &sheet.outline.elements[last].range;
        let gap = gap_before(sheet.text, last.start);
        return Ok(insert(last.end, format!("{gap}{}", lines(gap, step))));
    }
    let gap = format!("{outer}{step}");
    let text = format!("{gap}{}", lines(&gap, step));
    Ok(match own.end_name {
        Some(_) => insert(own.tag.end, text),
        // <Storey/> opens.
        None => Edit {
            range: sheet.text[..own.tag.end - 2].trim_end().len()..own.tag.end,
            text: format!(">{text}{outer}</Storey>"),
        },
    })
}
