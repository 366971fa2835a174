//! `Platform`, `Posts`, `Veranda`, `Brackets`, `Finial`: what stands at a house besides walls and roofs.

use super::read::{Attributes, Reader};
use super::schema::{Schema, Tag};
use super::tree::Element;
use super::values::{LENGTH, SIZE};
use crate::ast::{
    Brackets, Finial, FinialKind, House, Order, Paint, Platform, Posts, Rail, Side, Veranda,
};
use crate::diagnostic::messages::xml as say;
use crate::source::Span;
use std::ops::RangeInclusive;

const SIDES: &[(&str, Side)] = &[
    ("F", Side::Front),
    ("B", Side::Back),
    ("L", Side::Left),
    ("R", Side::Right),
];

const RAILS: &[(&str, Rail)] = &[
    ("none", Rail::None),
    ("crossed", Rail::Crossed),
    ("knobbed", Rail::Knobbed),
];

/// Heights and depths of what stands at a house, shaku: no platform is higher than a hill.
const NEAR: RangeInclusive<f64> = 0.0..=300.0;
/// Posts and the like, shaku.
const THICK: RangeInclusive<f64> = 0.1..=20.0;
/// More rows of beams than this do not fit a wall.
const ROWS: RangeInclusive<u64> = 0..=5;
/// Brackets of more steps were never built.
const STEPS: RangeInclusive<u64> = 0..=4;

/// From the walls to the edge of a platform, shaku.
const MARGIN: f64 = 6.0;

impl<'t> Reader<'t, '_> {
    /// Reads what belongs to a house as a whole. False where it is something else.
    pub(super) fn fitting(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
        house: &mut House,
    ) -> bool {
        let fittings = &mut house.fittings;
        let first = match schema.tag {
            Tag::Platform => {
                let read = self.platform(schema, element);
                keep(&mut fittings.platform, read, |p| p.span)
            }
            Tag::Posts => {
                let read = self.posts(schema, element);
                keep(&mut fittings.posts, read, |p| p.span)
            }
            Tag::Brackets => {
                let read = self.brackets(schema, element);
                keep(&mut fittings.brackets, read, |b| b.span)
            }
            Tag::Finial => {
                fittings.finials.extend(self.finial(schema, element));
                None
            }
            _ => return false,
        };
        self.only(schema, element, "House", first);
        true
    }

    /// Reads what belongs to a storey. False where it is something else.
    pub(super) fn order(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
        order: &mut Order,
    ) -> bool {
        let first = match schema.tag {
            Tag::Posts => {
                let read = self.posts(schema, element);
                keep(&mut order.posts, read, |p| p.span)
            }
            Tag::Veranda => {
                let read = self.veranda(schema, element);
                keep(&mut order.veranda, read, |v| v.span)
            }
            Tag::Brackets => {
                let read = self.brackets(schema, element);
                keep(&mut order.brackets, read, |b| b.span)
            }
            _ => return false,
        };
        self.only(schema, element, "Storey", first);
        true
    }

    /// Reports a second one of what there is one of.
    pub(super) fn only(
        &mut self,
        schema: &'static Schema,
        element: &Element<'_>,
        parent: &str,
        first: Option<Span>,
    ) {
        if let Some(first) = first {
            self.faults.at(&element.name_range, |s| {
                say::second_of(s, schema.name, parent, first)
            });
        }
    }

    fn platform(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Platform {
        let of = self.attributes(schema, element);
        self.no_children(element);
        let margin = self.pair(&of, "margin", NEAR);
        Platform {
            span: self.start(element),
            height: self.number(&of, "height", NEAR).map_or(3.0, |h| h.value),
            margin: margin.map_or([MARGIN; 2], |m| m.value),
            stairs: self.sides(&of, "stairs"),
            width: self.number(&of, "width", SIZE).map(|w| w.value),
        }
    }

    fn posts(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Posts {
        let of = self.attributes(schema, element);
        self.no_children(element);
        let nageshi = self.whole_number(&of, "nageshi", ROWS);
        Posts {
            span: self.start(element),
            size: self.number(&of, "size", THICK).map_or(0.4, |s| s.value),
            round: self.yes_no(&of, "round").is_some_and(|r| r.value),
            paint: self.paint(&of).unwrap_or_default(),
            nageshi: nageshi.map_or(0, |n| n.value as u32),
        }
    }

    fn veranda(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Veranda {
        let of = self.attributes(schema, element);
        self.no_children(element);
        Veranda {
            span: self.start(element),
            width: self.number(&of, "width", LENGTH).map_or(3.0, |w| w.value),
            height: self.number(&of, "height", NEAR).map_or(0.0, |h| h.value),
            rail: self
                .choice(&of, "rail", RAILS)
                .map_or(Rail::None, |r| r.value),
            stairs: self.sides(&of, "stairs"),
            paint: self.paint(&of),
        }
    }

    fn brackets(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Brackets {
        let of = self.attributes(schema, element);
        self.no_children(element);
        Brackets {
            span: self.start(element),
            steps: self
                .whole_number(&of, "steps", STEPS)
                .map_or(0, |s| s.value as u32),
            height: self.number(&of, "height", NEAR).map(|h| h.value),
            out: self.number(&of, "out", NEAR).map(|o| o.value),
            paint: self.paint(&of),
        }
    }

    fn finial(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> Option<Finial> {
        let of = self.attributes(schema, element);
        self.no_children(element);
        let count = self.whole_number(&of, "count", 0..=99);
        Some(Finial {
            span: self.start(element),
            kind: self.choice(&of, "kind", &FinialKind::ALL)?.value,
            height: self.number(&of, "height", SIZE).map(|h| h.value),
            count: count.map(|c| c.value as u32),
            at: self.point(&of, "at"),
        })
    }

    fn paint(&mut self, of: &Attributes<'t>) -> Option<Paint> {
        self.choice(of, "paint", &Paint::ALL).map(|p| p.value)
    }

    /// Sides such as `"F B"`, each once.
    fn sides(&mut self, of: &Attributes<'t>, name: &str) -> Vec<Side> {
        let mut sides = vec![];
        for side in self.words(of, name, SIDES) {
            if !sides.contains(&side) {
                sides.push(side);
            }
        }
        sides
    }
}

/// Keeps the first of what there is one of; the span of that one where this is another.
fn keep<T>(place: &mut Option<T>, read: T, span: fn(&T) -> Span) -> Option<Span> {
    let first = place.as_ref().map(span);
    place.get_or_insert(read);
    first
}
