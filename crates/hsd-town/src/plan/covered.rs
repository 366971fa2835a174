//! Outlines in the place of others: only one house is built there.

use super::{LotId, NEIGHBOURS, Plan};
use crate::layer::{LEVELS, Lot, Shape};
use crate::shape::{area, shared};
use glam::DVec2;

/// Difference in height below which two outlines are of one storey, metres.
const ONE_STOREY: f64 = 1.0;
/// The share of an outline in a larger one from which on both are of one house. Party walls of real maps overlap by less.
const COVERED: f64 = 0.4;
/// The most outlines that are compared with one, the largest first, and the most in a row of which each covers the one before.
const MOST: usize = 8;
const CHAIN: usize = 2;

/// An outline that covers another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Covered {
    /// The feature that has it.
    pub by: LotId,
    /// The share of the other outline inside it, 0 to 1.
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
        let larger = near.filter_map(|by| {
            let other = self.lot(by);
            let size = size(other)?;
            // Of two equals the first is built.
            let is_larger = (size, id) > (own, by);
            let is_level = (other.z - lot.z).abs() < ONE_STOREY;
            (is_larger && is_level && overlap(lot, other) >= COVERED * own).then_some((size, by))
        });
        let mut larger: Vec<(f64, LotId)> = larger.collect();
        larger.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut covers = larger.iter().take(MOST).filter_map(|(_, by)| {
            let share = share(lot, self.lot(*by));
            (share >= COVERED).then_some(Covered { by: *by, share })
        });
        covers.find(|covered| {
            let is_built = || self.covered_within(covered.by, chain - 1).is_none();
            chain == 0 || covered.share == 1.0 || is_built()
        })
    }
}

/// Returns the area of an outline with its courtyards, square metres.
fn size(lot: &Lot) -> Option<f64> {
    lot.shape.ring().map(|ring| area(ring, &[]))
}

/// Returns the share of an outline inside another, without its courtyards.
fn share(lot: &Lot, other: &Lot) -> f64 {
    let (Some(ring), Shape::Area(around, holes)) = (lot.shape.ring(), &other.shape) else {
        return 0.0;
    };
    if other.shape.encloses(ring) {
        return 1.0;
    }
    let whole = area(ring, &[]);
    let in_holes: f64 = holes.iter().map(|hole| shared(hole, ring)).sum();
    ((shared(around, ring) - in_holes) / whole).clamp(0.0, 0.99)
}

/// Returns the area that the boxes around two outlines share, square metres.
fn overlap(lot: &Lot, other: &Lot) -> f64 {
    let ([a, b], [c, d]) = (lot.shape.bounds(), other.shape.bounds());
    let both = (b.min(d) - a.max(c)).max(DVec2::ZERO);
    both.element_product()
}
