//! Sloping ceilings: walls under a lean-to end at its plane, in rectangular bays below a wedge.

use crate::material::SurfaceId;
use crate::tessellate::Level;
use crate::tessellate::mesh::{Axis, Bodies, THIN};
use crate::tessellate::part::bay::Layer;
use glam::{DVec2, dvec2};

/// Tolerance in plan for points on the border of a rectangle, U.
const NEAR: f64 = 1e-3;

/// The lowest wall, metres.
const LOWEST: f64 = 0.05;

/// Returns the heights above the storey's floor at which a unit from `from` to `to` (plan, U) ends; the storey's own
/// top if no ceiling is lower.
pub(in crate::tessellate) fn tops(
    level: Level<'_>,
    from: DVec2,
    to: DVec2,
    top: f64,
) -> (f64, f64) {
    let found = level
        .ceilings
        .iter()
        .find(|ceiling| ceiling.storey == level.storey.number && on_border(ceiling.rect, from, to));
    let Some(ceiling) = found else {
        return (top, top);
    };
    let at = |p: DVec2| {
        let z = ceiling.z + ceiling.slope.dot(p) - level.storey.z0;
        z.min(top).max(LOWEST)
    };
    (at(from), at(to))
}

/// Returns true if a section of wall lies on one edge of a rectangle.
fn on_border([a0, b0, a1, b1]: [f64; 4], p: DVec2, q: DVec2) -> bool {
    let near = |x: f64, y: f64| (x - y).abs() < NEAR;
    let within = |x: f64, lo: f64, hi: f64| x > lo - NEAR && x < hi + NEAR;
    let along_a =
        |b: f64| near(p.y, b) && near(q.y, b) && within(p.x, a0, a1) && within(q.x, a0, a1);
    let along_b =
        |a: f64| near(p.x, a) && near(q.x, a) && within(p.y, b0, b1) && within(q.y, b0, b1);
    along_a(b0) || along_a(b1) || along_b(a0) || along_b(a1)
}

/// Builds the wedge between a bay's level top and the sloping plane: x from 0 to the width, heights at the left and
/// right end above the level top.
pub(in crate::tessellate) fn wedge(
    finish: SurfaceId,
    layer: Layer,
    width: f64,
    base: f64,
    left: f64,
    right: f64,
) -> Bodies {
    let mut bodies = Bodies::default();
    let mut outline = vec![dvec2(base, 0.0), dvec2(base, width)];
    for (rise, x) in [(right, width), (left, 0.0)] {
        if rise > THIN {
            outline.push(dvec2(base + rise, x));
        }
    }
    if outline.len() > 2 {
        bodies.prism(
            finish,
            &outline,
            Axis::Y,
            -layer.front,
            layer.thick - layer.front,
        );
    }
    bodies
}
