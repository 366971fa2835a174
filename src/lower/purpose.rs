//! The shape and covering of roofs by what a house is for, where its roofs say nothing of them (docs/contract.md 8).
//!
//! Halls that are nearly square have pyramids, temples hip-and-gable roofs; all others have gables. Temples and halls are
//! covered with hon-gawara tiles, shrines with bark.

use crate::ast::{Purpose, Rare, RoofKind, RoofShape, StoreyKind};
use crate::building::{Ring, Storey};
use crate::geometry::SAME;
use crate::program::Roofs;
use crate::source::Spanned;

/// How much longer than wide a nearly square plan may be.
const NEARLY_SQUARE: f64 = 1.15;

/// Fills in what the roofs of a house do not say.
pub(super) fn fill(roofs: &mut Rare<Roofs>, purpose: Option<Spanned<Purpose>>, storeys: &[Storey]) {
    let Some(purpose) = purpose else {
        return;
    };
    let mut full = storeys
        .iter()
        .rev()
        .filter(|s| s.kind == StoreyKind::Storey);
    let Some(top) = full.next() else {
        return;
    };
    // A plan that slants gets one hip roof, whatever it is for.
    let slants = |ring: &Ring| {
        ring.walls
            .iter()
            .any(|w| w.direction.abs().max_element() < 1.0)
    };
    if top.rings.iter().any(slants) {
        return;
    }
    let shape = match purpose.value {
        Purpose::Hall if is_nearly_square(top) => Some(RoofShape::Pyramid),
        Purpose::Temple => Some(RoofShape::HipAndGable),
        _ => None,
    };
    let kind = match purpose.value {
        Purpose::Hall | Purpose::Temple => Some(RoofKind::CoverTiles),
        Purpose::Shrine => Some(RoofKind::Bark),
        _ => None,
    };
    let put = |value| Spanned::new(value, purpose.span);
    if let (Some(shape), None) = (shape, &roofs.style.shape) {
        roofs.style.shape = Some(put(shape));
    }
    if let (Some(kind), None) = (kind, &roofs.style.kind) {
        roofs.style.kind = Some(Spanned::new(kind, purpose.span));
    }
}

/// Returns true if a storey is one rectangle that is hardly longer than wide.
fn is_nearly_square(storey: &Storey) -> bool {
    let [ring] = &storey.rings[..] else {
        return false;
    };
    let count = ring.walls.len();
    let turns = |k: usize| {
        let (own, next) = (&ring.walls[k], &ring.walls[(k + 1) % count]);
        own.direction.dot(next.direction).abs() < SAME
    };
    let corners = ring.walls.iter().map(|w| w.from);
    let low = corners.clone().reduce(glam::DVec2::min);
    let high = corners.reduce(glam::DVec2::max);
    let (Some(low), Some(high)) = (low, high) else {
        return false;
    };
    let size = high - low;
    let is_rectangle = ring.closed && (0..count).filter(|k| turns(*k)).count() == 4;
    is_rectangle && size.max_element() <= NEARLY_SQUARE * size.min_element()
}
