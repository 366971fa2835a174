//! `replace`: a substitution (003-11), of codes, at positions, or of codes at positions. Positions count
//! the units of each row from 1; a split is one unit.

use super::{EditRef, Operation};
use crate::expand::Pass;
use hsd_base::source::Spanned;
use hsd_ir::ast::Replace;
use hsd_ir::messages::parts as say;

impl Pass<'_, '_> {
    pub(in crate::expand) fn prepare_replace(&mut self, replace: &Replace) -> Operation {
        let codes = replace.codes.as_ref().map(|codes| {
            let list = self.list(codes);
            let mut codes: Vec<_> = list.iter().map(|(found, _)| found.which).collect();
            codes.sort_unstable();
            codes
        });
        let mut with = self.list(&replace.with);
        if let Some((_, second)) = with.get(1) {
            let span = *second;
            self.once(322, span, || say::several_withs(span));
        }
        with.truncate(1);
        let choices = with.into_iter().map(|(found, _)| found).collect();
        let mut operation = Operation::new(EditRef::Replace(replace), choices);
        operation.codes = codes;
        operation.sums = vec![1.0];
        operation.at = replace.at.as_ref().map(merged);
        operation
    }
}

/// Returns ranges sorted and merged, so that a position is found by binary search.
fn merged(at: &Spanned<Vec<(u32, u32)>>) -> Spanned<Vec<(u32, u32)>> {
    let turned = |&(a, b): &(u32, u32)| (a.min(b), a.max(b));
    let mut ranges: Vec<_> = at.value.iter().map(turned).collect();
    ranges.sort_unstable();
    let mut apart: Vec<(u32, u32)> = vec![];
    for range in ranges {
        match apart.last_mut() {
            Some(last) if range.0 <= last.1 => last.1 = last.1.max(range.1),
            _ => apart.push(range),
        }
    }
    Spanned::new(apart, at.span)
}
