//! Tags: valid ones as quick-xml reads them, and all errors inside `<` and `>` except in the values of attributes,
//! which are read in [`quotes`](crate::parse::xml::tree::quotes).

use crate::parse::reporter::Reporter;
use crate::parse::xml::tree::chars::{ends_name, is_blank, is_name, is_whole_name, narrow};
use crate::parse::xml::tree::quotes::closers;
use crate::parse::xml::tree::scan::Scanner;
use crate::parse::xml::tree::text::Run;
use crate::parse::xml::tree::token::{Attribute, EndTag, StartTag};
use hsd_base::diagnostic::Edit;
use hsd_ir::messages::xml as say;
use quick_xml::events::{BytesEnd, BytesStart};
use smallvec::SmallVec;
use std::collections::HashMap;
use std::ops::Range;

/// The end of a start tag.
enum End {
    Open,
    Empty,
    /// Without `>`; `true` = there was a `/`.
    Missing(bool),
}

impl<'a> Scanner<'a, '_> {
    /// Returns the tag that quick-xml has read, if it is valid.
    pub(in crate::parse::xml) fn sound_start(
        &mut self,
        start: usize,
        tag: &BytesStart<'_>,
    ) -> Option<StartTag<'a>> {
        let name_range = self.sound_name(tag.name().as_ref())?;
        let mut places: SmallVec<[_; 8]> = SmallVec::new();
        // Two attributes of one name are found below; quick-xml would allocate for that.
        for attribute in tag.attributes().with_checks(false) {
            let attribute = attribute.ok()?;
            let name = self.sound_name(attribute.key.as_ref())?;
            self.text[..name.start].ends_with(is_blank).then_some(())?;
            places.push((name, self.range(&attribute.value)));
        }
        if places.len() > 1 {
            let names = places.iter().map(|(name, _)| &self.text[name.clone()]);
            let mut names: SmallVec<[&str; 8]> = names.collect();
            names.sort_unstable();
            if names.windows(2).any(|pair| pair[0] == pair[1]) {
                return None;
            }
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

    /// Returns the end tag that quick-xml has read, if it is valid.
    pub(in crate::parse::xml) fn sound_end(
        &self,
        start: usize,
        tag: &BytesEnd<'_>,
    ) -> Option<EndTag<'a>> {
        let name = &self.text[self.sound_name(tag.name().as_ref())?];
        let range = start..self.at;
        Some(EndTag { name, range })
    }

    /// Returns the place of a name that quick-xml has found, if it is valid.
    fn sound_name(&self, name: &str) -> Option<Range<usize>> {
        is_whole_name(name).then(|| self.range(name))
    }

    /// Returns the range of a part of the text.
    fn range(&self, part: &str) -> Range<usize> {
        let start = part.as_ptr() as usize - self.text.as_ptr() as usize;
        start..start + part.len()
    }

    /// Reports a name that XML does not allow; returns whether it is valid.
    fn check_name(&mut self, range: &Range<usize>) -> bool {
        let name = self.reporter.quote(range);
        if !is_name(name) {
            self.reporter.at(range, |s| say::bad_name(s, name));
        }
        is_name(name)
    }

    /// Returns the end of a name that begins here.
    pub(in crate::parse::xml) fn name_end(&self) -> usize {
        let rest = self.rest();
        self.at + rest.find(ends_name).unwrap_or(rest.len())
    }

    /// Reads a start tag.
    pub(in crate::parse::xml) fn start_tag(&mut self, start: usize) -> StartTag<'a> {
        self.open(1);
        let name_range = self.at..self.name_end();
        let name = &self.text[name_range.clone()];
        self.check_name(&name_range);
        self.at = name_range.end;
        self.element = name;
        let mut attributes = vec![];
        let (empty, closed) = match self.attributes(&mut attributes) {
            End::Open => (false, true),
            End::Empty => (true, true),
            End::Missing(slash) => {
                self.unclosed(start..name_range.end, name, slash);
                (slash, false)
            }
        };
        report_twins(&mut attributes, self.reporter);
        StartTag {
            name,
            name_range,
            range: start..self.at,
            attributes,
            empty,
            closed,
        }
    }

    /// Reports a start tag without `>`, which ends here. That of a leaf should end with `/>`.
    fn unclosed(&mut self, range: Range<usize>, name: &str, slash: bool) {
        let end = self.text[..self.at].trim_end_matches(is_blank).len();
        let end = self.reporter.span(&(end..end));
        let own_end = self.rest().strip_prefix("</");
        let held = own_end.is_some_and(|rest| rest.starts_with(name));
        let empty = !slash && !held && (self.habits.leaf)(name);
        let mark = if empty { "/>" } else { ">" };
        self.reporter.at(&range, |s| {
            say::tag_not_closed(s, name, slash, Edit::new(end, mark))
        });
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
                        self.reporter.at(&here, say::no_blank_between);
                    }
                    list.extend(self.attribute());
                }
            }
        }
    }

    /// Returns true if a line of codes begins here rather than one of attributes.
    fn is_text_line(&self) -> bool {
        let line = self.rest().split(['\n', '<']).next().unwrap_or_default();
        !line.trim().is_empty() && !line.contains(['=', '＝', '>', '＞', '/', '／', '"', '\''])
    }

    /// Reads the `/` before `>`; any other is reported and skipped.
    fn slash(&mut self) -> Option<End> {
        let start = self.at;
        self.bump();
        let after = self.at;
        self.at += self.rest().len() - self.rest().trim_start_matches(is_blank).len();
        match self.peek() {
            Some('>' | '＞') => {
                if self.at > after {
                    self.reporter
                        .at(&(after..self.at), say::blank_before_closing);
                }
                self.bump();
                Some(End::Empty)
            }
            None | Some('<') => Some(End::Missing(true)),
            _ => {
                self.reporter
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

    /// Returns the attribute of the name and value here, up to its end.
    fn resolved(&mut self, name: Range<usize>, end: usize, value: Range<usize>) -> Attribute<'a> {
        let mut run = Run::default();
        run.raw(value.clone(), self.reporter);
        Attribute {
            name: &self.text[name.clone()],
            range: name.start..end,
            name_range: name,
            value: run.value(value.start),
            faulty: false,
        }
    }

    /// Skips something that cannot begin an attribute.
    fn nameless(&mut self) {
        let start = self.at;
        let first = self.peek().unwrap_or('=');
        if narrow(first).unwrap_or(first) == '=' {
            self.at += self.rest().len() - self.rest().trim_start_matches(first).len();
        } else if "\"'“”„＂‘’＇".contains(first) {
            // A value without a name, if it ends soon and on this line; otherwise a surplus quote.
            let from = start + first.len_utf8();
            let near = self.text[from..].char_indices().take(100);
            let mut line = near.take_while(|(_, c)| !matches!(c, '\n' | '<' | '>'));
            let close = line.find(|(_, c)| closers(first).contains(c));
            self.at = close.map_or(from, |(i, c)| from + i + c.len_utf8());
        } else {
            self.at += first.len_utf8();
        }
        let range = start..self.at;
        let junk = self.reporter.quote(&range);
        self.reporter.at(&range, |s| say::stray_in_tag(s, junk));
    }
}

/// Reports attributes of the same name and keeps the first of them.
fn report_twins(attributes: &mut [Attribute<'_>], reporter: &mut Reporter<'_>) {
    let mut first = HashMap::new();
    for twin in attributes {
        let (name, span) = (twin.name, reporter.span(&twin.name_range));
        let range = twin.range.clone();
        let (before, whole) = first.entry(name).or_insert((span, range.clone()));
        if *before != span {
            twin.faulty = true;
            let both = [reporter.with_gap(whole), reporter.with_gap(&range)];
            reporter.push(|| say::attribute_twice(span, name, name, *before, both));
        }
    }
}
