//! The rooms of a storey: the areas round the points at which they are written, their mats, and whether one gets in.

use crate::ast;
use crate::ast::Flooring;
use crate::building::{House, Room, Storey};
use crate::catalog::{Catalog, Opening};
use crate::diagnostic::Diagnostics;
use crate::diagnostic::messages::plan::rooms as say;
use crate::fit::areas::{Areas, MOST};
use crate::fit::mats;
use crate::geometry::{SAME, SHAKU, holds};
use crate::program::{Content, Unit};
use glam::{DVec2, dvec2};
use std::collections::{BTreeMap, BTreeSet};

/// Works out the rooms of a house.
pub(super) fn rooms(house: &House, catalog: &Catalog, out: &mut Diagnostics) -> Vec<Room> {
    let mut made = vec![];
    for (level, storey) in house.storeys.iter().enumerate() {
        if !storey.rooms.is_empty() {
            made.extend(rooms_of(storey, level, catalog, out));
        }
    }
    made
}

fn rooms_of(storey: &Storey, level: usize, catalog: &Catalog, out: &mut Diagnostics) -> Vec<Room> {
    let first = storey.rooms[0].span;
    let Some(bounds) = bounds(storey) else {
        out.push(say::not_closed(first));
        return vec![];
    };
    let walls = storey.rings.iter().flat_map(|ring| &ring.walls);
    let walls: Vec<(DVec2, DVec2)> = walls.map(|wall| (wall.from, wall.to)).collect();
    let Some(areas) = Areas::new(&walls) else {
        out.push(say::too_many_walls(first, MOST));
        return vec![];
    };
    let taken = taken(storey, &areas, bounds, out);
    let mut named: Vec<(usize, &ast::Room)> = taken.iter().map(|(w, r)| (*w, *r)).collect();
    named.sort_by_key(|(_, room)| room.span.start);
    let mut made = vec![];
    for (walk, room) in &named {
        made.push(built(room, storey, level, areas.area(*walk), out));
    }
    // What is left has boards, so that no floor has a hole.
    for walk in areas.walks().filter(|walk| !taken.contains_key(walk)) {
        let point = areas.point_in(walk).filter(|p| is_inside(storey, *p));
        made.extend(point.map(|at| rest(storey, level, at, areas.area(walk))));
    }
    if storey.number == 1 && !named.is_empty() {
        let reached = reached(&areas, storey, catalog);
        for (_, room) in named.iter().filter(|(walk, _)| !reached.contains(walk)) {
            let name = room.name.as_ref().map(|n| n.value.as_str());
            out.push(say::no_way_in(room.span, name));
        }
    }
    made
}

/// What there is at a point of a storey.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InStorey {
    /// A wall.
    Wall,
    /// Nothing: it is outside, in a courtyard, or walls do not close.
    Outside,
    /// The area of a room, by its number among those of the storey.
    Room(usize),
    /// An area without a room.
    Free,
}

/// Returns what there is at a point of a storey.
pub(super) fn in_storey(storey: &Storey, at: DVec2) -> InStorey {
    let walls = storey.rings.iter().flat_map(|ring| &ring.walls);
    let walls: Vec<(DVec2, DVec2)> = walls.map(|wall| (wall.from, wall.to)).collect();
    let areas = bounds(storey).and_then(|_| Areas::new(&walls));
    let Some(areas) = areas else {
        return InStorey::Outside;
    };
    let around = |p: DVec2| {
        let there = !areas.on_wall(p) && is_inside(storey, p);
        areas.around(p).filter(|_| there)
    };
    if areas.on_wall(at) {
        return InStorey::Wall;
    }
    let Some(walk) = around(at) else {
        return InStorey::Outside;
    };
    let mut rooms = storey.rooms.iter();
    let own = rooms.position(|r| around(r.at.value.into()) == Some(walk));
    own.map_or(InStorey::Free, InStorey::Room)
}

/// Returns the rooms of a storey by the walks round them.
fn taken<'s>(
    storey: &'s Storey,
    areas: &Areas,
    bounds: [DVec2; 2],
    out: &mut Diagnostics,
) -> BTreeMap<usize, &'s ast::Room> {
    let mut taken: BTreeMap<usize, &ast::Room> = BTreeMap::new();
    for room in &storey.rooms {
        let at = dvec2(room.at.value.0, room.at.value.1);
        if areas.on_wall(at) {
            out.push(say::on_a_wall(room.at.span));
            continue;
        }
        let Some(walk) = areas.around(at).filter(|_| is_inside(storey, at)) else {
            out.push(say::outside(room.at.span, bounds));
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
        mats: vec![],
    }
}

/// Returns true for a point within the outer walls and in no courtyard.
fn is_inside(storey: &Storey, p: DVec2) -> bool {
    let closed = storey.rings.iter().filter(|r| r.closed && !r.inner);
    let around = closed.filter(|r| holds(&r.corners(), p));
    let (mut solid, mut court) = (false, false);
    for ring in around {
        (solid, court) = (solid || !ring.hole, court || ring.hole);
    }
    solid && !court
}

/// Returns the bounds of the outer walls, U; none where they, or those of a courtyard, do not close.
fn bounds(storey: &Storey) -> Option<[DVec2; 2]> {
    let rings = || storey.rings.iter().filter(|r| !r.inner);
    let corners = rings().flat_map(|r| &r.walls).map(|w| w.from);
    let around = corners.fold(None, |around: Option<[DVec2; 2]>, p| {
        let [low, high] = around.unwrap_or([p, p]);
        Some([low.min(p), high.max(p)])
    });
    around.filter(|_| rings().all(|r| r.closed))
}

fn built(
    room: &ast::Room,
    storey: &Storey,
    level: usize,
    area: Vec<Vec<DVec2>>,
    out: &mut Diagnostics,
) -> Room {
    let mats = match room.floor {
        Flooring::Tatami => mats::lay(&area, room.mats),
        Flooring::Boards | Flooring::Earth => Some(vec![]),
    };
    if mats.is_none() {
        out.push(say::too_large_for_mats(room.span, mats::MOST_CELLS / 2));
    }
    let height = room.height.map(|h| h * SHAKU);
    let made = Room {
        span: room.span,
        name: room
            .name
            .as_ref()
            .map_or(String::new(), |n| n.value.clone()),
        storey: storey.number,
        level,
        at: dvec2(room.at.value.0, room.at.value.1),
        floor: room.floor,
        ceiling: room.ceiling,
        height: height.filter(|h| *h < storey.z1 - storey.z0 - SAME),
        area,
        mats: mats.unwrap_or_default(),
    };
    let called = room
        .name
        .as_ref()
        .and_then(|n| Some((n, called(&n.value)?)));
    if let Some((name, called)) = called
        && room.floor == Flooring::Tatami
        && (made.mat_count() - called).abs() > 0.25
    {
        out.push(say::other_count(name.span, called, made.mat_count()));
    }
    made
}

/// Returns the number of mats in a name: 八畳, 四畳半, 8 mats.
fn called(name: &str) -> Option<f64> {
    let at = ["畳", "帖", "mat", "-mat", "jo"]
        .iter()
        .find_map(|word| name.find(word))?;
    let half = name[at..].chars().nth(1) == Some('半');
    let digit = |c: char| match c {
        '0'..='9' | '.' => Some(c),
        '０'..='９' => char::from_digit(u32::from(c) - u32::from('０'), 10),
        _ => None,
    };
    let before = name[..at].trim_end_matches([' ', '\u{3000}', '-']);
    let tail = |is: &dyn Fn(char) -> bool| {
        let start = before
            .char_indices()
            .rev()
            .take_while(|(_, c)| is(*c))
            .last();
        start.map(|(i, _)| &before[i..])
    };
    let number = match tail(&|c| digit(c).is_some()) {
        Some(text) => text
            .chars()
            .filter_map(digit)
            .collect::<String>()
            .parse()
            .ok()?,
        None => kanji(tail(&|c| KANJI.contains(c) || c == '十')?)?,
    };
    Some(number + if half { 0.5 } else { 0.0 })
}

const KANJI: &str = "一二三四五六七八九";

/// Returns a number below a hundred that is written in kanji.
fn kanji(text: &str) -> Option<f64> {
    let digit = |c: char| KANJI.chars().position(|k| k == c).map(|i| i as f64 + 1.0);
    let one = |text: &str, empty: f64| {
        let mut chars = text.chars();
        match (chars.next(), chars.next()) {
            (None, _) => Some(empty),
            (Some(c), None) => digit(c),
            _ => None,
        }
    };
    match text.split_once('十') {
        Some((tens, ones)) => Some(one(tens, 1.0)? * 10.0 + one(ones, 0.0)?),
        None => one(text, 0.0),
    }
}

/// Returns the areas of a ground storey that one can walk into from outside, courtyards included.
fn reached(areas: &Areas, storey: &Storey, catalog: &Catalog) -> BTreeSet<usize> {
    let mut ways: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    let outdoors = |walk: usize| match walk {
        Areas::OUTSIDE => true,
        walk => !areas.point_in(walk).is_some_and(|p| is_inside(storey, p)),
    };
    let walls = storey.rings.iter().flat_map(|ring| &ring.walls);
    for (number, wall) in walls.enumerate() {
        let mut at = wall.from;
        for unit in &wall.units {
            let middle = at + wall.direction * (unit.width / 2.0);
            at += wall.direction * unit.width;
            if unit.width < SAME || !is_way(unit, catalog) {
                continue;
            }
            let ends = (wall.from, wall.to);
            if let Some([one, other]) = areas.beside(number, ends, middle) {
                ways.entry(one).or_default().push(other);
                ways.entry(other).or_default().push(one);
            }
        }
    }
    let mut reached: BTreeSet<usize> = BTreeSet::new();
    let mut next: Vec<usize> = ways
        .keys()
        .copied()
        .filter(|walk| outdoors(*walk))
        .collect();
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

#[cfg(test)]
mod tests {
    use super::called;

    #[test]
    fn names_tell_the_number_of_mats() {
        for (name, mats) in [
            ("八畳", Some(8.0)),
            ("四畳半", Some(4.5)),
            ("座敷(十二畳)", Some(12.0)),
            ("二十一畳の間", Some(21.0)),
            ("６畳", Some(6.0)),
            ("4.5 mats", Some(4.5)),
            ("8-mat room", Some(8.0)),
            ("座敷", None),
            ("matsu", None),
            ("畳", None),
        ] {
            assert_eq!(called(name), mats, "{name}");
        }
    }
}
