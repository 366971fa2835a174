//! The values of attributes, in quotes or in characters mistaken for them.

use crate::parse::xml::tree::chars::{ends_name, is_blank, is_name, narrow};
use crate::parse::xml::tree::scan::Scanner;
use hsd_base::diagnostic::Edit;
use hsd_base::source::Span;
use hsd_ir::messages::xml as say;
use std::ops::Range;

/// More repetitions of one sign than a value can contain by mistake.
const MANY: usize = 1000;

/// Returns the marks that close this one: any of its kind, since input methods mix them.
pub(in crate::parse::xml) fn closers(open: char) -> &'static [char] {
    match open {
        '"' => &['"'],
        '\'' => &['\''],
        '“' | '”' | '„' | '＂' => &['”', '“', '＂', '"'],
        _ => &['’', '‘', '＇', '\''],
    }
}

impl<'a> Scanner<'a, '_> {
    /// Reads `=` and a value, or what is in their place; returns the range within the quotes, and whether it is
    /// complete.
    pub(in crate::parse::xml) fn value(
        &mut self,
        name: &'a str,
        place: &Range<usize>,
    ) -> (Range<usize>, bool) {
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
                    let gap = self.reporter.span(&(place.end..self.at));
                    self.reporter
                        .at(place, |s| say::equals_missing(s, name, gap));
                }
                self.quoted(name, quote)
            }
            (false, None) => {
                self.at = place.end;
                self.missing(name, place);
                self.at..self.at
            }
        };
        (value, equals && quote.is_some())
    }

    /// Reports an attribute without a value, which ends here.
    fn missing(&mut self, name: &str, place: &Range<usize>) {
        let element = self.element;
        let range = place.start..self.at;
        let whole = self.reporter.span(&range);
        let switch = (self.habits.switch)(element, name);
        let spared = (!(self.habits.needs)(element, name)).then(|| self.reporter.with_gap(&range));
        self.reporter.at(place, |s| {
            say::value_missing(s, name, whole, switch, spared)
        });
    }

    /// Reads a value up to its closing quote; returns the range within the quotes.
    fn quoted(&mut self, name: &'a str, quote: char) -> Range<usize> {
        let open = self.at;
        let from = open + quote.len_utf8();
        self.at = from;
        let limit = self.value_limit(quote);
        let close = self.text[from..limit]
            .find(closers(quote))
            .map(|i| from + i);
        let end = match close {
            Some(close) if !self.runs_on(from..close) => {
                self.at = close;
                self.skip();
                close
            }
            _ => self.guess_end(from..close.unwrap_or(limit)),
        };
        let plain = narrow(quote).unwrap_or(quote);
        self.wide_marks(&[open..from, end..self.at], plain);
        if self.at == end {
            let fix = Edit::new(self.reporter.span(&(end..end)), plain);
            self.reporter
                .at(&(open..from), |s| say::quote_not_closed(s, name, fix));
        }
        self.signs(from..end);
        from..end
    }

    /// Skips a character.
    fn skip(&mut self) {
        self.at += self.peek().map_or(0, char::len_utf8);
    }

    /// Reports the full-width marks around a value, which `plain` should replace.
    fn wide_marks(&mut self, marks: &[Range<usize>; 2], plain: char) {
        let first = |mark: &Range<usize>| self.text[mark.clone()].chars().next();
        let wide = marks.iter().filter_map(|mark| {
            let c = first(mark).filter(|c| narrow(*c).is_some())?;
            Some((c, mark))
        });
        let wide: Vec<(char, &Range<usize>)> = wide.collect();
        let all: Vec<Span> = wide
            .iter()
            .map(|(_, mark)| self.reporter.span(mark))
            .collect();
        for (c, mark) in wide {
            self.reporter
                .at(mark, |s| say::full_width_markup(s, c, plain, &all));
        }
    }

    /// Reports the first `<` in a value.
    fn signs(&mut self, value: Range<usize>) {
        let mut signs = self.text[value.clone()].match_indices('<');
        let Some((first, _)) = signs.next() else {
            return;
        };
        let place = |i: usize| value.start + i..value.start + i + 1;
        let few = if self.reporter.wanted() { MANY } else { 0 };
        let all = [first].into_iter().chain(signs.map(|(i, _)| i).take(few));
        let all: Vec<Span> = all.map(|i| self.reporter.span(&place(i))).collect();
        self.reporter
            .at(&place(first), |s| say::less_than_in_value(s, &all));
    }

    /// Returns the latest possible end of a value that begins here: its closing quote, or a line that begins with `<`.
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

    /// Returns true if the closing quote of a value is really the opening quote of the next attribute: it follows
    /// ` next=`, and no end of a tag or value comes after it.
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

    /// Returns the likely end of a value whose closing quote is missing; reading continues after it.
    fn guess_end(&mut self, value: Range<usize>) -> usize {
        let text = &self.text[value.clone()];
        let line = &text[..text.find('\n').unwrap_or(text.len())];
        let end = if let Some(close) = line.find(['”', '“', '＂', '’', '＇']) {
            // The value was closed after all, by a mark that only looks like a quote.
            self.at = value.start + close;
            self.skip();
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
            let text = self.reporter.quote(&value);
            self.reporter
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
            self.missing(name, place);
        } else {
            let text = self.reporter.quote(&value).trim_matches(['"', '\'', '”']);
            self.reporter
                .at(&value, |s| say::value_not_quoted(s, name, text));
        }
        value
    }
}

/// Returns the range within the brackets that begin a string, if they are quotation marks of another script and end soon.
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

/// Returns true if a string continues with `name=`.
fn names_attribute(text: &str) -> bool {
    let name = text.find(ends_name).unwrap_or(text.len());
    is_name(&text[..name]) && text[name..].starts_with(['=', '＝'])
}
