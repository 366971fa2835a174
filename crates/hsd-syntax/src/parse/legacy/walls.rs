//! The perimeter: one wall per line, storeys closed by `^`.

use super::cells::{columns, pieces};
use super::line::{CELL, SourceLine};
use super::words::say_comment;
use crate::messages::legacy as say;
use crate::parse::reporter::Reporter;
use hsd_base::diagnostic::{Diagnostic, Edit};
use hsd_base::source::{Span, Spanned};
use hsd_ir::ast::{Item, Loop, Row, Storey};
use std::ops::Range;

/// The control at a line's end, in addition to the right turn implied by every line end.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Control {
    Left,
    Right,
    NextStorey,
}

/// The storeys as read so far.
#[derive(Default)]
pub(super) struct Walls {
    storeys: Vec<Item<Storey>>,
    rows: Vec<Item<Row>>,
    /// From the first row of the current storey to its last.
    span: Option<Span>,
    /// The last `^`, if nothing has followed it.
    reset: Option<Span>,
    /// The lines whose codes are not in their columns.
    slips: Vec<say::Slip>,
}

impl Walls {
    /// Returns true if any line was read.
    pub(super) fn begun(&self) -> bool {
        self.span.is_some() || self.reset.is_some() || !self.storeys.is_empty()
    }

    /// Reads one line of codes.
    pub(super) fn read(&mut self, line: &SourceLine<'_>, reporter: &mut Reporter<'_>) {
        let end = comment(line, reporter);
        reporter.fixed_walls(line, line.written(end));
        let mut next = 0..end;
        while !next.is_empty() {
            let this = match first_turn(&line.text[next.clone()]) {
                Some(at) => next.start..next.start + at + 1,
                None => before_reset(line, next.clone(), reporter),
            };
            if !self.inner_turn(line, this.clone(), end, reporter) {
                self.wall(line, this.clone(), reporter);
            }
            let rest = &line.text[this.end..end];
            next = end - rest.trim_start_matches(' ').len()..end;
        }
    }

    /// Closes the last storey and returns the storeys.
    pub(super) fn finish(&mut self, reporter: &mut Reporter<'_>) -> Vec<Item<Storey>> {
        let mut slips = std::mem::take(&mut self.slips).into_iter();
        if let Some(first) = slips.next() {
            reporter.say(say::out_of_step(first, slips.collect()));
        }
        if let Some(reset) = self.reset.filter(|_| !self.storeys.is_empty()) {
            reporter.say(say::last_reset(reset));
        }
        self.close();
        self.storeys.shrink_to_fit();
        std::mem::take(&mut self.storeys)
    }

    fn wall(&mut self, line: &SourceLine<'_>, range: Range<usize>, reporter: &mut Reporter<'_>) {
        let Ending {
            codes,
            control,
            misplaced,
        } = ending(line, range.clone(), reporter);
        let turn = control.as_ref().map(|(_, at)| at.start);
        let (pieces, in_step) = pieces(line, range.start..codes, turn, &mut self.slips, reporter);
        // Where the codes have left their columns, a letter after them is in none either.
        if let Some(misplaced) = misplaced.filter(|_| in_step) {
            reporter.say(misplaced);
        }
        let span = line.span(reporter.source, range);
        let control = control.map(|(c, at)| (c, line.span(reporter.source, at)));
        let turn = control.and_then(|(c, at)| match c {
            Control::Left => Some(Spanned::new(-90.0, at)),
            Control::Right => Some(Spanned::new(90.0, at)),
            Control::NextStorey => None,
        });
        let reset = control.and_then(|(c, at)| (c == Control::NextStorey).then_some(at));
        // A lone `^` is not a wall: it closes the storey before.
        if reset.is_none() || !pieces.is_empty() {
            self.rows.push(Item::One(Row { span, pieces, turn }));
        } else if self.rows.is_empty() {
            let line = reporter.or_line(span);
            reporter.say(say::empty_storey(span, line, self.storeys.len() + 1));
        }
        self.span = Some(self.span.map_or(span, |s| s.to(span)));
        if reset.is_some() {
            self.close();
        }
        self.reset = reset;
    }

    /// Reports a turn that ends `range` but not its line. One before all codes is assigned to the line before, where it
    /// belongs; returns true if nothing else is left of the range.
    fn inner_turn(
        &mut self,
        line: &SourceLine<'_>,
        range: Range<usize>,
        end: usize,
        reporter: &mut Reporter<'_>,
    ) -> bool {
        let rest = line.text[range.end..end].trim_start_matches(' ');
        let text = line.text[range.clone()].trim_start_matches(' ');
        if rest.is_empty() || !text.ends_with(['L', 'R']) {
            return false;
        }
        let span = line.span(reporter.source, range.end - 1..range.end);
        let (letter, leads) = (&text[text.len() - 1..], text.len() == 1);
        let gap = line.span(
            reporter.source,
            if leads { range.start } else { range.end }..end - rest.len(),
        );
        let fix = if leads {
            self.rows
                .last()
                .and_then(|row| before(row, letter, reporter))
        } else {
            None
        };
        let fix = match (leads, fix) {
            (true, fix) => fix.map(|there| vec![Edit::new(gap, ""), there]),
            (false, _) => Some(vec![Edit::new(gap, reporter.line_end_text())]),
        };
        let message = say::inner_turn(span, letter, leads, fix.unwrap_or_default());
        reporter.say(message);
        if let Some(Item::One(row)) = self.rows.last_mut().filter(|_| leads) {
            let degrees = if letter == "L" { -90.0 } else { 90.0 };
            row.turn.get_or_insert(Spanned::new(degrees, span));
        }
        leads
    }

    fn close(&mut self) {
        let span = self.span.take().unwrap_or_default();
        let mut rows = std::mem::take(&mut self.rows);
        // Vectors of one element have room for four, which a hundred thousand storeys of a line each do not.
        rows.shrink_to_fit();
        if !rows.is_empty() {
            self.storeys.push(Item::One(Storey {
                span,
                loops: vec![Loop {
                    span,
                    rows,
                    ..Loop::default()
                }],
                ..Storey::default()
            }));
        }
    }
}

/// Returns the start of the comment on a line. A `#` inside a code is an ordinary character.
fn comment(line: &SourceLine<'_>, reporter: &mut Reporter<'_>) -> usize {
    let text = &*line.text;
    if !text.as_bytes().contains(&b'#') {
        return text.len();
    }
    let mut before = ' ';
    let Some((_, (at, _))) = text.char_indices().enumerate().find(|&(column, (_, c))| {
        let fresh = before == ' ' || column.is_multiple_of(CELL);
        before = c;
        c == '#' && fresh
    }) else {
        return text.len();
    };
    let span = line.span(reporter.source, at..text.trim_end().len());
    say_comment(line, span, reporter);
    text[..at].trim_end_matches(' ').len()
}

/// Returns the first `L` or `R` that is a word of its own with codes after it. In the fifth column of a code it is left
/// alone: custom parts may have such codes.
fn first_turn(text: &str) -> Option<usize> {
    // Not beyond the next `^`, with each column counted once: a line may be a megabyte of either.
    let end = text.bytes().position(|b| b == b'^').unwrap_or(text.len());
    let bytes = &text.as_bytes()[..end];
    let (mut at, mut counted, mut column) = (0, 0, 0);
    while let Some(found) = bytes[at..].iter().position(|b| matches!(b, b'L' | b'R')) {
        at += found;
        let alone =
            (at == 0 || bytes[at - 1] == b' ') && text.as_bytes().get(at + 1) == Some(&b' ');
        if alone {
            column += columns(&text[counted..at]);
            counted = at;
            if column % CELL != CELL - 1 {
                let more = text[at + 1..].trim_start_matches(' ');
                return (!more.is_empty()).then_some(at);
            }
        }
        at += 1;
    }
    None
}

/// Returns the part of a line up to its first `^`; the rest is the first wall of the next storey.
fn before_reset(
    line: &SourceLine<'_>,
    range: Range<usize>,
    reporter: &mut Reporter<'_>,
) -> Range<usize> {
    let text = &line.text[range.clone()];
    let Some(at) = text.bytes().position(|b| b == b'^') else {
        return range;
    };
    let rest = text[at + 1..].trim_start_matches(' ');
    if rest.is_empty() {
        return range;
    }
    let span = line.span(reporter.source, range.end - rest.len()..range.end);
    let gap = line.span(
        reporter.source,
        range.start + at + 1..range.end - rest.len(),
    );
    let end = reporter.line_end_text();
    reporter.say(say::after_reset(span, gap, end));
    range.start..range.start + at + 1
}

/// The end of a line.
struct Ending {
    /// The end of its codes.
    codes: usize,
    /// The control letter and its place.
    control: Option<(Control, Range<usize>)>,
    /// The message that the letter is inside a code.
    misplaced: Option<Diagnostic>,
}

/// Returns the end of a line.
fn ending(line: &SourceLine<'_>, range: Range<usize>, reporter: &mut Reporter<'_>) -> Ending {
    let ending = |codes, control| Ending {
        codes,
        control,
        misplaced: None,
    };
    let text = line.text[range.clone()].trim_end_matches(' ');
    let Some((control, lower)) = text.chars().next_back().and_then(control) else {
        return ending(range.end, None);
    };
    let before = &text[..text.len() - 1];
    let at = range.start + before.len()..range.start + text.len();
    let span = line.span(reporter.source, at.clone());
    if columns(before).is_multiple_of(CELL) {
        if lower {
            reporter.say(say::lower_control(span, &text[before.len()..]));
        }
        if at.end < range.end {
            let blanks = line.span(reporter.source, at.end..range.end);
            reporter.say(say::blanks_after(blanks, &text[before.len()..]));
        }
        return ending(at.start, Some((control, at)));
    }
    let apart = before.ends_with(' ');
    if lower || !apart && control != Control::NextStorey {
        return ending(range.end, None);
    }
    let letter = &text[before.len()..];
    let mut codes = before.trim_end_matches(' ');
    if columns(codes) % CELL == 1 && codes.ends_with(['L', 'R']) {
        // `L^`: the turn before a reset has no effect.
        let turn = &codes[codes.len() - 1..];
        codes = &codes[..codes.len() - 1];
        let gap = line.span(reporter.source, range.start + codes.len()..at.start);
        reporter.say(say::second_control(
            span,
            letter,
            columns(before),
            turn,
            gap,
        ));
        return ending(range.start + codes.len(), Some((control, at)));
    }
    let surplus = columns(before) % CELL;
    let blanks = line.span(reporter.source, at.start.saturating_sub(surplus)..at.start);
    let places = (columns(before), columns(codes));
    Ending {
        misplaced: Some(say::misplaced_control(span, letter, places, blanks)),
        ..ending(range.start + codes.len(), Some((control, at)))
    }
}

/// Returns the edit that ends a row without a turn with a letter right after the five columns of its last code.
fn before(row: &Item<Row>, letter: &str, reporter: &Reporter<'_>) -> Option<Edit> {
    let Item::One(row) = row else { return None };
    let text = reporter.written(row.span);
    if row.turn.is_some() || !text.is_ascii() {
        return None;
    }
    let codes = text.trim_end_matches(' ').len();
    let column = codes.next_multiple_of(CELL).max(text.len() / CELL * CELL);
    let range = reporter.source.text_range(row.span);
    let place = reporter.source.span(range.start + codes..range.end);
    let blanks = column - codes;
    Some(Edit::new(place, format!("{:blanks$}{letter}", "")))
}

fn control(c: char) -> Option<(Control, bool)> {
    Some(match c {
        'L' => (Control::Left, false),
        'R' => (Control::Right, false),
        '^' => (Control::NextStorey, false),
        'l' => (Control::Left, true),
        'r' => (Control::Right, true),
        _ => return None,
    })
}
