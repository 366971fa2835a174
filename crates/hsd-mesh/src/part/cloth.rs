//! Noren: cloths side by side, hung by loops from a pole, slit for most of their length, in gentle folds.

use crate::mesh::Axis;
use crate::mesh::panel::Rect;
use crate::mesh::smooth::soft_bar;
use crate::part::bay::Bay;
use glam::{dvec2, dvec3};
use hsd_ir::catalog::body::{Cloth, Place};
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;

/// Share of the drop over which neighbouring cloths are sewn together.
const SEWN: f64 = 0.28;

/// Amplitude of the folds at the foot, from the middle plane, metres.
const FOLD: f64 = 0.018;

/// Radius of the pole, metres.
const POLE: f64 = 0.012;

/// Distance from the axis of the pole to the upper edge of the cloth, metres.
const LOOP: f64 = 0.032;

/// Columns and rows of a cloth's mesh.
const GRID: [u32; 2] = [10, 5];

/// The same where the rest of the wall is flat: shaded alike, its outline 2 mm off.
const COARSE_GRID: [u32; 2] = [6, 4];

/// Adds cloths that fill the width of the rectangle and hang from its top; their count is kept, their width adapts.
pub(crate) fn cloth(bay: &mut Bay<'_>, cloth: &Cloth, place: &Place, rect: Rect) {
    let n = cloth.count.max(1);
    let width = cloth.size.0.min(rect.width() / f64::from(n));
    let left = (rect.x0 + rect.x1 - width * f64::from(n)) / 2.0;
    let pole = rect.z1 - 0.030;
    let top = pole - LOOP;
    let drop = top - (rect.z1 - cloth.drop.0).max(rect.z0 + 0.01);
    if drop < 0.05 || width < 0.05 {
        return;
    }
    let middle = place.thick.0 / 2.0 - place.front.0;
    let grid = match bay.detail > Detail::Flat {
        true => GRID,
        false => COARSE_GRID,
    };
    let ring = soft_bar(
        (middle - POLE, middle + POLE),
        (pole - POLE, pole + POLE),
        POLE,
        3,
        true,
    );
    bay.bodies
        .rounded(SurfaceId::named("bamboo"), &ring, Axis::X, rect.x0, rect.x1);
    for i in 0..n {
        let x = left + width * f64::from(i);
        loops(bay, cloth.loops, place, (x, width), (middle, top, pole));
        let which = f64::from(i);
        let half = place.thick.0 / 2.0;
        let size = dvec2(width, drop);
        bay.bodies.sheet(place.finish, grid, size, half, |u, v| {
            let (free, share) = ((1.0 - SEWN - v).max(0.0) / (1.0 - SEWN), 1.0 - v);
            // Below the seam neighbours pull apart, the more so towards the foot, and each has folds of its own.
            let slit = if n > 1 {
                0.014_f64.min(width * 0.06) * free
            } else {
                0.0
            };
            let turns = which + u + 0.12 * free * (which * 1.7 + 1.0);
            let wave = libm::sin(turns * 1.1 * std::f64::consts::TAU);
            let deep = FOLD.min(width * 0.065) * (0.12 + 0.88 * share);
            let x = x + slit + (width - 2.0 * slit) * u;
            dvec3(x, middle + deep * wave, top - drop * share)
        });
    }
}

/// Adds the loops of cloth around the pole.
fn loops(
    bay: &mut Bay<'_>,
    count: u32,
    place: &Place,
    (x, width): (f64, f64),
    (middle, top, pole): (f64, f64, f64),
) {
    let half = 0.015_f64.min(width / f64::from(3 * count.max(1)));
    let r = POLE + 0.003;
    for i in 0..count {
        let at = x + width * (f64::from(i) + 0.5) / f64::from(count);
        let lo = dvec3(at - half, middle - r, top - 0.012);
        let hi = dvec3(at + half, middle + r, pole + r);
        bay.bodies.block(place.finish, lo, hi);
    }
}
