//! Strokes that add, change and remove rooms.

use super::element::{added, fixed, one_of, own_element, removed, rewritten};
use crate::format::Edit;
use crate::stroke::StoreyAt;
use crate::stroke::find;
use crate::stroke::refuse;
use crate::stroke::sheet::{Reason, Sheet};
use crate::stroke::xml::plain;
use glam::{DVec2, dvec2};
use hsd_base::diagnostic::Text;
use hsd_ir::ast::{Flooring, MatOrder, Room, RoomCeiling};
use hsd_ir::building::Storey;
use hsd_passes::fit::{InStorey, in_storey};
use serde::Deserialize;
use std::ops::RangeInclusive;

/// What a stroke writes about a room; what it leaves out stays as it is.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
pub struct RoomWords {
    /// Its name; an empty one removes it.
    #[serde(default)]
    pub name: Option<String>,
    /// A point in it, U.
    #[serde(default)]
    pub at: Option<[f64; 2]>,
    /// `boards`, `tatami` or `earth`.
    #[serde(default)]
    pub floor: Option<String>,
    /// `festive` or `rows`.
    #[serde(default)]
    pub mats: Option<String>,
    /// `battens`, `joists` or `none`.
    #[serde(default)]
    pub ceiling: Option<String>,
    /// From the floor to the ceiling, shaku; 0 for that of the storey.
    #[serde(default)]
    pub height: Option<f64>,
}

/// Adds a room at a point.
pub(in crate::stroke) fn add(
    sheet: &Sheet<'_>,
    at: StoreyAt,
    words: &RoomWords,
) -> Result<Vec<Edit>, Text> {
    let (_, level) = find::storey(sheet, at.house, at.storey)?;
    free(level, words.at.ok_or_else(refuse::no_such_place)?, None)?;
    added(sheet, level, "Room", written(words)?, usual)
}

/// Changes a room.
pub(in crate::stroke) fn change(
    sheet: &Sheet<'_>,
    at: StoreyAt,
    number: usize,
    words: &RoomWords,
) -> Result<Vec<Edit>, Text> {
    let (_, level) = find::storey(sheet, at.house, at.storey)?;
    let element = element(sheet, level, number)?;
    if let Some(to) = words.at {
        free(level, to, Some(number))?;
    }
    rewritten(sheet, element, written(words)?, usual)
}

/// Removes a room; the area stays, and has boards.
pub(in crate::stroke) fn remove(
    sheet: &Sheet<'_>,
    at: StoreyAt,
    number: usize,
) -> Result<Vec<Edit>, Text> {
    let (_, level) = find::storey(sheet, at.house, at.storey)?;
    Ok(removed(sheet, element(sheet, level, number)?))
}

/// Returns the reason why no stroke can change a room.
pub(crate) fn room_fixed(sheet: &Sheet<'_>, room: &Room) -> Option<Reason> {
    fixed(sheet, room.span, "Room")
}

fn element(sheet: &Sheet<'_>, storey: &Storey, number: usize) -> Result<usize, Text> {
    let room = storey.rooms.get(number).ok_or_else(refuse::no_such_place)?;
    own_element(sheet, room.span, "Room")
}

/// Checks that a point is in an area without a room, or in that of the room itself.
fn free(storey: &Storey, at: [f64; 2], own: Option<usize>) -> Result<(), Text> {
    let at = DVec2::from(at);
    if !at.is_finite() || at.abs().max_element() > 1e6 {
        return Err(refuse::too_far());
    }
    match in_storey(storey, at) {
        InStorey::Free => Ok(()),
        InStorey::Room(number) if Some(number) == own => Ok(()),
        InStorey::Room(number) => {
            let name = storey.rooms[number].name.as_ref();
            Err(refuse::another_room(name.map_or("", |n| &n.value)))
        }
        InStorey::Wall => Err(refuse::on_a_wall()),
        InStorey::Outside => Err(refuse::no_area()),
    }
}

/// Returns attributes with their values as they are written.
fn written(words: &RoomWords) -> Result<Vec<(&'static str, String)>, Text> {
    let mut all = vec![];
    if let Some(name) = &words.name {
        let name = name.trim();
        let odd = |c: char| c.is_control() || matches!(c, '{' | '}');
        if name.contains(odd) || name.chars().count() > LONGEST_NAME {
            return Err(refuse::odd_name(LONGEST_NAME));
        }
        all.push(("name", escaped(name)));
    }
    if let Some([a, b]) = words.at {
        let at = dvec2(a, b);
        all.push(("at", format!("{} {}", plain(at.x), plain(at.y))));
    }
    let floors = Flooring::ALL.map(|(word, _)| word);
    let orders = MatOrder::ALL.map(|(word, _)| word);
    let ceilings = RoomCeiling::ALL.map(|(word, _)| word);
    for (word, value, known) in [
        ("floor", &words.floor, &floors[..]),
        ("mats", &words.mats, &orders[..]),
        ("ceiling", &words.ceiling, &ceilings[..]),
    ] {
        if let Some(value) = value {
            all.push((word, one_of(value, known)?));
        }
    }
    match words.height {
        None => {}
        Some(0.0) => all.push(("height", String::new())),
        Some(height) if HEIGHTS.contains(&height) => all.push(("height", plain(height))),
        Some(_) => return Err(refuse::odd_ceiling(*HEIGHTS.start(), *HEIGHTS.end())),
    }
    Ok(all)
}

/// How high ceilings can be drawn, shaku.
const HEIGHTS: RangeInclusive<f64> = 1.0..=100.0;

/// The longest name, characters.
const LONGEST_NAME: usize = 100;

/// Returns the value that an attribute has without being written.
fn usual(word: &str) -> Option<&'static str> {
    match word {
        "floor" => Some("boards"),
        "mats" => Some("festive"),
        "ceiling" => Some("battens"),
        _ => None,
    }
}

fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&apos;"),
            c => out.push(c),
        }
    }
    out
}
