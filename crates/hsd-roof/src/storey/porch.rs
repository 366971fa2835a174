//! Porches under a karahafu: one end is free, the other is closed by the house behind; the roof ends in its wall or, if
//! it is higher than the wall, in its roof (a kurumayose in front of its hall). A ceiling then hides the eaves that run on under it.

use crate::frame::{end_sides, near_side};
use crate::region::{Ridge, Side};
use crate::shape::end::End;
use crate::shape::form::RoofDraft;
use crate::shape::look::Look;
use crate::shape::profile::Profile;
use crate::solid::{INFILL_THICKNESS, prism};
use crate::storey::forms::Context;
use crate::storey::placed_line::PlacedLine;
use glam::DVec3;
use hsd_base::geometry::SHAKU;
use hsd_base::geometry::plan::{Cell, Plan};
use hsd_ir::building::{Finish, Solid};

/// Thickness of a ceiling's boards, metres.
const BOARDS: f64 = 0.02;
/// Depth to which a roof penetrates a wall, metres.
const INTO: f64 = 0.03;
/// Slopes behind count as gentler by this factor, since they may be curved (sori).
const HANGING: f64 = 0.5;
/// The maximum length inside the roof behind, metres.
const FARTHEST: f64 = 8.0;

/// Returns the ridge of a porch: into the house behind, unless written otherwise.
pub(crate) fn ridge(cell: &Cell, context: &Context<'_>, wish: Option<Ridge>) -> Option<Ridge> {
    let behind = || {
        let mut sides = Side::ALL
            .into_iter()
            .filter(|s| depth_behind(cell, *s, context) > 0);
        let side = sides.next()?;
        sides.next().is_none().then(|| side.ridge_into())
    };
    wish.or_else(behind)
}

/// Returns the roof of a porch.
pub(crate) fn planned(one: &PlacedLine<'_>, run: Ridge, context: &Context<'_>) -> RoofDraft {
    let look = context.gable_look(&one.cell, run, Some(&one.line.style));
    let ends = end_sides(near_side(run)).map(|side| {
        let plain = context.plain_end(&one.cell, side, &look);
        match depth_behind(&one.cell, side, context) {
            0 => plain,
            depth => into(one, side, &look, context.metres(depth), context),
        }
    });
    let mut draft = context.ridge_roof_with(one.cell, run, one.base, look, ends);
    if ends.iter().any(|end| end.reach > INTO) {
        draft.form.solids.push(ceiling(one, context));
    }
    draft
}

/// Returns a ceiling on the wall plates, within the gable wall.
fn ceiling(one: &PlacedLine<'_>, context: &Context<'_>) -> Solid {
    let within = context.rect(&one.cell).grown(-INFILL_THICKNESS);
    let ring = within.corners().map(|p| p.extend(one.base));
    prism(&ring, DVec3::Z * BOARDS, Finish::Timber)
}

/// Returns the end in a house of some depth behind.
fn into(one: &PlacedLine<'_>, side: Side, look: &Look, depth: f64, context: &Context<'_>) -> End {
    let half = context.metres(side.measure(&one.cell).0) / 2.0;
    let over = one.base + look.pitch * half - context.level.storey.z1;
    if over <= 0.0 {
        return End {
            reach: INTO,
            ..End::default()
        };
    }
    let profile = Profile::new(look, half, &[]);
    let behind = Look::gable(None, context.style, SHAKU, context.unit);
    let reach = (over + look.drop()) / (behind.pitch * HANGING);
    End {
        reach: reach.min(FARTHEST).min(depth / 2.0).max(INTO),
        from: profile
            .reach(half * look.pitch - over)
            .unwrap_or(0.0)
            .max(0.0),
        ..End::default()
    }
}

/// Returns the depth of the storey, in grid steps, behind the middle of a side that lies wholly on it; 0 if it is open
/// there.
fn depth_behind(cell: &Cell, side: Side, context: &Context<'_>) -> i64 {
    let plan = &context.level.plan;
    if !context.level.orthogonal || plan.loops.is_empty() {
        return 0;
    }
    let middle = (
        i64::midpoint(cell.a0, cell.a1),
        i64::midpoint(cell.b0, cell.b1),
    );
    let lies = match contains(plan, middle) {
        // A projecting part of the house.
        true => context.outline().along(cell, side).is_empty(),
        false => context.outline().whole(cell, side),
    };
    // The distance of a crossing wall beyond the side.
    let beyond = |((pa, pb), (qa, qb)): ((i64, i64), (i64, i64))| {
        let (far, p, q, at) = match side {
            Side::Front => (cell.b0 - pb, pa, qa, middle.0),
            Side::Back => (pb - cell.b1, pa, qa, middle.0),
            Side::Left => (pa - cell.a1, pb, qb, middle.1),
            Side::Right => (cell.a0 - pa, pb, qb, middle.1),
        };
        (far > 0 && p.min(q) <= at && at < p.max(q)).then_some(far)
    };
    let nearest = plan.edges().filter_map(beyond).min();
    nearest.filter(|_| lies).unwrap_or(0)
}

/// Returns true if a point lies inside a plan (even-odd, half-open).
fn contains(plan: &Plan, (a, b): (i64, i64)) -> bool {
    let crosses = |(p, q): &((i64, i64), (i64, i64))| {
        p.0 == q.0 && p.0 > a && p.1.min(q.1) <= b && b < p.1.max(q.1)
    };
    plan.edges().filter(crosses).count() % 2 == 1
}
