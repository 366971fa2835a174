//! Lines and columns of the protocol: lines end with `\n`, `\r\n` or `\r`; columns count bytes, UTF-16 units or characters,
//! as negotiated with the client.

use gen_lsp_types::{Position, Range};
use std::ops;

/// The unit of columns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Encoding {
    /// Bytes.
    Utf8,
    /// UTF-16 units, which every client supports.
    #[default]
    Utf16,
    /// Characters.
    Utf32,
}

impl Encoding {
    /// Returns its name in the protocol.
    pub(super) fn name(self) -> &'static str {
        match self {
            Encoding::Utf8 => "utf-8",
            Encoding::Utf16 => "utf-16",
            Encoding::Utf32 => "utf-32",
        }
    }

    /// Returns the cheapest encoding among those the client supports.
    pub(super) fn choose(known: &[String]) -> Encoding {
        let knows = |e: &Encoding| known.iter().any(|k| k == e.name());
        let best = [Encoding::Utf8, Encoding::Utf32].into_iter().find(knows);
        best.unwrap_or_default()
    }

    fn width(self, text: &str) -> usize {
        match self {
            Encoding::Utf8 => text.len(),
            _ if text.is_ascii() => text.len(),
            Encoding::Utf16 => text.chars().map(char::len_utf16).sum(),
            Encoding::Utf32 => text.chars().count(),
        }
    }

    fn of(self, c: char) -> usize {
        match self {
            Encoding::Utf8 => c.len_utf8(),
            Encoding::Utf16 => c.len_utf16(),
            Encoding::Utf32 => 1,
        }
    }
}

/// The start offsets of the lines of a document.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Lines {
    starts: Vec<usize>,
}

impl Lines {
    /// Finds the lines of a document.
    pub(super) fn new(text: &str) -> Lines {
        let mut starts = vec![0];
        starts.extend(starts_in(text, 0..text.len()));
        Lines { starts }
    }

    /// Updates the lines after an edit that replaced `range` by `len` bytes; `text` is the new text.
    pub(super) fn edit(&mut self, range: &ops::Range<usize>, len: usize, text: &str) {
        // Adding or removing a line feed after a carriage return affects the line before.
        let first = self.line(range.start).saturating_sub(1);
        let last = (self.line(range.end) + 2).min(self.starts.len());
        let moved = |at: usize| at - range.end + range.start + len;
        let from = self.starts[first];
        let to = self.starts.get(last).map_or(text.len(), |s| moved(*s) - 1);
        for start in &mut self.starts[last..] {
            *start = moved(*start);
        }
        let new = starts_in(text, from..to);
        self.starts.splice(first + 1..last, new);
    }

    /// Returns the line of an offset, counted from 0.
    fn line(&self, at: usize) -> usize {
        self.starts.partition_point(|s| *s <= at) - 1
    }

    /// Returns the position of an offset.
    pub(super) fn position(&self, text: &str, at: usize, encoding: Encoding) -> Position {
        let line = self.line(at);
        let before = text.get(self.starts[line]..at).unwrap_or_default();
        Position {
            line: line as u32,
            character: encoding.width(before) as u32,
        }
    }

    /// Returns the positions of a range of offsets.
    pub(super) fn range(&self, text: &str, range: &ops::Range<usize>, encoding: Encoding) -> Range {
        Range {
            start: self.position(text, range.start, encoding),
            end: self.position(text, range.end, encoding),
        }
    }

    /// Returns the offset of a position; positions past the end of a line are moved to its end.
    pub(super) fn offset(&self, text: &str, position: Position, encoding: Encoding) -> usize {
        let line = position.line as usize;
        let Some(&start) = self.starts.get(line) else {
            return text.len();
        };
        let end = self.starts.get(line + 1).map_or(text.len(), |next| {
            let line = &text[start..*next];
            start + line.trim_end_matches(['\n', '\r']).len()
        });
        let (line, wanted) = (&text[start..end], position.character as usize);
        if encoding == Encoding::Utf8 || line.is_ascii() {
            let mut at = start + wanted.min(line.len());
            while !text.is_char_boundary(at) {
                at -= 1;
            }
            return at;
        }
        let mut column = 0;
        for (at, c) in line.char_indices() {
            column += encoding.of(c);
            if column > wanted {
                return start + at;
            }
        }
        end
    }

    /// Returns the offsets of a range; its end is never before its start.
    pub(super) fn offsets(
        &self,
        text: &str,
        range: Range,
        encoding: Encoding,
    ) -> ops::Range<usize> {
        let start = self.offset(text, range.start, encoding);
        start..self.offset(text, range.end, encoding).max(start)
    }
}

/// Returns the starts of the lines that follow a line end within a range.
fn starts_in(text: &str, range: ops::Range<usize>) -> Vec<usize> {
    let bytes = text.as_bytes();
    let ends = |at: &usize| match bytes[*at] {
        b'\n' => true,
        b'\r' => bytes.get(at + 1) != Some(&b'\n'),
        _ => false,
    };
    range.filter(ends).map(|at| at + 1).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_keep_the_lines() {
        let pieces = ["", "\n", "\r", "\r\n", "家\n", "a\rb", "\n\r\n", "xyz"];
        let mut text = String::from("一\r\n二\r三\n\n四");
        let mut lines = Lines::new(&text);
        let mut seed = 7usize;
        for round in 0..4000 {
            let mut next = |below: usize| {
                seed = seed
                    .wrapping_mul(6364136223846793005)
                    .wrapping_add(1442695040888963407);
                (seed >> 33) % below.max(1)
            };
            let boundary = |mut at: usize, text: &str| {
                while !text.is_char_boundary(at) {
                    at -= 1;
                }
                at
            };
            let start = boundary(next(text.len() + 1), &text);
            let most = if text.len() > 60 { 40 } else { 6 };
            let end = boundary((start + next(most)).min(text.len()), &text).max(start);
            let piece = pieces[next(pieces.len())];
            text.replace_range(start..end, piece);
            lines.edit(&(start..end), piece.len(), &text);
            assert_eq!(lines, Lines::new(&text), "round {round}: {text:?}");
        }
    }

    #[test]
    fn positions_go_both_ways() {
        let text = "一𠮷b\r\nc\rd\n";
        let lines = Lines::new(text);
        for encoding in [Encoding::Utf8, Encoding::Utf16, Encoding::Utf32] {
            for (at, c) in text.char_indices() {
                if c == '\n' || c == '\r' {
                    continue;
                }
                let position = lines.position(text, at, encoding);
                assert_eq!(
                    lines.offset(text, position, encoding),
                    at,
                    "{encoding:?} {at}"
                );
            }
        }
        let at = text.find('b').expect("is there");
        let position = lines.position(text, at, Encoding::Utf16);
        assert_eq!((position.line, position.character), (0, 3));
        let beyond = Position {
            line: 0,
            character: 99,
        };
        assert_eq!(lines.offset(text, beyond, Encoding::Utf16), at + 1);
        let below = Position {
            line: 99,
            character: 0,
        };
        assert_eq!(lines.offset(text, below, Encoding::Utf16), text.len());
        let inside = Position {
            line: 0,
            character: 2,
        };
        assert_eq!(lines.offset(text, inside, Encoding::Utf16), "一".len());
    }
}
