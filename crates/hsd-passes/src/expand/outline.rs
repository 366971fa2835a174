//! Outlines as surveyed: the walk of every storey without rows of its own (docs/contract.md 8).
//!
//! The outline is cleaned, squared and joined once for the house ([`hsd_base::geometry::outline`]); then its sides are the
//! lines of a walk from the right end of the front, and [`sides`] fills them.

mod part;
mod ring;
mod sides;

use super::Pass;
use crate::messages::outline as say;
use glam::{DVec2, dvec2};
use hsd_base::diagnostic::Diagnostic;
use hsd_base::geometry::outline::{self, Axis, Crooked, Ring, clean, join, square};
use hsd_base::geometry::{Heading, SHAKU, area2};
use hsd_base::rng::Place;
use hsd_base::source::{Span, Spanned};
use hsd_ir::ast::{self, On, Outline, SideWall, Stand, Storey};
use hsd_ir::program::{Drawn, House, Loop};
use ring::SurveyedRing;

/// The usual bounds on the moves of corners and walls, metres.
const SQUARE: f64 = 0.3;
const JOIN: f64 = 0.3;
/// Corners move so far even if they may not: no survey is more exact, metres.
const EXACT: f64 = 0.001;
/// Shorter sides are no fronts while another one is, metres.
const SHORT_FRONT: f64 = 0.9;
/// Lengths of squared outlines count in steps of U: walls are on one line or a millimetre apart.
const STEP: f64 = 1e-3;
/// Outlines smaller than that in both directions are no houses, but probably in degrees.
const DEGREES: f64 = 0.5;

/// The marks of sides: on a street, of a neighbour; from the rest on, numbers that walls are written for.
const ON_STREET: u32 = 1;
const OF_NEIGHBOUR: u32 = 2;
const NUMBERS: u32 = 4;

/// The outline of a house, ready to be walked.
pub(super) struct Surveyed {
    /// The outline, then its courtyards.
    rings: Vec<SurveyedRing>,
    /// How the house stands.
    stand: Stand,
    /// The right end of the front, metres east and north of the house's place.
    corner: DVec2,
    /// The compass direction of the front, degrees.
    azimuth: f64,
    /// True once a storey has the door of the house.
    has_door: bool,
    /// True if a note says why it is not square.
    told: bool,
}

/// A ring of the survey in the direction of a walk.
struct Written<'d> {
    points: &'d [Spanned<DVec2>],
    /// True if the walk goes through the points backwards.
    reversed: bool,
}

impl Written<'_> {
    /// Returns the number of sides.
    fn sides(&self) -> usize {
        let is_closed = self.points.first().map(|p| p.value) == self.points.last().map(|p| p.value);
        self.points.len() - usize::from(is_closed && self.points.len() > 1)
    }

    /// Returns the index of a side as written, from its index in the walk.
    fn written(&self, side: usize) -> usize {
        let n = self.sides();
        match self.reversed {
            true => (2 * n - 2 - side) % n,
            false => side,
        }
    }

    /// Returns the place of a corner in the text and its number from 1, from its index in the walk.
    fn corner(&self, corner: usize) -> (Span, usize) {
        let written = match self.reversed {
            true => self.sides() - 1 - corner,
            false => corner,
        };
        (self.points[written].span, written + 1)
    }

    /// Returns the corners in the direction of the walk.
    fn walk(&self) -> Vec<DVec2> {
        let points = self.points[..self.sides()].iter().map(|p| p.value);
        match self.reversed {
            true => points.rev().collect(),
            false => points.collect(),
        }
    }

    /// Returns the place of a side in the text, by its index as written.
    fn span(&self, side: usize) -> Span {
        let next = &self.points[(side + 1) % self.sides()];
        match side + 1 < self.sides() {
            true => self.points[side].span.to(next.span),
            false => self.points[side].span,
        }
    }
}

impl Pass<'_, '_> {
    /// Prepares the outline of a house, if it has one; one U is `unit` shaku. An outline that is no area has no rings.
    pub(super) fn survey(&mut self, house: &ast::House, unit: f64) -> Option<Surveyed> {
        let outline = house.outline.as_deref()?;
        let courts = outline.holes.iter().map(|hole| &hole.points);
        let rings = std::iter::once(&outline.points).chain(courts);
        let (mut written, mut cleaned) = (vec![], vec![]);
        for (number, points) in rings.enumerate() {
            let marks = |n: usize| match number {
                0 => mark(outline, house, n as u32 + 1),
                _ => 0,
            };
            match self.clean(points, number > 0, marks) {
                Some((ring, sides)) => {
                    written.push((points.span, ring));
                    cleaned.push(sides);
                }
                None if number == 0 => return Some(Surveyed::empty()),
                None => {}
            }
        }
        self.check_numbers(outline, house, written[0].1.sides());
        let (turn, rings, told) = self.square(outline, &written, cleaned);
        let front = front(outline, &written[0].1, &rings[0], turn);
        let surveyed = walk(outline.stand, &written, rings, turn, front, unit);
        Some(Surveyed { told, ..surveyed })
    }

    /// Removes what is no corner; nothing if no area is left.
    fn clean<'d>(
        &mut self,
        points: &'d Spanned<Vec<Spanned<DVec2>>>,
        hole: bool,
        mark: impl Fn(usize) -> u32,
    ) -> Option<(Written<'d>, Ring)> {
        if points.value.is_empty() {
            return None; // they could not be read, which was reported
        }
        let corners: Vec<DVec2> = points.value.iter().map(|p| p.value).collect();
        let first = corners.first().copied().unwrap_or_default();
        let about: Vec<DVec2> = corners.iter().map(|p| *p - first).collect();
        let area = area2(&about);
        let written = Written {
            points: &points.value,
            // The interior lies to the right of a walk; seen from above an outline is walked clockwise.
            reversed: (area > 0.0) != hole,
        };
        let (ring, removed) = match points.value.len() {
            0..3 => Default::default(),
            _ => {
                let walk = written.walk();
                let marks: Vec<u32> = (0..walk.len()).map(|n| mark(written.written(n))).collect();
                clean::clean(&walk, &marks)
            }
        };
        let far = about.iter().map(|p| p.abs().max_element());
        let extent = far.fold(0.0, f64::max);
        let degrees = corners.len() > 2 && extent < DEGREES;
        if ring.is_empty() || degrees {
            self.out.push(say::no_area(points.span, degrees));
            return None;
        }
        if removed != clean::Removed::default() {
            let (doubled, spikes) = (removed.doubled, removed.spikes);
            self.out.push(say::cleaned(points.span, doubled, spikes));
        }
        Some((written, ring))
    }

    /// Reports numbers of sides that the outline does not have.
    fn check_numbers(&mut self, outline: &Outline, house: &ast::House, sides: usize) {
        let lists = [&outline.street, &outline.neighbour];
        let listed = lists.into_iter().flatten();
        let ends = listed.flat_map(|l| l.value.iter().map(|r| Spanned::new(r.1, l.span)));
        let mut numbers: Vec<Spanned<u32>> = ends.chain(outline.front).collect();
        for_walls(house, &mut |wall| {
            if let On::Number(number) = wall.on.value {
                numbers.push(Spanned::new(number, wall.on.span));
            }
        });
        for number in numbers {
            if number.value as usize > sides {
                self.once(425, number.span, || {
                    say::no_such_side(number.span, number.value, sides)
                });
            }
        }
    }

    /// Squares and joins rings as far as the outline allows; returns the direction of their axes, and whether a note says
    /// why there is none.
    fn square(
        &mut self,
        outline: &Outline,
        written: &[(Span, Written<'_>)],
        rings: Vec<Ring>,
    ) -> (Option<f64>, Vec<Ring>, bool) {
        let given = outline.square.map_or(SQUARE, |most| most.value);
        let most = given.max(EXACT);
        let join = outline.join.map_or(JOIN, |most| most.value);
        let span = outline.points.span;
        let reason = match square::square(&rings, most) {
            Ok(mut squared) => {
                let joined = join::join(&mut squared.rings, join);
                if squared.moved > EXACT || joined > EXACT {
                    self.out.push(say::squared(span, squared.moved, joined));
                }
                return (Some(squared.turn), squared.rings, false);
            }
            Err(reason) => reason,
        };
        // Sides that cross as surveyed are reported once they are walls.
        let told = given > 0.0 && outline::are_simple(&rings);
        let partly = match reason {
            Crooked::Slants(..) if told => partly(outline, &written[0].1, &rings, most),
            _ => None,
        };
        let partly = partly.map(|mut squared| {
            squared.moved += join::join(&mut squared.rings, join);
            squared
        });
        if told {
            let moved = partly.as_ref().map(|squared| squared.moved);
            self.out.push(crooked(span, written, reason, (most, moved)));
        }
        match partly {
            Some(squared) => (Some(squared.turn), squared.rings, told),
            None => (None, rings, told),
        }
    }

    /// Returns the part of the outline on which walls stand; `None` if that is the whole.
    fn part_of(&mut self, surveyed: &Surveyed, walls: &ast::Walls) -> Option<Vec<SurveyedRing>> {
        let found = part::part(&surveyed.rings, walls.part?);
        if found.is_none() && !surveyed.rings.is_empty() {
            self.once(1144, walls.span, || say::nothing_there(walls.span));
        }
        found
    }

    /// Returns the walks of a storey that stands on the outline.
    pub(super) fn outlined(
        &mut self,
        storey: &Storey,
        surveyed: Option<&mut Surveyed>,
        place: Place,
    ) -> Vec<Loop> {
        let own = storey.loops.iter().find(|l| !l.hole && !l.inner);
        let walls = storey.walls.as_deref();
        match (surveyed, own, walls) {
            // Rows inside are rows of its own too.
            (Some(_), None, None) if !storey.loops.is_empty() => {}
            (Some(surveyed), None, walls) => {
                let place = place.named("outline");
                let part = walls.and_then(|walls| self.part_of(surveyed, walls));
                let rings = part.as_ref().unwrap_or(&surveyed.rings);
                let door = &mut surveyed.has_door;
                let mut filled = self.fill(rings, door, walls, place).into_iter();
                let rings = rings.iter();
                let walk = |ring: &SurveyedRing| Loop {
                    span: ring.span,
                    hole: ring.hole,
                    inner: false,
                    drawn: Drawn::Outline,
                    start: ring.start.into(),
                    lines: filled.next().unwrap_or_default(),
                };
                return rings.map(walk).filter(|l| !l.lines.is_empty()).collect();
            }
            (_, Some(own), Some(walls)) => {
                let rows = self.head(own.span);
                self.once(428, walls.span, || say::rows_and_walls(walls.span, rows));
            }
            (None, None, Some(walls)) => {
                self.once(427, walls.span, || say::walls_without_outline(walls.span));
            }
            _ => {}
        }
        vec![]
    }
}

impl Surveyed {
    /// Returns an outline without walls, for one that is none.
    fn empty() -> Surveyed {
        Surveyed {
            rings: vec![],
            stand: Stand::Facing,
            corner: DVec2::ZERO,
            azimuth: 180.0,
            has_door: false,
            told: false,
        }
    }

    /// Puts a house where its outline was surveyed.
    pub(super) fn stand(&self, house: &mut House) {
        if self.told {
            house.roofs.slant_told = true;
        }
        let Stand::Surveyed(turn) = self.stand else {
            return;
        };
        let corner = Heading::new(-turn).vector().rotate(self.corner);
        house.origin[0] += corner.x;
        house.origin[1] += corner.y;
        house.azimuth = Heading::new(self.azimuth + turn).degrees();
    }
}

/// Squares those walls that do not slant, if the front is one of them: a walk begins along an axis.
fn partly(
    outline: &Outline,
    written: &Written<'_>,
    rings: &[Ring],
    most: f64,
) -> Option<square::Squared> {
    let squared = square::square_partly(rings, most)?;
    let first = front(outline, written, &squared.rings[0], Some(squared.turn));
    let (p, q) = outline::ends(&squared.rings[0], first);
    (p.x == q.x || p.y == q.y).then_some(squared)
}

/// Says why an outline is not squared, or not as a whole; corners might move by `most` metres, and did by `moved`.
fn crooked(
    points: Span,
    written: &[(Span, Written<'_>)],
    reason: Crooked,
    (most, moved): (f64, Option<f64>),
) -> Diagnostic {
    match reason {
        Crooked::Slants(ring, side, angle) => {
            let written = &written[ring].1;
            let side = written.written(side);
            say::slants(
                written.span(side),
                side + 1,
                (angle, square::MOST_OFF),
                moved,
            )
        }
        Crooked::Moves(ring, corner, moved) => {
            let (span, number) = written[ring].1.corner(corner);
            say::moves(span, number, moved, most)
        }
        Crooked::Crosses => say::would_cross(points),
    }
}

/// Returns the mark of a side of the outline, by its number.
fn mark(outline: &Outline, house: &ast::House, number: u32) -> u32 {
    let mut mark = 0;
    if holds(&outline.street, number) {
        mark |= ON_STREET;
    }
    if holds(&outline.neighbour, number) {
        mark |= OF_NEIGHBOUR;
    }
    let mut written = false;
    for_walls(house, &mut |wall| {
        written |= wall.on.value == On::Number(number)
    });
    match written {
        true => mark + NUMBERS * number,
        false => mark,
    }
}

fn holds(list: &Option<Spanned<Vec<(u32, u32)>>>, number: u32) -> bool {
    let ranges = list.iter().flat_map(|list| &list.value);
    ranges.into_iter().any(|(a, b)| (*a..=*b).contains(&number))
}

/// Calls back with every wall of a side that is written in a house.
fn for_walls(house: &ast::House, each: &mut impl FnMut(&SideWall)) {
    fn within(items: &[ast::Item<Storey>], each: &mut impl FnMut(&SideWall)) {
        for item in items {
            match item {
                ast::Item::One(storey) => {
                    let sides = storey.walls.iter().flat_map(|walls| &walls.sides);
                    sides.into_iter().for_each(&mut *each);
                }
                ast::Item::Repeat(repeat) => within(&repeat.body, each),
                ast::Item::Random(_) | ast::Item::Replace(_) => {}
            }
        }
    }
    within(&house.storeys, each);
}

/// Returns the index of the side of a ring that holds a side as written.
fn holder(written: &Written<'_>, ring: &Ring, side: usize) -> Option<usize> {
    let count = written.sides();
    (0..ring.len()).find(|k| {
        let (from, to) = (ring[*k].corner, ring[(k + 1) % ring.len()].corner);
        let to = if to > from { to } else { to + count };
        (from..to).any(|n| written.written(n % count) == side)
    })
}

/// Returns the index of the side that is the front: the one given, the longest on a street, or the southernmost.
fn front(outline: &Outline, written: &Written<'_>, ring: &Ring, turn: Option<f64>) -> usize {
    let given = outline.front.map(|front| front.value as usize);
    let given = given.filter(|n| (1..=written.sides()).contains(n));
    if let Some(side) = given.and_then(|n| holder(written, ring, n - 1)) {
        return side;
    }
    let length = |side: usize| {
        let (p, q) = outline::ends(ring, side);
        p.distance(q)
    };
    let on_street = (0..ring.len()).filter(|side| ring[*side].mark & ON_STREET > 0);
    if let Some(longest) = on_street.reduce(|a, b| if length(b) > length(a) { b } else { a }) {
        return longest;
    }
    let back = Heading::new(turn.unwrap_or(0.0).to_degrees()).vector();
    let north = |side: usize| {
        let (p, q) = outline::ends(ring, side);
        back.rotate(p.midpoint(q)).y
    };
    let all = |least: f64| (0..ring.len()).filter(move |side| length(*side) >= least);
    let least = |a: usize, b: usize| if north(b) < north(a) { b } else { a };
    all(SHORT_FRONT)
        .reduce(least)
        .or_else(|| all(0.0).reduce(least))
        .unwrap_or(0)
}

/// Returns the walks of rings in the author frame, from the right end of the front.
fn walk(
    stand: Stand,
    written: &[(Span, Written<'_>)],
    rings: Vec<Ring>,
    turn: Option<f64>,
    front: usize,
    unit: f64,
) -> Surveyed {
    let (from, to) = outline::ends(&rings[0], front);
    let along = match (turn, Axis::of(to - from)) {
        (None, _) => (to - from).normalize(),
        (Some(_), Axis::X) => dvec2((to - from).x.signum(), 0.0),
        (Some(_), Axis::Y) => dvec2(0.0, (to - from).y.signum()),
    };
    let back = dvec2(along.y, -along.x);
    let metres = unit * SHAKU;
    let place = |p: DVec2| {
        let p = dvec2((p - from).dot(along), (p - from).dot(back)) / metres;
        match turn {
            Some(_) => (p / STEP).round() * STEP,
            None => p,
        }
    };
    let rings = rings.iter().zip(written).enumerate();
    let rings = rings.filter(|(_, (ring, _))| !ring.is_empty());
    let rings = rings.map(|(number, (ring, (span, written)))| {
        let first = if number == 0 { front } else { 0 };
        let corners: Vec<DVec2> = (0..ring.len())
            .map(|k| place(ring[(first + k) % ring.len()].from))
            .collect();
        SurveyedRing {
            span: *span,
            hole: number > 0,
            start: corners[0],
            first: match number {
                0 => 0.0,
                _ => {
                    let first = corners[1] - corners[0];
                    libm::atan2(first.y, first.x).to_degrees()
                }
            },
            sides: sides::of(written, ring, first, &corners, number > 0),
        }
    });
    // The frame of squared rings is turned against that of the survey.
    let turn = turn.unwrap_or(0.0);
    let outward = -back;
    let azimuth = libm::atan2(outward.x, outward.y).to_degrees() - turn.to_degrees();
    Surveyed {
        rings: rings.collect(),
        stand,
        corner: dvec2(libm::cos(turn), libm::sin(turn)).rotate(from),
        azimuth: (azimuth * 1e9).round() / 1e9,
        has_door: false,
        told: false,
    }
}
