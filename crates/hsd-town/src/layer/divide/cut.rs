//! Deep areas cut by streets.

use super::split::{Line, Piece, Split};
use crate::shape::{contains, distance, sides};
use glam::DVec2;
use hsd_ir::ast::town::Division;

/// The distance of the points at which the depth of an area is measured, as a share of that which is looked for.
const STEP: f64 = 0.1;

/// Returns the blocks of an area and the streets between them.
pub(super) fn cut(area: &Piece, division: &Division) -> (Vec<Piece>, Vec<Piece>) {
    if !is_deep(area, division.deep) {
        return (vec![area.clone()], vec![]);
    }
    let along = direction(&area.ring);
    let across = along.perp();
    let extent = |way: DVec2| {
        let places = area.ring.iter().map(|p| p.dot(way));
        places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], t| {
            [low.min(t), high.max(t)]
        })
    };
    let (mut blocks, mut streets) = (vec![area.clone()], vec![]);
    let [wide, long] = division.every;
    // Streets across come first, so that they go through from one border to the other.
    for (way, every) in [(along, long), (across, wide)] {
        let [low, high] = extent(way);
        let count = ((high - low + division.street) / every).round().max(1.0);
        let pitch = (high - low + division.street) / count;
        for n in 1..count as usize {
            let end = low + pitch * n as f64;
            let strip = [end - division.street, end];
            blocks = blocks
                .into_iter()
                .flat_map(|block| {
                    let (rest, street) = without_strip(block, way, strip);
                    streets.extend(street);
                    rest
                })
                .collect();
        }
    }
    (blocks, streets)
}

/// Cuts a strip across a direction out of a piece; returns what is left and the strip.
fn without_strip(piece: Piece, way: DVec2, [low, high]: [f64; 2]) -> (Vec<Piece>, Vec<Piece>) {
    let line = |t: f64| Line {
        at: way * t,
        way: -way.perp(),
    };
    let Split {
        left: mut rest,
        right: before,
    } = piece.split(line(high));
    let mut street = vec![];
    for piece in before {
        let Split { left, right } = piece.split(line(low));
        street.extend(left);
        rest.extend(right);
    }
    (rest, street)
}

/// Returns true if a point of an area is farther than half this depth from its border.
fn is_deep(area: &Piece, deep: f64) -> bool {
    let step = deep * STEP;
    let far = |p: DVec2| {
        let rings = std::iter::once(&area.ring).chain(&area.holes);
        contains(&area.ring, p)
            && rings.clone().all(|ring| distance(ring, p) > deep / 2.0)
            && !area.holes.iter().any(|hole| contains(hole, p))
    };
    let [low, high] = area
        .ring
        .iter()
        .fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], p| {
            [low.min(*p), high.max(*p)]
        });
    let steps = ((high - low) / step).ceil();
    let (columns, rows) = (steps.x as usize, steps.y as usize);
    (0..columns)
        .any(|x| (0..rows).any(|y| far(low + DVec2::new(x as f64 + 0.5, y as f64 + 0.5) * step)))
}

/// Returns the direction that the sides of a ring agree on best, up to right angles: the longer way through it.
fn direction(ring: &[DVec2]) -> DVec2 {
    let (mut sin, mut cos) = (0.0, 0.0);
    for side in sides(ring) {
        let way = side.to - side.from;
        let turn = 4.0 * libm::atan2(way.y, way.x);
        sin += side.length() * libm::sin(turn);
        cos += side.length() * libm::cos(turn);
    }
    let turn = libm::atan2(sin, cos) / 4.0;
    let way = DVec2::new(libm::cos(turn), libm::sin(turn));
    let extent = |way: DVec2| {
        let places = ring.iter().map(|p| p.dot(way));
        let [low, high] = places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], t| {
            [low.min(t), high.max(t)]
        });
        high - low
    };
    if extent(way) >= extent(way.perp()) {
        way
    } else {
        way.perp()
    }
}
