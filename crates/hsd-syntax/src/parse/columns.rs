//! The form of codes in columns, and lines whose codes have left theirs.
//!
//! Only the form is known here: a code begins with one of the class letters (docs/evidence.md 5.1), five blanks or five
//! points are a void. Whether a part exists is checked later.

use std::borrow::Cow;
use std::ops::Range;

/// The columns of a code.
pub(super) const CELL: usize = 5;

/// A visible void.
pub(super) const POINTS: &str = ".....";

/// A code, or a void, and its place in the text of its line.
pub(super) struct Cell<'l> {
    pub(super) text: &'l str,
    pub(super) range: Range<usize>,
}

impl Cell<'_> {
    /// Returns the code as it belongs in its columns: a width goes to the fifth.
    pub(super) fn meant(&self) -> Cow<'_, str> {
        match self.text.as_bytes() {
            [a, b, c, width]
                if width.is_ascii_digit() && [a, b, c].iter().all(|b| b.is_ascii_uppercase()) =>
            {
                let (letters, width) = self.text.split_at(3);
                format!("{letters} {width}").into()
            }
            _ => self.text.into(),
        }
    }
}

/// The form of the cells of a line.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Form {
    odd: bool,
    doubtful: bool,
}

impl Form {
    /// Notes a cell; a truncated last one begins like any other.
    pub(super) fn see(&mut self, cell: &str) {
        self.odd |= !regular(cell);
        self.doubtful |= !plain(cell);
    }

    /// Returns true if a cell was neither a code nor a void.
    pub(super) fn is_odd(self) -> bool {
        self.odd
    }

    /// Returns the codes of the line if they have left their columns and its words leave no doubt; `at` is added to
    /// their places.
    pub(super) fn in_step(self, text: &str, at: usize) -> Option<Vec<Cell<'_>>> {
        if !self.odd && !self.doubtful {
            return None;
        }
        let cells = in_step(text, at)?;
        let all_plain = || cells.iter().all(|c| plain(c.text));
        (self.odd || all_plain()).then_some(cells)
    }
}

fn class(b: u8) -> bool {
    matches!(b, b'K' | b'T' | b'M' | b'G' | b'H' | b'A' | b'N')
}

/// Returns true if a cell has the form of a catalogue code or of a void.
fn regular(cell: &str) -> bool {
    match cell.as_bytes() {
        [b' ', ..] => cell == "     ",
        [b'.', ..] => cell == POINTS,
        [first, ..] => class(*first),
        [] => true,
    }
}

/// Returns true if a cell has the strict form of a catalogue code: three capitals, then letters,
/// and a width. Custom parts may differ, so any other cell is merely doubtful.
fn plain(cell: &str) -> bool {
    match *cell.as_bytes() {
        [] | [b' ' | b'.', ..] => true,
        [first, second, third, ref tail @ ..] => {
            let capitals = second.is_ascii_uppercase() && third.is_ascii_uppercase();
            // A letter after a blank is the first one of the next code.
            let torn = matches!(tail, [b' ', letter] if letter.is_ascii_uppercase());
            class(first) && capitals && !torn && !tail.iter().any(|b| matches!(b, b',' | b';'))
        }
        _ => false,
    }
}

/// Returns the codes of a misaligned line, if its words leave no doubt: each begins with a class letter and two
/// capitals, or is a void of points, and none is longer than five columns.
fn in_step(text: &str, at: usize) -> Option<Vec<Cell<'_>>> {
    let starts = starts(text);
    let first = *starts.first()?;
    if !text.is_ascii() || !text[..first].bytes().all(|b| b == b' ') {
        return None;
    }
    let mut cells = vec![];
    for k in 0..first / CELL {
        let range = at + k * CELL..at + (k + 1) * CELL;
        cells.push(Cell { text: "", range });
    }
    for (i, &start) in starts.iter().enumerate() {
        let end = starts.get(i + 1).copied();
        let segment = &text[start..end.unwrap_or(text.len())];
        // Some authors separate codes like words.
        let written = segment.trim_end_matches([' ', ',', ';']);
        if written.len() > CELL {
            return None;
        }
        let range = at + start..at + start + written.len();
        cells.push(Cell {
            text: written,
            range,
        });
        // A gap about five columns wider than a code needs is a void.
        let voids = end.map_or(0, |_| ((segment.len() + 2) / CELL).saturating_sub(1));
        let gap = at + start + written.len()..at + start + segment.len();
        cells.extend((0..voids).map(|_| Cell {
            text: "",
            range: gap.clone(),
        }));
    }
    Some(cells)
}

/// Returns the starts of words that look like codes.
fn starts(text: &str) -> Vec<usize> {
    let bytes = text.as_bytes();
    let (mut at, mut found) = (0, vec![]);
    while at < bytes.len() {
        let word = bytes
            .get(at..at + 3)
            .is_some_and(|w| class(w[0]) && w[1].is_ascii_uppercase() && w[2].is_ascii_uppercase());
        let fresh = at == 0 || !bytes[at - 1].is_ascii_uppercase();
        let points = bytes[at..].starts_with(POINTS.as_bytes());
        if points || word && fresh {
            found.push(at);
        }
        at += match (points, word && fresh) {
            (true, _) => CELL,
            (_, true) => 3,
            _ => 1,
        };
    }
    found
}
