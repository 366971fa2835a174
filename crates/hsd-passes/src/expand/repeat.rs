//! `repeat`: content several times (003-08), at every level from parts to facades; and the limit that keeps a mistyped
//! number from exhausting memory.
//!
//! The output of a repetition is counted before it is generated, with saturation, so that nested repetitions are caught
//! as well. Operations inside a repetition act on the output of that repetition.

use super::Pass;
use super::bounds::Exceeded;
use super::edits::{EditRef, numbered};
use hsd_base::diagnostic::messages::limits as say;
use hsd_base::source::Span;
use hsd_ir::ast::{Edit, Facade, Floor, Item, Loop, Piece, Repeat, Row, Storey};

/// Estimates the number of parts that a construct makes; 1 for empty ones, which cost memory as well.
pub(super) trait Weigh {
    /// The list that a `random` of this kind belongs to.
    const SLOT: u64 = 0;
    fn weigh(&self) -> u64;
}

impl Weigh for Piece {
    const SLOT: u64 = 1;
    fn weigh(&self) -> u64 {
        match self {
            Piece::Code(..) | Piece::Part(_) | Piece::Error(_) => 1,
            Piece::Split(split) => weigh_all(&split.upper.pieces)
                .saturating_add(weigh_all(&split.lower.pieces))
                .saturating_add(1),
        }
    }
}

impl Weigh for Row {
    fn weigh(&self) -> u64 {
        weigh_all(&self.pieces).max(1)
    }
}

impl Weigh for Storey {
    fn weigh(&self) -> u64 {
        let rows = |l: &Loop| weigh_all(&l.rows).max(1);
        let sum = self.loops.iter().map(rows);
        sum.fold(0, u64::saturating_add).max(1)
    }
}

impl Weigh for Floor {
    fn weigh(&self) -> u64 {
        weigh_all(&self.pieces).max(1)
    }
}

impl Weigh for Facade {
    fn weigh(&self) -> u64 {
        weigh_all(&self.floors).max(1)
    }
}

pub(super) fn weigh_all<T: Weigh>(items: &[Item<T>]) -> u64 {
    let weigh = |item: &Item<T>| match item {
        Item::One(one) => one.weigh(),
        Item::Repeat(repeat) => weigh_repeat(repeat),
        Item::Random(_) => T::SLOT,
        Item::Replace(_) => 0,
    };
    items.iter().map(weigh).fold(0, u64::saturating_add)
}

fn weigh_repeat<T: Weigh>(repeat: &Repeat<T>) -> u64 {
    weigh_all(&repeat.body).saturating_mul(u64::from(repeat.num.value))
}

/// An operation and the things it acts on.
#[derive(Clone, Copy)]
pub(super) struct Scoped<'d> {
    pub(super) edit: EditRef<'d>,
    /// Distinguishes the operations of one element and its levels in the keys of random choices.
    pub(super) key: u64,
    pub(super) from: usize,
    pub(super) to: usize,
}

/// Items of one kind without repetitions, and the operations beside them, innermost first.
pub(super) struct Flat<'d, T> {
    pub(super) ones: Vec<&'d T>,
    pub(super) edits: Vec<Scoped<'d>>,
}

impl Pass<'_, '_> {
    /// Expands the repetitions of a list. `level` distinguishes the kinds of lists in the keys of random choices.
    pub(super) fn flatten<'d, T: Weigh>(
        &mut self,
        items: &'d [Item<T>],
        level: u64,
    ) -> Flat<'d, T> {
        let mut flat = Flat {
            ones: Vec::with_capacity(items.len()),
            edits: vec![],
        };
        self.flatten_into(items, level, &mut flat);
        flat
    }

    fn flatten_into<'d, T: Weigh>(
        &mut self,
        items: &'d [Item<T>],
        level: u64,
        flat: &mut Flat<'d, T>,
    ) {
        let from = flat.ones.len();
        for item in items {
            match item {
                Item::One(one) => flat.ones.push(one),
                Item::Repeat(repeat) => {
                    for _ in 0..self.rounds(repeat) {
                        self.flatten_into(&repeat.body, level + 1, flat);
                    }
                }
                Item::Random(_) | Item::Replace(_) => {}
            }
        }
        let to = flat.ones.len();
        for (edit, ordinal) in numbered(edits(items)) {
            if from < to && self.work(EDIT_ROOM, edit.span()) {
                let key = (level << 32) | ordinal;
                flat.edits.push(Scoped {
                    edit,
                    key,
                    from,
                    to,
                });
            }
        }
    }

    /// Returns the number of repetitions: 0 if they would make nothing or exceed the limit.
    pub(super) fn rounds<T: Weigh>(&mut self, repeat: &Repeat<T>) -> u32 {
        let weight = weigh_repeat(repeat);
        if let Some(exceeded) = self.bounds.exceeded_by(self.spent, weight) {
            self.stop(exceeded, repeat.num.span);
        }
        if weight == 0 || self.stopped() {
            return 0;
        }
        repeat.num.value
    }

    /// Counts parts against the limit; returns false if it is exceeded.
    #[inline]
    pub(super) fn charge(&mut self, parts: u64, span: Span) -> bool {
        self.spent.parts += parts;
        self.judge(span)
    }

    /// Counts what holds parts against the limit of the run; returns false if it is exceeded.
    pub(super) fn charge_frame(&mut self, frame: u64, span: Span) -> bool {
        self.spent.frames += frame;
        self.judge(span)
    }

    /// Counts steps of an operation against the limit; returns false if it is exceeded. Operations times parts grow
    /// faster than the file.
    pub(super) fn work(&mut self, steps: u64, span: Span) -> bool {
        self.spent.steps += steps;
        self.judge(span)
    }

    #[inline]
    fn judge(&mut self, span: Span) -> bool {
        if let Some(exceeded) = self.bounds.exceeded(self.spent) {
            self.stop(exceeded, span);
        }
        !self.stopped()
    }

    pub(super) fn room(&self) -> u64 {
        self.bounds.room(self.spent)
    }

    #[cold]
    fn stop(&mut self, exceeded: Exceeded, span: Span) {
        if !self.over {
            self.over = true;
            self.out.push(match exceeded {
                Exceeded::House(limit) => say::too_many_parts(span, limit),
                Exceeded::Run(limit) => say::too_many_repeated(span, limit),
            });
        }
    }

    /// Returns true if work on the house was abandoned.
    pub(super) fn stopped(&self) -> bool {
        self.over
    }
}

/// Recording an operation costs memory, more than a step.
const EDIT_ROOM: u64 = 10;

/// Returns the operations among items, in order.
pub(super) fn edits<'d, T>(items: &'d [Item<T>]) -> impl Iterator<Item = EditRef<'d>> {
    items.iter().filter_map(|item| match item {
        Item::Random(random) => Some(EditRef::Random(random)),
        Item::Replace(replace) => Some(EditRef::Replace(replace)),
        Item::One(_) | Item::Repeat(_) => None,
    })
}

/// Returns the operations of a storey, in order.
pub(super) fn storey_edits(edits: &[Edit]) -> impl Iterator<Item = EditRef<'_>> {
    edits.iter().map(|edit| match edit {
        Edit::Random(random) => EditRef::Random(random),
        Edit::Replace(replace) => EditRef::Replace(replace),
    })
}
