//! Ground beside a house: a thin slab of gravel, sand, moss, grass or earth, or paving of stones in courses (敷石
//! shiki-ishi).

use crate::mesh::{Axis, Bodies};
use glam::{DVec2, dvec2};
use hsd_ir::ast::GroundSurface;
use hsd_ir::building::fittings::Ground;
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;

/// Length and depth of a paving stone, metres: 3 by 1.5 shaku.
const STONE: DVec2 = dvec2(0.909, 0.4545);

/// The joint between paving stones, metres.
const JOINT: f64 = 0.014;

/// How far the bed lies below the stones, metres.
const BED: f64 = 0.007;

/// The most courses, and the most stones in one; larger paving has larger stones.
const MOST: f64 = 24.0;

/// Stones narrower than this are joined to their neighbour, metres.
const LEAST: f64 = 0.1;

pub(super) fn bodies(it: &Ground, detail: Detail) -> Bodies {
    let mut bodies = Bodies::default();
    let stones = it.surface == GroundSurface::Paving && detail > Detail::Flat;
    let half = it.size / 2.0;
    let whole = [-half, half];
    if !stones {
        slab(&mut bodies, it, surface(it.surface), whole, it.thick);
        return bodies;
    }
    slab(&mut bodies, it, "earth", whole, it.thick - BED);
    let courses = (it.size.y / STONE.y).round().clamp(1.0, MOST);
    let deep = it.size.y / courses;
    let count = (it.size.x / STONE.x).round().clamp(1.0, MOST);
    let wide = it.size.x / count;
    for course in 0..courses as u32 {
        let (y0, y1) = (f64::from(course) * deep, f64::from(course + 1) * deep);
        // Every other course begins with half a stone.
        let shift = if course % 2 == 1 && count > 1.0 {
            0.5
        } else {
            0.0
        };
        let ends = (0..=count as u32 + 1).map(|k| (f64::from(k) - shift) * wide);
        let ends: Vec<f64> = ends.map(|x| x.clamp(0.0, it.size.x)).collect();
        for end in ends.windows(2).filter(|end| end[1] - end[0] > LEAST) {
            let joint = DVec2::splat(JOINT / 2.0);
            let (lo, hi) = (dvec2(end[0], y0) + joint, dvec2(end[1], y1) - joint);
            slab(&mut bodies, it, "stone", [lo - half, hi - half], it.thick);
        }
    }
    bodies
}

/// Adds a slab between two corners in the frame of the ground.
fn slab(bodies: &mut Bodies, it: &Ground, name: &'static str, [lo, hi]: [DVec2; 2], top: f64) {
    let corners = [lo, dvec2(hi.x, lo.y), hi, dvec2(lo.x, hi.y)];
    let outline = corners.map(|p| it.at.truncate() + it.along.rotate(p));
    let finish = SurfaceId::named(name);
    bodies.prism(finish, &outline, Axis::Z, it.at.z, it.at.z + top);
}

/// Returns the name of the look of a surface.
fn surface(of: GroundSurface) -> &'static str {
    match of {
        GroundSurface::Gravel => "gravel",
        GroundSurface::Sand => "sand",
        GroundSurface::Moss => "moss",
        GroundSurface::Grass => "foliage",
        GroundSurface::Paving => "stone",
        GroundSurface::Earth => "earth",
    }
}
