//! Tags: those that quick-xml reads and nothing is wrong with, and everything that can be wrong inside `<` and `>`.

use super::scan::{EndTag, Scanner, StartTag};
use super::text::{Run, Text};
use crate::diagnostic::messages::xml as say;
use crate::parse::faults::Faults;
use quick_xml::events::{BytesEnd, BytesStart};
use std::collections::HashMap;
use std::ops::Range;

/// `name="value"`.
#[derive(Clone)]
pub(super) struct Attribute<'a> {
    pub(super) name: &'a str,
    pub(super) name_range: Range<usize>,
    pub(super) value: Text<'a>,
    /// Name, `=` and value with its quotes.
    pub(super) range: Range<usize>,
    /// Whether something was wrong with it, so that nobody complains of it again.
    pub(super) faulty: bool,
}

impl Attribute<'_> {
    /// Whether it is other programs' business: name spaces, schema locations, xml:lang.
    pub(super) fn is_foreign(&self) -> bool {
        self.name.contains(':') || self.name == "xmlns"
    }
}

/// How a start tag ends.
enum End {
    Open,
    Empty,
    /// Without `>`; `true` = there was a `/`.
    Missing(bool),
}

/// White space of XML, and the full-width blank that Japanese input methods put in its place.
pub(super) fn is_blank(c: char) -> bool {
    matches!(c, ' ' | '\t' | '\r' | '\n' | '\u{3000}')
}

/// Whether a name may begin with it.
pub(super) fn is_name_start(c: char) -> bool {
    c.is_alphabetic() || c == '_' || c == ':'
}

/// What a full-width mark of a tag stands for.
pub(super) fn narrow(c: char) -> Option<char> {
    Some(match c {
        '＜' => '<',
        '＞' => '>',
        '／' => '/',
        '＝' => '=',
        '“' | '”' | '„' | '＂' => '"',
        '‘' | '’' | '＇' => '\'',
        _ => return None,
    })
}

/// Whether a name ends before it.
fn ends_name(c: char) -> bool {
    is_blank(c) || narrow(c).is_some() || matches!(c, '<' | '>' | '/' | '=' | '"' | '\'')
}

/// The marks that close what this one opens: any of its kind, since input methods mix them.
fn closers(open: char) -> &'static [char] {
    match open {
        '"' => &['"'],
        '\'' => &['\''],
        '“' | '”' | '„' | '＂' => &['”', '“', '＂', '"'],
        _ => &['’', '‘', '＇', '\''],
    }
}

/// Whether XML allows it as a name.
pub(super) fn is_name(name: &str) -> bool {
    let fits = |c: char| c.is_alphanumeric() || !c.is_ascii() || "_:-.".contains(c);
    name.starts_with(is_name_start) && name.chars().all(fits)
}

impl<'a> Scanner<'a, '_> {
    /// The tag that quick-xml has read, if nothing is wrong with it.
    pub(super) fn sound_start(
        &mut self,
        start: usize,
        tag: &BytesStart<'_>,
    ) -> Option<StartTag<'a>> {
        let name_range = self.sound_name(tag.name().as_ref())?;
        let mut places = vec![];
        for attribute in tag.attributes() {
            let attribute = attribute.ok()?;
            let name = self.sound_name(attribute.key.as_ref())?;
            self.text[..name.start].ends_with(is_blank).then_some(())?;
            places.push((name, self.range(&attribute.value)));
        }
        let places = places.into_iter();
        Some(StartTag {
            name: &self.text[name_range.clone()],
            name_range,
            range: start..self.at,
            attributes: places
                .map(|(n, v)| self.resolved(n, v.end + 1, v))
                .collect(),
            empty: self.text[..self.at].ends_with("/>"),
            closed: true,
        })
    }

    /// The end tag that quick-xml has read, if nothing is wrong with it.
    pub(super) fn sound_end(&self, start: usize, tag: &BytesEnd<'_>) -> Option<EndTag<'a>> {
        let name = &self.text[self.sound_name(tag.name().as_ref())?];
        let range = start..self.at;
        Some(EndTag { name, range })
    }

    /// Where a name stands that quick-xml has found, if it is one.
    fn sound_name(&self, name: &str) -> Option<Range<usize>> {
        (is_name(name) && !name.contains(ends_name)).then(|| self.range(name))
    }

    /// Where a part of the text stands in it.
    fn range(&self, part: &str) -> Range<usize> {
        let start = part.as_ptr() as usize - self.text.as_ptr() as usize;
        start..start + part.len()
    }

    /// Reports a name that XML does not allow; whether it is one.
    fn check_name(&mut self, range: &Range<usize>) -> bool {
        let name = self.faults.quote(range);
        if !is_name(name) {
            self.faults.at(range, |s| say::bad_name(s, name));
        }
        is_name(name)
    }

    /// The end of a name that begins here.
    pub(super) fn name_end(&self) -> usize {
        let rest = self.rest();
        self.at + rest.find(ends_name).unwrap_or(rest.len())
    }

    /// Reads a start tag.
    pub(super) fn start_tag(&mut self, start: usize) -> StartTag<'a> {
        self.open(1);
        let name_range = self.at..self.name_end();
        let name = &self.text[name_range.clone()];
        self.check_name(&name_range);
        self.at = name_range.end;
        let mut attributes = vec![];
        let (empty, closed) = match self.attributes(&mut attributes) {
            End::Open => (false, true),
            End::Empty => (true, true),
            End::Missing(slash) => {
                let range = start..name_range.end;
                self.faults
                    .at(&range, |s| say::tag_not_closed(s, name, slash));
                (slash, false)
            }
        };
        report_twins(&mut attributes, self.faults);
        StartTag {
            name,
            name_range,
            range: start..self.at,
            attributes,
            empty,
            closed,
        }
    }

    fn attributes(&mut self, list: &mut Vec<Attribute<'a>>) -> End {
        loop {
            let before = self.at;
            let spaced = self.blanks();
            if self.text[before..self.at].contains('\n') && self.is_text_line() {
                self.at = before;
                return End::Missing(false);
            }
            match self.peek() {
                None => return End::Missing(false),
                Some('<' | '＜') if self.opens_markup() => return End::Missing(false),
                Some('>' | '＞') => {
                    self.bump();
                    return End::Open;
                }
                Some('/' | '／') => {
                    if let Some(end) = self.slash() {
                        return end;
                    }
                }
                Some(_) => {
                    if !spaced && !list.is_empty() {
                        let here = self.at..self.at;
                        self.faults.at(&here, say::no_blank_between);
                    }
                    list.extend(self.attribute());
                }
            }
        }
    }

    /// Whether a line of codes begins here rather than one of attributes.
    fn is_text_line(&self) -> bool {
        let line = self.rest().split(['\n', '<']).next().unwrap_or_default();
        !line.trim().is_empty() && !line.contains(['=', '＝', '>', '＞', '/', '／', '"', '\''])
    }

    /// Reads the `/` before `>`; any other is reported and passed.
    fn slash(&mut self) -> Option<End> {
        let start = self.at;
        self.bump();
        let after = self.at;
        self.at += self.rest().len() - self.rest().trim_start_matches(is_blank).len();
        match self.peek() {
            Some('>' | '＞') => {
                if self.at > after {
                    self.faults.at(&(after..self.at), say::blank_before_closing);
                }
                self.bump();
                Some(End::Empty)
            }
            None | Some('<') => Some(End::Missing(true)),
            _ => {
                self.faults
                    .at(&(start..after), |s| say::stray_in_tag(s, "/"));
                None
            }
        }
    }

    fn attribute(&mut self) -> Option<Attribute<'a>> {
        let name_range = self.at..self.name_end();
        if name_range.is_empty() {
            self.nameless();
            return None;
        }
        let name = &self.text[name_range.clone()];
        self.at = name_range.end;
        let good = self.check_name(&name_range);
        let (value, whole) = self.value(name, &name_range);
        let attribute = self.resolved(name_range, self.at, value);
        let faulty = !(good && whole);
        Some(Attribute {
            faulty,
            ..attribute
        })
    }

    /// The attribute of a name and a value that stand here, up to its end.
    fn resolved(&mut self, name: Range<usize>, end: usize, value: Range<usize>) -> Attribute<'a> {
        let mut run = Run::default();
        run.raw(value.clone(), self.faults);
        Attribute {
            name: &self.text[name.clone()],
            range: name.start..end,
            name_range: name,
            value: run.value(value.start),
            faulty: false,
        }
    }

    /// Reads `=` and a value, or what stands in their place; the range within the quotes, and whether all is there.
    fn value(&mut self, name: &'a str, place: &Range<usize>) -> (Range<usize>, bool) {
        self.blanks();
        let equals = matches!(self.peek(), Some('=' | '＝'));
        if equals {
            self.bump();
            self.blanks();
        }
        let quote = self.peek().filter(|c| "\"'“”„＂‘’＇".contains(*c));
        let value = match (equals, quote) {
            (true, None) => self.unquoted(name, place),
            (_, Some(quote)) => {
                if !equals {
                    self.faults.at(place, |s| say::equals_missing(s, name));
                }
                self.quoted(name, quote)
            }
            (false, None) => {
                self.at = place.end;
                self.faults.at(place, |s| say::value_missing(s, name));
                self.at..self.at
            }
        };
        (value, equals && quote.is_some())
    }

    /// Steps over something that cannot begin an attribute.
    fn nameless(&mut self) {
        let start = self.at;
        let first = self.peek().unwrap_or('=');
        if narrow(first).unwrap_or(first) == '=' {
            self.at += self.rest().len() - self.rest().trim_start_matches(first).len();
        } else if "\"'“”„＂‘’＇".contains(first) {
            // A value without a name, if it ends soon and on this line; else a quote too many.
            let from = start + first.len_utf8();
            let near = self.text[from..].char_indices().take(100);
            let mut line = near.take_while(|(_, c)| !matches!(c, '\n' | '<' | '>'));
            let close = line.find(|(_, c)| closers(first).contains(c));
            self.at = close.map_or(from, |(i, c)| from + i + c.len_utf8());
        } else {
            self.at += first.len_utf8();
        }
        let range = start..self.at;
        let junk = self.faults.quote(&range);
        self.faults.at(&range, |s| say::stray_in_tag(s, junk));
    }

    /// Reads a value up to its closing quote; the range within the quotes.
    fn quoted(&mut self, name: &'a str, quote: char) -> Range<usize> {
        let open = self.at;
        self.bump();
        let from = self.at;
        let limit = self.value_limit(quote);
        let close = self.text[from..limit]
            .find(closers(quote))
            .map(|i| from + i);
        let end = match close {
            Some(close) if !self.runs_on(from..close) => {
                self.at = close;
                self.bump();
                close
            }
            _ => {
                let end = self.guess_end(from..close.unwrap_or(limit));
                if self.at == end {
                    let head = open..from;
                    self.faults.at(&head, |s| say::quote_not_closed(s, name));
                }
                end
            }
        };
        if let Some(i) = self.text[from..end].find('<') {
            self.faults
                .at(&(from + i..from + i + 1), say::less_than_in_value);
        }
        from..end
    }

    /// Where a value that begins here ends at the latest: its closing quote, or a line that begins with `<`.
    fn value_limit(&self, quote: char) -> usize {
        let mut line_start = false;
        for (i, c) in self.rest().char_indices() {
            let closes = closers(quote).contains(&c);
            if closes {
                return self.at + i + c.len_utf8();
            }
            match c {
                '\n' => line_start = true,
                '<' | '＜' if line_start => return self.at + i,
                c if !is_blank(c) => line_start = false,
                _ => {}
            }
        }
        self.text.len()
    }

    /// Whether the closing quote of a value is really the opening one of the next attribute: ` next=` stands before
    /// it and no end of a tag or value behind.
    fn runs_on(&self, value: Range<usize>) -> bool {
        let Some(before) = self.text[value.clone()]
            .trim_end()
            .strip_suffix(['=', '＝'])
        else {
            return false;
        };
        let before = before.trim_end();
        let blank = before.rfind(is_blank).map_or(0, |i| i + 1);
        let after = self.text[value.end..].chars().nth(1);
        before.contains(is_blank)
            && before.get(blank..).is_none_or(is_name)
            && after.is_some_and(|c| !is_blank(c) && !matches!(c, '>' | '/'))
    }

    /// The likely end of a value whose closing quote is missing; reading goes on behind it.
    fn guess_end(&mut self, value: Range<usize>) -> usize {
        let text = &self.text[value.clone()];
        let line = &text[..text.find('\n').unwrap_or(text.len())];
        let end = if let Some(close) = line.find(['”', '“', '＂', '’', '＇']) {
            // The value was closed after all, by a mark that only looks like one.
            self.at = value.start + close;
            self.bump();
            return value.start + close;
        } else if let Some(tag) = line.find('>') {
            line[..tag].trim_end_matches('/').len()
        } else {
            let mut blanks = line.match_indices(is_blank);
            blanks
                .find(|(i, blank)| names_attribute(&line[i + blank.len()..]))
                .map_or(line.trim_end().len(), |(i, _)| i)
        };
        self.at = value.start + end;
        self.at
    }

    fn unquoted(&mut self, name: &'a str, place: &Range<usize>) -> Range<usize> {
        let (start, rest) = (self.at, self.rest());
        if let Some(inner) = bracketed(rest) {
            let value = start + inner.start..start + inner.end;
            let close = self.text[value.end..].chars().next();
            self.at = value.end + close.map_or(0, char::len_utf8);
            let text = self.faults.quote(&value);
            self.faults
                .at(&(start..self.at), |s| say::value_in_brackets(s, name, text));
            return value;
        }
        let stops = |(i, c): &(usize, char)| match c {
            '/' | '／' => rest[i + c.len_utf8()..].starts_with(['>', '＞']),
            c => is_blank(*c) || matches!(c, '<' | '＜' | '>' | '＞'),
        };
        let stop = rest.char_indices().find(stops);
        self.at += stop.map_or(rest.len(), |(i, _)| i);
        let value = start..self.at;
        if value.is_empty() {
            self.faults.at(place, |s| say::value_missing(s, name));
        } else {
            let text = self.faults.quote(&value).trim_matches(['"', '\'', '”']);
            self.faults
                .at(&value, |s| say::value_not_quoted(s, name, text));
        }
        value
    }
}

/// The range within the brackets that begin a text, if they are quotation marks of another script and end soon.
fn bracketed(text: &str) -> Option<Range<usize>> {
    const PAIRS: [(char, &[char]); 5] = [
        ('「', &['」']),
        ('『', &['』']),
        ('｢', &['｣']),
        ('«', &['»']),
        ('〝', &['〟', '〞']),
    ];
    let open = text.chars().next()?;
    let (_, close) = PAIRS.iter().find(|(o, _)| *o == open)?;
    let from = open.len_utf8();
    let line = text[from..].split(['\n', '<', '>']).next()?;
    Some(from..from + line.find(*close)?)
}

/// Whether a text goes on with `name=`.
fn names_attribute(text: &str) -> bool {
    let name = text.find(ends_name).unwrap_or(text.len());
    is_name(&text[..name]) && text[name..].starts_with(['=', '＝'])
}

/// Reports attributes of the same name and keeps the first of them.
fn report_twins(attributes: &mut [Attribute<'_>], faults: &mut Faults<'_>) {
    let mut first = HashMap::new();
    for twin in attributes {
        let (name, span) = (twin.name, faults.span(&twin.name_range));
        let before = *first.entry(name).or_insert(span);
        if before != span {
            twin.faulty = true;
            faults.push(|| say::attribute_twice(span, name, name, before));
        }
    }
}
