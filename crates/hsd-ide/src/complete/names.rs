//! Names in expressions, and definitions.

use super::place::{self, Open, Tag};
use super::{Completion, CompletionKind, Request, fields};
use crate::names::{self, KnownName};
use crate::vocabulary;
use hsd_base::diagnostic::Text;
use hsd_base::text;
use std::ops::Range;

/// Returns the completions in an expression that begins at `from`, in an attribute of a tag or between tags.
pub(super) fn in_braces(
    request: &Request<'_>,
    from: usize,
    (open, tag): (&Open<'_>, Option<&Tag>),
) -> Vec<Completion> {
    let before = &request.text[from..request.at];
    // Quotes contain a string, not names.
    if before.matches('\'').count() % 2 == 1 || before.matches('"').count() % 2 == 1 {
        return fields::tables(request, before);
    }
    let start = before.rfind(|c: char| !(c.is_alphanumeric() || c == '_'));
    let start = from
        + start.map_or(0, |i| {
            i + before[i..].chars().next().map_or(1, char::len_utf8)
        });
    let more = request.text[request.at..].find(|c: char| !(c.is_alphanumeric() || c == '_'));
    let range = start..more.map_or(request.text.len(), |i| request.at + i);
    if request.text[start..request.at].starts_with(|c: char| c.is_ascii_digit()) {
        return vec![];
    }
    // A reference such as `&lt;` is no name.
    if request.text[..start].ends_with('&') {
        return vec![];
    }
    let mut found = vec![];
    if let Some(layer) = fields::layer(request, open, tag) {
        found.extend(fields::names(layer, &range));
    }
    let storey = place::is_numbered(open);
    for (rank, known) in names::values(request.a, request.at).iter().enumerate() {
        let word = Completion::word(known.name(), CompletionKind::Name, about(known), &range);
        found.push(word.sorted(format!("1{rank:04}")));
    }
    if storey {
        let about = text!("the number of the storey, from 1", "階の番号(1 から)");
        found.push(Completion::word("k", CompletionKind::Name, about, &range).sorted("2"));
    }
    for (name, about) in vocabulary::FUNCTIONS {
        let word = Completion::word(name, CompletionKind::Function, (*about).into(), &range);
        found.push(Completion {
            insert: format!("{name}("),
            snippet: Some(format!("{name}($1)$0")),
            ..word.sorted("3")
        });
    }
    found
}

/// Returns the definitions that a `use` may name.
pub(super) fn pieces(request: &Request<'_>, range: &Range<usize>) -> Vec<Completion> {
    let all = names::pieces(request.a, request.at).into_iter().enumerate();
    all.map(|(rank, piece)| {
        let named = names::parameters(&piece);
        let named: Vec<&str> = named.iter().map(KnownName::name).collect();
        let (list, file) = (named.join(", "), vocabulary::file(piece.source));
        let about = match list.as_str() {
            "" => text!([file] "piece of {file}", "{file} の部品"),
            _ => text!([file, list] "piece of {file}; sets {list}", "{file} の部品。変数 {list}"),
        };
        Completion::word(piece.name(), CompletionKind::Piece, about, range)
            .sorted(format!("1{rank:04}"))
    })
    .collect()
}

/// Returns a description of a name, in one line.
pub(crate) fn about(known: &KnownName<'_>) -> Text {
    let element = known.element();
    if known.is_argument() {
        let default = element.attributes[known.attribute].value.clone();
        let piece = element.value("name").unwrap_or_default();
        return match default.trim() {
            "" => text!([piece]
                "parameter of `{piece}`; must be given",
                "`{piece}` の変数。必ず指定する"
            ),
            default => text!([piece, default]
                "parameter of `{piece}`: {default} unless given",
                "`{piece}` の変数。既定値 {default}"
            ),
        };
    }
    if names::word(element) == "repeat" {
        return text!("the number of the round, from 0", "何回目かの番号。0 から");
    }
    if names::word(element) == "let" {
        let value = element.value("value").unwrap_or_default();
        return format!("= {value}").into();
    }
    let says = |name: &str| element.value(name).unwrap_or_default();
    let (doc, unit, default) = (says("doc"), says("unit"), says("default"));
    let bounds = vocabulary::bounds(says("choices"), says("min"), says("max"));
    let words = format!("{doc} = {default} {unit}");
    let words = words.split_whitespace().collect::<Vec<_>>().join(" ");
    (words + &bounds).into()
}

/// Returns the parameters of the definition that a `use` names.
pub(super) fn of_use<'a>(request: &Request<'a>, tag: &Tag) -> Vec<KnownName<'a>> {
    let named = tag
        .attributes
        .iter()
        .find(|a| &request.text[a.name.clone()] == "name");
    let Some(name) = named.and_then(|a| a.inner.clone()) else {
        return vec![];
    };
    let name = request.text[name].trim();
    let piece = names::pieces(request.a, request.at)
        .into_iter()
        .find(|p| p.name() == name);
    piece.map_or(vec![], |piece| names::parameters(&piece))
}
