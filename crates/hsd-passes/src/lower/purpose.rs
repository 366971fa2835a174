//! The shape, covering and pitch of roofs by what a house is for, where its roofs say nothing of them (docs/contract.md 8).
//!
//! | for | shape | covering | pitch |
//! |---|---|---|---|
//! | hall | pyramid if nearly square, small porches aside, else gable | hon-gawara, pantiles under 5 m | |
//! | temple | hip and gable | hon-gawara, pantiles under 5 m | 6 sun from 15 m |
//! | shrine | gable | bark | |
//! | store | gable | | 5 sun |
//! | shed | one slope | metal | |
//! | block | flat | | |
//! | dwelling, gate | gable | | |
//!
//! Metres are those of the shorter side of the top storey; pitches are those of docs/evidence.md 4.3.

use crate::messages::plan as say;
use glam::{DVec2, dvec2};
use hsd_base::diagnostic::Diagnostics;
use hsd_base::geometry::{SAME, area2};
use hsd_base::source::Spanned;
use hsd_ir::ast::{Purpose, Rare, RoofKind, RoofShape, StoreyKind};
use hsd_ir::building::{Ring, Storey};
use hsd_ir::program::Roofs;

/// How much longer than wide a nearly square plan may be.
const NEARLY_SQUARE: f64 = 1.15;
/// The shorter side of halls and temples below which they are small, and from which they are great, metres.
const SMALL: f64 = 5.0;
const GREAT: f64 = 15.0;
/// The share of a plan that porches before a hall may take.
const PORCHES: f64 = 0.2;
/// Halls with more corners are no squares with porches.
const MOST_CORNERS: usize = 24;

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

/// Returns true if a storey is one rectangle that is hardly longer than wide, porches aside.
fn is_nearly_square(storey: &Storey) -> bool {
    let [ring] = &storey.rings[..] else {
        return false;
    };
    let corners: Vec<DVec2> = ring.walls.iter().map(|w| w.from).collect();
    let Some(hall) = hall_of(&corners).filter(|_| ring.closed) else {
        return false;
    };
    let [low, high] = hall;
    let size = high - low;
    let whole = area2(&corners).abs() / 2.0;
    let mostly_hall = size.x * size.y >= (1.0 - PORCHES) * whole;
    mostly_hall && size.max_element() <= NEARLY_SQUARE * size.min_element()
}

/// Returns the corners of the largest rectangle inside walls at right angles whose sides lie on walls of theirs.
fn hall_of(corners: &[DVec2]) -> Option<[DVec2; 2]> {
    if corners.len() > MOST_CORNERS {
        return None;
    }
    let sorted = |of: fn(&DVec2) -> f64| {
        let mut all: Vec<f64> = corners.iter().map(of).collect();
        all.sort_by(f64::total_cmp);
        all.dedup_by(|p, q| (*p - *q).abs() < SAME);
        all
    };
    let (xs, ys) = (sorted(|p| p.x), sorted(|p| p.y));
    let pairs = |all: &[f64]| -> Vec<(f64, f64)> {
        let upper = |i: usize| all[i + 1..].iter().map(move |q| (all[i], *q));
        (0..all.len()).flat_map(upper).collect()
    };
    let (wide, deep) = (pairs(&xs), pairs(&ys));
    let boxes = wide.iter().flat_map(|x| deep.iter().map(move |y| (x, y)));
    let boxes = boxes.map(|(x, y)| [dvec2(x.0, y.0), dvec2(x.1, y.1)]);
    let size = |b: &[DVec2; 2]| (b[1] - b[0]).element_product();
    boxes
        .filter(|b| is_inside(b, corners))
        .max_by(|p, q| size(p).total_cmp(&size(q)))
}

/// Returns true if no wall enters a rectangle and its middle is inside the walls.
fn is_inside([low, high]: &[DVec2; 2], corners: &[DVec2]) -> bool {
    let walls = || corners.iter().zip(corners.iter().cycle().skip(1));
    let enters = |(p, q): (&DVec2, &DVec2)| {
        let (from, to) = (p.min(*q), p.max(*q));
        from.cmplt(high - SAME).all() && to.cmpgt(low + SAME).all()
    };
    let middle = low.midpoint(*high);
    let crossed =
        walls().filter(|(p, q)| (p.y <= middle.y) != (q.y <= middle.y) && p.x.max(q.x) > middle.x);
    crossed.count() % 2 == 1 && !walls().any(enters)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rounded(corners: &[(f64, f64)]) -> Option<[DVec2; 2]> {
        let corners: Vec<DVec2> = corners.iter().map(|p| dvec2(p.0, p.1)).collect();
        hall_of(&corners)
    }

    #[test]
    fn the_hall_of_a_plan_with_a_porch_is_what_stands_behind_it() {
        let porch = [
            (0.0, 0.0),
            (4.0, 0.0),
            (4.0, -2.0),
            (6.0, -2.0),
            (6.0, 0.0),
            (10.0, 0.0),
            (10.0, 9.0),
            (0.0, 9.0),
        ];
        assert_eq!(rounded(&porch), Some([dvec2(0.0, 0.0), dvec2(10.0, 9.0)]));
        let l_shaped = [
            (0.0, 0.0),
            (6.0, 0.0),
            (6.0, 4.0),
            (3.0, 4.0),
            (3.0, 9.0),
            (0.0, 9.0),
        ];
        assert_eq!(rounded(&l_shaped), Some([dvec2(0.0, 0.0), dvec2(3.0, 9.0)]));
    }
}
