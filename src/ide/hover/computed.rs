//! Expressions, names and definitions: their values in this run.

use super::{Hover, Request, holds};
use crate::diagnostic::Text;
use crate::ide::complete::names::about;
use crate::ide::complete::types;
use crate::ide::names::{self, KnownName};
use crate::ide::vocabulary;
use crate::parse::Seen;
use crate::parse::syntax::Expression;
use crate::text;
use std::ops::Range;

/// Describes the value of an expression, or of the name at the place.
pub(super) fn expression(request: &Request<'_>, expression: &Expression) -> Option<Hover> {
    let text = request.a.text();
    let seen = request
        .a
        .checked
        .values
        .at(request.a.source.span(expression.range.clone()));
    let word = word_at(text, request.at);
    let name = text.get(word.clone()).unwrap_or_default();
    if name == "k" || expression.names.contains(&word) {
        if name == "k" {
            let numbers = seen.map_or(vec![], |s| s.storeys);
            let list: Vec<String> = numbers.iter().map(|n| format!("`{n}`")).collect();
            let here: Text = match list.is_empty() {
                true => "".into(),
                false => format!("k = {}", list.join(", ")).into(),
            };
            return request.told(
                &word,
                [
                    here,
                    text!("the number of the storey, from 1", "階の番号(1 から)"),
                ],
            );
        }
        let known = names::values(request.a, request.at)
            .into_iter()
            .find(|k| k.name() == name);
        if let Some(known) = known {
            return value(request, &word, &known);
        }
    }
    if let Some(about) = vocabulary::meaning(
        vocabulary::FUNCTIONS,
        text.get(word.clone()).unwrap_or_default(),
    ) {
        return request.told(&word, [about.into()]);
    }
    let seen = seen?;
    let range = &expression.range;
    let written = &text[range.start + 1..range.end.max(range.start + 2) - 1];
    request.told(
        range,
        [format!("`{}` = {}", written.trim(), list(&seen)).into()],
    )
}

/// Describes a name: its value, and its description.
pub(super) fn value(
    request: &Request<'_>,
    range: &Range<usize>,
    known: &KnownName<'_>,
) -> Option<Hover> {
    let place = known.source.span(known.place());
    let name = known.name();
    let came = request.a.checked.values.at(place);
    let came: Text = came.map_or("".into(), |seen| {
        format!("`{name}` = {}", list(&seen)).into()
    });
    let (kind, line) = (
        names::word(known.element()),
        request.a.line_of(known.source, place),
    );
    let about = about(known);
    let said = text!([kind, line, about]
        "`{kind}` ({line}): {about}",
        "`{kind}` ({line}): {about}"
    );
    request.told(range, [came, said])
}

/// Describes a definition: its parameters with their defaults, and its description.
pub(super) fn piece(request: &Request<'_>, range: &Range<usize>, name: &str) -> Option<Hover> {
    let found = names::pieces(request.a, request.at).into_iter();
    let piece = found.into_iter().find(|p| p.name() == name)?;
    let line = request
        .a
        .line_of(piece.source, piece.source.span(piece.place()));
    let head = text!([name, line] "piece **{name}** ({line})", "部品 **{name}** ({line})");
    let parameters = names::parameters(&piece);
    let line = |p: &KnownName<'_>| {
        let (name, about) = (p.name(), about(p));
        text!([name, about] "- `{name}`: {about}", "- `{name}`: {about}")
    };
    let lines = parameters.iter().map(line).collect();
    request.told(range, [head, Text::joined(lines, "\n", "\n")])
}

/// Describes the house type that a `Place` names: what it is, and its parameters.
pub(super) fn house_type(request: &Request<'_>, range: &Range<usize>, word: &str) -> Option<Hover> {
    if let Some(piece) = piece(request, range, word) {
        return Some(piece);
    }
    let known = types::library().find(|(t, _)| t.word == word);
    let head = match known {
        Some((_, about)) => {
            text!([word, about] "type **{word}** ({about})", "型 **{word}** ({about})")
        }
        None => format!("**{word}**").into(),
    };
    let parameters = types::parameters(request.a, word);
    let line = |p: &types::TypeParameter| {
        let (name, about) = (&*p.name, p.about.clone());
        text!([name, about] "- `{name}`: {about}", "- `{name}`: {about}")
    };
    let lines = parameters.iter().map(line).collect();
    request.told(range, [head, Text::joined(lines, "\n", "\n")])
}

/// Describes an included file: its definitions.
pub(super) fn file(request: &Request<'_>, range: &Range<usize>, href: &str) -> Option<Hover> {
    let ends = |name: &str| {
        name == href
            || name
                .replace('\\', "/")
                .ends_with(&format!("/{}", href.trim_start_matches("./")))
    };
    let all = request.a.checked.included.iter().zip(request.a.outlines());
    let (source, outline) = all.into_iter().find(|(s, _)| ends(s.name()))?;
    let mut lines = vec![format!("**{}**", vocabulary::file(source)), String::new()];
    for element in &outline.elements {
        let outer = element
            .parent
            .is_none_or(|p| outline.elements[p].parent.is_none());
        let kind = names::word(element);
        let name = match kind {
            "let" | "Param" | "define" => element.value("name"),
            "PartDef" => element.value("code"),
            _ => None,
        };
        if let Some(name) = name.filter(|_| outer) {
            lines.push(format!("- {kind} `{name}`"));
        }
    }
    request.told(range, [lines.join("\n").into()])
}

/// Formats the values of a place.
fn list(seen: &Seen) -> String {
    let values: Vec<String> = seen.values.iter().map(|v| format!("`{v}`")).collect();
    values.join(", ") + if seen.more { ", …" } else { "" }
}

/// Returns the word at an offset; empty if there is none.
pub(super) fn word_at(text: &str, at: usize) -> Range<usize> {
    let in_word = |c: char| c.is_alphanumeric() || c == '_';
    let start = text[..at].rfind(|c| !in_word(c));
    let start = start.map_or(0, |i| {
        i + text[i..].chars().next().map_or(1, char::len_utf8)
    });
    let end = text[at..]
        .find(|c| !in_word(c))
        .map_or(text.len(), |i| at + i);
    start..end
}

/// Returns the expression that contains an offset.
pub(super) fn expression_at(expressions: &[Expression], at: usize) -> Option<&Expression> {
    expressions.iter().find(|e| holds(&e.range, at))
}
