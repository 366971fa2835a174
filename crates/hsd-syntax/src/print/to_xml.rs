//! A legacy file as XML: a row for each line, a storey for each `^`, attributes for the header, `Roof`s for the roof
//! lines. Numbers keep their spelling, comments keep their order.

use super::{encode, legacy, xml};
use crate::messages::print as say;
use crate::parse::legacy::parse_lines;
use crate::parse::syntax::LineKind;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::source::{Limits, Source, Span};
use hsd_ir::ast::{Document, House, Item, Loop, RoofLine, RoofStyle, Row};
use std::fmt::Write;
use std::ops::Range;

/// Writes a legacy file without errors as XML, with its line ends.
///
/// # Errors `None` if XML cannot express something; `out` receives the reason.
pub fn to_xml(source: &Source, limits: &Limits, out: &mut Diagnostics) -> Option<String> {
    let mut comments = vec![];
    let each = &mut |range: Range<usize>, kind| {
        if kind == LineKind::Comment {
            comments.push(range);
        }
    };
    let document = parse_lines(source, limits, &mut Diagnostics::new(), each);
    let mut writer = XmlWriter {
        source,
        text: declaration(source),
        comments: comments.into_iter().peekable(),
        out,
        sound: true,
    };
    writer.document(&document);
    let XmlWriter { text, sound, .. } = writer;
    let end = super::line_end(source.text());
    sound.then(|| xml::format(&text, end)).flatten()
}

/// Other programs read a file without a declaration as UTF-8.
fn declaration(source: &Source) -> String {
    match encode::label(source) {
        "UTF-8" => String::new(),
        name => format!("<?xml version=\"1.0\" encoding=\"{name}\"?>\n"),
    }
}

struct XmlWriter<'s, C: Iterator<Item = Range<usize>>> {
    source: &'s Source,
    text: String,
    /// The remaining comments.
    comments: std::iter::Peekable<C>,
    out: &'s mut Diagnostics,
    sound: bool,
}

impl<C: Iterator<Item = Range<usize>>> XmlWriter<'_, C> {
    fn document(&mut self, document: &Document) {
        let several = document.houses.len() != 1;
        if several {
            self.comments_before(document.houses.first().map(|h| h.span));
            self.text.push_str("<Houses>\n");
        }
        for house in &document.houses {
            self.comments_before(Some(house.span));
            self.house(house);
        }
        self.comments_before(None);
        if several {
            self.text.push_str("</Houses>\n");
        }
    }

    fn house(&mut self, house: &House) {
        let settings = &house.settings;
        self.text.push_str("<House");
        self.attribute("name", house.name.as_ref().map(|n| n.span));
        for (name, value, usual) in [
            ("x", &settings.x, 0.0),
            ("y", &settings.y, 0.0),
            ("azimuth", &settings.azimuth, 180.0),
            ("unit", &settings.unit, 3.0),
        ] {
            let told = value.as_ref().filter(|v| v.value != usual);
            self.attribute(name, told.map(|v| v.span));
        }
        self.attribute("seed", settings.seed.as_ref().map(|s| s.span));
        self.attribute("street", settings.street.as_ref().map(|s| s.span));
        self.attribute("age", settings.age.as_ref().map(|s| s.span));
        self.attribute("era", settings.era.as_ref().map(|s| s.span));
        self.text.push_str(">\n");
        for (index, storey) in house.storeys.iter().enumerate() {
            let Item::One(storey) = storey else { continue };
            self.comments_before(Some(storey.span));
            self.text.push_str("<Storey");
            self.attribute("height", house.heights.get(index).map(|h| h.span));
            self.text.push_str(">\n");
            storey.loops.iter().for_each(|walk| self.rows(walk));
            self.text.push_str("</Storey>\n");
        }
        self.roofs(house);
        self.text.push_str("</House>\n");
    }

    fn rows(&mut self, walk: &Loop) {
        for row in &walk.rows {
            if let Item::One(row) = row {
                self.comments_before(Some(row.span));
                self.row(row);
            }
        }
    }

    fn row(&mut self, row: &Row) {
        self.text.push_str("<Row");
        if let Some(turn) = &row.turn {
            let letter = if turn.value < 0.0 { "L" } else { "R" };
            let _ = write!(self.text, " turn=\"{letter}\"");
        }
        self.text.push('>');
        let mut codes = String::new();
        legacy::codes(legacy::codes_of(row), &mut codes, "");
        self.no_braces(&codes, row.span);
        escape(&codes, &mut self.text);
        self.text.push_str("</Row>\n");
    }

    fn roofs(&mut self, house: &House) {
        let roofs = &house.roofs;
        let (mode, method) = (roofs.mode.as_ref(), roofs.method.as_ref());
        if mode.is_none() && method.is_none() && roofs.lines.is_empty() {
            return;
        }
        if let Some(first) = roofs.lines.first() {
            self.comments_before(Some(first.span));
        }
        self.text.push_str("<Roofs");
        self.attribute("mode", mode.map(|m| m.span));
        self.attribute("method", method.map(|m| m.span));
        self.text.push_str(">\n");
        for line in &roofs.lines {
            self.comments_before(Some(line.span));
            self.roof(line);
        }
        self.text.push_str("</Roofs>\n");
    }

    fn roof(&mut self, line: &RoofLine) {
        self.text.push_str("<Roof");
        let style = &line.style;
        let letters = [
            ("kind", style.kind.as_ref().map(|k| k.span)),
            ("ridge", line.direction.as_ref().map(|d| d.span)),
            ("shape", style.shape.as_ref().map(|s| s.span)),
        ];
        for (name, span) in letters {
            let word = span.map(|span| self.spelled(span).to_ascii_uppercase());
            self.value(name, word);
        }
        self.attribute("height", line.height.as_ref().map(|h| h.span));
        let corners = self.spelled(line.corners.span).to_owned();
        for (name, corner) in ["a0", "b0", "a1", "b1"]
            .iter()
            .zip(corners.split_whitespace())
        {
            self.value(name, Some(corner.to_owned()));
        }
        self.options(style);
        self.text.push_str("/>\n");
    }

    fn options(&mut self, style: &RoofStyle) {
        let numbers = [
            ("pitch", &style.pitch),
            ("eaves", &style.eaves),
            ("verge", &style.verge),
            ("thickness", &style.thickness),
            ("sori", &style.sori),
            ("gable", &style.gable),
            ("ratio", &style.ratio),
        ];
        for (name, number) in numbers {
            let number = number.as_ref().map(|n| {
                let word = self.spelled(n.span);
                word.trim_start_matches(|c: char| c.is_alphabetic())
                    .to_owned()
            });
            self.value(name, number);
        }
        let noshi = style.noshi.as_ref().map(|n| n.value.to_string());
        self.value("noshi", noshi);
        let plain = style.plain_ridge.as_ref().map(|_| "yes".to_owned());
        self.value("plain_ridge", plain);
    }

    /// Returns the source text.
    fn spelled(&self, span: Span) -> &str {
        &self.source.text()[self.source.text_range(span)]
    }

    fn attribute(&mut self, name: &str, span: Option<Span>) {
        let value = span.map(|span| self.spelled(span).to_owned());
        if let (Some(span), Some(value)) = (span, &value) {
            self.no_braces(value, span);
        }
        self.value(name, value);
    }

    fn value(&mut self, name: &str, value: Option<String>) {
        let Some(value) = value else { return };
        let _ = write!(self.text, " {name}=\"");
        escape(&value, &mut self.text);
        self.text.push('"');
    }

    /// Braces hold expressions in XML.
    fn no_braces(&mut self, text: &str, span: Span) {
        if text.contains(['{', '}']) {
            self.sound = false;
            self.out.push(say::braces(span));
        }
    }

    /// Writes the comments before a place, or all remaining ones; adjacent ones become one.
    fn comments_before(&mut self, place: Option<Span>) {
        let end = place.map_or(usize::MAX, |span| self.source.text_range(span).start);
        let mut before: Option<usize> = None;
        while let Some(range) = self.comments.next_if(|range| range.start < end) {
            let gap = before.map(|b| &self.source.text()[b..range.start]);
            let joined = gap.is_some_and(|g| matches!(g, "\n" | "\r\n" | "\r"));
            match (joined, gap) {
                (true, _) => self.text.push_str("\n     "),
                (false, Some(_)) => self.text.push_str(" -->\n\n<!-- "),
                (false, None) => self.text.push_str("<!-- "),
            }
            let line = self.source.text()[range.clone()].trim();
            let line = line.strip_prefix('#').unwrap_or(line);
            comment(line.strip_prefix(' ').unwrap_or(line), &mut self.text);
            before = Some(range.end);
        }
        if before.is_some() {
            self.text.push_str(" -->\n");
        }
    }
}

fn escape(text: &str, out: &mut String) {
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c => out.push(c),
        }
    }
}

/// Writes a comment; those of XML contain no two dashes in a row and no control characters.
fn comment(text: &str, out: &mut String) {
    for c in text.chars() {
        if c == '-' && out.ends_with('-') {
            out.push(' ');
        }
        out.push(if c.is_control() { ' ' } else { c });
    }
}
