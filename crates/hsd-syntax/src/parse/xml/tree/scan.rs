//! The markup of an XML file as tokens: those of quick-xml, with recovery from malformed markup.
//!
//! Left to itself quick-xml runs to the end of the file after an unclosed quote or tag, and starting it again is
//! quadratic in a file full of them. No tag contains a `<`, so quick-xml is asked for one event at a time and sees a
//! tag only up to the next `<`; comments and the like may contain one and get the rest of the file, until a search for
//! their end has failed. Unclosed markup ends at the next line that begins with `<`.

use crate::parse::reporter::Reporter;
use crate::parse::schema::SchemaHints;
use crate::parse::xml::tree::chars::{BLANKS, is_blank, is_name_start, narrow};
use crate::parse::xml::tree::token::{EndTag, Token};
use hsd_base::diagnostic::{Edit, Noun, noun};
use hsd_ir::messages::xml as say;
use memchr::memchr;
use quick_xml::Reader;
use quick_xml::events::{BytesEnd, BytesStart, Event};
use quick_xml::parser::{ElementParser, Parser};
use std::ops::Range;

/// Markup that may contain a `<`: its start, its name, its end. A document type is refused, ended or not.
const ENCLOSED: [(&str, Noun, &str); 4] = [
    ("<!--", noun("comment `<!--`", "注釈 `<!--` "), "-->"),
    (
        "<![CDATA[",
        noun("text section `<![CDATA[`", "CDATA 区間 `<![CDATA[` "),
        "]]>",
    ),
    (
        "<?",
        noun("processing instruction `<?`", "処理命令 `<?` "),
        "?>",
    ),
    ("<!DOCTYPE", noun("", ""), ">"),
];

/// The maximum length of comments that are fixed.
const LONG: usize = 1 << 16;

/// The state of the scanner.
pub(in crate::parse::xml) struct Scanner<'a, 'f> {
    pub(in crate::parse::xml) reporter: &'f mut Reporter<'a>,
    pub(in crate::parse::xml) text: &'a str,
    pub(in crate::parse::xml) at: usize,
    pub(in crate::parse::xml) habits: SchemaHints,
    /// The element whose start tag is being read.
    pub(in crate::parse::xml) element: &'a str,
    /// Those of [`ENCLOSED`] whose end was not found, so that it is not searched again.
    endless: [bool; ENCLOSED.len()],
}

impl<'a, 'f> Scanner<'a, 'f> {
    pub(in crate::parse::xml) fn new(
        reporter: &'f mut Reporter<'a>,
        at: usize,
        habits: SchemaHints,
    ) -> Self {
        Scanner {
            text: reporter.source.text(),
            reporter,
            at,
            habits,
            element: "",
            endless: [false; ENCLOSED.len()],
        }
    }

    /// Returns the next token.
    pub(in crate::parse::xml) fn token(&mut self) -> Option<Token<'a>> {
        while self.at < self.text.len() {
            let token = if self.opens_markup() {
                self.markup()
            } else {
                Some(Token::Text(self.plain()))
            };
            if token.is_some() {
                return token;
            }
        }
        None
    }

    /// Returns the next token; `None` if the markup here produces none, e.g. a comment.
    fn markup(&mut self) -> Option<Token<'a>> {
        let start = self.at;
        let token = match self.event() {
            Some(Event::Start(tag) | Event::Empty(tag)) => {
                self.sound_start(start, &tag).map(Token::Start)
            }
            Some(Event::End(tag)) => self.sound_end(start, &tag).map(Token::End),
            Some(Event::CData(_)) => {
                let range = start + 9..self.at - 3;
                self.check_characters(range.clone());
                return Some(Token::Verbatim(range));
            }
            Some(Event::Comment(_)) => return self.check_comment(start..self.at),
            Some(Event::DocType(_)) => return self.refuse(start, Some(self.at)),
            Some(Event::PI(_) | Event::Decl(_)) => {
                self.check_instruction(start..self.at);
                return None;
            }
            event => return event.map_or_else(|| self.unsound(), |_| None),
        };
        token.or_else(|| {
            self.at = start;
            self.unsound()
        })
    }

    /// Reads the markup here with quick-xml and skips it.
    fn event(&mut self) -> Option<Event<'a>> {
        let rest = self.rest();
        let inner = rest.strip_prefix('<')?;
        let kind = match inner.starts_with(['!', '?']) {
            true => ENCLOSED.iter().position(|k| rest.starts_with(k.0)),
            false => None,
        };
        let end = match kind {
            Some(kind) if self.endless[kind] => return None,
            Some(_) => rest.len(),
            None if !inner.starts_with('!') => {
                let (event, length) = tag(inner)?;
                self.at += 1 + length;
                return Some(event);
            }
            None => inner.find('<').map_or(rest.len(), |i| 1 + i),
        };
        let mut reader = Reader::from_str(&rest[..end]);
        let event = reader.read_event().ok();
        let read = reader.buffer_position() as usize;
        if event.is_some() {
            self.at += read;
        } else if let (Some(kind), true) = (kind, read == end) {
            self.endless[kind] = true;
        }
        event
    }

    /// Returns the text from here on.
    pub(in crate::parse::xml) fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    /// Returns the character here.
    pub(in crate::parse::xml) fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    /// Skips a character, and reports a full-width one.
    pub(in crate::parse::xml) fn bump(&mut self) {
        let Some(c) = self.peek() else { return };
        let range = self.at..self.at + c.len_utf8();
        self.at = range.end;
        if let Some(narrow) = narrow(c) {
            let message = |s| say::full_width_markup(s, c, narrow, &[s]);
            self.reporter.at(&range, message);
        }
    }

    /// Skips blanks, and reports full-width ones together; returns whether there were any.
    pub(in crate::parse::xml) fn blanks(&mut self) -> bool {
        let start = self.at;
        while let Some(c) = self.peek().filter(|c| is_blank(*c)) {
            let from = self.at;
            let same = self.rest().find(|d| d != c).unwrap_or(self.rest().len());
            self.at += same;
            if c == '\u{3000}' {
                self.reporter.at(&(from..self.at), say::full_width_blank);
            }
        }
        self.at > start
    }

    /// Returns true if markup begins here: `<`, or a full-width one that is clearly meant as such.
    pub(in crate::parse::xml) fn opens_markup(&self) -> bool {
        let mut rest = self.rest().chars();
        match rest.next() {
            Some('<') => true,
            Some('＜') => rest
                .next()
                .is_some_and(|c| matches!(c, '/' | '／') || c.is_ascii_alphabetic()),
            _ => false,
        }
    }

    /// Returns the start of the next line that begins with `<`, or the end of the file.
    fn resumption(&self) -> usize {
        let mut from = self.at;
        while let Some(line) = self.text[from..].find('\n') {
            from += line + 1;
            let line = &self.text[from..];
            let markup = line.trim_start_matches([' ', '\t', '\u{3000}']);
            if markup.starts_with(['<', '＜']) {
                return from + (line.len() - markup.len());
            }
        }
        self.text.len()
    }

    /// Skips text up to the next markup.
    fn plain(&mut self) -> Range<usize> {
        let (start, rest) = (self.at, self.rest());
        // The first character opens no markup, even if it is a full-width sign.
        let first = self.peek().map_or(0, char::len_utf8);
        let end = rest[first..].find(['<', '＜']);
        self.at += end.map_or(rest.len(), |i| first + i);
        for (i, end) in self.text[start..self.at].match_indices("]]>") {
            let range = start + i..start + i + end.len();
            self.reporter.at(&range, say::stray_cdata_end);
        }
        start..self.at
    }

    /// Reads malformed markup and reports its errors.
    fn unsound(&mut self) -> Option<Token<'a>> {
        let start = self.at;
        let open = self.peek().map_or(1, char::len_utf8);
        let inner = &self.text[start + open..];
        let next = inner.trim_start_matches(is_blank).chars().next();
        if inner.starts_with(['!', '?']) {
            self.endless(start)
        } else if inner.starts_with('>') {
            self.at += open + 1;
            self.reporter.at(&(start..self.at), say::nameless_tag);
            None
        } else if next.is_some_and(|c| matches!(c, '/' | '／')) {
            self.end_tag(start)
        } else if inner.starts_with(|c: char| c.is_alphanumeric() || is_name_start(c))
            || (next.is_some_and(is_name_start) && !inner.starts_with(['\r', '\n']))
        {
            Some(Token::Start(self.start_tag(start)))
        } else {
            self.at += open;
            self.reporter.at(&(start..self.at), say::bare_less_than);
            Some(Token::Verbatim(start..self.at))
        }
    }

    /// Skips `<`, and misplaced blanks after it.
    pub(in crate::parse::xml) fn open(&mut self, parts: usize) {
        for _ in 0..parts {
            self.bump();
            let from = self.at;
            self.at += self.rest().len() - self.rest().trim_start_matches(is_blank).len();
            if self.at > from {
                self.reporter.at(&(from..self.at), say::blank_before_name);
            }
        }
    }

    fn end_tag(&mut self, start: usize) -> Option<Token<'a>> {
        self.open(2);
        let name_start = self.at;
        self.at = self.name_end();
        let name = &self.text[name_start..self.at];
        let name_end = self.at;
        self.blanks();
        let junk = self.at;
        let rest = self.rest();
        // Stopping at every end tag keeps a line full of full-width ones linear.
        let stops = |&(i, c): &(usize, char)| match c {
            '＜' => rest[i + c.len_utf8()..].starts_with(['/', '／']),
            c => matches!(c, '>' | '＞' | '<' | '\n'),
        };
        let stop = rest.char_indices().find(stops);
        self.at += stop.map_or(rest.len(), |(i, _)| i);
        if matches!(self.peek(), Some('>' | '＞')) {
            if self.at > junk {
                let words = self.reporter.quote(&(junk..self.at));
                self.reporter
                    .at(&(junk..self.at), |s| say::junk_in_end_tag(s, words));
            }
            self.bump();
        } else {
            self.at = name_end;
            let end = Edit::new(self.reporter.span(&(name_end..name_end)), ">");
            self.reporter.at(&(start..name_end), |s| {
                say::tag_not_closed(s, name, false, end)
            });
        }
        let range = start..self.at;
        Some(Token::End(EndTag { name, range }))
    }

    /// Skips markup without an end.
    fn endless(&mut self, start: usize) -> Option<Token<'a>> {
        let kind = ENCLOSED.iter().find(|k| self.rest().starts_with(k.0));
        if let Some((open, what, end)) = kind.filter(|k| !k.1.en.is_empty()) {
            self.at += open.len();
            let range = start..self.at;
            self.at = self.resumption();
            let fix = self.ending(range.end..self.at, end);
            self.reporter
                .at(&range, |s| say::not_ended(s, *what, end, fix));
            return None;
        }
        let rest = self.rest();
        let stop = rest[1..].find(['<', '>']).map_or(rest.len(), |i| 1 + i);
        let end = rest[stop..].starts_with('>').then_some(self.at + stop + 1);
        self.refuse(start, end);
        self.at = end.unwrap_or_else(|| self.resumption());
        None
    }

    /// Returns the fix that closes unclosed markup, at the latest at the end of this range.
    fn ending(&self, range: Range<usize>, end: &str) -> Edit {
        let inside = self.text[range.clone()].trim_end_matches(is_blank);
        // A part of the end may be present: `--` for `-->`.
        let parts = (1..end.len()).rev().map(|i| end.split_at(i));
        let part = parts.into_iter().find(|(part, _)| inside.ends_with(part));
        let at = range.start + inside.len();
        let text = part.map_or_else(|| format!(" {end}"), |(_, rest)| rest.to_owned());
        Edit::new(self.reporter.span(&(at..at)), text)
    }

    /// Reports `<!DOCTYPE ...>`, whatever its content.
    fn refuse(&mut self, start: usize, whole: Option<usize>) -> Option<Token<'a>> {
        let word = &self.text[start..];
        let end = word.find(|c| is_blank(c) || c == '>');
        let range = start..start + end.unwrap_or(word.len());
        self.at = self.at.max(range.end);
        let whole = whole.map(|end| self.reporter.span(&(start..end)));
        self.reporter.at(&range, |s| say::document_type(s, whole));
        None
    }

    /// Reports dashes inside a comment; quick-xml finds them too, but without their place.
    fn check_comment(&mut self, comment: Range<usize>) -> Option<Token<'a>> {
        let (from, to) = (comment.start + 4, comment.end - 3);
        self.check_characters(from..to);
        let inside = &self.text[from..to];
        // `--->`: the last dash touches the end.
        let touching = inside.ends_with('-').then(|| inside.len() - 1);
        let at = from + inside.find("--").or(touching)?;
        if self.text[..at].ends_with("<!") {
            let open = self.reporter.span(&(comment.start..from));
            let within = at - 2;
            // The first line that begins with markup shows where the comment should have ended.
            let mut end = from;
            let mut lines = self.text[from..within].split_inclusive('\n').peekable();
            while let Some(line) = lines.next() {
                end += line.len();
                if lines
                    .peek()
                    .is_some_and(|l| l.trim_start().starts_with('<'))
                {
                    break;
                }
            }
            let fix = self.ending(from..end, "-->");
            self.reporter
                .at(&(within..at + 2), |s| say::comment_in_comment(s, open, fix));
        } else {
            let fix = self.undashed(from..to);
            self.reporter
                .at(&(at..at + 2), |s| say::dashes_in_comment(s, fix));
        }
        None
    }

    /// Returns edits that replace dashes inside a comment: two by a long one, a line of them by double strokes.
    fn undashed(&self, inside: Range<usize>) -> Vec<Edit> {
        let text = &self.text[inside.clone()];
        let (mut edits, mut at) = (vec![], 0);
        if !self.reporter.wanted() || text.len() > LONG {
            return edits;
        }
        while let Some(start) = text[at..].find('-').map(|i| at + i) {
            let rest = &text[start..];
            let count = rest.len() - rest.trim_start_matches('-').len();
            at = start + count;
            let last = at == text.len();
            let place = inside.start + start..inside.start + at;
            let span = self.reporter.span(&place);
            match count {
                1 if last => edits.push(Edit::new(span.after(), " ")),
                1 => {}
                2 => edits.push(Edit::new(span, "—")),
                _ => edits.push(Edit::new(span, "=".repeat(count))),
            }
        }
        edits
    }
}

/// Reads a tag whose `<` stands before this text; returns its length too. `None` if a `<` is in it, or no end.
fn tag(text: &str) -> Option<(Event<'_>, usize)> {
    let end = memchr(b'<', text.as_bytes()).unwrap_or(text.len());
    // A reader of its own for every tag would allocate for each.
    let end = ElementParser::default().feed(&text.as_bytes()[..end])?;
    let inner = &text[..end];
    let event = match (inner.strip_prefix('/'), inner.strip_suffix('/')) {
        (Some(name), _) => Event::End(BytesEnd::new(name.trim_end_matches(BLANKS))),
        (None, Some(inner)) => Event::Empty(start(inner)),
        (None, None) => Event::Start(start(inner)),
    };
    Some((event, end + 1))
}

fn start(inner: &str) -> BytesStart<'_> {
    let name = inner.find(BLANKS).unwrap_or(inner.len());
    BytesStart::from_content(inner, name)
}
