//! Walls as straight lines between corners.

use super::chains::{chains, simplified};
use super::faces::Faces;
use glam::{DVec2, dvec2};
use std::collections::BTreeMap;

/// The greatest distance of pixels from their straight line, and of walls that become one, in thicknesses of walls.
const ROUGH: f64 = 0.6;
const NEAR: f64 = 0.7;
/// The least of both, pixels.
const PIXELS: f64 = 1.5;
/// Walls that differ less from an axis are along it: the sine of 10 degrees.
const ALONG: f64 = 0.174;

/// A straight wall between two corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// The corners at its ends.
    pub ends: [usize; 2],
    /// The rooms to its left and right; 0 is outside.
    pub rooms: [u32; 2],
    /// The place of most of it across each axis: at its ends other walls draw it aside.
    pub most: DVec2,
}

/// Walls between rooms.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    /// Corners, pixels.
    pub corners: Vec<DVec2>,
    /// Walls.
    pub lines: Vec<Line>,
}

/// Disjoint sets.
struct Sets(Vec<usize>);

impl Sets {
    fn new(count: usize) -> Sets {
        Sets((0..count).collect())
    }

    fn root(&mut self, k: usize) -> usize {
        let mut k = k;
        while self.0[k] != k {
            self.0[k] = self.0[self.0[k]];
            k = self.0[k];
        }
        k
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = a.min(b);
    }
}

/// Returns the middle of places along each axis.
fn median(places: &[DVec2]) -> DVec2 {
    let middle = |axis: usize| {
        let mut all: Vec<f64> = places.iter().map(|p| p[axis]).collect();
        all.sort_by(f64::total_cmp);
        all[all.len() / 2]
    };
    dvec2(middle(0), middle(1))
}

impl Graph {
    /// Finds the walls between rooms; `usual` is the thickness of walls, pixels.
    pub fn of(faces: &Faces, usual: f64) -> Graph {
        let rough = (ROUGH * usual).max(PIXELS);
        let mut graph = Graph::default();
        let mut known: BTreeMap<[u64; 2], usize> = BTreeMap::new();
        for chain in chains(&faces.of) {
            let points = simplified(&chain.points, rough);
            let corners: Vec<usize> = points
                .iter()
                .map(|p| {
                    let corners = &mut graph.corners;
                    *known
                        .entry([p.x.to_bits(), p.y.to_bits()])
                        .or_insert_with(|| {
                            corners.push(*p);
                            corners.len() - 1
                        })
                })
                .collect();
            let mut from = 0;
            for (ends, to) in corners.windows(2).zip(&points[1..]) {
                let rest = chain.points[from + 1..].iter();
                let end = rest
                    .clone()
                    .position(|p| p == to)
                    .map_or(from + 1, |k| from + 1 + k);
                graph.lines.push(Line {
                    ends: [ends[0], ends[1]],
                    rooms: chain.rooms,
                    most: median(&chain.points[from..=end]),
                });
                from = end;
            }
        }
        let near = (NEAR * usual).max(PIXELS);
        // Once walls are straight, more of them are short.
        for _ in 0..2 {
            graph.contract(near, usual.max(2.0 * PIXELS));
            graph.straighten(near);
        }
        graph.tidy();
        graph
    }

    /// Joins the corners at the ends of short walls: shorter than `near` along an axis, shorter than `aslant` otherwise.
    fn contract(&mut self, near: f64, aslant: f64) {
        let mut sets = Sets::new(self.corners.len());
        for line in &self.lines {
            let [a, b] = line.ends.map(|k| self.corners[k]);
            let is_aslant = (b - a).abs().min_element() > ALONG * a.distance(b);
            if a.distance(b) < if is_aslant { aslant } else { near } {
                sets.join(line.ends[0], line.ends[1]);
            }
        }
        let mut sums = vec![(DVec2::ZERO, 0.0); self.corners.len()];
        for (k, corner) in self.corners.iter().enumerate() {
            let sum = &mut sums[sets.root(k)];
            *sum = (sum.0 + *corner, sum.1 + 1.0);
        }
        for k in 0..self.corners.len() {
            let (sum, count) = sums[sets.root(k)];
            self.corners[k] = sum / count;
        }
        for line in &mut self.lines {
            line.ends = line.ends.map(|k| sets.root(k));
        }
        self.lines.retain(|line| line.ends[0] != line.ends[1]);
    }

    /// Puts walls along the axes onto straight lines, and those that nearly meet onto one.
    fn straighten(&mut self, near: f64) {
        for axis in 0..2 {
            let mut sets = Sets::new(self.corners.len());
            let mut weights = vec![0.0; self.corners.len()];
            let mut sums = vec![0.0; self.corners.len()];
            for line in &self.lines {
                let [a, b] = line.ends;
                let ahead = self.corners[b] - self.corners[a];
                // Along the other axis, so that both ends have the same place on this one.
                if ahead[axis].abs() <= ALONG * ahead.length() {
                    sets.join(a, b);
                    for end in [a, b] {
                        weights[end] += ahead.length();
                        sums[end] += ahead.length() * line.most[axis];
                    }
                }
            }
            let mut groups: BTreeMap<usize, (f64, f64)> = BTreeMap::new();
            for (k, weight) in weights.iter().enumerate().filter(|w| *w.1 > 0.0) {
                let group = groups.entry(sets.root(k)).or_default();
                *group = (group.0 + sums[k], group.1 + weight);
            }
            let mut places: Vec<(f64, f64, Vec<usize>)> = groups
                .into_iter()
                .map(|(root, (sum, weight))| (sum / weight, weight, vec![root]))
                .collect();
            places.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut merged: Vec<(f64, f64, Vec<usize>)> = vec![];
            for place in places {
                match merged.last_mut() {
                    Some(last) if place.0 - last.0 < near => {
                        let weight = last.1 + place.1;
                        last.0 = (last.0 * last.1 + place.0 * place.1) / weight;
                        last.1 = weight;
                        last.2.extend(place.2);
                    }
                    _ => merged.push(place),
                }
            }
            let place_of: BTreeMap<usize, f64> = merged
                .iter()
                .flat_map(|(place, _, roots)| roots.iter().map(|r| (*r, *place)))
                .collect();
            for (k, corner) in self.corners.iter_mut().enumerate() {
                let place = place_of.get(&sets.root(k)).filter(|_| weights[k] > 0.0);
                corner[axis] = place.copied().unwrap_or(corner[axis]);
            }
        }
    }

    /// Makes one of corners at one place, and of walls that go straight on.
    fn tidy(&mut self) {
        let mut known: BTreeMap<[i64; 2], usize> = BTreeMap::new();
        let same: Vec<usize> = (0..self.corners.len())
            .map(|k| {
                let p = (self.corners[k] * 64.0).round();
                *known.entry([p.x as i64, p.y as i64]).or_insert(k)
            })
            .collect();
        for line in &mut self.lines {
            line.ends = line.ends.map(|k| same[k]);
        }
        self.lines.retain(|line| line.ends[0] != line.ends[1]);
        loop {
            let mut at: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
            for (n, line) in self.lines.iter().enumerate() {
                line.ends
                    .iter()
                    .for_each(|k| at.entry(*k).or_default().push(n));
            }
            let straight = at.iter().find_map(|(k, lines)| {
                let [a, b] = lines[..] else { return None };
                let (one, two) = (self.lines[a], self.lines[b]);
                let other = |line: &Line| line.ends[usize::from(line.ends[0] == *k)];
                let (p, q) = (other(&one), other(&two));
                let (u, v) = (
                    self.corners[*k] - self.corners[p],
                    self.corners[q] - self.corners[*k],
                );
                let turn = u.perp_dot(v).abs() / (u.length() * v.length());
                let goes_on = turn < 0.02 && u.dot(v) > 0.0 && p != q;
                goes_on.then_some((a, b, p, q, one.ends[1] == *k))
            });
            let Some((a, b, p, q, ahead)) = straight else {
                break;
            };
            let line = Line {
                ends: if ahead { [p, q] } else { [q, p] },
                ..self.lines[a]
            };
            self.lines[a] = line;
            self.lines.swap_remove(b);
        }
    }

    /// Returns the middle of a wall's ends.
    pub fn middle(&self, line: &Line) -> DVec2 {
        let [a, b] = line.ends.map(|k| self.corners[k]);
        dvec2((a.x + b.x) / 2.0, (a.y + b.y) / 2.0)
    }
}
