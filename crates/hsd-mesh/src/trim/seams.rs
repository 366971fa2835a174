//! The lines of a roof that carry trim: where two slopes meet above (ridge, hip) or below (valley), and the kinds of
//! their free edges (eaves, verge, crest).
//!
//! A slope may be cut into facets by other roofs, into convex pieces, or into the strips of a curve. Facets that fall
//! in nearly the same direction are one slope, and collinear pieces of a line are one seam.

use crate::trim::surface::{Beside, Side, Surface};
use glam::{DVec2, DVec3};
use hsd_base::geometry::tolerance::POINT;
use hsd_ir::building::EdgeKind;
use std::collections::BTreeMap;

/// Pieces of a seam that turn by less than this are one line in plan, as a cosine: 20 degrees.
const GOES_ON: f64 = 0.94;

/// The kind of a seam.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    /// Two slopes meet above on a horizontal line.
    Ridge,
    /// Two slopes meet above on a sloping line.
    Hip,
    /// Two slopes meet below, or one meets another roof on a line across its fall.
    Valley,
    /// The low edge of a slope.
    Eaves,
    /// The edge of a slope along its fall.
    Verge,
    /// The high edge of a slope, free or at a wall.
    Crest,
    /// The edge of a slope along a wall.
    Flank,
}

/// The condition at the end of a seam.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// Open: it ends on the rim of the roof.
    Free,
    /// Other seams of the same roof.
    Met,
    /// Another roof, or a wall.
    Joint,
}

/// A straight piece of a seam.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    /// The facet to its left.
    pub(super) left: u32,
    /// The facet to its right; equal to `left` if there is none.
    pub(super) right: u32,
    /// Depth of the covering's edge at both ends, metres; zero on inner seams.
    pub(super) deep: [f64; 2],
}

/// A line that carries trim, from end to end. Rims run with their roof on the left, hips run upwards.
#[derive(Clone, Debug)]
pub(super) struct Seam {
    pub(super) kind: Kind,
    /// At least two, on the upper surface; straight in plan except for slight bends.
    pub(super) points: Vec<DVec3>,
    /// One fewer than points.
    pub(super) spans: Vec<Span>,
    pub(super) ends: [End; 2],
    /// Lengths by which ridges extend beyond ends at joints, metres.
    pub(super) runs: [f64; 2],
}

/// The surroundings of the joints of one roof.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Beyond {
    /// The rise of the slope beyond each joint in the order of edges, if there is one; empty if it was not computed.
    pub(super) rises: Vec<Option<DVec2>>,
    /// Lengths by which ridges extend beyond their ends at joints, metres, in the order of seams.
    pub(super) runs: Vec<f64>,
}

/// Default extension of a ridge into what covers its end, metres.
const INTO: f64 = 0.15;
/// How far all other trim extends into what it meets at a joint, metres: faces on the joint itself would flicker with those of
/// the other roof or the wall.
pub(super) const REACH: f64 = 0.003;

impl Seam {
    /// Extends it a little at an end.
    fn reach(&mut self, end: usize) {
        let last = self.points.len() - 1;
        let (at, back) = if end == 0 { (0, 1) } else { (last, last - 1) };
        let way = (self.points[at] - self.points[back]).normalize_or_zero();
        self.points[at] += way * REACH;
    }
}

impl Surface {
    /// Returns all seams, ridges first.
    pub(super) fn seams(&self, beyond: &Beyond) -> Vec<Seam> {
        let kinds = self
            .sides
            .iter()
            .filter_map(|side| Some((self.kind(side, beyond)?, *side)));
        let mut pieces: Vec<(Kind, Side)> = kinds.collect();
        pieces.sort_by_key(|(kind, _)| *kind);
        let ends = self.ends();
        let kinds = pieces.chunk_by(|a, b| a.0 == b.0);
        let seams = kinds.flat_map(|same| self.chains(same[0].0, same, &ends));
        let mut seams: Vec<Seam> = seams.collect();
        let mut runs = beyond.runs.iter();
        for seam in &mut seams {
            let is_ridge = matches!(seam.kind, Kind::Ridge | Kind::Hip);
            for end in 0..2 {
                match seam.ends[end] == End::Joint {
                    true if is_ridge => seam.runs[end] = runs.next().copied().unwrap_or(INTO),
                    true => seam.reach(end),
                    false => {}
                }
            }
        }
        seams
    }

    fn kind(&self, side: &Side, beyond: &Beyond) -> Option<Kind> {
        let way = self.at(side.to) - self.at(side.from);
        let run = way.truncate().length();
        if run < POINT {
            return None;
        }
        let Beside::Joint(n) = side.beside else {
            return match side.kind {
                EdgeKind::Ridge => Some(Kind::Ridge),
                EdgeKind::Hip => Some(Kind::Hip),
                EdgeKind::Valley => Some(Kind::Valley),
                EdgeKind::Eaves => Some(Kind::Eaves),
                EdgeKind::Verge => Some(Kind::Verge),
                EdgeKind::Crest => Some(Kind::Crest),
                EdgeKind::Abutment | EdgeKind::Fold => None,
            };
        };
        let facet = &self.facets[side.facet as usize];
        let out = -way.truncate().perp() / run;
        match beyond.rises.get(n as usize) {
            // Another slope: only where both rise from the joint does water run along it.
            Some(Some(rise)) => {
                (facet.rise.dot(out) - rise.dot(out) < -0.05).then_some(Kind::Valley)
            }
            Some(None) => match facet.fall().dot(out) {
                low if low > 0.5 => None,
                high if high < -0.94 => Some(Kind::Crest),
                _ => Some(Kind::Flank),
            },
            None => None,
        }
    }

    /// Returns the condition at each point.
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

    /// Joins pieces of one kind to lines.
    fn chains(&self, kind: Kind, pieces: &[(Kind, Side)], ends: &[End]) -> Vec<Seam> {
        let joints = Joints::new(self, kind, pieces);
        let (way, next) = (|n| joints.way(n), |n, at, way| joints.next(n, at, way));
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

    /// Builds a seam from a line of pieces, merging collinear ones.
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

    /// Returns true if a span continues straight into the next one, between the same planes.
    fn goes_on(&self, a: &Span, b: &Span, p: DVec3, q: DVec3, r: DVec3) -> bool {
        let rise = |f: u32| self.facets[f as usize].rise;
        let same = |f: u32, g: u32| (rise(f) - rise(g)).length() < 1e-6;
        let (before, after) = ((q - p).normalize_or_zero(), (r - q).normalize_or_zero());
        before.dot(after) > 1.0 - 1e-9 && same(a.left, b.left) && same(a.right, b.right)
    }

    /// Returns how steeply the covering falls to the left and to the right of a span, metres per metre across it.
    pub(super) fn leans(&self, span: &Span, way: DVec3) -> [f64; 2] {
        let left = way.truncate().normalize_or_zero().perp();
        let rise = |f: u32| self.facets[f as usize].rise;
        [-rise(span.left).dot(left), rise(span.right).dot(left)]
    }
}

/// Returns a side in the given direction.
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
        ..side
    }
}

/// The connections between pieces of one kind.
struct Joints<'s> {
    surface: &'s Surface,
    kind: Kind,
    pieces: &'s [(Kind, Side)],
    /// The pieces at each point.
    at: BTreeMap<u32, Vec<usize>>,
}

impl<'s> Joints<'s> {
    fn new(surface: &'s Surface, kind: Kind, pieces: &'s [(Kind, Side)]) -> Joints<'s> {
        let mut at: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (n, (_, side)) in pieces.iter().enumerate() {
            at.entry(side.from).or_default().push(n);
            at.entry(side.to).or_default().push(n);
        }
        Joints {
            surface,
            kind,
            pieces,
            at,
        }
    }

    /// Returns the direction of a piece in plan.
    fn way(&self, n: usize) -> DVec2 {
        let side = &self.pieces[n].1;
        let (from, to) = (self.surface.at(side.from), self.surface.at(side.to));
        (to - from).truncate().normalize_or_zero()
    }

    /// Returns the piece that continues this one at a point, and whether it starts there; ridges may be joined head to
    /// head. None if several do.
    fn next(&self, n: usize, point: u32, ahead: DVec2) -> Option<(usize, bool)> {
        let others = self.at.get(&point)?.iter().copied().filter(|m| *m != n);
        // Hips run upwards: two that face each other over a point are two.
        let onward = self.pieces[n].1.to == point;
        let going = others.map(|m| (m, self.pieces[m].1.from == point));
        let going = going.filter(|(_, forward)| self.kind != Kind::Hip || *forward == onward);
        let mut going = going.filter(|(m, forward)| {
            let way = self.way(*m);
            (if *forward { way } else { -way }).dot(ahead) > GOES_ON
        });
        let found = going.next()?;
        going.next().is_none().then_some(found)
    }
}
