//! Edits of a wall line, for fixes. They need only the places of its codes: a line of the legacy form ends right after
//! its last code, five columns wide, or with a letter after that; a row that ends with codes has only its end tag after
//! them.

use hsd_base::diagnostic::Edit;
use hsd_base::geometry::SAME;
use hsd_base::source::Span;
use hsd_ir::building::Wall;

/// Columns, and so bytes, of one code.
const CELL: u32 = 5;

/// Bytes of the end tag of a row, `</Row>`: more than may follow the last code of a line, and less than any other
/// tag with it.
const END_TAG: u32 = 6;

/// The code of a new wall of one unit.
const PLAIN: &str = "KSK  ";

/// Returns the last code of a line and what follows it, if that is at most the letter of a legacy line or the end tag
/// of a row.
fn end(wall: &Wall) -> Option<(Span, Span)> {
    let last = wall.units.last()?.span;
    let inside = last.start >= wall.span.start && last.end <= wall.span.end;
    let rest = Span {
        start: last.end,
        ..wall.span
    };
    let plain = last.file == rest.file
        && (1..=CELL).contains(&(last.end.saturating_sub(last.start)))
        && rest.end.saturating_sub(rest.start) <= END_TAG;
    (inside && plain).then_some((last, rest))
}

/// Returns true if this is the end of a row, not of a line in the legacy form.
fn is_row(rest: Span) -> bool {
    rest.end - rest.start == END_TAG
}

/// Returns the blanks that pad a code to its five columns.
fn filling(code: Span) -> String {
    " ".repeat((CELL - (code.end - code.start)) as usize)
}

/// Ends a line that has no letter with a turn to the left.
pub(super) fn turn_left(wall: &Wall) -> Option<Edit> {
    let (last, rest) = end(wall)?;
    (!is_row(rest)).then(|| Edit::new(rest, filling(last) + "L"))
}

/// Removes the letter for a left turn.
pub(super) fn turn_right(wall: &Wall) -> Option<Edit> {
    let (last, rest) = end(wall)?;
    let letter = rest.end - rest.start == 1 && last.end - last.start == CELL;
    letter.then(|| Edit::new(rest, ""))
}

/// Reverses a right-angle turn of a line.
pub(super) fn turn_back(wall: &Wall, turn: f64) -> Option<Edit> {
    match turn {
        90.0 => turn_left(wall),
        -90.0 => turn_right(wall),
        _ => None,
    }
}

/// Makes a line longer by whole units of plain wall, or shorter by its last codes.
pub(super) fn resize(wall: &Wall, by: f64) -> Option<Edit> {
    let (last, rest) = end(wall)?;
    if by < 0.0 {
        return shorten(wall, -by, last);
    }
    let whole = (1.0..=1000.0).contains(&by) && (by - by.round()).abs() < SAME;
    let codes = filling(last) + &PLAIN.repeat(by.round() as usize);
    let codes = match rest.end == rest.start || is_row(rest) {
        true => codes.trim_end().to_owned(),
        false => codes,
    };
    whole.then(|| Edit::new(last.after(), codes))
}

fn shorten(wall: &Wall, by: f64, last: Span) -> Option<Edit> {
    let (mut width, mut from) = (0.0, last.end);
    for unit in wall.units.iter().skip(1).rev() {
        // Codes side by side, each written once.
        if unit.span.end != from {
            return None;
        }
        width += unit.width;
        from = unit.span.start;
        if width > by - SAME {
            break;
        }
    }
    let span = Span {
        start: from,
        ..last
    };
    ((width - by).abs() < SAME).then(|| Edit::new(span, ""))
}
