//! The roads in front of a lot. From places along each wall of its outline one looks outwards: where a road begins soon, it is in
//! front, and where it ends is its far side.

use crate::frontage::{Run, is_cut, runs};
use crate::neighbour::Neighbours;
use crate::shape::{Segment, angle};
use crate::street::Piece;
use glam::DVec2;
use hsd_base::geometry::envelope::Half;

/// A road that begins farther away is not in front of a lot, metres: outlines of houses stand back a little.
const REACH: f64 = 3.0;
/// How far a lot may lie in a road by the map, metres.
const WITHIN: f64 = 1.0;
/// The places along a wall from which one looks, and the distance of those beyond its ends, metres. They tell the width where a
/// wall stands at the end of another road.
const LOOKS: usize = 7;
const BEYOND: [f64; 3] = [1.5, 3.0, 4.5];
/// The length of a lot on a road that makes it one in front, metres (Building Standards Act art. 43 (1)), or share of a wall.
const LEAST: f64 = 2.0;
const LEAST_SHARE: f64 = 0.5;
/// Pieces of a road that are drawn apart by so much are one, metres.
const GAP: f64 = 0.3;
/// Roads are at least so wide, metres.
const NARROWEST: f64 = 0.5;
/// A far side lies within this of a line, metres, and turns from the near side by at most this, degrees; else it counts as parallel.
const STRAIGHT: f64 = 0.25;
const TURN: f64 = 15.0;

/// A road in front of a lot.
#[derive(Clone, Debug, PartialEq)]
pub struct Front {
    /// The wall of the lot on it, with the lot on the left.
    pub chord: Segment,
    /// The numbers of the sides of the outline that make it up.
    pub sides: Vec<usize>,
    /// The far side of the road, and the way from there to the lot.
    pub far: Half,
    /// The width of the road, metres.
    pub width: f64,
}

impl Front {
    /// Creates the front of one side on a road of a width, which begins at the side.
    pub fn at(ring: &[DVec2], side: usize, width: f64) -> Front {
        let chord = Segment::new(ring[side], ring[(side + 1) % ring.len()]);
        Front {
            chord,
            sides: vec![side],
            far: Half {
                at: chord.from + chord.normal() * width,
                inward: -chord.normal(),
            },
            width,
        }
    }

    /// Returns it moved.
    #[must_use]
    pub fn moved(&self, by: DVec2) -> Front {
        Front {
            chord: Segment::new(self.chord.from + by, self.chord.to + by),
            sides: self.sides.clone(),
            far: Half {
                at: self.far.at + by,
                inward: self.far.inward,
            },
            width: self.width,
        }
    }
}

/// Finds the roads in front of a lot among pieces of streets.
pub fn fronts(ring: &[DVec2], pieces: &[Piece], neighbours: &Neighbours<'_>) -> Vec<Front> {
    let runs = runs(ring);
    let walls = runs.iter().enumerate();
    // A wall that cuts a corner off looks along both roads.
    let walls = walls.filter(|(number, _)| !is_cut(&runs, *number));
    walls
        .filter_map(|(_, run)| front(run, pieces, neighbours))
        .collect()
}

fn front(run: &Run, pieces: &[Piece], neighbours: &Neighbours<'_>) -> Option<Front> {
    let (chord, normal) = (run.chord, run.chord.normal());
    let look = |eye: DVec2| across(eye, normal, pieces).map(|[near, far]| (eye, near, far));
    let looks = (0..LOOKS).filter_map(|n| {
        let share = (n as f64 + 0.5) / LOOKS as f64;
        let (eye, near, far) = look(chord.from.lerp(chord.to, share))?;
        let before = Segment::new(eye + normal * 0.05, eye + normal * near);
        let is_free = near <= 0.05 || neighbours.is_free(before);
        is_free.then_some((eye, near, far))
    });
    let looks: Vec<(DVec2, f64, f64)> = looks.collect();
    let share = looks.len() as f64 / LOOKS as f64;
    if looks.is_empty() || (share < LEAST_SHARE && share * chord.length() < LEAST) {
        return None;
    }
    let way = chord.direction();
    let ends = BEYOND
        .iter()
        .flat_map(|by| [chord.from - way * *by, chord.to + way * *by]);
    let ends: Vec<(DVec2, f64, f64)> = ends.filter_map(look).collect();
    let all = || looks.iter().chain(&ends);
    let width = narrow(all().map(|(_, near, far)| far - near));
    let distance = narrow(all().map(|(_, _, far)| *far));
    let level = Half {
        at: chord.middle() + normal * distance,
        inward: -normal,
    };
    Some(Front {
        chord,
        sides: run.sides.clone(),
        far: straight(&looks, normal, distance).unwrap_or(level),
        width,
    })
}

/// Returns the far side as a line, if it is one.
fn straight(looks: &[(DVec2, f64, f64)], normal: DVec2, distance: f64) -> Option<Half> {
    let point = |(eye, _, far): &(DVec2, f64, f64)| *eye + normal * *far;
    let (first, last) = (point(looks.first()?), point(looks.last()?));
    let line = Segment::new(first, last);
    let parallel = looks
        .iter()
        .all(|(_, _, far)| (far - distance).abs() < 1e-9);
    if parallel || line.length() < LEAST {
        return None;
    }
    let inward = -line.normal();
    let off = |look| (point(look) - first).dot(inward).abs();
    let is_line =
        looks.iter().all(|look| off(look) <= STRAIGHT) && angle(line.normal(), normal) <= TURN;
    is_line.then_some(Half { at: first, inward })
}

/// Returns the lower quartile: at a crossing ways run along the other road.
fn narrow(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 4]
}

/// Returns how far away the road before a place begins and ends in a direction, metres; `None` if none begins soon.
fn across(eye: DVec2, way: DVec2, pieces: &[Piece]) -> Option<[f64; 2]> {
    let mut spans: Vec<[f64; 2]> = vec![];
    let mut crossings: Vec<(f64, bool)> = vec![];
    for piece in pieces {
        match piece.half > 0.0 {
            true => spans.extend(corridor(eye, way, piece)),
            false => crossings.extend(crossing(eye, way, piece.line)),
        }
    }
    crossings.retain(|(at, _)| *at >= -WITHIN);
    crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
    spans.extend(areas(&crossings));
    spans.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut spans = spans.into_iter().filter(|[_, far]| *far > NARROWEST);
    let [near, mut far] = spans.next()?;
    for [next, end] in spans {
        if next <= far + GAP {
            far = far.max(end);
        }
    }
    let fits = near <= REACH && far - near >= NARROWEST;
    fits.then_some([near, far])
}

/// Returns the spans in roads of a way that crosses their sides: from where it enters areas to where it leaves all of them. A way
/// that leaves one first begins in a block, and the road lies between that and the next.
fn areas(crossings: &[(f64, bool)]) -> Vec<[f64; 2]> {
    let Some((first, enters)) = crossings.first() else {
        return vec![];
    };
    if !enters {
        let next = crossings.iter().find(|(_, enters)| *enters);
        return next.map(|(next, _)| [*first, *next]).into_iter().collect();
    }
    let (mut spans, mut depth, mut begun) = (vec![], 0, 0.0);
    for (at, enters) in crossings {
        if *enters {
            if depth == 0 {
                begun = *at;
            }
            depth += 1;
        } else if depth > 0 {
            depth -= 1;
            if depth == 0 {
                spans.push([begun, *at]);
            }
        }
    }
    spans
}

/// Returns where a way crosses the side of an area, and whether it enters it there.
fn crossing(eye: DVec2, way: DVec2, side: Segment) -> Option<(f64, bool)> {
    let along = side.to - side.from;
    let cross = along.perp_dot(way);
    let (s, t) = (way.perp_dot(side.from - eye), way.perp_dot(side.to - eye));
    // Of two sides that meet on the way one counts.
    if (s > 0.0) == (t > 0.0) || cross == 0.0 {
        return None;
    }
    let at = along.perp_dot(side.from - eye) / cross;
    Some((at, cross > 0.0))
}

/// Returns the span of a way in a road along a line.
fn corridor(eye: DVec2, way: DVec2, piece: &Piece) -> Option<[f64; 2]> {
    let along = piece.line.direction();
    let across = along.perp_dot(way);
    if across.abs() < 0.5 {
        return None;
    }
    let off = along.perp_dot(piece.line.from - eye);
    let middle = off / across;
    let half = piece.half / across.abs();
    // Pieces of a bent road meet at its corners.
    let foot = (eye + way * middle - piece.line.from).dot(along);
    let fits = foot >= -piece.half.min(1.0) && foot <= piece.line.length() + piece.half.min(1.0);
    let span = [middle - half, middle + half];
    (fits && span[0] >= -WITHIN).then_some(span)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::sides;
    use glam::dvec2;

    fn square(x: f64, y: f64, width: f64, depth: f64) -> Vec<DVec2> {
        let at = dvec2(x, y);
        let corners = [(0.0, 0.0), (width, 0.0), (width, depth), (0.0, depth)];
        corners.map(|(x, y)| at + dvec2(x, y)).to_vec()
    }

    fn ring_pieces(ring: &[DVec2]) -> Vec<Piece> {
        let piece = |line| Piece {
            line,
            half: 0.0,
            street: 0,
            width: 0.0,
        };
        sides(ring).map(piece).collect()
    }

    fn found(pieces: &[Piece]) -> Vec<(usize, f64, f64)> {
        let lot = square(0.0, 0.0, 8.0, 12.0);
        let none = Neighbours { rings: vec![] };
        let fronts = fronts(&lot, pieces, &none);
        let told = |front: &Front| (front.sides[0], front.width, front.far.depth(lot[0]));
        fronts.iter().map(told).collect()
    }

    #[test]
    fn a_road_is_a_line_an_area_or_what_lies_between_blocks() {
        let line = Piece {
            line: Segment::new(dvec2(-20.0, -3.0), dvec2(30.0, -3.0)),
            half: 2.0,
            street: 0,
            width: 4.0,
        };
        assert_eq!(found(&[line]), [(0, 4.0, 5.0)]);
        let mut areas = ring_pieces(&square(-20.0, -4.5, 25.0, 4.0));
        areas.extend(ring_pieces(&square(5.0, -4.5, 25.0, 4.0)));
        assert_eq!(found(&areas), [(0, 4.0, 4.5)]);
        let mut blocks = ring_pieces(&square(0.0, 0.0, 30.0, 40.0));
        blocks.extend(ring_pieces(&square(0.0, -46.0, 30.0, 40.0)));
        blocks.extend(ring_pieces(&square(-45.0, 0.0, 40.0, 40.0)));
        assert_eq!(found(&blocks), [(0, 6.0, 6.0), (3, 5.0, 5.0)]);
        assert_eq!(found(&ring_pieces(&square(-20.0, -9.0, 50.0, 4.0))), []);
    }

    #[test]
    fn a_house_before_a_lot_takes_its_road() {
        let lot = square(0.0, 0.0, 8.0, 12.0);
        let before = square(0.0, -1.5, 8.0, 1.0);
        let pieces = ring_pieces(&square(-20.0, -6.0, 50.0, 4.0));
        let free = Neighbours { rings: vec![] };
        assert_eq!(fronts(&lot, &pieces, &free).len(), 1);
        let rings = vec![&before[..]];
        assert!(fronts(&lot, &pieces, &Neighbours { rings }).is_empty());
    }
}
