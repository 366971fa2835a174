//! Start tags: names and attributes, with everything that can be wrong inside `<` and `>`.

use super::faults::Faults;
use super::scan::{Scanner, StartTag};
use super::text::{Run, Text};
use crate::diagnostic::messages::xml as say;
use std::ops::Range;

/// `name="value"`.
pub(super) struct Attribute<'a> {
    pub(super) name: &'a str,
    pub(super) name_range: Range<usize>,
    pub(super) value: Text<'a>,
    /// Name, `=` and value with its quotes.
    pub(super) range: Range<usize>,
    /// Whether something was wrong with it, so that nobody complains of it again.
    pub(super) faulty: bool,
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

fn is_name(name: &str) -> bool {
    let fits = |c: char| c.is_alphanumeric() || !c.is_ascii() || "_:-.".contains(c);
    name.starts_with(is_name_start) && name.chars().all(fits)
}

/// Reports a name that XML does not allow; whether it is one.
fn check_name(name: &str, range: &Range<usize>, faults: &mut Faults<'_>) -> bool {
    let good = is_name(name);
    if !good {
        faults.at(range, |s| say::bad_name(s, name));
    }
    good
}

impl<'a> Scanner<'a, '_> {
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
        check_name(name, &name_range, self.faults);
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
        let mut faulty = !check_name(name, &name_range, self.faults);
        let value = self.value(name, &name_range, &mut faulty);
        let mut run = Run::default();
        run.raw(value.clone(), self.faults);
        Some(Attribute {
            name,
            range: name_range.start..self.at,
            name_range,
            value: run.value(value.start),
            faulty,
        })
    }

    /// Reads `=` and a value, or what stands in their place; the range within the quotes.
    fn value(
        &mut self,
        name: &'a str,
        name_range: &Range<usize>,
        faulty: &mut bool,
    ) -> Range<usize> {
        self.skip_plain_blanks();
        let equals = matches!(self.peek(), Some('=' | '＝'));
        if equals {
            self.bump();
            self.skip_plain_blanks();
        }
        let quote = self.peek().filter(|c| "\"'“”„＂‘’＇".contains(*c));
        match (equals, quote) {
            (true, Some(quote)) => self.quoted(name, quote),
            (false, Some(quote)) => {
                *faulty = true;
                self.faults.at(name_range, |s| say::equals_missing(s, name));
                self.quoted(name, quote)
            }
            (true, None) => {
                *faulty = true;
                self.unquoted(name, name_range)
            }
            (false, None) => {
                *faulty = true;
                self.at = name_range.end;
                self.faults.at(name_range, |s| say::value_missing(s, name));
                self.at..self.at
            }
        }
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

    fn skip_plain_blanks(&mut self) {
        if self.peek().is_some_and(is_blank) {
            self.blanks();
        }
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

    fn unquoted(&mut self, name: &'a str, name_range: &Range<usize>) -> Range<usize> {
        let start = self.at;
        while let Some(c) = self.peek() {
            let slash =
                matches!(c, '/' | '／') && self.rest()[c.len_utf8()..].starts_with(['>', '＞']);
            if slash || is_blank(c) || matches!(c, '<' | '＜' | '>' | '＞') {
                break;
            }
            self.at += c.len_utf8();
        }
        let value = start..self.at;
        if value.is_empty() {
            self.faults.at(name_range, |s| say::value_missing(s, name));
        } else {
            let text = self.faults.quote(&value).trim_matches(['"', '\'', '”']);
            self.faults
                .at(&value, |s| say::value_not_quoted(s, name, text));
        }
        value
    }
}

/// Whether a text goes on with `name=`.
fn names_attribute(text: &str) -> bool {
    let name = text.find(ends_name).unwrap_or(text.len());
    is_name(&text[..name]) && text[name..].starts_with(['=', '＝'])
}

/// Reports attributes of the same name and keeps the first of them.
fn report_twins(attributes: &mut [Attribute<'_>], faults: &mut Faults<'_>) {
    let mut order: Vec<usize> = (0..attributes.len()).collect();
    order.sort_by_key(|i| (attributes[*i].name, *i));
    let mut first = 0;
    for pair in 1..order.len() {
        if attributes[order[first]].name != attributes[order[pair]].name {
            first = pair;
            continue;
        }
        let before = faults.span(&attributes[order[first]].name_range);
        let twin = &mut attributes[order[pair]];
        twin.faulty = true;
        let name = twin.name;
        faults.at(&twin.name_range, |s| {
            say::attribute_twice(s, name, name, before)
        });
    }
}
