//! Ridge caps: courses of ridge tiles under a cap, or the ridge of another covering, and the end
//! tiles (onigawara). Sizes from domain.md 4.4.

use super::form::RidgeLine;
use super::look::Look;
use super::solid::prism;
use crate::ast::RoofKind;
use crate::building::{Finish, Solid};
use glam::DVec3;

/// How far a cap reaches down beside the ridge line beyond the slopes, metres.
const SUNK: f64 = 0.02;

/// Width and height above the ridge line, metres.
pub fn size(look: &Look) -> (f64, f64) {
    match look.kind {
        RoofKind::Tiles | RoofKind::CoverTiles => {
            // dai + n courses of 35 mm + cap of 80 mm; small ridges take the 5-sun cap.
            let width = if look.noshi > 4 { 0.18 } else { 0.15 };
            (width, 0.015 + 0.035 * f64::from(look.noshi) + 0.08)
        }
        RoofKind::Boards => (0.20, 0.06),
        RoofKind::Shingles => (0.24, 0.15),
        RoofKind::Bark => (0.30, 0.30),
        RoofKind::Thatch => (0.60, 0.35),
        RoofKind::Metal => (0.16, 0.05),
    }
}

/// The cap along a ridge and the tiles at its free ends.
pub fn ridge_cap(line: &RidgeLine, look: &Look, solids: &mut Vec<Solid>) {
    let way = line.to - line.from;
    let Some(along) = way.try_normalize() else {
        return;
    };
    let (width, height) = size(look);
    let finish = Finish::Ridge(look.kind);
    let across = across(along);
    let foot = SUNK + look.pitch * width / 2.0;
    let shoulder = height - (0.08_f64).min(height / 2.0);
    let profile = [
        (-0.5, -foot),
        (0.5, -foot),
        (0.5, shoulder),
        (0.25, height),
        (-0.25, height),
        (-0.5, shoulder),
    ];
    let section = profile.map(|(w, z)| line.from + across * (w * width) + DVec3::Z * z);
    solids.push(prism(&section, way, finish));
    if !matches!(look.kind, RoofKind::Tiles | RoofKind::CoverTiles) || !look.ends {
        return;
    }
    for (free, at, out) in [
        (line.free[0], line.from, -along),
        (line.free[1], line.to, along),
    ] {
        if free {
            solids.push(end_tile(at, out, look));
        }
    }
}

/// The onigawara: a block with a rounded head, a little higher and wider than the ridge.
fn end_tile(at: DVec3, out: DVec3, look: &Look) -> Solid {
    let (width, height) = size(look);
    let (half, top) = (width / 2.0 + 0.05, height + 0.08);
    let foot = SUNK + look.pitch * half;
    let across = across(out);
    let profile = [
        (-half, -foot),
        (half, -foot),
        (half, top - half * 0.6),
        (half * 0.5, top),
        (-half * 0.5, top),
        (-half, top - half * 0.6),
    ];
    let back = at - out * 0.06;
    let section = profile.map(|(w, z)| back + across * w + DVec3::Z * z);
    prism(&section, out * 0.10, Finish::Ridge(look.kind))
}

/// Level, at right angles to a ridge.
fn across(along: DVec3) -> DVec3 {
    along.truncate().perp().normalize_or_zero().extend(0.0)
}
