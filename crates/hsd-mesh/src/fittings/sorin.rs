//! Pagoda masts (相輪 sōrin): dew basin, inverted bowl, flower, nine rings, water-flame, dragon ball, jewel. Proportions
//! of the height after Horyu-ji.

use super::block;
use crate::mesh::Bodies;
use crate::mesh::lathe::{sides, turned};
use glam::{DVec2, DVec3};
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;
use std::f64::consts::FRAC_PI_2;

/// Number of rings on the mast.
const RINGS: u32 = 9;

/// Profile of bowl, flower and mast: (radius, height).
const BOWL: [(f64, f64); 13] = [
    (0.0, 0.068),
    (0.055, 0.068),
    (0.056, 0.085),
    (0.050, 0.103),
    (0.034, 0.118),
    (0.020, 0.124),
    (0.030, 0.136),
    (0.056, 0.150),
    (0.052, 0.155),
    (0.022, 0.158),
    (0.011, 0.165),
    (0.011, 0.985),
    (0.0, 0.985),
];

pub(super) fn sorin(bodies: &mut Bodies, at: DVec3, h: f64, detail: Detail) {
    let bronze = SurfaceId::named("bronze");
    let n = sides(detail);
    let foot = at - DVec3::Z * (h * 0.03);
    let h = h * 1.03;
    let plan = (foot.truncate(), DVec2::X);
    let z = |share: f64| foot.z + h * share;
    block(
        bodies,
        bronze,
        plan,
        (-0.065 * h, 0.065 * h),
        0.13 * h,
        (z(0.0), z(0.055)),
    );
    block(
        bodies,
        bronze,
        plan,
        (-0.075 * h, 0.075 * h),
        0.15 * h,
        (z(0.055), z(0.068)),
    );
    let scaled = |profile: &[(f64, f64)]| -> Vec<(f64, f64)> {
        profile.iter().map(|(r, t)| (r * h, t * h)).collect()
    };
    turned(bodies, bronze, foot, &scaled(&BOWL), n);
    if detail > Detail::Body {
        for k in 0..RINGS {
            let share = f64::from(k) / f64::from(RINGS - 1);
            let (r, t) = (0.068 - 0.024 * share, 0.195 + 0.455 * share);
            ring(bodies, foot, (r * h, t * h, 0.011 * h), detail);
        }
    }
    flame(bodies, foot, h, detail);
    let ball = |low: f64, r: f64, tip: f64| {
        [
            (0.0, low),
            (r * 0.6, low + r * 0.25),
            (r, low + r),
            (r * 0.75, low + r * 1.65),
            (r * 0.25, low + r * 2.0 + tip * 0.4),
            (0.0, low + r * 2.0 + tip),
        ]
    };
    turned(bodies, bronze, foot, &scaled(&ball(0.885, 0.016, 0.0)), n);
    turned(bodies, bronze, foot, &scaled(&ball(0.935, 0.020, 0.025)), n);
}

/// Adds a flat ring with four spokes.
fn ring(bodies: &mut Bodies, foot: DVec3, (r, t, thick): (f64, f64, f64), detail: Detail) {
    let bronze = SurfaceId::named("bronze");
    let profile = [(r * 0.74, t), (r, t), (r, t + thick), (r * 0.74, t + thick)];
    turned(bodies, bronze, foot, &profile, sides(detail));
    if detail < Detail::Openings {
        return;
    }
    for k in 0..4 {
        let angle = FRAC_PI_2 * f64::from(k);
        let out = DVec2::new(libm::cos(angle), libm::sin(angle));
        let z = (foot.z + t + thick * 0.2, foot.z + t + thick * 0.8);
        block(
            bodies,
            bronze,
            (foot.truncate(), out),
            (0.0, r * 0.8),
            thick,
            z,
        );
    }
}

/// Adds the water-flame (水煙 suien): four vertical blades.
fn flame(bodies: &mut Bodies, foot: DVec3, h: f64, detail: Detail) {
    let outline = [
        (0.006, 0.70),
        (0.040, 0.715),
        (0.062, 0.745),
        (0.048, 0.755),
        (0.066, 0.785),
        (0.046, 0.795),
        (0.054, 0.825),
        (0.034, 0.832),
        (0.036, 0.862),
        (0.006, 0.885),
    ];
    let blades = if detail == Detail::Body { 2 } else { 4 };
    for k in 0..blades {
        let angle = FRAC_PI_2 * f64::from(k);
        let out = DVec2::new(libm::cos(angle), libm::sin(angle));
        let side = DVec2::new(-out.y, out.x) * (0.002 * h);
        let ring: Vec<DVec3> = outline
            .map(|(r, t)| foot + (out * (r * h) - side).extend(t * h))
            .to_vec();
        bodies.slide(
            SurfaceId::named("bronze"),
            &ring,
            (side * 2.0).extend(0.0),
            false,
        );
    }
}
