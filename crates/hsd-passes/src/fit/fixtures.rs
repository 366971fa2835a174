//! Fixtures: whether each stands free in a room, and what it stands against.

use crate::fit::plan::Plan;
use crate::messages::plan::fixtures as say;
use glam::{DVec2, dvec2};
use hsd_base::diagnostic::{Diagnostic, Diagnostics};
use hsd_ir::ast;
use hsd_ir::building::{Fixture, House, OUTWARD};

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
        let standing = made.iter().chain(openings.iter().copied());
        if let Some(why) = hindered(plan, above, &fixture, standing) {
            out.push(told(written, why, plan));
            continue;
        }
        let walk = plan.areas.around(fixture.middle());
        fixture.walls = OUTWARD.map(|way| plan.areas.on_wall(fixture.edge(way)));
        fixture.height = walk.and_then(&height);
        if let Some(above) = above.filter(|_| written.kind.climbs()) {
            rise(&mut fixture, written, above, plan, unit, out);
        }
        made.push(fixture);
    }
    for (i, fixture) in made.iter().enumerate() {
        let way = fixture.faces.outward();
        let before = Plan::before(fixture, way);
        let beside = made.iter().enumerate();
        let blocked = beside
            .filter(|(j, _)| *j != i)
            .any(|(_, other)| hsd_base::geometry::holds(&other.corners(), before));
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

/// Why a fixture cannot stand at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hindrance<'f> {
    /// It is outside of the walls, or they do not close.
    Outside,
    /// A wall runs through it.
    Wall,
    /// Another one stands there.
    Taken(&'f Fixture),
    /// No storey is above its stairs.
    NoStoreyAbove,
    /// Its stairs end in a wall or outside.
    BlockedAbove,
}

/// Returns why a fixture cannot stand in a storey of a house among those that do.
pub(super) fn hindrance<'f>(
    house: &House,
    level: usize,
    written: &ast::Fixture,
    standing: impl Iterator<Item = &'f Fixture>,
) -> Option<Hindrance<'f>> {
    let plan = |level: usize| {
        let storey = house.storeys.get(level)?;
        Plan::of(storey, level).ok().filter(Plan::is_storey)
    };
    let Some(own) = plan(level) else {
        return Some(Hindrance::Outside);
    };
    let above = (level + 1..house.storeys.len()).find_map(plan);
    let above = above.filter(|p| p.storey.number == own.storey.number + 1);
    let fixture = rectangle(written, &own);
    let (number, climbs) = (own.storey.number, written.kind.climbs());
    // Stairs take up as much of the storey above as of their own.
    let standing = standing.filter(|other| {
        other.storey == number
            || other.storey + 1 == number && other.kind.climbs()
            || other.storey == number + 1 && climbs
    });
    hindered(&own, above.as_ref(), &fixture, standing)
}

fn hindered<'f>(
    plan: &Plan<'_>,
    above: Option<&Plan<'_>>,
    fixture: &Fixture,
    mut standing: impl Iterator<Item = &'f Fixture>,
) -> Option<Hindrance<'f>> {
    if !plan.holds(fixture.middle()) {
        return Some(Hindrance::Outside);
    }
    if plan.crosses(fixture) {
        return Some(Hindrance::Wall);
    }
    if let Some(other) = standing.find(|other| other.overlaps(fixture)) {
        return Some(Hindrance::Taken(other));
    }
    if !fixture.kind.climbs() {
        return None;
    }
    let Some(above) = above else {
        return Some(Hindrance::NoStoreyAbove);
    };
    let back = -fixture.faces.outward();
    let arrives = is_free(above, fixture.edge(back), Plan::landing(fixture));
    let leads_up = above.holds(fixture.middle()) && !above.crosses(fixture) && arrives;
    (!leads_up).then_some(Hindrance::BlockedAbove)
}

fn told(written: &ast::Fixture, why: Hindrance<'_>, plan: &Plan<'_>) -> Diagnostic {
    match why {
        Hindrance::Outside => say::outside(written, plan.bounds),
        Hindrance::Wall => say::through_a_wall(written),
        Hindrance::Taken(other) => say::in_one_place(written, other),
        Hindrance::NoStoreyAbove => say::no_storey_above(written),
        Hindrance::BlockedAbove => say::blocked_above(written),
    }
}

/// Notes which sides of the opening above the stairs have no wall, and warns of stairs that are too steep.
fn rise(
    stairs: &mut Fixture,
    written: &ast::Fixture,
    above: &Plan<'_>,
    plan: &Plan<'_>,
    unit: f64,
    out: &mut Diagnostics,
) {
    stairs.open_above = OUTWARD.map(|way| !above.areas.on_wall(stairs.edge(way)));
    let rise = plan.storey.z1 - plan.storey.z0;
    let (_, depth) = stairs.front_and_depth();
    if rise > STEEPEST * depth * unit {
        let needed = (rise / STEEPEST / unit * 4.0).ceil() / 4.0;
        out.push(say::too_steep(written, needed));
    }
}
