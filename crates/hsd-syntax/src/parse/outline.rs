//! Builds the [`Outline`] of a source file of either form, however malformed.

use super::legacy;
use super::syntax::{LegacyLine, LineKind, Outline};
use super::xml;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::source::{Limits, Source};
use hsd_ir::ast::{Document, Item, Piece, Row};
use std::ops::Range;

/// Returns the outline of a source file of either form.
pub fn of(source: &Source, limits: &Limits) -> Outline {
    let text = source.text();
    if source.size() > limits.bytes || crate::parse::looks_binary(text) {
        return Outline::default();
    }
    match text.trim_start().chars().next() {
        None => Outline::default(),
        Some('<' | '＜') => xml::outline(source, 0, limits.nesting),
        Some(_) => of_lines(source, limits),
    }
}

/// Returns the outline of a legacy file, and of the XML file that may follow it.
fn of_lines(source: &Source, limits: &Limits) -> Outline {
    let mut lines = vec![];
    let mut out = Diagnostics::new();
    let document = legacy::parse_lines(source, limits, &mut out, &mut |range, kind| {
        lines.push(LegacyLine {
            range,
            kind,
            codes: vec![],
            turn: None,
        });
    });
    let rest = lines.last().map_or(0, |l: &LegacyLine| l.range.end);
    let behind = source.text()[rest..].trim_start();
    let mut outline = match behind.is_empty() {
        true => Outline::default(),
        false => xml::outline(source, source.text().len() - behind.len(), limits.nesting),
    };
    let comments = lines.iter().filter(|l| l.kind == LineKind::Comment);
    let comments: Vec<Range<usize>> = comments.map(|l| l.range.clone()).collect();
    outline.comments.splice(0..0, comments);
    for row in rows(&document) {
        let place = source.text_range(row.span);
        let line = lines.partition_point(|l| l.range.end < place.start);
        if let Some(line) = lines.get_mut(line).filter(|l| l.kind == LineKind::Wall) {
            fill(line, source, row);
        }
    }
    lines.iter_mut().for_each(|line| end(line, source.text()));
    outline.lines = lines;
    outline
}

fn fill(line: &mut LegacyLine, source: &Source, row: &Row) {
    for item in &row.pieces {
        if let Item::One(piece) = item
            && let Some(code) = piece.code()
        {
            line.codes.push(source.text_range(code.span));
        } else if let Item::One(Piece::Error(span)) = item {
            line.codes.push(source.text_range(*span));
        }
    }
    let turn = row.turn.as_ref().map(|t| source.text_range(t.span));
    line.turn = turn.filter(|t| !t.is_empty());
}

/// Removes the `^` that ends a storey, which is no turn of its row.
fn end(line: &mut LegacyLine, text: &str) {
    let written = text[line.range.clone()].trim_end();
    if line.kind == LineKind::Wall && line.turn.is_none() && written.ends_with('^') {
        let end = line.range.start + written.len();
        let free = line.codes.last().is_none_or(|c| c.end < end);
        line.turn = free.then_some(end - 1..end);
    }
}

/// Returns the rows of a legacy document, in the order of the file.
fn rows(document: &Document) -> impl Iterator<Item = &Row> {
    let storeys = document.houses.iter().flat_map(|h| &h.storeys);
    let loops = storeys.filter_map(one).flat_map(|s| &s.loops);
    loops.flat_map(|l| &l.rows).filter_map(one)
}

fn one<T>(item: &Item<T>) -> Option<&T> {
    match item {
        Item::One(thing) => Some(thing),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hsd_base::source::FileId;

    fn outline(text: &str) -> Outline {
        let source = Source::new(FileId(0), "家.hsd", text.as_bytes());
        of(&source, &Limits::default())
    }

    #[test]
    fn lines_have_codes_and_turns() {
        let text = "# 町家\n0 0 180\n9.0\n\nGSI  2TOD L\nKKS\n";
        let outline = outline(text);
        let kinds: Vec<LineKind> = outline.lines.iter().map(|l| l.kind).collect();
        use LineKind::{Blank, Comment, Header, Wall};
        assert_eq!(kinds, [Comment, Header, Header, Blank, Wall, Wall]);
        let wall = &outline.lines[4];
        let codes: Vec<&str> = wall.codes.iter().map(|c| &text[c.clone()]).collect();
        assert_eq!(codes, ["GSI  ", "2TOD "]);
        assert_eq!(wall.turn.clone().map(|t| &text[t]), Some("L"));
        assert_eq!(outline.comments.first(), Some(&(0..8)));
    }

    #[test]
    fn elements_have_places_even_in_broken_files() {
        let text = "<House name='家'><Storey><Row>KSK  {a + b}<!-- x --></Row><use name='&lt;{n}' w=\"{2 * d}\"";
        let outline = outline(text);
        let names: Vec<&str> = outline
            .elements
            .iter()
            .map(|e| &text[e.name.clone()])
            .collect();
        assert_eq!(names, ["House", "Storey", "Row", "use"]);
        let row = &outline.elements[2];
        assert_eq!(row.parent, Some(1));
        assert_eq!(row.end_name.clone().map(|n| &text[n]), Some("Row"));
        assert_eq!(&text[row.words[0].codes[0].clone()], "KSK  ");
        let names = &row.words[0].expressions[0].names;
        let names: Vec<&str> = names.iter().map(|n| &text[n.clone()]).collect();
        assert_eq!(names, ["a", "b"]);
        let used = &outline.elements[3];
        assert_eq!(used.value("name"), Some("<{n}"));
        let name = used.attribute("w").expect("is there").expressions[0].names[0].clone();
        assert_eq!(&text[name], "d");
        assert_eq!(outline.comments.len(), 1);
        assert_eq!(outline.element_at(row.words[0].range.start), Some(2));
    }
}
