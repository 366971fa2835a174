//! Doors on hinges: a leaf and the arc of its swing, or a leaf alone that stands open.

use super::fit::Grid;
use super::lines::Stroke;
use super::roles::Means;
use glam::{DVec2, dvec2};

/// Leaves farther out hang nowhere, units.
const FARTHEST: f64 = 1e6;
/// The radius of a leaf, units.
const RADIUS: [f64; 2] = [0.3, 2.3];
/// How far the places of an arc may be from a circle, as a share of its radius.
const ROUND: f64 = 0.03;
/// How far a leaf may end from the arc that belongs to it, units.
const TOUCH: f64 = 0.12;
/// The least and the greatest sine of an open leaf's angle with the grid.
const SLANT: [f64; 2] = [0.25, 0.97];
/// How far from a crossing a hinge may be, units.
const HINGE: f64 = 0.3;

/// A unit: where it begins, and whether it is upright.
pub(super) type At = ((i32, i32), bool);

/// Where a door on hinges may stand: units from a crossing to the right or down.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Place(pub(super) (i32, i32), bool, i32);

impl Place {
    fn at(&self, k: i32) -> (i32, i32) {
        let ((u, v), upright) = (self.0, self.1);
        if upright { (u, v + k) } else { (u + k, v) }
    }

    pub(super) fn units(&self) -> Vec<At> {
        (0..self.2).map(|k| (self.at(k), self.1)).collect()
    }

    pub(super) fn ends(&self) -> [(i32, i32); 2] {
        [self.0, self.at(self.2)]
    }

    /// The units before and after it.
    pub(super) fn beyond(&self) -> [At; 2] {
        [(self.at(-1), self.1), (self.at(self.2), self.1)]
    }
}

/// The four units that meet in a crossing.
pub(super) fn around((u, v): (i32, i32)) -> [At; 4] {
    [
        ((u, v), false),
        ((u - 1, v), false),
        ((u, v), true),
        ((u, v - 1), true),
    ]
}

/// A door on hinges: where it may stand, and the strokes that are its leaf and its arc.
pub(super) struct Leaf {
    pub(super) places: Vec<Place>,
    pub(super) strokes: Vec<usize>,
}

/// Finds doors on hinges among the strokes of doors.
pub(super) fn find(strokes: &[Stroke], means: &[Option<Means>], grid: &Grid) -> Vec<Leaf> {
    let is_near = |stroke: &Stroke| {
        stroke
            .points
            .iter()
            .all(|p| grid.units_of(*p).abs().max_element() < FARTHEST)
    };
    let is_door =
        |k: &usize| matches!(means[*k], Some(Means::Door | Means::Hinged)) && is_near(&strokes[*k]);
    let doors: Vec<(usize, Vec<DVec2>)> = (0..strokes.len())
        .filter(is_door)
        .map(|k| {
            (
                k,
                strokes[k]
                    .points
                    .iter()
                    .map(|p| grid.units_of(*p))
                    .collect(),
            )
        })
        .collect();
    let mut leaves = vec![];
    let mut used = std::collections::BTreeSet::new();
    let mut lines: Vec<(usize, [DVec2; 2])> = vec![];
    let mut arcs: Vec<(usize, Arc)> = vec![];
    for (k, points) in &doors {
        if let Some(arc) = Arc::of(points).filter(|_| !strokes[*k].is_closed) {
            arcs.push((*k, arc));
        } else if let Some(line) = straight(points) {
            lines.push((*k, line));
        }
    }
    for (k, arc) in arcs {
        let own: Vec<usize> = lines
            .iter()
            .filter(|(_, line)| arc.leaf(*line).is_some())
            .map(|(j, _)| *j)
            .collect();
        let tip = lines.iter().find_map(|(_, line)| arc.leaf(*line));
        used.extend(own.iter().copied());
        let places = arc.places(tip);
        if !places.is_empty() {
            leaves.push(Leaf {
                places,
                strokes: own.into_iter().chain([k]).collect(),
            });
        }
    }
    for (k, line) in lines {
        let places = slanted(line);
        if !used.contains(&k) && !places.is_empty() {
            leaves.push(Leaf {
                places,
                strokes: vec![k],
            });
        }
    }
    leaves
}

/// An arc in units.
struct Arc {
    middle: DVec2,
    radius: f64,
    ends: [DVec2; 2],
}

impl Arc {
    /// The circle through places, if they lie on one and are less than half of it.
    fn of(points: &[DVec2]) -> Option<Arc> {
        if points.len() < 5 {
            return None;
        }
        let (a, b, c) = (
            points[0],
            points[points.len() / 2],
            points[points.len() - 1],
        );
        let (p, q) = (b - a, c - a);
        let cross = 2.0 * p.perp_dot(q);
        if cross.abs() < 1e-9 {
            return None;
        }
        let off = dvec2(
            q.y * p.length_squared() - p.y * q.length_squared(),
            p.x * q.length_squared() - q.x * p.length_squared(),
        ) / cross;
        let (middle, radius) = (a + off, off.length());
        let is_round = points
            .iter()
            .all(|p| (p.distance(middle) - radius).abs() < radius * ROUND);
        let is_leaf = (RADIUS[0]..RADIUS[1]).contains(&radius) && a.distance(c) < radius * 1.7;
        (is_round && is_leaf).then_some(Arc {
            middle,
            radius,
            ends: [a, c],
        })
    }

    /// The end of a line at the arc, if it runs there from the middle.
    fn leaf(&self, line: [DVec2; 2]) -> Option<DVec2> {
        let [p, q] = line;
        let [near, far] = if p.distance(self.middle) < q.distance(self.middle) {
            [p, q]
        } else {
            [q, p]
        };
        let touches = self.ends.iter().any(|e| e.distance(far) < TOUCH);
        (near.distance(self.middle) < TOUCH && touches).then_some(far)
    }

    /// Where the door may stand when it is closed: along the grid from its hinge to the end without a leaf.
    fn places(&self, tip: Option<DVec2>) -> Vec<Place> {
        let is_tip = |e: &DVec2| tip.is_some_and(|t| t.distance(*e) < TOUCH);
        let closed: Vec<DVec2> = self.ends.iter().copied().filter(|e| !is_tip(e)).collect();
        let closed = if closed.is_empty() {
            self.ends.to_vec()
        } else {
            closed
        };
        closed
            .into_iter()
            .filter_map(|end| self.place(end))
            .collect()
    }

    fn place(&self, end: DVec2) -> Option<Place> {
        let way = (end - self.middle).abs();
        let upright = way.y > way.x;
        let (along, across) = if upright { (1, 0) } else { (0, 1) };
        let line = ((self.middle[across] + end[across]) / 2.0).round();
        if way[across] > way[along] * 0.2 || (self.middle[across] - line).abs() > HINGE {
            return None;
        }
        let middle = (self.middle[along] + end[along]) / 2.0;
        // Posts stand between the leaf and the lines of the grid.
        let count = (self.radius + 0.2).round().max(1.0);
        let from = (middle - count / 2.0).round();
        let at = if upright {
            (line as i32, from as i32)
        } else {
            (from as i32, line as i32)
        };
        Some(Place(at, upright, count as i32))
    }
}

/// The ends of a stroke that is one straight line.
fn straight(points: &[DVec2]) -> Option<[DVec2; 2]> {
    let (first, last) = (*points.first()?, *points.last()?);
    let length = first.distance(last);
    let way = (last - first) / length;
    let is_straight = length > RADIUS[0]
        && points
            .iter()
            .all(|p| way.perp_dot(*p - first).abs() < 0.08 * length);
    is_straight.then_some([first, last])
}

/// Where a leaf that stands open may belong: the units beside it from the crossing at its hinge.
fn slanted([p, q]: [DVec2; 2]) -> Vec<Place> {
    let way = q - p;
    let length = way.length();
    let slant = (way / length).abs();
    let is_open =
        slant.min_element() > SLANT[0] && slant.max_element() < SLANT[1] && length < RADIUS[1];
    if !is_open {
        return vec![];
    }
    let off = |e: DVec2| e.distance(e.round());
    let (hinge, tip) = if off(p) <= off(q) { (p, q) } else { (q, p) };
    if off(hinge) > HINGE {
        return vec![];
    }
    let (at, way) = (hinge.round(), tip - hinge);
    let count = (length - 0.2).round().max(1.0) as i32;
    let level = Place(
        (
            at.x as i32 - if way.x < 0.0 { count } else { 0 },
            at.y as i32,
        ),
        false,
        count,
    );
    let upright = Place(
        (
            at.x as i32,
            at.y as i32 - if way.y < 0.0 { count } else { 0 },
        ),
        true,
        count,
    );
    if slant.y > slant.x {
        vec![upright, level]
    } else {
        vec![level, upright]
    }
}
