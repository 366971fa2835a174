//! The lines that a message refers to, and no others: miette scans and measures everything it is given.
//!
//! An excerpt is a separate source: the marked lines and their neighbours. Long lines are truncated round the marks,
//! with `…` for omitted text, and characters that would not align with their carets are replaced: miette counts the
//! half-width voicing marks ﾞ and ﾟ as no column, terminals as one. Each goes through miette as a private character one
//! column wide and is put back by [`restored`].

use super::lines::{Lines, Position};
use hsd_base::diagnostic::visible;
use miette::{MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};
use std::ops::Range;

/// Maximum length of a line that is shown whole, characters.
const WHOLE: usize = 160;
/// Characters shown before a mark in a longer line.
const BEFORE: usize = 50;
/// Characters shown from a mark's start on.
const AFTER: usize = 80;
/// The number of lines beyond which a mark shows only its first.
const TALL: usize = 6;

/// Private characters for ﾞ and ﾟ.
const STAND_INS: [(char, char); 2] = [('ﾞ', '\u{f8f0}'), ('ﾟ', '\u{f8f1}')];

/// The excerpt of a file.
#[derive(Debug)]
pub(super) struct Excerpt {
    name: String,
    text: String,
    rows: Vec<ExcerptRow>,
    marks: Vec<Mark>,
}

/// A line of the excerpt.
#[derive(Debug)]
struct ExcerptRow {
    /// Its number in the file, from 0.
    line: usize,
    /// Its range in the excerpt, with its line end.
    range: Range<usize>,
}

/// A marked place.
#[derive(Debug)]
struct Mark {
    range: Range<usize>,
    position: Position,
}

impl Excerpt {
    /// Creates an excerpt of the lines around some ranges of the text of `lines`.
    pub(super) fn new(name: &str, lines: &Lines<'_>, ranges: &[Range<usize>]) -> Excerpt {
        let ranges: Vec<_> = ranges.iter().map(|r| trimmed(lines, r.clone())).collect();
        let mut excerpt = Excerpt {
            name: visible::line(name),
            text: String::new(),
            rows: vec![],
            marks: vec![],
        };
        let mut shown: Vec<usize> = vec![];
        for range in &ranges {
            let (first, last) = (lines.line(range.start), lines.line(range.end));
            // After the last line end there is no line, unless a mark is there.
            let count = lines.count();
            let open = lines.line_range(count - 1).is_empty() && last + 1 < count;
            let count = count - usize::from(open);
            shown.extend(first.saturating_sub(1)..(last + 2).min(count));
        }
        shown.sort_unstable();
        shown.dedup();
        let mut ends = vec![(0, 0); ranges.len()];
        for line in shown {
            excerpt.row(lines, line, &ranges, &mut ends);
        }
        let mark = |(range, (start, end)): (&Range<usize>, (usize, usize))| Mark {
            range: start..end.max(start),
            position: lines.position(range.start),
        };
        excerpt.marks = ranges.iter().zip(ends).map(mark).collect();
        excerpt
    }

    /// Returns the ranges of the marks in the excerpt, in their order.
    pub(super) fn marks(&self) -> impl Iterator<Item = Range<usize>> {
        self.marks.iter().map(|m| m.range.clone())
    }

    /// Appends a line, and records the starts and ends of ranges in it.
    fn row(
        &mut self,
        lines: &Lines<'_>,
        line: usize,
        ranges: &[Range<usize>],
        ends: &mut [(usize, usize)],
    ) {
        let whole = lines.line_range(line);
        let text = &lines.text()[whole.clone()];
        let begin = self.text.len();
        let inside = |at: usize| (whole.start..=whole.end).contains(&at);
        let starts: Vec<usize> = ranges
            .iter()
            .map(|r| r.start)
            .filter(|s| inside(*s))
            .collect();
        // (offset in the file's text, offset in the excerpt) of every character that is shown.
        let mut places = vec![];
        let mut shown_to = 0;
        for kept in kept(text, starts.iter().map(|s| s - whole.start).collect()) {
            if kept.start > shown_to {
                self.text.push('…');
            }
            for (at, c) in text[kept.clone()].char_indices() {
                places.push((whole.start + kept.start + at, self.text.len()));
                self.text.push(shown(c));
            }
            shown_to = kept.end;
        }
        if shown_to < text.len() {
            self.text.push('…');
        }
        places.push((whole.end, self.text.len()));
        let place =
            |at: usize| places[places.partition_point(|p| p.0 < at).min(places.len() - 1)].1;
        for (range, end) in ranges.iter().zip(ends) {
            if inside(range.start) {
                end.0 = place(range.start);
            }
            if inside(range.end) {
                end.1 = place(range.end);
            }
        }
        if text.is_empty() {
            self.text.push(' '); // miette shows no caret under nothing
        }
        self.text.push('\n');
        self.rows.push(ExcerptRow {
            line,
            range: begin..self.text.len(),
        });
    }

    /// Returns the row at an offset.
    fn row_at(&self, offset: usize) -> Option<usize> {
        let row = self.rows.partition_point(|r| r.range.end <= offset);
        (row < self.rows.len()).then_some(row)
    }
}

impl SourceCode for Excerpt {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let (start, end) = (span.offset(), span.offset() + span.len());
        let row = |at| self.row_at(at).ok_or(MietteError::OutOfBounds);
        let (mut first, mut last) = (row(start)?, row(end)?);
        let joined = |i: usize| self.rows[i].line + 1 == self.rows[i + 1].line;
        if !(first..last).all(joined) {
            return Err(MietteError::OutOfBounds); // lines between are not in the excerpt
        }
        // The header of a snippet asks for no context and takes line and column from its mark.
        let mark = self
            .marks
            .iter()
            .find(|m| before == 0 && m.range.start == start);
        for _ in 0..before {
            first -= usize::from(first > 0 && joined(first - 1));
        }
        for _ in 0..after {
            last += usize::from(last + 1 < self.rows.len() && joined(last));
        }
        let range = self.rows[first].range.start..self.rows[last].range.end;
        let position = mark.map(|m| (m.position.line - 1, m.position.column - 1));
        let (line, column) = position.unwrap_or((self.rows[first].line, 0));
        Ok(Box::new(MietteSpanContents::new_named(
            self.name.clone(),
            &self.text.as_bytes()[range.clone()],
            (range.start, range.len()).into(),
            line,
            column,
            last - first + 1,
        )))
    }
}

/// Restores the characters that were replaced while miette counted columns.
pub(super) fn restored(text: &str) -> String {
    let back = |c: char| {
        STAND_INS
            .iter()
            .find(|(_, s)| *s == c)
            .map_or(c, |(own, _)| *own)
    };
    text.chars().map(back).collect()
}

fn shown(c: char) -> char {
    if let Some((_, stand_in)) = STAND_INS.iter().find(|(own, _)| *own == c) {
        return *stand_in;
    }
    if STAND_INS.iter().any(|(_, s)| *s == c) {
        return char::REPLACEMENT_CHARACTER;
    }
    visible::character(c).unwrap_or(c)
}

/// Returns a range without line ends at its end; of a tall one only the first line.
fn trimmed(lines: &Lines<'_>, range: Range<usize>) -> Range<usize> {
    let text = &lines.text()[range.clone()];
    let end = range.start + text.trim_end_matches(['\r', '\n']).len();
    let first = lines.line(range.start);
    if lines.line(end) - first > TALL {
        return range.start..lines.line_range(first).end.max(range.start);
    }
    range.start..end
}

/// Returns the parts of a line that are shown, given the starts of marks in it.
fn kept(line: &str, mut starts: Vec<usize>) -> Vec<Range<usize>> {
    if line.len() <= WHOLE || line.char_indices().nth(WHOLE).is_none() {
        return std::iter::once(0..line.len()).collect();
    }
    if starts.is_empty() {
        starts.push(0);
    }
    starts.sort_unstable();
    let mut parts: Vec<Range<usize>> = vec![];
    for start in starts {
        let start = start.min(line.len());
        let from = line[..start]
            .char_indices()
            .rev()
            .nth(BEFORE - 1)
            .map_or(0, |(i, _)| i);
        let to = line[start..]
            .char_indices()
            .nth(AFTER)
            .map_or(line.len(), |(i, _)| start + i);
        match parts.last_mut() {
            Some(last) if from <= last.end => last.end = to.max(last.end),
            _ => parts.push(from..to),
        }
    }
    parts
}
