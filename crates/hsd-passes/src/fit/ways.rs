//! Where one gets to in a storey: through doors and open bays from outside, and up the stairs.

use crate::fit::areas::Areas;
use crate::fit::plan::Plan;
use hsd_base::geometry::SAME;
use hsd_ir::building::Fixture;
use hsd_ir::catalog::{Catalog, Opening};
use hsd_ir::program::{Content, Unit};
use std::collections::{BTreeMap, BTreeSet};

/// Returns the areas of a ground storey that one can walk into from outside, courtyards included.
pub(super) fn from_outside(plan: &Plan<'_>, catalog: &Catalog) -> BTreeSet<usize> {
    let ways = ways(plan, catalog);
    let outdoors = |walk: usize| match walk {
        Areas::OUTSIDE => true,
        walk => !plan.areas.point_in(walk).is_some_and(|p| plan.holds(p)),
    };
    let starts = ways.keys().copied().filter(|walk| outdoors(*walk));
    follow(starts.collect(), &ways)
}

/// Returns the areas of a storey that one can walk into from stairs; each comes with what is reached of the storey below.
pub(super) fn from_stairs<'f>(
    plan: &Plan<'_>,
    stairs: impl Iterator<Item = &'f Fixture>,
    (below, reached): (&Plan<'_>, &BTreeSet<usize>),
    catalog: &Catalog,
) -> BTreeSet<usize> {
    let is_reached = |stairs: &&Fixture| {
        let foot = below.areas.around(stairs.middle());
        foot.is_some_and(|walk| reached.contains(&walk))
    };
    let tops = stairs.filter(is_reached).map(Plan::landing);
    let starts = tops.filter_map(|p| plan.areas.around(p)).collect();
    follow(starts, &ways(plan, catalog))
}

/// Returns the areas beside each area that a door or an open bay leads to.
fn ways(plan: &Plan<'_>, catalog: &Catalog) -> BTreeMap<usize, Vec<usize>> {
    let mut ways: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    let walls = plan.storey.rings.iter().flat_map(|ring| &ring.walls);
    for (number, wall) in walls.enumerate() {
        let mut at = wall.from;
        for unit in &wall.units {
            let middle = at + wall.direction * (unit.width / 2.0);
            at += wall.direction * unit.width;
            if unit.width < SAME || !is_way(unit, catalog) {
                continue;
            }
            let ends = (wall.from, wall.to);
            if let Some([one, other]) = plan.areas.beside(number, ends, middle) {
                ways.entry(one).or_default().push(other);
                ways.entry(other).or_default().push(one);
            }
        }
    }
    ways
}

fn follow(mut next: Vec<usize>, ways: &BTreeMap<usize, Vec<usize>>) -> BTreeSet<usize> {
    let mut reached = BTreeSet::new();
    while let Some(walk) = next.pop() {
        if reached.insert(walk) {
            next.extend(ways.get(&walk).into_iter().flatten());
        }
    }
    reached
}

/// Returns true if one can walk through a unit.
fn is_way(unit: &Unit, catalog: &Catalog) -> bool {
    match &unit.content {
        Content::Void => true,
        Content::Part(id) => {
            let part = catalog.part(*id);
            part.is_open() || part.opening() == Some(Opening::Door)
        }
        Content::Picture(_) => false,
        Content::Split(split) => split.lower.iter().any(|unit| is_way(unit, catalog)),
    }
}
