//! The fields of a town's maps, as they were when it was last checked with them, and the measures of features.

use super::{MEASURES, meaning};
use crate::Analysis;
use hsd_base::diagnostic::{Noun, Text, noun};
use hsd_base::text;
use hsd_ir::ast::town::FieldType;
use hsd_syntax::parse::syntax::Element;
use hsd_town::{FieldFacts, LayerFacts};

/// Returns what is known of a layer by its name in the town.
pub(crate) fn layer<'a>(a: &'a Analysis, name: &str) -> Option<&'a LayerFacts> {
    let layers = &a.town.as_ref()?.layers;
    layers.iter().find(|layer| layer.name == name)
}

/// Returns the layer whose features an element speaks of: it stands in their `for` or in their `Layer`, or is that.
pub(crate) fn layer_of(a: &Analysis, mut element: usize) -> Option<&LayerFacts> {
    let elements = &a.outline().elements;
    loop {
        let this = elements.get(element)?;
        if let Some(name) = layer_name(this) {
            return layer(a, name);
        }
        element = this.parent?;
    }
}

fn layer_name(element: &Element) -> Option<&str> {
    let name = match element.schema?.name {
        "for" => element.value("each")?,
        "Layer" => element.value("name")?,
        _ => return None,
    };
    Some(name.trim())
}

/// Describes a field in one line: its type, how many features have it, and some of its values.
pub(crate) fn about(field: &FieldFacts, layer: &LayerFacts) -> Text {
    let kind = kind(field.kind);
    let (count, features) = (field.count, layer.features);
    let head = text!([kind, count, features]
        "{kind}, in {count} of {features} features",
        "{kind}。{features} 件のうち {count} 件にある"
    );
    match examples(field) {
        list if list.is_empty() => head,
        list => text!([head, list] "{head}: {list}", "{head}: {list}"),
    }
}

/// Lists some values of a field.
fn examples(field: &FieldFacts) -> String {
    let short = |text: &String| match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.clone(),
    };
    let words: Vec<String> = field.examples.iter().map(short).collect();
    words.join(", ") + if field.more { ", …" } else { "" }
}

/// The number of characters of a value that are shown.
const LONGEST: usize = 24;

fn kind(kind: Option<FieldType>) -> Noun {
    match kind {
        Some(FieldType::Number) => noun("numbers", "数値"),
        Some(FieldType::Truth) => noun("yes or no", "真偽"),
        Some(FieldType::Text) => noun("texts", "文字列"),
        None => noun("values of several kinds", "種類の混じった値"),
    }
}

/// Returns the description of a measure.
pub(crate) fn measure(name: &str) -> Option<Noun> {
    meaning(MEASURES, name)
}
