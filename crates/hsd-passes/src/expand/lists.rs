//! Lists of codes in `random` and `replace`, and the weights of a random choice.

use super::Pass;
use super::codes::Found;
use hsd_base::source::{Span, Spanned};
use hsd_ir::ast::{CodeText, Random};
use hsd_ir::messages::parts as say;
use std::ops::Range;

/// The void, which cannot be trimmed.
const VOID: &str = "     ";

impl Pass<'_, '_> {
    /// Returns the codes of a list with their places; unknown ones are reported and substituted.
    pub(super) fn list(&mut self, list: &Spanned<String>) -> Vec<(Found, Span)> {
        let pieces = self.list_pieces(list);
        let spelling = self.spelling(list);
        let mut found: Vec<(Found, Span)> = vec![];
        for (index, piece) in pieces.iter().enumerate() {
            let span = self.within(list, spelling, piece);
            let text = &list.value[piece.clone()];
            let before = index.checked_sub(1).map(|before| &pieces[before]);
            if let (Some(before), Some(last)) = (before, found.last_mut())
                && let Some(whole) = self.torn(&list.value[before.clone()], text)
            {
                *last = (whole, last.1.to(span));
                let (code, span) = (self.codes.name(whole.which).to_owned(), last.1);
                self.once(314, span, || say::torn_code(span, &code));
                continue;
            }
            found.push((self.resolve(&CodeText::new(text), span), span));
        }
        found
    }

    /// Returns the code that white space split in two, as in `TSH 2 TKD 2`.
    fn torn(&mut self, before: &str, width: &str) -> Option<Found> {
        if width.len() != 1 || self.codes.known(&CodeText::new(width)).is_some() {
            return None;
        }
        self.codes
            .known(&CodeText::new(&format!("{before:<4}{width}")))
    }

    /// Returns the pieces of a list: divided at commas if it has any; otherwise one code if it is known as a whole;
    /// otherwise divided at white space. Empty pieces are reported and left out.
    pub(super) fn list_pieces(&mut self, list: &Spanned<String>) -> Vec<Range<usize>> {
        let text = list.value.as_str();
        if text.contains(',') {
            return self.comma_pieces(list);
        }
        let whole = match text {
            VOID => 0..VOID.len(),
            text => trimmed(text, 0..text.len()),
        };
        if whole.is_empty() {
            self.once(304, list.span, || say::empty_code(list.span, None));
            return vec![];
        }
        if self
            .codes
            .known(&CodeText::new(&text[whole.clone()]))
            .is_some()
        {
            return vec![whole];
        }
        let pieces = text.split_ascii_whitespace().map(|piece| {
            let start = piece.as_ptr() as usize - text.as_ptr() as usize;
            start..start + piece.len()
        });
        pieces.collect()
    }

    fn comma_pieces(&mut self, list: &Spanned<String>) -> Vec<Range<usize>> {
        let spelling = self.spelling(list);
        let (mut pieces, mut start) = (vec![], 0);
        for piece in list.value.split(',') {
            let range = start..start + piece.len();
            start = range.end + 1;
            let inner = trimmed(&list.value, range.clone());
            if inner.is_empty() {
                let span = self.within(list, spelling, &range);
                let comma = self.comma(list, spelling, &range);
                self.once(304, span, || say::empty_code(span, comma));
            } else {
                pieces.push(inner);
            }
        }
        pieces
    }

    /// Returns the spelling of a value in the source.
    pub(super) fn spelling(&self, list: &Spanned<String>) -> Spelling {
        let span = list.span;
        if span.file == self.source.id() {
            let place = self.source.text_range(span);
            if self.source.text()[place.clone()] == list.value {
                return Spelling::Text(place.start);
            }
        } else if (span.end - span.start) as usize == list.value.len() {
            return Spelling::Bytes;
        }
        Spelling::Otherwise
    }

    /// Returns the span of a range of a value.
    pub(super) fn within(
        &self,
        list: &Spanned<String>,
        spelling: Spelling,
        range: &Range<usize>,
    ) -> Span {
        match spelling {
            Spelling::Text(at) => self.source.span(at + range.start..at + range.end),
            Spelling::Bytes => Span {
                file: list.span.file,
                start: list.span.start + range.start as u32,
                end: list.span.start + range.end as u32,
            },
            Spelling::Otherwise => list.span,
        }
    }

    /// Returns the span of a comma beside an empty piece of a list, with the blanks of that piece.
    fn comma(
        &self,
        list: &Spanned<String>,
        spelling: Spelling,
        piece: &Range<usize>,
    ) -> Option<Span> {
        let all = list.value.len();
        let range = match (piece.start, piece.end) {
            (0, end) if end == all => return None,
            (0, end) => 0..end + 1,
            (start, end) => start - 1..end,
        };
        let exact = !matches!(spelling, Spelling::Otherwise);
        exact.then(|| self.within(list, spelling, &range))
    }

    /// Returns the span of the attribute with this value, with the blanks before it.
    fn attribute(&self, value: Span) -> Option<Span> {
        if value.file != self.source.id() {
            return None;
        }
        let (text, range) = (self.source.text(), self.source.text_range(value));
        let quote = text[range.end..].chars().next()?;
        let before = text[..range.start].strip_suffix(quote)?.trim_end();
        let name = before.strip_suffix('=')?.trim_end();
        let start = name.rfind(char::is_whitespace)?;
        let start = name[..start].trim_end().len();
        Some(self.source.span(start..range.end + quote.len_utf8()))
    }

    /// Returns true if nothing follows the span on its line of a legacy file.
    pub(super) fn ends_line(&self, span: Span) -> bool {
        let (text, range) = (self.source.text(), self.source.text_range(span));
        let rest = text[range.end..].trim_start_matches(' ');
        let ends = rest.is_empty() || rest.starts_with(['\n', '\r']);
        span.file == self.source.id() && ends && !text.trim_start().starts_with('<')
    }

    /// Returns the weights of a random choice among this many codes, as running sums; equal weights if they are missing
    /// or wrong.
    pub(super) fn weight_sums(&mut self, random: &Random, codes: usize) -> Vec<f64> {
        let mut sum = 0.0;
        let add = |weight| {
            sum += weight;
            sum
        };
        self.weights(random, codes).into_iter().map(add).collect()
    }

    fn weights(&mut self, random: &Random, codes: usize) -> Vec<f64> {
        let equal = vec![1.0; codes];
        let Some(weights) = &random.weights else {
            return equal;
        };
        let given = weights.value.len();
        if given != codes {
            let span = weights.span;
            let all = self.attribute(span);
            self.once(305, span, || say::weight_count(span, given, codes, all));
            return equal;
        }
        let sum: f64 = weights.value.iter().sum();
        let fit = weights.value.iter().all(|w| *w >= 0.0) && sum > 0.0 && sum.is_finite();
        // The readers report wrong ones.
        if fit { weights.value.clone() } else { equal }
    }
}

fn trimmed(text: &str, range: Range<usize>) -> Range<usize> {
    let piece = &text[range.clone()];
    let start = range.start + (piece.len() - piece.trim_start().len());
    start..start.max(range.start + piece.trim_end().len())
}

/// The spelling of a value in its source.
#[derive(Clone, Copy)]
pub(super) enum Spelling {
    /// Letter by letter, from this offset of the text.
    Text(usize),
    /// In another file, with as many bytes.
    Bytes,
    /// With character references: only its whole span is known.
    Otherwise,
}
