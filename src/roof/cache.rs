//! Houses of one plan get one plan's roofs: rows and towns repeat their houses, and roofs are the dearest step.

use crate::ast::{RoofLine, RoofStyle};
use crate::building::{House, HouseRoofs, Ring, Storey, Wall};
use crate::diagnostic::Diagnostic;
use crate::program::Roofs;
use crate::source::{Span, Spanned};
use glam::DVec2;
use std::collections::HashMap;

/// All that the roofs of a house depend on, to the last bit.
#[derive(PartialEq, Eq, Hash)]
pub(super) struct Plan(Vec<u64>);

/// What was built for the first house of each plan.
#[derive(Default)]
pub(super) struct RoofCache<'a> {
    /// Never walked, so that its order cannot matter.
    known: HashMap<Plan, First<'a>>,
}

struct First<'a> {
    house: &'a House,
    number: usize,
    /// What was said about it.
    told: Vec<Diagnostic>,
}

impl<'a> RoofCache<'a> {
    /// The roofs of a house like one before it, and what was said about them, with the places of this house.
    pub(super) fn twin(
        &self,
        house: &House,
        plan: &Plan,
        roofs: &[HouseRoofs],
    ) -> Option<(HouseRoofs, Vec<Diagnostic>)> {
        let first = self.known.get(plan)?;
        let mut roofs = roofs.get(first.number)?.clone();
        let mut told = first.told.clone();
        let mut places: Vec<&mut Span> = roofs
            .roofs
            .iter_mut()
            .filter_map(|r| r.span.as_mut())
            .collect();
        for diagnostic in &mut told {
            places.push(&mut diagnostic.span);
            places.extend(diagnostic.labels.iter_mut().map(|l| &mut l.span));
        }
        if !places.is_empty() {
            let pairs = pairs(&spans(first.house), &spans(house))?;
            for place in places {
                *place = *pairs.get(place)?;
            }
        }
        Some((roofs, told))
    }

    /// Keeps what was built for the first house of a plan.
    pub(super) fn keep(
        &mut self,
        plan: Plan,
        house: &'a House,
        number: usize,
        told: Vec<Diagnostic>,
    ) {
        let first = First {
            house,
            number,
            told,
        };
        self.known.insert(plan, first);
    }
}

/// Every place of a house that roofs or messages about them may have, in one order for all houses of a plan.
fn spans(house: &House) -> Vec<Span> {
    let mut spans = vec![house.span];
    spans.extend(house.roofs.wished);
    style_spans(&house.roofs.style, &mut spans);
    for line in &house.roofs.lines {
        spans.extend([line.span, line.corners.span]);
        spans.extend(line.direction.map(|d| d.span));
        spans.extend(line.height.map(|h| h.span));
        style_spans(&line.style, &mut spans);
    }
    for storey in &house.storeys {
        spans.push(storey.span);
        for ring in &storey.rings {
            spans.push(ring.span);
            spans.extend(ring.walls.iter().map(|w| w.span));
        }
    }
    spans
}

fn style_spans(style: &RoofStyle, spans: &mut Vec<Span>) {
    let numbers = [
        style.pitch,
        style.eaves,
        style.verge,
        style.thickness,
        style.sori,
        style.gable,
        style.ratio,
    ];
    spans.extend(style.kind.map(|k| k.span));
    spans.extend(style.shape.map(|s| s.span));
    spans.extend(numbers.into_iter().flatten().map(|n| n.span));
    spans.extend(style.noshi.map(|n| n.span));
    spans.extend(style.plain_ridge.map(|p| p.span));
}

/// The place in one house of each place in another; none where one stands for two.
fn pairs(from: &[Span], to: &[Span]) -> Option<HashMap<Span, Span>> {
    let mut pairs = HashMap::with_capacity(from.len());
    let mut plain = from.len() == to.len();
    for (from, to) in from.iter().zip(to) {
        plain &= pairs.insert(*from, *to).is_none_or(|known| known == *to);
    }
    plain.then_some(pairs)
}

impl Plan {
    pub(super) fn of(house: &House) -> Plan {
        // Everything is named, so that a new field is not forgotten.
        let House {
            span: _,
            name: _,
            variant: _,
            origin: _,
            azimuth: _,
            age: _,
            unit,
            street,
            storeys,
            raised: _,
            platform: _,
            finials: _,
            roofs,
        } = house;
        let Roofs {
            mode,
            method,
            wished,
            style,
            lines,
        } = roofs;
        let mut words = Words(Vec::with_capacity(64));
        words.number(*unit);
        words.flags(&[*street, wished.is_some()]);
        words.0.extend([*mode as u64, *method as u64]);
        words.style(style);
        words.0.push(lines.len() as u64);
        lines.iter().for_each(|line| words.line(line));
        storeys.iter().for_each(|storey| words.storey(storey));
        Plan(words.0)
    }
}

struct Words(Vec<u64>);

impl Words {
    fn number(&mut self, number: f64) {
        self.0.push(number.to_bits());
    }

    fn point(&mut self, p: DVec2) {
        self.number(p.x);
        self.number(p.y);
    }

    fn flags(&mut self, flags: &[bool]) {
        let bits = flags
            .iter()
            .fold(1, |bits, flag| bits << 1 | u64::from(*flag));
        self.0.push(bits);
    }

    fn wish<T: Copy>(&mut self, wish: &Option<Spanned<T>>, word: impl Fn(T) -> u64) {
        self.flags(&[wish.is_some()]);
        self.0.extend(wish.as_ref().map(|w| word(w.value)));
    }

    fn style(&mut self, style: &RoofStyle) {
        let RoofStyle {
            kind,
            shape,
            pitch,
            eaves,
            verge,
            thickness,
            noshi,
            sori,
            gable,
            ratio,
            plain_ridge,
        } = style;
        self.wish(kind, |kind| kind as u64);
        self.wish(shape, |shape| shape as u64);
        for length in [pitch, eaves, verge, thickness, sori, gable, ratio] {
            self.wish(length, f64::to_bits);
        }
        self.wish(noshi, u64::from);
        self.wish(plain_ridge, u64::from);
    }

    fn line(&mut self, line: &RoofLine) {
        let RoofLine {
            span: _,
            style,
            direction,
            height,
            corners,
        } = line;
        self.style(style);
        self.wish(direction, |direction| direction as u64);
        self.wish(height, f64::to_bits);
        corners.value.iter().for_each(|u| self.number(*u));
    }

    fn storey(&mut self, storey: &Storey) {
        let Storey {
            span: _,
            number,
            kind,
            z0,
            z1,
            order: _,
            rings,
        } = storey;
        self.0
            .extend([u64::from(*number), *kind as u64, rings.len() as u64]);
        self.number(*z0);
        self.number(*z1);
        rings.iter().for_each(|ring| self.ring(ring));
    }

    fn ring(&mut self, ring: &Ring) {
        let Ring {
            span: _,
            hole,
            closed,
            inner,
            walls,
        } = ring;
        self.flags(&[*hole, *closed, *inner]);
        self.0.push(walls.len() as u64);
        for wall in walls {
            let Wall {
                span: _,
                facade,
                from,
                to,
                direction,
                units: _,
                reflection: _,
            } = wall;
            self.0.push(u64::from(*facade));
            self.point(*from);
            self.point(*to);
            self.point(*direction);
        }
    }
}
