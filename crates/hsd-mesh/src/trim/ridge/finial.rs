//! The finial of a pyramid roof (hogyo): a box (roban) with a ball (hoju) over the point where its hips meet.

use crate::trim::TrimContext;
use crate::trim::body::Body;
use crate::trim::seams::{Kind, Seam};
use glam::DVec3;
use hsd_base::geometry::tolerance::JOINT;
use hsd_ir::ast::RoofKind;
use hsd_ir::material::SurfaceId;

/// Roofs with more hips than this have no finials, since they are not pyramids.
const MANY: usize = 500;
/// Rings from the foot up: radius and height above the point, metres. The foot is inside the roof.
const RINGS: [(f64, f64); 7] = [
    (0.24, 0.10),
    (0.24, 0.22),
    (0.12, 0.25),
    (0.14, 0.32),
    (0.15, 0.38),
    (0.10, 0.46),
    (0.02, 0.52),
];

/// Adds a finial at each point where at least three hips and no ridge meet.
pub(in crate::trim) fn finials(context: &TrimContext<'_>, seams: &[Seam], bodies: &mut Vec<Body>) {
    if !context.roof.trim.ends || context.roof.trim.crowned {
        return;
    }
    let of = |kind: Kind| seams.iter().filter(move |s| s.kind == kind);
    let heads: Vec<DVec3> = of(Kind::Hip)
        .filter_map(|s| s.points.last())
        .copied()
        .collect();
    if heads.len() > MANY {
        return;
    }
    let near = |p: &DVec3, q: &DVec3| p.distance(*q) < JOINT;
    for (n, head) in heads.iter().enumerate() {
        let first = !heads[..n].iter().any(|p| near(p, head));
        let count = heads.iter().filter(|p| near(p, head)).count();
        let ridged = of(Kind::Ridge)
            .flat_map(|s| &s.points)
            .any(|p| near(p, head));
        if first && count > 2 && !ridged {
            bodies.extend(finial(context, *head));
        }
    }
}

fn finial(context: &TrimContext<'_>, at: DVec3) -> Option<Body> {
    const SIDES: u32 = 8;
    let finish = match context.roof.kind {
        RoofKind::Tiles | RoofKind::CoverTiles => "ibushi",
        RoofKind::Metal => "sheet_roof",
        _ => "cedar",
    };
    // The foot stands in the slopes all round.
    let foot = (0.26, -0.30);
    let rings = [foot].into_iter().chain(RINGS);
    let ring = |(radius, up): (f64, f64)| -> Vec<DVec3> {
        let corner = |i: u32| {
            let angle = std::f64::consts::TAU * (f64::from(i) + 0.5) / f64::from(SIDES);
            at + DVec3::new(radius * libm::cos(angle), radius * libm::sin(angle), up)
        };
        (0..SIDES).map(corner).collect()
    };
    let sections: Vec<Vec<DVec3>> = rings.map(ring).collect();
    Body::loft(SurfaceId::named(finish), &sections).map(Body::smooth)
}
