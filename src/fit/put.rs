//! Parts that stand by themselves on the ground beside a house.

use crate::building::House;
use crate::building::fittings::{Fitting, FittingKind, Put};
use crate::diagnostic::Diagnostics;
use crate::diagnostic::messages::fittings as say;
use crate::fit::fitting;
use crate::geometry::{FOUNDATION, SHAKU};
use crate::program;
use glam::{DVec2, dvec2};

/// Returns the part in its place; one that stands in the house is reported.
pub(super) fn put(house: &House, written: &program::Put, out: &mut Diagnostics) -> Fitting {
    let rings = house.storeys.first().map_or(&[][..], |s| &s.rings);
    let outlines: Vec<Vec<DVec2>> = rings
        .iter()
        .filter(|ring| ring.closed)
        .map(|ring| ring.walls.iter().map(|wall| wall.from).collect())
        .collect();
    if crate::geometry::in_rings(&outlines, written.at) {
        out.push(say::put_inside(written.span));
    }
    // A platform or a veranda raises the house by its own height above the ground.
    let ground = match house.raised > 0.0 {
        true => house.raised,
        false => FOUNDATION,
    };
    let turn = written.turn.to_radians();
    let it = Put {
        part: written.part,
        at: house.place(written.at, -ground),
        right: dvec2(libm::cos(turn), -libm::sin(turn)),
        size: dvec2(written.width * house.unit, written.height * SHAKU),
    };
    fitting(written.span, 0, FittingKind::Put(it))
}
