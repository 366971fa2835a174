//! Elements, end tags and attributes of the XML form.

use super::place::{self, CursorPlace, Open, Tag};
use super::{Completion, CompletionKind, Request, cells, names, parts, values};
use crate::names::KnownName;
use crate::vocabulary;
use hsd_base::diagnostic::{Noun, Text, noun};
use hsd_base::text;
use hsd_ir::catalog::body;
use hsd_syntax::parse::schema;
use hsd_syntax::parse::schema::{Content, ELEMENTS, Holds, ROOT, Schema};
use std::ops::Range;

/// Returns the completions at the requested place.
pub(super) fn complete(request: &Request<'_>) -> Vec<Completion> {
    let (place, open) = place::place(request.text, request.at);
    match place {
        CursorPlace::Nowhere => vec![],
        CursorPlace::EndTag(range) => end_tags(&open, &range),
        CursorPlace::TagName(tag) => {
            let start = tag.name.start - 1;
            let mut found = elements(request, &open, start..tag.name.end, &tag);
            if tag.name.is_empty() || tag.attributes.is_empty() {
                found.extend(end_tags(&open, &(start..tag.name.end)));
            }
            found
        }
        CursorPlace::AttributeName(tag, range) => attributes(request, &open, &tag, range),
        CursorPlace::Value(tag, index) => values::complete(request, &open, &tag, index),
        CursorPlace::Content => content(request, &open),
    }
}

/// The content allowed in an element.
pub(super) enum Held {
    /// As described in the language's tables.
    Known(&'static Content),
    /// The content of a definition.
    Anything,
    /// Body elements.
    Shapes,
    /// `choice` elements.
    Choices,
    /// Unknown content.
    Unknown,
}

/// Returns the content allowed in the innermost open element.
pub(super) fn held(open: &[(&str, usize)]) -> Held {
    let Some(((name, _), round)) = open.split_last() else {
        return Held::Known(&ROOT);
    };
    let Some(schema) = schema::named(name) else {
        let shape = body::attributes_of(name).is_some();
        return if shape { Held::Shapes } else { Held::Unknown };
    };
    match schema.holds {
        Holds::Only(content) => Held::Known(content),
        Holds::Repeated => match held(round) {
            Held::Known(content) => Held::Known(content.repeated()),
            other => other,
        },
        Holds::Same => {
            let outside = round.split_last().filter(|((n, _), _)| *n == "random");
            held(outside.map_or(round, |(_, outer)| outer))
        }
        Holds::Anything => Held::Anything,
        Holds::Shapes => Held::Shapes,
        Holds::Choices => Held::Choices,
    }
}

impl Held {
    /// Returns true if text is read as codes there.
    pub(super) fn text(&self) -> bool {
        match self {
            Held::Known(content) => content.text,
            Held::Anything => true,
            Held::Shapes | Held::Choices | Held::Unknown => false,
        }
    }
}

/// Returns the completions among elements and codes.
fn content(request: &Request<'_>, open: &Open<'_>) -> Vec<Completion> {
    let held = held(open);
    if held.text() {
        let from = request.text[..request.at]
            .rfind(['>', '\n'])
            .map_or(0, |i| i + 1);
        if let Some(from) = place::braces(request.text, from, request.at) {
            return names::in_braces(request, from, (open, None));
        }
        let cell = cells::under_way(
            request.text,
            run(request.text, request.at),
            request.at,
            &|code| parts::meant(request.a, request.at, code).is_some(),
        );
        let mut found = parts::in_run(request, &cell, storey(request, open));
        if cell.typed.is_empty() && !matches!(held, Held::Anything) {
            found.extend(elements(
                request,
                open,
                request.at..request.at,
                &Tag::default(),
            ));
        }
        return found;
    }
    let before = request.text[..request.at].trim_end_matches(|c: char| c.is_alphanumeric());
    elements(request, open, before.len()..request.at, &Tag::default())
}

/// Returns the run of codes at an offset: a line, up to tags and braces, without its indentation.
fn run(text: &str, at: usize) -> Range<usize> {
    let start = text[..at]
        .rfind(['\n', '\r', '>', '}'])
        .map_or(0, |i| i + 1);
    let blanks = text[start..at].len()
        - text[start..at]
            .trim_start_matches([' ', '\t', '\u{3000}'])
            .len();
    let fresh = start == 0 || text[..start].ends_with(['\n', '\r']);
    let start = if fresh { start + blanks } else { start };
    let end = text[at..]
        .find(['\n', '\r', '<', '{'])
        .map_or(text.len(), |i| at + i);
    start..end
}

/// Returns the storey and wall of a row, as far as its tags tell.
fn storey(request: &Request<'_>, open: &Open<'_>) -> parts::Storey {
    let start = |name: &str| {
        open.iter()
            .rev()
            .find(|(n, _)| *n == name)
            .map(|(_, at)| *at)
    };
    let before = |from: Option<usize>, tag: &str, to: usize| {
        from.is_some_and(|from| {
            request
                .text
                .get(from + 1..to)
                .is_some_and(|t| t.contains(tag))
        })
    };
    let (house, storey) = (start("House"), start("Storey"));
    parts::Storey {
        upper: before(house, "</Storey", storey.unwrap_or(request.at)),
        rear: before(storey, "</Row", request.at),
    }
}

/// Returns the elements allowed in the innermost open one. `range` begins with the `<`, if there is one.
fn elements(
    request: &Request<'_>,
    open: &Open<'_>,
    range: Range<usize>,
    tag: &Tag,
) -> Vec<Completion> {
    let held = held(open);
    let mut found = vec![];
    let mut add = |name: &str, about: Text, form: Form, rank: u32| {
        // Only the name of a tag with further content is replaced.
        let goes_on = tag.closed || !tag.attributes.is_empty();
        let word = Completion::word(name, CompletionKind::Element, about, &range);
        found.push(Completion {
            insert: if goes_on {
                format!("<{name}")
            } else {
                form.plain
            },
            snippet: (!goes_on).then_some(form.snippet),
            filter: if request.text[range.clone()].starts_with('<') {
                format!("<{name}")
            } else {
                name.to_owned()
            },
            ..word.sorted(format!("{rank:03}"))
        });
    };
    let follows = request.text[..range.start].trim_end();
    for (rank, schema) in allowed(&held)
        .into_iter()
        .chain(language(&held, open, follows))
    {
        let about = both(schema.en, schema.ja);
        add(schema.name, about, Form::of(schema), rank);
    }
    if matches!(held, Held::Shapes) {
        for (rank, (name, about)) in (100..).zip(vocabulary::SHAPES) {
            add(name, (*about).into(), Form::of_shape(name), rank);
        }
    }
    found
}

/// Returns the elements that an element allows, each with its rank.
fn allowed(held: &Held) -> Vec<(u32, &'static Schema)> {
    let list: Vec<&'static Schema> = match held {
        Held::Known(content) => content.elements().collect(),
        Held::Anything => ELEMENTS
            .iter()
            .filter(|e| !e.is_language() && !OUTER.contains(&e.name))
            .collect(),
        Held::Choices => ELEMENTS.iter().filter(|e| e.is_choice()).collect(),
        Held::Shapes | Held::Unknown => vec![],
    };
    (100..).zip(list).collect()
}

/// Returns the elements that are evaluated before all others, if they are allowed here.
fn language(held: &Held, open: &Open<'_>, follows: &str) -> Vec<(u32, &'static Schema)> {
    let nothing = matches!(held, Held::Known(content) if content.is_nothing());
    if open.is_empty() || nothing || matches!(held, Held::Choices | Held::Shapes) {
        return vec![];
    }
    let inner = open.last().map_or("", |(name, _)| *name);
    let stands = |schema: &&'static Schema| match schema.name {
        "Param" => schema::named(inner).is_some_and(Schema::takes_parameters),
        _ if schema.is_else() => follows.ends_with("</if>") || follows.ends_with("</else>"),
        _ => true,
    };
    let all = ELEMENTS.iter().filter(|e| e.is_language()).filter(stands);
    (300..)
        .zip(all)
        .map(|(rank, schema)| (if schema.is_else() { 50 } else { rank }, schema))
        .collect()
}

/// Elements that no definition contains.
const OUTER: [&str; 4] = ["Houses", "Catalog", "choice", "PartDef"];

/// The form in which an element is written.
struct Form {
    plain: String,
    snippet: String,
}

impl Form {
    fn of(schema: &Schema) -> Form {
        let required: Vec<(&str, &str)> = schema
            .attributes
            .iter()
            .filter(|a| a.required && !(schema.name == "random" && a.name == "weights"))
            .map(|a| (a.name, first(a)))
            .collect();
        let holds = !schema.is_leaf() && schema.name != "random";
        Form::new(schema.name, &required, holds)
    }

    fn of_shape(name: &str) -> Form {
        let required: &[(&str, &str)] = match name {
            "change" => &[("element", "")],
            _ => &[],
        };
        Form::new(name, required, matches!(name, "oriel" | "grid"))
    }

    fn new(name: &str, required: &[(&str, &str)], holds: bool) -> Form {
        let (mut plain, mut snippet) = (format!("<{name}"), format!("<{name}"));
        for (number, (attribute, value)) in (1..).zip(required) {
            plain.push_str(&format!(" {attribute}=\"{value}\""));
            snippet.push_str(&format!(
                " {attribute}=\"${{{number}:{}}}\"",
                escaped(value)
            ));
        }
        match holds {
            true => {
                plain.push_str(&format!("></{name}>"));
                snippet.push_str(&format!(">$0</{name}>"));
            }
            false => {
                plain.push_str("/>");
                snippet.push_str("/>$0");
            }
        }
        Form { plain, snippet }
    }
}

/// Returns a sample value of an attribute.
fn first(attribute_schema: &schema::AttributeSchema) -> &'static str {
    match attribute_schema.kind {
        _ if !attribute_schema.default.is_empty() => attribute_schema.default,
        schema::Kind::Choice(words) => words.first().copied().unwrap_or(""),
        schema::Kind::Whole(..) => "2",
        schema::Kind::Number(..) => "0",
        _ => "",
    }
}

/// Escapes a string for a snippet.
pub(super) fn escaped(text: &str) -> String {
    text.replace('\\', "\\\\")
        .replace('$', "\\$")
        .replace('}', "\\}")
}

fn both(en: &'static str, ja: &'static str) -> Text {
    noun(en, ja).into()
}

/// Returns the end tag of the innermost open element, then those around it.
fn end_tags(open: &Open<'_>, range: &Range<usize>) -> Vec<Completion> {
    const ENDS: Noun = noun("ends the innermost open element", "開いている要素を閉じる");
    let innermost = open.iter().rev().take(1);
    let tags = innermost.map(|(name, _)| {
        let word = format!("</{name}>");
        Completion::word(&word, CompletionKind::EndTag, ENDS.into(), range).sorted("0")
    });
    tags.collect()
}

/// Returns the attributes that a tag does not have yet.
fn attributes(
    request: &Request<'_>,
    open: &Open<'_>,
    tag: &Tag,
    range: Range<usize>,
) -> Vec<Completion> {
    let name = &request.text[tag.name.clone()];
    let valued = request.text[range.end..].trim_start().starts_with('=');
    let there: Vec<&str> = tag
        .attributes
        .iter()
        .filter(|a| a.name != range)
        .map(|a| &request.text[a.name.clone()])
        .collect();
    let mut found = vec![];
    let mut add = |attribute: &str, about: Text, form: (&str, &[&str]), rank: u32| {
        if !there.contains(&attribute) {
            let word = Completion::word(attribute, CompletionKind::Attribute, about, &range);
            let word = word.sorted(format!("{rank:03}"));
            found.push(if valued { word } else { with_value(word, form) });
        }
    };
    match schema::named(name) {
        Some(schema) => {
            for (rank, attribute_schema) in (0..).zip(schema.attributes) {
                let rank = if attribute_schema.required {
                    rank
                } else {
                    100 + rank
                };
                let choices = choices(attribute_schema, first(attribute_schema));
                add(
                    attribute_schema.name,
                    about(attribute_schema),
                    (first(attribute_schema), &choices),
                    rank,
                );
            }
            for (rank, (name, default, about)) in (50..).zip(parameters(request, tag, name)) {
                add(&name, about, (&default, &[]), rank);
            }
        }
        None => {
            for (rank, (attribute, about)) in (0..).zip(shape_attributes(name, open)) {
                add(attribute, about.into(), ("", &[]), rank);
            }
        }
    }
    found
}

/// Returns the parameters that a `use` or a `Place` can set: name, default and description.
fn parameters(request: &Request<'_>, tag: &Tag, element: &str) -> Vec<(String, String, Text)> {
    let of_use = |p: &KnownName<'_>| {
        let default = values::default_of(p).to_owned();
        (p.name().to_owned(), default, names::about(p))
    };
    match element {
        "use" => names::of_use(request, tag).iter().map(of_use).collect(),
        "Place" => {
            let all = values::of_type(request, tag).into_iter();
            all.map(|p| (p.name, p.default, p.about)).collect()
        }
        _ => vec![],
    }
}

/// Completes an attribute with its value: a default, or a choice of words.
fn with_value(word: Completion, (default, choices): (&str, &[&str])) -> Completion {
    let value = match choices {
        [] => format!("${{1:{}}}", escaped(default)),
        _ => format!("${{1|{}|}}", choices.join(",")),
    };
    let name = &word.label;
    Completion {
        insert: format!("{name}=\"{default}\""),
        snippet: Some(format!("{name}=\"{value}\"$0")),
        ..word
    }
}

/// Returns the description of an attribute, and its default.
fn about(attribute_schema: &schema::AttributeSchema) -> Text {
    let meaning = noun(attribute_schema.en, attribute_schema.ja);
    match attribute_schema.default {
        _ if attribute_schema.required => {
            text!([meaning] "{meaning} (required)", "{meaning}(必須)")
        }
        "" => meaning.into(),
        default => {
            text!([meaning, default] "{meaning} ({default} without)", "{meaning}(既定 {default})")
        }
    }
}

/// Returns the words of an attribute, its default first.
fn choices(attribute_schema: &schema::AttributeSchema, first: &str) -> Vec<&'static str> {
    let words: &[&str] = match attribute_schema.kind {
        schema::Kind::Choice(words) => words,
        schema::Kind::YesNo => &["yes", "no"],
        _ => &[],
    };
    let mut words = words.to_vec();
    words.sort_by_key(|w| *w != first);
    words
}

/// Returns the attributes of a body element.
fn shape_attributes(name: &str, open: &Open<'_>) -> Vec<(&'static str, &'static str)> {
    if !matches!(held(open), Held::Shapes) {
        return vec![];
    }
    match name {
        "change" | "remove" => vec![
            ("element", "The elements of the base to change."),
            ("at", "Their positions, counted from 1."),
        ],
        _ => body::attributes_of(name).unwrap_or_default(),
    }
}
