//! The rooms of a plan: the edges of mats, names, numbers of mats.

use crate::Settings;
use crate::dimension::short;
use crate::paper::{Anchor, Facts, Mark, Role, Shape};
use crate::subject::Subject;
use glam::{DVec2, dvec2};
use hsd_base::diagnostic::{Language, visible};
use hsd_base::geometry::in_rings;
use hsd_ir::ast::Flooring;
use hsd_ir::building::{Mat, Room};
use std::collections::BTreeSet;
use std::sync::Arc;

/// The height of names, millimetres.
const NAME: f64 = 2.5;

/// The height of numbers of mats, and how far they stand below a name, millimetres.
const COUNT: (f64, f64) = (2.0, 3.2);

/// The room around a name in which no edge of a mat is drawn, millimetres.
const CLEAR: f64 = 0.5;

/// Returns the edges of mats, and the names of rooms with their numbers of mats.
pub(super) fn rooms(subject: &Subject<'_>, number: u32, settings: &Settings) -> Vec<Mark> {
    let scale = settings.millimetres();
    let mut marks = vec![];
    for (k, built) in subject.houses.iter().enumerate() {
        let place = |p: DVec2| subject.plan_point(&built.house, p) * scale;
        for room in built.rooms.iter().filter(|r| r.storey == number) {
            let mats: Vec<[DVec2; 4]> = room.mats.iter().map(|m| corners(m).map(place)).collect();
            let at = place(middle(room));
            let facts = Arc::new(told(k, room));
            let (mut lines, mut names) = (sides(&mats), vec![]);
            let mut line = |down: f64, size: f64, text: String| {
                let at = at - dvec2(0.0, down);
                lines = lines
                    .iter()
                    .flat_map(|l| beside(*l, around(at, size, &text)))
                    .collect();
                names.push(Mark::label(Role::Text, at, size, Anchor::Middle, text));
            };
            if !room.name.is_empty() {
                line(0.0, NAME, visible::line(&room.name));
            }
            if !room.mats.is_empty() {
                let count = room.mat_count();
                let words = match settings.language {
                    Language::English => format!("{count} mats"),
                    Language::Japanese => format!("{count}畳"),
                };
                line(COUNT.1, COUNT.0, words);
            }
            if !lines.is_empty() {
                marks.push(Mark::new(Role::Mat, Shape::Lines(lines)));
            }
            marks.extend(names.into_iter().map(|name| name.telling(&facts)));
        }
    }
    marks
}

/// The attributes of a room: its house, level, name, point (units) and floor.
fn told(house: usize, room: &Room) -> Facts {
    let floor = Flooring::ALL.iter().find(|(_, f)| *f == room.floor);
    vec![
        ("house", house.to_string()),
        ("level", room.level.to_string()),
        ("room", room.name.clone()),
        (
            "at",
            format!("{} {}", short(room.at.x, 6), short(room.at.y, 6)),
        ),
        ("floor", floor.map_or("", |f| f.0).to_owned()),
    ]
}

/// The box that a name takes, with room around it: letters of Japanese are as wide as high, others about half as wide.
fn around(at: DVec2, size: f64, text: &str) -> [DVec2; 2] {
    let wide: f64 = text
        .chars()
        .map(|c| if c.is_ascii() { 0.6 } else { 1.0 })
        .sum();
    let half = wide * size / 2.0 + CLEAR;
    [
        at - dvec2(half, 0.2 * size + CLEAR),
        at + dvec2(half, 0.9 * size + CLEAR),
    ]
}

/// Returns what of a line lies outside of a box, so that no line runs through a name in any kind of file.
fn beside([p, q]: [DVec2; 2], [low, high]: [DVec2; 2]) -> Vec<[DVec2; 2]> {
    let way = q - p;
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        if way[axis].abs() < 1e-9 {
            if p[axis] <= low[axis] || p[axis] >= high[axis] {
                return vec![[p, q]];
            }
            continue;
        }
        let (one, two) = (
            (low[axis] - p[axis]) / way[axis],
            (high[axis] - p[axis]) / way[axis],
        );
        enter = enter.max(one.min(two));
        leave = leave.min(one.max(two));
    }
    if enter >= leave {
        return vec![[p, q]];
    }
    let mut left = vec![];
    if enter > 0.0 {
        left.push([p, p + way * enter]);
    }
    if leave < 1.0 {
        left.push([p + way * leave, q]);
    }
    left
}

fn corners(mat: &Mat) -> [DVec2; 4] {
    let (low, high) = (mat.low, mat.high);
    [low, dvec2(high.x, low.y), high, dvec2(low.x, high.y)]
}

/// Where the name of a room stands: its middle, or the author's point where that lies outside.
fn middle(room: &Room) -> DVec2 {
    let corners = || room.area.iter().flatten().copied();
    let low = corners().reduce(DVec2::min).unwrap_or(room.at);
    let high = corners().reduce(DVec2::max).unwrap_or(room.at);
    let middle = (low + high) / 2.0;
    if in_rings(&room.area, middle) {
        middle
    } else {
        room.at
    }
}

/// Returns the sides of mats, those that two share once.
fn sides(mats: &[[DVec2; 4]]) -> Vec<[DVec2; 2]> {
    let step = |p: DVec2| ((p.x * 1e4).round() as i64, (p.y * 1e4).round() as i64);
    let mut known = BTreeSet::new();
    let sides = mats
        .iter()
        .flat_map(|m| (0..4).map(|i| [m[i], m[(i + 1) % 4]]));
    let new = |[p, q]: &[DVec2; 2]| {
        let (p, q) = (step(*p), step(*q));
        known.insert((p.min(q), p.max(q)))
    };
    sides.filter(new).collect()
}
