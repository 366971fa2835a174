//! The part of an outline on which a storey stands: a rectangle of shares of its extent along the longest side and
//! across it, the upper body of the published gable house (002-25, parameters 9 to 11).

use super::SurveyedRing;
use super::sides::{self, SurveyedSide};
use glam::DVec2;
use hsd_base::geometry::SAME;
use hsd_base::geometry::area2;
use hsd_base::geometry::outline::clean::clean;
use hsd_ir::ast::OutlinePart;

/// A cut so near to a corner goes through it, U.
const NEAR: f64 = 0.5;

/// The beginning of a side, and the side that it was part of; `None` = it was cut.
type Edge<'r> = (DVec2, Option<&'r SurveyedSide>);

/// The half of the plane that lies behind a line: its normal, and the least distance along it.
#[derive(Clone, Copy)]
struct Behind {
    normal: DVec2,
    least: f64,
}

/// Returns the largest piece of an outline in a rectangle, with its courtyards; nothing if none lies there.
pub(super) fn part(rings: &[SurveyedRing], part: OutlinePart) -> Option<Vec<SurveyedRing>> {
    let outer = rings.iter().find(|ring| !ring.hole)?;
    let mut along = outer.longest();
    if along.x + along.y < 0.0 {
        along = -along;
    }
    let mut edges: Vec<Vec<Edge<'_>>> = rings.iter().map(SurveyedRing::edges).collect();
    for (n, axis) in [along, DVec2::new(-along.y, along.x)]
        .into_iter()
        .enumerate()
    {
        // 0 lies at the front or at the right end.
        let axis = if axis.x + axis.y < 0.0 { -axis } else { axis };
        for half in halves(outer, axis, part.shares[n], part.at[n]) {
            edges = half.clip(edges);
        }
    }
    let mut found: Vec<SurveyedRing> = edges
        .iter()
        .filter_map(|edges| rebuilt(outer, edges))
        .collect();
    let size = |ring: &SurveyedRing| area2(&ring.corners());
    let largest = (0..found.len())
        .filter(|n| !found[*n].hole)
        .max_by(|a, b| size(&found[*a]).total_cmp(&size(&found[*b])))?;
    let outer = found.remove(largest);
    found.retain(|ring| ring.hole && outer.holds(ring.start));
    found.insert(0, outer);
    Some(found)
}

/// Returns the halves of the plane that leave a share of the extent of a ring along an axis.
fn halves(ring: &SurveyedRing, axis: DVec2, share: f64, at: f64) -> Vec<Behind> {
    if share >= 1.0 {
        return vec![];
    }
    let places: Vec<f64> = ring.corners().iter().map(|p| p.dot(axis)).collect();
    let low = places.iter().copied().fold(f64::INFINITY, f64::min);
    let high = places.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let from = low + (1.0 - share) * at * (high - low);
    let to = from + share * (high - low);
    let near = |cut: f64| {
        let off = |p: &&f64| (**p - cut).abs();
        let nearest = places.iter().min_by(|p, q| off(p).total_cmp(&off(q)));
        nearest.filter(|p| off(p) <= NEAR).copied().unwrap_or(cut)
    };
    let both = [(axis, near(from)), (-axis, -near(to))];
    both.map(|(normal, least)| Behind { normal, least }).into()
}

impl Behind {
    fn holds(self, p: DVec2) -> bool {
        p.dot(self.normal) >= self.least - SAME
    }

    /// Returns where a side crosses the line.
    fn crossing(self, p: DVec2, q: DVec2) -> DVec2 {
        let (a, b) = (
            p.dot(self.normal) - self.least,
            q.dot(self.normal) - self.least,
        );
        if (a - b).abs() < SAME {
            p
        } else {
            p.lerp(q, a / (a - b))
        }
    }

    /// Returns what lies behind the line of rings with their interior on the left.
    fn clip(self, rings: Vec<Vec<Edge<'_>>>) -> Vec<Vec<Edge<'_>>> {
        let (mut whole, mut chains) = (vec![], vec![]);
        for ring in rings {
            if ring.iter().all(|(p, _)| self.holds(*p)) {
                whole.push(ring);
            } else {
                self.chains(&ring, &mut chains);
            }
        }
        // Along the line with the kept half on the left, each end of a chain is followed by the next beginning of one.
        let way = DVec2::new(self.normal.y, -self.normal.x);
        let place = |chain: &[Edge<'_>], last: bool| {
            let end = if last { chain.last() } else { chain.first() };
            end.map_or(0.0, |(p, _)| p.dot(way))
        };
        while let Some(first) = chains.pop() {
            let mut ring = first;
            loop {
                let end = place(&ring, true);
                let begin = place(&ring, false);
                let next = (0..chains.len())
                    .filter(|n| place(&chains[*n], false) >= end - SAME)
                    .min_by(|a, b| place(&chains[*a], false).total_cmp(&place(&chains[*b], false)));
                match next {
                    Some(n) if begin < end - SAME || place(&chains[n], false) < begin => {
                        ring.extend(chains.swap_remove(n));
                    }
                    _ => break,
                }
            }
            whole.push(ring);
        }
        whole
    }

    /// Adds the stretches of a ring that lie behind the line, from where they begin on it to where they end on it.
    fn chains<'r>(self, ring: &[Edge<'r>], chains: &mut Vec<Vec<Edge<'r>>>) {
        let n = ring.len();
        let holds = |k: usize| self.holds(ring[k % n].0);
        for begin in (0..n).filter(|k| !holds(*k) && holds(k + 1)) {
            let (p, side) = ring[begin];
            let mut chain = vec![(self.crossing(p, ring[(begin + 1) % n].0), side)];
            let mut k = begin + 1;
            while holds(k) {
                chain.push(ring[k % n]);
                k += 1;
            }
            chain.push((self.crossing(ring[(k - 1) % n].0, ring[k % n].0), None));
            chains.push(chain);
        }
    }
}

/// Returns the ring of some edges; `None` if they enclose nothing. A cut in the direction of the front is on the street
/// as the front is.
fn rebuilt(outer: &SurveyedRing, edges: &[Edge<'_>]) -> Option<SurveyedRing> {
    let points: Vec<DVec2> = edges.iter().map(|(p, _)| *p).collect();
    let marks: Vec<u32> = edges
        .iter()
        .map(|(_, side)| side.map_or(0, |side| side.number as u32))
        .collect();
    let (ring, _) = clean(&points, &marks);
    if ring.is_empty() {
        return None;
    }
    let corners: Vec<DVec2> = ring.iter().map(|side| side.from).collect();
    let hole = area2(&corners) < 0.0;
    let n = corners.len();
    let own = |k: usize| edges[ring[k].number].1;
    let along = |k: usize| corners[(k + 1) % n] - corners[k % n];
    let faces = |k: usize| !hole && along(k).x > along(k).y.abs();
    let length = |k: &usize| along(*k).length();
    let kept = (0..n).find(|k| own(*k).is_some_and(|side| side.is_front()));
    let facing = (0..n)
        .filter(|k| faces(*k))
        .max_by(|a, b| length(a).total_cmp(&length(b)));
    let front = kept.or(facing).unwrap_or(0);
    let longest = sides::longest(&corners);
    let span = outer.span;
    let sides = (0..n).map(|step| {
        let k = (front + step) % n;
        let side = match own(k) {
            Some(side) => side.clone(),
            None => SurveyedSide::cut(span, along(k), hole),
        };
        let ways = [along(k), along(k + 1)];
        side.with(corners[k], ways, k == front && faces(k), longest)
    });
    let first = along(front);
    let first = libm::atan2(first.y, first.x).to_degrees();
    Some(SurveyedRing {
        span,
        hole,
        start: corners[front],
        first: if first.abs() < sides::TURNED {
            0.0
        } else {
            first
        },
        sides: sides.collect(),
    })
}
