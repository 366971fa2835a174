//! Drawings as DXF, release 12, which every CAD program reads: a layer for each role, in millimetres of the house, so that
//! what is measured is true. Areas are closed polylines; kanji are written as `\U+XXXX`, since the release knows no Unicode.

use crate::dimension::short;
use crate::paper::{Anchor, Label, Mark, Role, Shape, Sheet};
use glam::DVec2;
use hsd_base::diagnostic::visible;
use std::fmt::Write;

/// A group: its code and its value.
fn group(code: u32, value: impl std::fmt::Display, out: &mut String) {
    let _ = writeln!(out, "{code}\n{value}");
}

/// Returns a sheet as the text of a DXF file.
pub fn write(sheet: &Sheet) -> String {
    let mut out = String::new();
    let scale = f64::from(sheet.scale);
    head(sheet.size * scale, &mut out);
    layers(&mut out);
    section("ENTITIES", &mut out);
    for mark in sheet.views.iter().flat_map(|v| &v.marks) {
        entity(mark, scale, &mut out);
    }
    group(0, "ENDSEC", &mut out);
    group(0, "EOF", &mut out);
    out
}

fn section(name: &str, out: &mut String) {
    group(0, "SECTION", out);
    group(2, name, out);
}

fn head(size: DVec2, out: &mut String) {
    section("HEADER", out);
    group(9, "$ACADVER", out);
    group(1, "AC1009", out);
    for (name, at) in [("$EXTMIN", DVec2::ZERO), ("$EXTMAX", size)] {
        group(9, name, out);
        point(0, at, out);
    }
    group(0, "ENDSEC", out);
}

/// The tables of line types and layers.
fn layers(out: &mut String) {
    section("TABLES", out);
    group(0, "TABLE", out);
    group(2, "LTYPE", out);
    let dashed: Vec<Role> = Role::ALL
        .into_iter()
        .filter(|r| !r.dashes().is_empty())
        .collect();
    group(70, dashed.len() + 1, out);
    line_type("CONTINUOUS", "Solid line", &[], out);
    for role in dashed {
        line_type(&layer(role), role.word(), role.dashes(), out);
    }
    group(0, "ENDTAB", out);
    group(0, "TABLE", out);
    group(2, "LAYER", out);
    group(70, Role::ALL.len(), out);
    for role in Role::ALL {
        group(0, "LAYER", out);
        group(2, layer(role), out);
        group(70, 0, out);
        // White or black, whichever the background is not; fine lines are grey.
        group(62, if role.pen() < 0.15 { 8 } else { 7 }, out);
        let kind = match role.dashes().is_empty() {
            true => "CONTINUOUS".to_owned(),
            false => layer(role),
        };
        group(6, kind, out);
    }
    group(0, "ENDTAB", out);
    group(0, "ENDSEC", out);
}

/// A line type of dashes and gaps, millimetres on paper.
fn line_type(name: &str, words: &str, dashes: &[f64], out: &mut String) {
    group(0, "LTYPE", out);
    group(2, name, out);
    group(70, 0, out);
    group(3, words, out);
    group(72, 65, out);
    group(73, dashes.len(), out);
    group(40, short(dashes.iter().sum(), 3), out);
    for (dash, sign) in dashes.iter().zip([1.0, -1.0].into_iter().cycle()) {
        group(49, short(dash * sign, 3), out);
    }
}

fn layer(role: Role) -> String {
    role.word().to_uppercase()
}

/// A point; `place` is 0 for the first of an entity, 1 for the second.
fn point(place: u32, at: DVec2, out: &mut String) {
    group(10 + place, short(at.x, 4), out);
    group(20 + place, short(at.y, 4), out);
    group(30 + place, 0, out);
}

fn entity(mark: &Mark, scale: f64, out: &mut String) {
    let begin = |name: &str, out: &mut String| {
        group(0, name, out);
        group(8, layer(mark.role), out);
    };
    match &mark.shape {
        Shape::Lines(lines) => {
            // Parts without width are told in SVG alone.
            for [p, q] in lines.iter().filter(|[p, q]| p != q) {
                begin("LINE", out);
                point(0, *p * scale, out);
                point(1, *q * scale, out);
            }
        }
        Shape::Area(rings) | Shape::Letters(rings) => {
            for ring in rings {
                begin("POLYLINE", out);
                group(66, 1, out);
                group(70, 1, out);
                point(0, DVec2::ZERO, out);
                for corner in ring {
                    begin("VERTEX", out);
                    point(0, *corner * scale, out);
                }
                begin("SEQEND", out);
            }
        }
        Shape::Label(label) => {
            begin("TEXT", out);
            write_label(label, scale, out);
        }
    }
}

fn write_label(label: &Label, scale: f64, out: &mut String) {
    let at = label.at * scale;
    point(0, at, out);
    // Capitals are as high as kanji are wide by seven tenths.
    group(40, short(label.size * 0.75 * scale, 4), out);
    group(1, coded(&label.text), out);
    if label.upward {
        group(50, 90, out);
    }
    let anchor = match label.anchor {
        Anchor::Start => return,
        Anchor::Middle => 1,
        Anchor::End => 2,
    };
    group(72, anchor, out);
    point(1, at, out);
}

/// Returns a text in ASCII.
fn coded(text: &str) -> String {
    let mut out = String::new();
    for unit in visible::line(text).encode_utf16() {
        match u8::try_from(unit) {
            Ok(byte) if byte.is_ascii() => out.push(char::from(byte)),
            _ => {
                let _ = write!(out, "\\U+{unit:04X}");
            }
        }
    }
    out
}
