//! The base row of a facade's floor: its own parts, otherwise those of the floor of the same id elsewhere, otherwise
//! the part images `f{facade}f{floor}f{n}` (003-15, `docs/evidence.md` 8).

use super::Pass;
use super::codes::{Found, Mode, Which};
use super::edits::Strip;
use super::rows::{RowEdits, bare_unit, has_parts};
use super::split::{EVEN, common_width, divided, fit};
use hsd_base::rng::Place;
use hsd_base::source::Span;
use hsd_ir::ast::{Floor, Item, Piece};
use hsd_ir::messages::parts as say;
use std::collections::BTreeMap;

/// The floors of a structure that have parts of their own, by id.
#[derive(Default)]
pub(super) struct Bases<'d> {
    by_facade: BTreeMap<(String, usize), &'d Floor>,
    anywhere: BTreeMap<String, &'d Floor>,
}

impl<'d> Bases<'d> {
    /// Records a floor of the facade of this index; the first of an id counts.
    pub(super) fn add(&mut self, facade: usize, floor: &'d Floor) {
        let Some(id) = floor.id.as_ref().filter(|_| has_parts(&floor.pieces)) else {
            return;
        };
        let id = letter(&id.value);
        self.by_facade.entry((id.into(), facade)).or_insert(floor);
        self.anywhere.entry(id.into()).or_insert(floor);
    }

    fn find(&self, facade: usize, id: &str) -> Option<&'d Floor> {
        let id = letter(id).to_owned();
        let near = self.by_facade.get(&(id.clone(), facade));
        near.or_else(|| self.anywhere.get(&id)).copied()
    }
}

/// Returns the id, with `t` for `top`.
fn letter(id: &str) -> &str {
    if id == "top" { "t" } else { id }
}

/// A floor at its place.
pub(super) struct FloorAt<'a> {
    pub(super) floor: &'a Floor,
    /// Index of its facade, and the facade's name in names of images.
    pub(super) facade: usize,
    pub(super) facade_id: &'a str,
    /// Number of the storey, without parapets: the name of a floor that has none.
    pub(super) number: usize,
    pub(super) place: Place,
    pub(super) mode: Mode,
}

impl Pass<'_, '_> {
    /// Returns the row of a floor with its operations applied.
    pub(super) fn floor(&mut self, at: &FloorAt<'_>, bases: &Bases<'_>) -> Strip {
        let pieces = &at.floor.pieces;
        let id = match &at.floor.id {
            Some(id) => id.value.clone(),
            None => at.number.to_string(),
        };
        if !has_parts(pieces)
            && let Some(mut strip) = self.borrowed(at, bases, &id)
        {
            self.edit_borrowed(pieces, &mut strip);
            return strip;
        }
        let strip = self.strip(pieces, at.place, at.mode);
        if strip.units.is_empty() && !self.stopped() && !has_slots(pieces) && !has_parts(pieces) {
            let span = self.head(at.floor.span);
            let picture = format!("f{}f{}f1", at.facade_id, letter(&id));
            self.once(312, span, || say::floor_without_parts(span, &id, &picture));
        }
        strip
    }

    fn borrowed(&mut self, at: &FloorAt<'_>, bases: &Bases<'_>, id: &str) -> Option<Strip> {
        if let Some(base) = bases.find(at.facade, id) {
            let none = RowEdits::default();
            return Some(self.base_strip(&base.pieces, &none, at.place, at.mode));
        }
        let names = if id == "top" {
            &["top", "t"][..]
        } else {
            &[id]
        };
        let mut stems = names
            .iter()
            .map(|name| format!("f{}f{name}f", at.facade_id));
        stems.find_map(|stem| self.pictures_of(at, &stem))
    }

    fn pictures_of(&mut self, at: &FloorAt<'_>, stem: &str) -> Option<Strip> {
        let mut strip = empty(at.place, at.mode);
        for number in 1.. {
            if self.stopped() || !self.picture_part(at, &format!("{stem}{number}"), &mut strip) {
                break;
            }
        }
        (!strip.units.is_empty()).then_some(strip)
    }

    /// Adds the part of one number: one image, or an upper and a lower one. Returns false if there is none.
    fn picture_part(&mut self, at: &FloorAt<'_>, name: &str, strip: &mut Strip) -> bool {
        let span = at.floor.span;
        if let Some(found) = self.codes.picture(name) {
            self.picture_unit(found, span, strip);
            return true;
        }
        let halves = at.mode.share(EVEN);
        let place = at.place.at(strip.units.len() as u64);
        let mut upper = self.picture_half(name, 'u', span, empty(place, halves));
        if upper.units.is_empty() {
            return false;
        }
        let mut lower = self.picture_half(name, 'l', span, empty(place, halves));
        if lower.units.is_empty() {
            // Without a lower image nothing was divided: the pieces stand side by side.
            self.once(319, span, || say::no_lower_picture(span, name));
            for unit in upper.units {
                if let Some(which) = Which::of(&unit.content) {
                    let found = Found { which, width: None };
                    self.picture_unit(found, span, strip);
                }
            }
            return true;
        }
        let width = common_width(&upper, &lower);
        fit(&mut upper, width, span);
        fit(&mut lower, width, span);
        self.push(divided(span, EVEN, width, upper, lower), true, strip);
        true
    }

    fn picture_half(&mut self, name: &str, half: char, span: Span, mut strip: Strip) -> Strip {
        for number in 1.. {
            let found = self.codes.picture(&format!("{name}{half}{number}"));
            let Some(found) = found.filter(|_| !self.stopped()) else {
                break;
            };
            self.picture_unit(found, span, &mut strip);
        }
        strip
    }

    fn picture_unit(&mut self, found: Found, span: Span, strip: &mut Strip) {
        let width = self.codes.own_width_of(&found, strip.mode);
        self.push(bare_unit(span, width, found.which), true, strip);
    }
}

fn empty(place: Place, mode: Mode) -> Strip {
    Strip {
        units: vec![],
        place,
        mode,
        natural: false,
    }
}

fn has_slots(pieces: &[Item<Piece>]) -> bool {
    pieces.iter().any(|item| match item {
        Item::Random(_) => true,
        Item::Repeat(repeat) => repeat.num.value > 0 && has_slots(&repeat.body),
        Item::One(_) | Item::Replace(_) => false,
    })
}
