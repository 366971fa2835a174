//! Shrine ridges: crossed boards (千木 chigi) at the ends, logs (鰹木 katsuogi) across the ridge between them.

use crate::mesh::Bodies;
use crate::mesh::lathe::sides;
use glam::{DVec2, DVec3};
use hsd_ir::building::fittings::Finial;
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;
use std::f64::consts::TAU;

/// Slope of the crossed boards, rise over run.
const SLOPE: f64 = 1.15;

pub(super) fn chigi(bodies: &mut Bodies, it: &Finial, detail: Detail) {
    let wood = SurfaceId::named("hinoki");
    let [p, q] = it.ridge;
    let way = (q - p).truncate();
    let length = way.length();
    let Some(along) = way.try_normalize() else {
        return;
    };
    let across = DVec2::new(-along.y, along.x);
    let h = it.height;
    let (wide, thick) = (h * 0.16, h * 0.075);
    // Logs lie in the ridge a little.
    let low = p.z.min(q.z);
    let top = low + h * 0.015;
    let inset = (h * 0.18).min(length * 0.2);
    for (end, sign) in [(p, 1.0), (q, -1.0)] {
        for lean in [-1.0, 1.0] {
            // The two boards lie side by side, and cross over the ridge.
            let by = along * (sign * inset + lean * thick / 2.0 - thick / 2.0);
            let foot = (end.truncate() + by).extend(low);
            let at = |up: f64, off: f64| {
                let run = up / SLOPE * lean;
                foot + (across * (run + off * lean)).extend(up + h * 0.08)
            };
            let ring = [
                at(-h * 0.35, 0.0),
                at(-h * 0.35, wide),
                at(h * 0.92, wide),
                at(h * 0.92, 0.0),
            ];
            bodies.slide(wood, &ring, (along * thick).extend(0.0), false);
        }
    }
    let n = sides(detail);
    let r = h * 0.1;
    // Clear of the crossed boards, which are two thick.
    let clear = inset + thick + 1.6 * r + r;
    let (first, last) = (clear, length - clear);
    for k in 0..it.count {
        let share = match it.count {
            1 => 0.5,
            count => f64::from(k) / f64::from(count - 1),
        };
        let at = p.truncate() + along * (first + (last - first) * share);
        let half = h * 0.46;
        log(bodies, (at.extend(top + r * 0.7), across, half), r, n);
    }
}

/// Adds a log that tapers towards its ends.
fn log(bodies: &mut Bodies, (at, way, half): (DVec3, DVec2, f64), r: f64, n: usize) {
    let wood = SurfaceId::named("hinoki");
    let side = DVec2::new(-way.y, way.x);
    let rings = [(-1.0, 0.72), (-0.35, 1.0), (0.35, 1.0), (1.0, 0.72)];
    let point = |(u, share): (f64, f64), k: usize| {
        let angle = TAU * (k % n) as f64 / n as f64;
        let flat = way * (u * half) + side * (r * share * libm::cos(angle));
        at + flat.extend(r * share * libm::sin(angle))
    };
    let normal = |k: usize| {
        let angle = TAU * (k % n) as f64 / n as f64;
        (side * libm::cos(angle)).extend(libm::sin(angle))
    };
    for pair in rings.windows(2) {
        for k in 0..n {
            let corners = [
                point(pair[0], k),
                point(pair[0], k + 1),
                point(pair[1], k + 1),
                point(pair[1], k),
            ];
            let normals = [normal(k), normal(k + 1), normal(k + 1), normal(k)];
            bodies.shaded(wood, &corners, &normals);
        }
    }
    let end: Vec<DVec3> = (0..n).rev().map(|k| point(rings[0], k)).collect();
    bodies.face(wood, &end);
    let end: Vec<DVec3> = (0..n).map(|k| point(rings[3], k)).collect();
    bodies.face(wood, &end);
}
