//! The table itself for other programs: the reference is made of it.

use crate::schema::model::{self, Place};
use hsd::parse::schema::lengths::Measure;
use hsd::parse::schema::{AttributeSchema, Kind, Schema};
use serde_json::{Value, json};

/// The table.
pub fn make() -> String {
    let places = model::places();
    let elements: Vec<Value> = model::elements().map(|e| element(e, &places)).collect();
    let table = json!({ "version": 1, "elements": elements });
    serde_json::to_string_pretty(&table).expect("it is plain data") + "\n"
}

fn element(element: &Schema, places: &[Place]) -> Value {
    let attributes: Vec<Value> = element.attributes.iter().map(attribute).collect();
    json!({
        "name": element.name,
        "en": element.en,
        "ja": element.ja,
        "language": element.is_language(),
        "attributes": attributes,
        "anyAttributes": element.takes_any_attribute(),
        "holds": held(element, places),
    })
}

/// The elements that may stand in an element; `None` = what may stand round it.
pub fn held(element: &Schema, places: &[Place]) -> Option<Vec<&'static str>> {
    // The last place is that of anything.
    let anything = places.last()?;
    let inside = model::inside(element, anything);
    if inside == Some(anything.name) {
        return None;
    }
    let Some(place) = places.iter().find(|p| Some(p.name) == inside) else {
        return Some(vec![]);
    };
    let own = place.elements.iter().filter(|e| !e.is_language());
    Some(own.map(|e| e.name).collect())
}

fn attribute(attribute_schema: &AttributeSchema) -> Value {
    let numbers = |least: f64, most: f64| {
        let known = |n: f64| (n.abs() < f64::MAX).then_some(n);
        json!([known(least), known(most)])
    };
    let (kind, range, words): (&str, Value, &[&str]) = match attribute_schema.kind {
        Kind::Text => ("text", Value::Null, &[]),
        Kind::Number(least, most) => ("number", numbers(least, most), &[]),
        Kind::Whole(least, u64::MAX) => ("whole", json!([least, null]), &[]),
        Kind::Whole(least, most) => ("whole", json!([least, most]), &[]),
        Kind::Numbers(least, most) => ("numbers", numbers(least, most), &[]),
        Kind::Pair(least, most) => ("pair", numbers(least, most), &[]),
        Kind::WholePair(least, most) => ("pair of whole numbers", numbers(least, most), &[]),
        Kind::Point(..) => ("place", Value::Null, &[]),
        Kind::Spot(..) => ("spot", Value::Null, &[]),
        Kind::Points(..) => ("corners", Value::Null, &[]),
        Kind::YesNo => ("choice", Value::Null, &["yes", "no"]),
        Kind::Choice(words) => ("choice", Value::Null, words),
        Kind::Choices(words) => ("choices", Value::Null, words),
        Kind::Either(words, least, most) => ("choice or number", numbers(least, most), words),
        Kind::Positions => ("positions", Value::Null, &[]),
    };
    json!({
        "name": attribute_schema.name,
        "kind": kind,
        "range": range,
        "unit": attribute_schema.measure.map(|measure| match measure {
            Measure::Units => "U",
            Measure::Shaku => "shaku",
            Measure::Metres => "m",
        }),
        "words": words,
        "required": attribute_schema.required,
        "default": attribute_schema.default,
        "en": attribute_schema.en,
        "ja": attribute_schema.ja,
    })
}
