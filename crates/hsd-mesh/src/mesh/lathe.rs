//! Bodies of revolution around a vertical axis.

use crate::mesh::Bodies;
use glam::{DVec2, DVec3, dvec2};
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;
use std::f64::consts::TAU;

/// Radii smaller than this count as zero, metres.
const AXIS: f64 = 1e-4;

/// Number of sides of round bodies at a detail.
pub(crate) fn sides(detail: Detail) -> usize {
    match detail {
        Detail::Body => 6,
        Detail::Flat => 8,
        Detail::Openings => 12,
        Detail::Everything => 20,
    }
}

/// Revolves a profile of (radius, height) around the vertical axis through `at`. The profile runs upwards along the
/// outside, from axis to axis, or back to its start if it bounds a ring. Neighbouring faces at a small angle share
/// their normals.
pub(crate) fn turned(
    bodies: &mut Bodies,
    finish: SurfaceId,
    at: DVec3,
    profile: &[(f64, f64)],
    sides: usize,
) {
    revolved(bodies, finish, at, profile, (sides, 0.0, true));
}

/// As [`turned`], with the angle of its first corner, and flat sides unless it is `soft`.
pub(crate) fn revolved(
    bodies: &mut Bodies,
    finish: SurfaceId,
    at: DVec3,
    profile: &[(f64, f64)],
    (sides, turn, soft): (usize, f64, bool),
) {
    let n = profile.len();
    let ring = profile[0].0 > AXIS;
    let steps = if ring { n } else { n - 1 };
    let point = |i: usize| dvec2(profile[i % n].0, profile[i % n].1);
    let normal = |i: usize| {
        let way = point(i + 1) - point(i);
        dvec2(way.y, -way.x).normalize_or_zero()
    };
    let shade = |own: DVec2, other: Option<DVec2>| match other {
        Some(o) if own.dot(o) > 0.6 => (own + o).normalize_or_zero(),
        _ => own,
    };
    for i in 0..steps {
        let own = normal(i);
        let before = (ring || i > 0).then(|| normal((i + n - 1) % n));
        let after = (ring || i + 1 < steps).then(|| normal((i + 1) % n));
        let normals = [shade(own, before), shade(own, after)];
        let ends = [point(i), point(i + 1)];
        for k in 0..sides {
            let ways = [k, k + 1].map(|k| {
                let angle = turn + TAU * (k % sides) as f64 / sides as f64;
                dvec2(libm::cos(angle), libm::sin(angle))
            });
            let (corners, shades) = quad(at, ends, normals, ways);
            match corners.len() > 2 {
                true if soft => bodies.shaded(finish, &corners, &shades),
                true => bodies.face(finish, &corners),
                false => {}
            }
        }
    }
}

/// Returns the corners and normals of one face, between two corners of the profile and two directions in plan. On the
/// axis both corners are one.
fn quad(
    at: DVec3,
    [lower, upper]: [DVec2; 2],
    [low, high]: [DVec2; 2],
    [a, b]: [DVec2; 2],
) -> (Vec<DVec3>, Vec<DVec3>) {
    let (mut corners, mut shades): (Vec<DVec3>, Vec<DVec3>) = (vec![], vec![]);
    for (p, m, way) in [
        (lower, low, a),
        (lower, low, b),
        (upper, high, b),
        (upper, high, a),
    ] {
        let corner = at + (way * p.x).extend(p.y);
        let ends = [corners.first(), corners.last()];
        let known = |end: Option<&DVec3>| end.is_some_and(|e| e.distance(corner) < AXIS);
        if !ends.into_iter().any(known) {
            corners.push(corner);
            shades.push((way * m.x).extend(m.y));
        }
    }
    (corners, shades)
}
