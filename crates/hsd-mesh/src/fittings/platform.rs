//! Platforms of cut stone (壇上積 danjō-zumi): a ground course, panels between short posts and a projecting edge course;
//! stairs between cheeks.

use super::block;
use crate::mesh::{Axis, Bodies};
use glam::{DVec2, dvec2};
use hsd_ir::building::fittings::{Platform, Plinth, Stairs};
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;

/// How far courses project beyond the panels, metres.
const OUT: f64 = 0.06;

/// Approximate width of a panel, metres.
const PANEL: f64 = 1.5;

/// How far stairs extend into the platform they lead to, metres.
const INTO: f64 = 0.1;

/// How far foundations extend into the ground, metres.
const SUNK: f64 = 0.15;

pub(super) fn bodies(it: &Platform, detail: Detail) -> Bodies {
    let mut bodies = Bodies::default();
    let stone = SurfaceId::named("stone");
    let (foot, top) = it.z;
    let height = top - foot;
    if height < 0.02 {
        return bodies;
    }
    let edge = (height * 0.2).clamp(0.05, 0.3);
    let base = (height * 0.14).clamp(0.03, 0.25);
    bodies.prism(
        stone,
        &grown(&it.outline, -OUT),
        Axis::Z,
        foot + base,
        top - edge,
    );
    bodies.prism(stone, &it.outline, Axis::Z, top - edge, top);
    bodies.prism(stone, &it.outline, Axis::Z, foot - SUNK, foot + base);
    if detail > Detail::Flat {
        posts(&mut bodies, it, (foot + base, top - edge));
    }
    for stairs in &it.stairs {
        flight(&mut bodies, stairs, stone, detail);
    }
    bodies
}

/// Returns the body of a plinth, flush with what it carries.
pub(super) fn plinth(it: &Plinth) -> Bodies {
    let mut bodies = Bodies::default();
    let stone = SurfaceId::named("stone");
    for outline in &it.outlines {
        bodies.prism(stone, outline, Axis::Z, it.z.0, it.z.1);
    }
    bodies
}

/// Offsets a convex or right-angled outline outwards.
fn grown(points: &[DVec2], by: f64) -> Vec<DVec2> {
    let n = points.len();
    let edge = |i: usize| (points[(i + 1) % n] - points[i % n]).normalize_or_zero();
    let corner = |i: usize| {
        let (before, after) = (edge(i + n - 1), edge(i));
        let bend = 1.0 + before.dot(after);
        let out = |way: DVec2| dvec2(way.y, -way.x);
        points[i] + (out(before) + out(after)) * (by / bend.max(0.2))
    };
    (0..n).map(corner).collect()
}

/// Adds the short posts between the panels.
fn posts(bodies: &mut Bodies, it: &Platform, z: (f64, f64)) {
    let n = it.outline.len();
    for i in 0..n {
        let (p, q) = (it.outline[i], it.outline[(i + 1) % n]);
        let length = p.distance(q);
        let (along, count) = (
            (q - p).normalize_or_zero(),
            (length / PANEL).round().min(200.0),
        );
        let out = dvec2(along.y, -along.x);
        for k in 1..count as u32 {
            let at = p + along * (length * f64::from(k) / count) - out * OUT;
            block(
                bodies,
                SurfaceId::named("stone"),
                (at, out),
                (-0.04, OUT * 0.7),
                0.3,
                z,
            );
        }
    }
}

/// Adds steps and their cheeks.
pub(super) fn flight(bodies: &mut Bodies, it: &Stairs, finish: SurfaceId, detail: Detail) {
    let (count, tread, run) = (it.risers(), Stairs::TREAD, it.run());
    let riser = (it.z.1 - it.z.0) / f64::from(count);
    let side = dvec2(-it.out.y, it.out.x);
    let at = |u: f64, out: f64, z: f64| (it.at + side * u + it.out * out).extend(z);
    let cheek = (it.width * 0.08).clamp(0.08, 0.45);
    let half = it.width / 2.0 - if count < 3 { 0.0 } else { cheek };
    let low = it.z.0 - SUNK;
    // The highest step lies a riser below the top; all reach a little into what they lead up to.
    let mut profile = vec![at(-half, -INTO, low), at(-half, run - tread, low)];
    for k in (1..count).rev() {
        let (out, z) = (tread * f64::from(k), it.z.1 - riser * f64::from(k));
        let back = if k == 1 { -INTO } else { out - tread };
        profile.extend([at(-half, out, z), at(-half, back, z)]);
    }
    let way = (side * (2.0 * half)).extend(0.0);
    if count > 1 && half > 0.05 {
        bodies.slide(finish, &profile, way, false);
    }
    if detail == Detail::Body || count < 3 {
        return;
    }
    for end in [-it.width / 2.0, it.width / 2.0 - cheek] {
        let ring = [
            at(end, -INTO, low),
            at(end, run, low),
            at(end, run, it.z.0 + 0.1),
            at(end, tread * 0.2, it.z.1 + 0.02),
            at(end, -INTO, it.z.1 + 0.02),
        ];
        bodies.slide(finish, &ring, (side * cheek).extend(0.0), false);
    }
}
