//! Finials: a jewel on a dew basin, and fish tails at the ends of a ridge. Pagoda masts and shrine ridges have modules
//! of their own.

use super::{block, shrine, sorin};
use crate::mesh::Bodies;
use crate::mesh::lathe::{sides, turned};
use glam::{DVec2, DVec3};
use hsd_ir::ast::FinialKind;
use hsd_ir::building::fittings::Finial;
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;

pub(super) fn bodies(it: &Finial, detail: Detail) -> Bodies {
    let mut bodies = Bodies::default();
    let middle = (it.ridge[0] + it.ridge[1]) / 2.0;
    match it.kind {
        FinialKind::Sorin => sorin::sorin(&mut bodies, middle, it.height, detail),
        FinialKind::Hoju => hoju(&mut bodies, middle, it.height, detail),
        FinialKind::Shibi => {
            for (end, other) in [(it.ridge[0], it.ridge[1]), (it.ridge[1], it.ridge[0])] {
                shibi(&mut bodies, end, other, it.height);
            }
        }
        FinialKind::Chigi => shrine::chigi(&mut bodies, it, detail),
    }
    bodies
}

/// Adds a square basin, a lotus and a pointed jewel.
fn hoju(bodies: &mut Bodies, at: DVec3, h: f64, detail: Detail) {
    let tile = SurfaceId::named("ibushi");
    let foot = at - DVec3::Z * (h * 0.25);
    let plan = (foot.truncate(), DVec2::X);
    let z = |share: f64| foot.z + h * share;
    block(
        bodies,
        tile,
        plan,
        (-0.42 * h, 0.42 * h),
        0.84 * h,
        (z(0.0), z(0.36)),
    );
    block(
        bodies,
        tile,
        plan,
        (-0.48 * h, 0.48 * h),
        0.96 * h,
        (z(0.36), z(0.44)),
    );
    let jewel = [
        (0.0, 0.44),
        (0.30, 0.44),
        (0.36, 0.52),
        (0.24, 0.60),
        (0.20, 0.64),
        (0.30, 0.74),
        (0.345, 0.86),
        (0.30, 0.98),
        (0.18, 1.09),
        (0.07, 1.17),
        (0.0, 1.25),
    ];
    let profile = jewel.map(|(r, t)| (r * h, t * h));
    turned(bodies, tile, foot, &profile, sides(detail));
}

/// Adds a fish tail at one end of a ridge, its fin curved inwards.
fn shibi(bodies: &mut Bodies, end: DVec3, other: DVec3, h: f64) {
    let out = (end - other).truncate().normalize_or(DVec2::X);
    let side = DVec2::new(-out.y, out.x) * (h * 0.16);
    let foot = end - DVec3::Z * (h * 0.12) - (out * (h * 0.1)).extend(0.0);
    let outline = [
        (-0.34, 0.0),
        (0.16, 0.0),
        (0.25, 0.16),
        (0.27, 0.40),
        (0.21, 0.66),
        (0.08, 0.88),
        (-0.12, 1.03),
        (-0.34, 1.12),
        (-0.31, 0.99),
        (-0.20, 0.84),
        (-0.13, 0.66),
        (-0.14, 0.46),
        (-0.22, 0.30),
        (-0.34, 0.22),
    ];
    let at = |(u, t): (f64, f64)| foot + (out * (u * h) - side).extend(t * h);
    let ring: Vec<DVec3> = outline.map(at).to_vec();
    bodies.slide(
        SurfaceId::named("ibushi"),
        &ring,
        (side * 2.0).extend(0.0),
        true,
    );
    // A rib along the back.
    let rib: Vec<DVec3> = [
        (0.20, 0.02),
        (0.31, 0.16),
        (0.33, 0.40),
        (0.27, 0.67),
        (0.12, 0.92),
        (0.20, 0.64),
        (0.24, 0.40),
        (0.22, 0.16),
    ]
    .map(|p| at(p) + (side * 0.6).extend(0.0))
    .to_vec();
    bodies.slide(
        SurfaceId::named("ibushi"),
        &rib,
        (side * 0.8).extend(0.0),
        false,
    );
}
