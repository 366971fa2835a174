//! What the tables call the default of an attribute is what holds without it: a text that says so builds the same
//! house as one that does not.

use crate::schema::model;
use hsd::diagnostic::Diagnostics;
use hsd::source::{FileId, NoFiles, Source};
use serde_json::Value;

/// Texts in which an element stands without its attributes: (elements, text).
const HOSTS: &[(&[&str], &str)] = &[
    (
        &["House", "Storey", "Row", "Roofs", "Posts", "Veranda", "Brackets", "Platform", "split"],
        "<House><Platform/><Storey><Row>KSK  KSK  KSK  <split><upper>KSK</upper><lower>TOD</lower></split></Row>
         <Row>KSK  KSK  KSK</Row><Row>KSK  KSK  KSK  KSK</Row><Row>KSK  KSK  KSK</Row><Posts/><Veranda/><Brackets/></Storey><Roofs/></House>",
    ),
    (
        &["Outline", "Walls", "Side"],
        "<House><Outline points=\"0 0, 5 0, 5 4, 0 4\"/><Storey><Walls><Side><fill>KSK  MRE</fill></Side></Walls></Storey></House>",
    ),
    (
        &["Loop"],
        "<House><Storey><Loop><Row>KSK  KSK  KSK</Row><Row>KSK  KSK</Row><Row>KSK  KSK  KSK</Row><Row>KSK  KSK</Row></Loop>
         </Storey></House>",
    ),
    (
        &["Room"],
        "<House><Storey><Row>TIT 2KSK</Row><Row>KSK  KSK</Row><Row>KSK  KSK  KSK</Row><Row>KSK  KSK</Row><Room  at='1 1'/></Storey></House>",
    ),
    (
        &["Fixture"],
        "<House><Storey><Row>TIT 2KSK</Row><Row>KSK  KSK</Row><Row>KSK  KSK  KSK</Row><Row>KSK  KSK</Row><Fixture  kind='well' at='1 1'/></Storey></House>",
    ),
    (
        &["Put"],
        "<House><Storey><Row>KSK</Row><Row>KSK</Row><Row>KSK</Row><Row>KSK</Row></Storey><Put  code='OTO' at='1 -3'/></House>",
    ),
    (
        &["Ground"],
        "<House><Storey><Row>KSK</Row><Row>KSK</Row><Row>KSK</Row><Row>KSK</Row></Storey><Ground  surface='moss' at='1 -3' size='2'/></House>",
    ),
    (
        &["Roof"],
        "<House><Storey><Row>KSK  KSK  KSK</Row><Row>KSK  KSK</Row><Row>KSK  KSK  KSK</Row><Row>KSK  KSK</Row></Storey>
         <Roofs><Roof a0=\"0\" b0=\"0\" a1=\"3\" b1=\"2\" shape=\"KIR\"/></Roofs></House>",
    ),
    (
        &["Structure", "Floor"],
        "<Structure><Facades><Facade><Floor>KSK  KSK  TOD</Floor></Facade><Facade><Floor>KSK  KSK</Floor></Facade>
         <Facade><Floor>KSK  KSK  KSK</Floor></Facade><Facade><Floor>KSK  KSK</Floor></Facade></Facades></Structure>",
    ),
    (
        &["Group", "Place"],
        "<Houses><Group ><Place  type='kura'/></Group></Houses>",
    ),
    (&["Pagoda"], "<House><Pagoda/></House>"),
    (&["Gate"], "<House><Gate/></House>"),
    (&["Hall"], "<House><Hall/></House>"),
    (&["Shrine"], "<House><Shrine/></House>"),
];

/// Defaults that hold for all but one of their kind, which the texts above have: (element, attribute).
const EXCEPTIONS: &[(&str, &str)] = &[
    ("Facade", "angle"),
    ("Facade", "reflection"),
    ("choice", "weight"),
    ("Param", "random"),
    ("View", "fov"),
    // Towns build nothing without their maps; see tests/towns.rs.
    ("Town", "seed"),
    ("Town", "geoid"),
    ("Rear", "density"),
    ("Road", "surface"),
    ("Road", "pavement"),
    ("Road", "drain"),
    ("Rail", "gauge"),
    ("Tree", "spacing"),
    ("Tree", "offset"),
    ("Fence", "code"),
    ("Hedge", "code"),
    ("Wall", "code"),
    ("Fence", "gate"),
    ("Hedge", "gate"),
    ("Wall", "gate"),
    ("Pole", "height"),
    ("Pole", "spacing"),
    ("Pole", "wires"),
    ("Pole", "sag"),
    ("Pole", "made"),
    ("Network", "height"),
    ("Network", "spacing"),
    ("Network", "reach"),
    ("Network", "wires"),
    ("Network", "sag"),
    ("Network", "made"),
    ("Wire", "height"),
    ("Wire", "wires"),
    ("Wire", "sag"),
    ("Signal", "height"),
    ("Sign", "size"),
    ("Sign", "height"),
    ("Sign", "board"),
    ("Arcade", "depth"),
    ("Arcade", "height"),
    ("Arcade", "bay"),
    ("Torii", "code"),
    ("Lantern", "code"),
    ("Water", "width"),
    ("Water", "bank"),
    ("Water", "bank_width"),
    ("Farmland", "crop"),
    ("Farmland", "width"),
    ("Farmland", "depth"),
    ("Farmland", "azimuth"),
    ("Farmland", "ridge"),
    ("Farmland", "way"),
    ("Residence", "house"),
    ("Residence", "code"),
    ("Residence", "height"),
    ("Residence", "gate"),
    ("Residence", "gatehouse"),
    ("Residence", "species"),
    ("Residence", "spacing"),
    ("Block", "side"),
    ("Envelope", "show"),
    ("Join", "within"),
    ("Divide", "plots"),
    ("Divide", "blocks"),
    ("Divide", "streets"),
    ("Divide", "yards"),
    ("Divide", "frontage"),
    ("Divide", "depth"),
    ("Divide", "street"),
    ("Divide", "every"),
    ("Divide", "deep"),
    ("Tiles", "size"),
    ("Tiles", "detail"),
];

/// The building of a text.
fn building(text: &str) -> Value {
    let mut out = Diagnostics::new();
    let source = Source::new(FileId(0), "default.hsd", text.as_bytes());
    let made = hsd::compile(&[&source], &NoFiles, &hsd::Options::default(), &mut out);
    assert!(!out.has_errors(), "{text}: {out:?}");
    let mut value = serde_json::to_value(&made.building).expect("buildings are plain data");
    without_places(&mut value);
    value
}

/// What is built counts; where it is written, and whether, does not.
fn without_places(value: &mut Value) {
    match value {
        Value::Object(map) => {
            for key in ["span", "placed", "wished", "plain_ridge"] {
                map.remove(key);
            }
            map.values_mut().for_each(without_places);
        }
        Value::Array(list) => list.iter_mut().for_each(without_places),
        _ => {}
    }
}

#[test]
fn defaults_are_what_holds_without_them() {
    let mut wrong = vec![];
    for element in model::elements() {
        let host = HOSTS
            .iter()
            .find(|(names, _)| names.contains(&element.name));
        for attribute_schema in element.attributes.iter().filter(|a| !a.default.is_empty()) {
            let Some((_, text)) = host else {
                let known = EXCEPTIONS.contains(&(element.name, attribute_schema.name));
                assert!(
                    known,
                    "no text with a {} {}",
                    element.name, attribute_schema.name
                );
                continue;
            };
            let tag = format!("<{}", element.name);
            let at = text
                .find(&format!("{tag}>"))
                .or_else(|| text.find(&format!("{tag}/")));
            let at = at
                .or_else(|| text.find(&format!("{tag} ")))
                .expect("it is there")
                + tag.len();
            let said = format!(
                " {}=\"{}\"",
                attribute_schema.name, attribute_schema.default
            );
            // Blanks in its place, so that all places in the text are the same.
            let with = |words: &str| building(&format!("{}{words}{}", &text[..at], &text[at..]));
            if with(&said) != with(&" ".repeat(said.len())) {
                wrong.push(format!(
                    "{} {}={}",
                    element.name, attribute_schema.name, attribute_schema.default
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}
