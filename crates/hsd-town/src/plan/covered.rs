//! Outlines in the place of others: only one house is built there.

use super::{LotId, NEIGHBOURS, Plan};
use crate::layer::{LEVELS, Lot, Shape};
use crate::shape::{area, shared};

/// Difference in height below which two outlines are of one storey, metres.
const ONE_STOREY: f64 = 1.0;
/// The share of an outline in a larger one from which on both are of one house. Party walls of real maps overlap by less.
const COVERED: f64 = 0.4;
/// The most outlines in a row, each covered by the next, that are looked at.
const CHAIN: usize = 4;

/// An outline that covers another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Covered {
    /// The feature that has it.
    pub by: LotId,
    /// The share of the other outline that lies in it, 0 to 1.
    pub share: f64,
}

impl Plan {
    /// Returns an outline of the same layer that covers a feature, apart from its courtyards. Parts of buildings may be inside of
    /// others.
    pub fn covered(&self, id: LotId) -> Option<Covered> {
        self.covered_within(id, CHAIN)
    }

    fn covered_within(&self, id: LotId, chain: usize) -> Option<Covered> {
        let (lot, layer) = (self.lot(id), &self.layers[id.0]);
        let own = size(lot)?;
        if LEVELS.iter().any(|field| layer.word(lot, field).is_some()) {
            return None;
        }
        let around = self.around(id, 0.0, NEIGHBOURS).into_iter();
        let near = around.filter(|other| other.0 == id.0);
        let mut covers = near.filter_map(|by| {
            let other = self.lot(by);
            // Of two equals the first is built.
            let is_larger = size(other).is_some_and(|size| (size, id) > (own, by));
            let is_level = (other.z - lot.z).abs() < ONE_STOREY;
            let share = (is_larger && is_level).then(|| share(lot, other))?;
            (share >= COVERED).then_some(Covered { by, share })
        });
        covers.find(|c| {
            chain == 0 || c.share == 1.0 || self.covered_within(c.by, chain - 1).is_none()
        })
    }
}

/// Returns the area of an outline with its courtyards, square metres.
fn size(lot: &Lot) -> Option<f64> {
    lot.shape.ring().map(|ring| area(ring, &[]))
}

/// Returns the share of an outline that lies in another and in none of its courtyards.
fn share(lot: &Lot, other: &Lot) -> f64 {
    let (Some(ring), Shape::Area(around, holes)) = (lot.shape.ring(), &other.shape) else {
        return 0.0;
    };
    if other.shape.encloses(ring) {
        return 1.0;
    }
    let whole = area(ring, &[]);
    let ([a, b], [c, d]) = (lot.shape.bounds(), other.shape.bounds());
    let both = (b.min(d) - a.max(c)).max(glam::DVec2::ZERO);
    if both.element_product() < COVERED * whole {
        return 0.0;
    }
    let in_holes: f64 = holes.iter().map(|hole| shared(hole, ring)).sum();
    ((shared(around, ring) - in_holes) / whole).clamp(0.0, 0.99)
}
