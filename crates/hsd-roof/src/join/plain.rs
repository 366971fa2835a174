//! Plain roofs on one plate, as they are seen from afar: one solid of their slopes, which are not joined before.
//!
//! Lean-tos under the eaves of a plain roof that touch no slope are slabs of their own below it, with the walls over
//! them up to its plate. They may pass through the eaves of another roof: what is inside of both is unseen.

use crate::facet::{Convex, Corner, Facet, HalfPlane, area, edges, sides_of};
use crate::frame::{Plane, Rect, round};
use crate::shape::form::{Form, RoofDraft};
use crate::solid::massive::{Plate, Slope, Wing, is_gable, of_wings};
use crate::solid::{INFILL_THICKNESS, SUNK};
use hsd_base::geometry::tolerance::{CUT, JOINT, SLIVER};
use hsd_ir::ast::RoofShape;
use hsd_ir::building::{Attic, Roof, Solid};
use smallvec::SmallVec;

/// Surfaces of roofs that pass through each other do not flicker if they are this far apart somewhere: sloping ones in height,
/// upright ones in plan, metres.
const NEAR: f64 = 5e-3;

/// Adds several roofs, the first with the solids of all, each with its walls as they are before roofs meet. Returns false,
/// and leaves them, if they are not plain.
pub(crate) fn join(planned: &mut Vec<RoofDraft>, roofs: &mut Vec<Roof>) -> bool {
    // One that meets no other has a closed form.
    let several = planned.len() > 1;
    let Some(mut whole) = several.then(|| whole(planned)).flatten() else {
        return false;
    };
    let made = planned.drain(..).map(|draft| Roof {
        attic: Attic {
            plate: draft.base,
            filled: draft.form.under.is_none(),
            ..Attic::default()
        },
        whole: Some(std::mem::take(&mut whole)).filter(|solids| !solids.is_empty()),
        solids: draft.form.solids,
        ..draft.roof
    });
    roofs.extend(made);
    true
}

/// Returns the solids of some roofs; none if one of them is more than slopes over walls.
fn whole(planned: &[RoofDraft]) -> Option<Vec<Solid>> {
    let first = planned.first()?;
    let plain = |draft: &RoofDraft| {
        let alike = draft.base == first.base && draft.look.kind == first.look.kind;
        alike && draft.roof.shape != RoofShape::Flat && is_plain(&draft.form)
    };
    if !planned.iter().all(plain) {
        return None;
    }
    let is_main = |draft: &&RoofDraft| draft.form.under.is_none();
    let (main, tucked): (Vec<&RoofDraft>, Vec<&RoofDraft>) = planned.iter().partition(is_main);
    let drop = main.first()?.form.drop;
    if main.iter().any(|draft| draft.form.drop != drop) {
        return None;
    }
    let mut solids = slabs(&main, Some(first.base - SUNK))?;
    for draft in tucked {
        if !is_apart(draft, planned) {
            return None;
        }
        solids.extend(slabs(&[draft], None)?);
        solids.extend_from_slice(&draft.form.solids);
    }
    Some(solids)
}

fn is_plain(form: &Form) -> bool {
    let alone = !form.hung && form.walls.is_none();
    alone && form.solids.iter().all(is_gable) && form.facets.iter().all(|f| f.lowered == 0.0)
}

/// Returns the slabs of some roofs over an attic with this floor, if they have one.
fn slabs(drafts: &[&RoofDraft], floor: Option<f64>) -> Option<Vec<Solid>> {
    let slopes = |draft: &&RoofDraft| draft.form.facets.iter().map(slope).collect();
    let roofs: Vec<Vec<Slope>> = drafts.iter().map(slopes).collect::<Option<_>>()?;
    let first = drafts.first()?;
    let plate = Plate {
        drop: first.form.drop,
        floor,
        kind: first.look.kind,
    };
    of_wings(&Wing::joined(roofs), &plate)
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
        let wall = side.moved_out(INFILL_THICKNESS / 2.0);
        if slope.body.iter().all(|c| wall.depth(c.at) > -CUT) {
            continue;
        }
        let [body, verge] = wall.halves(&slope.body);
        slope.body = body;
        slope
            .verges
            .extend(Some(verge).filter(|v| area(v) > SLIVER));
    }
    (area(&slope.body) > SLIVER).then_some(slope)
}

/// Returns true if a roof under the eaves of another touches neither that nor any other. It may lie under the eaves of several,
/// and pass through those of all but its own.
fn is_apart(draft: &RoofDraft, planned: &[RoofDraft]) -> bool {
    let form = &draft.form;
    let floor = Plane::level(draft.base - SUNK);
    let low = |own: &Facet| lies_below(&own.outline, own.plane, floor);
    let around = bounds(form);
    let free = |(n, other): (usize, &RoofDraft)| {
        let trunk = form.under == Some(n);
        let apart = std::ptr::eq(other, draft) || !around.overlaps(&bounds(&other.form));
        let under = || is_under_eaves(form, &other.form);
        let through = || !trunk && is_askew(form, &other.form);
        (apart && !trunk) || (other.form.under.is_none() && (under() || through()))
    };
    form.facets.iter().all(low) && planned.iter().enumerate().all(free)
}

/// Returns true if no surface of a form lies in one of another, so that they may pass through each other.
fn is_askew(form: &Form, other: &Form) -> bool {
    let levels = |form: &Form, plane: Plane| [plane, plane.raised(-form.drop)];
    let apart = |own: &Facet, above: &Facet| {
        let common = overlap(own, above);
        let gap = |one: Plane, two: Plane, c: &Corner| (one.at(c.at) - two.at(c.at)).abs();
        let differ = |one, two| common.iter().any(|c| gap(one, two, c) > NEAR);
        let others = levels(other, above.plane);
        let level = |one| others.iter().all(|two| differ(one, *two));
        area(&common) < SLIVER || levels(form, own.plane).into_iter().all(level)
    };
    let beside = |own: &Facet, above: &Facet| {
        let next = above.outline.iter().cycle().skip(1);
        let mut lines = above.outline.iter().zip(next);
        let along = |side: &HalfPlane, c: &Corner| side.depth(c.at).abs() < NEAR;
        let sides = sides_of(&own.outline);
        lines.all(|(c, d)| !sides.iter().any(|side| along(side, c) && along(side, d)))
    };
    let free = |own: &Facet| other.facets.iter().all(|f| apart(own, f) && beside(own, f));
    form.facets.iter().all(free)
}

/// Returns what two slopes both cover in plan.
fn overlap(one: &Facet, other: &Facet) -> Convex {
    let sides = sides_of(&other.outline);
    let whole = one.outline.clone();
    sides.iter().fold(whole, |rest, side| side.inside(&rest))
}

/// Returns true if the slopes of a form lie below those of its trunk.
fn is_under_eaves(form: &Form, trunk: &Form) -> bool {
    trunk.facets.iter().all(|above| {
        let soffit = above.plane.raised(-trunk.drop);
        form.facets.iter().all(|own| {
            let common = overlap(own, above);
            area(&common) < SLIVER || lies_below(&common, own.plane, soffit)
        })
    })
}

/// Returns true if a plane lies below another over an outline, with air between them.
fn lies_below(outline: &[Corner], plane: Plane, other: Plane) -> bool {
    let gap = |c: &Corner| other.at(c.at) - plane.at(c.at);
    outline.iter().all(|c| gap(c) > JOINT)
}

fn bounds(form: &Form) -> Rect {
    round(form.facets.iter().flat_map(|f| &f.outline).map(|c| c.at))
}
