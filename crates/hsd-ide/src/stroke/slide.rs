//! Strokes that move walls: the rings they change, and the roofs that follow.

use super::change::{Change, tidy};
use super::draft::Draft;
use super::walls::{FARTHEST, outward};
use super::write;
use super::{Storeys, WallAt, find, refuse, roofs};
use crate::format::Edit;
use crate::stroke::sheet::{Reason, Sheet};
use crate::stroke::storeys::{doubts, inner};
use glam::DVec2;
use hsd_base::diagnostic::Text;
use hsd_base::geometry::SAME;
use hsd_ir::building::House;

/// Redraws a ring.
type Draw<'a> = &'a dyn Fn(&mut Draft, usize) -> Result<(), Text>;

/// Slides a wall.
pub(super) fn slide(
    sheet: &Sheet<'_>,
    at: WallAt,
    by: i32,
    storeys: Storeys,
) -> Result<Vec<Edit>, Text> {
    check_way(by)?;
    let (house, _, ring) = find::ring(sheet, at)?;
    if ring.is_lone_wall() {
        let way = outward(ring.walls[at.wall].direction) * f64::from(by);
        let mut edits = inner::shift(sheet, at, way)?;
        edits.extend(doubts::shifted(sheet, at, way));
        return Ok(tidy(edits));
    }
    let mut walls = vec![at];
    if storeys == Storeys::All {
        walls.extend(aligned(house, at));
    }
    let (mut edits, moved) = drawn(sheet, house, &walls, &|draft, wall| draft.slide(wall, by))?;
    edits.extend(roofs::follow(sheet, house, &moved));
    let way = outward(ring.walls[at.wall].direction) * f64::from(by);
    edits.extend(doubts::shifted(sheet, at, way));
    Ok(tidy(edits))
}

/// Pushes a part of a wall out or in. Roofs stay: a bay is roofed by itself or stands under the eaves.
pub(super) fn break_out(
    sheet: &Sheet<'_>,
    at: WallAt,
    part: (u32, u32),
    by: i32,
) -> Result<Vec<Edit>, Text> {
    check_way(by)?;
    let (house, _, ring) = find::ring(sheet, at)?;
    let (from, to) = (f64::from(part.0), f64::from(part.1));
    let whole = ring.walls.get(at.wall).is_some_and(|wall| {
        let length = wall.from.distance(wall.to);
        from < SAME && to > length - SAME
    });
    if whole {
        return slide(sheet, at, by, Storeys::One);
    }
    let draw = |draft: &mut Draft, wall| draft.break_out(wall, from, to, by);
    let (edits, _) = drawn(sheet, house, &[at], &draw)?;
    Ok(tidy(edits))
}

fn check_way(by: i32) -> Result<(), Text> {
    match by.unsigned_abs() {
        0 => Err(refuse::nothing()),
        n if n > FARTHEST.unsigned_abs() => Err(refuse::too_far()),
        _ => Ok(()),
    }
}

/// Returns the walls of other storeys directly above or below a wall.
fn aligned(house: &House, at: WallAt) -> Vec<WallAt> {
    let own = &house.storeys[at.storey].rings[at.ring].walls[at.wall];
    let normal = outward(own.direction);
    let mut found = vec![];
    for (storey, other) in house
        .storeys
        .iter()
        .enumerate()
        .filter(|(s, _)| *s != at.storey)
    {
        for (ring, other) in other.rings.iter().enumerate() {
            let beside = |w: &hsd_ir::building::Wall| {
                let level = (w.from - own.from).dot(normal).abs() < SAME;
                let (from, to) = (
                    (w.from - own.from).dot(own.direction),
                    (w.to - own.from).dot(own.direction),
                );
                let overlaps = to > SAME && from < own.from.distance(own.to) - SAME;
                level && overlaps && w.direction.distance(own.direction) < SAME
            };
            // One wall per ring: a second one moves with the next stroke.
            if let Some(wall) = other.walls.iter().position(beside) {
                let house = at.house;
                found.push(WallAt {
                    house,
                    storey,
                    ring,
                    wall,
                });
            }
        }
    }
    found
}

/// Rings with their new corners.
type Moved = Vec<(WallAt, Vec<DVec2>)>;

/// Returns the edits of some walls, each of a ring of its own, and the resulting rings.
fn drawn(
    sheet: &Sheet<'_>,
    house: &House,
    walls: &[WallAt],
    draw: Draw<'_>,
) -> Result<(Vec<Edit>, Moved), Text> {
    let mut edits = vec![];
    let mut moved = vec![];
    for at in walls {
        let storey = &house.storeys[at.storey];
        let ring = &storey.rings[at.ring];
        if ring.is_lone_wall() {
            return Err(Reason::Open.text());
        }
        let rows = sheet.rows(ring);
        if let Some(reason) = sheet.ring_fixed(ring, &rows, at.wall) {
            return Err(reason.text());
        }
        let mut draft = Draft::of(ring, &rows);
        draw(&mut draft, at.wall)?;
        draft.check(at.ring, storey)?;
        let change = Change {
            sheet,
            ring,
            rows: &rows,
            draft: &draft,
        };
        edits.extend(write::edits(&change)?);
        moved.push((*at, draft.corners()));
    }
    Ok((edits, moved))
}
