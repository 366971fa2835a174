//! The plan of a storey as in `dump --stage regions` (docs/contract.md 5).

use crate::plan::level::Level;
use crate::region::{Region, Ridge, Role, Side};
use glam::DVec2;
use hsd_base::geometry::plan::Cell;
use hsd_ir::ast::RoofShape;
use hsd_ir::building::{PlanRegion, Ring, StoreyPlan, rect_of};

/// Returns the plan of the automatic regions of an orthogonal storey, whose roofs are of this shape.
pub(crate) fn plan(level: &Level<'_>, regions: &[Region], shape: RoofShape) -> StoreyPlan {
    let region = |r: &Region| match shape {
        RoofShape::Flat => flat_region(rect_of(r.cell), None),
        _ => PlanRegion {
            rect: rect_of(r.cell),
            polygon: None,
            ridge: r.ridge.map(ridge_letter),
            fall: r.fall.map(letter),
            role: match r.role {
                Role::Main => "main",
                Role::Branch => "branch",
                Role::LeanTo => "lean-to",
            },
            shape: match (r.role, shape) {
                (Role::LeanTo, _) => RoofShape::LeanTo,
                // A roof that joins another keeps its gable, and a pent roof stands in front of its wall.
                (_, RoofShape::LeanTo | RoofShape::Pent) => RoofShape::Gable,
                (_, shape) => shape,
            },
            // Written roofs are not in the list.
            over: match r.role {
                Role::Branch => r.over.filter(|over| *over < regions.len()),
                _ => None,
            },
        },
    };
    with_regions(level, regions.iter().map(region).collect())
}

/// Returns the plan of a lower roof round the storey above: the strips on its sides, which fall away from it.
pub(crate) fn skirt(level: &Level<'_>, mut strips: Vec<(Cell, Side)>) -> StoreyPlan {
    strips.sort_unstable_by_key(|(cell, _)| cell.key());
    let region = |(cell, fall): &(Cell, Side)| PlanRegion {
        rect: rect_of(*cell),
        polygon: None,
        ridge: None,
        fall: Some(letter(*fall)),
        role: "lean-to",
        shape: RoofShape::Hip,
        over: None,
    };
    with_regions(level, strips.iter().map(region).collect())
}

/// Returns a region for each outline of a storey that is roofed as a whole, in U.
pub(crate) fn polygons(
    level: &Level<'_>,
    outlines: Vec<Vec<DVec2>>,
    shape: RoofShape,
) -> StoreyPlan {
    let region = |corners: Vec<DVec2>| {
        let min = corners.iter().copied().fold(DVec2::MAX, DVec2::min);
        let max = corners.iter().copied().fold(DVec2::MIN, DVec2::max);
        PlanRegion {
            shape,
            ..flat_region([min.x, min.y, max.x, max.y], Some(corners))
        }
    };
    let mut regions: Vec<PlanRegion> = outlines.into_iter().map(region).collect();
    regions.sort_by(|p, q| {
        p.rect[1]
            .total_cmp(&q.rect[1])
            .then(p.rect[0].total_cmp(&q.rect[0]))
    });
    with_regions(level, regions)
}

fn flat_region(rect: [f64; 4], polygon: Option<Vec<DVec2>>) -> PlanRegion {
    let shape = RoofShape::Flat;
    PlanRegion {
        rect,
        polygon,
        ridge: None,
        fall: None,
        role: "main",
        shape,
        over: None,
    }
}

fn with_regions(level: &Level<'_>, regions: Vec<PlanRegion>) -> StoreyPlan {
    StoreyPlan {
        storey: level.storey.number,
        z: level.storey.z1,
        outlines: level.rings(false).map(Ring::corners).collect(),
        holes: level.rings(true).map(Ring::corners).collect(),
        regions,
    }
}

fn ridge_letter(ridge: Ridge) -> &'static str {
    match ridge {
        Ridge::A => "a",
        Ridge::B => "b",
    }
}

fn letter(side: Side) -> &'static str {
    match side {
        Side::Front => "F",
        Side::Back => "B",
        Side::Left => "L",
        Side::Right => "R",
    }
}
