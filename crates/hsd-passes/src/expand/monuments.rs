//! Monuments (`docs/evidence.md` 4.8, 7.10): a pagoda, a gate, a hall or a shrine becomes storeys of bays, posts,
//! verandas, brackets, a platform and roofs, as an author could write them out. Elements beside it in its house
//! (`Platform`, `Posts`, `Brackets`, `Finial`, `Roofs`) replace those that it would make.
//!
//! - [`draft`]: the house under construction;
//! - [`pagoda`], [`gate`], [`hall`]: one element each.

mod draft;
mod gate;
mod hall;
mod pagoda;

use super::Pass;
use crate::messages::fittings::{self as say, Scarce};
use draft::Draft;
use hsd_base::diagnostic::messages::limits;
use hsd_base::source::{Span, Spanned};
use hsd_ir::ast::{self, Given, Monument, RoofStyle};
use hsd_ir::program::{Content, House, Storey, Unit};

/// Parts of the limit that a storey of a monument counts as.
const PARTS_A_STOREY: u64 = 1250;

impl<'c> Pass<'_, 'c> {
    /// Returns the storeys of a monument; `None` for other houses.
    pub(super) fn monument(&mut self, house: &ast::House, unit: f64) -> Option<Draft<'c>> {
        let monument = house.monument.as_ref()?;
        let span = monument.span();
        let storeys = house.storeys.iter().map(place_of);
        let outline = house.outline.iter().map(|outline| outline.span);
        let walls = storeys.chain(house.structures.iter().map(|s| s.span));
        let all: Vec<Span> = walls.chain(outline).collect();
        if let Some(first) = all.first() {
            let first = self.head(*first);
            let told = say::storeys_beside(span, name(monument), first, all);
            self.out.push(told);
        }
        let mut draft = Draft::new(span, unit, self.codes.catalog);
        if self.written_short > self.most_storeys() {
            // Reported for the first of them. Excess storeys are not computed.
            self.over = true;
            return Some(draft);
        }
        match &**monument {
            Monument::Pagoda(it) => self.pagoda(it, &mut draft),
            Monument::Gate(it) => self.gate(it, &mut draft),
            Monument::Hall(it) => self.hall(it, &mut draft),
        }
        let parts = draft.parts();
        self.charge(parts, span);
        self.charge_storeys(draft.storeys.len() as u64, span);
        Some(draft)
    }

    /// Replaces codes of storeys by the parts that the house means by them.
    pub(super) fn own_parts(&self, mut storeys: Vec<Storey>) -> Vec<Storey> {
        let loops = storeys.iter_mut().flat_map(|s| &mut s.loops);
        for unit in loops.flat_map(|l| &mut l.lines).flat_map(|l| &mut l.units) {
            self.own_part(unit);
        }
        storeys
    }

    fn own_part(&self, unit: &mut Unit) {
        match &mut unit.content {
            Content::Part(id) => *id = self.codes.own_part(*id),
            Content::Split(split) => {
                let halves = split.upper.iter_mut().chain(&mut split.lower);
                halves.for_each(|unit| self.own_part(unit));
            }
            Content::Picture(_) | Content::Void => {}
        }
    }

    /// Returns the maximum number of storeys that all monuments of a run may have together.
    fn most_storeys(&self) -> u64 {
        self.bounds.own / PARTS_A_STOREY
    }

    /// Counts storeys of a monument against the limit: a few letters make a storey with its roof, posts and brackets,
    /// which is far more work than a line of codes, and all houses of a run share the limit.
    fn charge_storeys(&mut self, storeys: u64, span: Span) {
        let most = self.most_storeys();
        self.written_short = self.written_short.saturating_add(storeys);
        if self.written_short > most && !self.over {
            self.over = true;
            self.out.push(limits::too_many_storeys(span, most));
        }
    }

    /// Raises a height to the minimum, and reports it.
    fn at_least(&mut self, span: Span, what: Scarce, has: f64, least: f64) -> f64 {
        if has < least {
            self.once(704, span, || say::no_room(span, what, has, least));
        }
        has.max(least)
    }
}

/// Adds the elements that a monument makes to a house, except those written explicitly.
pub(super) fn furnish(made: &mut House, draft: Draft<'_>) {
    made.platform = made.platform.take().or(draft.platform);
    if made.finials.is_empty() {
        made.finials = draft.finials;
    }
    made.roofs.style = overlaid(&made.roofs.style, &draft.style);
    made.roofs.lines.extend(draft.lines);
    made.roofs.wished = made.roofs.wished.or(Some(draft.span));
}

/// Applies the defaults of a house to its storeys.
pub(super) fn share(storeys: &mut [Storey], fittings: &ast::Fittings, short: bool) {
    for storey in storeys {
        let order = &mut storey.order;
        // Beside a monument they replace its own.
        if short || order.posts.is_none() {
            order.posts = fittings.posts.clone().or(order.posts.take());
        }
        if short || order.brackets.is_none() {
            order.brackets = fittings.brackets.clone().or(order.brackets.take());
        }
    }
}

/// Returns the first style, completed by the second.
fn overlaid(over: &RoofStyle, under: &RoofStyle) -> RoofStyle {
    RoofStyle {
        kind: over.kind.or(under.kind),
        shape: over.shape.or(under.shape),
        pitch: over.pitch.or(under.pitch),
        eaves: over.eaves.or(under.eaves),
        verge: over.verge.or(under.verge),
        thickness: over.thickness.or(under.thickness),
        noshi: over.noshi.or(under.noshi),
        sori: over.sori.or(under.sori),
        gable: over.gable.or(under.gable),
        ratio: over.ratio.or(under.ratio),
        plain_ridge: over.plain_ridge.or(under.plain_ridge),
        gable_wall: over.gable_wall.or(under.gable_wall),
        offset: over.offset.or(under.offset),
        paint: over.paint.or(under.paint),
    }
}

fn name(monument: &Monument) -> &'static str {
    match monument {
        Monument::Pagoda(_) => "Pagoda",
        Monument::Gate(_) => "Gate",
        Monument::Hall(h) if h.shrine => "Shrine",
        Monument::Hall(_) => "Hall",
    }
}

fn place_of(item: &ast::Item<ast::Storey>) -> Span {
    match item {
        ast::Item::One(storey) => storey.span,
        ast::Item::Repeat(repeat) => repeat.span,
        ast::Item::Random(random) => random.span,
        ast::Item::Replace(replace) => replace.span,
    }
}

/// Returns a number, or its default.
fn or(given: Given, default: f64) -> f64 {
    given.map_or(default, |n| n.value)
}

/// Returns a whole number, or its default.
fn count(given: Option<Spanned<u64>>, default: u32) -> u32 {
    given.map_or(default, |n| u32::try_from(n.value).unwrap_or(default))
}
