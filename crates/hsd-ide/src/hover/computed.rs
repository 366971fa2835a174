//! Expressions, names and definitions: their values in this run.

use super::{Hover, Request, holds};
use crate::complete::names::about;
use crate::complete::types;
use crate::names::{self, KnownName};
use crate::vocabulary::{self, fields};
use hsd_base::diagnostic::Text;
use hsd_base::text;
use hsd_ir::ast::Value;
use hsd_syntax::parse::Seen;
use hsd_syntax::parse::syntax::Expression;
use std::ops::Range;

/// Describes the value of an expression, or of the name at the place.
pub(super) fn expression(request: &Request<'_>, expression: &Expression) -> Option<Hover> {
    let text = request.a.text();
    let seen = request
        .a
        .seen(request.a.source.span(expression.range.clone()));
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
        // Fields hide names from outside their `for`.
        let of_feature = || field(request, &word);
        return match known {
            Some(known) if is_in_rule(request, &known) => value(request, &word, &known),
            Some(known) => of_feature().or_else(|| value(request, &word, &known)),
            None => of_feature(),
        };
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
    let values = format!("`{}` = {}", written.trim(), list(&seen)).into();
    request.told(range, [values, held(request, &seen)])
}

/// Returns true if a name is defined in the `for` that contains the place.
fn is_in_rule(request: &Request<'_>, known: &KnownName<'_>) -> bool {
    let outline = request.a.outline();
    let is_rule = |e: &usize| names::word(&outline.elements[*e]) == "for";
    let own = outline.element_at(request.at);
    let rule = own.and_then(|own| outline.around(own).find(is_rule));
    let is_here = known.source.id() == request.a.source.id();
    let inside = |rule: usize| outline.elements[rule].range.contains(&known.place().start);
    is_here && rule.is_some_and(inside)
}

/// Tells at how many features a test holds; nothing if the value belongs to no feature, or is no truth.
fn held(request: &Request<'_>, seen: &Seen) -> Text {
    let element = request.a.outline().element_at(request.at);
    let layer = element.and_then(|e| fields::layer_of(request.a, e));
    let is_test = seen.values.iter().all(|v| matches!(v, Value::Truth(_)));
    let Some(layer) = layer.filter(|_| is_test && !seen.values.is_empty()) else {
        return Text::default();
    };
    let (held, times, all, name) = (seen.held, seen.times, layer.features, &layer.name);
    match times == all {
        true => text!([held, all, name]
            "takes {held} of the {all} features of `{name}`",
            "`{name}` の {all} 件のうち {held} 件が当てはまる"
        ),
        false => text!([held, times, all, name]
            "takes {held} of {times} features at which it is asked, of {all} of `{name}`",
            "`{name}` の {all} 件のうち、問われた {times} 件の中で {held} 件が当てはまる"
        ),
    }
}

/// Describes a field or measure of the features that a place speaks of.
pub(super) fn field(request: &Request<'_>, word: &Range<usize>) -> Option<Hover> {
    let name = request.a.text().get(word.clone())?;
    let element = request.a.outline().element_at(request.at)?;
    let layer = fields::layer_of(request.a, element)?;
    let about = match layer.field(name) {
        Some(field) => fields::about(field, layer),
        None => fields::measure(name)?.into(),
    };
    let layer = &layer.name;
    let head = text!([name, layer] "**{name}** (`{layer}`)", "**{name}** (`{layer}`)");
    request.told(word, [head, about])
}

/// Describes a name: its value, and its description.
pub(super) fn value(
    request: &Request<'_>,
    range: &Range<usize>,
    known: &KnownName<'_>,
) -> Option<Hover> {
    let place = known.source.span(known.place());
    let name = known.name();
    let came = request.a.seen(place);
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
