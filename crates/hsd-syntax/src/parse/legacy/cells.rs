//! Splits a wall line into codes of five columns.
//!
//! If the columns of a line are misaligned, every code after the mistake would be unknown; so the words are examined
//! instead, and one message proposes the intended line.

use super::line::SourceLine;
use crate::messages::legacy as say;
use crate::parse::columns::{CELL, Cell, Form, POINTS};
use crate::parse::reporter::Reporter;
use hsd_ir::ast::{CodeText, Item, Piece};
use nom::bytes::complete::take;
use nom::{IResult, Parser};
use std::ops::Range;

/// Returns the pieces of a part of a line, and whether they are in their columns; those that are not are added to `slips`.
/// `turn` is the place of the control letter after it.
pub(super) fn pieces(
    line: &SourceLine<'_>,
    mut range: Range<usize>,
    turn: Option<usize>,
    slips: &mut Vec<say::Slip>,
    reporter: &mut Reporter<'_>,
) -> (Vec<Item<Piece>>, bool) {
    if let Some((width, code)) = free_width(&line.text[range.clone()]) {
        let span = line.span(
            reporter.source,
            range.start + width.start..range.start + width.end,
        );
        let number = &line.text[range.clone()][width];
        reporter.say(say::no_widths(span, number, code));
        let span = line.span(reporter.source, range);
        return (vec![Item::One(Piece::Error(span))], false);
    }
    range.start += leading_shift(line, range.clone(), reporter);
    let text = &line.text[range.clone()];
    let mut pieces = Vec::with_capacity(text.len() / CELL + 1);
    let (mut rest, mut at) = (text, range.start);
    let mut form = Form::default();
    let ascii = text.is_ascii();
    while let Ok((next, cell)) = if ascii { five_bytes(rest) } else { five(rest) } {
        form.see(cell);
        pieces.push(piece(line, at..at + cell.len(), cell, reporter));
        (rest, at) = (next, at + cell.len());
    }
    // A truncated last code begins like any other.
    let last = rest.trim_end_matches(' ');
    form.see(last);
    if let Some(cells) = form.in_step(text, range.start) {
        let (pieces, slip) = fixed(line, range, &cells, turn, reporter);
        slips.push(slip);
        return (pieces, false);
    }
    if form.is_odd() {
        point_voids(line, range.clone(), &mut pieces, reporter);
    }
    remainder(line, at..range.end, rest, &mut pieces, reporter);
    if turn.is_none() && text.ends_with("     ") {
        trailing_voids(line, text, range.start, reporter);
    }
    (pieces, true)
}

/// Returns the number of columns, which are characters whatever their bytes.
pub(super) fn columns(text: &str) -> usize {
    if text.is_ascii() {
        text.len()
    } else {
        text.chars().count()
    }
}

/// Returns the place of a width that an author gives to a part, `KKS 1.5` or `KKS=2`, and the code before it. No code has a
/// number with a decimal point.
fn free_width(text: &str) -> Option<(Range<usize>, &str)> {
    let digit = |at: usize| text.as_bytes().get(at).is_some_and(u8::is_ascii_digit);
    let (mark, sign) = text
        .match_indices(['.', '=', '*', ':'])
        .find(|(at, sign)| {
            let before = match *sign {
                "." => digit(at.wrapping_sub(1)),
                _ => at
                    .checked_sub(1)
                    .is_some_and(|b| text.as_bytes()[b].is_ascii_uppercase()),
            };
            before && digit(at + 1)
        })?;
    let number = |c: char| c.is_ascii_digit() || c == '.';
    let start = match sign {
        "." => text[..mark].trim_end_matches(number).len(),
        _ => mark + 1,
    };
    let end = text.len() - text[start..].trim_start_matches(number).len();
    let before = text[..start].trim_end_matches([' ', '=', '*', ':']);
    let code = before
        .trim_end_matches(|c: char| c.is_ascii_uppercase())
        .len();
    Some((start..end, &before[code..]))
}

fn five(input: &str) -> IResult<&str, &str> {
    take(CELL).parse(input)
}

/// Takes five columns if they are bytes, which avoids decoding each character.
fn five_bytes(input: &str) -> IResult<&str, &str> {
    let (_, cell) = take(CELL)
        .parse(input.as_bytes())
        .map_err(|e: nom::Err<_>| {
            e.map(|e: nom::error::Error<&[u8]>| nom::error::Error::new(input, e.code))
        })?;
    let (cell, rest) = input.split_at(cell.len());
    Ok((rest, cell))
}

fn piece(
    line: &SourceLine<'_>,
    range: Range<usize>,
    text: &str,
    reporter: &Reporter<'_>,
) -> Item<Piece> {
    let span = line.span(reporter.source, range);
    if !text.is_ascii() {
        return Item::One(Piece::Error(span));
    }
    let code = match <[u8; CELL]>::try_from(text.as_bytes()) {
        Ok(five) if five != *b"....." => CodeText::Five(five),
        _ => CodeText::new(if text == POINTS { "" } else { text }),
    };
    Item::One(Piece::new(code, span))
}

/// Reports blanks before the first code that are not whole voids: they shift every code of the line.
fn leading_shift(line: &SourceLine<'_>, range: Range<usize>, reporter: &mut Reporter<'_>) -> usize {
    let text = &line.text[range.clone()];
    let lead = text.len() - text.trim_start_matches(' ').len();
    let shift = lead % CELL;
    if shift == 0 || lead == text.len() {
        return 0;
    }
    let span = line.span(reporter.source, range.start..range.start + lead);
    reporter.say(say::shifted(span, lead, lead - shift));
    shift
}

/// Reads the remainder after the last whole cell (docs/contract.md 2, remainders).
fn remainder(
    line: &SourceLine<'_>,
    range: Range<usize>,
    rest: &str,
    pieces: &mut Vec<Item<Piece>>,
    reporter: &mut Reporter<'_>,
) {
    let trimmed = rest.trim_end_matches(' ');
    let range = range.start..range.start + trimmed.len();
    if trimmed.is_empty() {
        return;
    }
    let span = line.span(reporter.source, range.clone());
    if trimmed.bytes().all(|b| b == b'.' || b == b' ') {
        reporter.say(say::few_points(span, trimmed));
        pieces.push(piece(line, range, POINTS, reporter));
    } else if columns(rest) == 1 {
        if trimmed.is_ascii() {
            reporter.say(say::one_over(span, trimmed));
        }
    } else {
        pieces.push(piece(line, range, trimmed, reporter));
    }
}

/// Reads whole cells of points and blanks that are not five points as voids.
fn point_voids(
    line: &SourceLine<'_>,
    range: Range<usize>,
    pieces: &mut [Item<Piece>],
    reporter: &mut Reporter<'_>,
) {
    let (mut rest, mut at) = (&line.text[range.clone()], range.start);
    for slot in pieces {
        let Ok((next, cell)) = five(rest) else { return };
        let range = at..at + cell.len();
        let points = cell.bytes().all(|b| b == b'.' || b == b' ') && cell.contains('.');
        if points && cell != POINTS {
            reporter.say(say::few_points(
                line.span(reporter.source, range.clone()),
                cell,
            ));
            *slot = piece(line, range, POINTS, reporter);
        }
        (rest, at) = (next, at + cell.len());
    }
}

/// Reports voids at a line end that an editor may trim away (docs/evidence.md 2.6, A4).
fn trailing_voids(line: &SourceLine<'_>, text: &str, at: usize, reporter: &mut Reporter<'_>) {
    let written = text.trim_end_matches(' ');
    let missing = (CELL - columns(written) % CELL) % CELL;
    let start = written.len() + missing;
    let count = text.len().saturating_sub(start) / CELL;
    if count > 0 {
        let span = line.span(reporter.source, at + start..at + start + count * CELL);
        reporter.say(say::trailing_void(span, count));
    }
}

/// Returns the words of a misaligned line, and its mistake from its first irregular cell on.
fn fixed(
    line: &SourceLine<'_>,
    range: Range<usize>,
    cells: &[Cell<'_>],
    turn: Option<usize>,
    reporter: &Reporter<'_>,
) -> (Vec<Item<Piece>>, say::Slip) {
    let text = &line.text[range.clone()];
    // The mistake is where a code first leaves its column.
    let off = |c: &&Cell<'_>| !(c.range.start - range.start).is_multiple_of(CELL);
    let slip = cells
        .iter()
        .find(off)
        .map_or(range.start, |c| c.range.start);
    let end = range.start + text.trim_end_matches(' ').len();
    let span = line.span(reporter.source, slip..end);
    let meant: String = cells.iter().map(|c| format!("{:5}", c.meant())).collect();
    // A turn belongs right after the five columns of the last code.
    let (last, whole) = match turn {
        Some(letter) => (letter, &*meant),
        None => (end, meant.trim_end()),
    };
    let all = line.span(reporter.source, range.start..last);
    let slip = say::Slip {
        span,
        column: slip - range.start + 1,
        fix: (all, whole.to_owned()),
        turn: None,
    };
    let part = |c: &Cell<'_>| piece(line, c.range.clone(), &c.meant(), reporter);
    (cells.iter().map(part).collect(), slip)
}
