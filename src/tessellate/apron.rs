//! Inu-yarai: laths of split bamboo in an arc before the foot of a wall.

use super::bars::middles;
use super::bay::{Bay, Rect};
use crate::catalog::body::{Apron, Place};
use crate::material::SurfaceId;

/// Pieces of the arc.
const STEPS: usize = 7;

/// The laths, and two rails behind them.
pub(super) fn apron(bay: &mut Bay<'_>, apron: &Apron, place: &Place, rect: Rect) {
    let pitch = rect.width() / f64::from(apron.count.max(1));
    let half = pitch * 0.42;
    let outline = arc(apron.out.0, place, rect, place.thick.0);
    // The first and last lath stand half a pitch from the ends, so that neighbours go on evenly.
    for i in 0..apron.count {
        let x = rect.x0 + pitch * (f64::from(i) + 0.5);
        bay.profile(place.finish, &outline, x - half, x + half);
    }
    let points = points(apron.out.0, place, rect);
    for share in middles(2, 0.0, 1.0, false) {
        let (out, z) = points[(share * STEPS as f64).round() as usize];
        let (out, z) = (out - place.thick.0 - 0.022, z - 0.008);
        let rail = [
            (out, z - 0.012),
            (out + 0.02, z - 0.012),
            (out + 0.02, z + 0.012),
            (out, z + 0.012),
        ];
        bay.profile(SurfaceId::named("bamboo"), &rail, rect.x0, rect.x1);
    }
}

/// Points of the outer face from the foot to the head: a quarter of an ellipse that leans out at the foot.
fn points(out: f64, place: &Place, rect: Rect) -> Vec<(f64, f64)> {
    (0..=STEPS)
        .map(|i| {
            let angle = std::f64::consts::FRAC_PI_2 * i as f64 / STEPS as f64;
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            (place.front.0 + out * cos, rect.z0 + rect.height() * sin)
        })
        .collect()
}

/// The closed outline of a lath.
fn arc(out: f64, place: &Place, rect: Rect, thick: f64) -> Vec<(f64, f64)> {
    let outer = points(out, place, rect);
    let inner = (0..=STEPS).rev().map(|i| {
        let angle = std::f64::consts::FRAC_PI_2 * i as f64 / STEPS as f64;
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        let (a, b) = (out - thick, rect.height() - thick);
        (place.front.0 + a * cos, rect.z0 + b * sin)
    });
    outer.iter().copied().chain(inner).collect()
}
