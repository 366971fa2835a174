//! Texts whose references are resolved while every character still knows its place in the file.
//!
//! `&amp;` is one character of the text and five of the file, a comment is none of the text; so a text
//! carries pieces that map its offsets back.

use super::faults::Faults;
use crate::diagnostic::messages::{file, xml as say};
use std::borrow::Cow;
use std::ops::Range;

/// Stands for a character that was reported already, so that later steps keep quiet about it.
pub(super) const REPORTED: char = '\u{fffd}';

/// A resolved text.
#[derive(Clone, Debug)]
pub(super) struct Text<'a> {
    text: Cow<'a, str>,
    first: Piece,
    more: Vec<Piece>,
}

/// From offset `at` of the text on, it comes from this range of the file's text.
#[derive(Clone, Copy, Debug)]
struct Piece {
    at: usize,
    from: usize,
    to: usize,
    /// The range is one reference, which cannot be divided.
    atom: bool,
}

impl Text<'_> {
    /// The text without references.
    pub(super) fn as_str(&self) -> &str {
        &self.text
    }

    /// Where a range of the text stands in the file's text.
    pub(super) fn range(&self, range: Range<usize>) -> Range<usize> {
        let first = self.piece(range.start);
        let start = if first.atom {
            first.from
        } else {
            first.from + (range.start - first.at)
        };
        if range.end <= range.start {
            return start..start;
        }
        let last = self.piece(range.end - 1);
        let end = if last.atom {
            last.to
        } else {
            last.from + (range.end - last.at)
        };
        start..end.max(start)
    }

    /// Where the whole text stands.
    pub(super) fn whole(&self) -> Range<usize> {
        self.range(0..self.text.len())
    }

    fn piece(&self, at: usize) -> Piece {
        match self.more.partition_point(|p| p.at <= at) {
            0 => self.first,
            n => self.more[n - 1],
        }
    }
}

/// A text in the making.
#[derive(Debug, Default)]
pub(super) struct Run<'a> {
    text: Cow<'a, str>,
    first: Option<Piece>,
    more: Vec<Piece>,
}

impl<'a> Run<'a> {
    /// Adds a range of the file as it stands.
    pub(super) fn literal(&mut self, whole: &'a str, range: Range<usize>) {
        let slice = &whole[range.clone()];
        let last = self.more.last_mut().or(self.first.as_mut());
        if let Some(last) = last.filter(|p| !p.atom && p.to == range.start) {
            last.to = range.end;
        } else {
            self.piece(range, false);
        }
        if self.text.is_empty() {
            self.text = Cow::Borrowed(slice);
        } else {
            self.text.to_mut().push_str(slice);
        }
    }

    /// Adds one character for a range of the file.
    pub(super) fn atom(&mut self, character: char, range: Range<usize>) {
        self.piece(range, true);
        self.text.to_mut().push(character);
    }

    /// Adds a range of the file with its references resolved; bad ones are reported.
    pub(super) fn raw(&mut self, range: Range<usize>, faults: &mut Faults<'a>) {
        let whole = faults.source.text();
        let mut from = range.start;
        while let Some(found) = whole.as_bytes()[from..range.end]
            .iter()
            .position(|&b| b == b'&' || (b < b' ' && !matches!(b, b'\t' | b'\n' | b'\r')))
        {
            let at = from + found;
            if at > from {
                self.literal(whole, from..at);
            }
            from = self.special(at, range.end, faults);
        }
        if from < range.end {
            self.literal(whole, from..range.end);
        }
    }

    /// The finished text, if there is any; this run is empty then.
    pub(super) fn take(&mut self) -> Option<Text<'a>> {
        let run = std::mem::take(self);
        Some(Text {
            first: run.first?,
            text: run.text,
            more: run.more,
        })
    }

    /// The finished text of an attribute that begins at `start`: line ends and tabs are blanks there.
    pub(super) fn value(mut self, start: usize) -> Text<'a> {
        if self.text.contains(['\t', '\n', '\r']) {
            self.text = Cow::Owned(self.text.replace(['\t', '\n', '\r'], " "));
        }
        let nothing = Piece {
            at: 0,
            from: start,
            to: start,
            atom: false,
        };
        Text {
            text: self.text,
            first: self.first.unwrap_or(nothing),
            more: self.more,
        }
    }

    /// Handles the `&` or control character at `at`; returns where reading goes on.
    fn special(&mut self, at: usize, end: usize, faults: &mut Faults<'a>) -> usize {
        let whole = faults.source.text();
        let rest = &whole[at..end];
        let Some(body) = reference(rest) else {
            let range = at..at + 1;
            if rest.starts_with('&') {
                faults.at(&range, say::bare_ampersand);
                self.literal(whole, range);
            } else {
                let character = char::from(whole.as_bytes()[at]);
                faults.at(&range, |s| file::control_character(s, character));
                self.atom(REPORTED, range);
            }
            return at + 1;
        };
        let range = at..at + body.len() + 2;
        let character = match body {
            "lt" => Some('<'),
            "gt" => Some('>'),
            "amp" => Some('&'),
            "quot" => Some('"'),
            "apos" => Some('\''),
            _ => numbered(body),
        };
        if character.is_none() {
            faults.at(&range, |s| say::unknown_entity(s, &rest[..body.len() + 2]));
        }
        self.atom(character.unwrap_or(REPORTED), range.clone());
        range.end
    }

    fn piece(&mut self, range: Range<usize>, atom: bool) {
        let piece = Piece {
            at: self.text.len(),
            from: range.start,
            to: range.end,
            atom,
        };
        match self.first {
            None => self.first = Some(piece),
            Some(_) => self.more.push(piece),
        }
    }
}

/// What stands between `&` and `;` at the start of a text, if it looks like a reference.
fn reference(rest: &str) -> Option<&str> {
    let body = rest.strip_prefix('&')?;
    let semicolon = body.bytes().take(40).position(|b| b == b';')?;
    let body = body.get(..semicolon)?;
    let fits = |c: char| c.is_alphanumeric() || matches!(c, '#' | '_' | '-' | '.' | ':');
    (!body.is_empty() && body.chars().all(fits)).then_some(body)
}

/// The character of `#12` or `#x1F`, if XML allows it.
fn numbered(body: &str) -> Option<char> {
    let digits = body.strip_prefix('#')?;
    let number = match digits.strip_prefix('x') {
        Some(hex) if !hex.starts_with('+') => u32::from_str_radix(hex, 16),
        None if !digits.starts_with('+') => digits.parse(),
        _ => return None,
    };
    let character = char::from_u32(number.ok()?)?;
    let allowed = matches!(character, '\t' | '\n' | '\r' | ' '..='\u{fffd}' | '\u{10000}'..);
    allowed.then_some(character)
}
