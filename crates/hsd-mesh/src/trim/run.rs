//! Rows of equal bodies: cover tiles, discs, cap tiles, rafters. Each shape is made once, in meshes of a few side by
//! side, and instanced by nodes.

use crate::trim::body::Body;
use glam::{DVec2, DVec3};
use hsd_ir::building::Corners;
use hsd_ir::material::SurfaceId;
use std::collections::HashMap;
use std::sync::Arc;

/// Tolerance within which shapes are equal, metres.
const ALIKE: f64 = 1e-5;
/// Resolution of the spacing of a row, metres.
const FINE: f64 = 1e-6;
/// Fewer equal bodies stay with their roof, since a mesh and its nodes would be larger.
const LEAST: usize = 4;
/// Number of bodies in a mesh of a long row, and the most that share one mesh without being in a row.
const CHUNK: usize = 8;
const SHORT: usize = 12;

/// A body in its own frame: x to the right, y up the slope, origin at its first corner.
#[derive(Debug, PartialEq, Eq, Hash)]
pub(crate) struct Shape {
    finish: SurfaceId,
    soft: bool,
    round: u32,
    lofted: usize,
    sides: usize,
    /// Hundredths of a millimetre.
    points: Vec<[i32; 3]>,
    faces: Vec<Corners>,
}

/// The key of a run's mesh.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Row {
    /// Its name.
    pub(crate) name: &'static str,
    shape: Arc<Shape>,
    /// Offset from one to the next in their frame, thousandths of a millimetre.
    step: [i32; 3],
    count: u32,
}

/// Equal bodies side by side.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    /// Origin of the first one, metres.
    pub(crate) at: DVec3,
    /// Direction to the right, unit length.
    pub(crate) right: DVec2,
    pub(crate) row: Row,
}

impl Shape {
    fn of(body: &Body, right: DVec2) -> Shape {
        let place = |p: &DVec3| local(*p - body.points[0], right, ALIKE);
        Shape {
            finish: body.finish,
            soft: body.soft,
            round: body.round,
            lofted: body.lofted,
            sides: body.sides,
            points: body.points.iter().map(place).collect(),
            faces: body.faces.clone(),
        }
    }
}

impl Row {
    /// Returns its bodies in the frame of the first.
    pub(crate) fn bodies(&self) -> impl Iterator<Item = Body> + '_ {
        let shape = &*self.shape;
        (0..self.count).map(|i| {
            let moved = metres(self.step, FINE) * f64::from(i);
            let points = shape.points.iter();
            Body {
                finish: shape.finish,
                soft: shape.soft,
                points: points.map(|p| metres(*p, ALIKE) + moved).collect(),
                faces: shape.faces.clone(),
                round: shape.round,
                lofted: shape.lofted,
                sides: shape.sides,
                row: None,
            }
        })
    }
}

/// Removes from the bodies those that form rows of equal shapes, and returns the rows.
pub(super) fn take(bodies: &mut Vec<Body>) -> Vec<Run> {
    // The map is never walked, so that its order cannot matter.
    let mut known: HashMap<(Shape, [u64; 2]), usize> = HashMap::new();
    let mut groups: Vec<Vec<usize>> = vec![];
    for (i, body) in bodies.iter().enumerate() {
        let Some((_, right)) = body.row else {
            continue;
        };
        let key = (Shape::of(body, right), right.to_array().map(f64::to_bits));
        let group = *known.entry(key).or_insert(groups.len());
        match groups.get_mut(group) {
            Some(group) => group.push(i),
            None => groups.push(vec![i]),
        }
    }
    let mut runs = vec![];
    let mut taken = vec![false; bodies.len()];
    for group in groups.iter().filter(|g| g.len() >= LEAST) {
        group.iter().for_each(|i| taken[*i] = true);
        let Some((name, right)) = bodies[group[0]].row else {
            continue;
        };
        let shape = Arc::new(Shape::of(&bodies[group[0]], right));
        let places: Vec<DVec3> = group.iter().map(|i| bodies[*i].points[0]).collect();
        rows(&places, right, |at, step, count| {
            let row = Row {
                name,
                shape: shape.clone(),
                step,
                count: count as u32,
            };
            runs.push(Run { at, right, row });
        });
    }
    let mut taken = taken.iter();
    bodies.retain(|_| taken.next() != Some(&true));
    runs
}

/// Splits positions into rows of constant spacing, long ones into pieces that are mostly equal.
fn rows(places: &[DVec3], right: DVec2, mut made: impl FnMut(DVec3, [i32; 3], usize)) {
    let mut from = 0;
    while from < places.len() {
        let first = places[from];
        let step = |i: usize| places[i] - places[i - 1];
        let mut to = from + 1;
        while to < places.len() && (step(to) - step(from + 1)).length() < ALIKE {
            to += 1;
        }
        let way = match to - from {
            1 => [0; 3],
            _ => local(
                (places[to - 1] - first) / (to - from - 1) as f64,
                right,
                FINE,
            ),
        };
        let mut at = from;
        while at < to {
            let left = to - at;
            let count = if left > SHORT { CHUNK } else { left };
            // One alone has no step, whatever it stood beside.
            made(places[at], if count > 1 { way } else { [0; 3] }, count);
            at += count;
        }
        from = to;
    }
}

/// Returns a vector in a frame, in units.
fn local(way: DVec3, right: DVec2, unit: f64) -> [i32; 3] {
    let plan = way.truncate();
    let own = [right.dot(plan), right.perp_dot(plan), way.z];
    own.map(|x| (x / unit).round() as i32)
}

fn metres(units: [i32; 3], unit: f64) -> DVec3 {
    DVec3::from(units.map(|n| f64::from(n) * unit))
}
