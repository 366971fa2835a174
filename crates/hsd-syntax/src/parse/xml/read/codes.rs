//! Runs of text as codes of five columns (docs/contract.md 3, "Codes").
//!
//! A run is the text between two children. Line breaks and the white space around them are removed; each line is split
//! into fives independently and its last code padded, since the blanks that end a code before a line break are removed
//! with it. Blanks at the start of a run on the line of its tag are columns. Runs of white space alone are not passed
//! in. Codes that have left their columns are read by their words, as in the legacy form.

use crate::messages::legacy::{Slip, SlippedTurn, out_of_step};
use crate::parse::columns::{CELL, Cell, Form};
use crate::parse::xml::read::Reader;
use crate::parse::xml::suggest::narrow_ascii;
use crate::parse::xml::tree::chars::is_blank;
use crate::parse::xml::tree::text::{REPORTED, Text};
use hsd_base::source::Spanned;
use hsd_ir::ast::{CodeText, Item, Piece};
use hsd_ir::messages::xml as say;
use std::ops::Range;

/// A column: its content, and its range of the text. `None` = an error was reported.
struct Column {
    byte: Option<u8>,
    range: Range<usize>,
}

impl Reader<'_, '_> {
    /// Splits a run into parts. A control letter at the end of a line is reported and returned as the turn it means;
    /// `turns` = the row has a `turn` to name.
    pub(in crate::parse::xml) fn codes(
        &mut self,
        text: &Text<'_>,
        turns: bool,
        parts: &mut Vec<Item<Piece>>,
    ) -> Option<Spanned<f64>> {
        let whole = text.as_str();
        let mut turn = None;
        let mut start = 0;
        while start <= whole.len() {
            let end = whole[start..]
                .find(['\n', '\r'])
                .map_or(whole.len(), |i| start + i);
            let (mut from, mut to) = (start, end);
            if start > 0 {
                from = end - whole[start..end].trim_start_matches(is_blank).len();
            }
            if end < whole.len() {
                to = from + whole[from..end].trim_end_matches(is_blank).len();
            }
            if from < to {
                let line = self.columns(text, from..to);
                turn = self.cut(text, &line, turns, parts).or(turn);
            }
            start = end + 1;
        }
        turn
    }

    /// Returns the columns of a line; invalid characters are reported and replaced by their fix.
    fn columns(&mut self, text: &Text<'_>, range: Range<usize>) -> Vec<Column> {
        let whole = text.as_str();
        let mut line = vec![];
        let mut at = range.start;
        while let Some(c) = whole[at..range.end].chars().next() {
            let here = at..at + c.len_utf8();
            at = here.end;
            match c {
                ' '..='~' => push(&mut line, Some(c as u8), here),
                _ => {
                    at = here.start + same_kind(&whole[here.start..range.end]);
                    self.odd(text, here.start..at, &mut line);
                }
            }
        }
        line
    }

    /// Reports characters that are not columns.
    fn odd(&mut self, text: &Text<'_>, range: Range<usize>, line: &mut Vec<Column>) {
        let quoted = &text.as_str()[range.clone()];
        let place = text.range(range.clone());
        match quoted.chars().next() {
            Some('\t') => {
                // To the end of the current code; each further tab is a void.
                let from = line.len();
                let blanks = 5 * quoted.len() - from % 5;
                self.reporter
                    .at(&place, |s| say::tab_in_codes(s, from + 1, blanks));
                for _ in 0..blanks {
                    push(line, Some(b' '), range.clone());
                }
            }
            Some(REPORTED) => {}
            _ => self
                .reporter
                .at(&place, |s| say::not_a_column(s, quoted, &plain(quoted))),
        }
        if quoted.starts_with('\t') {
            return;
        }
        for (i, c) in quoted.char_indices() {
            let here = range.start + i..range.start + i + c.len_utf8();
            let byte = narrow_ascii(c).map(|c| c as u8);
            // A full-width blank is as wide as two columns.
            if c == '\u{3000}' {
                push(line, byte, here.clone());
            }
            push(line, byte, here);
        }
    }

    /// Splits a line into parts.
    fn cut(
        &mut self,
        text: &Text<'_>,
        line: &[Column],
        turns: bool,
        parts: &mut Vec<Item<Piece>>,
    ) -> Option<Spanned<f64>> {
        let last = line.chunks(CELL).next_back();
        let control = last.and_then(|code| match code {
            [only] => only.byte.filter(|b| matches!(b, b'L' | b'R' | b'^')),
            _ => None,
        });
        // A letter after codes that have left their columns is in none either.
        let loose = loose_letter(line).filter(|_| control.is_none());
        let turn = |at: usize| Some((line[at].byte?, text.range(line[at].range.clone())));
        let read = loose.and_then(|at| {
            let turn = turn(at).filter(|_| turns);
            Some((self.in_step(text, &line[..at], turn)?, at))
        });
        let is_told = read.is_some() && turns;
        let (meant, codes) = match read {
            Some((meant, at)) => (Some(meant), at),
            None => {
                let codes = line.len() - usize::from(control.is_some());
                (self.in_step(text, &line[..codes], None), codes)
            }
        };
        let (codes, end) = line.split_at(codes);
        match meant {
            Some(meant) => parts.extend(meant),
            None => parts.extend(codes.chunks(CELL).filter_map(|code| self.code(text, code))),
        }
        let control = control.or_else(|| end.first()?.byte);
        let (letter, place) = (control?, text.range(end[0].range.clone()));
        if !is_told {
            let bear = self.turn.filter(|_| turns);
            let bear = bear.map(|at| self.reporter.span(&(at..at)));
            self.reporter.at(&place, |s| {
                say::control_letter(s, letter as char, turns, bear)
            });
        }
        let degrees = if letter == b'L' { -90.0 } else { 90.0 };
        (letter != b'^').then(|| Spanned::new(degrees, self.reporter.span(&place)))
    }

    /// Reports a line whose codes are not in their columns, with the turn letter after them and its place, and returns the
    /// codes that its words mean.
    fn in_step(
        &mut self,
        text: &Text<'_>,
        line: &[Column],
        turn: Option<(u8, Range<usize>)>,
    ) -> Option<Vec<Item<Piece>>> {
        let bytes = line.iter().map(|c| c.byte.map(char::from));
        let written: String = bytes.collect::<Option<_>>()?;
        let mut form = Form::default();
        for at in (0..written.len()).step_by(CELL) {
            let cell = &written[at..];
            // Blanks after the last code are no void.
            form.see(cell.get(..CELL).unwrap_or(cell.trim_end_matches(' ')));
        }
        let cells = form.in_step(&written, 0)?;
        let place = |range: Range<usize>| {
            let last = range.end.max(range.start + 1).min(line.len()) - 1;
            text.range(line[range.start.min(last)].range.start..line[last].range.end)
        };
        let off = |c: &&Cell<'_>| !c.range.start.is_multiple_of(CELL);
        let slip = cells.iter().find(off).map_or(0, |c| c.range.start);
        let end = written.trim_end_matches(' ').len();
        let turn = turn.map(|(letter, place)| SlippedTurn {
            letter: letter as char,
            span: self.reporter.span(&place),
            attribute: self.turn.map(|at| self.reporter.span(&(at..at))),
        });
        let meant: String = cells.iter().map(|c| format!("{:5}", c.meant())).collect();
        let meant = meant.trim_end();
        let all = self.reporter.span(&place(0..end));
        self.reporter.at(&place(slip..end), |span| {
            let fix = (all, meant.to_owned());
            let column = slip + 1;
            let slip = Slip {
                span,
                column,
                fix,
                turn,
            };
            out_of_step(slip, vec![])
        });
        let pieces = cells.iter().map(|cell| {
            let span = self.reporter.span(&place(cell.range.clone()));
            Item::One(Piece::new(CodeText::new(&cell.meant()), span))
        });
        Some(pieces.collect())
    }

    /// Returns the part of up to five columns; a remainder of blanks is none.
    fn code(&mut self, text: &Text<'_>, columns: &[Column]) -> Option<Item<Piece>> {
        let blank = columns.iter().all(|c| c.byte == Some(b' '));
        if columns.len() < CELL && blank {
            return None;
        }
        let mut five = [b' '; CELL];
        // A code with an error becomes a void, so that the row keeps its length.
        if columns.iter().all(|c| c.byte.is_some()) {
            for (place, column) in five.iter_mut().zip(columns) {
                *place = column.byte.unwrap_or(b' ');
            }
        }
        let range = columns.first()?.range.start..columns.last()?.range.end;
        let span = self.reporter.span(&text.range(range));
        Some(Item::One(Piece::Code(five, span)))
    }
}

/// Returns the place of a turn letter at the end of a line that a blank divides from the codes.
fn loose_letter(line: &[Column]) -> Option<usize> {
    let at = line.iter().rposition(|c| c.byte != Some(b' '))?;
    let letter = matches!(line[at].byte, Some(b'L' | b'R'));
    let apart = at > 0 && line[at - 1].byte == Some(b' ');
    (letter && apart).then_some(at)
}

fn push(line: &mut Vec<Column>, byte: Option<u8>, range: Range<usize>) {
    line.push(Column { byte, range });
}

/// Returns the length of the characters at the start of a string that one message can name together.
fn same_kind(text: &str) -> usize {
    let kind = |c: char| match c {
        ' '..='~' => 0,
        '\t' => 1,
        REPORTED => 2,
        '\u{3000}' => 3,
        c if narrow_ascii(c).is_some() => 4,
        _ => 5,
    };
    let first = text.chars().next().map_or(0, kind);
    text.find(|c| kind(c) != first).unwrap_or(text.len())
}

/// Returns the fix of full-width characters; empty if there is none.
fn plain(text: &str) -> String {
    text.chars()
        .filter_map(narrow_ascii)
        .map(|c| {
            if c == ' ' {
                "  ".to_owned()
            } else {
                c.to_string()
            }
        })
        .collect()
}
