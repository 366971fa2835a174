//! Squares rings whose walls are nearly parallel to two axes at right angles.
//!
//! Walls side by side along one axis are put on one line; corners are where lines meet. A wall so short that its ends
//! change places leaves its line to its neighbours.

use super::clean::drop_where;
use super::{Ring, Side, are_simple, corners, ends};
use glam::{DVec2, dvec2};

/// The largest angle between a wall and its axis, degrees (docs/contract.md 8).
pub const MOST_OFF: f64 = 12.0;
/// Walls are taken out if they would be shorter, metres.
const SHORTEST: f64 = 0.02;
/// The steps by which the axes are turned to find the best, degrees, and their number to each side.
const STEP: f64 = 0.25;
const STEPS: i32 = 12;

/// The direction of a wall: along x, or along y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// Along x.
    X,
    /// Along y.
    Y,
}

impl Axis {
    /// Returns the axis nearest to a direction.
    pub fn of(direction: DVec2) -> Axis {
        let [x, y] = direction.abs().to_array();
        if x > y { Axis::X } else { Axis::Y }
    }

    /// Returns the coordinate that is the same all along the axis.
    pub fn across(self, p: DVec2) -> f64 {
        match self {
            Axis::X => p.y,
            Axis::Y => p.x,
        }
    }

    /// Moves a point onto a line along the axis.
    pub fn onto(self, p: DVec2, line: f64) -> DVec2 {
        match self {
            Axis::X => dvec2(p.x, line),
            Axis::Y => dvec2(line, p.y),
        }
    }
}

/// Rings at right angles.
#[derive(Clone, Debug)]
pub struct Squared {
    /// The direction of the x axis of the rings in the frame of the survey, radians.
    pub turn: f64,
    /// The rings in their own frame: every wall is parallel to x or y.
    pub rings: Vec<Ring>,
    /// The farthest that a corner moved, metres.
    pub moved: f64,
}

/// Why rings could not be squared: the ring, and the number of a side or corner as surveyed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Crooked {
    /// A side at more than [`MOST_OFF`] degrees from its axis; its angle.
    Slants(usize, usize, f64),
    /// A corner that would move too far, and how far, metres.
    Moves(usize, usize, f64),
    /// The walls would cross.
    Crosses,
}

/// Squares rings if all their longer walls lie within [`MOST_OFF`] degrees of two axes and no corner moves by more than
/// `most` metres.
///
/// # Errors What stands in the way, for the axes along which most of the length of the walls lies.
pub fn square(rings: &[Ring], most: f64) -> Result<Squared, Crooked> {
    let turn = main_direction(rings);
    let first = attempt(rings, turn, most);
    let Err(reason) = first else {
        return first;
    };
    // A wall that slants by far more than the axes are turned stays slanting.
    if matches!(reason, Crooked::Slants(_, _, angle) if angle > MOST_OFF + STEP * f64::from(STEPS))
    {
        return Err(reason);
    }
    let turns = (1..=STEPS).flat_map(|k| [k, -k]);
    let turned = turns.map(|k| turn + (f64::from(k) * STEP).to_radians());
    let tried = turned.filter_map(|turn| attempt(rings, turn, most).ok());
    tried
        .reduce(|best, next| if next.moved < best.moved { next } else { best })
        .ok_or(reason)
}

/// Squares the walls of rings that lie within [`MOST_OFF`] degrees of two axes, and leaves the others slanting between their
/// corners; none if a corner would move by more than `most` metres, or most of the length slants.
pub fn square_partly(rings: &[Ring], most: f64) -> Option<Squared> {
    let mut turn = main_direction(rings);
    for _ in 0..3 {
        let straight = |ring: &Ring| -> Vec<_> {
            let numbers = 0..ring.len();
            let kept = numbers.filter(|side| axis_within(ring, *side, turn).is_some());
            kept.map(|side| ends(ring, side)).collect()
        };
        turn = direction_of(rings.iter().flat_map(straight));
    }
    let about = dvec2(libm::cos(turn), -libm::sin(turn));
    let mut squared = Squared {
        turn,
        rings: Vec::with_capacity(rings.len()),
        moved: 0.0,
    };
    let (mut right, mut whole) = (0.0, 0.0);
    for ring in rings {
        let axes: Vec<Option<Axis>> = (0..ring.len())
            .map(|n| axis_within(ring, n, turn))
            .collect();
        let mut made = ring.clone();
        made.iter_mut()
            .for_each(|side| side.from = about.rotate(side.from));
        let places = meeting_partly(&corners(&made), &axes, most);
        for (n, place) in places.iter().enumerate() {
            let (p, q) = ends(&made, n);
            let now = places[(n + 1) % places.len()] - *place;
            if now.dot(q - p) <= 0.0 {
                return None;
            }
            whole += p.distance(q);
            right += if axes[n].is_some() {
                p.distance(q)
            } else {
                0.0
            };
            squared.moved = squared.moved.max(p.distance(*place));
        }
        made.iter_mut()
            .zip(&places)
            .for_each(|(side, place)| side.from = *place);
        squared.rings.push(made);
    }
    let sound = squared.moved <= most && right >= 0.5 * whole && are_simple(&squared.rings);
    sound.then_some(squared)
}

/// Returns the axis of a side that lies within [`MOST_OFF`] degrees of it, in a frame turned by some radians.
fn axis_within(ring: &[Side], side: usize, turn: f64) -> Option<Axis> {
    let (p, q) = ends(ring, side);
    let way = dvec2(libm::cos(turn), -libm::sin(turn)).rotate(q - p);
    let [x, y] = way.abs().to_array();
    let angle = libm::atan2(x.min(y), x.max(y)).to_degrees();
    (angle <= MOST_OFF).then(|| Axis::of(way))
}

/// Walls side by side along one axis.
struct Run {
    axis: Axis,
    sides: Vec<usize>,
    /// Its line and its length.
    line: f64,
    length: f64,
}

/// Returns where walls begin once those with an axis are parallel to it. Walls side by side along one axis share a line, and
/// so do those on both sides of a slanting wing, if their lines are no farther apart than `most`.
fn meeting_partly(from: &[DVec2], axes: &[Option<Axis>], most: f64) -> Vec<DVec2> {
    let n = from.len();
    let before = |i: usize| (i + n - 1) % n;
    let mut runs: Vec<Run> = vec![];
    for first in (0..n).filter(|i| axes[before(*i)] != axes[*i]) {
        let Some(axis) = axes[first] else { continue };
        let sides = (0..n).map(|k| (first + k) % n);
        let sides: Vec<usize> = sides.take_while(|k| axes[*k] == Some(axis)).collect();
        let walls = || sides.iter().map(|k| (from[*k], from[(k + 1) % n]));
        let (line, length) = (
            mean(axis, walls()),
            walls().map(|(p, q)| p.distance(q)).sum(),
        );
        runs.push(Run {
            axis,
            sides,
            line,
            length,
        });
    }
    for k in 0..runs.len() {
        let next = (k + 1) % runs.len();
        let (one, two) = (&runs[k], &runs[next]);
        let apart = (one.line - two.line).abs();
        if k != next && one.axis == two.axis && apart > 0.0 && apart <= most {
            let length = one.length + two.length;
            let line = (one.line * one.length + two.line * two.length) / length;
            for run in [k, next] {
                (runs[run].line, runs[run].length) = (line, length);
            }
        }
    }
    let mut lines = vec![0.0; n];
    for run in &runs {
        run.sides.iter().for_each(|side| lines[*side] = run.line);
    }
    let onto = |p: DVec2, side: usize| axes[side].map_or(p, |axis| axis.onto(p, lines[side]));
    (0..n).map(|i| onto(onto(from[i], i), before(i))).collect()
}

/// Returns the direction of the axes: directions that differ by right angles count as one, so their fourfold angles agree.
fn main_direction(rings: &[Ring]) -> f64 {
    let sides = |ring: &'_ Ring| -> Vec<_> { (0..ring.len()).map(|n| ends(ring, n)).collect() };
    direction_of(rings.iter().flat_map(sides))
}

fn direction_of(sides: impl Iterator<Item = (DVec2, DVec2)>) -> f64 {
    let mut sum = DVec2::ZERO;
    for (p, q) in sides {
        let angle = 4.0 * libm::atan2(q.y - p.y, q.x - p.x);
        sum += dvec2(libm::cos(angle), libm::sin(angle)) * p.distance(q);
    }
    libm::atan2(sum.y, sum.x) / 4.0
}

fn attempt(rings: &[Ring], turn: f64, most: f64) -> Result<Squared, Crooked> {
    let about = dvec2(libm::cos(turn), -libm::sin(turn));
    let mut squared = Squared {
        turn,
        rings: Vec::with_capacity(rings.len()),
        moved: 0.0,
    };
    for (number, ring) in rings.iter().enumerate() {
        let turned = |side: &Side| Side {
            from: about.rotate(side.from),
            ..*side
        };
        let turned: Ring = ring.iter().map(turned).collect();
        slants(&turned, number, most)?;
        let (made, moved) = settle(&turned, number, most)?;
        squared.moved = squared.moved.max(moved);
        squared.rings.push(made);
    }
    match are_simple(&squared.rings) {
        true => Ok(squared),
        false => Err(Crooked::Crosses),
    }
}

/// Refuses walls that slant; one whose ends can meet its neighbours within `most` does no harm.
fn slants(ring: &[Side], number: usize, most: f64) -> Result<(), Crooked> {
    let off = |side: usize| {
        let (p, q) = ends(ring, side);
        let [x, y] = (q - p).abs().to_array();
        let angle = libm::atan2(x.min(y), x.max(y)).to_degrees();
        (angle, p.distance(q) > 2.0 * most)
    };
    let long = (0..ring.len()).map(|side| (side, off(side)));
    let worst = long
        .filter(|(_, (_, is_long))| *is_long)
        .map(|(side, (angle, _))| (side, angle))
        .fold((0, 0.0), |w, o| if o.1 > w.1 { o } else { w });
    match worst.1 > MOST_OFF {
        true => Err(Crooked::Slants(number, ring[worst.0].number, worst.1)),
        false => Ok(()),
    }
}

/// Puts the walls of a ring on their lines, first on the means of where they lay, then midway between their ends; returns
/// the farthest move too.
fn settle(ring: &Ring, number: usize, most: f64) -> Result<(Ring, f64), Crooked> {
    let mean = settled(ring, Line::Mean);
    let (made, (corner, moved)) = match mean {
        Some((made, far)) if far.1 <= most => (made, far),
        _ => settled(ring, Line::Middle).ok_or(Crooked::Crosses)?,
    };
    match moved <= most {
        true => Ok((made, moved)),
        false => Err(Crooked::Moves(number, ring[corner].corner, moved)),
    }
}

/// Where the line of several walls lies.
#[derive(Clone, Copy)]
pub enum Line {
    /// At their mean, long walls counting more.
    Mean,
    /// Midway between the outermost of their ends.
    Middle,
}

fn settled(ring: &Ring, line: Line) -> Option<(Ring, (usize, f64))> {
    let mut made = ring.clone();
    for _ in 0..ring.len() {
        let axes: Vec<Axis> = (0..made.len())
            .map(|side| ends(&made, side))
            .map(|(p, q)| Axis::of(q - p))
            .collect();
        let places = meeting(&corners(&made), &axes, line)?;
        let count = made.len();
        let gone = (0..count).find(|&side| {
            let (p, q) = ends(&made, side);
            let now = places[(side + 1) % count] - places[side];
            let is_bend = axes[side] == axes[(side + count - 1) % count];
            now.dot((q - p).normalize_or_zero()) < SHORTEST && !is_bend
        });
        let Some(side) = gone else {
            for (side, place) in made.iter_mut().zip(&places) {
                side.from = *place;
            }
            straighten(&mut made);
            let far = farthest(ring, &made);
            return (made.len() >= 4).then_some((made, far));
        };
        // The neighbours on both sides of it come to lie on one line.
        let (p, q) = ends(&made, side);
        made[(side + 1) % count].from = p.midpoint(q);
        made.remove(side);
        if made.len() < 4 {
            return None;
        }
    }
    None
}

/// Returns where walls begin once they are parallel to their axes; `None` if they do not turn. Walls side by side along
/// one axis share a line.
pub fn meeting(from: &[DVec2], axes: &[Axis], line: Line) -> Option<Vec<DVec2>> {
    let n = from.len();
    let before = |i: usize| (i + n - 1) % n;
    let first = (0..n).find(|i| axes[before(*i)] != axes[*i])?;
    let mut lines = vec![0.0; n];
    let mut start = 0;
    while start < n {
        let at = |k: usize| (first + k) % n;
        let axis = axes[at(start)];
        let count = (start..n).take_while(|k| axes[at(*k)] == axis).count();
        let run = (start..start + count).map(|k| (from[at(k)], from[at(k + 1)]));
        let place = match line {
            Line::Mean => mean(axis, run),
            Line::Middle => middle(axis, run),
        };
        (start..start + count).for_each(|k| lines[at(k)] = place);
        start += count;
    }
    let corner = |i: usize| {
        let p = axes[i].onto(from[i], lines[i]);
        axes[before(i)].onto(p, lines[before(i)])
    };
    Some((0..n).map(corner).collect())
}

fn mean(axis: Axis, walls: impl Iterator<Item = (DVec2, DVec2)>) -> f64 {
    let (mut sum, mut whole) = (0.0, 0.0);
    for (p, q) in walls {
        let length = p.distance(q);
        sum += axis.across(p.midpoint(q)) * length;
        whole += length;
    }
    sum / whole
}

fn middle(axis: Axis, walls: impl Iterator<Item = (DVec2, DVec2)>) -> f64 {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for c in walls.flat_map(|(p, q)| [axis.across(p), axis.across(q)]) {
        (low, high) = (low.min(c), high.max(c));
    }
    f64::midpoint(low, high)
}

/// Removes corners at which a ring of right angles goes straight on, or back on itself.
pub(super) fn straighten(ring: &mut Ring) {
    let is_needless = |[last, here, next]: [Side; 3], _| {
        let (to, from) = (here.from - last.from, next.from - here.from);
        let runs_on = last.mark == here.mark && to.dot(from) > 0.0;
        let nothing = to == DVec2::ZERO || from == DVec2::ZERO;
        to.perp_dot(from) == 0.0 && (nothing || runs_on || to.dot(from) < 0.0)
    };
    while drop_where(ring, is_needless) > 0 && ring.len() > 2 {}
}

/// Returns the corner of a ring that moves farthest when the ring becomes another one, and how far. A corner that is gone
/// moves to the nearest side.
fn farthest(ring: &[Side], made: &[Side]) -> (usize, f64) {
    let mut kept = made.iter().map(|side| (side.corner, side.from));
    let mut kept_next = kept.next();
    let mut far = (0, 0.0);
    for (n, side) in ring.iter().enumerate() {
        let moved = match kept_next {
            Some((corner, place)) if corner == side.corner => {
                kept_next = kept.next();
                place.distance(side.from)
            }
            _ => {
                let sides = (0..made.len()).map(|s| ends(made, s));
                let to_sides = sides.map(|(a, b)| to_side(side.from, a, b));
                to_sides.fold(f64::INFINITY, f64::min)
            }
        };
        if moved > far.1 {
            far = (n, moved);
        }
    }
    far
}

fn to_side(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let share = ((p - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    (a + along * share).distance(p)
}
