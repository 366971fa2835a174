//! Formats a legacy file: codes in their five columns, fields of roof lines aligned, one blank line instead of several.
//!
//! Conventions, where the contract leaves a choice:
//! - the last code of a line loses its padding blanks, since editors remove them too; a control letter
//!   after it keeps them;
//! - a void is `.....`, wherever five blanks say it;
//! - fields of header lines stand one blank apart; numbers keep their spelling, but the height of a roof has a
//!   decimal;
//! - the fields of roof lines are in the columns of `docs/evidence.md` 6, numbers to the right; where one is too long, the
//!   column is as much wider in all roof lines of the house;
//! - blank lines stand where the author put them, one for several, none at both ends of the file.

use super::table::{Table, tables, words};
use crate::parse::legacy::parse_lines;
use crate::parse::syntax::LineKind;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::source::{Limits, Source};
use hsd_ir::ast::{CodeText, Document, Item, Piece, Row};

/// Number of columns of a code.
const CELL: usize = 5;

/// A visible void.
const VOID: &str = ".....";

/// Formats a source file without errors, with line feeds.
pub(super) fn format(source: &Source, limits: &Limits, document: &Document) -> String {
    let mut lines = vec![];
    let each = &mut |range, kind| lines.push((range, kind));
    parse_lines(source, limits, &mut Diagnostics::new(), each);
    let mut printer = Printer {
        text: String::with_capacity(source.text().len() + 64),
        gap: false,
        apart: false,
        section: None,
    };
    let mut rows = rows(document).peekable();
    let tables = tables(source.text(), &lines);
    let mut house = 0;
    for (range, kind) in &lines {
        let raw = source.text()[range.clone()].trim_end_matches(['\u{1a}']);
        match kind {
            LineKind::Blank => (printer.gap, printer.apart) = (true, true),
            LineKind::Comment => printer.line(*kind, |text| text.push_str(raw.trim())),
            LineKind::Separator => {
                printer.line(*kind, |text| text.push('%'));
                house += 1;
            }
            LineKind::Header => printer.line(*kind, |text| header(raw, text)),
            LineKind::Wall => {
                let here = |row: &&Row| source.text_range(row.span).start < range.end;
                let row = rows.next_if(here);
                printer.line(*kind, |text| wall(row, raw, text));
            }
            LineKind::Roof => printer.line(*kind, |text| {
                tables
                    .get(house)
                    .unwrap_or(&Table::default())
                    .line(raw, text)
            }),
        }
    }
    printer.text
}

/// Returns the lines of codes, in the order of the file.
fn rows(document: &Document) -> impl Iterator<Item = &Row> {
    let storeys = document.houses.iter().flat_map(|house| &house.storeys);
    let loops = storeys.filter_map(one).flat_map(|storey| &storey.loops);
    loops.flat_map(|walk| &walk.rows).filter_map(one)
}

/// Returns the item itself; the legacy form has no operations.
fn one<T>(item: &Item<T>) -> Option<&T> {
    match item {
        Item::One(thing) => Some(thing),
        _ => None,
    }
}

struct Printer {
    text: String,
    /// True if blank lines came since the last line.
    gap: bool,
    /// True if blank lines came since the last line that is not a comment.
    apart: bool,
    /// The kind of the last line that is not a comment.
    section: Option<LineKind>,
}

impl Printer {
    fn line(&mut self, kind: LineKind, write: impl FnOnce(&mut String)) {
        if kind != LineKind::Comment {
            let parts = matches!(kind, LineKind::Wall | LineKind::Roof);
            let begins = self.section.is_some_and(|before| before != kind);
            self.gap |= parts && begins && !self.apart;
            self.section = Some(kind);
            self.apart = false;
        }
        if self.gap && !self.text.is_empty() {
            self.text.push('\n');
        }
        self.gap = false;
        write(&mut self.text);
        // Codes end at their fifth column: the last may need its blanks.
        if kind != LineKind::Wall {
            let blank = |c: char| c != '\n' && c.is_whitespace();
            let end = self.text.trim_end_matches(blank).len();
            self.text.truncate(end);
        }
        self.text.push('\n');
    }
}

fn header(raw: &str, text: &mut String) {
    let raw = raw.trim();
    let key = raw.split_whitespace().next().unwrap_or_default();
    if key == "name" {
        // A name may contain any number of blanks.
        text.push_str("name ");
        text.push_str(raw[key.len()..].trim());
    } else {
        words(raw, text);
    }
}

fn wall(row: Option<&Row>, raw: &str, text: &mut String) {
    let turn = row.and_then(|row| row.turn.as_ref());
    let control = match turn {
        Some(turn) if turn.value < 0.0 => "L",
        Some(_) => "R",
        None if raw.trim_end().ends_with('^') => "^",
        None => "",
    };
    codes(row.into_iter().flat_map(codes_of), text, control);
}

/// Returns the codes of a line.
pub(super) fn codes_of(row: &Row) -> impl Iterator<Item = CodeText> {
    let pieces = row.pieces.iter().filter_map(one);
    pieces.filter_map(Piece::code).map(|code| code.value)
}

/// Writes codes, and a control letter after them.
pub(super) fn codes(list: impl Iterator<Item = CodeText>, text: &mut String, control: &str) {
    let start = text.len();
    for code in list {
        let code = code.as_str().trim_end_matches(' ');
        let before = text.len();
        text.push_str(if code.is_empty() { VOID } else { code });
        while text.len() - before < CELL {
            text.push(' ');
        }
    }
    if control.is_empty() {
        let end = text.trim_end_matches(' ').len().max(start);
        // One column alone would be taken for a mistake or a control letter.
        if (end - start) % CELL != 1 {
            text.truncate(end);
        }
    }
    text.push_str(control);
}
