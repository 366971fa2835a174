//! The areas between the walls of a storey: faces of the plane that outer and inner walls divide, with the ways between
//! them.
//!
//! Walls are cut where they meet. A walk that turns as far as it can to one side at every end goes round an area; one that
//! goes round from outside is the outline of walls that stand together. Exact: corners are in steps, turns are signs of
//! products of whole numbers.

use glam::{DVec2, dvec2};
use hsd_base::geometry::{SAME, STEPS, area2, holds, steps};
use std::collections::HashMap;

/// A corner in steps.
type Corner = (i64, i64);

/// The most walls of a storey, and pieces of them, whose areas are searched: each wall is compared with all others, and walls
/// that cross like a grid have as many areas as crossings.
pub(super) const MOST: usize = 2_000;

/// Areas of a storey.
pub(super) struct Areas {
    corners: Vec<Corner>,
    /// The pieces of walls, each once in either direction: its start and its end. The other direction of half `h` is `h ^ 1`.
    halves: Vec<(usize, usize)>,
    /// The pieces of each wall in their order: how far each reaches along it, and one of its halves.
    pieces: Vec<Vec<(i128, usize)>>,
    /// The walk that each half belongs to.
    walk_of: Vec<usize>,
    walks: Vec<Walk>,
    /// For each walk round walls from outside the area in which they stand.
    around: Vec<Option<usize>>,
}

struct Walk {
    points: Vec<DVec2>,
    /// Twice its area; positive round an area.
    area2: f64,
    /// The walls that it follows stand together under this number.
    group: usize,
}

impl Areas {
    /// Divides the plane by walls, each given by its ends in U; `None` if they are too many.
    pub(super) fn new(walls: &[(DVec2, DVec2)]) -> Option<Areas> {
        if walls.len() > MOST {
            return None;
        }
        let place = |p: DVec2| (steps(p.x), steps(p.y));
        let walls = walls.iter().map(|(p, q)| (place(*p), place(*q)));
        let walls: Vec<(Corner, Corner)> = walls.collect();
        let mut areas = Areas {
            corners: vec![],
            halves: vec![],
            pieces: vec![],
            walk_of: vec![],
            walks: vec![],
            around: vec![],
        };
        let mut known: HashMap<Corner, usize> = HashMap::new();
        let mut halves: HashMap<(usize, usize), usize> = HashMap::new();
        for wall in &walls {
            let mut cuts = vec![wall.0, wall.1];
            cuts.extend(walls.iter().flat_map(|other| meetings(*wall, *other)));
            cuts.sort_by_key(|p| along(*wall, *p));
            cuts.dedup();
            let mut pieces = vec![];
            for pair in cuts.windows(2) {
                let ends = [pair[0], pair[1]].map(|p| {
                    *known.entry(p).or_insert_with(|| {
                        areas.corners.push(p);
                        areas.corners.len() - 1
                    })
                });
                let [p, q] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
                let half = *halves.entry((p, q)).or_insert_with(|| {
                    areas.halves.extend([(p, q), (q, p)]);
                    areas.halves.len() - 2
                });
                pieces.push((along(*wall, pair[1]), half));
            }
            areas.pieces.push(pieces);
            if areas.halves.len() > 2 * MOST {
                return None;
            }
        }
        areas.follow();
        areas.around = (0..areas.walks.len()).map(|w| areas.enclosing(w)).collect();
        Some(areas)
    }

    /// Finds the walks.
    fn follow(&mut self) {
        let mut leaving: Vec<Vec<usize>> = vec![vec![]; self.corners.len()];
        for (half, (from, _)) in self.halves.iter().enumerate() {
            leaving[*from].push(half);
        }
        let way = |half: usize| {
            let (p, q) = self.halves[half];
            let (p, q) = (self.corners[p], self.corners[q]);
            (q.0 - p.0, q.1 - p.1)
        };
        for list in &mut leaving {
            list.sort_by(|p, q| turning(way(*p), way(*q)));
        }
        // After a half comes the one next to its way back.
        let mut place: Vec<usize> = vec![0; self.halves.len()];
        for list in &leaving {
            for (i, half) in list.iter().enumerate() {
                place[*half] = i;
            }
        }
        let next = |half: usize| {
            let list = &leaving[self.halves[half].1];
            list[(place[half ^ 1] + list.len() - 1) % list.len()]
        };
        let groups = self.groups();
        self.walk_of = vec![usize::MAX; self.halves.len()];
        for first in 0..self.halves.len() {
            if self.walk_of[first] != usize::MAX {
                continue;
            }
            let (mut half, mut points) = (first, vec![]);
            while self.walk_of[half] == usize::MAX {
                self.walk_of[half] = self.walks.len();
                points.push(self.point(self.halves[half].0));
                half = next(half);
            }
            let area2 = area2(&points);
            let group = groups[self.halves[first].0];
            self.walks.push(Walk {
                points,
                area2,
                group,
            });
        }
    }

    fn point(&self, corner: usize) -> DVec2 {
        let (a, b) = self.corners[corner];
        dvec2(a as f64, b as f64) / STEPS as f64
    }

    /// Returns true if a wall goes through a point, or ends there.
    pub(super) fn on_wall(&self, p: DVec2) -> bool {
        let p = (steps(p.x), steps(p.y));
        let corner = |i: usize| self.corners[i];
        let mut walls = self.halves.iter().map(|&(u, v)| (corner(u), corner(v)));
        walls.any(|wall| lies_on(wall, p))
    }

    /// Returns the walk round the least area that holds a point; `None` outside of all walls.
    pub(super) fn around(&self, p: DVec2) -> Option<usize> {
        let round = self.walks.iter().enumerate();
        let holding = round.filter(|(_, w)| w.area2 > SAME && holds(&w.points, p));
        let least = holding.min_by(|(_, v), (_, w)| v.area2.total_cmp(&w.area2));
        least.map(|(number, _)| number)
    }

    /// Returns all walks round areas.
    pub(super) fn walks(&self) -> impl Iterator<Item = usize> + use<'_> {
        let all = self.walks.iter().enumerate();
        all.filter(|(_, walk)| walk.area2 > SAME)
            .map(|(number, _)| number)
    }

    /// Returns a point inside a walk, next to its first side.
    pub(super) fn point_in(&self, walk: usize) -> Option<DVec2> {
        let points = corners(&self.walks[walk].points);
        let (p, q) = (*points.first()?, *points.get(1)?);
        let inward = (q - p).normalize().perp();
        Some((p + q) / 2.0 + inward * 1e-4)
    }

    /// Returns the area inside a walk: its corners, and those of walls that stand free in it.
    pub(super) fn area(&self, walk: usize) -> Vec<Vec<DVec2>> {
        let outer = corners(&self.walks[walk].points);
        let mut all = vec![outer];
        let free = self.walks.iter().zip(&self.around);
        let own = free.filter(|(other, around)| other.area2 < -SAME && **around == Some(walk));
        all.extend(own.map(|(other, _)| corners(&other.points)));
        all.retain(|ring| ring.len() > 2);
        all
    }

    /// Returns the least area that holds the walls of a walk but is bounded by others.
    fn enclosing(&self, walk: usize) -> Option<usize> {
        let Walk {
            points,
            area2,
            group,
        } = &self.walks[walk];
        let first = points.first().filter(|_| *area2 <= SAME)?;
        let round = self.walks.iter().enumerate();
        let other = round.filter(|(_, w)| w.area2 > SAME && w.group != *group);
        let holding = other.filter(|(_, w)| holds(&w.points, *first));
        let least = holding.min_by(|(_, v), (_, w)| v.area2.total_cmp(&w.area2));
        least.map(|(number, _)| number)
    }

    /// Returns a number for each corner; those of walls that stand together have the same.
    fn groups(&self) -> Vec<usize> {
        let mut beside: Vec<Vec<usize>> = vec![vec![]; self.corners.len()];
        for (from, to) in &self.halves {
            beside[*from].push(*to);
        }
        let mut groups = vec![usize::MAX; self.corners.len()];
        for first in 0..groups.len() {
            let mut next = vec![first];
            while let Some(corner) = next.pop() {
                if groups[corner] == usize::MAX {
                    groups[corner] = first;
                    next.extend(&beside[corner]);
                }
            }
        }
        groups
    }

    /// Returns the areas on both sides of a wall, given by its number, at a point on it; `None` if it has no length.
    pub(super) fn beside(
        &self,
        wall: usize,
        (from, to): (DVec2, DVec2),
        p: DVec2,
    ) -> Option<[usize; 2]> {
        let place = |p: DVec2| (steps(p.x), steps(p.y));
        let far = along((place(from), place(to)), place(p));
        let pieces = &self.pieces[wall];
        let (_, half) = pieces.get(pieces.partition_point(|(end, _)| *end < far))?;
        Some([*half, half ^ 1].map(|half| self.inside(self.walk_of[half])))
    }

    /// Returns the area that a walk bounds: itself, or for one round walls from outside the area in which they stand. Outside
    /// of everything it is [`Areas::OUTSIDE`].
    fn inside(&self, walk: usize) -> usize {
        if self.walks[walk].area2 > SAME {
            return walk;
        }
        self.around[walk].unwrap_or(Areas::OUTSIDE)
    }

    /// The place outside of all walls.
    pub(super) const OUTSIDE: usize = usize::MAX;
}

/// Returns the corners of a walk without walls that are walked there and back, and without corners in a straight line.
fn corners(points: &[DVec2]) -> Vec<DVec2> {
    let mut kept: Vec<DVec2> = vec![];
    let straight = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - q).abs() < SAME;
    for point in points {
        while let [.., p, q] = kept[..]
            && straight(p, q, *point)
        {
            kept.pop();
        }
        match kept.last() {
            Some(last) if last.distance(*point) < SAME => {}
            _ => kept.push(*point),
        }
    }
    // The same where the end meets the start.
    loop {
        let n = kept.len();
        if n < 3 {
            return kept;
        }
        let (first, second) = (kept[0], kept[1]);
        let (last, before) = (kept[n - 1], kept[n - 2]);
        if last.distance(first) < SAME || straight(before, last, first) {
            kept.pop();
        } else if straight(last, first, second) {
            kept.remove(0);
        } else {
            return kept;
        }
    }
}

/// Compares directions by the way round from +a over +b.
fn turning(p: Corner, q: Corner) -> std::cmp::Ordering {
    let half = |(a, b): Corner| u8::from(b < 0 || (b == 0 && a < 0));
    let cross = cross(p, q);
    half(p).cmp(&half(q)).then(0.cmp(&cross))
}

fn cross(p: Corner, q: Corner) -> i128 {
    i128::from(p.0) * i128::from(q.1) - i128::from(p.1) * i128::from(q.0)
}

fn minus(p: Corner, q: Corner) -> Corner {
    (p.0 - q.0, p.1 - q.1)
}

/// How far a point lies along a wall, in steps times its length.
fn along((from, to): (Corner, Corner), p: Corner) -> i128 {
    let (way, d) = (minus(to, from), minus(p, from));
    i128::from(way.0) * i128::from(d.0) + i128::from(way.1) * i128::from(d.1)
}

/// Returns true if a point lies on a wall; beside one that slants it may miss the line by a step.
fn lies_on(wall: (Corner, Corner), p: Corner) -> bool {
    let way = minus(wall.1, wall.0);
    let far = i128::from(way.0.abs().max(way.1.abs()));
    let beside = cross(way, minus(p, wall.0)).abs();
    let far_enough = along(wall, p);
    let straight = way.0 == 0 || way.1 == 0;
    beside <= if straight { 0 } else { 2 * far } && (0..=along(wall, wall.1)).contains(&far_enough)
}

/// Returns where one wall is cut by another: ends of the other on it, or the point where they cross.
fn meetings(one: (Corner, Corner), other: (Corner, Corner)) -> Vec<Corner> {
    let apart = |p: i64, q: i64, r: i64, s: i64| p.max(q) < r.min(s) || r.max(s) < p.min(q);
    if apart(one.0.0, one.1.0, other.0.0, other.1.0)
        || apart(one.0.1, one.1.1, other.0.1, other.1.1)
    {
        return vec![];
    }
    let mut found: Vec<Corner> = [other.0, other.1]
        .into_iter()
        .filter(|p| lies_on(one, *p))
        .collect();
    let (d, e) = (minus(one.1, one.0), minus(other.1, other.0));
    let area = cross(d, e);
    if area == 0 {
        return found;
    }
    let between = minus(other.0, one.0);
    let (t, u) = (cross(between, e), cross(between, d));
    let inside = |v: i128| (v > 0 && v < area) || (v < 0 && v > area);
    if inside(t) && inside(u) {
        let share = t as f64 / area as f64;
        let at = |from: i64, way: i64| from + (way as f64 * share).round() as i64;
        found.push((at(one.0.0, d.0), at(one.0.1, d.1)));
    }
    found
}
