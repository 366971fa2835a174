//! The schema in the W3C's language. It says a little less than the other: that a `code` is needed is not in it, since
//! `texturecode` may stand for that, and unknown names in other name spaces are let through.

use crate::schema::model::{self, Place, escape};
use hsd::parse::schema::{AttributeSchema, Schema};
use std::fmt::Write;

const HEAD: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<!-- XML Schema of the XML form of house texts (.hsd). Made by tests/schema from the tables of the reader: do not edit.
     An expression {...} may stand in every value. Where hsd.rng is understood it is the better one: it knows which
     elements need a code. -->
<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema" elementFormDefault="unqualified">
"#;

/// The schema.
pub fn make() -> String {
    let mut out = HEAD.to_owned();
    for root in model::roots() {
        let name = root.name;
        let _ = writeln!(out, "  <xs:element name=\"{name}\" type=\"{name}\"/>");
    }
    let places = model::places();
    for place in &places {
        group(&mut out, place);
    }
    let mut done: Vec<String> = vec![];
    for place in &places {
        let param = model::elements().filter(|e| e.name == "Param");
        let inner = place.elements.iter().copied();
        for element in inner
            .chain([model::otherwise(), model::choice()])
            .chain(param)
            .chain(model::roots())
        {
            let name = model::type_name(element, place);
            if !done.contains(&name) {
                one(&mut out, &name, element, place, &places);
                done.push(name);
            }
        }
    }
    values(&mut out);
    out.push_str("</xs:schema>\n");
    out
}

/// What may stand in a place, once.
fn group(out: &mut String, place: &Place) {
    let _ = writeln!(
        out,
        "\n  <xs:group name=\"in.{}\">\n    <xs:choice>",
        place.name
    );
    for element in place.elements.iter().filter(|e| e.name != "random") {
        let kind = model::type_name(element, place);
        let one = format!("<xs:element name=\"{}\" type=\"{kind}\"/>", element.name);
        if element.name == "if" {
            let other = model::type_name(model::otherwise(), place);
            let _ = writeln!(
                out,
                "      <xs:sequence>\n        {one}\n        <xs:element name=\"else\" type=\"{other}\" minOccurs=\"0\" maxOccurs=\"unbounded\"/>\n      </xs:sequence>"
            );
        } else {
            let _ = writeln!(out, "      {one}");
        }
    }
    let kind = format!("random.{}", place.name);
    let _ = writeln!(
        out,
        "      <xs:element name=\"random\" type=\"{kind}\"/>\n    </xs:choice>\n  </xs:group>"
    );
    random(out, &kind, place);
}

/// The type of a `random`: of codes, or of choices.
fn random(out: &mut String, kind: &str, place: &Place) {
    let _ = writeln!(out, "\n  <xs:complexType name=\"{kind}\">");
    let choice = model::type_name(model::choice(), place);
    let _ = writeln!(
        out,
        "    <xs:sequence>\n      <xs:element name=\"choice\" type=\"{choice}\" minOccurs=\"0\" maxOccurs=\"unbounded\"/>\n    </xs:sequence>"
    );
    let element = model::elements().find(|e| e.name == "random");
    for attribute_schema in element.expect("the language has draws").attributes {
        attribute(out, attribute_schema);
    }
    let _ = writeln!(
        out,
        "    <xs:anyAttribute namespace=\"##other\" processContents=\"skip\"/>\n  </xs:complexType>"
    );
}

/// The type of an element.
fn one(out: &mut String, name: &str, element: &Schema, place: &Place, places: &[Place]) {
    let inside = model::inside(element, place);
    let text = places.iter().any(|p| Some(p.name) == inside && p.text);
    let mixed = if text { " mixed=\"true\"" } else { "" };
    let _ = writeln!(out, "\n  <xs:complexType name=\"{name}\"{mixed}>");
    documentation(out, element.en);
    if inside == Some(model::SHAPES) {
        // The elements of a part are the business of the catalogue.
        let any = r#"<xs:any processContents="skip" minOccurs="0" maxOccurs="unbounded"/>"#;
        let _ = writeln!(out, "    <xs:sequence>\n      {any}\n    </xs:sequence>");
    } else if let Some(inside) = inside {
        let _ = writeln!(
            out,
            "    <xs:choice minOccurs=\"0\" maxOccurs=\"unbounded\">\n      <xs:group ref=\"in.{inside}\"/>"
        );
        if element.takes_parameters() {
            let _ = writeln!(out, "      <xs:element name=\"Param\" type=\"Param\"/>");
        }
        let _ = writeln!(out, "    </xs:choice>");
    }
    for attribute_schema in element.attributes {
        attribute(out, attribute_schema);
    }
    let space = if element.takes_any_attribute() {
        "##any"
    } else {
        "##other"
    };
    let _ = writeln!(
        out,
        "    <xs:anyAttribute namespace=\"{space}\" processContents=\"skip\"/>\n  </xs:complexType>"
    );
}

fn documentation(out: &mut String, text: &str) {
    let text = escape(text);
    let _ = writeln!(
        out,
        "    <xs:annotation><xs:documentation>{text}</xs:documentation></xs:annotation>"
    );
}

fn attribute(out: &mut String, attribute_schema: &AttributeSchema) {
    let names: &[&str] = match attribute_schema.name {
        "code" => &["code", "texturecode"],
        _ => &[attribute_schema.name],
    };
    let needed = match attribute_schema.required && names.len() == 1 {
        true => " use=\"required\"",
        false => "",
    };
    for name in names {
        let kind = model::kind_name(attribute_schema);
        let _ = writeln!(
            out,
            "    <xs:attribute name=\"{name}\" type=\"{kind}\"{needed}>"
        );
        documentation(out, attribute_schema.en);
        let _ = writeln!(out, "    </xs:attribute>");
    }
}

/// What values may say.
fn values(out: &mut String) {
    let expression = escape(model::EXPRESSION);
    let _ = writeln!(
        out,
        "\n  <xs:simpleType name=\"expression\">\n    <xs:restriction base=\"xs:string\"><xs:pattern value=\"{expression}\"/></xs:restriction>\n  </xs:simpleType>"
    );
    for (name, attribute_schema) in model::kinds() {
        let kind = attribute_schema.kind;
        let _ = writeln!(
            out,
            "\n  <xs:simpleType name=\"{name}\">\n    <xs:union memberTypes=\"expression\">"
        );
        let mut member = |base: &str, facets: &str| {
            let _ = writeln!(
                out,
                "      <xs:simpleType><xs:restriction base=\"xs:{base}\">{facets}</xs:restriction></xs:simpleType>"
            );
        };
        if let Some((base, least, most)) = model::bounds(kind) {
            member(
                base,
                &format!("<xs:minInclusive value=\"{least}\"/><xs:maxInclusive value=\"{most}\"/>"),
            );
        }
        let words: String = model::words(kind)
            .iter()
            .map(|w| format!("<xs:enumeration value=\"{w}\"/>"))
            .collect();
        if !words.is_empty() {
            member("token", &words);
        }
        if let Some(p) = model::pattern(attribute_schema) {
            member("string", &format!("<xs:pattern value=\"{}\"/>", escape(&p)));
        }
        let _ = writeln!(out, "    </xs:union>\n  </xs:simpleType>");
    }
}
