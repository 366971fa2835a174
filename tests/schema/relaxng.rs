//! The RELAX NG schema.

use crate::schema::model::{self, Place, escape};
use hsd::parse::schema::{AttributeSchema, Schema};
use std::fmt::Write;

const HEAD: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<!-- RELAX NG schema of the XML form of house texts (.hsd). Made by tests/schema from the tables of the reader: do not edit.
     An expression {...} may stand in every value. -->
<grammar xmlns="http://relaxng.org/ns/structure/1.0"
         xmlns:a="http://relaxng.org/ns/compatibility/annotations/1.0"
         datatypeLibrary="http://www.w3.org/2001/XMLSchema-datatypes">
"#;

/// Attributes of other programs: name spaces, schema locations, xml:lang.
const FOREIGN: &str = r#"
  <define name="foreign">
    <zeroOrMore>
      <attribute><anyName><except><nsName ns=""/></except></anyName><text/></attribute>
    </zeroOrMore>
  </define>
"#;

/// The elements of a part, which are the business of the catalogue.
const SHAPES: &str = r#"
  <define name="in.shapes">
    <element>
      <anyName/>
      <zeroOrMore><attribute><anyName/><text/></attribute></zeroOrMore>
      <zeroOrMore><ref name="in.shapes"/></zeroOrMore>
    </element>
  </define>
"#;

/// The schema.
pub fn make() -> String {
    let mut out = HEAD.to_owned();
    let _ = writeln!(out, "  <start>\n    <choice>");
    for root in model::roots() {
        let _ = writeln!(out, "      <ref name=\"{}\"/>", root.name);
    }
    let _ = writeln!(out, "    </choice>\n  </start>");
    let places = model::places();
    let mut done: Vec<String> = vec![];
    for place in &places {
        content(&mut out, place);
    }
    let outside = places.last().cloned();
    let mut each = |element: &Schema, place: &Place, out: &mut String| {
        let name = model::type_name(element, place);
        if !done.contains(&name) {
            one(out, &name, element, place);
            done.push(name);
        }
    };
    for place in outside.iter().chain(&places) {
        let inner = place.elements.iter().copied();
        let param = model::elements().filter(|e| e.name == "Param");
        for element in inner
            .chain([model::otherwise(), model::choice()])
            .chain(param)
        {
            each(element, place, &mut out);
        }
        for root in model::roots() {
            each(root, place, &mut out);
        }
    }
    out.push_str(SHAPES);
    out.push_str(FOREIGN);
    values(&mut out);
    out.push_str("</grammar>\n");
    out
}

/// What may stand in a place.
fn content(out: &mut String, place: &Place) {
    let _ = writeln!(out, "\n  <define name=\"in.{}\">\n    <choice>", place.name);
    if place.text {
        let _ = writeln!(out, "      <text/>");
    }
    for element in &place.elements {
        let name = model::type_name(element, place);
        if element.name == "if" {
            let otherwise = model::type_name(model::otherwise(), place);
            let _ = writeln!(
                out,
                "      <group>\n        <ref name=\"{name}\"/>\n        <zeroOrMore><ref name=\"{otherwise}\"/></zeroOrMore>\n      </group>"
            );
        } else {
            let _ = writeln!(out, "      <ref name=\"{name}\"/>");
        }
    }
    let choices = format!("random.{}", place.name);
    let _ = writeln!(
        out,
        "      <ref name=\"{choices}\"/>\n    </choice>\n  </define>"
    );
    let choice = model::type_name(model::choice(), place);
    let _ = writeln!(
        out,
        "\n  <define name=\"{choices}\">\n    <element name=\"random\">\n      <ref name=\"foreign\"/>\n      <oneOrMore><ref name=\"{choice}\"/></oneOrMore>\n    </element>\n  </define>"
    );
}

/// An element.
fn one(out: &mut String, name: &str, element: &Schema, place: &Place) {
    let _ = writeln!(
        out,
        "\n  <define name=\"{name}\">\n    <element name=\"{}\">",
        element.name
    );
    let _ = writeln!(
        out,
        "      <a:documentation>{}</a:documentation>",
        escape(element.en)
    );
    for attribute_schema in element.attributes {
        attribute(out, attribute_schema);
    }
    if element.takes_any_attribute() {
        let own = element.attributes.iter();
        let own: String = own.map(|a| format!("<name>{}</name>", a.name)).collect();
        let any = format!("<anyName><except>{own}</except></anyName>");
        let _ = writeln!(
            out,
            "      <zeroOrMore><attribute>{any}<text/></attribute></zeroOrMore>"
        );
    } else {
        let _ = writeln!(out, "      <ref name=\"foreign\"/>");
    }
    match model::inside(element, place) {
        Some(inside) => {
            let _ = writeln!(out, "      <zeroOrMore>\n        <choice>");
            let _ = writeln!(out, "          <ref name=\"in.{inside}\"/>");
            if element.takes_parameters() {
                let _ = writeln!(out, "          <ref name=\"Param\"/>");
            }
            let _ = writeln!(out, "        </choice>\n      </zeroOrMore>");
        }
        None => {
            let _ = writeln!(out, "      <empty/>");
        }
    }
    let _ = writeln!(out, "    </element>\n  </define>");
}

fn attribute(out: &mut String, attribute_schema: &AttributeSchema) {
    let names: &[&str] = match attribute_schema.name {
        "code" => &["code", "texturecode"],
        _ => &[attribute_schema.name],
    };
    let (open, close) = match (attribute_schema.required, names.len()) {
        (true, 1) => ("", ""),
        (true, _) => ("<choice>", "</choice>"),
        (false, 1) => ("<optional>", "</optional>"),
        (false, _) => ("<optional><choice>", "</choice></optional>"),
    };
    let default = match attribute_schema.default {
        "" => String::new(),
        value => format!(" a:defaultValue=\"{}\"", escape(value)),
    };
    let _ = write!(out, "      {open}");
    for name in names {
        let kind = model::kind_name(attribute_schema);
        let doc = escape(attribute_schema.en);
        let _ = write!(
            out,
            "<attribute name=\"{name}\"{default}><a:documentation>{doc}</a:documentation><ref name=\"{kind}\"/></attribute>"
        );
    }
    let _ = writeln!(out, "{close}");
}

/// What values may say.
fn values(out: &mut String) {
    let pattern = |p: &str| {
        let p = escape(p);
        format!("<data type=\"string\"><param name=\"pattern\">{p}</param></data>")
    };
    let expression = pattern(model::EXPRESSION);
    let _ = writeln!(
        out,
        "\n  <define name=\"expression\">\n    {expression}\n  </define>"
    );
    for (name, attribute_schema) in model::kinds() {
        let kind = attribute_schema.kind;
        let _ = writeln!(out, "\n  <define name=\"{name}\">\n    <choice>");
        for word in model::words(kind) {
            let _ = writeln!(out, "      <value>{word}</value>");
        }
        if let Some((base, least, most)) = model::bounds(kind) {
            let _ = writeln!(
                out,
                "      <data type=\"{base}\"><param name=\"minInclusive\">{least}</param><param name=\"maxInclusive\">{most}</param></data>"
            );
        }
        if let Some(p) = model::pattern(attribute_schema) {
            let _ = writeln!(out, "      {}", pattern(&p));
        }
        let _ = writeln!(
            out,
            "      <ref name=\"expression\"/>\n    </choice>\n  </define>"
        );
    }
}
