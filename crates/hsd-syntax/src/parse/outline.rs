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
