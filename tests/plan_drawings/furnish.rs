//! What stands in the rooms: stairs, alcoves, closets, stoves, wells, hearths, privies.

use super::rng::Rng;
use super::truth::{Area, Fixture, Floor, Furnishing, Kind, Point, RoomTruth, Unit};
use std::collections::BTreeMap;

/// Furnish the rooms; nothing stands before a door.
pub fn furnish(rooms: &[RoomTruth], walls: &[Unit], rng: &mut Rng) -> Vec<Fixture> {
    let closed = closed_sides(walls);
    let mut out = Vec::new();
    for room in rooms {
        for (what, size, share) in wishes(room) {
            if !rng.chance(share) {
                continue;
            }
            if let Some(area) = place(room, size, what, &closed, &out, rng) {
                out.push(Fixture { what, area });
            }
        }
    }
    out
}

/// Whether the edge between two grid points is plain wall, keyed by its lower end and direction.
fn closed_sides(walls: &[Unit]) -> BTreeMap<(Point, bool), bool> {
    walls
        .iter()
        .map(|u| ((u.from.min(u.to), u.from.1 == u.to.1), u.kind == Kind::Wall))
        .collect()
}

fn wishes(room: &RoomTruth) -> Vec<(Furnishing, Point, f32)> {
    use Furnishing::*;
    let cells = room.area.width() * room.area.depth();
    match room.floor {
        Floor::Earth => vec![
            (Stove, (1, 2), 0.5),
            (Stove, (2, 1), 0.2),
            (Well, (1, 1), 0.45),
            (Stairs, (1, 3), 0.2),
        ],
        Floor::Tatami if cells >= 12 => vec![
            (Alcove, (2, 1), 0.45),
            (Closet, (2, 1), 0.35),
            (Hearth, (1, 1), 0.1),
        ],
        Floor::Tatami => vec![(Closet, (2, 1), 0.25), (Stairs, (1, 3), 0.2)],
        Floor::Board if cells <= 2 => vec![(Privy, (1, 1), 0.35), (Closet, (2, 1), 0.4)],
        Floor::Board => vec![
            (Stairs, (1, 3), 0.4),
            (Hearth, (1, 1), 0.25),
            (Closet, (2, 1), 0.3),
        ],
        Floor::Veranda => vec![],
    }
}

/// A place along a closed wall, turned either way, clear of doors and of other things.
fn place(
    room: &RoomTruth,
    size: Point,
    what: Furnishing,
    closed: &BTreeMap<(Point, bool), bool>,
    others: &[Fixture],
    rng: &mut Rng,
) -> Option<Area> {
    let free_standing = matches!(what, Furnishing::Hearth | Furnishing::Well);
    let mut choices = Vec::new();
    for (w, d) in [size, (size.1, size.0)] {
        for b in room.area.from.1..=room.area.to.1 - d {
            for a in room.area.from.0..=room.area.to.0 - w {
                let area = Area {
                    from: (a, b),
                    to: (a + w, b + d),
                };
                let clear = others.iter().all(|other| !overlaps(&other.area, &area));
                let (walls, doors) = around(&area, closed);
                let privy = what == Furnishing::Privy;
                if clear && (privy || doors == 0) && (free_standing || walls >= w.max(d)) {
                    choices.push(area);
                }
            }
        }
    }
    (!choices.is_empty()).then(|| rng.pick(&choices))
}

fn overlaps(one: &Area, two: &Area) -> bool {
    one.from.0 < two.to.0 && two.from.0 < one.to.0 && one.from.1 < two.to.1 && two.from.1 < one.to.1
}

/// How many units of plain wall and of openings bound an area.
fn around(area: &Area, closed: &BTreeMap<(Point, bool), bool>) -> (i32, i32) {
    let across =
        (area.from.0..area.to.0).flat_map(|a| [((a, area.from.1), true), ((a, area.to.1), true)]);
    let back =
        (area.from.1..area.to.1).flat_map(|b| [((area.from.0, b), false), ((area.to.0, b), false)]);
    across
        .chain(back)
        .fold((0, 0), |(walls, doors), key| match closed.get(&key) {
            Some(true) => (walls + 1, doors),
            Some(false) => (walls, doors + 1),
            None => (walls, doors),
        })
}
