//! Values of attributes: words of a list, codes, names of other things, files.

use super::place::{self, Open, Tag};
use super::types::{self, TypeParameter};
use super::{Completion, CompletionKind, Request, fields, names, parts};
use crate::names::KnownName;
use crate::vocabulary;
use hsd_base::diagnostic::Text;
use hsd_base::text;
use hsd_ir::catalog::body;
use hsd_ir::material;
use hsd_syntax::parse::schema;
use hsd_syntax::parse::schema::Kind;
use std::ops::Range;

/// Returns the completions for the value of an attribute.
pub(super) fn complete(
    request: &Request<'_>,
    open: &Open<'_>,
    tag: &Tag,
    index: usize,
) -> Vec<Completion> {
    let said = &tag.attributes[index];
    let Some(inner) = said.inner.clone() else {
        return vec![];
    };
    if let Some(from) = place::braces(request.text, inner.start, request.at) {
        return names::in_braces(request, from, (open, Some(tag)));
    }
    let element = &request.text[tag.name.clone()];
    let attribute = &request.text[said.name.clone()];
    let attribute = if attribute == "texturecode" {
        "code"
    } else {
        attribute
    };
    let mut found = proposals(request, (open, tag), element, attribute, &inner);
    if !said.quoted {
        for completion in &mut found {
            completion.insert = format!("\"{}\"", completion.insert);
        }
    }
    found
}

fn proposals(
    request: &Request<'_>,
    (open, tag): (&Open<'_>, &Tag),
    element: &str,
    attribute: &str,
    inner: &Range<usize>,
) -> Vec<Completion> {
    let layer = || fields::layer(request, open, Some(tag));
    let item = |divider: &[char]| item(request, inner, divider);
    match (element, attribute) {
        ("Part" | "Texture" | "Put", "code") | ("PartDef", "base") => {
            parts::in_value(request, inner)
        }
        ("random" | "replace", "code" | "with") => parts::in_value(request, &item(&[','])),
        ("use", "name") => names::pieces(request, inner),
        ("Place", "type") => types(request, inner),
        ("for", "each") => fields::layers(request, inner),
        ("Envelope", "roads") => fields::layers(request, inner),
        ("Place", "front") => {
            let mut found = fields::layers(request, inner);
            found.extend(listed(request, element, attribute, inner));
            found
        }
        ("Field", "from") | ("Layer", "key" | "outline" | "order") => {
            layer().map_or(vec![], |layer| fields::in_file(layer, inner))
        }
        ("Layer", "where") => match layer() {
            Some(layer) => fields::names(layer, &word_of(request, inner)),
            None => vec![],
        },
        ("include", "href") => files(request, inner, &["hsd"]),
        ("Texture", "src") | ("PartDef", "texture") => {
            files(request, inner, &["png", "jpg", "jpeg"])
        }
        ("Floor", "id") => references(request, "Floor", inner),
        ("Facade", "id") => references(request, "Facade", inner),
        ("change" | "remove", "element") => shapes(inner),
        ("PartDef", "finish" | "floor") | (_, "finish" | "pane" | "roof" | "end")
            if element == "PartDef" || schema::named(element).is_none() =>
        {
            surfaces(inner)
        }
        ("use", parameter) => argument(request, tag, parameter, inner),
        ("Place", name) if schema::is_parameter_of_place(name) => of_type(request, tag)
            .iter()
            .filter(|p| p.name == name)
            .flat_map(|p| type_values(p, inner))
            .collect(),
        _ => listed(request, element, attribute, inner),
    }
}

/// Returns what a `Place` can put somewhere: definitions, types of the library, files.
fn types(request: &Request<'_>, inner: &Range<usize>) -> Vec<Completion> {
    let mut found = names::pieces(request, inner);
    let library = types::library().enumerate();
    found.extend(library.map(|(rank, (template, about))| {
        let word = Completion::word(template.word, CompletionKind::Piece, about, inner);
        word.sorted(format!("2{rank:04}"))
    }));
    found.extend(files(request, inner, &["hsd"]));
    found
}

/// Returns the parameters of the type that a `Place` names.
pub(super) fn of_type(request: &Request<'_>, tag: &Tag) -> Vec<TypeParameter> {
    let mut attributes = tag.attributes.iter();
    let named = attributes.find(|a| &request.text[a.name.clone()] == "type");
    let Some(word) = named.and_then(|a| a.inner.clone()) else {
        return vec![];
    };
    types::parameters(request.a, request.text[word].trim())
}

fn type_values(parameter: &TypeParameter, inner: &Range<usize>) -> Vec<Completion> {
    let listed = parameter.choices.split(',').map(str::trim);
    let mut words: Vec<&str> = std::iter::once(&*parameter.default)
        .chain(listed)
        .filter(|w| !w.is_empty())
        .collect();
    words.sort_unstable();
    words.dedup();
    let word = |w: &&str| {
        let about = parameter.about.clone();
        Completion::word(w, CompletionKind::Value, about, inner).sorted("1")
    };
    words.iter().map(word).collect()
}

/// Returns the words of a list.
fn listed(
    request: &Request<'_>,
    element: &str,
    attribute: &str,
    inner: &Range<usize>,
) -> Vec<Completion> {
    let table = vocabulary::table(element, attribute);
    let word = |(rank, word): (usize, &&str), range: &Range<usize>| {
        let about = vocabulary::meaning(table, word).map_or(Text::default(), Text::from);
        Completion::word(word, CompletionKind::Value, about, range).sorted(format!("1{rank:03}"))
    };
    let all = |list: &[&str], range: Range<usize>| -> Vec<Completion> {
        list.iter().enumerate().map(|w| word(w, &range)).collect()
    };
    let Some(attribute_schema) = schema::named(element).and_then(|s| s.attribute(attribute)) else {
        return vec![];
    };
    match attribute_schema.kind {
        Kind::Choice(list) | Kind::Either(list, ..) => all(list, inner.clone()),
        Kind::YesNo => all(&["yes", "no"], inner.clone()),
        Kind::Choices(list) => all(list, item(request, inner, &[' ', ','])),
        _ if !table.is_empty() => {
            let list: Vec<&str> = table.iter().map(|(w, _)| *w).collect();
            all(&list, inner.clone())
        }
        _ if !attribute_schema.default.is_empty() => {
            let about = text!("what holds without it", "既定値");
            vec![Completion::word(
                attribute_schema.default,
                CompletionKind::Value,
                about,
                inner,
            )]
        }
        _ => vec![],
    }
}

/// Returns the word of a test at an offset.
fn word_of(request: &Request<'_>, inner: &Range<usize>) -> Range<usize> {
    let ends = |c: char| !(c.is_alphanumeric() || c == '_');
    let before = &request.text[inner.start..request.at];
    let blank = before.char_indices().rev().find(|(_, c)| ends(*c));
    let start = blank.map_or(inner.start, |(at, c)| inner.start + at + c.len_utf8());
    let end = request.text[request.at..inner.end].find(ends);
    start..end.map_or(inner.end, |i| request.at + i)
}

/// Returns the item of a list at an offset, without the blanks around it.
fn item(request: &Request<'_>, inner: &Range<usize>, dividers: &[char]) -> Range<usize> {
    let before = &request.text[inner.start..request.at];
    let start = before
        .rfind(dividers)
        .map_or(inner.start, |i| inner.start + i + 1);
    let blanks =
        request.text[start..request.at].len() - request.text[start..request.at].trim_start().len();
    let end = request.text[request.at..inner.end]
        .find(dividers)
        .map_or(inner.end, |i| request.at + i);
    start + blanks..end
}

/// Returns files below the folder of the file.
fn files(request: &Request<'_>, inner: &Range<usize>, endings: &[&str]) -> Vec<Completion> {
    let own = request
        .a
        .source
        .name()
        .rsplit(['/', '\\'])
        .next()
        .unwrap_or_default();
    let mut all: Vec<String> = endings.iter().flat_map(|e| (request.files)(e)).collect();
    all.sort();
    all.dedup();
    let others = all.iter().filter(|f| *f != own);
    let word = |f: &String| Completion::word(f, CompletionKind::File, Text::default(), inner);
    others.map(word).collect()
}

/// Returns names that other elements of a kind have.
fn references(request: &Request<'_>, element: &str, inner: &Range<usize>) -> Vec<Completion> {
    let elements = request.a.outline().elements.iter();
    let named = elements.filter(|e| e.schema.is_some_and(|s| s.name == element));
    let ids = named.filter_map(|e| e.attribute("id"));
    let others = ids.filter(|a| a.inner != *inner);
    let mut names: Vec<&str> = others
        .map(|a| a.value.trim())
        .filter(|n| !n.is_empty())
        .collect();
    names.sort_unstable();
    names.dedup();
    let about = || text!([element] "the id of another `{element}`", "ほかの `{element}` の id");
    let word = |n: &&str| Completion::word(n, CompletionKind::Reference, about(), inner);
    names.iter().map(word).collect()
}

/// Returns the body elements that a `change` or `remove` may name.
fn shapes(inner: &Range<usize>) -> Vec<Completion> {
    let real = vocabulary::SHAPES
        .iter()
        .filter(|(w, _)| body::attributes_of(w).is_some());
    real.map(|(w, about)| Completion::word(w, CompletionKind::Value, (*about).into(), inner))
        .collect()
}

/// Returns the surfaces of the texture library.
fn surfaces(inner: &Range<usize>) -> Vec<Completion> {
    let all = material::all().iter();
    all.map(|s| Completion::word(s.name, CompletionKind::Value, Text::default(), inner))
        .collect()
}

/// Returns values of a parameter: those of its list, and its default.
fn argument(request: &Request<'_>, tag: &Tag, name: &str, inner: &Range<usize>) -> Vec<Completion> {
    let all = names::of_use(request, tag);
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
    if parts::meant(request.a, request.at, default).is_some() {
        found.extend(parts::in_value(request, inner));
    }
    found
}

/// Returns the default of a parameter, empty if it has none.
pub(super) fn default_of<'a>(parameter: &KnownName<'a>) -> &'a str {
    let element = parameter.element();
    match parameter.is_argument() {
        true => element.attributes[parameter.attribute].value.trim(),
        false => element.value("default").unwrap_or_default().trim(),
    }
}
