//! What a plan of `hsd draw` tells: walks, walls and bays with their places on paper, rooms.

use super::refused::Refused;
use super::xml::{Attributes, Element, walk};
use glam::{DVec2, dvec2};
use std::collections::BTreeMap;

/// Metres in a shaku.
const SHAKU: f64 = 10.0 / 33.0;
/// How exactly places stand on paper, millimetres.
const EXACT: f64 = 0.0016;
/// The most bays of a drawing.
const MOST: usize = 2_000_000;

/// A bay of a wall: between two places on paper, millimetres.
#[derive(Clone, Debug)]
pub(super) struct Bay {
    pub(super) code: Option<String>,
    pub(super) from: DVec2,
    pub(super) to: DVec2,
}

/// A wall: what is told of it, and its bays in the order of the walk.
#[derive(Clone, Debug)]
pub(super) struct Line {
    pub(super) told: Attributes,
    pub(super) bays: Vec<Bay>,
}

/// What is told of a room.
#[derive(Clone, Debug)]
pub(super) struct Room {
    pub(super) name: String,
    pub(super) at: String,
    pub(super) floor: String,
}

/// A closed walk, or a wall inside.
#[derive(Clone, Debug, Default)]
pub(super) struct Walk {
    pub(super) kind: String,
    pub(super) lines: Vec<Line>,
}

/// A storey of a house: its place in the house, then what is told of it.
#[derive(Clone, Debug, Default)]
pub(super) struct Level {
    pub(super) told: Attributes,
    pub(super) walks: Vec<Walk>,
    pub(super) rooms: Vec<Room>,
}

/// A house: its storeys by their place.
pub(super) type House = BTreeMap<u32, Level>;

/// The houses of a drawing.
#[derive(Clone, Debug, Default)]
pub(super) struct Drawing {
    /// Metres in a metre on paper.
    pub(super) scale: f64,
    pub(super) houses: BTreeMap<u32, House>,
}

/// Collects walls and rooms of the plans in a drawing.
pub(super) fn collect(svg: &str) -> Result<Option<Drawing>, Refused> {
    let mut drawing = Drawing::default();
    let mut count = 0;
    let (mut wall, mut seen) = (None::<(u32, u32, Line)>, std::collections::BTreeSet::new());
    walk(svg, &mut |element: &Element<'_>| {
        if element.depth() == 1 {
            drawing.scale = element
                .own("data-scale")
                .and_then(|s| s.parse().ok())
                .filter(|s: &f64| *s > 0.0 && s.is_finite())
                .unwrap_or(0.0);
        }
        let (role, house) = (element.own("data-role"), element.number("data-house"));
        let level = element.number("data-level");
        if let (Some(role), Some(house), Some(level)) = (role, house, level) {
            put(&mut drawing, wall.take());
            if role == "axis" {
                let key = (
                    element.above("data-view").unwrap_or_default().to_owned(),
                    house,
                    level,
                    element.number("data-wall"),
                );
                if !seen.insert(key) {
                    return Err(Refused::Unclear("a wall is drawn twice".to_owned()));
                }
                wall = Some((
                    house,
                    level,
                    Line {
                        told: element.attributes().clone(),
                        bays: vec![],
                    },
                ));
            } else if let Some(room) = room(element) {
                level_of(&mut drawing, house, level).rooms.push(room);
            }
        } else if element.name() == "path" && element.above("data-role") == Some("axis") {
            let Some((.., line)) = &mut wall else {
                return Ok(());
            };
            count += 1;
            line.bays.push(bay(element, count < MOST)?);
        }
        Ok(())
    })?;
    put(&mut drawing, wall);
    let is_own = drawing.scale > 0.0
        && drawing
            .houses
            .values()
            .flat_map(BTreeMap::values)
            .any(|level| !level.walks.is_empty());
    Ok(is_own.then_some(drawing))
}

/// The bay that a line of a wall draws; `in_number` says whether no more were drawn than are read.
fn bay(element: &Element<'_>, in_number: bool) -> Result<Bay, Refused> {
    let unclear = |why: &str| Refused::Unclear(why.to_owned());
    if element.is_transformed() {
        return Err(unclear(
            "a wall lies in a group that was shifted or turned (transform)",
        ));
    }
    let ends = element.own("d").and_then(ends).filter(|_| in_number);
    let (from, to) = ends.ok_or_else(|| unclear("the line of a bay is not M x yL x y"))?;
    let code = element.own("data-code").map(str::to_owned);
    Ok(Bay { code, from, to })
}

/// The room that a group names.
fn room(element: &Element<'_>) -> Option<Room> {
    let text = |key: &str| element.own(key).unwrap_or_default().to_owned();
    let name = element.own("data-room")?.to_owned();
    Some(Room {
        name,
        at: text("data-at"),
        floor: text("data-floor"),
    })
}

fn level_of(drawing: &mut Drawing, house: u32, level: u32) -> &mut Level {
    drawing
        .houses
        .entry(house)
        .or_default()
        .entry(level)
        .or_default()
}

/// Adds a wall to its walk; the first wall of a walk tells of it, and of the house.
fn put(drawing: &mut Drawing, wall: Option<(u32, u32, Line)>) {
    let Some((house, level, line)) = wall else {
        return;
    };
    let level = level_of(drawing, house, level);
    if let Some(kind) = line.told.get("data-walk") {
        level.walks.push(Walk {
            kind: kind.to_owned(),
            lines: vec![],
        });
        if level.told.is_empty() {
            level.told = line.told.clone();
        }
    }
    if let Some(last) = level.walks.last_mut().filter(|_| !line.bays.is_empty()) {
        last.lines.push(line);
    }
}

/// The ends of a path of one line.
fn ends(d: &str) -> Option<(DVec2, DVec2)> {
    let (from, to) = d.strip_prefix('M')?.split_once('L')?;
    let place = |text: &str| {
        let mut numbers = text
            .split_whitespace()
            .map(|n| n.parse::<f64>().ok().filter(|n| n.abs() < 1e6));
        let place = dvec2(numbers.next()??, numbers.next()??);
        numbers.next().is_none().then_some(place)
    };
    Some((place(from)?, place(to)?))
}

/// From places on paper to places in the plan of a house: units to the left and back.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    paper: DVec2,
    plan: DVec2,
    turn: DVec2,
    /// Units in a millimetre on paper.
    pub(super) per_mm: f64,
}

impl Frame {
    /// The frame of a walk that starts at a place in the plan; `turn` are the degrees between the fronts of this house and the
    /// first one.
    pub(super) fn new(
        drawing: &Drawing,
        unit: f64,
        turn: f64,
        (paper, plan): (DVec2, DVec2),
    ) -> Frame {
        let quarters = turn / 90.0;
        let turn = match (quarters - quarters.round()).abs() < 1e-9 {
            true => [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y]
                [(quarters.round() as i64).rem_euclid(4) as usize],
            false => dvec2(libm::cos(turn.to_radians()), libm::sin(turn.to_radians())),
        };
        Frame {
            paper,
            plan,
            turn,
            per_mm: drawing.scale / 1000.0 / (unit * SHAKU),
        }
    }

    /// Where a place on paper lies in the plan.
    pub(super) fn plan(&self, paper: DVec2) -> DVec2 {
        let off = (paper - self.paper) * self.per_mm;
        // Right and up on paper: the plan's a runs to the left.
        let off = self.turn.rotate(dvec2(off.x, -off.y));
        self.plan + dvec2(-off.x, off.y)
    }

    /// How exactly places are known, units.
    pub(super) fn exact(&self) -> f64 {
        EXACT * self.per_mm
    }
}
