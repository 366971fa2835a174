//! Names in a town: fields and measures of the features of a layer, layers, and tables.

use super::place::{self, Open, Tag};
use super::{Completion, CompletionKind, Request};
use crate::Analysis;
use crate::vocabulary::{MEASURES, fields};
use hsd_base::diagnostic::{Text, noun};
use hsd_base::text;
use hsd_town::LayerFacts;
use std::ops::Range;

/// Returns the layer whose features are spoken of in an attribute of a tag, or between tags, by the elements around it.
pub(super) fn layer<'a>(
    request: &Request<'a>,
    open: &Open<'_>,
    tag: Option<&Tag>,
) -> Option<&'a LayerFacts> {
    let own = tag.map(|tag| (&request.text[tag.name.clone()], tag.clone()));
    let around = open.iter().rev();
    let around = around.map(|(name, start)| (*name, place::tag(request.text, *start)));
    let name = own.into_iter().chain(around).find_map(|(name, tag)| {
        let attribute = match name {
            "for" => "each",
            "Layer" => "name",
            _ => return None,
        };
        value(request.text, &tag, attribute)
    });
    fields::layer(request.a, name?)
}

/// Returns the value of an attribute.
fn value<'t>(text: &'t str, tag: &Tag, name: &str) -> Option<&'t str> {
    let mut attributes = tag.attributes.iter();
    let found = attributes.find(|a| &text[a.name.clone()] == name)?;
    Some(text[found.inner.clone()?].trim())
}

/// Returns the fields that expressions can name, then the measures.
pub(super) fn names(layer: &LayerFacts, range: &Range<usize>) -> Vec<Completion> {
    let fields = layer.fields.iter().filter(|field| field.is_name);
    let mut known: Vec<&str> = vec![];
    let mut found = vec![];
    for field in fields {
        if !known.contains(&&*field.name) {
            known.push(&field.name);
            let rank = found.len();
            found.push(word(&field.name, fields::about(field, layer), range, rank));
        }
    }
    for (rank, (name, about)) in MEASURES.iter().enumerate() {
        if !known.contains(name) {
            found.push(word(name, (*about).into(), range, 1000 + rank));
        }
    }
    found
}

fn word(name: &str, about: Text, range: &Range<usize>, rank: usize) -> Completion {
    Completion::word(name, CompletionKind::Name, about, range).sorted(format!("1{rank:04}"))
}

/// Returns the fields of the file.
pub(super) fn in_file(layer: &LayerFacts, range: &Range<usize>) -> Vec<Completion> {
    let own = layer.fields.iter().filter(|field| !field.is_made);
    let all = own.enumerate();
    all.map(|(rank, field)| word(&field.name, fields::about(field, layer), range, rank))
        .collect()
}

/// Returns the layers of the town.
pub(super) fn layers(request: &Request<'_>, range: &Range<usize>) -> Vec<Completion> {
    let named = named(request.a, "Layer").enumerate();
    named
        .map(|(rank, name)| {
            let about = fields::layer(request.a, name).map_or_else(
                || noun("a layer", "レイヤー").into(),
                |layer| {
                    let count = layer.features;
                    text!([count] "a layer of {count} features", "{count} 件のレイヤー")
                },
            );
            Completion::word(name, CompletionKind::Reference, about, range)
                .sorted(format!("1{rank:04}"))
        })
        .collect()
}

/// Returns the tables of the town, for the first argument of `look` whose quotes contain the place; `before` is what
/// stands before it in the expression.
pub(super) fn tables(request: &Request<'_>, before: &str) -> Vec<Completion> {
    let quote = before.rfind(['\'', '"']).unwrap_or(0);
    if !before[..quote].trim_end().ends_with("look(") {
        return vec![];
    }
    let start = request.at - (before.len() - quote - 1).min(request.at);
    let more = request.text[request.at..].find(|c: char| !(c.is_alphanumeric() || c == '_'));
    let range = start..more.map_or(request.text.len(), |i| request.at + i);
    let about = || noun("a table", "表").into();
    named(request.a, "Table")
        .map(|name| Completion::word(name, CompletionKind::Reference, about(), &range))
        .collect()
}

/// Returns the names of all elements of a kind.
fn named<'a>(a: &'a Analysis, element: &'a str) -> impl Iterator<Item = &'a str> {
    let elements = a.outline().elements.iter();
    let alike = elements.filter(move |e| e.schema.is_some_and(|s| s.name == element));
    alike.filter_map(|e| Some(e.value("name")?.trim()).filter(|name| !name.is_empty()))
}
