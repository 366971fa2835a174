//! The rooms of a storey: the areas round the points at which they are written, their mats, and whether one gets in.

use crate::fit::areas::MOST;
use crate::fit::plan::{Area, NoPlan, Plan, Rest};
use crate::fit::{fixtures, mats, names, ways};
use crate::messages::plan::rooms as say;
use glam::{DVec2, dvec2};
use hsd_base::diagnostic::Diagnostics;
use hsd_base::geometry::{SAME, SHAKU};
use hsd_ir::ast;
use hsd_ir::ast::Flooring;
use hsd_ir::building::{Fixture, House, Mat, Room, Storey};
use hsd_ir::catalog::Catalog;
use std::collections::{BTreeMap, BTreeSet};

/// Works out the rooms of a house and what is built into them.
pub(super) fn rooms(
    house: &House,
    catalog: &Catalog,
    out: &mut Diagnostics,
) -> (Vec<Room>, Vec<Fixture>) {
    let (mut rooms, mut fixtures): (Vec<Room>, Vec<Fixture>) = (vec![], vec![]);
    let has_rooms = |s: &Storey| !s.rooms.is_empty() || !s.fixtures.is_empty();
    if !house.storeys.iter().any(has_rooms) {
        return (rooms, fixtures);
    }
    let storeys = house.storeys.iter().enumerate();
    let plans = storeys.map(|(level, storey)| plan(storey, level, out));
    let plans: Vec<Plan<'_>> = plans.flatten().filter(Plan::is_storey).collect();
    let mut reached = BTreeSet::new();
    let mut open: Vec<Area> = vec![];
    for (i, plan) in plans.iter().enumerate() {
        let number = plan.storey.number;
        let above = plans.get(i + 1).filter(|p| p.storey.number == number + 1);
        let below = i.checked_sub(1).map(|i| &plans[i]);
        let below = below.filter(|p| p.storey.number + 1 == number);
        let lower = |f: &&Fixture| below.is_some_and(|p| p.level == f.level) && f.kind.climbs();
        let openings: Vec<&Fixture> = fixtures.iter().filter(lower).collect();
        if below.is_none() {
            open.clear();
        }
        if !has_rooms(plan.storey) && openings.is_empty() {
            reached.clear();
            open.clear();
            continue;
        }
        let taken = taken(plan, out);
        let height = |walk: usize| taken.get(&walk).and_then(|room| room.height);
        let height = |walk: usize| lower_than_storey(height(walk), plan.storey);
        let own = fixtures::placed(plan, above, &openings, house.unit, height, out);
        let voids = voids(plan, &taken, open);
        let built = rooms_of(plan, &taken, (&own, &openings, &voids), out);
        open = voids.iter().map(|walk| plan.areas.area(*walk)).collect();
        open.extend(without_ceiling(&built));
        rooms.extend(built);
        reached = match below {
            Some(below) => {
                let stairs = openings.iter().copied();
                ways::from_stairs(plan, stairs, (below, &reached), catalog)
            }
            None => ways::from_outside(plan, catalog),
        };
        if number > 1 && openings.is_empty() && !taken.is_empty() {
            out.push(say::no_stairs(plan.storey.rooms[0].span, number));
        } else {
            unreached(&taken, &reached, out);
        }
        fixtures.extend(own);
    }
    (rooms, fixtures)
}

/// Returns the plan of a storey; that it has none is told where it has rooms.
fn plan<'h>(storey: &'h Storey, level: usize, out: &mut Diagnostics) -> Option<Plan<'h>> {
    let rooms = storey.rooms.iter().map(|r| r.span);
    let mut first = rooms.chain(storey.fixtures.iter().map(|f| f.span));
    match (Plan::of(storey, level), first.next()) {
        (Ok(plan), _) => Some(plan),
        (Err(_), None) => None,
        (Err(why), Some(first)) => {
            out.push(match why {
                NoPlan::Open => say::not_closed(first),
                NoPlan::Crowded => say::too_many_walls(first, MOST),
            });
            None
        }
    }
}

/// Returns the areas of a storey that have no floor: those without a room, all of which lie over what is open above.
fn voids(plan: &Plan<'_>, taken: &BTreeMap<usize, &ast::Room>, open: Vec<Area>) -> BTreeSet<usize> {
    let Some(rest) = plan.without(open) else {
        return BTreeSet::new();
    };
    let walks = plan.areas.walks().filter(|walk| !taken.contains_key(walk));
    walks.filter(|walk| rest.is_gone(*walk)).collect()
}

/// Returns the areas of rooms without a ceiling.
fn without_ceiling(rooms: &[Room]) -> impl Iterator<Item = Area> {
    let open = rooms.iter().filter(|r| r.ceiling == ast::RoomCeiling::None);
    open.map(|room| room.area.clone())
}

/// Returns the rooms of a storey: those that are written, then boards for what is left, so that no floor has a hole.
fn rooms_of(
    plan: &Plan<'_>,
    taken: &BTreeMap<usize, &ast::Room>,
    (own, openings, voids): (&[Fixture], &[&Fixture], &BTreeSet<usize>),
    out: &mut Diagnostics,
) -> Vec<Room> {
    let storey = plan.storey;
    let area = |fixture: &Fixture| vec![fixture.corners().to_vec()];
    let openings = openings.iter().map(|f| area(f));
    let standing = plan.without(own.iter().map(area).chain(openings.clone()).collect());
    let floor = plan.without(openings.collect());
    let stairs = own.iter().filter(|f| f.kind.climbs());
    let ceiling = plan.without(stairs.map(area).collect());
    let pieces = |rest: &Option<Rest<'_, '_>>, walk: usize| {
        let rest = rest.as_ref().filter(|rest| !rest.is_whole(walk));
        rest.map(|rest| rest.pieces(walk))
    };
    let mut named: Vec<(usize, &ast::Room)> = taken.iter().map(|(w, r)| (*w, *r)).collect();
    named.sort_by_key(|(_, room)| room.span.start);
    let mut made = vec![];
    for (walk, room) in named {
        let area = plan.areas.area(walk);
        let free = pieces(&standing, walk).map(|free| free.concat());
        let mats = mats_of(room, free.as_ref().unwrap_or(&area), out);
        let mut room = written(room, plan, area, mats);
        (room.floors, room.ceilings) = (pieces(&floor, walk), pieces(&ceiling, walk));
        made.push(room);
    }
    let left = |walk: &usize| !taken.contains_key(walk) && !voids.contains(walk);
    for walk in plan.areas.walks().filter(left) {
        let point = plan.areas.point_in(walk).filter(|p| plan.holds(*p));
        let Some(at) = point else { continue };
        let mut room = rest(storey, plan.level, at, plan.areas.area(walk));
        (room.floors, room.ceilings) = (pieces(&floor, walk), pieces(&ceiling, walk));
        made.push(room);
    }
    made
}

/// Tells of written rooms that nobody can enter.
fn unreached(
    taken: &BTreeMap<usize, &ast::Room>,
    reached: &BTreeSet<usize>,
    out: &mut Diagnostics,
) {
    let mut left: Vec<_> = taken
        .iter()
        .filter(|(walk, _)| !reached.contains(walk))
        .collect();
    left.sort_by_key(|(_, room)| room.span.start);
    for (_, room) in left {
        let name = room.name.as_ref().map(|n| n.value.as_str());
        out.push(say::no_way_in(room.span, name));
    }
}

/// Returns the rooms of a storey by the walks round them.
fn taken<'s>(plan: &Plan<'s>, out: &mut Diagnostics) -> BTreeMap<usize, &'s ast::Room> {
    let (storey, areas) = (plan.storey, &plan.areas);
    let mut taken: BTreeMap<usize, &ast::Room> = BTreeMap::new();
    for room in &storey.rooms {
        let at = dvec2(room.at.value.0, room.at.value.1);
        if areas.on_wall(at) {
            out.push(say::on_a_wall(room.at.span));
            continue;
        }
        let Some(walk) = areas.around(at).filter(|_| plan.holds(at)) else {
            out.push(say::outside(room.at.span, plan.bounds));
            continue;
        };
        if let Some(first) = taken.get(&walk) {
            let names = [*first, room].map(|r| r.name.as_ref().map(|n| n.value.as_str()));
            out.push(say::one_area(room.span, first.span, names));
            continue;
        }
        taken.insert(walk, room);
    }
    taken
}

/// An area that no room names.
fn rest(storey: &Storey, level: usize, at: DVec2, area: Vec<Vec<DVec2>>) -> Room {
    Room {
        span: storey.span,
        name: String::new(),
        storey: storey.number,
        level,
        at,
        floor: Flooring::Boards,
        ceiling: ast::RoomCeiling::Battens,
        height: None,
        area,
        floors: None,
        ceilings: None,
        mats: vec![],
    }
}

/// Lays the mats of a room; a name that says another number is told.
fn mats_of(room: &ast::Room, free: &[Vec<DVec2>], out: &mut Diagnostics) -> Vec<Mat> {
    if room.floor != Flooring::Tatami {
        return vec![];
    }
    let Some(mats) = mats::lay(free, room.mats) else {
        out.push(say::too_large_for_mats(room.span, mats::MOST_CELLS / 2));
        return vec![];
    };
    let laid: f64 = mats.iter().map(Mat::count).sum();
    let name = room.name.as_ref();
    let called = name.and_then(|n| Some((n, names::called(&n.value)?)));
    if let Some((name, called)) = called
        && (laid - called).abs() > 0.25
    {
        out.push(say::other_count(name.span, called, laid));
    }
    mats
}

fn written(room: &ast::Room, plan: &Plan<'_>, area: Vec<Vec<DVec2>>, mats: Vec<Mat>) -> Room {
    let name = room.name.as_ref();
    Room {
        span: room.span,
        name: name.map_or(String::new(), |n| n.value.clone()),
        storey: plan.storey.number,
        level: plan.level,
        at: dvec2(room.at.value.0, room.at.value.1),
        floor: room.floor,
        ceiling: room.ceiling,
        height: lower_than_storey(room.height, plan.storey),
        area,
        floors: None,
        ceilings: None,
        mats,
    }
}

/// Returns the height of a ceiling in metres; `None` = that of the storey.
fn lower_than_storey(shaku: Option<f64>, storey: &Storey) -> Option<f64> {
    let height = shaku.map(|h| h * SHAKU);
    height.filter(|h| *h < storey.z1 - storey.z0 - SAME)
}
