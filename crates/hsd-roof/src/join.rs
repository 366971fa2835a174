//! Turns forms into solids: roofs of one height meet, then each gets its slab and its gable infills.

pub(crate) mod gable_infill;
pub(crate) mod meet;
pub(crate) mod nearby;
mod plain;
pub(crate) mod verges;

use crate::facet::{Sides, edges};
use crate::join::gable_infill::{Built, fit};
use crate::join::meet::{apart, meet};
use crate::shape::form::{Form, RoofDraft};
use crate::solid::sheet::sheet;
use glam::DVec2;
use hsd_base::geometry::tolerance::JOINT;
use hsd_ir::ast::RoofShape;
use hsd_ir::building::{Attic, Roof, Verge};

/// Assembles the roofs of one storey, in order. `walls` are convex parts of the storey above, which roofs do not enter;
/// from `afar` plain roofs under none are one solid. Returns whether all met; if too many overlap they stay as they are.
pub(super) fn assemble(
    mut planned: Vec<RoofDraft>,
    walls: &[Vec<DVec2>],
    afar: bool,
    roofs: &mut Vec<Roof>,
) -> bool {
    if afar && walls.is_empty() && plain::join(&mut planned, roofs) {
        return true;
    }
    let mut all_met = true;
    let mut start = 0;
    // A stable sort, so that indices of trunks keep their meaning within a height.
    let first = planned.first().map_or(0.0, |p| p.base);
    planned.sort_by(|p, q| {
        (p.base != first)
            .cmp(&(q.base != first))
            .then(p.base.total_cmp(&q.base))
    });
    while start < planned.len() {
        let base = planned[start].base;
        let count = planned[start..]
            .iter()
            .take_while(|p| (p.base - base).abs() < 1e-6)
            .count();
        all_met &= group(&mut planned[start..start + count], walls, roofs);
        start += count;
    }
    all_met
}

fn group(planned: &mut [RoofDraft], walls: &[Vec<DVec2>], roofs: &mut Vec<Roof>) -> bool {
    let forms: Vec<_> = planned
        .iter_mut()
        .map(|p| std::mem::take(&mut p.form))
        .collect();
    let (met, all_met) = match meet(&forms, walls) {
        Some(met) => (met, true),
        None => (apart(&forms), false),
    };
    for (planned, form) in planned.iter_mut().zip(&forms) {
        planned.roof.attic = attic(form, planned.base, planned.roof.shape);
    }
    let mut built: Vec<Built> = planned
        .iter()
        .zip(forms)
        .zip(met)
        .map(|((planned, form), pieces)| Built {
            sheets: sheet(&pieces, form.drop, &planned.look.coat(), form.floor),
            drop: form.drop,
            fills: form.solids,
        })
        .collect();
    if all_met {
        fit(&mut built);
    }
    for (planned, built) in planned.iter_mut().zip(built) {
        let mut solids = built.sheets;
        solids.extend(built.fills);
        planned.roof.solids = solids;
        let empty = Roof {
            attic: Attic::default(),
            whole: None,
            solids: vec![],
            ..planned.roof
        };
        roofs.push(std::mem::replace(&mut planned.roof, empty));
    }
    all_met
}

/// Returns the space between a form and the walls that carry it.
fn attic(form: &Form, plate: f64, shape: RoofShape) -> Attic {
    let filled = !form.hung && form.under.is_none() && shape != RoofShape::Flat;
    let mut attic = Attic {
        plate,
        filled,
        ..Attic::default()
    };
    if filled {
        let walls = form.walls.map_or(Sides::new(), |w| edges(&w.corners()));
        for facet in &form.facets {
            let top = facet.plane;
            let lift = |at: DVec2| at.extend(top.at(at));
            let over = facet.beyond(&walls).into_iter();
            let over = over.map(|v| v.iter().map(|c| lift(c.at)).collect::<Verge>());
            // Eaves lie below the plate, over walls or not.
            let high = |v: &Verge| v.iter().any(|p| p.z - form.drop > plate + JOINT);
            attic.verges.extend(over.filter(high));
            if facet.lowered > 0.0 {
                let whole = facet.outline.iter().map(|c| lift(c.at)).collect();
                attic.lowered.push((whole, facet.lowered));
            }
        }
    }
    attic
}
