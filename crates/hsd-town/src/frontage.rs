//! The side of an outline on which a house fronts its street (docs/contract.md 10.2).
//!
//! The front is the side nearest to a street, of those that face it. Thresholds were measured on 3,260 real outlines.

use super::neighbour::Neighbours;
use super::shape::{Segment, angle, contains, sides, turn};
use super::street::{FAR, Nearest, Piece, nearest};
use glam::DVec2;

/// The greatest angle between the normal of a front and the way to its street, degrees.
const FACES: f64 = 60.0;
/// Sides this near to the least distance compete by their middles, metres.
const AS_NEAR: f64 = 0.25;
/// The sides of a run lie within this angle of its chord, degrees.
const RUN: f64 = 15.0;
/// Shorter sides are no fronts while another one qualifies, metres.
const SHORT: f64 = 0.9;
/// The longest cut of a corner, metres, and its angle to both longer neighbours, degrees.
const CUT: f64 = 5.0;
const CUT_ANGLES: std::ops::RangeInclusive<f64> = 25.0..=65.0;
/// The least length of a front that is free of neighbours, metres.
const FREE: f64 = 1.8;
/// The turn from which a second side is another front, and the turn from which it is the opposite one, degrees.
const SECOND: f64 = 45.0;
const OPPOSITE: f64 = 135.0;
/// How much farther a second front, or the opposite one of a through lot, may be, metres.
const FARTHER: f64 = 3.0;
/// A street is wider by this factor.
const WIDER: f64 = 1.3;
/// The bounds within which the front of a neighbour is in line: degrees, metres.
const ROW_ANGLE: f64 = 15.0;
const ROW_OFF: f64 = 2.5;
/// The farthest free way that counts, metres, and the difference that does not.
const WAY: f64 = 12.0;
const SAME_WAY: f64 = 1.0;
/// The length of outline from which a street is seen, metres, and the distance of places that look.
const SEEN: f64 = 1.8;
const LOOK: f64 = 0.6;

/// A side of an outline, or sides nearly in line: a wall as one sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// From its first to its last corner.
    pub chord: Segment,
    /// The numbers of its sides in the ring.
    pub sides: Vec<usize>,
}

/// A front and its street.
#[derive(Clone, Debug, PartialEq)]
pub struct Front {
    /// The wall.
    pub chord: Segment,
    /// The numbers of its sides in the ring.
    pub sides: Vec<usize>,
    /// The distance of the street, metres; `None` if no street is near.
    pub street: Option<f64>,
    /// The number of the street.
    pub number: Option<u32>,
    /// The width of the street; 0 if it is not known.
    pub width: f64,
}

/// How a house is reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// From a street that is seen.
    Street,
    /// No street is seen past other houses.
    Rear,
    /// No street is near.
    None,
}

impl Access {
    /// Returns the word for it.
    pub fn word(self) -> &'static str {
        match self {
            Access::Street => "street",
            Access::Rear => "rear",
            Access::None => "none",
        }
    }
}

/// What is known of the front of an outline.
#[derive(Clone, Debug, PartialEq)]
pub struct Frontage {
    /// The front.
    pub front: Front,
    /// True if a second side faces another street.
    pub corner: bool,
    /// True if the opposite side faces a street too.
    pub through: bool,
    /// How it is reached.
    pub access: Access,
    /// The sides on streets, by their numbers in the ring.
    pub on_street: Vec<usize>,
}

/// Returns the walls of a ring: its sides, joined while each lies within 15 degrees of the chord of the run.
pub fn runs(ring: &[DVec2]) -> Vec<Run> {
    let all: Vec<Segment> = sides(ring).collect();
    let n = all.len();
    // Begin after the sharpest corner, so that no run is cut by the start of the ring.
    let bend = |i: usize| angle(all[(i + n - 1) % n].direction(), all[i].direction());
    let start = (0..n).fold(
        0,
        |best, i| if bend(i) > bend(best) + 1e-9 { i } else { best },
    );
    let mut runs: Vec<Run> = vec![];
    // The least and the greatest turn of a side of the last run from the first one.
    let (mut first, mut turns) = (DVec2::ZERO, [0.0, 0.0]);
    for step in 0..n {
        let number = (start + step) % n;
        let side = all[number];
        let own = turn(first, side.direction());
        if let Some(run) = runs.last_mut() {
            let chord = Segment::new(run.chord.from, side.to);
            let [low, high] = [f64::min(turns[0], own), f64::max(turns[1], own)];
            let along = turn(first, chord.direction());
            let straight = along - low <= RUN && high - along <= RUN;
            if straight && chord.length() > 0.0 {
                turns = [low, high];
                run.chord = chord;
                run.sides.push(number);
                continue;
            }
        }
        (first, turns) = (side.direction(), [0.0, 0.0]);
        runs.push(Run {
            chord: side,
            sides: vec![number],
        });
    }
    runs
}

/// Returns true for a run that cuts a corner off.
pub(crate) fn is_cut(runs: &[Run], at: usize) -> bool {
    let n = runs.len();
    let (before, own, after) = (&runs[(at + n - 1) % n], &runs[at], &runs[(at + 1) % n]);
    let length = own.chord.length();
    let beside = |other: &Run| {
        let off = angle(own.chord.direction(), other.chord.direction());
        other.chord.length() > length && CUT_ANGLES.contains(&off)
    };
    n > 4 && length < CUT && beside(before) && beside(after)
}

/// A run that faces a street.
struct Facing {
    run: usize,
    /// The distance of the wall from the side of the street.
    distance: f64,
    /// The distance of its middle, below 0 where the street overlaps the outline.
    middle: f64,
    near: Nearest,
}

/// Returns the nearest street that each run faces, if there is one within reach.
fn facing(runs: &[Run], pieces: &[Piece]) -> Vec<Facing> {
    // Stable: the pieces of a street keep their order.
    let mut by_street = pieces.to_vec();
    by_street.sort_by_key(|piece| piece.street);
    let mut found = vec![];
    for (number, run) in runs.iter().enumerate() {
        let (normal, middle) = (run.chord.normal(), run.chord.middle());
        let mut best: Option<Facing> = None;
        for street in by_street.chunk_by(|a, b| a.street == b.street) {
            let own = street.iter();
            let gap = |p: &Piece| (p.line.distance(run.chord) - p.half).max(0.0);
            let distance = own.clone().map(gap).fold(f64::INFINITY, f64::min);
            if distance > FAR {
                continue;
            }
            let Some(near) = nearest(own, middle).filter(|n| n.faced(normal, middle) <= FACES)
            else {
                continue;
            };
            let nearer = best
                .as_ref()
                .is_none_or(|b| (distance, near.depth) < (b.distance, b.middle));
            if nearer {
                best = Some(Facing {
                    run: number,
                    distance,
                    middle: near.depth,
                    near,
                });
            }
        }
        found.extend(best);
    }
    found
}

/// Returns the fronts of an outline in the order of preference, by distance alone, without a look at the row.
fn candidates(runs: &[Run], pieces: &[Piece], neighbours: &Neighbours<'_>) -> Vec<Facing> {
    let mut all = facing(runs, pieces);
    let is_poor = |f: &Facing| {
        let chord = runs[f.run].chord;
        chord.length() < SHORT || is_cut(runs, f.run) || neighbours.free_length(chord) < FREE
    };
    if all.iter().any(|f| !is_poor(f)) {
        all.retain(|f| !is_poor(f));
    }
    let least = all.iter().map(|f| f.distance).fold(f64::INFINITY, f64::min);
    let near = |f: &Facing| f.distance <= least + AS_NEAR;
    all.sort_by(|a, b| {
        let key = |f: &Facing| (!near(f), if near(f) { f.middle } else { f.distance });
        let (a, b) = (key(a), key(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    all
}

/// Returns the front of an outline by distance alone, which its neighbours look at.
pub fn first_front(
    ring: &[DVec2],
    pieces: &[Piece],
    neighbours: &Neighbours<'_>,
) -> Option<Segment> {
    let runs = runs(ring);
    let all = candidates(&runs, pieces, neighbours);
    Some(runs[all.first()?.run].chord)
}

/// Finds the front of an outline. `known` is a side that belongs to it, whatever stands before that; `row` returns the fronts
/// of the neighbours that touch it.
pub fn frontage(
    (ring, known): (&[DVec2], Option<usize>),
    pieces: &[Piece],
    neighbours: &Neighbours<'_>,
    row: impl FnOnce() -> Vec<Segment>,
) -> Frontage {
    let runs = runs(ring);
    let all = candidates(&runs, pieces, neighbours);
    let known = known.and_then(|side| runs.iter().position(|run| run.sides.contains(&side)));
    if let Some(known) = known.filter(|known| all.iter().all(|f| f.run != *known)) {
        return on_its_street(&runs[known], sees_street(ring, pieces, neighbours));
    }
    let Some(first) = all.first() else {
        return without_street(&runs, neighbours);
    };
    let turned = |f: &Facing| angle(runs[first.run].chord.normal(), runs[f.run].chord.normal());
    let close = |f: &&Facing| f.distance <= first.distance + FARTHER;
    let second = all[1..]
        .iter()
        .filter(close)
        .find(|f| (SECOND..=OPPOSITE).contains(&turned(f)));
    let through = all[1..].iter().filter(close).any(|f| turned(f) > OPPOSITE);
    let is_known = |f: &&Facing| known == Some(f.run);
    let chosen = match (all.iter().find(is_known), second) {
        (Some(known), _) => known,
        (None, Some(second)) => corner_front(&runs, first, second, &row()),
        (None, None) => first,
    };
    let on_street = all
        .iter()
        .filter(close)
        .flat_map(|f| runs[f.run].sides.iter().copied());
    let mut on_street: Vec<usize> = on_street.collect();
    on_street.sort_unstable();
    Frontage {
        corner: second.is_some(),
        through,
        access: access(sees_street(ring, pieces, neighbours)),
        front: Front {
            chord: runs[chosen.run].chord,
            sides: runs[chosen.run].sides.clone(),
            street: Some(chosen.distance),
            number: Some(chosen.near.street),
            width: chosen.near.width,
        },
        on_street,
    }
}

/// Decides between the two fronts of a corner house: the row, then the wider street, then the nearer one.
fn corner_front<'f>(
    runs: &[Run],
    first: &'f Facing,
    second: &'f Facing,
    row: &[Segment],
) -> &'f Facing {
    let in_row = |f: &Facing| {
        let chord = runs[f.run].chord;
        row.iter().any(|other| {
            let off = (other.middle() - chord.middle()).dot(chord.normal()).abs();
            angle(chord.normal(), other.normal()) <= ROW_ANGLE && off <= ROW_OFF
        })
    };
    match (in_row(first), in_row(second)) {
        (true, false) => return first,
        (false, true) => return second,
        _ => {}
    }
    let (own, other) = (first.near.width, second.near.width);
    match own > 0.0 && other >= own * WIDER {
        true => second,
        false => first,
    }
}

fn access(sees_street: bool) -> Access {
    match sees_street {
        true => Access::Street,
        false => Access::Rear,
    }
}

/// Returns a known front before which no street is found free: maps draw areas into each other.
fn on_its_street(run: &Run, sees_street: bool) -> Frontage {
    Frontage {
        on_street: run.sides.clone(),
        front: Front {
            chord: run.chord,
            sides: run.sides.clone(),
            street: Some(0.0),
            number: None,
            width: 0.0,
        },
        corner: false,
        through: false,
        access: access(sees_street),
    }
}

/// The front where no street is near: the longest free way before it, and of equal ones the shorter wall.
fn without_street(runs: &[Run], neighbours: &Neighbours<'_>) -> Frontage {
    let long = runs.iter().any(|r| r.chord.length() >= SHORT);
    let way = |run: &Run| neighbours.free_way(run.chord, WAY);
    let usable = runs.iter().filter(|r| !long || r.chord.length() >= SHORT);
    let best = usable.reduce(|best, next| {
        let (a, b) = (way(best), way(next));
        let shorter = next.chord.length() < best.chord.length();
        match b > a + SAME_WAY || (b > a - SAME_WAY && shorter) {
            true => next,
            false => best,
        }
    });
    let run = best.or(runs.first());
    let chord = run.map_or(Segment::new(DVec2::ZERO, DVec2::ZERO), |r| r.chord);
    let sides = run.map_or(vec![], |r| r.sides.clone());
    Frontage {
        on_street: sides.clone(),
        front: Front {
            chord,
            sides,
            street: None,
            number: None,
            width: 0.0,
        },
        corner: false,
        through: false,
        access: Access::None,
    }
}

/// Returns true if a street is seen past other houses from a stretch of the outline.
fn sees_street(ring: &[DVec2], pieces: &[Piece], neighbours: &Neighbours<'_>) -> bool {
    let mut seen = 0.0;
    for side in sides(ring) {
        let length = side.length();
        let steps = (length / LOOK).ceil().max(1.0) as usize;
        let step = length / steps as f64;
        for n in 0..steps {
            let share = (n as f64 + 0.5) / steps as f64;
            let eye = side.from.lerp(side.to, share) + side.normal() * 0.05;
            let sees = nearest(pieces, eye).is_some_and(|near| {
                let way = near.point - eye;
                let outward = way.dot(side.normal()) > 0.0 || near.distance == 0.0;
                outward && neighbours.is_free(Segment::new(eye, near.side(eye)))
            });
            seen = if sees { seen + step } else { 0.0 };
            if seen >= SEEN || sees && contains(ring, eye) {
                return true;
            }
        }
    }
    false
}
