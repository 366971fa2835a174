//! Tags as nearly all are: ASCII names, `name="value"` after blanks, nothing to report. They are read here, since quick-xml
//! takes several times as long to start anew for each; whatever is not as plain is left to it.

use crate::parse::xml::tree::scan::Scanner;
use crate::parse::xml::tree::token::{EndTag, StartTag, Token};
use smallvec::SmallVec;
use std::ops::Range;

/// The places of the name and the value of each attribute.
type Places = SmallVec<[(Range<usize>, Range<usize>); 4]>;

impl<'a> Scanner<'a, '_> {
    /// Reads and skips the tag here if it is plain.
    pub(in crate::parse::xml) fn plain_tag(&mut self) -> Option<Token<'a>> {
        let text = self.text;
        let mut cursor = Cursor {
            bytes: text.as_bytes(),
            at: self.at,
        };
        cursor.skips(b'<').then_some(())?;
        if cursor.skips(b'/') {
            let name = cursor.name()?;
            cursor.skips(b'>').then_some(())?;
            let range = self.at..cursor.at;
            self.at = cursor.at;
            let name = &text[name];
            return Some(Token::End(EndTag { name, range }));
        }
        let name_range = cursor.name()?;
        let places = cursor.attributes()?;
        let names = || places.iter().map(|(name, _)| &text[name.clone()]);
        let twice = |(n, name)| names().take(n).any(|before| before == name);
        if names().enumerate().any(twice) {
            return None;
        }
        let empty = cursor.skips(b'/');
        cursor.skips(b'>').then_some(())?;
        let range = self.at..cursor.at;
        self.at = cursor.at;
        let resolved = |(name, value): (_, Range<usize>)| self.resolved(name, value.end + 1, value);
        Some(Token::Start(StartTag {
            name: &text[name_range.clone()],
            name_range,
            range,
            attributes: places.into_iter().map(resolved).collect(),
            empty,
            closed: true,
        }))
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

    /// Skips the attributes up to the end of the tag.
    fn attributes(&mut self) -> Option<Places> {
        let mut places = Places::new();
        loop {
            let before = self.at;
            self.skip_all(|c| matches!(c, b' ' | b'\t' | b'\r' | b'\n'));
            if let Some(b'/' | b'>') = self.peek() {
                return Some(places);
            }
            (self.at > before).then_some(())?;
            let name = self.name()?;
            self.skips(b'=').then_some(())?;
            places.push((name, self.value()?));
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
