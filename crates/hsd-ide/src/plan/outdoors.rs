//! What stands outdoors in a plan: parts by the rectangles that they cover, covered ground.

use super::{PlanPlace, place};
use glam::{DVec2, DVec3, dvec2};
use hsd_export::number::Number;
use hsd_ir::ast::GroundSurface;
use hsd_ir::building::fittings::{Fitting, FittingKind};
use hsd_ir::building::{self};
use hsd_ir::catalog::body::{Element, Shape};
use hsd_ir::catalog::{Catalog, PartDef};
use serde::Serialize;

/// A part or covered ground outdoors, as the page draws it.
#[derive(Debug, Serialize)]
pub struct PlanOutdoor {
    /// `put` or `ground`.
    pub kind: &'static str,
    /// The code of the part, or the surface of the ground.
    pub code: String,
    /// The corners of what it covers.
    pub outline: [[Number; 2]; 4],
    /// Its place in the file.
    #[serde(flatten)]
    pub place: PlanPlace,
}

/// Returns what stands outdoors beside a house: ground below, parts above.
pub(super) fn outdoors(built: &building::Built, catalog: &Catalog) -> Vec<PlanOutdoor> {
    let of = |fitting| outdoor(fitting, built, catalog);
    let mut found: Vec<PlanOutdoor> = built.fittings.iter().filter_map(of).collect();
    found.sort_by_key(|one| one.kind == "put");
    found
}

fn outdoor(fitting: &Fitting, built: &building::Built, catalog: &Catalog) -> Option<PlanOutdoor> {
    let unit = built.house.unit;
    let (kind, code, at, along, span) = match &fitting.what {
        FittingKind::Ground(it) => {
            let half = it.size / 2.0;
            let word = GroundSurface::ALL
                .iter()
                .find(|(_, own)| *own == it.surface);
            let code = word.map_or("", |(word, _)| *word).to_owned();
            ("ground", code, it.at, it.along, (-half, half))
        }
        FittingKind::Put(it) => {
            let part = catalog.part(it.part);
            let half = it.size.x / 2.0;
            let (front, back) = depth(part, half);
            let code = part.code().trim_end().to_owned();
            (
                "put",
                code,
                it.at,
                it.right,
                (dvec2(-half, -front), dvec2(half, -back)),
            )
        }
        _ => return None,
    };
    let (least, most) = span;
    let corners = [least, dvec2(most.x, least.y), most, dvec2(least.x, most.y)];
    Some(PlanOutdoor {
        kind,
        code,
        outline: corners.map(|corner| author(at, along, corner, unit)),
        place: place(fitting.span),
    })
}

/// Returns a point of a thing, along it and back, in the author frame of its house, U.
fn author(at: DVec3, along: DVec2, corner: DVec2, unit: f64) -> [Number; 2] {
    let p = at.truncate() + along * corner.x + along.perp() * corner.y;
    [Number(-p.x / unit), Number(p.y / unit)]
}

/// Returns how far before its middle a part begins and ends, metres; round bodies are as deep as it is wide.
fn depth(part: &PartDef, half: f64) -> (f64, f64) {
    let all = part
        .body
        .iter()
        .flat_map(|e| std::iter::once(e).chain(&e.children));
    let of = |e: &Element| match &e.shape {
        Shape::Turned(it) => (it.out.0 + half, it.out.0 - half),
        Shape::Coping(it) if !it.across => {
            let front = e.place.front.0 + it.out.0;
            (front, front - e.place.thick.0 - 2.0 * it.out.0)
        }
        _ => (e.place.front.0, e.place.front.0 - e.place.thick.0),
    };
    let found = all.map(of).reduce(|a, b| (a.0.max(b.0), a.1.min(b.1)));
    found.unwrap_or((half, -half))
}
