//! Words of the XML form.

use super::{List, Modifiers, TokenKind, braces};
use crate::names::{CodeForm, codes_of_element};
use hsd_syntax::parse::schema;
use hsd_syntax::parse::schema::Kind;
use hsd_syntax::parse::syntax::{Attribute, Element, Outline};
use std::ops::Range;

/// Adds the words of all elements.
pub(super) fn tokens(outline: &Outline, list: &mut List<'_>) {
    let mut codes = vec![];
    for number in 0..outline.elements.len() {
        let element = &outline.elements[number];
        let unknown = element.schema.is_none() && !is_shape(outline, element);
        for name in std::iter::once(&element.name).chain(&element.end_name) {
            let modifiers = Modifiers {
                unknown,
                ..Modifiers::default()
            };
            list.put(name.clone(), TokenKind::Element, modifiers);
        }
        codes.clear();
        codes_of_element(list.text, outline, number, &mut |range, form| {
            codes.push((range, form));
        });
        for attribute in &element.attributes {
            name(element, attribute, list);
            value(element, attribute, &codes, list);
        }
        for words in &element.words {
            for expression in &words.expressions {
                braces::tokens(expression, list);
            }
        }
        let columns = codes.iter().filter(|(_, form)| *form == CodeForm::Columns);
        if element.schema.is_some() {
            columns.for_each(|(range, _)| list.code(range));
        }
    }
}

/// Returns true for a body element, which only the catalogue defines.
fn is_shape(outline: &Outline, element: &Element) -> bool {
    let around = element.parent.into_iter().flat_map(|p| outline.around(p));
    let mut words = around.map(|e| outline.elements[e].schema.map_or("", |s| s.name));
    words.any(|w| w == "PartDef")
}

fn word(element: &Element) -> &'static str {
    element.schema.map_or("", |s| s.name)
}

/// Adds the name of an attribute; a parameter of a definition is one.
fn name(element: &Element, attribute: &Attribute, list: &mut List<'_>) {
    let range = attribute.name.clone();
    match word(element) {
        "define" if attribute.word != "name" => list.declare(range, TokenKind::Parameter),
        "use" if attribute.word != "name" => list.add(range, TokenKind::Parameter),
        "Place" if schema::is_parameter_of_place(&attribute.word) => {
            list.add(range, TokenKind::Parameter);
        }
        _ => {
            let foreign = list.text[range.clone()].contains(':');
            let modifiers = Modifiers {
                unknown: element.schema.is_some()
                    && attribute.attribute_schema.is_none()
                    && !foreign,
                ..Modifiers::default()
            };
            list.put(range, TokenKind::Attribute, modifiers);
        }
    }
}

/// Adds the value of an attribute: its codes and expressions, and the text between them.
fn value(
    element: &Element,
    attribute: &Attribute,
    codes: &[(Range<usize>, CodeForm)],
    list: &mut List<'_>,
) {
    let inner = &attribute.inner;
    let mut at = inner.start;
    for expression in &attribute.expressions {
        plain(element, attribute, at..expression.range.start, list);
        braces::tokens(expression, list);
        at = expression.range.end;
    }
    if !attribute.expressions.is_empty() {
        plain(element, attribute, at..inner.end, list);
        return;
    }
    let inside = |r: &Range<usize>| inner.start <= r.start && r.end <= inner.end;
    let mut any = false;
    for (range, form) in codes.iter().filter(|(range, _)| inside(range)) {
        let known = list.known(&list.text[range.clone()]);
        match (form, known) {
            (CodeForm::Part | CodeForm::Picture, _) => list.declare(range.clone(), TokenKind::Code),
            (CodeForm::Perhaps, None) => plain(element, attribute, range.clone(), list),
            (CodeForm::Columns, _) => continue,
            // Longer names may be those of images, which are not listed anywhere.
            (_, None) if range.len() != 5 => list.add(range.clone(), TokenKind::Code),
            _ => list.code(range),
        }
        any = true;
    }
    if !any {
        plain(element, attribute, inner.clone(), list);
    }
}

/// Adds a plain value.
fn plain(element: &Element, attribute: &Attribute, range: Range<usize>, list: &mut List<'_>) {
    let text = list.text;
    let written = &text[range.clone()];
    let start = range.start + written.len() - written.trim_start().len();
    let range = start..start + written.trim().len();
    let written = &text[range.clone()];
    match (word(element), &*attribute.word) {
        ("define", "name") => return list.declare(range, TokenKind::Function),
        ("use", "name") => return list.add(range, TokenKind::Function),
        ("let" | "Param", "name") => return list.declare(range, TokenKind::Variable),
        _ => {}
    }
    let number = |w: &str| w.parse::<f64>().is_ok();
    let mut words = written
        .split([' ', ','])
        .filter(|w| !w.is_empty())
        .peekable();
    let kind = match attribute.attribute_schema.map(|b| b.kind) {
        Some(Kind::Choice(_) | Kind::Choices(_) | Kind::YesNo) => TokenKind::Keyword,
        Some(Kind::Either(..)) if !number(written) => TokenKind::Keyword,
        Some(Kind::Positions) => TokenKind::Number,
        _ if words.peek().is_some() && words.all(number) => TokenKind::Number,
        _ if matches!(written, "yes" | "no" | "true" | "false") => TokenKind::Keyword,
        _ => TokenKind::String,
    };
    list.add(range, kind);
}
