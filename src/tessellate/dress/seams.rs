//! The lines of a roof that want dressing, read off the faces of its solids: where two slopes meet above (ridge,
//! hip) or below (valley), and what their free edges are (eaves, verge, crest).
//!
//! A slope is cut into facets in many ways: by other roofs, into convex pieces, into the strips of a curve. Facets
//! whose falls point nearly the same way are one slope, and pieces of a line on one straight way are one seam.

use super::beyond::Beyond;
use crate::building::{Corners, Face, Finish, Solid};
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// Slopes gentler than this are level and have no seams.
const LEVEL: f64 = 0.003;

/// Falls that point the same way as far as this, in the cosine, belong to one slope: 20 degrees.
const SAME_FALL: f64 = 0.94;

/// Pieces of a seam that go on within this, in the cosine, are one line in plan: 20 degrees.
const GOES_ON: f64 = 0.94;

/// Points nearer than this are one, metres.
const WELD: f64 = 1e-6;

/// What a seam is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    /// Two slopes meet above on a level line.
    Ridge,
    /// Two slopes meet above on a line that falls.
    Hip,
    /// Two slopes meet below, or one meets another roof on a line across its fall.
    Valley,
    /// The low edge of a slope.
    Eaves,
    /// The edge of a slope along its fall.
    Verge,
    /// The high edge of a slope, free or at a wall.
    Crest,
    /// Where a slope runs along a wall.
    Flank,
}

/// What lies beyond the end of a seam.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// The open: it ends on the rim of the roof.
    Free,
    /// Other seams of the same roof.
    Met,
    /// Another roof, or a wall.
    Joint,
}

/// A plane sloping piece of the covering.
#[derive(Clone, Debug)]
pub(super) struct Facet {
    /// Indices of points, counter-clockwise seen from above.
    pub(super) corners: Corners,
    /// Rise per metre in plan: points up the slope.
    pub(super) rise: DVec2,
}

impl Facet {
    /// Down the slope in plan, unit length.
    pub(super) fn fall(&self) -> DVec2 {
        -self.rise.normalize_or_zero()
    }
}

/// The covering of one roof.
#[derive(Clone, Debug, Default)]
pub(super) struct Surface {
    pub(super) points: Vec<DVec3>,
    pub(super) facets: Vec<Facet>,
    sides: Vec<Side>,
}

/// An edge of a facet, with the facet on its left.
#[derive(Clone, Copy, Debug)]
struct Side {
    from: u32,
    to: u32,
    facet: u32,
    beside: Beside,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Beside {
    Facet(u32),
    /// The open; how deep the edge of the covering is at both ends, metres.
    Rim([f64; 2]),
    /// A wall or another roof; which of them in the order of edges.
    Joint(u32),
}

/// A piece of a seam on one straight way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    /// The facet to its left.
    pub(super) left: u32,
    /// The facet to its right, the same where nothing lies there.
    pub(super) right: u32,
    /// How deep the edge of the covering is at both ends, metres; zero on inner seams.
    pub(super) deep: [f64; 2],
}

/// A line to be dressed, from end to end. Rims run with their roof on the left, hips upwards.
#[derive(Clone, Debug)]
pub(super) struct Seam {
    pub(super) kind: Kind,
    /// At least two, on the upper surface; straight in plan but for slight bends.
    pub(super) points: Vec<DVec3>,
    /// One less than points.
    pub(super) spans: Vec<Span>,
    pub(super) ends: [End; 2],
    /// How far ridges run on beyond ends at joints, metres.
    pub(super) runs: [f64; 2],
}

/// So far a ridge runs on into what covers its end where nobody measured, metres.
const INTO: f64 = 0.15;

impl Surface {
    /// The covering of some solids.
    pub(super) fn of(solids: &[Solid]) -> Surface {
        let mut surface = Surface::default();
        let mut known: BTreeMap<[i64; 3], u32> = BTreeMap::new();
        let mut rims: BTreeMap<(u32, u32), [f64; 2]> = BTreeMap::new();
        for solid in solids {
            let covers = |f: &&Face| matches!(f.finish, Finish::Covering(_));
            if solid.faces.iter().find(covers).is_none() {
                continue;
            }
            let mut number = |i: u32| -> Option<u32> {
                let p = *solid.points.get(i as usize)?;
                let key = p.to_array().map(|x| (x / WELD).round() as i64);
                Some(*known.entry(key).or_insert_with(|| {
                    surface.points.push(p);
                    surface.points.len() as u32 - 1
                }))
            };
            let mut faces: Vec<(Corners, Finish)> = Vec::with_capacity(solid.faces.len());
            for face in &solid.faces {
                if matches!(face.finish, Finish::Covering(_) | Finish::Edge(_)) {
                    let corners: Corners = face.corners.iter().filter_map(|i| number(*i)).collect();
                    faces.push((corners, face.finish));
                }
            }
            for (corners, finish) in faces {
                match finish {
                    Finish::Covering(_) => surface.facets.extend(facet(&surface.points, corners)),
                    _ => rim(&surface.points, &corners, &mut rims),
                }
            }
        }
        surface.find_sides(&rims);
        surface
    }

    /// All edges of facets with what lies beside them.
    fn find_sides(&mut self, rims: &BTreeMap<(u32, u32), [f64; 2]>) {
        let mut owner: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        for (n, facet) in self.facets.iter().enumerate() {
            for (from, to) in edges(&facet.corners) {
                owner.insert((from, to), n as u32);
            }
        }
        let mut joints = 0;
        for (n, facet) in self.facets.iter().enumerate() {
            for (from, to) in edges(&facet.corners) {
                let beside = match (owner.get(&(to, from)), rims.get(&(from, to))) {
                    (Some(other), _) => Beside::Facet(*other),
                    (None, Some(deep)) => Beside::Rim(*deep),
                    (None, None) => {
                        joints += 1;
                        Beside::Joint(joints - 1)
                    }
                };
                let facet = n as u32;
                self.sides.push(Side {
                    from,
                    to,
                    facet,
                    beside,
                });
            }
        }
    }

    /// Pairs of facets that belong to one slope.
    pub(super) fn kinks(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.sides.iter().filter_map(|side| {
            let Beside::Facet(other) = side.beside else {
                return None;
            };
            let (f, g) = (side.facet as usize, other as usize);
            let alike = self.facets[f].fall().dot(self.facets[g].fall()) > SAME_FALL;
            alike.then_some((f, g))
        })
    }

    /// The area of a facet in plan, square metres.
    pub(super) fn area(&self, facet: usize) -> f64 {
        let corners = &self.facets[facet].corners;
        let plan: Vec<DVec2> = corners.iter().map(|i| self.at(*i).truncate()).collect();
        crate::geometry::area2(&plan) / 2.0
    }

    /// Edges of the rim: from, to, how deep it is at both.
    pub(super) fn rim_sides(&self) -> impl Iterator<Item = (u32, u32, [f64; 2])> + '_ {
        self.sides.iter().filter_map(|side| match side.beside {
            Beside::Rim(deep) => Some((side.from, side.to, deep)),
            _ => None,
        })
    }

    /// How deep the rim of the covering is at a point on it.
    pub(super) fn deep_at(&self, p: DVec3) -> Option<f64> {
        let mut sides = self.rim_sides();
        let found = sides.find(|(from, _, _)| self.at(*from).distance(p) < WELD)?;
        Some(found.2[0])
    }

    /// A point by its number.
    fn at(&self, id: u32) -> DVec3 {
        self.points[id as usize]
    }

    /// The ends of edges at joints, in their order.
    pub(super) fn joints(&self) -> impl Iterator<Item = (DVec3, DVec3)> + '_ {
        let joints = self
            .sides
            .iter()
            .filter(|s| matches!(s.beside, Beside::Joint(_)));
        joints.map(|s| (self.at(s.from), self.at(s.to)))
    }

    /// All seams, ridges first.
    pub(super) fn seams(&self, beyond: &Beyond) -> Vec<Seam> {
        let mut pieces: Vec<(Kind, Side)> = Vec::with_capacity(self.sides.len());
        for side in &self.sides {
            // Of the two sides of an inner edge one is enough.
            let twice = matches!(side.beside, Beside::Facet(_)) && side.from > side.to;
            if let Some(kind) = self.kind(side, beyond).filter(|_| !twice) {
                let upward = self.at(side.from).z <= self.at(side.to).z;
                let side = match (kind, side.beside) {
                    (Kind::Hip, Beside::Facet(other)) if !upward => Side {
                        from: side.to,
                        to: side.from,
                        facet: other,
                        beside: Beside::Facet(side.facet),
                    },
                    _ => *side,
                };
                pieces.push((kind, side));
            }
        }
        pieces.sort_by_key(|(kind, _)| *kind);
        let ends = self.ends();
        let kinds = pieces.chunk_by(|a, b| a.0 == b.0);
        let seams = kinds.flat_map(|same| self.chains(same[0].0, same, &ends));
        let mut seams: Vec<Seam> = seams.collect();
        let ridges = seams
            .iter_mut()
            .filter(|s| matches!(s.kind, Kind::Ridge | Kind::Hip));
        let mut runs = beyond.runs.iter();
        for seam in ridges {
            for end in 0..2 {
                if seam.ends[end] == End::Joint {
                    seam.runs[end] = runs.next().copied().unwrap_or(INTO);
                }
            }
        }
        seams
    }

    fn kind(&self, side: &Side, beyond: &Beyond) -> Option<Kind> {
        let facet = &self.facets[side.facet as usize];
        let way = self.at(side.to) - self.at(side.from);
        let run = way.truncate().length();
        if run < WELD {
            return None;
        }
        let out = -way.truncate().perp() / run;
        match side.beside {
            Beside::Facet(other) => {
                let other = &self.facets[other as usize];
                if facet.fall().dot(other.fall()) > SAME_FALL {
                    return None;
                }
                // How steeply the surface falls away on both sides: a ridge falls on both together.
                let bend = facet.rise.dot(out) - other.rise.dot(out);
                let steep = facet.rise.length().max(other.rise.length());
                let level = way.z.abs() < 0.25 * steep * run;
                match (bend > 0.0, level) {
                    (false, _) => Some(Kind::Valley),
                    (true, true) => Some(Kind::Ridge),
                    (true, false) => Some(Kind::Hip),
                }
            }
            Beside::Rim(_) => Some(match facet.fall().dot(out) {
                low if low > 0.5 => Kind::Eaves,
                high if high < -0.5 => Kind::Crest,
                _ => Kind::Verge,
            }),
            Beside::Joint(n) => match beyond.rises.get(n as usize) {
                // Another slope: only where both rise from the joint water runs along it.
                Some(Some(rise)) => {
                    (facet.rise.dot(out) - rise.dot(out) < -0.05).then_some(Kind::Valley)
                }
                Some(None) => match facet.fall().dot(out) {
                    low if low > 0.5 => None,
                    high if high < -0.94 => Some(Kind::Crest),
                    _ => Some(Kind::Flank),
                },
                None => None,
            },
        }
    }

    /// What lies at each point: the open, a joint, or neither.
    fn ends(&self) -> Vec<End> {
        let mut ends = vec![End::Met; self.points.len()];
        for side in &self.sides {
            let end = match side.beside {
                Beside::Rim(_) => End::Free,
                Beside::Joint(_) => End::Joint,
                Beside::Facet(_) => continue,
            };
            for id in [side.from, side.to] {
                let known = &mut ends[id as usize];
                if *known != End::Free {
                    *known = end;
                }
            }
        }
        ends
    }

    /// Pieces of one kind joined to lines.
    fn chains(&self, kind: Kind, pieces: &[(Kind, Side)], ends: &[End]) -> Vec<Seam> {
        let mut at: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (n, (_, side)) in pieces.iter().enumerate() {
            at.entry(side.from).or_default().push(n);
            at.entry(side.to).or_default().push(n);
        }
        let way = |n: usize| {
            let side = &pieces[n].1;
            (self.at(side.to) - self.at(side.from))
                .truncate()
                .normalize_or_zero()
        };
        // The piece that goes on from this one at a point; ridges may be joined head to head.
        let next = |n: usize, point: u32, ahead: DVec2| -> Option<(usize, bool)> {
            let others = at.get(&point)?.iter().copied().filter(|m| *m != n);
            let going = others.map(|m| (m, pieces[m].1.from == point));
            let mut going = going.filter(|(m, forward)| {
                let way = way(*m);
                (if *forward { way } else { -way }).dot(ahead) > GOES_ON
            });
            let found = going.next()?;
            going.next().is_none().then_some(found)
        };
        let mut used = vec![false; pieces.len()];
        let mut seams = Vec::new();
        for start in 0..pieces.len() {
            if used[start] {
                continue;
            }
            // Back to the first piece, then forward to the last.
            let (mut first, mut forward) = (start, true);
            for _ in 0..pieces.len() {
                let side = &pieces[first].1;
                let (point, ahead) = match forward {
                    true => (side.from, -way(first)),
                    false => (side.to, way(first)),
                };
                match next(first, point, ahead) {
                    Some((m, away)) if m != start && !used[m] => (first, forward) = (m, !away),
                    _ => break,
                }
            }
            let mut links = Vec::new();
            let mut now = Some((first, forward));
            while let Some((n, forward)) = now.filter(|(n, _)| !used[*n]) {
                used[n] = true;
                links.push((n, forward));
                let side = &pieces[n].1;
                now = match forward {
                    true => next(n, side.to, way(n)),
                    false => next(n, side.from, -way(n)),
                };
            }
            let sides = links
                .iter()
                .map(|&(n, forward)| turned(pieces[n].1, forward));
            seams.push(self.seam(kind, &sides.collect::<Vec<_>>(), ends));
        }
        seams
    }

    /// A line of pieces, straight ones joined.
    fn seam(&self, kind: Kind, sides: &[Side], ends: &[End]) -> Seam {
        let mut points: Vec<DVec3> = vec![];
        let mut spans: Vec<Span> = vec![];
        for side in sides {
            let (p, q) = (self.at(side.from), self.at(side.to));
            if points.is_empty() {
                points.push(p);
            }
            let span = Span {
                left: side.facet,
                right: match side.beside {
                    Beside::Facet(other) => other,
                    _ => side.facet,
                },
                deep: match side.beside {
                    Beside::Rim(deep) => deep,
                    _ => [0.0; 2],
                },
            };
            match (spans.last_mut(), points.len()) {
                (Some(last), n) if n > 1 && self.goes_on(last, &span, points[n - 2], p, q) => {
                    last.deep[1] = span.deep[1];
                    points[n - 1] = q;
                }
                _ => {
                    spans.push(span);
                    points.push(q);
                }
            }
        }
        let end = |id: Option<u32>| id.map_or(End::Met, |id| ends[id as usize]);
        Seam {
            kind,
            points,
            spans,
            ends: [
                end(sides.first().map(|s| s.from)),
                end(sides.last().map(|s| s.to)),
            ],
            runs: [0.0; 2],
        }
    }

    /// Whether a span goes on straight in the next one, between the same planes.
    fn goes_on(&self, a: &Span, b: &Span, p: DVec3, q: DVec3, r: DVec3) -> bool {
        let rise = |f: u32| self.facets[f as usize].rise;
        let same = |f: u32, g: u32| (rise(f) - rise(g)).length() < 1e-6;
        let (before, after) = ((q - p).normalize_or_zero(), (r - q).normalize_or_zero());
        before.dot(after) > 1.0 - 1e-9 && same(a.left, b.left) && same(a.right, b.right)
    }

    /// How steeply the covering falls away to the left and to the right of a span, per metre across it.
    pub(super) fn leans(&self, span: &Span, way: DVec3) -> [f64; 2] {
        let left = way.truncate().normalize_or_zero().perp();
        let rise = |f: u32| self.facets[f as usize].rise;
        [-rise(span.left).dot(left), rise(span.right).dot(left)]
    }
}

/// A side the other way round.
fn turned(side: Side, forward: bool) -> Side {
    let Beside::Facet(other) = side.beside else {
        return side;
    };
    if forward {
        return side;
    }
    Side {
        from: side.to,
        to: side.from,
        facet: other,
        beside: Beside::Facet(side.facet),
    }
}

fn edges(corners: &Corners) -> impl Iterator<Item = (u32, u32)> + '_ {
    let n = corners.len();
    (0..n).map(move |i| (corners[i], corners[(i + 1) % n]))
}

/// A face of the covering; level and upright ones have no fall.
fn facet(points: &[DVec3], corners: Corners) -> Option<Facet> {
    let first = points[*corners.first()? as usize];
    let at = |i: usize| points[corners[i] as usize] - first;
    let normal: DVec3 = (1..corners.len().max(1) - 1)
        .map(|i| at(i).cross(at(i + 1)))
        .sum();
    if normal.z <= 1e-9 {
        return None;
    }
    let rise = -normal.truncate() / normal.z;
    (rise.length() > LEVEL).then_some(Facet { corners, rise })
}

/// The edge that a face of the rim hangs on, and how deep it hangs at both ends: its two highest corners beside
/// each other with something under them.
fn rim(points: &[DVec3], corners: &Corners, rims: &mut BTreeMap<(u32, u32), [f64; 2]>) {
    let below = |id: u32| {
        let top = points[id as usize];
        let under = corners.iter().map(|i| points[*i as usize]);
        let under = under.filter(|p| (p.truncate() - top.truncate()).length() < 1e-4);
        under.map(|p| top.z - p.z).fold(0.0, f64::max)
    };
    for (from, to) in edges(corners) {
        let deep = [below(to), below(from)];
        if deep[0] > 0.0 || deep[1] > 0.0 {
            // Run the other way by the face above.
            rims.insert((to, from), deep);
        }
    }
}
