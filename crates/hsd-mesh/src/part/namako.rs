//! Namako walls: half-round plaster joints over flat tiles, diagonal or in running bond.

use crate::mesh::panel::Rect;
use crate::part::bay::{Bay, Layer};
use crate::part::boards::pieces;
use glam::{DVec2, DVec3, dvec2, dvec3};
use hsd_ir::catalog::body::{Namako, Place};
use hsd_ir::catalog::value::Joints;
use hsd_ir::material::SurfaceId;
use hsd_scene::Detail;

/// Section of a joint: shares of its half width across, and of its height.
const SECTION: [(f64, f64); 5] = [
    (-1.0, 0.0),
    (-DIAGONAL, DIAGONAL),
    (0.0, 1.0),
    (DIAGONAL, DIAGONAL),
    (1.0, 0.0),
];

/// Cosine of 45 degrees.
const DIAGONAL: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// How far a passer-by's look goes across a joint on each metre into the house, metres.
const SLANT: f64 = 1.0;

/// Corners closer than this to a line of the section are snapped to it, to avoid slivers, metres.
const SNAP: f64 = 5e-4;

/// Adds joints over a rectangle; `front` is their crown, `thick` their relief.
pub(crate) fn namako(bay: &mut Bay<'_>, namako: &Namako, place: &Place, rect: Rect) {
    match namako.joints {
        Joints::Diagonal => diagonal(bay, namako, place, rect),
        Joints::Running => running(bay, namako, place, rect),
    }
}

/// Adds horizontal joints, and vertical ones offset by half a tile in each course. Spacings divide the bay, so that the
/// pattern continues into neighbouring bays.
fn running(bay: &mut Bay<'_>, namako: &Namako, place: &Place, rect: Rect) {
    let (cols, rows) = (
        pieces(rect.width(), namako.tile.0),
        pieces(rect.height(), namako.tile.0),
    );
    let (w, h) = (rect.width() / cols as f64, rect.height() / rows as f64);
    let joint = Joint::new(namako, place, bay.detail);
    for row in 0..=rows {
        let z = rect.z0 + h * row as f64;
        joint.draw(bay, rect, |p| p.y - z);
    }
    for row in 0..rows {
        let z = rect.z0 + h * row as f64;
        let shift = if row % 2 == 0 { 0.0 } else { 0.5 };
        for col in 0..=cols {
            let x = rect.x0 + w * (col as f64 + shift);
            joint.draw(bay, rect.between(z, z + h), |p| p.x - x);
        }
    }
}

/// Adds two families of joints at 45 degrees. Their spacing divides the bay's width, so that the pattern continues into
/// neighbouring bays.
fn diagonal(bay: &mut Bay<'_>, namako: &Namako, place: &Place, rect: Rect) {
    let side = namako.tile.0 * std::f64::consts::SQRT_2;
    let step = rect.width() / pieces(rect.width(), side) as f64;
    let first = -((rect.height() / step).ceil() as i64) - 1;
    let last = (rect.width() / step).ceil() as i64 + 1;
    let joint = Joint::new(namako, place, bay.detail);
    for i in first..=last {
        let at = step * i as f64;
        joint.draw(bay, rect, |p| {
            (p.x - rect.x0 - (p.y - rect.z0) - at) * DIAGONAL
        });
    }
    // Falling joints are mirrored in the bay's middle.
    for i in first..=last {
        let at = step * i as f64;
        joint.draw(bay, rect, |p| {
            (rect.x1 - p.x - (p.y - rect.z0) - at) * DIAGONAL
        });
    }
}

/// A half-round joint.
struct Joint {
    finish: SurfaceId,
    /// Half its width, metres.
    half: f64,
    /// The layer of its relief; the front is the crown.
    layer: Layer,
}

impl Joint {
    /// Where joints are a flat image they are as wide as a round one seems to somebody who looks along the wall.
    fn new(namako: &Namako, place: &Place, detail: Detail) -> Joint {
        let (half, layer) = (namako.joint.0 / 2.0, Layer::from(place));
        let seems = (half + libm::hypot(half, layer.thick * SLANT)) / 2.0;
        Joint {
            finish: place.finish,
            half: if detail < Detail::Everything {
                seems
            } else {
                half
            },
            layer,
        }
    }

    /// Adds the joint clipped to a rectangle; `across` measures the distance from its axis.
    fn draw(&self, bay: &mut Bay<'_>, rect: Rect, across: impl Fn(DVec2) -> f64) {
        let sides = self.sides(rect, &across);
        let ring: Vec<DVec2> = sides
            .iter()
            .flat_map(|side| &side[..side.len() - 1])
            .copied()
            .collect();
        for pair in SECTION.windows(2) {
            let (lo, hi) = (pair[0].0 * self.half, pair[1].0 * self.half);
            let held = ring.iter().filter(|p| between(across(**p), lo, hi));
            let strip: Vec<DVec2> = held.copied().collect();
            if strip.len() > 2 {
                let top: Vec<DVec3> = strip.iter().map(|p| self.head(*p, &across)).collect();
                let normals = self.normals(&strip, &across);
                bay.bodies.shaded(self.finish, &top, &normals);
            }
        }
        self.close(bay, &sides, &across);
    }

    /// Adds the ends at the rectangle's sides, and the back.
    fn close(&self, bay: &mut Bay<'_>, sides: &[Vec<DVec2>], across: impl Fn(DVec2) -> f64) {
        let mut base: Vec<DVec3> = Vec::new();
        for side in sides {
            let held = side
                .iter()
                .filter(|p| between(across(**p), -self.half, self.half));
            let on: Vec<DVec2> = held.copied().collect();
            let (Some(first), Some(last)) = (on.first(), on.last()) else {
                continue;
            };
            let mut wall = vec![self.foot(*first)];
            if on.len() > 1 {
                wall.push(self.foot(*last));
            }
            base.extend(&wall);
            let risen = on.iter().rev().map(|p| self.head(*p, &across));
            wall.extend(risen.filter(|p| self.layer.thick - self.layer.front - p.y > 1e-6));
            if wall.len() > 2 {
                bay.bodies.face(self.finish, &wall);
            }
        }
        base.dedup();
        if base.len() > 2 && base.first() == base.last() {
            base.pop();
        }
        if base.len() > 2 {
            // Seen from behind.
            base.reverse();
            bay.bodies.face(self.finish, &base);
        }
    }

    /// Returns the point on the plane of the joint's foot.
    fn foot(&self, p: DVec2) -> DVec3 {
        dvec3(p.x, self.layer.thick - self.layer.front, p.y)
    }

    /// Returns the point on the joint's surface.
    fn head(&self, p: DVec2, across: impl Fn(DVec2) -> f64) -> DVec3 {
        let u = (across(p) / self.half).clamp(-1.0, 1.0);
        let k = SECTION.iter().rposition(|s| s.0 <= u).unwrap_or(0).min(3);
        let ((u0, h0), (u1, h1)) = (SECTION[k], SECTION[k + 1]);
        let share = h0 + (h1 - h0) * (u - u0) / (u1 - u0);
        self.foot(p) - DVec3::Y * (self.layer.thick * share)
    }

    /// Returns the rectangle's sides from corner to corner, counter-clockwise from outside, with a point wherever a
    /// line of the section crosses them.
    fn sides(&self, rect: Rect, across: impl Fn(DVec2) -> f64) -> Vec<Vec<DVec2>> {
        let corners = [
            dvec2(rect.x0, rect.z0),
            dvec2(rect.x1, rect.z0),
            dvec2(rect.x1, rect.z1),
            dvec2(rect.x0, rect.z1),
        ];
        let side = |i: usize| {
            let (p, q) = (corners[i], corners[(i + 1) % 4]);
            let (mp, mq) = (across(p), across(q));
            let lines = SECTION.iter().map(|s| s.0 * self.half);
            let mut cuts: Vec<f64> = lines
                .filter(|u| (mp - u).abs() > SNAP && (mq - u).abs() > SNAP)
                .map(|u| (mp - u) / (mp - mq))
                .filter(|t| *t > 0.0 && *t < 1.0)
                .collect();
            cuts.sort_by(f64::total_cmp);
            let mut points = vec![p];
            points.extend(cuts.iter().map(|t| p.lerp(q, *t)));
            points.push(q);
            points
        };
        (0..4).map(side).collect()
    }

    /// Returns the normals of the round surface at the points of a strip.
    fn normals(&self, strip: &[DVec2], across: impl Fn(DVec2) -> f64) -> Vec<DVec3> {
        // The direction in which the distance grows.
        let gradient = dvec2(
            across(dvec2(1.0, 0.0)) - across(DVec2::ZERO),
            across(dvec2(0.0, 1.0)) - across(DVec2::ZERO),
        );
        let normal = |p: &DVec2| {
            let u = (across(*p) / self.half).clamp(-0.94, 0.94);
            let side = gradient * u;
            dvec3(side.x, -(1.0 - u * u).sqrt(), side.y).normalize_or_zero()
        };
        strip.iter().map(normal).collect()
    }
}

/// Returns true if a distance lies between two lines of the section, within tolerance.
fn between(u: f64, lo: f64, hi: f64) -> bool {
    u >= lo - SNAP && u <= hi + SNAP
}
