//! What stands on the sides of an outline: a run of parts that is repeated and stretched, with first and last parts, and
//! a door once in the house.

use super::{OF_NEIGHBOUR, ON_STREET, SurveyedRing, Written};
use crate::expand::codes::Mode;
use crate::expand::edits::Strip;
use crate::expand::rows::bare_unit;
use crate::expand::split::fit;
use crate::expand::{Pass, bounds};
use crate::messages::outline as say;
use glam::DVec2;
use hsd_base::geometry::SAME;
use hsd_base::geometry::outline::Ring;
use hsd_base::rng::Place;
use hsd_base::source::Span;
use hsd_ir::ast::{CodeText, Half, Item, On, Piece, SidePart, SideWall, Walls};
use hsd_ir::program::{Unit, WallLine};

/// The largest share by which a run is stretched or shortened.
const MOST_STRETCH: f64 = 0.08;
/// Longer walls are a mistake that `lower` reports, U.
const LONGEST: f64 = 1e5;
/// The part of walls that nothing is written for.
const PLAIN: [u8; 5] = *b"KSK  ";

/// Smaller turns are none, degrees.
pub(super) const TURNED: f64 = 1e-9;

/// A side of an outline.
#[derive(Clone)]
pub(super) struct SurveyedSide {
    pub(super) span: Span,
    /// Where it begins, author frame, U.
    from: DVec2,
    /// Its number as written, from 1; 0 if it is cut through the outline.
    pub(super) number: usize,
    /// Its length, U.
    length: f64,
    /// The turn at its end, degrees.
    turn: f64,
    /// The numbers as written of all sides that it unites; a courtyard has none.
    numbers: Vec<u32>,
    is_front: bool,
    is_back: bool,
    is_court: bool,
    /// True if it runs along the longest side of its ring, within 45 degrees.
    is_long: bool,
    mark: u32,
}

impl SurveyedSide {
    /// Returns where it begins.
    pub(super) fn from(&self) -> DVec2 {
        self.from
    }

    /// Returns true if it is the front.
    pub(super) fn is_front(&self) -> bool {
        self.is_front
    }

    /// Returns a side that is cut through the outline.
    pub(super) fn cut(span: Span, along: DVec2, court: bool) -> Self {
        let faces = !court && along.x > along.y.abs();
        SurveyedSide {
            span,
            from: DVec2::ZERO,
            number: 0,
            length: 0.0,
            turn: 0.0,
            numbers: vec![],
            is_front: false,
            is_back: !court && -along.x > along.y.abs(),
            is_court: court,
            is_long: false,
            mark: u32::from(faces) * ON_STREET,
        }
    }

    /// Returns it with other ends, in a part of the outline.
    pub(super) fn with(
        self,
        from: DVec2,
        [along, next]: [DVec2; 2],
        front: bool,
        longest: DVec2,
    ) -> Self {
        SurveyedSide {
            from,
            length: along.length(),
            turn: turn(along, next),
            is_front: front,
            is_long: is_along(along, longest),
            ..self
        }
    }

    /// Returns how well a kind describes it; `None` if it does not.
    fn rank(&self, on: On) -> Option<u8> {
        let (rank, fits) = match on {
            On::Number(number) => (0, self.numbers.contains(&number)),
            On::Front => (1, self.is_front),
            On::Street => (2, self.mark & ON_STREET > 0),
            On::Neighbour => (2, self.mark & OF_NEIGHBOUR > 0),
            On::Court => (2, self.is_court),
            On::Back => (3, self.is_back),
            On::Long => (4, self.is_long),
            On::Short => (4, !self.is_long),
            On::Any => (5, true),
        };
        fits.then_some(rank)
    }

    /// Returns the wall that is written for it; the first of several that describe it as well.
    fn wall<'d>(&self, walls: Option<&'d Walls>) -> Option<&'d SideWall> {
        let sides = walls.into_iter().flat_map(|walls| &walls.sides);
        let ranked = sides.filter_map(|wall| Some((self.rank(wall.on.value)?, wall)));
        ranked.min_by_key(|(rank, _)| *rank).map(|(_, wall)| wall)
    }
}

/// Returns the sides of a ring from its corners in the author frame, the first of which begins side `first`.
pub(super) fn of(
    written: &Written<'_>,
    ring: &Ring,
    first: usize,
    corners: &[DVec2],
    court: bool,
) -> Vec<SurveyedSide> {
    let n = corners.len();
    let along = |k: usize| corners[(k + 1) % n] - corners[k % n];
    let longest = longest(corners);
    let any_street = ring.iter().any(|side| side.mark & ON_STREET > 0);
    let side = |k: usize| {
        let (own, next) = (along(k), along(k + 1));
        let (side, end) = (&ring[(first + k) % n], &ring[(first + k + 1) % n]);
        let to = match end.corner > side.corner {
            true => end.corner,
            false => end.corner + written.sides(),
        };
        let number = |n: usize| written.written(n % written.sides()) as u32 + 1;
        let is_front = k == 0 && !court;
        let street = u32::from(is_front && !any_street) * ON_STREET;
        SurveyedSide {
            span: written.span(written.written(side.number)),
            from: corners[k],
            number: written.written(side.number) + 1,
            length: own.length(),
            turn: turn(own, next),
            numbers: (side.corner..to).map(number).filter(|_| !court).collect(),
            is_front,
            // The front runs along +a; what runs against it within 45 degrees looks to the back.
            is_back: !court && -own.x > own.y.abs(),
            is_court: court,
            is_long: is_along(own, longest),
            mark: side.mark | street,
        }
    };
    (0..n).map(side).collect()
}

/// Returns the direction of the longest side of a ring; the first of several.
pub(super) fn longest(corners: &[DVec2]) -> DVec2 {
    let next = corners.iter().cycle().skip(1);
    let sides = corners.iter().zip(next).map(|(p, q)| *q - *p);
    let longest = sides.reduce(|a, b| if b.length() > a.length() + SAME { b } else { a });
    longest.unwrap_or(DVec2::X).normalize_or(DVec2::X)
}

fn is_along(side: DVec2, longest: DVec2) -> bool {
    side.dot(longest).abs() >= side.perp_dot(longest).abs()
}

/// Returns the turn from one side to the next, degrees to the right.
fn turn(side: DVec2, next: DVec2) -> f64 {
    libm::atan2(side.perp_dot(next), side.dot(next)).to_degrees()
}

/// Returns the part of walls that nothing else fills.
fn rest_of(walls: Option<&Walls>) -> CodeText {
    let written = walls.and_then(|walls| walls.rest.as_ref());
    written.map_or(CodeText::Five(PLAIN), |code| code.value.clone())
}

fn has_door(wall: &SideWall) -> bool {
    let mut parts = wall.parts.iter();
    parts.any(|part| matches!(part, SidePart::Door(_)))
}

impl Pass<'_, '_> {
    /// Fills the sides of all rings; a ring whose storey exceeds a limit has none.
    pub(super) fn fill(
        &mut self,
        rings: &[SurveyedRing],
        has_door: &mut bool,
        walls: Option<&Walls>,
        place: Place,
    ) -> Vec<Vec<WallLine>> {
        let mut door = match has_door {
            true => None,
            false => self.door(rings, walls, place),
        };
        *has_door |= door.is_some();
        let rest = rest_of(walls);
        let mut filled = vec![];
        for (r, ring) in rings.iter().enumerate() {
            let place = place.at(r as u64);
            let mut lines = Vec::with_capacity(ring.sides.len() + 1);
            lines.extend(ring.leading());
            for (k, side) in ring.sides.iter().enumerate() {
                let wall = side.wall(walls);
                let with_door = door.take_if(|(ring, side, _)| (*ring, *side) == (r, k));
                let units = match with_door {
                    Some((_, _, units)) => units,
                    None => self.side(side, wall, place.at(k as u64), &rest),
                };
                self.charge_frame(bounds::ROW, side.span);
                lines.push(WallLine {
                    span: side.span,
                    units,
                    turn: side.turn,
                    reflection: false,
                });
                if self.stopped() {
                    return vec![];
                }
            }
            filled.push(lines);
        }
        filled
    }

    /// Returns the side with the door of the house, and its parts: the front, if its wall has a door; otherwise the longest
    /// side with room for the door of the first wall that has one.
    fn door(
        &mut self,
        rings: &[SurveyedRing],
        walls: Option<&Walls>,
        place: Place,
    ) -> Option<(usize, usize, Vec<Unit>)> {
        let numbered = |wall: &SideWall| {
            let mut all = walls.into_iter().flat_map(|walls| &walls.sides);
            all.position(|w| std::ptr::eq(w, wall))
        };
        let mut sides = vec![];
        for (r, ring) in rings.iter().enumerate() {
            for (k, side) in ring.sides.iter().enumerate() {
                let wall = side.wall(walls).filter(|wall| has_door(wall));
                sides.extend(wall.map(|wall| (r, k, side, wall)));
            }
        }
        sides.sort_by(|(_, _, a, own), (_, _, b, other)| {
            let front = b.is_front.cmp(&a.is_front);
            let wall = numbered(own).cmp(&numbered(other));
            front.then(wall).then(b.length.total_cmp(&a.length))
        });
        sides.into_iter().find_map(|(r, k, side, wall)| {
            let place = place.at(r as u64).at(k as u64);
            let units = self
                .parts(side, wall, place, (true, &rest_of(walls)))
                .ok()?;
            Some((r, k, units))
        })
    }

    /// Fills a side; a plain wall stands where its parts do not fit.
    fn side(
        &mut self,
        side: &SurveyedSide,
        wall: Option<&SideWall>,
        place: Place,
        rest: &CodeText,
    ) -> Vec<Unit> {
        let Some(wall) = wall else {
            return self.plain_wall(side.span, side.length, rest);
        };
        self.parts(side, wall, place, (false, rest))
            .unwrap_or_else(|needed| {
                // Real outlines have many short sides; only who names one expects its parts there.
                if matches!(wall.on.value, On::Number(_) | On::Front) {
                    let (number, length) = (side.number, side.length);
                    self.once(426, wall.span, || {
                        say::side_too_short(wall.span, number, length, needed)
                    });
                }
                self.plain_wall(side.span, side.length, rest)
            })
    }

    /// Returns the parts of a side, right to left.
    ///
    /// # Errors The length that they need, U, if the side is shorter.
    fn parts(
        &mut self,
        side: &SurveyedSide,
        wall: &SideWall,
        place: Place,
        (with_door, rest): (bool, &CodeText),
    ) -> Result<Vec<Unit>, f64> {
        let (mut fixed, mut fills) = (vec![], 0);
        for (index, part) in wall.parts.iter().enumerate() {
            let pieces: &[Item<Piece>] = match part {
                SidePart::Pieces(pieces) => pieces,
                SidePart::Door(door) if with_door => &door.pieces,
                SidePart::Door(_) => &[],
                SidePart::Fill(_) => {
                    fills += 1;
                    &[]
                }
            };
            fixed.push(self.strip(pieces, place.at(index as u64), Mode::Row));
        }
        let needed: f64 = fixed.iter().map(Strip::width).sum();
        let room = side.length - needed;
        let tight = needed * (1.0 - MOST_STRETCH);
        if side.length < tight - SAME {
            return Err(needed);
        }
        if fills == 0 || room < SAME {
            return Ok(self.without_fill(side, fixed, needed, rest));
        }
        let share = room / f64::from(fills);
        let mut units = vec![];
        for (index, (part, strip)) in wall.parts.iter().zip(fixed).enumerate() {
            match part {
                SidePart::Fill(fill) => {
                    let place = place.at(index as u64);
                    self.run(fill, share, place, rest, &mut units);
                }
                _ => units.extend(strip.units),
            }
        }
        Ok(units)
    }

    /// Stretches parts to the whole side; where they are much too short a plain wall follows them.
    fn without_fill(
        &mut self,
        side: &SurveyedSide,
        fixed: Vec<Strip>,
        needed: f64,
        rest: &CodeText,
    ) -> Vec<Unit> {
        let mut all = Strip {
            units: fixed.into_iter().flat_map(|strip| strip.units).collect(),
            place: Place::seed(0),
            mode: Mode::Row,
            natural: false,
        };
        let left = side.length - needed;
        if left <= needed * MOST_STRETCH {
            fit(&mut all, side.length, side.span);
        } else {
            all.units.extend(self.plain_wall(side.span, left, rest));
        }
        all.units
    }

    /// Adds a run of parts as often as it fits into `room`; a plain wall takes what stretching does not.
    fn run(
        &mut self,
        fill: &Half,
        room: f64,
        place: Place,
        rest: &CodeText,
        units: &mut Vec<Unit>,
    ) {
        let (pieces, span) = (&fill.pieces[..], fill.span);
        let mut first = Some(self.strip(pieces, place.at(0), Mode::Row));
        let own = first.as_ref().map_or(0.0, Strip::width);
        if own < SAME || room > LONGEST {
            units.extend(first.into_iter().flat_map(|strip| strip.units));
            units.extend(self.plain_wall(span, room, rest));
            return;
        }
        let fits = |count: f64| (room / (count * own) - 1.0).abs() <= MOST_STRETCH;
        let nearest = (room / own).round();
        let (count, left) = match nearest >= 1.0 && fits(nearest) {
            true => (nearest, 0.0),
            false => {
                let count = (room / own).floor();
                (count, room - count * own)
            }
        };
        let width = if left > 0.0 { own } else { room / count };
        for copy in 0..count as u64 {
            let next = || self.strip(pieces, place.at(copy), Mode::Row);
            let mut strip = first.take().unwrap_or_else(next);
            fit(&mut strip, width, span);
            units.extend(strip.units);
            if self.stopped() {
                return;
            }
        }
        if left > SAME {
            units.extend(self.plain_wall(span, left, rest));
        }
    }

    /// Returns a wall of plain bays, all alike and about 1 U wide.
    fn plain_wall(&mut self, span: Span, length: f64, code: &CodeText) -> Vec<Unit> {
        let count = match length > LONGEST {
            true => 1.0,
            false => length.round().max(1.0),
        };
        let which = self.resolve(code, span).which;
        self.charge(count as u64, span);
        if self.stopped() {
            return vec![];
        }
        let bay = bare_unit(span, length / count, which);
        vec![bay; count as usize]
    }
}
