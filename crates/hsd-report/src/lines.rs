//! Lines and columns of a file, counted once.

use hsd_base::source::{Source, Span};
use memchr::memchr_iter;
use std::ops::Range;

/// Bytes between two known character counts.
const BLOCK: usize = 1024;

/// A place as editors show it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    /// From 1.
    pub line: usize,
    /// From 1, in characters.
    pub column: usize,
}

impl Default for Position {
    fn default() -> Self {
        Position { line: 1, column: 1 }
    }
}

/// The starts of the lines of a source, and the number of characters before some of its bytes.
#[derive(Debug)]
pub struct Lines<'a> {
    source: &'a Source,
    /// The starts of the lines, as offsets into the text.
    starts: Vec<usize>,
    /// The number of characters before every [`BLOCK`]th byte.
    characters: Vec<usize>,
}

impl<'a> Lines<'a> {
    /// Indexes a source.
    pub fn new(source: &'a Source) -> Lines<'a> {
        let text = source.text().as_bytes();
        let breaks = memchr_iter(b'\n', text);
        let starts = std::iter::once(0).chain(breaks.map(|i| i + 1)).collect();
        let mut characters = vec![0];
        for block in text.chunks(BLOCK) {
            let before = characters.last().copied().unwrap_or(0);
            characters.push(before + characters_in(block));
        }
        Lines {
            source,
            starts,
            characters,
        }
    }

    /// Returns the text.
    pub fn text(&self) -> &'a str {
        self.source.text()
    }

    /// Returns the range of the text that a span covers.
    pub fn range(&self, span: Span) -> Range<usize> {
        self.source.text_range(span)
    }

    /// Returns the number of characters before an offset of the text.
    pub fn characters(&self, offset: usize) -> usize {
        let text = self.source.text().as_bytes();
        let offset = offset.min(text.len());
        let block = offset / BLOCK;
        self.characters[block] + characters_in(&text[block * BLOCK..offset])
    }

    /// Returns the number of the line, from 0, at an offset of the text.
    pub fn line(&self, offset: usize) -> usize {
        self.starts.partition_point(|s| *s <= offset) - 1
    }

    /// Returns the number of lines; a text that ends with a line end has an empty last one.
    pub fn count(&self) -> usize {
        self.starts.len()
    }

    /// Returns the range of a line, from 0, without its line end.
    pub fn line_range(&self, line: usize) -> Range<usize> {
        let text = self.source.text();
        let start = self.starts[line];
        let next = self.starts.get(line + 1).copied();
        let end = next.map_or(text.len(), |n| n - 1);
        let end = end - usize::from(text[start..end].ends_with('\r'));
        start..end
    }

    /// Returns line and column of an offset of the text.
    pub fn position(&self, offset: usize) -> Position {
        let line = self.line(offset);
        let before = self.characters(self.starts[line]);
        Position {
            line: line + 1,
            column: self.characters(offset) - before + 1,
        }
    }
}

/// Returns the number of bytes that begin a character.
fn characters_in(bytes: &[u8]) -> usize {
    bytes.iter().filter(|b| **b & 0xc0 != 0x80).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use hsd_base::source::FileId;

    #[test]
    fn positions_agree_with_slow_counting() {
        let text = "町家\r\nGSI  ｶﾞ\n\n".repeat(200) + "end";
        let source = Source::new(FileId(0), "a.hsd", text.as_bytes());
        let lines = Lines::new(&source);
        for (at, _) in text.char_indices().chain([(text.len(), ' ')]) {
            let Position { line, column } = lines.position(at);
            assert_eq!(
                (line, column),
                source.line_column(source.span(at..at)),
                "{at}"
            );
        }
        assert_eq!(&text[lines.line_range(0)], "町家");
        assert_eq!(&text[lines.line_range(1)], "GSI  ｶﾞ");
        assert_eq!(&text[lines.line_range(600)], "end");
    }
}
