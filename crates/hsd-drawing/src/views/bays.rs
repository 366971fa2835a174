//! The bays of a plan, and what a reader of the drawing needs to write the house again.

use crate::Settings;
use crate::dimension::short;
use crate::paper::{Facts, Mark, Role, Shape};
use crate::subject::Subject;
use hsd_base::geometry::SHAKU;
use hsd_ir::ast::StoreyKind;
use hsd_ir::building::{Built, House, Ring, Storey, Wall};
use std::sync::Arc;

/// Returns a line for each bay of a storey with the code of its part, along the middle of the wall: what a reader of the
/// drawing takes for the plan. The line is as long as the bay; parts without width are lines without length, open bays have
/// no code. Walls come as they are walked, each with its walk.
pub(super) fn bays(subject: &Subject<'_>, number: u32, settings: &Settings) -> Vec<Mark> {
    let scale = settings.millimetres();
    let mut marks = vec![];
    for (k, built) in subject.houses.iter().enumerate() {
        let house = &built.house;
        for (level, storey) in house
            .storeys
            .iter()
            .enumerate()
            .filter(|(_, s)| s.number == number)
        {
            let mut wall = 0;
            for ring in &storey.rings {
                for (i, line) in ring.walls.iter().enumerate() {
                    wall += 1;
                    let mut facts = vec![
                        ("house", k.to_string()),
                        ("level", level.to_string()),
                        ("wall", wall.to_string()),
                    ];
                    if i == 0 {
                        facts.extend(walk(ring, line));
                        facts.extend(home(built, storey));
                    }
                    marks.extend(along(subject, house, line, scale, &Arc::new(facts)));
                }
            }
        }
    }
    marks
}

/// The bays of a wall.
fn along(
    subject: &Subject<'_>,
    house: &House,
    wall: &Wall,
    scale: f64,
    facts: &Arc<Facts>,
) -> Vec<Mark> {
    let mut at = wall.from;
    let bay = |unit: &hsd_ir::program::Unit| {
        let to = at + wall.direction * unit.width;
        let line = [at, to].map(|p| subject.plan_point(house, p) * scale);
        at = to;
        Mark {
            role: Role::Axis,
            code: subject.code_of(unit),
            facts: Some(facts.clone()),
            shape: Shape::Lines(vec![line]),
        }
    };
    wall.units.iter().map(bay).collect()
}

/// The attributes of a walk: what it goes round, and where it starts.
fn walk(ring: &Ring, first: &Wall) -> Facts {
    let kind = match (ring.inner, ring.hole, ring.closed) {
        (true, ..) => "inner",
        (_, true, _) => "court",
        (_, _, true) => "outline",
        _ => "open",
    };
    let start = format!("{} {}", short(first.from.x, 6), short(first.from.y, 6));
    vec![("walk", kind.to_owned()), ("start", start)]
}

/// The attributes of a house and a storey: name, unit in shaku, its place in metres east, north and up with the azimuth of its
/// front, the height of the storey in shaku.
fn home(built: &Built, storey: &Storey) -> Facts {
    let house = &built.house;
    let [east, north, up] = house.origin;
    let place = [east, north, up - house.raised, house.azimuth].map(|x| short(x, 6));
    let mut facts = vec![
        ("name", house.name.clone()),
        ("unit", short(house.unit / SHAKU, 6)),
        ("place", place.join(" ")),
        ("height", short((storey.z1 - storey.z0) / SHAKU, 6)),
    ];
    if house.street {
        facts.push(("street", "yes".to_owned()));
    }
    if storey.kind == StoreyKind::Parapet {
        facts.push(("kind", "parapet".to_owned()));
    }
    facts
}
