//! Descending ridges (降棟 kudarimune): from the main ridge down a slope, beside the verge of a gable, closed by an
//! onigawara at their foot. Irimoya have them under tiles of any kind, gable roofs under cover tiles.

use crate::trim::TrimContext;
use crate::trim::body::Body;
use crate::trim::line::Line;
use crate::trim::ridge::{HIP_WIDTH, close, hip_courses, laid};
use crate::trim::seams::{Kind, Seam};
use glam::{DVec2, DVec3};
use hsd_ir::ast::{RoofKind, RoofShape};
use hsd_ir::building::Roof;

/// Distance of the ridge from the verge as a share of the verge's overhang, and its bounds, metres.
const INWARD: f64 = 0.9;
const BESIDE: (f64, f64) = (0.32, 0.9);
/// The shortest half of a verge in plan with such a ridge, on irimoya and on gable roofs, metres.
const SHORTEST: (f64, f64) = (1.2, 2.4);
/// Where it ends, as a share of the half verge from its foot: at the foot of an irimoya's gable, above the eaves of a gable.
const FOOT: (f64, f64) = (0.03, 0.13);
/// Ridges closer together than this, as a multiple of their distance from the verge, are left out.
const APART: f64 = 4.0;
/// How far its head lies in the main ridge, metres.
const INTO: f64 = 0.02;
/// How far from a border of facets a height is taken, metres.
const ASIDE: f64 = 1e-4;

/// Returns true if a roof's gables have descending ridges beside them.
fn has(roof: &Roof) -> bool {
    match roof.kind {
        RoofKind::CoverTiles => {
            !matches!(roof.shape, RoofShape::LeanTo | RoofShape::Karahafu)
                && !roof.shape.stands_on_another()
        }
        RoofKind::Tiles => is_irimoya(roof),
        _ => false,
    }
}

fn is_irimoya(roof: &Roof) -> bool {
    matches!(roof.shape, RoofShape::HipAndGable | RoofShape::Temple)
}

/// Adds the ridges beside a verge, one on each side of its apex.
pub(in crate::trim) fn beside(
    context: &TrimContext<'_>,
    verge: &Seam,
    seams: &[Seam],
    bodies: &mut Vec<Body>,
) {
    let points = &verge.points;
    let last = points.len() - 1;
    let top = (0..=last).fold(0, |best, i| match points[i].z > points[best].z {
        true => i,
        false => best,
    });
    if !has(context.roof) || top == 0 || top == last {
        return;
    }
    let out = -(points[last] - points[0]).truncate().perp();
    let by = (context.roof.trim.verge * INWARD).clamp(BESIDE.0, BESIDE.1);
    let inward = -out.normalize_or_zero() * by;
    // The main ridge must have room for one at each of its ends.
    let apex = points[top].truncate();
    let reaches = |seam: &Seam| {
        let ends = [seam.points[0], seam.points[seam.points.len() - 1]];
        let near = ends.iter().any(|p| p.truncate().distance(apex) < by);
        seam.kind == Kind::Ridge && near && ends[0].distance(ends[1]) > APART * by
    };
    if !seams.iter().any(reaches) {
        return;
    }
    let left: Vec<DVec3> = points[..=top].iter().rev().copied().collect();
    for half in [&left[..], &points[top..]] {
        if let Some(line) = line(context, half, inward) {
            ridge(context, &line, bodies);
        }
    }
}

/// Returns the line of the ridge beside half a verge, from the apex down; `None` where there is too little room.
fn line(context: &TrimContext<'_>, half: &[DVec3], inward: DVec2) -> Option<Line> {
    let verge = Line {
        points: half.to_vec(),
    };
    let run = half[0].truncate().distance(half[half.len() - 1].truncate());
    let (shortest, foot) = match is_irimoya(context.roof) {
        true => (SHORTEST.0, FOOT.0),
        false => (SHORTEST.1, FOOT.1),
    };
    if run < shortest {
        return None;
    }
    let part = verge.part(0.0, verge.length() * (1.0 - foot));
    let down = (half[half.len() - 1] - half[0])
        .truncate()
        .normalize_or_zero();
    // Corners lie on the borders of facets; a little below they lie in one.
    let moved = part
        .points
        .iter()
        .map(|p| p.truncate() + inward + down * ASIDE);
    let on = |plan: DVec2| context.surface.height(plan).map(|z| plan.extend(z));
    let mut points = moved.map(on).collect::<Option<Vec<DVec3>>>()?;
    // The apex lies on the main ridge, whose courses cover the head.
    let head = (points[0] - points[1]).normalize_or_zero();
    points[0] += head * INTO;
    Some(Line { points })
}

/// Adds one ridge and the tile at its foot.
fn ridge(context: &TrimContext<'_>, line: &Line, bodies: &mut Vec<Body>) {
    let trim = &context.roof.trim;
    let courses = hip_courses(trim.noshi);
    let size = laid(context, line, courses, HIP_WIDTH, 0.0, bodies);
    if trim.ends {
        let last = line.points.len() - 1;
        let (at, back) = (line.points[last], line.points[last - 1]);
        close(context, (at, at - back), 0.0, size, bodies);
    }
}
