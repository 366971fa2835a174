//! `random` and `replace` as edits: both act on the fully expanded row of the
//! enclosing element, including the halves of splits, and change its units (docs/contract.md 3).

mod random;
mod replace;

use super::Pass;
use super::codes::{Found, Mode, Which};
use hsd_base::rng::Place;
use hsd_base::source::{Span, Spanned};
use hsd_ir::ast::{Random, Replace};
use hsd_ir::messages::parts as say;
use hsd_ir::program::{Content, Unit};
use std::cell::Cell;
use std::rc::Rc;

/// An operation as written.
#[derive(Clone, Copy)]
pub(super) enum EditRef<'d> {
    Random(&'d Random),
    Replace(&'d Replace),
}

impl EditRef<'_> {
    pub(super) fn span(self) -> Span {
        match self {
            EditRef::Random(random) => random.span,
            EditRef::Replace(replace) => replace.span,
        }
    }

    /// Distinguishes operations; their spans do not if a definition is used twice.
    fn address(self) -> usize {
        match self {
            EditRef::Random(random) => std::ptr::from_ref(random).addr(),
            EditRef::Replace(replace) => std::ptr::from_ref(replace).addr(),
        }
    }
}

/// Returns operations with their ordinals in their element, which enter the keys of their random choices. Only `random`
/// counts, so that adding a substitution changes no choice.
pub(super) fn numbered<'d>(
    edits: impl Iterator<Item = EditRef<'d>>,
) -> impl Iterator<Item = (EditRef<'d>, u64)> {
    edits.scan(0, |next, edit| {
        let ordinal = *next;
        *next += u64::from(matches!(edit, EditRef::Random(_)));
        Some((edit, ordinal))
    })
}

/// A row of units with the context needed to edit it.
pub(super) struct Strip {
    pub(super) units: Vec<Unit>,
    /// The row's place in the keys of random choices.
    pub(super) place: Place,
    pub(super) mode: Mode,
    /// True if some width was derived only from an image's proportions.
    pub(super) natural: bool,
}

impl Strip {
    /// Returns the sum of the widths in U.
    pub(super) fn width(&self) -> f64 {
        self.units.iter().map(|unit| unit.width).sum()
    }
}

/// An operation whose codes were looked up, once however often it is applied.
pub(super) struct Operation {
    span: Span,
    /// The code to replace; `None` = every code.
    pub(super) codes: Option<Vec<Which>>,
    /// The replacements, with the running sums of their weights.
    pub(super) choices: Vec<Found>,
    pub(super) sums: Vec<f64>,
    /// Positions from 1, as inclusive ranges, ascending and apart.
    pub(super) at: Option<Spanned<Vec<(u32, u32)>>>,
    draws: bool,
    hit: Cell<bool>,
    longest: Cell<usize>,
}

impl Operation {
    pub(super) fn new(edit: EditRef<'_>, choices: Vec<Found>) -> Operation {
        Operation {
            span: edit.span(),
            codes: None,
            choices,
            sums: vec![],
            at: None,
            draws: matches!(edit, EditRef::Random(_)),
            hit: Cell::new(false),
            longest: Cell::new(0),
        }
    }

    fn wants(&self, which: Option<Which>, position: u32) -> bool {
        let coded = match (&self.codes, which) {
            (None, _) => true,
            (Some(_), None) => false,
            (Some(codes), Some(which)) => codes.binary_search(&which).is_ok(),
        };
        coded
            && self
                .at
                .as_ref()
                .is_none_or(|at| within(&at.value, position))
    }

    fn pick(&self, site: Site) -> usize {
        if self.choices.len() == 1 {
            return 0; // Most substitutions: no hash is needed for them.
        }
        site.row.at(site.index).at(site.key).pick(&self.sums)
    }

    /// Marks it as used, as a slot does.
    pub(super) fn used(&self) {
        self.hit.set(true);
    }
}

fn within(ranges: &[(u32, u32)], position: u32) -> bool {
    let next = ranges.partition_point(|range| range.0 <= position);
    next > 0 && position <= ranges[next - 1].1
}

impl Pass<'_, '_> {
    /// Looks up the codes of an operation.
    pub(super) fn operation(&mut self, edit: EditRef<'_>, mode: Mode) -> Rc<Operation> {
        let address = edit.address();
        if let Some(index) = self.operation_index.get(&address) {
            return Rc::clone(&self.operations[*index]);
        }
        let operation = Rc::new(match edit {
            EditRef::Random(random) => self.prepare_random(random, mode),
            EditRef::Replace(replace) => self.prepare_replace(replace),
        });
        self.operation_index.insert(address, self.operations.len());
        self.operations.push(Rc::clone(&operation));
        operation
    }

    /// Applies an operation to a row. `key` distinguishes it from the other operations of its element.
    pub(super) fn edit(&mut self, edit: EditRef<'_>, key: u64, strip: &mut Strip) {
        let operation = self.operation(edit, strip.mode);
        let longest = operation.longest.get().max(strip.units.len());
        operation.longest.set(longest);
        if operation.choices.is_empty() {
            operation.used();
        }
        if operation.choices.is_empty() || self.stopped() {
            return;
        }
        let mut units = std::mem::take(&mut strip.units);
        for (index, unit) in units.iter_mut().enumerate() {
            let site = Site {
                row: strip.place,
                index: index as u64,
                key,
                position: index as u32 + 1,
                mode: strip.mode,
                inside: false,
            };
            strip.natural |= self.edit_unit(&operation, unit, site);
        }
        strip.units = units;
    }

    /// Applies an operation to a unit; returns true if the unit took its width from an image's proportions.
    fn edit_unit(&mut self, operation: &Operation, unit: &mut Unit, site: Site) -> bool {
        if !self.work(1, operation.span) {
            return false;
        }
        let which = Which::of(&unit.content);
        // A position without codes means the whole split, not its pieces.
        let piece = operation.codes.is_none() && site.inside;
        if !piece && operation.wants(which, site.position) {
            operation.used();
            let choice = operation.pick(site);
            return self.put(operation.span, unit, operation.choices[choice], site);
        }
        if let Content::Split(split) = &mut unit.content {
            let halves = [(1, &mut split.upper), (2, &mut split.lower)];
            for (half, units) in halves {
                let row = site.row.at(site.index).at(half);
                for (index, unit) in (0..).zip(units) {
                    let inner = Site {
                        row,
                        index,
                        inside: true,
                        ..site
                    };
                    self.edit_unit(operation, unit, inner);
                }
            }
        }
        false
    }

    /// Replaces the content of a unit. In a row the width stays, and another one is an error; in a floor it follows,
    /// since the floor is scaled; inside a split it stays, since the halves fit.
    fn put(&mut self, span: Span, unit: &mut Unit, new: Found, site: Site) -> bool {
        let old = Which::of(&unit.content);
        let own = self.codes.own_width_of(&new, site.mode);
        let usual = old.map_or(unit.width, |old| self.codes.own_width(old, site.mode));
        let differs = (own - usual).abs() >= hsd_base::geometry::SAME;
        let follows = !site.inside && !site.mode.is_row();
        if differs && site.mode.is_row() && (own - unit.width).abs() >= hsd_base::geometry::SAME {
            let (there, here) = (unit.span, unit.width);
            let name = self.codes.name(new.which).to_owned();
            self.once(307, span, || {
                say::replaced_width(span, &name, own, there, here)
            });
        }
        let plain = (unit.width - usual).abs() < hsd_base::geometry::SAME;
        let natural = follows && plain && new.width.is_none();
        if follows && plain {
            unit.width = own;
        }
        unit.content = new.which.content();
        natural
    }

    /// Reports the operations of the house that never found a match.
    pub(super) fn report_idle_operations(&mut self) {
        for operation in std::mem::take(&mut self.operations) {
            let beyond = operation.at.as_ref().and_then(|at| {
                let last = at.value.iter().map(|range| range.1).max()?;
                (last as usize > operation.longest.get()).then_some((at.span, last))
            });
            let (span, longest) = (operation.span, operation.longest.get());
            match beyond {
                Some((at, last)) => self.out.push(say::beyond_the_row(at, last, longest)),
                None if operation.hit.get() => {}
                None if operation.draws => self.out.push(say::idle_random(span)),
                None => self.out.push(say::idle_replace(span)),
            }
        }
        self.operation_index.clear();
    }
}

/// The place at which an operation acts.
#[derive(Clone, Copy)]
struct Site {
    row: Place,
    /// Index in that row.
    index: u64,
    /// Distinguishes the operation from the others of its element.
    key: u64,
    /// Position in the outermost row, from 1.
    position: u32,
    mode: Mode,
    inside: bool,
}
