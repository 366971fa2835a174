//! `random`: a random choice from a list (003-10). If a code of the list is in the enclosing element, it replaces that
//! code anew; otherwise it is a slot, one part at its place in the row.

use super::{EditRef, Operation};
use crate::expand::Pass;
use crate::expand::codes::{Found, Mode};
use hsd_base::geometry::SAME;
use hsd_base::rng::Place;
use hsd_ir::ast::Random;
use hsd_ir::messages::parts as say;

impl Pass<'_, '_> {
    pub(in crate::expand) fn prepare_random(&mut self, random: &Random, mode: Mode) -> Operation {
        let list = self.list(&random.codes);
        if mode.is_row()
            && let Some((first, rest)) = list.split_first()
        {
            let width = |found: &Found| self.codes.own_width_of(found, mode);
            let usual = width(&first.0);
            let other = rest
                .iter()
                .find(|(f, _)| (width(f) - usual).abs() >= SAME)
                .map(|(found, span)| (width(found), *span));
            if let Some((other, span)) = other {
                self.once(306, span, || say::drawn_widths(span, other, first.1, usual));
            }
        }
        let choices: Vec<Found> = list.into_iter().map(|(found, _)| found).collect();
        let mut codes: Vec<_> = choices.iter().map(|found| found.which).collect();
        codes.sort_unstable();
        let sums = self.weight_sums(random, choices.len());
        let mut operation = Operation::new(EditRef::Random(random), choices);
        operation.codes = Some(codes);
        operation.sums = sums;
        operation
    }

    /// Returns the content of a slot; `None` if its list is empty. In a row the outline must not depend on the choice,
    /// so the first code's width counts.
    pub(in crate::expand) fn draw_slot(
        &mut self,
        random: &Random,
        mode: Mode,
        place: Place,
        key: u64,
    ) -> Option<(Found, f64)> {
        let operation = self.operation(EditRef::Random(random), mode);
        operation.used();
        let first = *operation.choices.first()?;
        let drawn = operation.choices[place.at(key).pick(&operation.sums)];
        let wide = if mode.is_row() { &first } else { &drawn };
        Some((drawn, self.codes.own_width_of(wide, mode)))
    }
}
