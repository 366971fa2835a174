//! Ranges around a place, for fixes: a whole line, a word with the blanks before it, the digits of a glued word.

use super::line::after_line_end;
use crate::parse::reporter::Reporter;
use hsd_base::source::Span;

/// Line ends.
const ENDS: [char; 2] = ['\n', '\r'];

impl Reporter<'_> {
    /// Returns the source at a place.
    pub(super) fn written(&self, span: Span) -> &str {
        &self.source.text()[self.source.text_range(span)]
    }

    /// Returns the lines of a place, with the last line end.
    pub(super) fn line_of(&self, span: Span) -> Span {
        let (text, range) = (self.source.text(), self.source.text_range(span));
        let start = text[..range.start].rfind(ENDS).map_or(0, |at| at + 1);
        let rest = &text[range.end..];
        let end = range.end + rest.find(ENDS).unwrap_or(rest.len());
        self.source
            .span(start..after_line_end(text.as_bytes(), end))
    }

    /// Returns the place, or its whole line if nothing else is there: a line left blank could end a section.
    pub(super) fn or_line(&self, span: Span) -> Span {
        let (text, range) = (self.source.text(), self.source.text_range(span));
        let before = text[..range.start].trim_end_matches(' ');
        let after = text[range.end..].trim_start_matches(' ');
        let alone = (before.is_empty() || before.ends_with(ENDS))
            && (after.is_empty() || after.starts_with(ENDS));
        if alone { self.line_of(span) } else { span }
    }

    /// Returns the place and the blanks before it.
    pub(super) fn with_blanks(&self, span: Span) -> Span {
        let range = self.source.text_range(span);
        let before = self.source.text()[..range.start].trim_end_matches([' ', '\t']);
        self.source.span(before.len()..range.end)
    }

    /// Returns the range of a string that ends a place; nothing if it is written in other letters.
    pub(super) fn tail(&self, span: Span, text: &str) -> Option<Span> {
        let range = self.source.text_range(span);
        let fits = self.source.text()[range.clone()].ends_with(text);
        fits.then(|| self.source.span(range.end - text.len()..range.end))
    }
}
