//! Values of attributes: words of a list, codes, names of other things, files.

use super::place::{self, Open, Tag};
use super::xml::{self, is_numbered};
use super::{Ask, Completion, CompletionKind, names, parts};
use crate::catalog::body;
use crate::diagnostic::Text;
use crate::ide::names::Known;
use crate::ide::words;
use crate::material;
use crate::parse::xml::schema::{self, Kind};
use crate::text;
use std::ops::Range;

/// What may stand in the value of an attribute.
pub(super) fn complete(ask: &Ask<'_>, open: &Open<'_>, tag: &Tag, index: usize) -> Vec<Completion> {
    let said = &tag.attributes[index];
    let Some(inner) = said.inner.clone() else {
        return vec![];
    };
    if let Some(from) = place::braces(ask.text, inner.start, ask.at) {
        return names::in_braces(ask, from, is_numbered(open));
    }
    let element = &ask.text[tag.name.clone()];
    let attribute = &ask.text[said.name.clone()];
    let attribute = if attribute == "texturecode" {
        "code"
    } else {
        attribute
    };
    let mut found = proposals(ask, tag, element, attribute, &inner);
    if !said.quoted {
        for completion in &mut found {
            completion.insert = format!("\"{}\"", completion.insert);
        }
    }
    found
}

fn proposals(
    ask: &Ask<'_>,
    tag: &Tag,
    element: &str,
    attribute: &str,
    inner: &Range<usize>,
) -> Vec<Completion> {
    let item = |divider: &[char]| item(ask, inner, divider);
    match (element, attribute) {
        ("Part" | "Texture", "code") | ("PartDef", "base") => parts::in_value(ask, inner),
        ("random" | "replace", "code" | "with") => parts::in_value(ask, &item(&[','])),
        ("use", "name") => names::pieces(ask, inner),
        ("include", "href") => files(ask, inner, &["hsd"]),
        ("Texture", "src") | ("PartDef", "texture") => files(ask, inner, &["png", "jpg", "jpeg"]),
        ("Floor", "id") => references(ask, "Floor", inner),
        ("Facade", "id") => references(ask, "Facade", inner),
        ("change" | "remove", "element") => shapes(inner),
        ("PartDef", "finish" | "floor") | (_, "finish" | "pane" | "roof" | "end")
            if element == "PartDef" || schema::named(element).is_none() =>
        {
            surfaces(inner)
        }
        ("use", parameter) => argument(ask, tag, parameter, inner),
        _ => listed(ask, element, attribute, inner),
    }
}

/// The words of a list.
fn listed(ask: &Ask<'_>, element: &str, attribute: &str, inner: &Range<usize>) -> Vec<Completion> {
    let table = words::table(element, attribute);
    let word = |(rank, word): (usize, &&str), range: &Range<usize>| {
        let about = words::meaning(table, word).map_or(Text::default(), Text::from);
        Completion::word(word, CompletionKind::Value, about, range).sorted(format!("1{rank:03}"))
    };
    let all = |list: &[&str], range: Range<usize>| -> Vec<Completion> {
        list.iter().enumerate().map(|w| word(w, &range)).collect()
    };
    let Some(bears) = schema::named(element).and_then(|s| s.attribute(attribute)) else {
        return vec![];
    };
    match bears.kind {
        Kind::Choice(list) | Kind::Either(list, ..) => all(list, inner.clone()),
        Kind::YesNo => all(&["yes", "no"], inner.clone()),
        Kind::Choices(list) => all(list, item(ask, inner, &[' ', ','])),
        _ if !table.is_empty() => {
            let list: Vec<&str> = table.iter().map(|(w, _)| *w).collect();
            all(&list, inner.clone())
        }
        _ if !bears.default.is_empty() => {
            let about = text!("what holds without it", "既定値");
            vec![Completion::word(
                bears.default,
                CompletionKind::Value,
                about,
                inner,
            )]
        }
        _ => vec![],
    }
}

/// The item of a list that an offset lies in, without the blanks round it.
fn item(ask: &Ask<'_>, inner: &Range<usize>, dividers: &[char]) -> Range<usize> {
    let before = &ask.text[inner.start..ask.at];
    let start = before
        .rfind(dividers)
        .map_or(inner.start, |i| inner.start + i + 1);
    let blanks = ask.text[start..ask.at].len() - ask.text[start..ask.at].trim_start().len();
    let end = ask.text[ask.at..inner.end]
        .find(dividers)
        .map_or(inner.end, |i| ask.at + i);
    start + blanks..end
}

/// Files below the folder of the text.
fn files(ask: &Ask<'_>, inner: &Range<usize>, endings: &[&str]) -> Vec<Completion> {
    let own = ask
        .a
        .source
        .name()
        .rsplit(['/', '\\'])
        .next()
        .unwrap_or_default();
    let mut all: Vec<String> = endings.iter().flat_map(|e| (ask.files)(e)).collect();
    all.sort();
    all.dedup();
    let others = all.iter().filter(|f| *f != own);
    let word = |f: &String| Completion::word(f, CompletionKind::File, Text::default(), inner);
    others.map(word).collect()
}

/// Names that other elements of a kind bear.
fn references(ask: &Ask<'_>, element: &str, inner: &Range<usize>) -> Vec<Completion> {
    let elements = ask.a.outline().elements.iter();
    let named = elements.filter(|e| e.schema.is_some_and(|s| s.name == element));
    let ids = named.filter_map(|e| e.attribute("id"));
    let others = ids.filter(|a| a.inner != *inner);
    let mut names: Vec<&str> = others
        .map(|a| a.value.trim())
        .filter(|n| !n.is_empty())
        .collect();
    names.sort_unstable();
    names.dedup();
    let about = || text!("the id of another `{element}`", "ほかの `{element}` の id");
    let word = |n: &&str| Completion::word(n, CompletionKind::Reference, about(), inner);
    names.iter().map(word).collect()
}

/// The elements that the base of a part may consist of.
fn shapes(inner: &Range<usize>) -> Vec<Completion> {
    let real = words::SHAPES
        .iter()
        .filter(|(w, _)| body::attributes_of(w).is_some());
    real.map(|(w, about)| Completion::word(w, CompletionKind::Value, (*about).into(), inner))
        .collect()
}

/// The surfaces of the texture library.
fn surfaces(inner: &Range<usize>) -> Vec<Completion> {
    let all = material::all().iter();
    all.map(|s| Completion::word(s.name, CompletionKind::Value, Text::default(), inner))
        .collect()
}

/// Values of a parameter: those of its list, and its default.
fn argument(ask: &Ask<'_>, tag: &Tag, name: &str, inner: &Range<usize>) -> Vec<Completion> {
    let all = xml::parameters(ask, tag);
    let Some(parameter) = all.iter().find(|p| p.name() == name) else {
        return vec![];
    };
    let choices = match parameter.is_argument() {
        true => "",
        false => parameter.element().value("choices").unwrap_or_default(),
    };
    let default = default_of(parameter);
    let listed = choices.split(',').map(str::trim);
    let mut words: Vec<&str> = std::iter::once(default)
        .chain(listed)
        .filter(|w| !w.is_empty())
        .collect();
    words.sort_unstable();
    words.dedup();
    let about = || names::about(parameter);
    let mut found: Vec<Completion> = words
        .iter()
        .map(|w| Completion::word(w, CompletionKind::Value, about(), inner).sorted("1"))
        .collect();
    if parts::meant(ask.a, ask.at, default).is_some() {
        found.extend(parts::in_value(ask, inner));
    }
    found
}

/// The default of a parameter, empty where it has none.
pub(super) fn default_of<'a>(parameter: &Known<'a>) -> &'a str {
    let element = parameter.element();
    match parameter.is_argument() {
        true => element.attributes[parameter.attribute].value.trim(),
        false => element.value("default").unwrap_or_default().trim(),
    }
}
