//! Plain roofs on one plate, as they are seen from afar: one solid of their slopes, which are not joined before.

use crate::ast::RoofShape;
use crate::building::{Attic, Roof, Solid};
use crate::geometry::tolerance::SLIVER;
use crate::roof::facet::{Facet, area, edges};
use crate::roof::shape::form::{Form, RoofDraft};
use crate::roof::solid::massive::{Plate, Slope, is_gable, of_slopes};
use crate::roof::solid::{INFILL_THICKNESS, SUNK};
use smallvec::SmallVec;

/// Adds some roofs, the first with the solid of all, each with its gable walls as they are before roofs meet. Returns false,
/// and leaves them, if they are not plain.
pub(in crate::roof) fn join(planned: &mut Vec<RoofDraft>, roofs: &mut Vec<Roof>) -> bool {
    let Some(mut whole) = whole(planned) else {
        return false;
    };
    let filled = planned.drain(..).map(|draft| Roof {
        attic: Attic {
            plate: draft.base,
            filled: true,
            ..Attic::default()
        },
        whole: Some(std::mem::take(&mut whole)).filter(|solids| !solids.is_empty()),
        solids: draft.form.solids,
        ..draft.roof
    });
    roofs.extend(filled);
    true
}

/// Returns the solids of some roofs; none if one of them is more than slopes over gable walls.
fn whole(planned: &[RoofDraft]) -> Option<Vec<Solid>> {
    let first = planned.first()?;
    let plain = |draft: &RoofDraft| {
        let RoofDraft { form, look, roof, base } = draft;
        *base == first.base
            && look.kind == first.look.kind
            && form.drop == first.form.drop
            && roof.shape != RoofShape::Flat
            && is_plain(form)
    };
    if !planned.iter().all(plain) {
        return None;
    }
    let facets = planned.iter().flat_map(|draft| &draft.form.facets);
    let slopes: Vec<Slope> = facets.map(slope).collect::<Option<_>>()?;
    let plate = Plate {
        drop: first.form.drop,
        floor: first.base - SUNK,
        kind: first.look.kind,
    };
    of_slopes(&slopes, &plate)
}

fn is_plain(form: &Form) -> bool {
    let alone = form.under.is_none() && !form.hung && form.walls.is_none();
    alone && form.solids.iter().all(is_gable) && form.facets.iter().all(|f| f.lowered == 0.0)
}

/// Returns a facet with its verges apart.
fn slope(facet: &Facet) -> Option<Slope> {
    let outline = facet.outline.clone();
    let same = outline.iter().map(|c| c.at).eq(facet.body.iter().copied());
    let mut slope = Slope {
        body: outline.clone(),
        outline,
        verges: SmallVec::new(),
        top: facet.plane,
    };
    if same {
        return Some(slope);
    }
    for side in edges(&facet.body) {
        let [body, verge] = side.moved_out(INFILL_THICKNESS / 2.0).halves(&slope.body);
        slope.body = body;
        slope.verges.extend(Some(verge).filter(|v| area(v) > SLIVER));
    }
    (area(&slope.body) > SLIVER).then_some(slope)
}
