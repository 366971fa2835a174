//! Expressions, names and pieces: what they came to in this run.

use super::{Ask, Hover, holds};
use crate::diagnostic::Text;
use crate::ide::complete::names::about;
use crate::ide::names::{self, Known};
use crate::ide::words;
use crate::parse::Seen;
use crate::parse::outline::Expression;
use crate::text;
use std::ops::Range;

/// What an expression came to, or the name in it that stands there.
pub(super) fn expression(ask: &Ask<'_>, expression: &Expression) -> Option<Hover> {
    let text = ask.a.text();
    let seen = ask
        .a
        .checked
        .values
        .at(ask.a.source.span(expression.range.clone()));
    let word = word_at(text, ask.at);
    let name = text.get(word.clone()).unwrap_or_default();
    if name == "k" || expression.names.contains(&word) {
        if name == "k" {
            let numbers = seen.map_or(vec![], |s| s.storeys);
            let list: Vec<String> = numbers.iter().map(|n| format!("`{n}`")).collect();
            let here: Text = match list.is_empty() {
                true => "".into(),
                false => format!("k = {}", list.join(", ")).into(),
            };
            return ask.told(
                &word,
                [
                    here,
                    text!("the number of the storey, from 1", "階の番号(1 から)"),
                ],
            );
        }
        let known = names::values(ask.a, ask.at)
            .into_iter()
            .find(|k| k.name() == name);
        if let Some(known) = known {
            return value(ask, &word, &known);
        }
    }
    if let Some(about) =
        words::meaning(words::FUNCTIONS, text.get(word.clone()).unwrap_or_default())
    {
        return ask.told(&word, [about.into()]);
    }
    let seen = seen?;
    let range = &expression.range;
    let written = &text[range.start + 1..range.end.max(range.start + 2) - 1];
    ask.told(
        range,
        [format!("`{}` = {}", written.trim(), list(&seen)).into()],
    )
}

/// A name: what it came to, and how it was said.
pub(super) fn value(ask: &Ask<'_>, range: &Range<usize>, known: &Known<'_>) -> Option<Hover> {
    let place = known.source.span(known.place());
    let name = known.name();
    let came = ask.a.checked.values.at(place);
    let came: Text = came.map_or("".into(), |seen| {
        format!("`{name}` = {}", list(&seen)).into()
    });
    let (kind, line) = (
        names::word(known.element()),
        ask.a.line_of(known.source, place),
    );
    let about = about(known);
    let said = text!([about, line] "`{kind}` ({line}): {about}", "`{kind}` ({line}): {about}");
    ask.told(range, [came, said])
}

/// A piece: its parameters with their defaults, and what is said of it.
pub(super) fn piece(ask: &Ask<'_>, range: &Range<usize>, name: &str) -> Option<Hover> {
    let found = names::pieces(ask.a, ask.at).into_iter();
    let piece = found.into_iter().find(|p| p.name() == name)?;
    let line = ask
        .a
        .line_of(piece.source, piece.source.span(piece.place()));
    let head = text!([line] "piece **{name}** ({line})", "部品 **{name}** ({line})");
    let parameters = names::parameters(&piece);
    let lines: Vec<(String, Text)> = parameters
        .iter()
        .map(|p| (p.name().to_owned(), about(p)))
        .collect();
    let in_language = |ja: bool| {
        let line = |(n, t): &(String, Text)| format!("- `{n}`: {}", if ja { &t.ja } else { &t.en });
        lines.iter().map(line).collect::<Vec<_>>().join("\n")
    };
    ask.told(
        range,
        [head, Text::both(in_language(false), in_language(true))],
    )
}

/// A file that is included: what it defines.
pub(super) fn file(ask: &Ask<'_>, range: &Range<usize>, href: &str) -> Option<Hover> {
    let ends = |name: &str| {
        name == href
            || name
                .replace('\\', "/")
                .ends_with(&format!("/{}", href.trim_start_matches("./")))
    };
    let all = ask.a.checked.included.iter().zip(ask.a.outlines());
    let (source, outline) = all.into_iter().find(|(s, _)| ends(s.name()))?;
    let mut lines = vec![format!("**{}**", words::file(source)), String::new()];
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
    ask.told(range, [lines.join("\n").into()])
}

/// The values of a place.
fn list(seen: &Seen) -> String {
    let values: Vec<String> = seen.values.iter().map(|v| format!("`{v}`")).collect();
    values.join(", ") + if seen.more { ", …" } else { "" }
}

/// The word at an offset; empty where none is.
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

/// The expression that holds an offset.
pub(super) fn expression_at(expressions: &[Expression], at: usize) -> Option<&Expression> {
    expressions.iter().find(|e| holds(&e.range, at))
}
