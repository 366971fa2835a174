//! What is beside a house: parts that stand by themselves, and covered ground.

use crate::fit::fitting;
use crate::messages::fittings as say;
use glam::{DVec2, dvec2};
use hsd_base::diagnostic::Diagnostics;
use hsd_base::geometry::{FOUNDATION, SHAKU};
use hsd_ir::ast;
use hsd_ir::building::House;
use hsd_ir::building::fittings::{Fitting, FittingKind, Ground, Put};
use hsd_ir::program;

/// How far covered ground begins above the ground, metres.
const LOWEST: f64 = 0.001;
/// How thick it is, metres.
const THICK: f64 = 0.012;
/// How much higher the next one lies, so that it shows where it lies on the one before, metres.
const STEP: f64 = 0.003;
/// How much narrower, so that sides of two that end on one line share no plane, metres.
const INSET: f64 = 0.0008;
/// The number of steps.
const MOST: usize = 20;

/// Returns the part in its place; one that stands in the house is reported.
pub(super) fn put(house: &House, written: &program::Put, out: &mut Diagnostics) -> Fitting {
    let rings = house.storeys.first().map_or(&[][..], |s| &s.rings);
    let outlines: Vec<Vec<DVec2>> = rings
        .iter()
        .filter(|ring| ring.closed)
        .map(|ring| ring.walls.iter().map(|wall| wall.from).collect())
        .collect();
    if hsd_base::geometry::in_rings(&outlines, written.at) {
        out.push(say::put_inside(written.span));
    }
    let it = Put {
        part: written.part,
        at: house.place(written.at, level(house)),
        right: turned(written.turn),
        size: dvec2(written.width * house.unit, written.height * SHAKU),
    };
    fitting(written.span, 0, FittingKind::Put(it))
}

/// Returns covered ground in its place, the n-th of its house.
pub(super) fn ground(house: &House, written: &ast::Ground, n: usize) -> Fitting {
    let later = n.min(MOST) as f64;
    let it = Ground {
        surface: written.surface,
        at: house.place(DVec2::from(written.at), level(house) + LOWEST),
        along: turned(written.turn),
        size: DVec2::from(written.size) * house.unit - DVec2::splat(INSET * later),
        thick: THICK + STEP * later,
    };
    fitting(written.span, 0, FittingKind::Ground(it))
}

/// Returns the height of the ground in the house frame, metres: a platform or a veranda raises the house by its own
/// height above it.
fn level(house: &House) -> f64 {
    match house.raised > 0.0 {
        true => -house.raised,
        false => -FOUNDATION,
    }
}

/// Returns the direction to the right of what is turned clockwise by some degrees.
fn turned(degrees: f64) -> DVec2 {
    let turn = degrees.to_radians();
    dvec2(libm::cos(turn), -libm::sin(turn))
}
