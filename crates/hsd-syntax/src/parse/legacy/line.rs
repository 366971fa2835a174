//! Lines of a source file, and the replacements of invalid characters.
//!
//! Almost every line is printable ASCII and is borrowed as it is. The others are fixed: full-width blanks and tabs
//! become blanks, full-width letters become plain ones, so that the rest of the reader sees what the author meant. A
//! map leads back to the source, so spans always cover what is written.

use crate::parse;
use hsd_base::source::{Source, Span};
use std::borrow::Cow;
use std::ops::Range;

pub(super) use crate::parse::columns::CELL;

/// A line without its line end, with invalid characters replaced.
#[derive(Debug)]
pub struct SourceLine<'a> {
    /// As written.
    pub raw: &'a str,
    /// The start of `raw` in the text of the source.
    pub at: usize,
    /// With substitutes for invalid characters.
    pub text: Cow<'a, str>,
    /// Offset in `raw` of each byte of `text` and of its end; empty where both are the same.
    map: Vec<u32>,
    /// The fixed characters.
    pub findings: Vec<Finding>,
}

/// A run of characters that were replaced, or could not be.
#[derive(Debug)]
pub struct Finding {
    /// The kind of characters.
    pub kind: Odd,
    /// Its range in `raw`.
    pub range: Range<usize>,
}

/// Kinds of characters that are not printable ASCII.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Odd {
    /// U+3000, read as two blanks.
    WideBlank,
    /// A tab, read as the blanks up to the next border of two codes.
    Tab,
    /// White space of other widths, read as one blank.
    OtherBlank,
    /// Full-width forms, read as the plain letters.
    Wide,
    /// Characters without a width, left out.
    Invisible,
    /// Control characters, read as blanks.
    Control,
    /// The replacement character of invalid bytes; reported for the file already.
    Replacement,
    /// The Japanese name of a part, read as its code.
    PartName,
    /// Everything else; kept.
    Foreign,
}

impl<'a> SourceLine<'a> {
    /// Fixes a line that begins at `at`.
    pub fn new(raw: &'a str, at: usize) -> SourceLine<'a> {
        let mut line = SourceLine {
            raw,
            at,
            text: Cow::Borrowed(raw),
            map: vec![],
            findings: vec![],
        };
        // Without an early exit the loop is vectorized.
        let odd = |odd, b: u8| odd | !(b' '..=b'~').contains(&b);
        if raw.bytes().fold(false, odd) {
            line.fix();
        }
        line
    }

    /// Returns the span of a range of `text`.
    pub fn span(&self, source: &Source, range: Range<usize>) -> Span {
        source.span(self.at + self.written(range.start)..self.at + self.written(range.end))
    }

    /// Returns the span of the whole line, without blanks at its ends.
    pub(super) fn whole(&self, source: &Source) -> Span {
        let (mut start, mut end) = (0, self.raw.len());
        // Most lines have no white space at their ends, and searching for all kinds of it takes time.
        if self.raw.starts_with(|c: char| !c.is_ascii_graphic()) {
            start = end - self.raw.trim_start().len();
        }
        if self.raw.ends_with(|c: char| !c.is_ascii_graphic()) {
            end = self.raw.trim_end().len().max(start);
        }
        source.span(self.at + start..self.at + end)
    }

    /// Returns the offset in `raw` of an offset in `text`.
    pub(super) fn written(&self, at: usize) -> usize {
        self.map.get(at).map_or(at, |&w| w as usize)
    }

    /// Returns the text that a range of `raw` was read as.
    pub(super) fn read(&self, range: Range<usize>) -> &str {
        let at = |offset: usize| self.map.partition_point(|&w| (w as usize) < offset);
        let end = at(range.end).min(self.text.len());
        match self.map[..] {
            [] => &self.text[range],
            _ => self.text.get(at(range.start)..end).unwrap_or_default(),
        }
    }

    fn fix(&mut self) {
        let mut text = String::with_capacity(self.raw.len() + CELL);
        let (mut column, mut wide_run) = (0, false);
        let mut next = 0;
        while let Some(c) = self.raw[next..].chars().next() {
            let at = next;
            next += c.len_utf8();
            let kind = odd(c);
            if kind == Some(Odd::Foreign)
                && column % CELL == 0
                && let Some((code, end)) = part_name(self.raw, at)
            {
                text.push_str(code);
                self.map.extend([at as u32; CELL]);
                column += CELL;
                self.find(Odd::PartName, at..end);
                next = after_name(self.raw, at, end);
                continue;
            }
            let before = text.len();
            match kind {
                Some(Odd::WideBlank) => text.push_str(if wide_run { " " } else { "  " }),
                Some(Odd::Tab) => (column % CELL..CELL).for_each(|_| text.push(' ')),
                Some(Odd::OtherBlank | Odd::Control) => text.push(' '),
                Some(Odd::Wide) => text.push(narrow(c)),
                Some(Odd::Invisible) => {}
                Some(Odd::Replacement | Odd::Foreign | Odd::PartName) | None => text.push(c),
            }
            // A blank typed among full-width letters is in one of their columns.
            wide_run = matches!(kind, Some(Odd::Wide)) || wide_run && c == '\u{3000}';
            column += text[before..].chars().count();
            self.map.extend((before..text.len()).map(|_| at as u32));
            if let Some(kind) = kind {
                self.find(kind, at..at + c.len_utf8());
            }
        }
        self.map.push(self.raw.len() as u32);
        self.text = Cow::Owned(text);
    }

    /// Records a character; adjacent ones of the same kind make one finding.
    fn find(&mut self, kind: Odd, range: Range<usize>) {
        match self.findings.last_mut() {
            Some(f) if f.kind == kind && f.range.end == range.start => f.range.end = range.end,
            _ => self.findings.push(Finding { kind, range }),
        }
    }
}

/// Returns the code of the part whose name is here as a word, and the end of the name.
fn part_name(raw: &str, at: usize) -> Option<(&'static str, usize)> {
    let foreign = |c: char| odd(c) == Some(Odd::Foreign);
    if raw[..at].ends_with(foreign) {
        return None;
    }
    let (part, len) = parse::builtin().named_at(&raw[at..])?;
    let end = at + len;
    (!raw[end..].starts_with(foreign)).then_some((part.code(), end))
}

/// Returns the end of a name and the blanks that pad it to whole codes.
pub(super) fn after_name(raw: &str, at: usize, end: usize) -> usize {
    let written = raw[at..end].chars().count();
    let missing = written.next_multiple_of(CELL) - written;
    let blanks = raw[end..].bytes().take(missing);
    end + blanks.take_while(|b| *b == b' ').count()
}

fn odd(c: char) -> Option<Odd> {
    Some(match c {
        ' '..='~' => return None,
        '\u{3000}' => Odd::WideBlank,
        '\t' => Odd::Tab,
        '\u{ff01}'..='\u{ff5e}' => Odd::Wide,
        '\u{200b}'..='\u{200f}' | '\u{2060}' | '\u{feff}' | '\u{ad}' => Odd::Invisible,
        '\u{fffd}' => Odd::Replacement,
        c if c.is_control() => Odd::Control,
        c if c.is_whitespace() => Odd::OtherBlank,
        _ => Odd::Foreign,
    })
}

/// Returns the plain form of a full-width character; both blocks have the same order.
fn narrow(c: char) -> char {
    char::from_u32(u32::from(c) - 0xff01 + 0x21).unwrap_or(c)
}

/// The maximum number of carriage returns that form one line end with a line feed. A file may be a megabyte of them.
const RETURNS: usize = 8;

/// Returns the ranges of the lines of a source file and of their line ends: LF, CR LF (with several CR), or CR.
pub fn lines(text: &str) -> impl Iterator<Item = (Range<usize>, Range<usize>)> + '_ {
    let bytes = text.as_bytes();
    let mut at = 0;
    std::iter::from_fn(move || {
        let start = (at < bytes.len()).then_some(at)?;
        let ends = |b: &u8| matches!(b, b'\n' | b'\r');
        let end = bytes[start..].iter().position(ends);
        let end = end.map_or(bytes.len(), |i| start + i);
        at = after_line_end(bytes, end);
        Some((start..end, end..at))
    })
}

pub(super) fn after_line_end(bytes: &[u8], end: usize) -> usize {
    let returns = bytes[end..].iter().take(RETURNS);
    let returns = returns.take_while(|&&b| b == b'\r').count();
    match bytes.get(end + returns) {
        Some(b'\n') => end + returns + 1, // CR CR LF comes from a file converted twice
        _ => end + returns.min(1),
    }
}
