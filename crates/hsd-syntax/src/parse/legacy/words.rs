//! Words and numbers, the components of header and roof lines.

use super::line::SourceLine;
use crate::messages::legacy as say;
use crate::parse::reporter::Reporter;
use hsd_base::diagnostic::Noun;
use hsd_base::diagnostic::suggest;
use hsd_base::source::{Source, Span, Spanned};
use nom::bytes::complete::{take_till1, take_while};
use nom::combinator::{all_consuming, consumed};
use nom::number::complete::recognize_float;
use nom::sequence::preceded;
use nom::{IResult, Parser};
use std::ops::RangeInclusive;

/// A word and its place.
pub(super) struct Word<'l> {
    pub(super) text: &'l str,
    pub(super) span: Span,
}

/// Returns the words of a line, up to a misplaced comment.
pub(super) fn words<'l>(line: &'l SourceLine<'_>, reporter: &mut Reporter<'_>) -> Vec<Word<'l>> {
    let (mut rest, mut at, mut found) = (line.text.as_bytes(), 0, Vec::with_capacity(16));
    while let Ok((next, (read, word))) = word(rest) {
        let end = at + read.len();
        let start = end - word.len();
        let text = &line.text[start..end];
        if text.starts_with('#') {
            let comment = line.span(reporter.source, start..line.text.trim_end().len());
            say_comment(line, comment, reporter);
            break;
        }
        let span = line.span(reporter.source, start..end);
        found.push(Word { text, span });
        (rest, at) = (next, end);
    }
    found
}

/// Reports a comment behind something on its line, with a fix that moves it before.
pub(super) fn say_comment(line: &SourceLine<'_>, comment: Span, reporter: &mut Reporter<'_>) {
    let start = reporter.source.span(line.at..line.at);
    let (place, end) = (reporter.with_blanks(comment), reporter.line_end_text());
    let text = [reporter.written(comment), end].concat();
    reporter.say(say::comment_column(comment, place, start, text));
}

/// Returns the words of a string, without places.
pub(super) fn plain_words(text: &str) -> impl Iterator<Item = &str> {
    text.split_ascii_whitespace()
}

/// Parses a word; returns the characters read, blanks included, and the word. Blanks are ASCII, so bytes suffice.
fn word(input: &[u8]) -> IResult<&[u8], (&[u8], &[u8])> {
    consumed(preceded(take_while(blank), take_till1(blank))).parse(input)
}

fn blank(b: u8) -> bool {
    b.is_ascii_whitespace()
}

/// Parses a finite decimal number.
pub(super) fn number(text: &str) -> Option<f64> {
    let mut whole = all_consuming(recognize_float::<_, nom::error::Error<_>>);
    let (_, digits) = whole.parse(text).ok()?;
    digits.parse().ok().filter(|n: &f64| n.is_finite())
}

/// Returns true if a word begins like a number; codes, keys and roof letters never do.
pub(super) fn numeric(text: &str) -> bool {
    let text = text.trim_start_matches(['+', '-']);
    let text = text.strip_prefix('.').unwrap_or(text);
    text.starts_with(|c: char| c.is_ascii_digit())
}

/// The purpose of a number, and its bounds.
pub(super) struct Range64 {
    /// Its name in messages.
    pub(super) what: Noun,
    /// Its bounds.
    pub(super) bounds: RangeInclusive<f64>,
    /// The unit of measure, for messages.
    pub(super) unit: Noun,
}

/// Reads a number within bounds; reports and returns `None` for everything else.
pub(super) fn within(
    text: &str,
    span: Span,
    range: &Range64,
    reporter: &mut Reporter<'_>,
) -> Option<Spanned<f64>> {
    let value = number(text).or_else(|| {
        let bare = text
            .trim_end_matches([',', ';'])
            .trim_start_matches(['=', ':']);
        let meant = [bare.to_owned(), text.replacen(',', ".", 1)];
        let meant = meant.into_iter().find_map(|m| Some((number(&m)?, m)));
        let fix = meant.as_ref().and_then(|(value, text_meant)| {
            let place = reporter.tail(span, text)?;
            let good = range.bounds.contains(value);
            good.then_some((place, &**text_meant))
        });
        reporter.say(say::not_a_number(span, text, range.what, fix));
        meant.map(|(value, _)| value)
    })?;
    if range.bounds.contains(&value) {
        return Some(Spanned::new(value, span));
    }
    let (least, most) = (*range.bounds.start(), *range.bounds.end());
    reporter.say(say::out_of_range(
        span, text, range.what, least, most, range.unit,
    ));
    None
}

/// Returns the span that covers several words.
pub(super) fn all(words: &[Word<'_>], source: &Source) -> Span {
    match words {
        [] => source.span(0..0),
        [first, .., last] => first.span.to(last.span),
        [only] => only.span,
    }
}

/// Returns the candidate nearest to a word, if any is near.
pub(super) fn nearest<'c>(word: &str, candidates: &[&'c str]) -> Option<&'c str> {
    let lower = word.to_ascii_lowercase();
    if lower.len() > 32 {
        return None;
    }
    // Of equally near words, one with the same first letter: it is seldom mistyped.
    let score = |c: &'c str| {
        let small = c.to_ascii_lowercase();
        let other = small.bytes().next() != lower.bytes().next();
        (suggest::slips(&lower, &small), (other, c))
    };
    let allowed = |c: &str| (c.len().max(3) + 1) / 3;
    suggest::nearest(candidates.iter().copied(), score, allowed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_finite_and_whole_words() {
        assert_eq!(number("-3.25"), Some(-3.25));
        assert_eq!(number(".5"), Some(0.5));
        for bad in ["", "nan", "inf", "1e999", "3m", "0x10", "1 2", "-"] {
            assert_eq!(number(bad), None, "{bad}");
        }
    }

    #[test]
    fn suggestions_are_near() {
        let keys = ["unit", "seed", "street"];
        assert_eq!(nearest("units", &keys), Some("unit"));
        assert_eq!(nearest("STRET", &keys), Some("street"));
        assert_eq!(nearest("depth", &keys), None);
        assert_eq!(nearest("KRI", &["IRI", "KIR"]), Some("KIR"));
    }
}
