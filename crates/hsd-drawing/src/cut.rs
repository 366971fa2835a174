//! The exact cut of bodies with a plane.

use crate::look::Look;
use crate::paper::{Mark, Role, Shape};
use crate::subject::{Body, Subject};
use glam::DVec2;
use std::collections::HashMap;

/// Corners of a cut that turn by less than this are left out: twice the area of the triangle that they form, mm2.
const STRAIGHT: f64 = 1e-6;

/// The edge of a body that the plane passes through: its lower corner, then the higher one.
type Crossing = (u32, u32);

/// Returns the areas and lines in which a look cuts bodies, those of one role together.
pub(super) fn cut(subject: &Subject<'_>, look: &Look) -> Vec<Mark> {
    let mut marks: Vec<Mark> = vec![];
    for body in &subject.bodies {
        let (rings, open) = rings(body, look);
        let mut add = |shape| {
            marks.push(Mark {
                role: body.role,
                code: body.code.clone(),
                facts: None,
                shape,
            });
        };
        if !rings.is_empty() {
            add(Shape::Area(rings));
        }
        if !open.is_empty() {
            add(Shape::Lines(open));
        }
    }
    marks.sort_by_key(|m| order(m.role));
    marks
}

/// What is drawn over what else.
fn order(role: Role) -> usize {
    Role::ALL
        .iter()
        .position(|r| *r == role)
        .unwrap_or_default()
}

/// Returns the rings in which the plane of a look cuts a body, the body to the left of each, and the lines in which
/// it cuts sheets without thickness. A corner in the plane counts as behind it.
fn rings(body: &Body, look: &Look) -> (Vec<Vec<DVec2>>, Vec<[DVec2; 2]>) {
    let depths: Vec<f64> = body
        .points
        .iter()
        .map(|p| look.depth(*p) - look.cut)
        .collect();
    let mut next: HashMap<Crossing, Vec<Crossing>> = HashMap::new();
    let mut starts: Vec<Crossing> = vec![];
    for t in &body.triangles {
        let near = t.map(|c| depths[c as usize] < 0.0);
        let crossing = |k: usize, side: bool| {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            (near[k] == side && near[(k + 1) % 3] != side).then_some((a.min(b), a.max(b)))
        };
        let find = |side| (0..3).find_map(|k| crossing(k, side));
        // Seen along the way of looking, the body lies to the left of the line from where its border leaves to where it comes.
        if let (Some(from), Some(to)) = (find(true), find(false)) {
            next.entry(from).or_default().push(to);
            starts.push(from);
        }
    }
    let place = |(a, b): Crossing| {
        let (da, db) = (depths[a as usize], depths[b as usize]);
        let [p, q] = [a, b].map(|c| body.points[c as usize]);
        look.paper(p.lerp(q, da / (da - db)))
    };
    let (mut closed, mut open) = (vec![], vec![]);
    for start in starts {
        let mut ring = vec![];
        let mut at = start;
        while let Some(to) = next.get_mut(&at).and_then(Vec::pop) {
            ring.push(at);
            at = to;
        }
        if ring.is_empty() {
            continue;
        }
        let mut points: Vec<DVec2> = ring.iter().map(|c| place(*c)).collect();
        if at == start {
            simplify(&mut points);
            if points.len() > 2 {
                closed.push(points);
            }
        } else {
            points.push(place(at));
            open.extend(points.windows(2).map(|w| [w[0], w[1]]));
        }
    }
    (closed, open)
}

/// Leaves out corners at which a ring does not turn.
fn simplify(ring: &mut Vec<DVec2>) {
    let mut k = 0;
    while ring.len() > 2 && k < ring.len() {
        let n = ring.len();
        let (before, at, after) = (ring[(k + n - 1) % n], ring[k], ring[(k + 1) % n]);
        if (at - before).perp_dot(after - at).abs() < STRAIGHT
            && (at - before).dot(after - at) >= 0.0
            || at.distance_squared(before) < STRAIGHT * STRAIGHT
        {
            ring.remove(k);
            k = k.saturating_sub(1);
        } else {
            k += 1;
        }
    }
}

/// Returns the area that rings enclose, signed: positive if it lies to their left.
pub(super) fn area(rings: &[Vec<DVec2>]) -> f64 {
    let one = |ring: &Vec<DVec2>| -> f64 {
        let next = ring.iter().cycle().skip(1);
        ring.iter().zip(next).map(|(p, q)| p.perp_dot(*q)).sum()
    };
    rings.iter().map(one).sum::<f64>() / 2.0
}
