//! Squares rings that miss right angles by less than a degree, as measured or drawn plans do, so that roofs divide them
//! into rectangles (docs/contract.md 8).
//!
//! Walls side by side along one axis are put on one line, at the mean of where they lay; corners are where lines
//! meet. Each wall keeps its units, stretched or shortened with it.

use super::close::MEASURED_ANGLE;
use super::walk::Walk;
use crate::messages::plan;
use glam::{DVec2, dvec2};
use hsd_base::diagnostic::Diagnostics;
use hsd_base::geometry::SAME;
use hsd_base::geometry::outline::Axis;
use hsd_base::geometry::outline::square::{Line, meeting};
use hsd_ir::building::Wall;

/// The farthest that a corner may move, metres.
const MOST_MOVE: f64 = 0.3;

/// Squares a closed walk if all its walls are nearly parallel to the axes and no corner moves too far. `unit` is the
/// length of 1 U, metres.
pub(super) fn square(walk: &mut Walk, unit: f64, out: &mut Diagnostics) {
    // The sine of the angle between a wall and its axis.
    let off = |wall: &Wall| wall.direction.abs().min_element();
    let (worst, most) = (walk.walls.iter().enumerate())
        .map(|(n, wall)| (n, off(wall)))
        .fold((0, 0.0), |m, o| if o.1 > m.1 { o } else { m });
    if most == 0.0 || most > MEASURED_ANGLE {
        return;
    }
    let axes: Vec<Axis> = walk.walls.iter().map(|w| Axis::of(w.direction)).collect();
    let from: Vec<DVec2> = walk.walls.iter().map(|w| w.from).collect();
    let Some(corners) = meeting(&from, &axes, Line::Mean) else {
        return;
    };
    let moves = walk.walls.iter().zip(&corners);
    let farthest = moves.map(|(w, c)| w.from.distance(*c)).fold(0.0, f64::max) * unit;
    if farthest > MOST_MOVE || !keeps_directions(&walk.walls, &corners) {
        return;
    }
    let span = walk.walls[worst].span;
    put(&mut walk.walls, &axes, &corners);
    out.push(plan::squared(span, most.asin().to_degrees(), farthest));
}

/// Returns true if every wall is still there and runs as it did.
fn keeps_directions(walls: &[Wall], corners: &[DVec2]) -> bool {
    let next = corners.iter().cycle().skip(1);
    let mut all = walls.iter().zip(corners).zip(next);
    all.all(|((wall, from), to)| (*to - *from).dot(wall.direction) > SAME)
}

fn put(walls: &mut [Wall], axes: &[Axis], corners: &[DVec2]) {
    let next = corners.iter().cycle().skip(1);
    for (((wall, axis), from), to) in walls.iter_mut().zip(axes).zip(corners).zip(next) {
        let share = from.distance(*to) / wall.from.distance(wall.to);
        wall.units.iter_mut().for_each(|unit| unit.width *= share);
        (wall.from, wall.to) = (*from, *to);
        wall.direction = match axis {
            Axis::X => dvec2(wall.direction.x.signum(), 0.0),
            Axis::Y => dvec2(0.0, wall.direction.y.signum()),
        };
    }
}
