//! Where the readers' messages go: spans are made here, and a flood of them ends here.
//!
//! A file of a million broken lines, or one that is no XML at all, can hold a fault a byte. Nobody reads a million
//! messages, and keeping them would take more memory than a file is allowed to (language.md 7); so after [`ENOUGH`]
//! the rest is counted only, and the last message says how many there were.

use crate::diagnostic::messages::file;
use crate::diagnostic::{Diagnostic, Diagnostics, Severity};
use crate::source::{Source, Span};
use std::ops::Range;

/// Messages on one file that are passed on.
const ENOUGH: usize = 500;

/// The faults found in one source.
pub(super) struct Faults<'a> {
    pub(super) source: &'a Source,
    out: &'a mut Diagnostics,
    said: usize,
    /// The worst of those left out.
    worst: Option<Severity>,
}

impl<'a> Faults<'a> {
    pub(super) fn new(source: &'a Source, out: &'a mut Diagnostics) -> Self {
        Faults {
            source,
            out,
            said: 0,
            worst: None,
        }
    }

    /// The span of a range of the text.
    pub(super) fn span(&self, range: &Range<usize>) -> Span {
        self.source.span(range.clone())
    }

    /// The author's words in a range of the text.
    pub(super) fn quote(&self, range: &Range<usize>) -> &'a str {
        self.source.text().get(range.clone()).unwrap_or_default()
    }

    /// Takes a message about a range of the text.
    pub(super) fn at(&mut self, range: &Range<usize>, message: impl FnOnce(Span) -> Diagnostic) {
        let span = self.span(range);
        self.push(|| message(span));
    }

    /// Takes a message. Its wording is made only where it can still matter.
    pub(super) fn push(&mut self, message: impl FnOnce() -> Diagnostic) {
        self.said += 1;
        if self.said <= ENOUGH {
            self.out.push(message());
        } else if self.worst < Some(Severity::Error) {
            self.worst = self.worst.max(Some(message().severity));
        }
    }

    /// Takes a message that is made already.
    pub(super) fn say(&mut self, message: Diagnostic) {
        self.push(|| message);
    }

    /// Says how much was left out.
    pub(super) fn finish(self) {
        if let Some(worst) = self.worst {
            let end = self.source.text().len();
            let span = self.span(&(end..end));
            let more = self.said - ENOUGH;
            self.out.push(file::more_messages(span, more, worst));
        }
    }
}
