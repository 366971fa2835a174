//! Finials: they stand on the apex or the ridge of the finished solids.

use super::metres;
use glam::{DVec2, DVec3};
use hsd_base::geometry::SHAKU;
use hsd_ir::ast::{self, FinialKind};
use hsd_ir::building::fittings::Finial;
use hsd_ir::building::{Finish, House, HouseRoofs, Roof, Solid};

/// Points no lower than this below the highest belong to the ridge, metres, since curved ridges sag.
const LEVEL: f64 = 0.35;

/// Returns a finial on the highest roof, or on the highest over its place, with the number of that roof; `None` if
/// there is no roof.
pub(super) fn finial(
    house: &House,
    roofs: &HouseRoofs,
    written: &ast::Finial,
) -> Option<(Finial, usize)> {
    let place = written.at.map(|at| metres(house, at.value.into()));
    let roofs = roofs.roofs.iter().enumerate();
    let (highest, (number, roof)) = roofs
        .filter(|(_, roof)| place.is_none_or(|p| covers(roof, p)))
        .filter_map(|(n, roof)| Some((top(roof)?, (n, roof))))
        .reduce(|a, b| if b.0.z > a.0.z + 1e-9 { b } else { a })?;
    // Shibi and chigi stand on the ridge tiles, sōrin and jewels on the bare apex.
    let tiles = match written.kind {
        FinialKind::Shibi | FinialKind::Chigi => roof.trim.ridge_height(roof.kind) * 0.8,
        FinialKind::Sorin | FinialKind::Hoju => 0.0,
    };
    let ridge = ridge(roof, highest).map(|p| p + DVec3::Z * tiles);
    let length = ridge[0].distance(ridge[1]);
    let height = written.height.map(|h| h * SHAKU);
    let finial = Finial {
        kind: written.kind,
        ridge,
        height: height.unwrap_or_else(|| usual(written.kind, length, span(roof))),
        count: written.count.unwrap_or(odd(length / 1.3)),
    };
    Some((finial, number))
}

/// Returns true if a finial of this kind replaces the default jewel on an apex.
pub(super) fn crowns(kind: FinialKind) -> bool {
    matches!(kind, FinialKind::Sorin | FinialKind::Hoju)
}

/// Returns the points of a roof's upper surfaces.
fn covering(roof: &Roof) -> impl Iterator<Item = DVec3> {
    let upper = |solid: &Solid| {
        let faces = solid.faces.iter();
        let faces = faces.filter(|f| matches!(f.finish, Finish::Covering(_)));
        let points = faces.flat_map(|f| f.corners.iter());
        let found: Vec<DVec3> = points
            .filter_map(|i| solid.points.get(*i as usize).copied())
            .collect();
        found
    };
    roof.solids.iter().flat_map(upper)
}

fn top(roof: &Roof) -> Option<DVec3> {
    covering(roof).reduce(|a, b| if b.z > a.z + 1e-9 { b } else { a })
}

/// Returns true if a roof covers a place, by its bounds.
fn covers(roof: &Roof, p: DVec2) -> bool {
    let lo = covering(roof).fold(DVec2::INFINITY, |m, q| m.min(q.truncate()));
    let hi = covering(roof).fold(DVec2::NEG_INFINITY, |m, q| m.max(q.truncate()));
    lo.cmple(p).all() && p.cmple(hi).all()
}

/// Returns the ends of the ridge: the two highest points that are farthest apart.
fn ridge(roof: &Roof, highest: DVec3) -> [DVec3; 2] {
    let level: Vec<DVec3> = covering(roof).filter(|p| p.z > highest.z - LEVEL).collect();
    let far = |from: DVec3, by: &dyn Fn(DVec3) -> f64| {
        level
            .iter()
            .copied()
            .reduce(|a, b| if by(b) > by(a) + 1e-9 { b } else { a })
            .unwrap_or(from)
    };
    // Only points as high as the top across the ridge: a sagging ridge is narrow.
    let first = far(highest, &|p| {
        p.distance(highest) - 4.0 * (highest.z - p.z).max(0.0)
    });
    let second = far(first, &|p| {
        p.distance(first) - 4.0 * (highest.z - p.z).max(0.0)
    });
    [first, second]
}

/// Returns the shorter side of a roof, metres.
fn span(roof: &Roof) -> f64 {
    let lo = covering(roof).fold(DVec2::INFINITY, |m, q| m.min(q.truncate()));
    let hi = covering(roof).fold(DVec2::NEG_INFINITY, |m, q| m.max(q.truncate()));
    (hi - lo).min_element()
}

/// Returns the default height of a finial, metres: for a sorin 0.3 of a pagoda of usual height, for the others by the
/// size of their roof.
fn usual(kind: FinialKind, ridge: f64, span: f64) -> f64 {
    match kind {
        FinialKind::Sorin => 0.9 * span,
        FinialKind::Hoju => (0.14 * span).clamp(0.5, 3.0),
        FinialKind::Shibi => (0.09 * ridge).clamp(0.5, 2.2),
        FinialKind::Chigi => (0.16 * ridge).clamp(0.6, 3.0),
    }
}

/// Returns the nearest odd number, at least 3: ridges usually carry 3 to 9 billets.
fn odd(n: f64) -> u32 {
    ((((n - 1.0) / 2.0).round() * 2.0) as u32 + 1).clamp(3, 11)
}
