//! Drawings as SVG: one user unit is one millimetre on paper, all coordinates are absolute and nothing is transformed.
//! Groups have `data-view` and `data-role`, bays and cut parts `data-code`; groups of bays and of a room's marks have what
//! `hsd plan` needs to write the house again (grammar/drawings.md).

use crate::dimension::short;
use crate::paper::{Anchor, Facts, Label, Mark, Role, Shape, Sheet, View};
use glam::DVec2;
use hsd_base::diagnostic::visible;
use std::fmt::Write;
use std::sync::Arc;

/// The fonts that texts ask for, the first that is there.
const FONTS: &str =
    "'Noto Sans CJK JP','Noto Sans JP','Hiragino Sans','Yu Gothic',Meiryo,sans-serif";

/// Returns a sheet as the text of an SVG file.
pub fn write(sheet: &Sheet) -> String {
    let (w, h) = (number(sheet.size.x), number(sheet.size.y));
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}mm\" height=\"{h}mm\" viewBox=\"0 0 {w} {h}\" \
         data-scale=\"{}\" font-family=\"{FONTS}\">\n<title>{}</title>\n<rect width=\"{w}\" height=\"{h}\" fill=\"#fff\"/>\n",
        sheet.scale,
        escaped(&sheet.title),
    );
    for view in &sheet.views {
        write_view(view, sheet.size.y, &mut out);
    }
    out + "</svg>\n"
}

/// Adds a view; marks of one role one after another that tell the same share a group.
fn write_view(view: &View, height: f64, out: &mut String) {
    let (name, title) = (escaped(&view.name), escaped(&view.title));
    let _ = writeln!(
        out,
        "<g data-view=\"{name}\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n<title>{title}</title>"
    );
    for marks in view.marks.chunk_by(is_of_group) {
        let role = marks[0].role;
        let facts = marks[0].facts.as_deref().map_or(String::new(), told);
        let (word, style) = (role.word(), style(role));
        let _ = writeln!(out, "<g data-role=\"{word}\"{facts}{style}>");
        for mark in marks {
            write_mark(mark, height, out);
        }
        out.push_str("</g>\n");
    }
    out.push_str("</g>\n");
}

fn is_of_group(a: &Mark, b: &Mark) -> bool {
    let same = match (&a.facts, &b.facts) {
        (Some(a), Some(b)) => Arc::ptr_eq(a, b),
        (None, None) => true,
        _ => false,
    };
    same && a.role == b.role
}

fn told(facts: &Facts) -> String {
    let one = |(name, value): &(&str, String)| format!(" data-{name}=\"{}\"", escaped(value));
    facts.iter().map(one).collect()
}

fn style(role: Role) -> String {
    let dashes: Vec<String> = role.dashes().iter().map(|d| number(*d)).collect();
    let dashes = match dashes.is_empty() {
        true => String::new(),
        false => format!(" stroke-dasharray=\"{}\"", dashes.join(" ")),
    };
    format!(
        " stroke=\"#000\" stroke-width=\"{}\" fill=\"{}\"{dashes}",
        number(role.pen()),
        grey(role.fill()),
    )
}

fn grey(share: f64) -> String {
    let byte = (share * 255.0).round() as u8;
    format!("#{byte:02x}{byte:02x}{byte:02x}")
}

fn write_mark(mark: &Mark, height: f64, out: &mut String) {
    let code = mark.code.as_deref();
    let code = code.map_or(String::new(), |c| format!(" data-code=\"{}\"", escaped(c)));
    let at = |p: &DVec2| format!("{} {}", number(p.x), number(height - p.y));
    let path = |rings: &[Vec<DVec2>]| -> String {
        let ring = |ring: &Vec<DVec2>| {
            let points: Vec<String> = ring.iter().map(at).collect();
            format!("M{}Z", points.join("L"))
        };
        rings.iter().map(ring).collect()
    };
    let _ = match &mark.shape {
        Shape::Lines(lines) => {
            let one = |[p, q]: &[DVec2; 2]| format!("M{}L{}", at(p), at(q));
            let d: String = lines.iter().map(one).collect();
            writeln!(out, "<path fill=\"none\"{code} d=\"{d}\"/>")
        }
        Shape::Area(rings) => writeln!(out, "<path{code} d=\"{}\"/>", path(rings)),
        Shape::Letters(rings) => writeln!(
            out,
            "<path stroke=\"none\" fill=\"#000\" fill-rule=\"evenodd\" d=\"{}\"/>",
            path(rings)
        ),
        Shape::Label(label) => write_label(label, height, out),
    };
}

fn write_label(label: &Label, height: f64, out: &mut String) -> std::fmt::Result {
    let (text, size) = (escaped(&label.text), number(label.size));
    let (x, y) = (label.at.x, height - label.at.y);
    let anchor = match label.anchor {
        Anchor::Start => "start",
        Anchor::Middle => "middle",
        Anchor::End => "end",
    };
    if !label.upward {
        return writeln!(
            out,
            "<text x=\"{}\" y=\"{}\" font-size=\"{size}\" text-anchor=\"{anchor}\" stroke=\"none\" fill=\"#000\">{text}</text>",
            number(x),
            number(y),
        );
    }
    // Each letter has a place of its own and is turned there, so that nothing is transformed.
    let mut along = match label.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => -super::paper::width(&label.text) * label.size / 2.0,
        Anchor::End => -super::paper::width(&label.text) * label.size,
    };
    let mut ys = vec![];
    for letter in label.text.chars() {
        ys.push(number(y - along));
        along += super::paper::width(letter.encode_utf8(&mut [0; 4])) * label.size;
    }
    let xs = vec![number(x); ys.len()];
    writeln!(
        out,
        "<text x=\"{}\" y=\"{}\" rotate=\"-90\" font-size=\"{size}\" stroke=\"none\" fill=\"#000\">{text}</text>",
        xs.join(" "),
        ys.join(" "),
    )
}

/// Writes millimetres to the micrometre.
fn number(value: f64) -> String {
    short(value, 3)
}

/// Returns a text as it stands in XML; control characters as signs that show them.
fn escaped(text: &str) -> String {
    let text = visible::line(text);
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c => out.push(c),
        }
    }
    out
}
