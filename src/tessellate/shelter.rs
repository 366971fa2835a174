//! Little roofs: over windows, along fences, on wing walls.

use super::bay::{Bay, Rect};
use super::mesh::Axis;
use crate::catalog::body::{Coping, Place, Wing};
use crate::material::SurfaceId;
use glam::{DVec2, dvec2};

/// Thickness of a little roof, metres.
const SLAB: f64 = 0.035;

/// A hood whose slab falls from the top of its rectangle.
pub(super) fn hood(bay: &mut Bay<'_>, pitch: f64, place: &Place, rect: Rect) {
    let (front, back) = (place.front.0, place.front.0 - place.thick.0);
    let foot = (rect.z1 - SLAB - pitch * (front - back)).max(rect.z0);
    let outline = [
        (front, foot),
        (front, foot + SLAB),
        (back, rect.z1),
        (back, foot - 0.02),
    ];
    bay.profile(place.finish, &outline, rect.x0, rect.x1);
}

/// A little gable roof along a fence: both slopes, a flat underside, a round ridge of tiles.
pub(super) fn coping(bay: &mut Bay<'_>, coping: &Coping, place: &Place, rect: Rect) {
    let (front, back) = (place.front.0, place.front.0 - place.thick.0);
    let (middle, half) = ((front + back) / 2.0, place.thick.0 / 2.0 + coping.out.0);
    let ridge = 0.070_f64.min(rect.height() / 3.0);
    let top = rect.z1 - ridge * 0.6;
    let eaves = (top - coping.pitch * half).max(rect.z0);
    let outline = [
        (middle + half, eaves - SLAB),
        (middle + half, eaves),
        (middle, top),
        (middle - half, eaves),
        (middle - half, eaves - SLAB),
    ];
    bay.profile(place.finish, &outline, rect.x0, rect.x1);
    let w = 0.075_f64;
    let cap = [
        (middle + w, top - w * coping.pitch - 0.01),
        (middle + w, rect.z1 - ridge * 0.4),
        (middle + w * 0.5, rect.z1),
        (middle - w * 0.5, rect.z1),
        (middle - w, rect.z1 - ridge * 0.4),
        (middle - w, top - w * coping.pitch - 0.01),
    ];
    bay.profile(SurfaceId::named("kawara_edge"), &cap, rect.x0, rect.x1);
}

/// A wing wall at right angles to the facade, under its own gable roof that runs outwards.
pub(super) fn wing(bay: &mut Bay<'_>, wing: &Wing, place: &Place, rect: Rect) {
    let half = place.thick.0 / 2.0;
    // Its outer end falls a little, as the roof over it does.
    let (inner, outer) = (-place.front.0, wing.out.0);
    let roof = 0.190_f64.min(rect.height() / 3.0);
    let top = rect.z1 - roof;
    let wall = [
        dvec2(rect.z0, -half),
        dvec2(rect.z0, half),
        dvec2(top, half),
        dvec2(top, -half),
    ];
    bay.bodies
        .prism(place.finish, &wall, Axis::Y, -outer, -inner);
    let eaves = half + 0.120;
    let slopes: [DVec2; 5] = [
        dvec2(top - 0.02, -eaves),
        dvec2(top + 0.02, -eaves),
        dvec2(rect.z1, 0.0),
        dvec2(top + 0.02, eaves),
        dvec2(top - 0.02, eaves),
    ];
    bay.bodies
        .prism(wing.roof, &slopes, Axis::Y, -outer - 0.120, -inner - 0.001);
}
