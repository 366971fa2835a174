//! Lines and columns of many places. [`Source::line_column`] looks through the text up to each of them.

use super::Source;

/// A text is counted once, and its characters are known after every so many bytes: a column costs the same in a line of a
/// million codes.
const BLOCK: usize = 256;

/// The lines of a text.
#[derive(Clone, Debug)]
pub struct Lines<T> {
    text: T,
    /// The offsets at which lines begin.
    starts: Vec<u32>,
    /// The characters that begin before each block.
    blocks: Vec<u32>,
    /// Line and column of the first character, from 1.
    first: (u32, u32),
}

impl<T: AsRef<str>> Lines<T> {
    /// Finds the lines of a text whose first character has this line and column, both from 1.
    pub fn new(text: T, first: (u32, u32)) -> Lines<T> {
        let ends = text.as_ref().match_indices('\n');
        let starts = [0]
            .into_iter()
            .chain(ends.map(|(at, _)| at as u32 + 1))
            .collect();
        let mut count = 0;
        let blocks = text.as_ref().as_bytes().chunks(BLOCK);
        let blocks = blocks.map(|block| {
            let before = count;
            count += begun(block);
            before
        });
        let blocks = blocks.collect();
        Lines {
            text,
            starts,
            blocks,
            first,
        }
    }

    /// Returns the number of characters that begin before an offset.
    fn characters(&self, at: usize) -> u32 {
        let bytes = self.text.as_ref().as_bytes();
        let block = (at / BLOCK).min(self.blocks.len().saturating_sub(1));
        let before = self.blocks.get(block).copied().unwrap_or(0);
        let rest = bytes.get(block * BLOCK..at.min(bytes.len()));
        before + rest.map_or(0, begun)
    }

    /// Returns line and column of an offset, which is at a character; both from 1, columns in characters.
    pub fn line_column(&self, at: usize) -> (u32, u32) {
        let number = self.starts.partition_point(|start| *start as usize <= at) - 1;
        let before = self.characters(at) - self.characters(self.starts[number] as usize);
        match number {
            0 => (self.first.0, self.first.1 + before),
            _ => (self.first.0 + number as u32, 1 + before),
        }
    }
}

/// Returns the number of characters that begin in some bytes of UTF-8.
fn begun(bytes: &[u8]) -> u32 {
    bytes.iter().filter(|b| (**b as i8) >= -0x40).count() as u32
}

impl<'s> Lines<&'s str> {
    /// Finds the lines of a source; offsets are those of its text.
    pub fn of(source: &'s Source) -> Lines<&'s str> {
        Lines::new(source.text(), (1, 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::FileId;

    #[test]
    fn lines_are_those_of_a_source() {
        let text = "# 町家\r\nGSI  KSK\n\n家\n";
        let source = Source::new(FileId(0), "a.hsd", text.as_bytes());
        let lines = Lines::of(&source);
        for (at, _) in text.char_indices().chain([(text.len(), ' ')]) {
            let (line, column) = source.line_column(source.span(at..at));
            assert_eq!(lines.line_column(at), (line as u32, column as u32), "{at}");
        }
        let long = format!("{}\n{}家", "町家GSI  ".repeat(300), "x".repeat(700));
        let lines = Lines::new(&long, (1, 1));
        for (at, _) in long.char_indices().chain([(long.len(), ' ')]) {
            let line = long[..at].rfind('\n').map_or(0, |n| n + 1);
            let column = long[line..at].chars().count() as u32 + 1;
            assert_eq!(lines.line_column(at).1, column, "{at}");
        }
        assert_eq!(Lines::new("ab\nc", (7, 5)).line_column(1), (7, 6));
        assert_eq!(Lines::new("ab\nc", (7, 5)).line_column(3), (8, 1));
    }
}
