//! Where the readers' messages go: spans are made here, and a flood of them ends here.
//!
//! A file of a million broken lines, or one that is no XML at all, can hold a fault a byte. No one reads a million
//! messages, and keeping them would take more memory than a file is allowed to (docs/contract.md 7); so after [`ENOUGH`]
//! the rest is counted only, and the last message says how many there were.

use crate::diagnostic::messages::file;
use crate::diagnostic::{Diagnostic, Diagnostics, Severity, Text};
use crate::source::{Source, Span};
use std::collections::BTreeMap;
use std::ops::Range;

/// Messages of one code on one place, where something is read several times.
const A_FEW: usize = 4;

/// More white space than anybody puts before something.
const FAR: usize = 4096;

/// Messages on one file that are passed on.
const ENOUGH: usize = 500;

/// The faults found in one source, and in those that it includes. Their texts count as if they stood behind one
/// another: so a range tells the file too.
pub(super) struct Reporter<'a> {
    /// The source that is being read.
    pub(super) source: &'a Source,
    /// Where its text begins among all texts.
    base: usize,
    /// All sources but the first, with where they begin.
    more: Vec<(usize, &'a Source)>,
    first: &'a Source,
    /// Messages already reported, for content that is read several times.
    once: Option<BTreeMap<(u16, Span), Vec<Text>>>,
    /// How the lines of the first source end.
    line_end: &'static str,
    out: Diagnostics,
    said: usize,
    /// The worst of those left out.
    worst: Option<Severity>,
}

/// The first line end of a text, or the usual one.
fn line_end(text: &str) -> &'static str {
    match text.find(['\n', '\r']).map(|at| &text.as_bytes()[at..]) {
        Some([b'\r', b'\n', ..]) => "\r\n",
        Some([b'\r', ..]) => "\r",
        _ => "\n",
    }
}

impl<'a> Reporter<'a> {
    pub(super) fn new(source: &'a Source) -> Self {
        Reporter {
            source,
            base: 0,
            more: vec![],
            first: source,
            once: None,
            line_end: line_end(source.text()),
            out: Diagnostics::new(),
            said: 0,
            worst: None,
        }
    }

    /// How the lines of the text end.
    pub(super) fn line_end_text(&self) -> &'static str {
        self.line_end
    }

    /// Goes on to a source that the others include, and says where its text begins among all texts.
    pub(super) fn enter(&mut self, source: &'a Source) -> usize {
        let (last, at) = match self.more.last() {
            Some((at, last)) => (*last, *at),
            None => (self.first, 0),
        };
        self.base = at + last.text().len() + 1;
        self.more.push((self.base, source));
        self.source = source;
        self.base
    }

    /// Goes back to the first source: from now on ranges are those of all texts.
    pub(super) fn leave(&mut self) {
        (self.source, self.base) = (self.first, 0);
    }

    /// From now on says the same thing once for a place.
    pub(super) fn say_once(&mut self) {
        self.once.get_or_insert_default();
    }

    /// The source at an offset, and where it begins.
    pub(super) fn source_at(&self, at: usize) -> (usize, &'a Source) {
        let next = self.more.partition_point(|(base, _)| *base <= at);
        next.checked_sub(1)
            .map_or((0, self.first), |i| self.more[i])
    }

    /// The span of a range of the text.
    pub(super) fn span(&self, range: &Range<usize>) -> Span {
        if self.more.is_empty() {
            return self.first.span(range.clone());
        }
        let (base, source) = self.source_at(self.base + range.start);
        let offset = |at: usize| (self.base + at).saturating_sub(base);
        source.span(offset(range.start)..offset(range.end))
    }

    /// Returns true if the next message will be kept; otherwise its fixes need not be computed.
    pub(super) fn wanted(&self) -> bool {
        self.said < ENOUGH
    }

    /// Returns the span of a range of the text with the white space before it, so that deleting it leaves no gap.
    pub(super) fn with_gap(&self, range: &Range<usize>) -> Span {
        if !self.wanted() {
            return self.span(range);
        }
        let (base, source) = self.source_at(self.base + range.start);
        let from = (self.base + range.start).saturating_sub(base);
        let before = source.text().as_bytes().get(..from).unwrap_or_default();
        let blank = |b: &&u8| matches!(b, b' ' | b'\t' | b'\r' | b'\n');
        let blanks = before.iter().rev().take(FAR).take_while(blank).count();
        self.span(&(range.start - blanks..range.end))
    }

    /// The author's words in a range of the text.
    pub(super) fn quote(&self, range: &Range<usize>) -> &'a str {
        let (base, source) = self.source_at(self.base + range.start);
        let offset = |at: usize| (self.base + at).saturating_sub(base);
        let range = offset(range.start)..offset(range.end);
        source.text().get(range).unwrap_or_default()
    }

    /// Reports a message about a range of the text.
    pub(super) fn at(&mut self, range: &Range<usize>, message: impl FnOnce(Span) -> Diagnostic) {
        let span = self.span(range);
        self.push(|| message(span));
    }

    /// Reports a message. It is built only if it may still be kept.
    pub(super) fn push(&mut self, message: impl FnOnce() -> Diagnostic) {
        if self.once.is_some() {
            if self.said > ENOUGH && self.worst == Some(Severity::Error) {
                self.said += 1;
                return;
            }
            let message = message();
            if self.is_news(&message) {
                self.count(|| message);
            }
        } else {
            self.count(message);
        }
    }

    /// Returns true if a message is new for its place. Values differ from copy to copy; a few of them suffice.
    fn is_news(&mut self, message: &Diagnostic) -> bool {
        let Some(once) = &mut self.once else {
            return true;
        };
        let said = once.entry((message.code.0, message.span)).or_default();
        let news = said.len() < A_FEW && !said.contains(&message.message);
        if news {
            said.push(message.message.clone());
        }
        news
    }

    fn count(&mut self, message: impl FnOnce() -> Diagnostic) {
        self.said += 1;
        if self.said <= ENOUGH {
            self.out.push(message());
        } else if self.worst < Some(Severity::Error) {
            self.worst = self.worst.max(Some(message().severity));
        }
    }

    /// Reports a message that is already built.
    pub(super) fn say(&mut self, message: Diagnostic) {
        self.push(|| message);
    }

    /// Returns all messages, with a final one that states how many were omitted.
    pub(super) fn finish(mut self) -> Diagnostics {
        if let Some(worst) = self.worst {
            let end = self.first.text().len();
            let span = self.first.span(end..end);
            let more = self.said - ENOUGH;
            self.out.push(file::more_messages(span, more, worst));
        }
        self.out
    }
}
