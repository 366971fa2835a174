//! The areas between the walls of a storey: faces of the plane that outer and inner walls divide, with the ways between
//! them.
//!
//! Walls are cut where they meet. A walk that turns as far as it can to one side at every end goes round an area; one that
//! goes round from outside is the outline of walls that stand together. Exact: corners are in steps, turns are signs of
//! products of whole numbers.

use crate::geometry::{SAME, STEPS, area2, holds, steps};
use glam::{DVec2, dvec2};
use std::collections::{BTreeMap, HashMap};

/// A corner in steps.
type Corner = (i64, i64);

/// The largest number of walls of a storey whose areas are searched: each is compared with all others.
pub(super) const MOST_WALLS: usize = 1_000;

/// Areas of a storey.
pub(super) struct Areas {
    corners: Vec<Corner>,
    /// Ends of half of each wall: its start and its end. The other direction of half `h` is `h ^ 1`.
    halves: Vec<(usize, usize)>,
    /// The walk that each half belongs to.
    walk_of: Vec<usize>,
    /// Walks: halves in their order.
    walks: Vec<Walk>,
}

struct Walk {
    points: Vec<DVec2>,
    /// Twice its area; positive round an area.
    area2: f64,
}

impl Areas {
    /// Divides the plane by walls, each given by its ends in U.
    pub(super) fn new(walls: &[(DVec2, DVec2)]) -> Areas {
        let place = |p: DVec2| (steps(p.x), steps(p.y));
        let walls: Vec<(Corner, Corner)> = walls
            .iter()
            .map(|(p, q)| (place(*p), place(*q)))
            .filter(|(p, q)| p != q)
            .collect();
        let mut corners: Vec<Corner> = vec![];
        let mut known: HashMap<Corner, usize> = HashMap::new();
        let mut edges: BTreeMap<(usize, usize), ()> = BTreeMap::new();
        for wall in &walls {
            let mut cuts = vec![wall.0, wall.1];
            cuts.extend(walls.iter().flat_map(|other| meetings(*wall, *other)));
            cuts.sort_by_key(|p| along(*wall, *p));
            cuts.dedup();
            let ends: Vec<usize> = cuts
                .into_iter()
                .map(|p| {
                    *known.entry(p).or_insert_with(|| {
                        corners.push(p);
                        corners.len() - 1
                    })
                })
                .collect();
            for pair in ends.windows(2).filter(|pair| pair[0] != pair[1]) {
                edges.insert((pair[0].min(pair[1]), pair[0].max(pair[1])), ());
            }
        }
        let halves: Vec<(usize, usize)> =
            edges.keys().flat_map(|&(p, q)| [(p, q), (q, p)]).collect();
        let mut areas = Areas {
            corners,
            halves,
            walk_of: vec![],
            walks: vec![],
        };
        areas.follow();
        areas
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
            self.walks.push(Walk { points, area2 });
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
        for (number, other) in self.walks.iter().enumerate() {
            let Some(p) = other.points.first().filter(|_| other.area2 < -SAME) else {
                continue;
            };
            // Walls of the same walk touch it; those inside another area belong to that one.
            let own = self.walks[walk].points.contains(p);
            if number != walk && !own && self.around_free(*p, number) == Some(walk) {
                all.push(corners(&other.points));
            }
        }
        all.retain(|ring| ring.len() > 2);
        all
    }

    /// The area in which walls stand free, given one of their corners and the walk round them from outside.
    fn around_free(&self, p: DVec2, outside: usize) -> Option<usize> {
        let group = |w: &Walk| {
            w.points
                .iter()
                .any(|q| self.walks[outside].points.contains(q))
        };
        let round = self.walks.iter().enumerate();
        let holding = round.filter(|(_, w)| w.area2 > SAME && !group(w) && holds(&w.points, p));
        let least = holding.min_by(|(_, v), (_, w)| v.area2.total_cmp(&w.area2));
        least.map(|(number, _)| number)
    }

    /// Returns what lies on both sides of the wall at a point; `None` if there is none.
    pub(super) fn at_wall(&self, p: DVec2) -> Option<[usize; 2]> {
        let p = (steps(p.x), steps(p.y));
        let corner = |i: usize| self.corners[i];
        let found = (0..self.halves.len()).find(|&half| {
            let (u, v) = self.halves[half];
            lies_on((corner(u), corner(v)), p)
        })?;
        Some([found, found ^ 1].map(|half| self.inside(self.walk_of[half])))
    }

    /// Returns the area that a walk bounds: itself, or for one round free walls the area in which they stand. Outside of
    /// everything it is [`Areas::OUTSIDE`].
    fn inside(&self, walk: usize) -> usize {
        if self.walks[walk].area2 > SAME {
            return walk;
        }
        let first = self.walks[walk].points[0];
        self.around_free(first, walk).unwrap_or(Areas::OUTSIDE)
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
