//! Noren: cloths side by side on a pole, slit for most of their length.

use super::bay::{Bay, Layer, Rect};
use super::mesh::Axis;
use crate::catalog::body::{Cloth, Place};
use crate::material::SurfaceId;
use glam::{DVec2, dvec2};

/// Share of the drop over which neighbours are sewn together.
const SEWN: f64 = 0.18;

/// How far folds stand out from the middle plane, metres.
const FOLD: f64 = 0.014;

/// Cloths that fill the width of the rectangle and hang from its top; the count is kept, their width
/// gives way.
pub(super) fn cloth(bay: &mut Bay<'_>, cloth: &Cloth, place: &Place, rect: Rect) {
    let n = cloth.count.max(1);
    let width = cloth.size.0.min(rect.width() / f64::from(n));
    let left = (rect.x0 + rect.x1 - width * f64::from(n)) / 2.0;
    let drop = cloth.drop.0.min(rect.height() - 0.03);
    let top = rect.z1 - 0.030;
    let pole = Layer {
        front: place.front.0 + 0.012,
        thick: 0.024,
    };
    bay.block(
        SurfaceId::named("bamboo"),
        rect.between(top - 0.012, top + 0.012),
        pole,
    );
    let sewn = top - drop * SEWN;
    for i in 0..n {
        let x = left + width * f64::from(i);
        // Slits are as wide as the cloths pull apart.
        let slit = if n > 1 { 0.012 } else { 0.0 };
        fold(bay, place, (x, x + width), (sewn, top - 0.002), i);
        fold(
            bay,
            place,
            (x + slit, x + width - slit),
            (top - drop, sewn),
            i,
        );
    }
}

/// A piece of cloth in gentle folds, drawn upwards from its wavy foot.
fn fold(bay: &mut Bay<'_>, place: &Place, (x0, x1): (f64, f64), (z0, z1): (f64, f64), which: u32) {
    if x1 - x0 < 0.02 || z1 - z0 < 0.02 {
        return;
    }
    let middle = -place.front.0 + place.thick.0 / 2.0;
    let half = place.thick.0 / 2.0;
    const STEPS: usize = 6;
    let wave = [0.0, 0.8, 0.3, -0.7, -0.2, 0.6, 0.0];
    let sense = if which.is_multiple_of(2) { FOLD } else { -FOLD };
    let at = |i: usize, side: f64| {
        let x = x0 + (x1 - x0) * i as f64 / STEPS as f64;
        dvec2(x, middle + wave[i] * sense + side * half)
    };
    let front = (0..=STEPS).map(|i| at(i, -1.0));
    let back = (0..=STEPS).rev().map(|i| at(i, 1.0));
    let outline: Vec<DVec2> = front.chain(back).collect();
    bay.bodies.prism(place.finish, &outline, Axis::Z, z0, z1);
}
