//! The lines between rooms, from corner of a pixel to corner of a pixel.

use super::field::Field;
use glam::{DVec2, dvec2};
use std::collections::BTreeSet;

/// A corner of a pixel.
type Corner = (usize, usize);

/// A line between two rooms.
#[derive(Clone, Debug)]
pub struct Chain {
    /// The corners; the first and last are junctions, or the same point of a closed line.
    pub points: Vec<DVec2>,
    /// The rooms to its left and right.
    pub rooms: [u32; 2],
}

/// Steps to the right, down, to the left, up.
const STEPS: [(isize, isize); 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];

/// Traces the lines between rooms.
pub fn chains(of: &Field<u32>) -> Vec<Chain> {
    let parts = |at: Corner, step: usize| {
        let [a, b] = beside(of, at, step);
        a != b
    };
    let next = |(x, y): Corner, step: usize| {
        let (dx, dy) = STEPS[step];
        (x.wrapping_add_signed(dx), y.wrapping_add_signed(dy))
    };
    let corners = || (0..=of.height).flat_map(|y| (0..=of.width).map(move |x| (x, y)));
    let degree = |at: Corner| (0..4).filter(|s| parts(at, *s)).count();
    let mut used: BTreeSet<(Corner, usize)> = BTreeSet::new();
    let mut out = vec![];
    let mut follow = |start: Corner, first: usize, used: &mut BTreeSet<(Corner, usize)>| {
        let (mut at, mut step) = (start, first);
        let sides = beside(of, start, first);
        let mut points = vec![point(start)];
        loop {
            used.insert((at, step));
            at = next(at, step);
            used.insert((at, (step + 2) % 4));
            points.push(point(at));
            if degree(at) != 2 || at == start {
                break;
            }
            let back = (step + 2) % 4;
            let Some(on) = (0..4).find(|s| *s != back && parts(at, *s)) else {
                break;
            };
            step = on;
        }
        out.push(Chain {
            points,
            rooms: sides,
        });
    };
    for junctions in [true, false] {
        for at in corners() {
            let n = degree(at);
            if n == 0 || (n == 2) == junctions {
                continue;
            }
            for step in 0..4 {
                if parts(at, step) && !used.contains(&(at, step)) {
                    follow(at, step, &mut used);
                }
            }
        }
    }
    out
}

/// The rooms to the left and right of a step from a corner.
fn beside(of: &Field<u32>, (x, y): Corner, step: usize) -> [u32; 2] {
    let (x, y) = (x as isize, y as isize);
    let room = |x: isize, y: isize| of.get(x, y).unwrap_or(0);
    match step {
        0 => [room(x, y - 1), room(x, y)],
        1 => [room(x, y), room(x - 1, y)],
        2 => [room(x - 1, y), room(x - 1, y - 1)],
        _ => [room(x - 1, y - 1), room(x, y - 1)],
    }
}

fn point((x, y): Corner) -> DVec2 {
    dvec2(x as f64, y as f64)
}

/// Returns the points of a line that all others are near.
pub fn simplified(points: &[DVec2], tolerance: f64) -> Vec<DVec2> {
    let (first, last) = (points[0], points[points.len() - 1]);
    if first == last && points.len() > 3 {
        // A closed line has two ends that are far apart.
        let far = (0..points.len()).max_by(|a, b| {
            let of = |k: &usize| points[*k].distance_squared(first);
            of(a).total_cmp(&of(b))
        });
        let far = far.unwrap_or(0);
        let mut out = simplified(&points[..=far], tolerance);
        out.pop();
        out.extend(simplified(&points[far..], tolerance));
        return out;
    }
    let ahead = last - first;
    let away = |p: DVec2| match ahead.length_squared() > 0.0 {
        true => (ahead.perp_dot(p - first) / ahead.length()).abs(),
        false => p.distance(first),
    };
    let inner = 1..points.len() - 1;
    let far = inner.max_by(|a, b| away(points[*a]).total_cmp(&away(points[*b])));
    match far {
        Some(far) if away(points[far]) > tolerance => {
            let mut out = simplified(&points[..=far], tolerance);
            out.pop();
            out.extend(simplified(&points[far..], tolerance));
            out
        }
        _ => vec![first, last],
    }
}
