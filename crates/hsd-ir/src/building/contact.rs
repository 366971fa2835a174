//! Edges where the roofs of one storey meet: for each, the slope of the other roof beyond it is found, and it becomes a
//! valley, a ridge, a hip or a fold; all others stay abutments.

use crate::building::{Beside, EdgeKind, Roof, RoofSurface, meeting};
use glam::{DVec2, DVec3};

/// Storeys with more facets than this keep plain abutments, since the search visits every facet.
const MOST_FACETS: usize = 3000;
/// Distance beyond an edge at which its neighbour is searched for, metres.
const STEP: f64 = 0.02;
/// Maximum height difference between the neighbour and the edge there, metres.
const RISE: f64 = 0.04;
/// Slopes that bend less than this at an edge, as a change of rise per metre, count as one.
const FLAT: f64 = 0.05;

/// A facet of a roof.
struct Slope {
    roof: usize,
    low: DVec2,
    high: DVec2,
    plan: Vec<DVec2>,
    at: DVec3,
    rise: DVec2,
}

impl Slope {
    fn holds(&self, p: DVec2) -> bool {
        let next = self.plan.iter().cycle().skip(1);
        let mut sides = self.plan.iter().zip(next);
        let inside = self.low.cmple(p).all() && p.cmple(self.high).all();
        inside && sides.all(|(a, b)| (*b - *a).perp_dot(p - *a) >= -1e-9)
    }

    fn height(&self, p: DVec2) -> f64 {
        self.at.z + self.rise.dot(p - self.at.truncate())
    }
}

/// Returns the upper surfaces of the roofs of a house.
pub(super) fn surfaces(roofs: &[Roof]) -> Vec<RoofSurface> {
    let own = roofs.iter().map(|roof| RoofSurface::of(&roof.solids));
    let mut surfaces: Vec<RoofSurface> = own.collect();
    let mut first = 0;
    for storey in roofs.chunk_by(|p, q| p.storey == q.storey) {
        let next = first + storey.len();
        classify(&mut surfaces[first..next], first);
        first = next;
    }
    surfaces
}

/// Types the edges at which the roofs of one storey, of which the first has this index in the house, meet each other.
fn classify(roofs: &mut [RoofSurface], first: usize) {
    let wall = |r: &RoofSurface| r.edges.iter().any(|e| e.beside == Beside::Wall);
    let count: usize = roofs.iter().map(|r| r.facets.len()).sum();
    if roofs.len() < 2 || count > MOST_FACETS || !roofs.iter().any(wall) {
        return;
    }
    let all: Vec<Slope> = (first..)
        .zip(roofs.iter())
        .flat_map(|(n, r)| slopes(n, r))
        .collect();
    for (n, surface) in (first..).zip(roofs) {
        for i in 0..surface.edges.len() {
            let edge = surface.edges[i];
            if edge.beside != Beside::Wall {
                continue;
            }
            let [from, to] = surface.ends(&edge);
            let middle = from.midpoint(to);
            let out = -(to - from).truncate().perp().normalize_or_zero();
            let place = middle.truncate() + out * STEP;
            let near = |s: &&Slope| {
                s.roof != n && s.holds(place) && (s.height(place) - middle.z).abs() < RISE
            };
            let Some(other) = all.iter().find(near) else {
                continue;
            };
            let own = surface.facets[edge.facet as usize].rise;
            let edge = &mut surface.edges[i];
            edge.beside = Beside::Roof(other.roof as u32);
            edge.kind = match (own - other.rise).dot(out).abs() < FLAT {
                true => EdgeKind::Fold,
                false => meeting(own, other.rise, to - from),
            };
        }
    }
}

fn slopes(n: usize, surface: &RoofSurface) -> impl Iterator<Item = Slope> + '_ {
    surface.facets.iter().map(move |facet| {
        let points = facet.corners.iter().map(|i| surface.at(*i).truncate());
        let plan: Vec<DVec2> = points.collect();
        let min = plan.iter().copied().fold(DVec2::MAX, DVec2::min);
        let max = plan.iter().copied().fold(DVec2::MIN, DVec2::max);
        Slope {
            roof: n,
            low: min,
            high: max,
            plan,
            at: surface.at(facet.corners[0]),
            rise: facet.rise,
        }
    })
}
