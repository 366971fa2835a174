//! Where the reader's messages go: spans are made here, and a flood of them ends here.
//!
//! A file that is no XML at all can hold a fault a byte. Nobody reads a million messages, and their wording
//! would take more memory than the file is allowed to; so after [`MOST`] of them one last message says that
//! there are more.

use crate::diagnostic::{Diagnostic, Diagnostics, messages::xml as say};
use crate::source::{Source, Span};
use std::ops::Range;

/// Messages that one file can cause.
pub(super) const MOST: usize = 20_000;

/// The faults found in one source.
pub(super) struct Faults<'a> {
    pub(super) source: &'a Source,
    out: &'a mut Diagnostics,
    left: usize,
}

impl<'a> Faults<'a> {
    pub(super) fn new(source: &'a Source, out: &'a mut Diagnostics) -> Self {
        Faults {
            source,
            out,
            left: MOST,
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

    /// Takes a message about a range of the text; the wording is made only while there is room for it.
    pub(super) fn at(&mut self, range: &Range<usize>, message: impl FnOnce(Span) -> Diagnostic) {
        let span = self.span(range);
        self.push(span, || message(span));
    }

    /// Takes a message about a span; `span` also bears the message that ends a flood.
    pub(super) fn push(&mut self, span: Span, message: impl FnOnce() -> Diagnostic) {
        match self.left {
            0 => return,
            1 => self.out.push(say::too_many_faults(span, MOST)),
            _ => self.out.push(message()),
        }
        self.left -= 1;
    }
}
