//! Formatting, as edits of only those lines that change.

use super::Analysis;
use hsd_base::diagnostic::Diagnostics;
use hsd_syntax::print;
use std::ops::Range;

/// The replacement of a range.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// The removed range.
    pub range: Range<usize>,
    /// The new text.
    pub text: String,
}

/// Returns the edits that format the file, in its order; `None` if its meaning is in doubt.
pub fn format(a: &Analysis) -> Option<Vec<Edit>> {
    let limits = &a.options.expand.limits;
    let made = print::format(&a.source, limits, &mut Diagnostics::new())?;
    Some(edits(a.text(), &made))
}

/// Returns the edits that touch the lines of a range.
pub fn format_range(a: &Analysis, range: Range<usize>) -> Option<Vec<Edit>> {
    let text = a.text();
    let bound = |at: usize| (0..=at.min(text.len())).rfind(|i| text.is_char_boundary(*i));
    let (start, end) = (bound(range.start)?, bound(range.end)?);
    let start = text[..start].rfind('\n').map_or(0, |i| i + 1);
    let end = text[end..].find('\n').map_or(text.len(), |i| end + i + 1);
    let mut edits = format(a)?;
    edits.retain(|e| start <= e.range.start && e.range.end <= end);
    Some(edits)
}

/// Returns the edits that turn one string into another: only the differing parts of differing lines, so that a cursor
/// elsewhere stays where it is.
pub fn edits(old: &str, new: &str) -> Vec<Edit> {
    let (before, after): (Vec<&str>, Vec<&str>) = (lines(old), lines(new));
    let starts = starts(&before);
    let mut found = vec![];
    for (gone, come) in print::changes(&before, &after) {
        if gone.len() == come.len() {
            for (i, j) in gone.zip(come) {
                found.extend(within(starts[i], before[i], after[j]));
            }
        } else {
            found.push(Edit {
                range: starts[gone.start]..starts[gone.end],
                text: after[come].concat(),
            });
        }
    }
    found
}

/// Returns the edit of a line: the part between the common start and the common end.
pub(super) fn within(at: usize, old: &str, new: &str) -> Option<Edit> {
    let same = |(a, b): &(char, char)| a == b;
    let length = |(c, _): (char, char)| c.len_utf8();
    let head: usize = old
        .chars()
        .zip(new.chars())
        .take_while(same)
        .map(length)
        .sum();
    let (rest, other) = (&old[head..], &new[head..]);
    let ends = rest.chars().rev().zip(other.chars().rev());
    let tail: usize = ends.take_while(same).map(length).sum();
    let text = other[..other.len() - tail].to_owned();
    let range = at + head..at + old.len() - tail;
    (!range.is_empty() || !text.is_empty()).then_some(Edit { range, text })
}

/// Returns the lines of a source file with their line ends.
fn lines(text: &str) -> Vec<&str> {
    text.split_inclusive('\n').collect()
}

/// Returns the offsets at which lines begin, and the end of the last one.
fn starts(lines: &[&str]) -> Vec<usize> {
    let mut at = 0;
    let mut starts = vec![0];
    for line in lines {
        at += line.len();
        starts.push(at);
    }
    starts
}
