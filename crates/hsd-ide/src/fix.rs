//! All fixes of a source file at once. A fix may reveal further errors, so fixed files are read again and fixed again,
//! and the best result is taken; it is offered only if it is better than the file as it is.

use crate::Analysis;
use crate::format::{Edit, edits};
use hsd_base::diagnostic::{self, Severity};
use hsd_base::source::Span;
use std::collections::BTreeMap;

/// Returns the number of errors, then of all diagnostics, of a source file.
fn badness(a: &Analysis) -> (usize, usize) {
    let errors = a.diagnostics.iter();
    let errors = errors.filter(|d| d.severity == Severity::Error).count();
    (errors, a.diagnostics.len())
}

/// Returns the number of fixes that improve a source file, and their edits; `None` if none do. `read` analyses a source
/// file in the place of this one, at most `rounds` times.
pub fn fix_all(
    a: &Analysis,
    read: &dyn Fn(&str) -> Analysis,
    rounds: usize,
) -> Option<(usize, Vec<Edit>)> {
    let (mut least, mut best) = (badness(a), None);
    let (mut count, mut last): (usize, Option<Analysis>) = (0, None);
    for _ in 0..rounds {
        let Some((text, done)) = round(last.as_ref().unwrap_or(a)) else {
            break;
        };
        count += done;
        let next = read(&text);
        let bad = badness(&next);
        if bad < least {
            least = bad;
            best = Some((count, text));
        }
        last = Some(next);
    }
    let (count, text) = best?;
    Some((count, edits(a.text(), &text)))
}

/// Applies the first fix of each diagnostic, as far as they do not overlap; returns the source file and the number of
/// fixes.
fn round(a: &Analysis) -> Option<(String, usize)> {
    // Sorted by their ends, so that none overlaps another.
    let mut taken: BTreeMap<u32, (u32, &diagnostic::Edit)> = BTreeMap::new();
    let mut count = 0;
    for fix in a.diagnostics.iter().filter_map(|d| d.fixes.first()) {
        let spans = || fix.edits.iter().map(|e| e.span);
        let own = spans().all(|s| s.file == a.source.id());
        let meets = |s: Span| {
            let next = taken.range(s.start..).next();
            next.is_some_and(|(_, (start, _))| *start <= s.end)
        };
        if own && !spans().any(meets) {
            taken.extend(fix.edits.iter().map(|e| (e.span.end, (e.span.start, e))));
            count += 1;
        }
    }
    let mut text = a.text().to_owned();
    for (_, edit) in taken.values().rev() {
        text.replace_range(a.source.text_range(edit.span), &edit.text);
    }
    (count > 0).then_some((text, count))
}
