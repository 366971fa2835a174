//! Fixtures: whether each stands free in a room, and what it stands against.

use crate::ast;
use crate::building::{Fixture, OUTWARD};
use crate::diagnostic::Diagnostics;
use crate::diagnostic::messages::plan::fixtures as say;
use crate::fit::plan::Plan;
use glam::{DVec2, dvec2};

/// The steepest stairs: rise in run. Old ones reach 60 degrees; what is steeper is a ladder.
const STEEPEST: f64 = 1.75;

/// Places the fixtures of a storey. `openings` are the stairs that come up into it, `height` tells how far a room's ceiling is
/// above its floor.
pub(super) fn placed(
    plan: &Plan<'_>,
    above: Option<&Plan<'_>>,
    openings: &[&Fixture],
    unit: f64,
    height: impl Fn(usize) -> Option<f64>,
    out: &mut Diagnostics,
) -> Vec<Fixture> {
    let mut made: Vec<Fixture> = vec![];
    for written in &plan.storey.fixtures {
        let mut fixture = rectangle(written, plan);
        let middle = fixture.middle();
        if !plan.holds(middle) {
            out.push(say::outside(written, plan.bounds));
            continue;
        }
        if plan.crosses(&fixture) {
            out.push(say::through_a_wall(written));
            continue;
        }
        let mut standing = made.iter().chain(openings.iter().copied());
        if let Some(other) = standing.find(|other| other.overlaps(&fixture)) {
            out.push(say::in_one_place(written, other));
            continue;
        }
        let walk = plan.areas.around(middle);
        fixture.walls = OUTWARD.map(|way| plan.areas.on_wall(fixture.edge(way)));
        fixture.height = walk.and_then(&height);
        if written.kind.climbs() && !leads_up(&mut fixture, written, above, plan, unit, out) {
            continue;
        }
        made.push(fixture);
    }
    for (i, fixture) in made.iter().enumerate() {
        let way = fixture.faces.outward();
        let before = Plan::before(fixture, way);
        let beside = made.iter().enumerate();
        let blocked = beside
            .filter(|(j, _)| *j != i)
            .any(|(_, other)| crate::geometry::holds(&other.corners(), before));
        if blocked || !is_free(plan, fixture.edge(way), before) {
            out.push(say::front_against(fixture));
        }
    }
    made
}

fn rectangle(written: &ast::Fixture, plan: &Plan<'_>) -> Fixture {
    let (width, depth) = written.kind.usual_size();
    let usual = match written.faces {
        ast::Side::Front | ast::Side::Back => (width, depth),
        ast::Side::Left | ast::Side::Right => (depth, width),
    };
    let (a, b) = written.at.value;
    let (along_a, along_b) = written.size.as_ref().map_or(usual, |s| s.value);
    let low = dvec2(a, b);
    Fixture {
        span: written.span,
        kind: written.kind,
        storey: plan.storey.number,
        level: plan.level,
        low,
        high: low + dvec2(along_a, along_b),
        faces: written.faces,
        walls: [false; 4],
        height: None,
        open_above: [false; 4],
    }
}

/// Returns true if one can stand at a place before an edge.
fn is_free(plan: &Plan<'_>, edge: DVec2, before: DVec2) -> bool {
    plan.holds(before) && !plan.areas.on_wall(edge) && !plan.areas.on_wall(before)
}

/// Returns true if stairs lead into the storey above.
fn leads_up(
    stairs: &mut Fixture,
    written: &ast::Fixture,
    above: Option<&Plan<'_>>,
    plan: &Plan<'_>,
    unit: f64,
    out: &mut Diagnostics,
) -> bool {
    let Some(above) = above else {
        out.push(say::no_storey_above(written));
        return false;
    };
    let back = -stairs.faces.outward();
    let arrives = is_free(above, stairs.edge(back), Plan::landing(stairs));
    if !above.holds(stairs.middle()) || above.crosses(stairs) || !arrives {
        out.push(say::blocked_above(written));
        return false;
    }
    stairs.open_above = OUTWARD.map(|way| !above.areas.on_wall(stairs.edge(way)));
    let rise = plan.storey.z1 - plan.storey.z0;
    let (_, depth) = stairs.front_and_depth();
    if rise > STEEPEST * depth * unit {
        let needed = (rise / STEEPEST / unit * 4.0).ceil() / 4.0;
        out.push(say::too_steep(written, needed));
    }
    true
}
