//! A row of pieces to a row of units: parts, splits and slots in order, then the edits over the result.
//!
//! Each `random` is classified as a slot or an edit before anything is placed. In a floor the base row
//! decides: parts of its own make every `random` an edit. In a row of a house a `random` holds its place
//! in the outline, unless a code of its list is beside it (grammar/README.md).

use super::codes::{Mode, Which};
use super::edits::{EditRef, Strip, numbered};
use super::repeat::weigh_all;
use super::{Pass, positive};
use hsd_base::rng::Place;
use hsd_base::source::Span;
use hsd_ir::ast::{CodeText, Half, Item, Part, Piece, Random};
use hsd_ir::program::Unit;
use std::collections::HashMap;

/// The operations of a row in document order, and which of them are slots.
#[derive(Default)]
pub(super) struct RowEdits<'d> {
    list: Vec<(EditRef<'d>, u64)>,
    /// The ordinal of each slot, by the address of its `random`; it is the key of its choices.
    slots: HashMap<usize, u64>,
}

impl<'d> RowEdits<'d> {
    fn gather(pieces: &'d [Item<Piece>]) -> Vec<(EditRef<'d>, u64)> {
        let mut list = vec![];
        gather(pieces, &mut list);
        numbered(list.into_iter()).collect()
    }
}

fn gather<'d>(pieces: &'d [Item<Piece>], list: &mut Vec<EditRef<'d>>) {
    for item in pieces {
        match item {
            Item::One(_) => {}
            Item::Repeat(repeat) if repeat.num.value > 0 => gather(&repeat.body, list),
            Item::Repeat(_) => {}
            Item::Random(random) => list.push(EditRef::Random(random)),
            Item::Replace(replace) => list.push(EditRef::Replace(replace)),
        }
    }
}

/// Returns true if a row has parts of its own; operations do not count.
pub(super) fn has_parts(pieces: &[Item<Piece>]) -> bool {
    pieces.iter().any(|item| match item {
        Item::One(_) => true,
        Item::Repeat(repeat) => repeat.num.value > 0 && has_parts(&repeat.body),
        Item::Random(_) | Item::Replace(_) => false,
    })
}

fn address(random: &Random) -> usize {
    std::ptr::from_ref(random).addr()
}

impl Pass<'_, '_> {
    /// Expands an independent row: a row of a house, the half of a split, or a floor.
    pub(super) fn strip(&mut self, pieces: &[Item<Piece>], place: Place, mode: Mode) -> Strip {
        let list = RowEdits::gather(pieces);
        let edits = if list.is_empty() {
            RowEdits::default()
        } else {
            self.sort_out(pieces, list, mode)
        };
        let mut strip = self.base_strip(pieces, &edits, place, mode);
        self.edit_strip(&edits, &mut strip);
        strip
    }

    /// Expands the parts of a row, and of its operations only the slots.
    pub(super) fn base_strip(
        &mut self,
        pieces: &[Item<Piece>],
        edits: &RowEdits<'_>,
        place: Place,
        mode: Mode,
    ) -> Strip {
        let mut strip = Strip {
            // A growing list would need twice the memory while it moves.
            units: Vec::with_capacity(weigh_all(pieces).min(self.room()) as usize),
            place,
            mode,
            natural: false,
        };
        self.pieces(pieces, edits, &mut strip);
        strip
    }

    /// Applies the operations of a floor whose parts come from elsewhere.
    pub(super) fn edit_borrowed(&mut self, pieces: &[Item<Piece>], strip: &mut Strip) {
        let edits = RowEdits {
            list: RowEdits::gather(pieces),
            ..RowEdits::default()
        };
        self.edit_strip(&edits, strip);
    }

    fn edit_strip(&mut self, edits: &RowEdits<'_>, strip: &mut Strip) {
        for (edit, ordinal) in &edits.list {
            match edit {
                EditRef::Random(random) if edits.slots.contains_key(&address(random)) => {}
                _ => self.edit(*edit, *ordinal, strip),
            }
        }
    }

    fn sort_out<'d>(
        &mut self,
        pieces: &'d [Item<Piece>],
        list: Vec<(EditRef<'d>, u64)>,
        mode: Mode,
    ) -> RowEdits<'d> {
        let mut standing = vec![];
        if mode.is_row() {
            self.codes_of(pieces, &mut standing);
            standing.sort_unstable();
            standing.dedup();
        }
        let all_edits = !mode.is_row() && has_parts(pieces);
        let mut slots = HashMap::new();
        for (edit, ordinal) in &list {
            let EditRef::Random(random) = edit else {
                continue;
            };
            let operation = self.operation(*edit, mode);
            let stands = |which: &Which| standing.binary_search(which).is_ok();
            if !all_edits && !operation.codes.iter().flatten().any(stands) {
                slots.insert(address(random), *ordinal);
            }
        }
        RowEdits { list, slots }
    }

    /// Returns the codes of the parts of a row, including the halves of its splits.
    fn codes_of(&mut self, pieces: &[Item<Piece>], codes: &mut Vec<Which>) {
        for item in pieces {
            match item {
                Item::One(Piece::Code(five, span)) => {
                    codes.push(self.resolve(&CodeText::Five(*five), *span).which);
                }
                Item::One(Piece::Part(part)) => {
                    codes.push(self.resolve(&part.code.value, part.code.span).which);
                }
                Item::One(Piece::Split(split)) => {
                    self.codes_of(&split.upper.pieces, codes);
                    self.codes_of(&split.lower.pieces, codes);
                }
                Item::Repeat(repeat) if repeat.num.value > 0 => {
                    self.codes_of(&repeat.body, codes);
                }
                Item::One(Piece::Error(_))
                | Item::Repeat(_)
                | Item::Random(_)
                | Item::Replace(_) => {}
            }
        }
    }

    fn pieces(&mut self, pieces: &[Item<Piece>], edits: &RowEdits<'_>, strip: &mut Strip) {
        for item in pieces {
            match item {
                Item::One(Piece::Code(five, span)) => self.code(*five, *span, strip),
                Item::One(Piece::Part(part)) => self.part(part, strip),
                Item::One(Piece::Error(span)) => {
                    let plain = self.codes.plain_part();
                    self.push(bare_unit(*span, 1.0, plain), false, strip);
                }
                Item::One(Piece::Split(split)) => {
                    let place = strip.place.at(strip.units.len() as u64);
                    let (unit, natural) = self.split(split, place, strip.mode);
                    self.push(unit, natural, strip);
                }
                Item::Repeat(repeat) => {
                    for _ in 0..self.rounds(repeat) {
                        self.pieces(&repeat.body, edits, strip);
                    }
                }
                Item::Random(random) => {
                    if let Some(ordinal) = edits.slots.get(&address(random)) {
                        self.slot(random, *ordinal, strip);
                    }
                }
                Item::Replace(_) => {}
            }
            if self.stopped() {
                return;
            }
        }
    }

    #[inline]
    fn code(&mut self, five: [u8; 5], span: Span, strip: &mut Strip) {
        let found = self.resolve(&CodeText::Five(five), span);
        let natural = found.width.is_none() && !strip.mode.is_row();
        let width = self.codes.own_width_of(&found, strip.mode);
        self.push(bare_unit(span, width, found.which), natural, strip);
    }

    fn part(&mut self, part: &Part, strip: &mut Strip) {
        let found = self.resolve(&part.code.value, part.code.span);
        let given = part.width.as_ref().map(|width| width.value);
        let given = given.filter(|width| *width >= 0.0);
        let natural = given.is_none() && found.width.is_none() && !strip.mode.is_row();
        let width = match given.or(found.width) {
            Some(width) => width,
            None => self.codes.own_width(found.which, strip.mode),
        };
        let unit = Unit {
            span: part.code.span,
            width,
            content: found.which.content(),
            height: part.height.as_ref().and_then(positive).map(|h| h as f32),
            reflection: None,
            picture: None,
        };
        self.push(unit, natural, strip);
    }

    fn slot(&mut self, random: &Random, ordinal: u64, strip: &mut Strip) {
        let place = strip.place.at(strip.units.len() as u64);
        if let Some((found, width)) = self.draw_slot(random, strip.mode, place, ordinal) {
            let natural = found.width.is_none() && !strip.mode.is_row();
            let unit = bare_unit(random.span, width, found.which);
            self.push(unit, natural, strip);
        }
    }

    #[inline]
    pub(super) fn push(&mut self, unit: Unit, natural: bool, strip: &mut Strip) {
        if self.charge(1, unit.span) {
            strip.units.push(unit);
            strip.natural |= natural;
        }
    }

    /// Expands the half of a split, which is an element of its own for the operations in it.
    pub(super) fn half(&mut self, half: &Half, place: Place, mode: Mode) -> Strip {
        self.strip(&half.pieces, place, mode)
    }
}

/// Creates a unit without attributes.
pub(super) fn bare_unit(span: Span, width: f64, which: Which) -> Unit {
    Unit {
        span,
        width,
        content: which.content(),
        height: None,
        reflection: None,
        picture: None,
    }
}
