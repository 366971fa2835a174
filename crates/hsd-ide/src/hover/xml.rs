//! Elements, attributes and codes of the XML form.

use super::computed::{self, expression_at, word_at};
use super::{Hover, Request, built, holds};
use crate::card::short;
use crate::names::KnownName;
use crate::vocabulary;
use hsd_base::diagnostic::{Noun, Text, noun};
use hsd_base::text;
use hsd_ir::catalog::body;
use hsd_syntax::parse::schema::{AttributeSchema, Kind};
use hsd_syntax::parse::syntax::{Attribute, Element};

/// Returns the hover text at the requested place.
pub(super) fn hover(request: &Request<'_>) -> Option<Hover> {
    let outline = request.a.outline();
    let number = outline.element_at(request.at)?;
    let element = &outline.elements[number];
    let named = [Some(&element.name), element.end_name.as_ref()];
    if let Some(name) = named.into_iter().flatten().find(|n| holds(n, request.at)) {
        return element_told(request, element, name);
    }
    if let Some(attribute) = element
        .attributes
        .iter()
        .find(|a| holds(&a.range, request.at))
    {
        return attribute_told(request, number, attribute);
    }
    let words = element.words.iter().find(|w| holds(&w.range, request.at));
    let text = request.a.text();
    if let Some(words) = words {
        if let Some(expression) = expression_at(&words.expressions, request.at) {
            return computed::expression(request, expression);
        }
        let end = |c: &std::ops::Range<usize>| c.start + text[c.clone()].trim_end().len();
        if let Some(code) = words
            .codes
            .iter()
            .find(|c| c.start <= request.at && request.at < end(c))
        {
            return request.part(code, &text[code.clone()]);
        }
    }
    let row = element.schema.is_some_and(|s| s.name == "Row");
    row.then(|| request.told(&element.range, built::walls(request, &element.range)))
        .flatten()
}

/// Describes the kind of an element, and the things built from it.
fn element_told(
    request: &Request<'_>,
    element: &Element,
    name: &std::ops::Range<usize>,
) -> Option<Hover> {
    let word = &request.a.text()[name.clone()];
    let Some(schema) = element.schema else {
        let about: Text = vocabulary::meaning(vocabulary::SHAPES, word)?.into();
        return request.told(
            name,
            [text!([word, about] "**{word}**: {about}", "**{word}**: {about}")],
        );
    };
    let (en, ja) = (schema.en, schema.ja);
    let head = text!([word, en, ja] "**{word}**: {en}", "**{word}**: {ja}");
    let built = match schema.name {
        "Row" => built::walls(request, &element.range),
        "Storey" | "Floor" => built::storeys(request, &element.range),
        "House" | "Structure" => built::houses(request, &element.range),
        "Room" => built::rooms(request, &element.range),
        "Roof" => built::roofs(request, &element.range, false),
        "Roofs" => built::roofs(request, &element.range, true),
        _ => vec![],
    };
    let home = schema.home;
    let home = match schema.is_language() || schema.home.starts_with("nothing") {
        true => Text::default(),
        false => {
            let names = ja_home(home);
            text!([home, names] "in {home}", "書ける場所: {names}")
        }
    };
    let card = match (schema.name, element.value("code")) {
        ("Part" | "Put", Some(code)) => request.part(name, code).map(|h| h.markdown.into()),
        _ => None,
    };
    request.told(
        name,
        [head].into_iter().chain(built).chain(card).chain([home]),
    )
}

/// Returns the names in backticks of an English list of elements.
fn ja_home(home: &str) -> String {
    let names: Vec<&str> = home.split('`').skip(1).step_by(2).collect();
    names.join("、")
}

fn attribute_told(request: &Request<'_>, number: usize, attribute: &Attribute) -> Option<Hover> {
    let element = &request.a.outline().elements[number];
    let schema = element.schema.map_or("", |s| s.name);
    if holds(&attribute.name, request.at) {
        if let Some(attribute_schema) = attribute.attribute_schema {
            return request.told(&attribute.name, bears_told(attribute_schema));
        }
        let word = &request.a.text()[element.name.clone()];
        let known = body::attributes_of(word).unwrap_or_default();
        let about = known
            .iter()
            .find(|(n, _)| *n == attribute.word)
            .map(|(_, about)| *about);
        if let Some(about) = about {
            let name = &attribute.word;
            return request.told(&attribute.name, [format!("`{name}`: {about}").into()]);
        }
        return None;
    }
    if let Some(expression) = expression_at(&attribute.expressions, request.at) {
        return computed::expression(request, expression);
    }
    let inner = &attribute.inner;
    if !holds(inner, request.at) {
        return None;
    }
    let value = attribute.value.trim();
    match (schema, attribute.word.as_str()) {
        ("Part" | "Texture" | "Put", "code") | ("PartDef", "base" | "code") => {
            request.part(inner, value)
        }
        ("random" | "replace", "code" | "with") => listed_part(request, attribute),
        ("use", "name") => computed::piece(request, inner, value),
        ("Place", "type") => computed::house_type(request, inner, value),
        ("include", "href") => computed::file(request, inner, value),
        ("Field", "from") | ("Layer", "key" | "outline" | "order") => {
            computed::field(request, inner)
        }
        ("Layer", "where") => computed::field(request, &word_at(request.a.text(), request.at)),
        ("let" | "Param", "name") => {
            computed::value(request, inner, &KnownName::of(request.a, number)?)
        }
        (_, name) => {
            let table = vocabulary::table(schema, name);
            let word = word_at(request.a.text(), request.at);
            let word = if table.iter().any(|(w, _)| *w == value) {
                inner.clone()
            } else {
                word
            };
            let written = request.a.text().get(word.clone())?;
            let about = vocabulary::meaning(table, written)?;
            request.told(
                &word,
                [text!([written, about] "`{written}`: {about}", "`{written}`: {about}")],
            )
        }
    }
}

/// Returns the card of the part in a list of codes.
fn listed_part(request: &Request<'_>, attribute: &Attribute) -> Option<Hover> {
    let text = request.a.text();
    let inner = &attribute.inner;
    let start = text[inner.start..request.at]
        .rfind(',')
        .map_or(inner.start, |i| inner.start + i + 1);
    let end = text[request.at..inner.end]
        .find(',')
        .map_or(inner.end, |i| request.at + i);
    let start = start + text[start..end].len() - text[start..end].trim_start().len();
    let end = start + text[start..end].trim_end().len();
    let range = start..end.max(start);
    if !holds(&range, request.at) {
        return None;
    }
    request.part(&range, &text[range.clone()])
}

/// Describes an attribute, its values, and its default.
fn bears_told(attribute_schema: &AttributeSchema) -> Vec<Text> {
    let (name, en, ja) = (
        attribute_schema.name,
        attribute_schema.en,
        attribute_schema.ja,
    );
    let mut told = vec![text!([name, en, ja] "`{name}`: {en}", "`{name}`: {ja}")];
    told.extend(form(attribute_schema.kind));
    if attribute_schema.required {
        told.push(noun("required", "必須").into());
    } else if !attribute_schema.default.is_empty() {
        let default = attribute_schema.default;
        told.push(text!([default] "`{default}` without it", "既定値 `{default}`"));
    }
    told
}

/// Describes the form of a place, or of a list of places.
fn places(kind: Kind) -> Noun {
    match kind {
        Kind::Spot(..) => noun(
            "three numbers: metres east, north and up",
            "数値三つ。東へ、北へ、高さ(m)",
        ),
        Kind::Points(..) => noun(
            "corners: two numbers each, divided by commas",
            "コンマで区切った隅。数値ふたつずつ",
        ),
        _ => noun("two numbers: a and b", "ふたつの数値 a、b"),
    }
}

/// Describes the kind of value of an attribute.
fn form(kind: Kind) -> Option<Text> {
    let number = |least: f64, most: f64| {
        let (least, most) = (bound(least), bound(most));
        text!([least, most] "from {least} to {most}", "{least} から {most} まで")
    };
    let list = |list: &[&str]| {
        list.iter()
            .map(|w| format!("`{w}`"))
            .collect::<Vec<_>>()
            .join(", ")
    };
    Some(match kind {
        Kind::Text => return None,
        Kind::Number(least, most) if most >= f64::MAX || least <= f64::MIN => {
            noun("a number", "数値").into()
        }
        Kind::Number(least, most) => {
            let bounds = number(least, most);
            text!([bounds] "a number {bounds}", "数値 {bounds}")
        }
        Kind::Whole(_, most) if most == u64::MAX => noun("a whole number", "整数").into(),
        Kind::Whole(least, most) => text!([least, most]
            "a whole number from {least} to {most}",
            "{least} から {most} までの整数"
        ),
        Kind::Numbers(..) => noun(
            "numbers divided by blanks or commas",
            "空白かコンマで区切った数値",
        )
        .into(),
        Kind::Pair(..) | Kind::WholePair(..) => noun(
            "two numbers, or one for both",
            "ふたつの数値、または両方を兼ねる一つ",
        )
        .into(),
        Kind::Point(..) | Kind::Spot(..) | Kind::Points(..) => places(kind).into(),
        Kind::YesNo => noun("`yes` or `no`", "`yes` か `no`").into(),
        Kind::Choice(words) => list(words).into(),
        Kind::Choices(words) => {
            let words = list(words);
            text!([words] "some of {words}", "{words} のいくつか")
        }
        Kind::Either(words, ..) => {
            let words = list(words);
            text!([words] "{words}, or a number", "{words} または数値")
        }
        Kind::Positions => noun(
            "positions from 1, such as `2,5-7`",
            "`2,5-7` のような位置(1 から)",
        )
        .into(),
    })
}

fn bound(number: f64) -> String {
    match number.abs() >= 1e9 {
        true => format!("{number:e}"),
        false => short(number, 6),
    }
}
