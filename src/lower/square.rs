//! Squares rings that miss right angles by less than a degree, as measured or drawn plans do, so that roofs divide them
//! into rectangles (docs/contract.md 8).
//!
//! Walls side by side along one axis are put on one line, at the mean of where they lay; corners are where lines
//! meet. Each wall keeps its units, stretched or shortened with it.

use super::close::MEASURED_ANGLE;
use super::walk::Walk;
use crate::building::Wall;
use crate::diagnostic::{Diagnostics, messages::plan};
use crate::geometry::SAME;
use glam::{DVec2, dvec2};

/// The farthest that a corner may move, metres.
const MOST_MOVE: f64 = 0.3;

/// A wall's axis: along a, or along b.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Axis {
    A,
    B,
}

impl Axis {
    /// Returns the axis nearest to a direction, and the sine of the angle between the two.
    fn of(direction: DVec2) -> (Axis, f64) {
        let [a, b] = direction.abs().to_array();
        if a > b { (Axis::A, b) } else { (Axis::B, a) }
    }

    /// Returns the coordinate that is the same all along the axis.
    fn across(self, p: DVec2) -> f64 {
        match self {
            Axis::A => p.y,
            Axis::B => p.x,
        }
    }

    /// Moves a point onto a line along the axis.
    fn onto(self, p: DVec2, line: f64) -> DVec2 {
        match self {
            Axis::A => dvec2(p.x, line),
            Axis::B => dvec2(line, p.y),
        }
    }
}

/// Squares a closed walk if all its walls are nearly parallel to the axes and no corner moves too far. `unit` is the
/// length of 1 U, metres.
pub(super) fn square(walk: &mut Walk, unit: f64, out: &mut Diagnostics) {
    let axes: Vec<(Axis, f64)> = walk.walls.iter().map(|w| Axis::of(w.direction)).collect();
    let (worst, most) = (axes.iter().enumerate())
        .map(|(n, (_, off))| (n, *off))
        .fold((0, 0.0), |m, o| if o.1 > m.1 { o } else { m });
    if most == 0.0 || most > MEASURED_ANGLE {
        return;
    }
    let axes: Vec<Axis> = axes.into_iter().map(|(axis, _)| axis).collect();
    let Some(corners) = corners(&walk.walls, &axes) else {
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

/// Returns where the walls begin once they are parallel to their axes; `None` if they do not turn.
fn corners(walls: &[Wall], axes: &[Axis]) -> Option<Vec<DVec2>> {
    let n = walls.len();
    let before = |i: usize| (i + n - 1) % n;
    let first = (0..n).find(|i| axes[before(*i)] != axes[*i])?;
    // The line of each wall: that of all walls side by side with it.
    let mut lines = vec![0.0; n];
    let mut start = 0;
    while start < n {
        let at = |k: usize| (first + k) % n;
        let axis = axes[at(start)];
        let count = (start..n).take_while(|k| axes[at(*k)] == axis).count();
        let (mut sum, mut whole) = (0.0, 0.0);
        for wall in (start..start + count).map(|k| &walls[at(k)]) {
            let length = wall.from.distance(wall.to);
            sum += axis.across(wall.from.midpoint(wall.to)) * length;
            whole += length;
        }
        (start..start + count).for_each(|k| lines[at(k)] = sum / whole);
        start += count;
    }
    let corner = |i: usize| {
        let p = axes[i].onto(walls[i].from, lines[i]);
        axes[before(i)].onto(p, lines[before(i)])
    };
    Some((0..n).map(corner).collect())
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
            Axis::A => dvec2(wall.direction.x.signum(), 0.0),
            Axis::B => dvec2(0.0, wall.direction.y.signum()),
        };
    }
}
