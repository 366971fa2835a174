//! The first line of a house of the legacy form: where it stands and which way it faces.

use crate::stroke::sheet::Sheet;
use hsd_syntax::parse::syntax::{LegacyLine, LineKind};
use std::ops::Range;

/// Its numbers where the line leaves them out: metres east and north, degrees.
pub(crate) const USUAL: [f64; 3] = [0.0, 0.0, 180.0];

/// The words of the line, and the place of those that are left out.
#[derive(Clone, Debug)]
pub(crate) struct FirstLine {
    /// The ranges of x, y and azimuth, as many as there are.
    pub(crate) words: Vec<Range<usize>>,
    /// The end of the last of them, or the place of the whole line.
    pub(crate) end: usize,
    /// The number of line ends after a line that is put in.
    pub(crate) line_ends: usize,
}

impl FirstLine {
    /// Returns the first line of the house whose text contains a place; none where there is no house.
    pub(crate) fn of(sheet: &Sheet<'_>, at: usize) -> Option<FirstLine> {
        let lines = &sheet.outline.lines;
        let own = sheet.outline.line_at(at)?;
        let divides = |l: &LegacyLine| l.kind == LineKind::Separator;
        let from = lines[..own].iter().rposition(divides).map_or(0, |n| n + 1);
        let mut section = lines[from..].iter().take_while(|l| !divides(l));
        let header =
            |l: &&LegacyLine| l.kind == LineKind::Header && is_place(&sheet.text[l.range.clone()]);
        if let Some(line) = section.clone().find(header) {
            let text = &sheet.text[line.range.clone()];
            let start =
                |word: &str| line.range.start + (word.as_ptr() as usize - text.as_ptr() as usize);
            let words = text.split_whitespace().take(USUAL.len());
            let words: Vec<Range<usize>> = words.map(|w| start(w)..start(w) + w.len()).collect();
            let end = words.last()?.end;
            return Some(FirstLine {
                words,
                end,
                line_ends: 0,
            });
        }
        let content =
            |l: &&LegacyLine| matches!(l.kind, LineKind::Header | LineKind::Wall | LineKind::Roof);
        let next = section.find(content)?;
        let line_ends = if next.kind == LineKind::Header { 1 } else { 2 };
        Some(FirstLine {
            words: vec![],
            end: next.range.start,
            line_ends,
        })
    }

    /// Returns its numbers as written; none if a word is no plain number.
    pub(crate) fn numbers(&self, text: &str) -> Option<[f64; 3]> {
        let mut numbers = USUAL;
        for (number, word) in numbers.iter_mut().zip(&self.words) {
            *number = text[word.clone()]
                .parse()
                .ok()
                .filter(|n: &f64| n.is_finite())?;
        }
        Some(numbers)
    }
}

/// Returns true if a line of a header begins with a number.
fn is_place(line: &str) -> bool {
    let bare = line.trim_start().trim_start_matches(['+', '-', '.']);
    bare.starts_with(|c: char| c.is_ascii_digit())
}
