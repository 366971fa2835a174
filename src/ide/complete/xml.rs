//! Elements, end tags and attributes of the XML form.

use super::place::{self, Open, Place, Tag};
use super::{Ask, Completion, CompletionKind, cells, names, parts, values};
use crate::catalog::body;
use crate::diagnostic::{Noun, Text, noun};
use crate::ide::names::{self as known, Known};
use crate::ide::words;
use crate::parse::xml::schema::{self, Content, ELEMENTS, Holds, ROOT, Schema};
use std::ops::Range;

/// What may stand at the place that was asked about.
pub(super) fn complete(ask: &Ask<'_>) -> Vec<Completion> {
    let (place, open) = place::place(ask.text, ask.at);
    match place {
        Place::Nowhere => vec![],
        Place::EndTag(range) => end_tags(&open, &range),
        Place::TagName(tag) => {
            let start = tag.name.start - 1;
            let mut found = elements(ask, &open, start..tag.name.end, &tag);
            if tag.name.is_empty() || tag.attributes.is_empty() {
                found.extend(end_tags(&open, &(start..tag.name.end)));
            }
            found
        }
        Place::AttributeName(tag, range) => attributes(ask, &open, &tag, range),
        Place::Value(tag, index) => values::complete(ask, &open, &tag, index),
        Place::Content => content(ask, &open),
    }
}

/// What an element holds.
pub(super) enum Held {
    /// What the language says.
    Known(&'static Content),
    /// Pieces of anything.
    Anything,
    /// Elements of shape.
    Shapes,
    /// `choice` elements.
    Choices,
    /// Nothing is known of it.
    Unknown,
}

/// What stands in the innermost of the open elements.
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
    /// Whether text is codes there.
    pub(super) fn text(&self) -> bool {
        match self {
            Held::Known(content) => content.text,
            Held::Anything => true,
            Held::Shapes | Held::Choices | Held::Unknown => false,
        }
    }
}

/// Among elements and codes.
fn content(ask: &Ask<'_>, open: &Open<'_>) -> Vec<Completion> {
    let held = held(open);
    if held.text() {
        let from = ask.text[..ask.at].rfind(['>', '\n']).map_or(0, |i| i + 1);
        if let Some(from) = place::braces(ask.text, from, ask.at) {
            return names::in_braces(ask, from, is_numbered(open));
        }
        let cell = cells::under_way(ask.text, run(ask.text, ask.at), ask.at, &|code| {
            parts::meant(ask.a, ask.at, code).is_some()
        });
        let mut found = parts::in_run(ask, &cell, storey(ask, open));
        if cell.typed.is_empty() && !matches!(held, Held::Anything) {
            found.extend(elements(ask, open, ask.at..ask.at, &Tag::default()));
        }
        return found;
    }
    let before = ask.text[..ask.at].trim_end_matches(|c: char| c.is_alphanumeric());
    elements(ask, open, before.len()..ask.at, &Tag::default())
}

/// The run of codes that an offset lies in: a line, up to tags and braces, without its indentation.
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

/// Whether there is a number of a storey.
pub(super) fn is_numbered(open: &[(&str, usize)]) -> bool {
    open.iter()
        .any(|(name, _)| matches!(*name, "Storey" | "Floor" | "define"))
}

/// Which storey and wall a row belongs to, as far as its tags tell.
fn storey(ask: &Ask<'_>, open: &Open<'_>) -> parts::Storey {
    let start = |name: &str| {
        open.iter()
            .rev()
            .find(|(n, _)| *n == name)
            .map(|(_, at)| *at)
    };
    let before = |from: Option<usize>, tag: &str, to: usize| {
        from.is_some_and(|from| ask.text.get(from + 1..to).is_some_and(|t| t.contains(tag)))
    };
    let (house, storey) = (start("House"), start("Storey"));
    parts::Storey {
        upper: before(house, "</Storey", storey.unwrap_or(ask.at)),
        rear: before(storey, "</Row", ask.at),
    }
}

/// The elements that may stand in the innermost open one. `range` begins with the `<`, where there is one.
fn elements(ask: &Ask<'_>, open: &Open<'_>, range: Range<usize>, tag: &Tag) -> Vec<Completion> {
    let held = held(open);
    let mut found = vec![];
    let mut add = |name: &str, about: Text, form: Form, rank: u32| {
        // The name of a tag that goes on is changed, and nothing else.
        let goes_on = tag.closed || !tag.attributes.is_empty();
        let word = Completion::word(name, CompletionKind::Element, about, &range);
        found.push(Completion {
            insert: if goes_on {
                format!("<{name}")
            } else {
                form.plain
            },
            snippet: (!goes_on).then_some(form.snippet),
            filter: if ask.text[range.clone()].starts_with('<') {
                format!("<{name}")
            } else {
                name.to_owned()
            },
            ..word.sorted(format!("{rank:03}"))
        });
    };
    let follows = ask.text[..range.start].trim_end();
    for (rank, schema) in allowed(&held)
        .into_iter()
        .chain(language(&held, open, follows))
    {
        let about = both(schema.en, schema.ja);
        add(schema.name, about, Form::of(schema), rank);
    }
    if matches!(held, Held::Shapes) {
        for (rank, (name, about)) in (100..).zip(words::SHAPES) {
            add(name, (*about).into(), Form::of_shape(name), rank);
        }
    }
    found
}

/// What an element may hold, each with its rank.
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

/// The elements that are worked out before all else, where they may stand behind this text.
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

/// Elements that stand in no piece.
const OUTER: [&str; 4] = ["Houses", "Catalog", "choice", "PartDef"];

/// How an element is written.
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

/// A value that an attribute may begin with.
fn first(bears: &schema::Bears) -> &'static str {
    match bears.kind {
        _ if !bears.default.is_empty() => bears.default,
        schema::Kind::Choice(words) => words.first().copied().unwrap_or(""),
        schema::Kind::Whole(..) => "2",
        schema::Kind::Number(..) => "0",
        _ => "",
    }
}

/// A text in a snippet.
pub(super) fn escaped(text: &str) -> String {
    text.replace('\\', "\\\\")
        .replace('$', "\\$")
        .replace('}', "\\}")
}

fn both(en: &'static str, ja: &'static str) -> Text {
    noun(en, ja).into()
}

/// The end tag of the innermost open element, then those round it.
fn end_tags(open: &Open<'_>, range: &Range<usize>) -> Vec<Completion> {
    const ENDS: Noun = noun("ends the innermost open element", "開いている要素を閉じる");
    let innermost = open.iter().rev().take(1);
    let tags = innermost.map(|(name, _)| {
        let word = format!("</{name}>");
        Completion::word(&word, CompletionKind::EndTag, ENDS.into(), range).sorted("0")
    });
    tags.collect()
}

/// The attributes that a tag does not bear yet.
fn attributes(ask: &Ask<'_>, open: &Open<'_>, tag: &Tag, range: Range<usize>) -> Vec<Completion> {
    let name = &ask.text[tag.name.clone()];
    let valued = ask.text[range.end..].trim_start().starts_with('=');
    let there: Vec<&str> = tag
        .attributes
        .iter()
        .filter(|a| a.name != range)
        .map(|a| &ask.text[a.name.clone()])
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
            for (rank, bears) in (0..).zip(schema.attributes) {
                let rank = if bears.required { rank } else { 100 + rank };
                let choices = choices(bears, first(bears));
                add(bears.name, about(bears), (first(bears), &choices), rank);
            }
            let parameters = match name {
                "use" => parameters(ask, tag),
                _ => vec![],
            };
            for (rank, parameter) in (50..).zip(&parameters) {
                let default = values::default_of(parameter);
                let about = names::about(parameter);
                add(parameter.name(), about, (default, &[]), rank);
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

/// An attribute with its value: a default, or the words it may be.
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

/// What an attribute means, and what holds without it.
fn about(bears: &schema::Bears) -> Text {
    let (mut en, mut ja) = (bears.en.to_owned(), bears.ja.to_owned());
    if bears.required {
        en += " (required)";
        ja += "(必須)";
    } else if !bears.default.is_empty() {
        en += &format!(" ({} without)", bears.default);
        ja += &format!("(既定 {})", bears.default);
    }
    Text::both(en, ja)
}

/// The words of an attribute, that which one begins with first.
fn choices(bears: &schema::Bears, first: &str) -> Vec<&'static str> {
    let words: &[&str] = match bears.kind {
        schema::Kind::Choice(words) => words,
        schema::Kind::YesNo => &["yes", "no"],
        _ => &[],
    };
    let mut words = words.to_vec();
    words.sort_by_key(|w| *w != first);
    words
}

/// The parameters of the piece that a `use` names.
pub(super) fn parameters<'a>(ask: &Ask<'a>, tag: &Tag) -> Vec<Known<'a>> {
    let named = tag
        .attributes
        .iter()
        .find(|a| &ask.text[a.name.clone()] == "name");
    let Some(name) = named.and_then(|a| a.inner.clone()) else {
        return vec![];
    };
    let name = ask.text[name].trim();
    let piece = known::pieces(ask.a, ask.at)
        .into_iter()
        .find(|p| p.name() == name);
    piece.map_or(vec![], |piece| known::parameters(&piece))
}

/// The attributes of an element of shape.
fn shape_attributes(name: &str, open: &Open<'_>) -> Vec<(&'static str, &'static str)> {
    if !matches!(held(open), Held::Shapes) {
        return vec![];
    }
    match name {
        "change" | "remove" => vec![
            ("element", "Which elements of the base."),
            ("at", "Which of several, counted from 1."),
        ],
        _ => body::attributes_of(name).unwrap_or_default(),
    }
}
