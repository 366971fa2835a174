//! Onigawara: the tile that closes a ridge or hip, 0.05 to 0.15 m higher than it (docs/evidence.md 4.4). A shield with
//! a brow and feet that curl out, with a boss in front; on cover-tile roofs, a round bar (toribusuma) points upwards.

use crate::trim::body::Body;
use glam::DVec3;
use hsd_ir::material::SurfaceId;

/// The outline of the right half from the foot up, as shares of half width and height.
const OUTLINE: [(f64, f64); 9] = [
    (1.12, 0.10),
    (1.30, 0.16),
    (1.26, 0.30),
    (1.02, 0.34),
    (0.92, 0.52),
    (1.06, 0.70),
    (0.92, 0.84),
    (0.62, 0.86),
    (0.40, 1.00),
];

/// The boss in front of it, in the same units.
const BOSS: [(f64, f64); 4] = [(0.50, 0.26), (0.62, 0.46), (0.50, 0.66), (0.22, 0.76)];

/// The position and size of an end tile.
#[derive(Clone, Copy, Debug)]
pub(in crate::trim) struct Place {
    /// The end of the ridge line on the upper surface.
    pub(in crate::trim) at: DVec3,
    /// The direction it faces; its vertical component is ignored.
    pub(in crate::trim) out: DVec3,
    /// Half the width of the ridge, metres.
    pub(in crate::trim) half: f64,
    /// Height of the ridge above its line, metres.
    pub(in crate::trim) height: f64,
    /// How far it extends below the line per metre beside it.
    pub(in crate::trim) lean: f64,
}

/// Builds a plain block, for viewing from afar.
pub(in crate::trim) fn block(finish: SurfaceId, place: &Place, bodies: &mut Vec<Body>) {
    let (half, top) = (place.half + 0.05, place.height + 0.08);
    let foot = 0.02 + place.lean * half;
    let profile = [
        (-half, -foot),
        (half, -foot),
        (half, top - half * 0.6),
        (half * 0.5, top),
        (-half * 0.5, top),
        (-half, top - half * 0.6),
    ];
    bodies.extend(shield(finish, place, &profile, -0.06, 0.10));
}

/// Builds the tile with its silhouette.
pub(in crate::trim) fn tile(finish: SurfaceId, place: &Place, bar: bool, bodies: &mut Vec<Body>) {
    let half = place.half + 0.02;
    let rise = place.height + (0.06 + 0.12 * place.height).min(0.15);
    let foot = 0.02 + place.lean * half;
    let corner = |side: f64, (w, h): &(f64, f64)| (side * w * half, h * (rise + foot) - foot);
    let mirrored = |half_of: &[(f64, f64)]| -> Vec<(f64, f64)> {
        let right = half_of.iter().map(|c| corner(1.0, c));
        let left = half_of.iter().rev().map(|c| corner(-1.0, c));
        right.chain(left).collect()
    };
    let mut outline = vec![(-half * 0.9, -foot), (half * 0.9, -foot)];
    outline.extend(mirrored(&OUTLINE));
    bodies.extend(shield(finish, place, &outline, -0.05, 0.09));
    bodies.extend(shield(finish, place, &mirrored(&BOSS), 0.03, 0.05));
    if bar {
        bodies.extend(toribusuma(finish, place, rise));
    }
}

/// Builds a vertical plate, `thick` metres outwards from `back`.
fn shield(
    finish: SurfaceId,
    place: &Place,
    profile: &[(f64, f64)],
    back: f64,
    thick: f64,
) -> Option<Body> {
    let out = place.out.truncate().normalize_or_zero().extend(0.0);
    let across = out.truncate().perp().extend(0.0);
    let foot = place.at + out * back;
    let corner = |(w, z): &(f64, f64)| foot + across * *w + DVec3::Z * *z;
    let body = Body::sweep(finish, profile.iter().map(corner).collect(), out * thick);
    body.map(Body::smooth)
}

/// Builds the round bar over it, rising outwards.
fn toribusuma(finish: SurfaceId, place: &Place, rise: f64) -> Option<Body> {
    let out = place.out.truncate().normalize_or_zero().extend(0.0);
    let across = out.truncate().perp().extend(0.0);
    let radius = (0.45 * place.half).clamp(0.03, 0.12);
    let ring = |along: f64, up: f64, radius: f64| -> Vec<DVec3> {
        let middle = place.at + out * along + DVec3::Z * (rise - 0.3 * radius + up);
        let corner = |i: u32| {
            let angle = std::f64::consts::TAU * f64::from(i) / 8.0;
            middle + across * (radius * libm::cos(angle)) + DVec3::Z * (radius * libm::sin(angle))
        };
        (0..8).map(corner).collect()
    };
    let rings = [
        ring(-0.15, 0.0, radius),
        ring(0.12, 0.02, radius),
        ring(0.12 + 2.0 * radius, 0.02 + radius, 1.15 * radius),
    ];
    Body::loft(finish, &rings).map(Body::smooth)
}
