//! The sections of a legacy file: its houses, their storeys and their roofs, as ranges of lines.

use hsd_syntax::parse::syntax::LineKind;
use hsd_syntax::parse::syntax::{LegacyLine, Outline};
use std::ops::Range;

/// A house of a legacy file; ranges count lines.
#[derive(Clone, Debug, Default)]
pub(super) struct House {
    /// From its first line that is not blank to its last, comments included.
    pub(super) lines: Range<usize>,
    /// Its header.
    pub(super) header: Option<Range<usize>>,
    /// The wall lines of each storey.
    pub(super) storeys: Vec<Range<usize>>,
    /// Its roof lines.
    pub(super) roofs: Option<Range<usize>>,
}

/// Returns the houses of a legacy file.
pub(super) fn houses(outline: &Outline, text: &str) -> Vec<House> {
    let lines = &outline.lines;
    let mut found = vec![];
    let mut start = 0;
    while start < lines.len() {
        let separator = |l: &LegacyLine| l.kind == LineKind::Separator;
        let end = lines[start..].iter().position(separator);
        let end = end.map_or(lines.len(), |i| start + i);
        found.extend(house(lines, start..end, text));
        start = end + 1;
    }
    found
}

fn house(lines: &[LegacyLine], range: Range<usize>, text: &str) -> Option<House> {
    let written = |i: &usize| lines[*i].kind != LineKind::Blank;
    let first = range.clone().find(written)?;
    let last = range.clone().rfind(written)?;
    let mut house = House {
        lines: first..last + 1,
        ..House::default()
    };
    let mut open: Option<Range<usize>> = None;
    for (number, line) in lines.iter().enumerate().take(last + 1).skip(first) {
        match line.kind {
            LineKind::Header => grow(&mut house.header, number),
            LineKind::Roof => grow(&mut house.roofs, number),
            LineKind::Wall => {
                grow(&mut open, number);
                let turn = line.turn.clone().and_then(|t| text.get(t));
                if turn == Some("^") {
                    house.storeys.extend(open.take());
                }
            }
            LineKind::Blank | LineKind::Comment | LineKind::Separator => {}
        }
    }
    house.storeys.extend(open);
    Some(house)
}

fn grow(range: &mut Option<Range<usize>>, line: usize) {
    let start = range.as_ref().map_or(line, |r| r.start);
    *range = Some(start..line + 1);
}

/// Converts a range of lines to a range of the file.
pub(super) fn text_range(outline: &Outline, lines: &Range<usize>) -> Range<usize> {
    let start = outline.lines.get(lines.start).map_or(0, |l| l.range.start);
    let last = lines.end.checked_sub(1).and_then(|l| outline.lines.get(l));
    start..last.map_or(start, |l| l.range.end).max(start)
}
