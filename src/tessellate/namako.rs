//! Namako walls: raised plaster joints over flat tiles, diagonal or in running bond.

use super::bay::{Bay, Layer, Rect};
use super::boards::pieces;
use super::mesh::Axis;
use crate::catalog::body::{Namako, Place};
use crate::catalog::value::Joints;
use glam::{DVec2, dvec2};

/// How much lower joints of the second family are, so that crossings show no two faces in one plane.
const LOWER: f64 = 0.002;

/// Joints over a rectangle.
pub(super) fn namako(bay: &mut Bay<'_>, namako: &Namako, place: &Place, rect: Rect) {
    match namako.joints {
        Joints::Diagonal => diagonal(bay, namako, place, rect),
        Joints::Running => running(bay, namako, place, rect),
    }
}

/// Level joints, and upright ones that shift by half a tile each course. Widths divide the bay, so that
/// neighbouring bays go on.
fn running(bay: &mut Bay<'_>, namako: &Namako, place: &Place, rect: Rect) {
    let layer = Layer::from(place);
    let low = Layer {
        front: layer.front - LOWER,
        thick: layer.thick - LOWER,
    };
    let (cols, rows) = (
        pieces(rect.width(), namako.tile.0),
        pieces(rect.height(), namako.tile.0),
    );
    let (w, h) = (rect.width() / cols as f64, rect.height() / rows as f64);
    let half = namako.joint.0 / 2.0;
    for row in 0..=rows {
        let z = rect.z0 + h * row as f64;
        let joint = rect.between((z - half).max(rect.z0), (z + half).min(rect.z1));
        bay.block(place.finish, joint, layer);
    }
    for row in 0..rows {
        let z = rect.z0 + h * row as f64;
        let shift = if row % 2 == 0 { 0.0 } else { 0.5 };
        for col in 0..=cols {
            let x = rect.x0 + w * (col as f64 + shift);
            let joint = rect.across((x - half).max(rect.x0), (x + half).min(rect.x1));
            bay.block(place.finish, joint.between(z + half, z + h - half), low);
        }
    }
}

/// Two families of joints at 45 degrees. Their distance divides the bay's width, so that neighbouring
/// bays go on.
fn diagonal(bay: &mut Bay<'_>, namako: &Namako, place: &Place, rect: Rect) {
    let side = namako.tile.0 * std::f64::consts::SQRT_2;
    let step = rect.width() / pieces(rect.width(), side) as f64;
    let half = namako.joint.0 / std::f64::consts::SQRT_2;
    let layer = Layer::from(place);
    let first = -((rect.height() / step).ceil() as i64) - 1;
    let last = (rect.width() / step).ceil() as i64 + 1;
    let corners = [
        dvec2(rect.x0, rect.z0),
        dvec2(rect.x1, rect.z0),
        dvec2(rect.x1, rect.z1),
        dvec2(rect.x0, rect.z1),
    ];
    for rising in [true, false] {
        let front = layer.front - if rising { 0.0 } else { LOWER };
        for i in first..=last {
            let at = step * i as f64;
            // x - z runs from at - half to at + half; falling joints are mirrored in the bay's middle.
            let across = |p: DVec2| {
                let x = if rising { p.x - rect.x0 } else { rect.x1 - p.x };
                x - (p.y - rect.z0)
            };
            let band = clip(&corners, |p| across(p) - (at - half));
            let band = clip(&band, |p| at + half - across(p));
            if band.len() >= 3 && crate::geometry::area2(&band).abs() > 1e-4 {
                let outline: Vec<DVec2> = band.iter().map(|p| dvec2(p.y, p.x)).collect();
                let (y0, y1) = (-front, -layer.front + layer.thick);
                bay.bodies.prism(place.finish, &outline, Axis::Y, y0, y1);
            }
        }
    }
}

/// What of a convex polygon lies where a linear measure is not negative.
fn clip(polygon: &[DVec2], measure: impl Fn(DVec2) -> f64) -> Vec<DVec2> {
    let mut kept: Vec<DVec2> = Vec::new();
    for (i, &p) in polygon.iter().enumerate() {
        let q = polygon[(i + 1) % polygon.len()];
        let (mp, mq) = (measure(p), measure(q));
        if mp >= 0.0 {
            kept.push(p);
        }
        if (mp < 0.0) != (mq < 0.0) {
            kept.push(p.lerp(q, mp / (mp - mq)));
        }
    }
    // A cut through a corner names it twice.
    kept.dedup_by(|a, b| a.distance(*b) < 1e-6);
    while kept.len() > 1 && kept[0].distance(kept[kept.len() - 1]) < 1e-6 {
        kept.pop();
    }
    kept
}
