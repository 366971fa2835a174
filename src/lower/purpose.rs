//! The shape, covering and pitch of roofs by what a house is for, where its roofs say nothing of them (docs/contract.md 8).
//!
//! | for | shape | covering | pitch |
//! |---|---|---|---|
//! | hall | pyramid if nearly square, else gable | hon-gawara, pantiles under 5 m | |
//! | temple | hip and gable | hon-gawara, pantiles under 5 m | 6 sun from 15 m |
//! | shrine | gable | bark | |
//! | store | gable | | 5 sun |
//! | shed | one slope | metal | |
//! | block | flat | | |
//! | dwelling, gate | gable | | |
//!
//! Metres are those of the shorter side of the top storey; pitches are those of docs/evidence.md 4.3.

use crate::ast::{Purpose, Rare, RoofKind, RoofShape, StoreyKind};
use crate::building::{Ring, Storey};
use crate::diagnostic::{Diagnostics, messages::purpose as say};
use crate::geometry::SAME;
use crate::program::Roofs;
use crate::source::Spanned;
use glam::DVec2;

/// How much longer than wide a nearly square plan may be.
const NEARLY_SQUARE: f64 = 1.15;
/// The shorter side of halls and temples below which they are small, and from which they are great, metres.
const SMALL: f64 = 5.0;
const GREAT: f64 = 15.0;

/// What a purpose says of roofs.
#[derive(Default)]
struct Custom {
    shape: Option<RoofShape>,
    kind: Option<RoofKind>,
    /// Sun per shaku.
    pitch: Option<f64>,
}

/// Fills in what the roofs of a house do not say; `unit` = metres in one U.
pub(super) fn fill(
    roofs: &mut Rare<Roofs>,
    purpose: Option<Spanned<Purpose>>,
    storeys: &[Storey],
    unit: f64,
    out: &mut Diagnostics,
) {
    let Some(purpose) = purpose else {
        if let Some(word) = roofs.by_use {
            out.push(say::no_use(word));
        }
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
    let custom = custom(purpose.value, top, unit);
    let style = &roofs.style;
    let shape = custom.shape.filter(|_| style.shape.is_none());
    // The pitch is that of the usual covering.
    let pitch = custom
        .pitch
        .filter(|_| style.pitch.is_none() && style.kind.is_none());
    let kind = custom.kind.filter(|_| style.kind.is_none());
    if shape.is_none() && pitch.is_none() && kind.is_none() {
        return;
    }
    let span = purpose.span;
    let style = &mut roofs.style;
    style.shape = style.shape.or(shape.map(|s| Spanned::new(s, span)));
    style.pitch = style.pitch.or(pitch.map(|p| Spanned::new(p, span)));
    style.kind = style.kind.or(kind.map(|k| Spanned::new(k, span)));
}

fn custom(purpose: Purpose, top: &Storey, unit: f64) -> Custom {
    let across = size(top).min_element() * unit;
    let tiles = match across < SMALL {
        true => RoofKind::Tiles,
        false => RoofKind::CoverTiles,
    };
    match purpose {
        Purpose::Hall => Custom {
            shape: is_nearly_square(top).then_some(RoofShape::Pyramid),
            kind: Some(tiles),
            pitch: None,
        },
        Purpose::Temple => Custom {
            shape: Some(RoofShape::HipAndGable),
            kind: Some(tiles),
            pitch: (across >= GREAT).then_some(6.0),
        },
        Purpose::Shrine => Custom {
            kind: Some(RoofKind::Bark),
            ..Custom::default()
        },
        Purpose::Store => Custom {
            pitch: Some(5.0),
            ..Custom::default()
        },
        Purpose::Shed => Custom {
            shape: Some(RoofShape::LeanTo),
            kind: Some(RoofKind::Metal),
            pitch: None,
        },
        Purpose::Block => Custom {
            shape: Some(RoofShape::Flat),
            ..Custom::default()
        },
        Purpose::Dwelling | Purpose::Gate => Custom::default(),
    }
}

/// Returns the extent of a storey along its walls, U.
fn size(storey: &Storey) -> DVec2 {
    let corners = storey
        .rings
        .iter()
        .flat_map(|r| r.walls.iter().map(|w| w.from));
    let low = corners.clone().reduce(DVec2::min);
    let high = corners.reduce(DVec2::max);
    low.zip(high).map_or(DVec2::ZERO, |(low, high)| high - low)
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
    let size = size(storey);
    let is_rectangle = ring.closed && (0..count).filter(|k| turns(*k)).count() == 4;
    is_rectangle && size.max_element() <= NEARLY_SQUARE * size.min_element()
}
