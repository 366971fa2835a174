//! Collects the readers' messages: computes their spans and limits their number.
//!
//! A file of a million broken lines, or one that is no XML at all, can have an error per byte. Nobody reads a million
//! messages, and keeping them would exceed the memory limit (docs/contract.md 7); so after [`ENOUGH`] the rest is only
//! counted, and the last message states their number.

use hsd_base::diagnostic::messages::file;
use hsd_base::diagnostic::{Code, Diagnostic, Diagnostics, ENOUGH, Origin, Severity, Text};
use hsd_base::source::{FileId, Source, Span};
use std::collections::BTreeMap;
use std::ops::Range;

/// The maximum number of messages of one code for one place, if content is read several times.
const A_FEW: usize = 4;

/// The maximum white space considered before an item.
const FAR: usize = 4096;

/// The messages about one source, and those that it includes. Their texts are numbered consecutively, so that a range
/// determines its file.
pub(super) struct Reporter<'a> {
    /// The source that is being read.
    pub(super) source: &'a Source,
    /// The start of its text among all texts.
    base: usize,
    /// All sources except the first, with the starts of their texts.
    more: Vec<(usize, &'a Source)>,
    first: &'a Source,
    /// Messages already reported, for content that is read several times.
    once: Option<BTreeMap<(u16, Origin), Vec<Text>>>,
    /// A file whose messages are put at another place: one that no author can change.
    instead: Option<(FileId, Span)>,
    /// The line end of the first source.
    line_end: &'static str,
    out: Diagnostics,
    /// The number of messages so far, those that were reported already included.
    told: usize,
    said: usize,
    /// The highest severity of the omitted messages.
    worst: Option<Severity>,
    /// The gravest problem since it was last asked for.
    problem: Option<(Severity, Code)>,
}

/// Returns the first line end of a source, or the usual one.
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
            instead: None,
            line_end: line_end(source.text()),
            out: Diagnostics::new(),
            told: 0,
            said: 0,
            worst: None,
            problem: None,
        }
    }

    /// Returns the gravest problem since this was last asked, warnings and errors alone.
    pub(super) fn take_problem(&mut self) -> Option<(Severity, Code)> {
        self.problem.take()
    }

    /// Records a problem.
    fn note_problem(&mut self, message: &Diagnostic) {
        let known = self.problem.map(|(severity, _)| severity);
        if message.severity > Severity::Note && known < Some(message.severity) {
            self.problem = Some((message.severity, message.code));
        }
    }

    /// Returns the line end of the text.
    pub(super) fn line_end_text(&self) -> &'static str {
        self.line_end
    }

    /// Switches to an included source, and returns the start of its text among all texts.
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

    /// Returns to the first source: from now on ranges are those of all texts.
    pub(super) fn leave(&mut self) {
        (self.source, self.base) = (self.first, 0);
    }

    /// From now on, puts the messages of a file at another place; returns what held before.
    pub(super) fn instead(&mut self, of: Option<(FileId, Span)>) -> Option<(FileId, Span)> {
        std::mem::replace(&mut self.instead, of)
    }

    /// From now on, reports the same message only once per place.
    pub(super) fn say_once(&mut self) {
        self.once.get_or_insert_default();
    }

    /// Returns the source at an offset, and the start of its text.
    pub(super) fn source_at(&self, at: usize) -> (usize, &'a Source) {
        let next = self.more.partition_point(|(base, _)| *base <= at);
        next.checked_sub(1)
            .map_or((0, self.first), |i| self.more[i])
    }

    /// Returns the span of a range of the text.
    pub(super) fn span(&self, range: &Range<usize>) -> Span {
        if self.more.is_empty() {
            return self.first.span(range.clone());
        }
        let (base, source) = self.source_at(self.base + range.start);
        let offset = |at: usize| (self.base + at).saturating_sub(base);
        source.span(offset(range.start)..offset(range.end))
    }

    /// Returns the number of messages so far, those that were reported already included.
    pub(super) fn told(&self) -> usize {
        self.told
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

    /// Returns the source in a range of the text.
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

    /// Reports a message. It is built only if something of it is kept. Messages have unlike types, so what does not depend on them is
    /// compiled once, in other functions.
    pub(super) fn push(&mut self, message: impl FnOnce() -> Diagnostic) {
        self.told += 1;
        if self.keeps() {
            self.keep(message());
        } else {
            self.said += 1;
        }
    }

    /// Returns true if the next message changes the result.
    fn keeps(&self) -> bool {
        let room = ENOUGH + usize::from(self.once.is_some());
        self.said < room || self.worst < Some(Severity::Error)
    }

    fn keep(&mut self, mut message: Diagnostic) {
        if let Some((file, place)) = self.instead {
            message.leave(file, place);
        }
        if self.once.is_some() {
            self.note_problem(&message);
            if !self.is_news(&message) {
                return;
            }
        }
        self.said += 1;
        if self.said <= ENOUGH {
            self.out.push(message);
        } else {
            self.worst = self.worst.max(Some(message.severity));
        }
    }

    /// Returns true if a message is new for its place. Values differ between copies; a few of them suffice.
    fn is_news(&mut self, message: &Diagnostic) -> bool {
        let Some(once) = &mut self.once else {
            return true;
        };
        let said = once
            .entry((message.code.0, message.origin.clone()))
            .or_default();
        let news = said.len() < A_FEW && !said.contains(&message.message);
        if news {
            said.push(message.message.clone());
        }
        news
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
