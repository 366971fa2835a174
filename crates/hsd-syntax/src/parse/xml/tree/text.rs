//! Text with resolved references, in which every character keeps its place in the file.
//!
//! `&amp;` is one character of the text and five of the file, and a comment is none of the text; so a text has pieces
//! that map its offsets to the file.

use crate::parse::reporter::Reporter;
use crate::parse::xml::tree::chars::is_forbidden;
use hsd_base::diagnostic::messages::file;
use hsd_ir::messages::xml as say;
use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::{BytesRef, Event};
use quick_xml::reader::Reader;
use std::borrow::Cow;
use std::ops::Range;

/// Stands for a character that was reported already, so that later steps do not report it again.
pub(in crate::parse::xml) const REPORTED: char = '\u{fffd}';

/// A resolved text.
#[derive(Clone, Debug)]
pub(in crate::parse::xml) struct Text<'a> {
    text: Cow<'a, str>,
    first: TextPiece,
    more: Vec<TextPiece>,
}

/// From offset `at` of the text, the text comes from this range of the file.
#[derive(Clone, Copy, Debug)]
struct TextPiece {
    at: usize,
    from: usize,
    to: usize,
    /// True if the range is one reference, which cannot be divided.
    atom: bool,
}

impl<'a> Text<'a> {
    /// Creates a text that replaces a range of the file.
    pub(in crate::parse::xml) fn instead(text: String, place: Range<usize>) -> Text<'a> {
        let first = TextPiece {
            at: 0,
            from: place.start,
            to: place.end,
            atom: true,
        };
        Text {
            text: Cow::Owned(text),
            first,
            more: vec![],
        }
    }

    /// Returns a range of the text as a text of its own.
    pub(in crate::parse::xml) fn part(&self, range: Range<usize>) -> Text<'a> {
        let text = match &self.text {
            Cow::Borrowed(text) => Cow::Borrowed(&text[range.clone()]),
            Cow::Owned(text) => Cow::Owned(text[range.clone()].to_owned()),
        };
        let next = self.more.partition_point(|p| p.at <= range.start);
        let last = self.more.partition_point(|p| p.at < range.end);
        let mut first = next.checked_sub(1).map_or(self.first, |i| self.more[i]);
        if !first.atom {
            first.from += range.start - first.at;
        }
        first.at = 0;
        let more = &self.more[next..last.max(next)];
        let moved = |p: &TextPiece| TextPiece {
            at: p.at - range.start,
            ..*p
        };
        Text {
            text,
            first,
            more: more.iter().map(moved).collect(),
        }
    }

    /// Appends another text.
    pub(in crate::parse::xml) fn append(&mut self, other: Text<'a>) {
        if self.text.is_empty() {
            *self = other;
            return;
        }
        if other.text.is_empty() {
            return;
        }
        let by = self.text.len();
        let pieces = std::iter::once(other.first).chain(other.more);
        self.more
            .extend(pieces.map(|p| TextPiece { at: p.at + by, ..p }));
        self.text.to_mut().push_str(&other.text);
    }

    /// Shifts the places in the file.
    pub(in crate::parse::xml) fn shift(&mut self, by: usize) {
        for piece in std::iter::once(&mut self.first).chain(&mut self.more) {
            piece.from += by;
            piece.to += by;
        }
    }

    /// Returns the text without references.
    pub(in crate::parse::xml) fn as_str(&self) -> &str {
        &self.text
    }

    /// Returns the place of a range of the text in the file.
    pub(in crate::parse::xml) fn range(&self, range: Range<usize>) -> Range<usize> {
        let start = self.place(range.start).start;
        if range.end <= range.start {
            return start..start;
        }
        start..self.place(range.end - 1).end.max(start)
    }

    /// Returns the place of the whole text.
    pub(in crate::parse::xml) fn whole(&self) -> Range<usize> {
        self.range(0..self.text.len())
    }

    /// Returns the place of a byte of the text.
    fn place(&self, at: usize) -> Range<usize> {
        let piece = match self.more.partition_point(|p| p.at <= at) {
            0 => self.first,
            n => self.more[n - 1],
        };
        if piece.atom {
            return piece.from..piece.to;
        }
        let from = piece.from + (at - piece.at);
        from..from + 1
    }
}

/// A text being collected.
#[derive(Debug, Default)]
pub(in crate::parse::xml) struct Run<'a> {
    text: Cow<'a, str>,
    first: Option<TextPiece>,
    more: Vec<TextPiece>,
}

impl<'a> Run<'a> {
    /// Adds a range of the file unchanged.
    pub(in crate::parse::xml) fn literal(&mut self, whole: &'a str, range: Range<usize>) {
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
    pub(in crate::parse::xml) fn atom(&mut self, character: char, range: Range<usize>) {
        self.piece(range, true);
        self.text.to_mut().push(character);
    }

    /// Adds a range of the file with its references, as quick-xml finds them, resolved; invalid ones are reported.
    pub(in crate::parse::xml) fn raw(&mut self, range: Range<usize>, reporter: &mut Reporter<'a>) {
        let whole = reporter.source.text();
        if range.is_empty() {
            return;
        }
        // Nearly all text has no reference to resolve, and most of it no character that XML forbids.
        let bytes = &whole.as_bytes()[range.clone()];
        let special = |byte: &u8| matches!(byte, b'&' | b'<');
        let plain = |byte: &u8| matches!(byte, b' '..=b'~') && !special(byte);
        if bytes.iter().all(plain) {
            return self.literal(whole, range);
        }
        if !bytes.iter().any(special) {
            return self.plain(range, reporter);
        }
        let mut from = range.start;
        // Only a value can contain `<`, which was reported then.
        for (i, part) in whole[range].split('<').enumerate() {
            if i > 0 {
                self.literal(whole, from..from + 1);
                from += 1;
            }
            let end = from + part.len();
            let mut reader = Reader::from_str(part);
            reader.config_mut().allow_dangling_amp = true;
            while from < end {
                let event = reader.read_event();
                let to = end - reader.get_ref().len();
                match event {
                    Ok(Event::GeneralRef(body)) => self.reference(&body, from..to, reporter),
                    _ => self.plain(from..to, reporter),
                }
                from = to;
            }
        }
    }

    /// Returns the finished text, if there is any; this run is empty then.
    pub(in crate::parse::xml) fn take(&mut self) -> Option<Text<'a>> {
        let run = std::mem::take(self);
        Some(Text {
            first: run.first?,
            text: run.text,
            more: run.more,
        })
    }

    /// Returns the finished text of an attribute that begins at `start`: line ends and tabs are blanks there.
    pub(in crate::parse::xml) fn value(mut self, start: usize) -> Text<'a> {
        if self.text.contains(['\t', '\n', '\r']) {
            self.text = Cow::Owned(self.text.replace(['\t', '\n', '\r'], " "));
        }
        let nothing = TextPiece {
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

    /// Adds a range without references; an `&` that begins it and control characters are reported.
    fn plain(&mut self, range: Range<usize>, reporter: &mut Reporter<'a>) {
        let whole = reporter.source.text();
        if whole[range.clone()].starts_with('&') {
            reporter.at(&(range.start..range.start + 1), say::bare_ampersand);
        }
        let mut from = range.start;
        for (i, found) in whole[range.clone()].match_indices(is_forbidden) {
            let here = range.start + i..range.start + i + found.len();
            if from < here.start {
                self.literal(whole, from..here.start);
            }
            let character = found.chars().next().unwrap_or(REPORTED);
            reporter.at(&here, |s| file::control_character(s, character));
            from = here.end;
            self.atom(REPORTED, here);
        }
        if from < range.end {
            self.literal(whole, from..range.end);
        }
    }

    /// Adds the character of a reference; text that merely lies between `&` and `;` is none.
    fn reference(&mut self, body: &BytesRef<'_>, range: Range<usize>, reporter: &mut Reporter<'a>) {
        let fits = |c: char| c.is_alphanumeric() || matches!(c, '#' | '_' | '-' | '.' | ':');
        if body.is_empty() || body.len() >= 40 || !body.chars().all(fits) {
            return self.plain(range, reporter);
        }
        let allowed = |c: &char| matches!(c, '\t' | '\n' | '\r' | ' '..='\u{fffd}' | '\u{10000}'..);
        let character = match body.resolve_char_ref() {
            Ok(None) => resolve_predefined_entity(body).and_then(|c| c.chars().next()),
            number => number.ok().flatten().filter(allowed),
        };
        if character.is_none() {
            let quoted = reporter.quote(&range);
            reporter.at(&range, |s| say::unknown_entity(s, quoted));
        }
        self.atom(character.unwrap_or(REPORTED), range);
    }

    fn piece(&mut self, range: Range<usize>, atom: bool) {
        let piece = TextPiece {
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
