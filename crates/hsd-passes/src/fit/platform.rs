//! The stone platform under a house, and the stairs up to it.

use super::around::{facing, moved, outline};
use super::rings;
use glam::{DVec2, dvec2};
use hsd_base::geometry::{SHAKU, holds};
use hsd_ir::ast;
use hsd_ir::building::fittings::{Platform, Stairs};
use hsd_ir::building::{House, Storey};

/// Returns the platform under the largest ring of the ground storey; `None` if no ring is closed.
pub(super) fn platform(
    house: &House,
    ground: &Storey,
    written: &ast::Platform,
) -> Option<Platform> {
    let all = rings(ground).map(|r| outline(house, r));
    let area = |points: &Vec<DVec2>| hsd_base::geometry::area2(points);
    let walls = all.reduce(|a, b| if area(&b) > area(&a) { b } else { a })?;
    let [across, deep] = written.margin;
    let outline = moved(&walls, dvec2(across, deep) * SHAKU);
    let z = (-house.raised, written.height * SHAKU - house.raised);
    let stairs = written.stairs.iter().filter_map(|side| {
        let way = side.outward();
        let width = written.width.map(|w| w * SHAKU);
        let width = width.unwrap_or_else(|| middle_bay(house, ground, *side));
        flight(&outline, dvec2(-way.x, way.y), width, z)
    });
    let stairs = stairs.collect();
    Some(Platform { outline, z, stairs })
}

/// Returns a flight of stairs up to the middle of the side of an outline that faces this way.
pub(super) fn flight(outline: &[DVec2], way: DVec2, width: f64, z: (f64, f64)) -> Option<Stairs> {
    let (p, q) = facing(outline, way)?;
    let along = (q - p).normalize_or_zero();
    let width = width.min(p.distance(q));
    (z.1 - z.0 > 0.05 && width > 0.3).then(|| Stairs {
        at: (p + q) / 2.0,
        out: dvec2(along.y, -along.x),
        width,
        z,
    })
}

/// Gives the flights of a veranda something to stand on: one that ends on the platform stays; one that would end beyond
/// the platform's edge goes on down to the ground, and takes the place of the platform's own stairs where they would
/// stand in each other.
pub(super) fn stand<'a>(flights: impl Iterator<Item = &'a mut Stairs>, platform: &mut Platform) {
    for flight in flights {
        let [_, _, right, left] = flight.plan();
        let on = |p: DVec2| holds(&platform.outline, p);
        if on(right) && on(left) {
            continue;
        }
        flight.z.0 = platform.z.0;
        platform.stairs.retain(|own| !meet(own, flight));
    }
}

/// Returns true if two flights that lead the same way share some of their width.
fn meet(a: &Stairs, b: &Stairs) -> bool {
    let side = dvec2(-b.out.y, b.out.x);
    a.out.dot(b.out) > 0.7 && (a.at - b.at).dot(side).abs() < (a.width + b.width) / 2.0
}

/// Returns the width of the bay in the middle of the walls on one side, metres.
pub(super) fn middle_bay(house: &House, storey: &Storey, side: ast::Side) -> f64 {
    let walls = rings(storey).flat_map(|r| &r.walls);
    let out = |w: &hsd_ir::building::Wall| dvec2(w.direction.y, -w.direction.x);
    let facing = walls.filter(|w| out(w).dot(side.outward()) > 0.7);
    let length = |w: &hsd_ir::building::Wall| w.from.distance(w.to);
    let longest = facing.reduce(|a, b| if length(b) > length(a) { b } else { a });
    let Some(wall) = longest else {
        return house.unit;
    };
    let middle = length(wall) / 2.0;
    let mut at = 0.0;
    let bay = wall.units.iter().find(|u| {
        at += u.width;
        u.width > 0.0 && at >= middle - 1e-6
    });
    bay.map_or(house.unit, |u| u.width * house.unit)
}
