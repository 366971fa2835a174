//! Messages about characters that were fixed in a line; which of them are reported depends on the kind of the line.

use super::line::{Odd, SourceLine, after_name};
use crate::messages::legacy as say;
use crate::parse;
use crate::parse::reporter::Reporter;
use hsd_base::diagnostic::messages::file;
use hsd_base::source::Span;
use hsd_ir::catalog::PartDef;
use hsd_ir::messages::parts;
use std::ops::Range;

impl Reporter<'_> {
    /// Reports what was fixed in a wall line up to `end`, an offset in `raw` where a comment may begin:
    /// every character before it stands for a column.
    pub(super) fn fixed_walls(&mut self, line: &SourceLine<'_>, end: usize) {
        for (i, finding) in line.findings.iter().enumerate() {
            if finding.range.start < end {
                self.fixed(line, i);
            }
        }
    }

    /// Reports what was fixed in a line of fields: any white space counts as a blank there, and a
    /// word that is still wrong is reported as a word.
    pub(super) fn fixed_fields(&mut self, line: &SourceLine<'_>) {
        for (i, finding) in line.findings.iter().enumerate() {
            if matches!(finding.kind, Odd::Wide | Odd::Invisible | Odd::Control) {
                self.fixed(line, i);
            }
        }
    }

    /// Reports what was fixed in a line whose text from `free` on, an offset in `raw`, is the author's.
    pub(super) fn fixed_before(&mut self, line: &SourceLine<'_>, free: usize) {
        for (i, finding) in line.findings.iter().enumerate() {
            let own = finding.range.start >= free;
            let wide = matches!(finding.kind, Odd::Wide | Odd::Invisible);
            if finding.kind == Odd::Control || wide && !own {
                self.fixed(line, i);
            }
        }
    }

    fn fixed(&mut self, line: &SourceLine<'_>, number: usize) {
        let finding = &line.findings[number];
        let written = &line.raw[finding.range.clone()];
        if finding.kind == Odd::Replacement {
            return; // Said once of the whole file.
        }
        let first = written.chars().next().unwrap_or(' ');
        let read = line.read(finding.range.clone());
        let span = self.raw_span(line, finding.range.clone());
        let run = wide_run(line, number);
        let whole = self.raw_span(line, run.clone());
        let source = self.source;
        self.push(|| match finding.kind {
            Odd::WideBlank => say::wide_blank(span, written.chars().count(), read),
            Odd::Tab => say::tab(span, read),
            Odd::Wide => say::wide_letters(span, written, whole, line.read(run)),
            Odd::Invisible | Odd::OtherBlank => say::other_blank(span, first, read),
            Odd::Control => file::control_character(span, first),
            Odd::PartName => {
                let part = parse::builtin().called(written);
                let end = after_name(line.raw, finding.range.start, finding.range.end);
                let cells = source.span(line.at + finding.range.start..line.at + end);
                let code = part.map_or("", PartDef::code);
                parts::part_name(span, written, code, cells)
            }
            Odd::Foreign | Odd::Replacement => say::foreign(span, written),
        });
    }

    fn raw_span(&self, line: &SourceLine<'_>, range: Range<usize>) -> Span {
        self.source.span(line.at + range.start..line.at + range.end)
    }
}

/// Returns a finding and the wide blanks right after it: among wide letters they are as wide as these.
fn wide_run(line: &SourceLine<'_>, number: usize) -> Range<usize> {
    let range = line.findings[number].range.clone();
    let next = line.findings.get(number + 1);
    let blanks = next.filter(|n| n.kind == Odd::WideBlank && n.range.start == range.end);
    range.start..blanks.map_or(range.end, |n| n.range.end)
}
