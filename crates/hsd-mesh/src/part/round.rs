//! Round elements: openings with rounded corners and bell-shaped ones, poles, convex slats.

use crate::mesh::Axis;
use crate::mesh::lathe;
use crate::mesh::panel::Rect;
use crate::mesh::smooth::soft_bar;
use crate::part::bay::{Bay, Layer};
use crate::part::boards::pieces;
use glam::{DVec2, dvec2, dvec3};
use hsd_ir::catalog::body::{Bell, Corners, Place, Slats, Turned};
use hsd_ir::catalog::value::{Level, Run};
use hsd_ir::material::SurfaceId;
use std::f64::consts::FRAC_PI_2;

/// Fills the corners of a rectangle around a rounded opening; a radius of half the width gives a circle.
pub(crate) fn corners(bay: &mut Bay<'_>, corners: &Corners, place: &Place, rect: Rect) {
    let finish = if corners.around {
        bay.around
    } else {
        place.finish
    };
    fill_corners(bay, finish, Layer::from(place), rect, corners.size.0);
}

/// Fills the corners of a rectangle outside arcs of this radius.
pub(crate) fn fill_corners(
    bay: &mut Bay<'_>,
    finish: SurfaceId,
    layer: Layer,
    rect: Rect,
    radius: f64,
) {
    let r = radius.min(rect.width() / 2.0).min(rect.height() / 2.0);
    if r < 0.005 {
        return;
    }
    let steps = steps(r);
    for (x, dx) in [(rect.x0, 1.0), (rect.x1, -1.0)] {
        for (z, dz) in [(rect.z0, 1.0), (rect.z1, -1.0)] {
            let arc = (0..=steps).map(|i| {
                let angle = FRAC_PI_2 * i as f64 / steps as f64;
                let (sin, cos) = (libm::sin(angle), libm::cos(angle));
                dvec2(z + dz * r * (1.0 - cos), x + dx * r * (1.0 - sin))
            });
            let outline: Vec<DVec2> = std::iter::once(dvec2(z, x)).chain(arc).collect();
            let (y0, y1) = (-layer.front, layer.thick - layer.front);
            bay.bodies.rounded(finish, &outline, Axis::Y, y0, y1);
        }
    }
}

/// The right half of a bell-shaped opening from the foot to the tip: shares of half its width and of its height. The jambs
/// spread at their feet; two cusps on each side lead up to the tip.
const BELL: [(f64, f64); 17] = [
    (1.00, 0.00),
    (0.95, 0.10),
    (0.92, 0.24),
    (0.91, 0.42),
    (0.91, 0.58),
    (0.88, 0.67),
    (0.82, 0.74),
    (0.74, 0.78),
    (0.70, 0.80),
    (0.64, 0.845),
    (0.54, 0.88),
    (0.44, 0.895),
    (0.40, 0.91),
    (0.30, 0.945),
    (0.18, 0.965),
    (0.08, 0.98),
    (0.00, 1.00),
];
/// How far the rim stands before the wall, metres.
const RIM_BEFORE: f64 = 0.012;

/// Adds the wall around a bell-shaped opening, and the rim along its curve.
pub(crate) fn bell(bay: &mut Bay<'_>, bell: &Bell, place: &Place, rect: Rect) {
    let (half, height) = (rect.width() / 2.0, rect.height());
    let rim = bell.rim.0.min(half / 2.0).min(height / 2.0);
    if rect.width() < 0.02 || height < 0.02 {
        return;
    }
    let middle = (rect.x0 + rect.x1) / 2.0;
    let (y0, y1) = (-place.front.0, place.thick.0 - place.front.0);
    for side in [1.0, -1.0] {
        // The curve of an opening smaller by a part of the rim on its sides and at its top.
        let curve = |by: f64| {
            BELL.map(|(w, h)| dvec2(rect.z0 + h * (height - by), middle + side * w * (half - by)))
        };
        let edge = middle + side * half;
        // They meet under the rim.
        let mut wall = vec![dvec2(rect.z0, edge)];
        wall.extend(curve(rim / 2.0));
        wall.extend([dvec2(rect.z1, middle), dvec2(rect.z1, edge)]);
        bay.bodies.rounded(bay.around, &wall, Axis::Y, y0, y1);
        let mut ring = curve(0.0).to_vec();
        ring.extend(curve(rim).into_iter().rev());
        let y = (y0 - RIM_BEFORE, y1 + RIM_BEFORE);
        bay.bodies.rounded(place.finish, &ring, Axis::Y, y.0, y.1);
    }
}

/// Fills the ends of a row of vertical gaps so that they end in half circles: one body above and one below, which pass
/// through the bars between the gaps.
pub(crate) fn arcade(
    bay: &mut Bay<'_>,
    finish: SurfaceId,
    layer: Layer,
    rect: Rect,
    gaps: &[(f64, f64)],
) {
    /// How far the bodies extend into the frame, metres.
    const INTO: f64 = 0.002;
    let (y0, y1) = (-layer.front, layer.thick - layer.front);
    let radius = |(x0, x1): (f64, f64)| ((x1 - x0) / 2.0).min(rect.height() / 2.0);
    let gaps = gaps.iter().copied().filter(|g| radius(*g) >= 0.005);
    let gaps: Vec<(f64, f64)> = gaps.collect();
    let (Some(first), Some(last)) = (gaps.first(), gaps.last()) else {
        return;
    };
    for (z, dz) in [(rect.z0, 1.0), (rect.z1, -1.0)] {
        let mut outline = vec![dvec2(z - dz * INTO, last.1), dvec2(z - dz * INTO, first.0)];
        for &(x0, x1) in &gaps {
            let (r, middle) = (radius((x0, x1)), (x0 + x1) / 2.0);
            let steps = 2 * steps(r);
            outline.extend((0..=steps).map(|i| {
                let angle = 2.0 * FRAC_PI_2 * i as f64 / steps as f64;
                let (sin, cos) = (libm::sin(angle), libm::cos(angle));
                dvec2(z + dz * r * (1.0 - sin), middle - r * cos)
            }));
        }
        bay.bodies.rounded(finish, &outline, Axis::Y, y0, y1);
    }
}

/// Returns the number of segments of a quarter circle: about two centimetres each, since small arcs are seen from close
/// up.
fn steps(radius: f64) -> usize {
    ((radius * FRAC_PI_2 / 0.02).ceil() as usize).clamp(3, 12)
}

/// Adds a round bar in the middle of its place, with the place's smallest dimension as its diameter.
pub(crate) fn pole(bay: &mut Bay<'_>, run: Run, place: &Place, rect: Rect) {
    let (y0, y1) = (-place.front.0, place.thick.0 - place.front.0);
    match run {
        Run::Level => {
            let r = (rect.height().min(y1 - y0)) / 2.0;
            let (y, z) = ((y0 + y1) / 2.0, (rect.z0 + rect.z1) / 2.0);
            let ring = soft_bar((y - r, y + r), (z - r, z + r), r, 3, true);
            bay.bodies
                .rounded(place.finish, &ring, Axis::X, rect.x0, rect.x1);
        }
        Run::Upright => {
            let r = (rect.width().min(y1 - y0)) / 2.0;
            let (x, y) = ((rect.x0 + rect.x1) / 2.0, (y0 + y1) / 2.0);
            let ring = soft_bar((x - r, x + r), (y - r, y + r), r, 3, true);
            bay.bodies
                .rounded(place.finish, &ring, Axis::Z, rect.z0, rect.z1);
        }
    }
}

/// Adds a body of revolution in the middle of its place.
pub(crate) fn turned(bay: &mut Bay<'_>, turned: &Turned, place: &Place, rect: Rect) {
    let half = rect.width() / 2.0;
    let corner = |(z, r): &(Level, Level)| {
        let radius = r.at(0.0, half).clamp(0.0, half);
        (radius, z.at(0.0, rect.height()).clamp(0.0, rect.height()))
    };
    let mut profile: Vec<(f64, f64)> = turned.profile.0.iter().map(corner).collect();
    // Closed at both ends.
    if let Some(&(_, z)) = profile.first().filter(|p| p.0 > 0.0) {
        profile.insert(0, (0.0, z));
    }
    if let Some(&(_, z)) = profile.last().filter(|p| p.0 > 0.0) {
        profile.push((0.0, z));
    }
    if profile.len() < 3 {
        return;
    }
    let at = dvec3((rect.x0 + rect.x1) / 2.0, -turned.out.0, rect.z0);
    let sides = match turned.sides {
        0 => lathe::sides(bay.detail),
        n => n.clamp(3, 64) as usize,
    };
    let soft = turned.sides == 0;
    lathe::revolved(
        &mut bay.bodies,
        place.finish,
        at,
        &profile,
        (sides, turned.turn.to_radians(), soft),
    );
}

/// Adds horizontal slats from the top down, each convex between two grooves.
pub(crate) fn slats(bay: &mut Bay<'_>, slats: &Slats, place: &Place, rect: Rect) {
    let n = pieces(rect.height(), slats.size.0);
    let size = rect.height() / n as f64;
    let (front, back) = (place.front.0, place.front.0 - place.thick.0);
    let groove = front - slats.bulge.0;
    for i in 0..n {
        let z = rect.z0 + size * i as f64;
        // Shares of the height and of the bulge.
        let bow = [
            (0.0, 0.0),
            (0.12, 0.62),
            (0.5, 1.0),
            (0.88, 0.62),
            (1.0, 0.0),
        ];
        let face = bow.map(|(up, out)| dvec2(-(groove + slats.bulge.0 * out), z + size * up));
        let mut outline = vec![dvec2(-back, z + size), dvec2(-back, z)];
        outline.extend(face);
        bay.bodies
            .rounded(place.finish, &outline, Axis::X, rect.x0, rect.x1);
    }
}
