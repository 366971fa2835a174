//! The roofs of a plan.

use super::{Roof, place, point};
use glam::{DVec2, dvec2};
use hsd_export::number::Number;
use hsd_ir::building::{self, EdgeKind, RoofSurface};

/// Heights that differ by less are equal, metres.
const LEVEL: f64 = 1e-3;

pub(super) fn roof(roof: &building::Roof, surface: &RoofSurface, unit: f64) -> Roof {
    let points = || roof.solids.iter().flat_map(|s| &s.points);
    let plan = |p: &glam::DVec3| dvec2(-p.x / unit, p.y / unit);
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for p in points().map(plan) {
        (low, high) = (low.min(p), high.max(p));
    }
    let top = points().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max);
    let upper = [EdgeKind::Ridge, EdgeKind::Crest, EdgeKind::Abutment];
    let edges = surface.edges.iter().filter(|e| upper.contains(&e.kind));
    let highest = edges
        .map(|e| surface.ends(e))
        .filter(|ends| ends.iter().all(|p| top - p.z < LEVEL))
        .flatten()
        .map(|p| plan(&p));
    let letter = hsd_ir::ast::RoofKind::ALL.iter().find(|k| k.1 == roof.kind);
    Roof {
        shape: roof.shape.letters(),
        kind: letter.map_or('K', |k| k.0),
        storey: roof.storey,
        place: roof.span.map(place),
        rect: [low.x, low.y, high.x, high.y].map(Number),
        z: Number(top),
        ridge: ridge(highest.collect()),
    }
}

/// Returns the ends of the line on which all points lie, if they are collinear.
fn ridge(points: Vec<DVec2>) -> Option<[[Number; 2]; 2]> {
    let first = *points.first()?;
    let far = |from: DVec2| {
        let distance = |p: &&DVec2| p.distance_squared(from);
        points
            .iter()
            .max_by(|p, q| distance(p).total_cmp(&distance(q)))
    };
    let start = *far(first)?;
    let end = *far(start)?;
    let along = (end - start).try_normalize()?;
    let off = |p: &DVec2| along.perp_dot(*p - start).abs();
    let straight = points.iter().all(|p| off(p) < 0.05);
    (straight && start.distance(end) > 0.05).then_some([point(start), point(end)])
}
