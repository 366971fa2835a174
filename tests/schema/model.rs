//! What both schemas have in common: which elements there are in which surroundings, and the names of types.

use hsd::parse::schema::lengths::{self, Measure};
use hsd::parse::schema::{AttributeSchema, Content, ELEMENTS, Holds, Kind, ROOT, Schema};

/// Surroundings in which anything may stand: those of `define`.
const ANYTHING: &str = "anything";

/// Surroundings of which only the catalogue knows the elements.
pub const SHAPES: &str = "shapes";

/// What may stand somewhere.
#[derive(Clone)]
pub struct Place {
    pub name: &'static str,
    /// Whether text is codes there.
    pub text: bool,
    /// Elements but `else`, those of the language too.
    pub elements: Vec<&'static Schema>,
    /// The place that a `repeat` makes.
    repeated: &'static str,
}

/// The elements that are read.
pub fn elements() -> impl Iterator<Item = &'static Schema> {
    ELEMENTS.iter()
}

/// The outermost elements.
pub fn roots() -> impl Iterator<Item = &'static Schema> {
    ROOT.elements()
}

/// Every place, those of `define` last.
pub fn places() -> Vec<Place> {
    let mut places: Vec<Place> = vec![];
    for element in elements() {
        if let Holds::Only(content) = element.holds {
            add(content, &mut places);
        }
    }
    let anything = Place {
        name: ANYTHING,
        text: true,
        elements: elements()
            .filter(|e| is_in_places(e))
            .filter(|e| places.iter().any(|p| holds(p, e)))
            .collect(),
        repeated: ANYTHING,
    };
    places.push(anything);
    places
}

fn holds(place: &Place, element: &Schema) -> bool {
    place.elements.iter().any(|e| e.name == element.name)
}

fn add(content: &'static Content, places: &mut Vec<Place>) {
    if is_nothing(content) || places.iter().any(|p| p.name == content.name) {
        return;
    }
    let language = elements().filter(|e| e.is_language() && is_in_places(e));
    places.push(Place {
        name: content.name,
        text: content.text,
        elements: content.elements().chain(language).collect(),
        repeated: content.repeated().name,
    });
    add(content.repeated(), places);
}

fn is_nothing(content: &Content) -> bool {
    content.name == "nothing"
}

/// The place in an element that stands in a place; `None` = it holds nothing.
pub fn inside(element: &Schema, place: &Place) -> Option<&'static str> {
    match element.holds {
        Holds::Only(content) => (!is_nothing(content)).then_some(content.name),
        Holds::Repeated => Some(place.repeated),
        Holds::Same => Some(place.name),
        Holds::Anything => Some(ANYTHING),
        Holds::Shapes => Some(SHAPES),
        Holds::Choices => None,
    }
}

/// The name of an element's type in a place: one for all places unless what it holds depends on the place.
pub fn type_name(element: &Schema, place: &Place) -> String {
    match element.holds {
        Holds::Only(_) | Holds::Anything | Holds::Choices | Holds::Shapes => {
            element.name.to_owned()
        }
        Holds::Repeated | Holds::Same => format!("{}.{}", element.name, place.name),
    }
}

/// Whether an element is among those of a place: not those that follow others or stand in certain elements only.
fn is_in_places(element: &Schema) -> bool {
    !element.is_else() && !element.is_choice() && element.name != "Param"
}

/// What a `random` of choices holds.
pub fn choice() -> &'static Schema {
    let found = elements().find(|e| e.is_choice());
    found.expect("the language has choices")
}

/// The `else` of the language.
pub fn otherwise() -> &'static Schema {
    let found = elements().find(|e| e.is_else());
    found.expect("the language has an else")
}

/// Every kind of value once, by its name.
pub fn kinds() -> Vec<(String, &'static AttributeSchema)> {
    let mut kinds: Vec<(String, &'static AttributeSchema)> = vec![];
    for attribute in elements().flat_map(|e| e.attributes) {
        let name = kind_name(attribute);
        if !kinds.iter().any(|(n, _)| *n == name) {
            kinds.push((name, attribute));
        }
    }
    kinds.sort_by(|a, b| a.0.cmp(&b.0));
    kinds
}

/// The name of the type of an attribute's value.
pub fn kind_name(attribute: &AttributeSchema) -> String {
    let range = |name: &str, least: f64, most: f64| match (least, most) {
        (f64::MIN, f64::MAX) => name.to_owned(),
        _ => format!("{name}_{least}_{most}"),
    };
    let number = match attribute.measure {
        Some(_) => "length",
        None => "number",
    };
    match attribute.kind {
        Kind::Text => "text".into(),
        Kind::Number(least, most) => range(number, least, most),
        Kind::Whole(least, u64::MAX) => format!("whole_{least}"),
        Kind::Whole(least, most) => format!("whole_{least}_{most}"),
        Kind::Numbers(..) => "numbers".into(),
        Kind::Pair(..) => format!("pair{}", of_lengths(attribute)),
        Kind::WholePair(..) => "whole_pair".into(),
        Kind::Point(..) => format!("point{}", of_lengths(attribute)),
        Kind::Spot(..) => format!("spot{}", of_lengths(attribute)),
        Kind::Points(..) => format!("points{}", of_lengths(attribute)),
        Kind::YesNo => "yes_no".into(),
        Kind::Choice(words) => format!("one_of_{}", words.join("_")),
        Kind::Choices(words) => format!("some_of_{}", words.join("_")),
        Kind::Either(words, least, most) => {
            let words = words.join("_").replace('*', "star");
            range(&format!("{words}_or_{number}"), least, most)
        }
        Kind::Positions => "positions".into(),
    }
}

/// The end of the name of a list of lengths.
fn of_lengths(attribute: &AttributeSchema) -> &'static str {
    match attribute.measure {
        Some(_) => "_of_lengths",
        None => "",
    }
}

/// What is between the items of a list.
const BETWEEN: &str = "[ ,、\u{3000}]+";

/// The pattern of a value that the types of XML Schema have no words for.
pub fn pattern(attribute: &AttributeSchema) -> Option<String> {
    const NUMBER: &str = r"[+\-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+\-]?[0-9]+)?";
    let units: Vec<&str> = lengths::units().collect();
    let units = units.join("|");
    let single = matches!(attribute.kind, Kind::Number(..) | Kind::Either(..));
    if single && attribute.measure.is_some() {
        return Some(format!(
            r"\s*[+\-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)\s*({units})\s*"
        ));
    }
    let number = match attribute.measure {
        Some(_) => format!(r"{NUMBER}(\s*({units}))?"),
        None => NUMBER.into(),
    };
    let padded = |inner: &str| format!(r"\s*({inner})\s*");
    let list = |item: &str| padded(&format!("{item}({BETWEEN}{item})*"));
    Some(match attribute.kind {
        Kind::Text => r".*\S.*|     ".into(),
        Kind::Numbers(..) => list(NUMBER),
        Kind::Pair(..) => padded(&format!("{number}({BETWEEN}{number})?")),
        Kind::WholePair(..) => padded(&format!(r"\+?[0-9]+({BETWEEN}\+?[0-9]+)?")),
        Kind::Point(..) => padded(&format!("{number}{BETWEEN}{number}")),
        Kind::Spot(..) => padded(&format!("{number}({BETWEEN}{number}){{2}}")),
        Kind::Points(..) => {
            const BREAK: &str = "[ ,;、\\s]+";
            let pair = format!("{number}{BREAK}{number}");
            padded(&format!("{pair}({BREAK}{pair})*"))
        }
        Kind::Choices(words) => list(&format!("({})", words.join("|"))),
        Kind::Positions => list("0*[1-9][0-9]*(-0*[1-9][0-9]*)?"),
        _ => return None,
    })
}

/// An expression somewhere in a value.
pub const EXPRESSION: &str = r".*\{.*\}.*";

/// The words of a value, without those of others.
pub fn words(kind: Kind) -> Vec<&'static str> {
    match kind {
        Kind::YesNo => vec!["yes", "no", "true", "false", "1", "0"],
        Kind::Choice(words) | Kind::Either(words, ..) => words.to_vec(),
        _ => vec![],
    }
}

/// The type of numbers and their bounds.
pub fn bounds(kind: Kind) -> Option<(&'static str, String, String)> {
    match kind {
        Kind::Number(least, most) | Kind::Either(_, least, most) => {
            Some(("double", format!("{least:?}"), format!("{most:?}")))
        }
        Kind::Whole(least, most) => Some(("unsignedLong", least.to_string(), most.to_string())),
        _ => None,
    }
}

/// A text in XML.
pub fn escape(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('>', "&gt;").replace('"', "&quot;")
}

/// Asserts that a length has the unit that its explanation names.
pub fn assert_measure(element: &str, attribute: &AttributeSchema, unit: &str) {
    use Kind::{Either, Number, Pair, Point, Points, Spot};
    if !matches!(
        attribute.kind,
        Number(..) | Either(..) | Pair(..) | Point(..) | Points(..) | Spot(..)
    ) {
        return;
    }
    let measure = match unit {
        "U" => Some(Measure::Units),
        "shaku | 尺" => Some(Measure::Shaku),
        "m" => Some(Measure::Metres),
        _ => None,
    };
    assert_eq!(attribute.measure, measure, "{element} {}", attribute.name);
}
