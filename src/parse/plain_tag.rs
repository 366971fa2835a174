//! Tags as nearly all are: ASCII names, `name="value"` after blanks, each name once, nothing to report. They are read here,
//! since quick-xml takes several times as long; whatever is not as plain is left to it.

use smallvec::SmallVec;
use std::ops::Range;

/// A plain tag, as places in the text.
pub(in crate::parse) struct PlainTag {
    pub(in crate::parse) name: Range<usize>,
    /// The place of the name and the value of each attribute.
    pub(in crate::parse) attributes: SmallVec<[(Range<usize>, Range<usize>); 4]>,
    pub(in crate::parse) kind: TagKind,
    /// The first byte after it.
    pub(in crate::parse) end: usize,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::parse) enum TagKind {
    /// `<name ...>`.
    Start,
    /// `<name .../>`.
    Empty,
    /// `</name>`.
    End,
}

impl PlainTag {
    /// Reads the tag that begins at a byte, if it is plain.
    pub(in crate::parse) fn at(bytes: &[u8], at: usize) -> Option<PlainTag> {
        let mut cursor = Cursor { bytes, at };
        cursor.skips(b'<').then_some(())?;
        let ends = cursor.skips(b'/');
        let name = cursor.name()?;
        let mut tag = PlainTag {
            name,
            attributes: SmallVec::new(),
            kind: TagKind::End,
            end: 0,
        };
        if !ends {
            cursor.attributes(&mut tag)?;
            tag.kind = match cursor.skips(b'/') {
                true => TagKind::Empty,
                false => TagKind::Start,
            };
        }
        cursor.skips(b'>').then_some(())?;
        tag.end = cursor.at;
        Some(tag)
    }
}

/// A place in the text.
struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Cursor<'_> {
    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    /// Skips a byte if it is here; returns whether it is.
    fn skips(&mut self, byte: u8) -> bool {
        let here = self.peek() == Some(byte);
        self.at += usize::from(here);
        here
    }

    /// Skips all bytes of a kind.
    fn skip_all(&mut self, of_kind: impl Fn(u8) -> bool) {
        while self.peek().is_some_and(&of_kind) {
            self.at += 1;
        }
    }

    fn name(&mut self) -> Option<Range<usize>> {
        let start = self.at;
        let begins = |c: u8| c.is_ascii_alphabetic() || c == b'_';
        self.peek().is_some_and(begins).then_some(())?;
        self.skip_all(|c| c.is_ascii_alphanumeric() || matches!(c, b'_' | b'-' | b'.'));
        Some(start..self.at)
    }

    /// Reads the attributes up to the end of a tag.
    fn attributes(&mut self, tag: &mut PlainTag) -> Option<()> {
        loop {
            let before = self.at;
            self.skip_all(|c| matches!(c, b' ' | b'\t' | b'\r' | b'\n'));
            if let Some(b'/' | b'>') = self.peek() {
                return Some(());
            }
            (self.at > before).then_some(())?;
            let name = self.name()?;
            let own = &self.bytes[name.clone()];
            let mut others = tag.attributes.iter().map(|(other, _)| other.clone());
            if others.any(|other| self.bytes[other] == *own) {
                return None;
            }
            self.skips(b'=').then_some(())?;
            let value = self.value()?;
            tag.attributes.push((name, value));
        }
    }

    fn value(&mut self) -> Option<Range<usize>> {
        let quote = self.peek().filter(|c| matches!(c, b'"' | b'\''))?;
        let start = self.at + 1;
        self.at = start;
        self.skip_all(|c| c != quote && !matches!(c, b'<' | b'>'));
        let end = self.at;
        self.skips(quote).then_some(start..end)
    }
}
