//! The text of an XML file as tokens: start tags, end tags, text. Nothing stops it.
//!
//! A general XML reader runs to the end of the file after an unclosed quote, tag or comment, and starting it again
//! there is quadratic in a file full of them. This scanner knows that `<` cannot stand inside a tag: whatever is
//! left open ends at the next line that begins with `<`, and every byte is looked at a bounded number of times.
//! The tests hold its tokens of well-formed texts against quick-xml's.

use super::faults::Faults;
use super::tag::{Attribute, is_blank, is_name_start, narrow};
use crate::diagnostic::messages::xml as say;
use std::ops::Range;

/// A piece of the file.
pub(super) enum Token<'a> {
    /// `<name ...>` or `<name .../>`.
    Start(StartTag<'a>),
    /// `</name>`.
    End(EndTag<'a>),
    /// Text that may hold references.
    Text(Range<usize>),
    /// Text that holds none.
    Verbatim(Range<usize>),
}

/// `<name ...>` or `<name .../>`.
pub(super) struct StartTag<'a> {
    pub(super) name: &'a str,
    pub(super) name_range: Range<usize>,
    pub(super) range: Range<usize>,
    pub(super) attributes: Vec<Attribute<'a>>,
    pub(super) empty: bool,
    /// Whether the `>` is there.
    pub(super) closed: bool,
}

/// `</name>`.
pub(super) struct EndTag<'a> {
    pub(super) name: &'a str,
    pub(super) range: Range<usize>,
}

/// The state of reading.
pub(super) struct Scanner<'a, 'f> {
    pub(super) faults: &'f mut Faults<'a>,
    pub(super) text: &'a str,
    pub(super) at: usize,
    /// Ends that were looked for in vain, so that nobody looks again.
    missing: Vec<&'static str>,
}

impl<'a, 'f> Scanner<'a, 'f> {
    pub(super) fn new(faults: &'f mut Faults<'a>) -> Self {
        Scanner {
            text: faults.source.text(),
            faults,
            at: 0,
            missing: vec![],
        }
    }

    /// The next token.
    pub(super) fn token(&mut self) -> Option<Token<'a>> {
        loop {
            let start = self.at;
            if start >= self.text.len() {
                return None;
            }
            if !self.opens_markup() {
                self.at = self.text_end();
                self.check_text(start..self.at);
                return Some(Token::Text(start..self.at));
            }
            if let Some(token) = self.markup() {
                return Some(token);
            }
        }
    }

    /// The text from here on.
    pub(super) fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    /// The character here.
    pub(super) fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    /// Steps over a character, and reports it if it is a full-width one.
    pub(super) fn bump(&mut self) {
        if let Some(c) = self.peek() {
            let range = self.at..self.at + c.len_utf8();
            if let Some(narrow) = narrow(c) {
                self.faults
                    .at(&range, |s| say::full_width_markup(s, c, narrow));
            }
            self.at = range.end;
        }
    }

    /// Steps over blanks; full-width ones are reported together. Whether there were any.
    pub(super) fn blanks(&mut self) -> bool {
        let start = self.at;
        while let Some(c) = self.peek().filter(|c| is_blank(*c)) {
            let from = self.at;
            let same = self.rest().find(|d| d != c).unwrap_or(self.rest().len());
            self.at += same;
            if c == '\u{3000}' {
                self.faults.at(&(from..self.at), say::full_width_blank);
            }
        }
        self.at > start
    }

    /// Whether markup begins here: `<`, or a full-width one that is surely meant so.
    pub(super) fn opens_markup(&self) -> bool {
        let mut rest = self.rest().chars();
        match rest.next() {
            Some('<') => true,
            Some('＜') => rest
                .next()
                .is_some_and(|c| matches!(c, '/' | '／' | '!' | '?') || c.is_ascii_alphabetic()),
            _ => false,
        }
    }

    /// The start of the next line that begins with `<`, or the end of the file.
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

    fn text_end(&self) -> usize {
        let rest = self.rest();
        let mut marks = rest.match_indices(['<', '＜']).map(|(i, _)| self.at + i);
        let first = marks.next().unwrap_or(self.text.len());
        // A full-width sign that opens nothing is a text of its own, so that it is never gone over twice.
        if first == self.at {
            first + self.peek().map_or(0, char::len_utf8)
        } else {
            first
        }
    }

    fn check_text(&mut self, range: Range<usize>) {
        let mut from = range.start;
        while let Some(found) = self.text[from..range.end].find("]]>") {
            let at = from + found;
            self.faults.at(&(at..at + 3), say::stray_cdata_end);
            from = at + 3;
        }
    }

    fn markup(&mut self) -> Option<Token<'a>> {
        let start = self.at;
        let open = self.peek().map_or(1, char::len_utf8);
        let inner = &self.text[start + open..];
        let next = inner.trim_start_matches(is_blank).chars().next();
        if inner.starts_with("!--") {
            self.comment(start, open);
            None
        } else if inner.starts_with("![CDATA[") {
            self.cdata(start, open)
        } else if inner.starts_with('!') {
            self.declaration(start);
            None
        } else if inner.starts_with('?') {
            self.enclosed(start, open + 1, "?>", "processing instruction `<?`");
            None
        } else if inner.starts_with('>') {
            self.at += open + 1;
            self.faults.at(&(start..self.at), say::nameless_tag);
            None
        } else if next.is_some_and(|c| matches!(c, '/' | '／')) {
            self.end_tag(start)
        } else if inner.starts_with(|c: char| c.is_alphanumeric() || is_name_start(c))
            || (next.is_some_and(is_name_start) && !inner.starts_with(['\r', '\n']))
        {
            Some(Token::Start(self.start_tag(start)))
        } else {
            self.at += open;
            self.faults.at(&(start..self.at), say::bare_less_than);
            Some(Token::Verbatim(start..self.at))
        }
    }

    /// Steps over `<`, and blanks that do not belong behind it.
    pub(super) fn open(&mut self, parts: usize) {
        for _ in 0..parts {
            self.bump();
            let from = self.at;
            self.at += self.rest().len() - self.rest().trim_start_matches(is_blank).len();
            if self.at > from {
                self.faults.at(&(from..self.at), say::blank_before_name);
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
        while self
            .peek()
            .is_some_and(|c| !matches!(c, '>' | '＞' | '<' | '\n'))
        {
            self.at += self.peek().map_or(0, char::len_utf8);
        }
        if matches!(self.peek(), Some('>' | '＞')) {
            if self.at > junk {
                self.faults.at(&(junk..self.at), say::junk_in_end_tag);
            }
            self.bump();
        } else {
            self.at = name_end;
            self.faults
                .at(&(start..name_end), |s| say::tag_not_closed(s, name, true));
        }
        let range = start..self.at;
        Some(Token::End(EndTag { name, range }))
    }

    fn comment(&mut self, start: usize, open: usize) {
        let from = start + open + 3;
        if !self.enclosed(start, open + 3, "-->", "comment `<!--`") {
            return;
        }
        let inside = &self.text[from..self.at - 3];
        if let Some(found) = inside.find("--").or(inside.ends_with('-').then(|| {
            // `--->`: the last dash touches the end.
            inside.len() - 1
        })) {
            let at = from + found;
            let open = start..from;
            if self.text[..at].ends_with("<!") {
                let open = self.faults.span(&open);
                self.faults
                    .at(&(at - 2..at + 2), |s| say::comment_in_comment(s, open));
            } else {
                self.faults.at(&(at..at + 2), say::dashes_in_comment);
            }
        }
    }

    fn cdata(&mut self, start: usize, open: usize) -> Option<Token<'a>> {
        let from = start + open + 8;
        let done = self.enclosed(start, open + 8, "]]>", "text section `<![CDATA[`");
        let range = from..self.at.saturating_sub(3);
        (done && !range.is_empty()).then_some(Token::Verbatim(range))
    }

    /// Steps over something up to its end mark; without one, up to the next line that begins with `<`.
    fn enclosed(&mut self, start: usize, open: usize, end: &'static str, what: &str) -> bool {
        self.at = start + open;
        let found = (!self.missing.contains(&end)).then(|| self.rest().find(end));
        if let Some(Some(found)) = found {
            self.at += found + end.len();
            return true;
        }
        self.give_up(end);
        self.faults
            .at(&(start..self.at), |s| say::not_ended(s, what, end));
        self.at = self.resumption();
        false
    }

    fn give_up(&mut self, end: &'static str) {
        if !self.missing.contains(&end) {
            self.missing.push(end);
        }
    }

    /// Steps over `<!DOCTYPE ...>`, which is refused whatever it holds.
    fn declaration(&mut self, start: usize) {
        let keyword = self.rest().find(|c: char| is_blank(c) || c == '>');
        let word = start..start + keyword.unwrap_or(self.rest().len());
        self.faults.at(&word, say::document_type);
        let end = (!self.missing.contains(&"doctype"))
            .then(|| declaration_end(self.rest()))
            .flatten();
        if let Some(end) = end {
            self.at += end;
        } else {
            self.give_up("doctype");
            self.at = word.end;
            self.at = self.resumption();
        }
    }
}

/// Where a declaration ends that the text begins with: quotes and the brackets of its inside are passed.
fn declaration_end(text: &str) -> Option<usize> {
    let bytes = text.as_bytes();
    let (mut at, mut depth) = (0, 0usize);
    while at < bytes.len() {
        match bytes[at] {
            b'<' if bytes[at..].starts_with(b"<!--") => at += text[at..].find("-->")? + 2,
            b'<' if bytes[at..].starts_with(b"<?") => at += text[at..].find("?>")? + 1,
            b'<' | b'[' => depth += 1,
            b']' => depth = depth.saturating_sub(1),
            quote @ (b'"' | b'\'') => {
                at += 1 + bytes[at + 1..].iter().position(|b| *b == quote)?;
            }
            b'>' => {
                depth = depth.saturating_sub(1);
                if depth == 0 {
                    return Some(at + 1);
                }
            }
            _ => {}
        }
        at += 1;
    }
    None
}
