//! Strokes that add, change and remove rooms.

use crate::ast::{Flooring, MatOrder, Room, RoomCeiling};
use crate::building::Storey;
use crate::diagnostic::Text;
use crate::fit::{InStorey, in_storey};
use crate::ide::format::Edit;
use crate::ide::stroke::StoreyAt;
use crate::ide::stroke::change::tidy;
use crate::ide::stroke::find;
use crate::ide::stroke::refuse;
use crate::ide::stroke::sheet::{Reason, Sheet, name};
use crate::ide::stroke::xml::{gap_before, gone, plain, without};
use crate::source::{FileId, Span};
use glam::{DVec2, dvec2};
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
pub(in crate::ide::stroke) fn add(
    sheet: &Sheet<'_>,
    at: StoreyAt,
    words: &RoomWords,
) -> Result<Vec<Edit>, Text> {
    let (_, level) = find::storey(sheet, at.house, at.storey)?;
    free(level, words.at.ok_or_else(refuse::no_such_place)?, None)?;
    let mut element = "<Room".to_owned();
    for (word, value) in written(words)? {
        if !value.is_empty() && Some(&*value) != usual(word) {
            element += &format!(" {word}=\"{value}\"");
        }
    }
    element += "/>";
    let lines = |_: &str, _: &str| element.clone();
    Ok(vec![put(sheet, level, &[], &lines)?])
}

/// Changes a room.
pub(in crate::ide::stroke) fn change(
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

/// Returns the edits that give attributes of an element these values; empty ones remove them, those that are `usual` need
/// not be written.
pub(super) fn rewritten(
    sheet: &Sheet<'_>,
    element: usize,
    words: Vec<(&'static str, String)>,
    usual: fn(&str) -> Option<&'static str>,
) -> Result<Vec<Edit>, Text> {
    let own = &sheet.outline.elements[element];
    let end = own.attributes.iter().map(|a| a.range.end).max();
    let end = end.unwrap_or(own.name.end);
    let mut edits = vec![];
    for (word, value) in words {
        match own.attribute(word) {
            Some(given) if !given.expressions.is_empty() => return Err(Reason::Computed.text()),
            Some(given) if value.is_empty() => edits.push(without(sheet, &given.range)),
            Some(given) if sheet.text.get(given.inner.clone()) == Some(&*value) => {}
            Some(given) => edits.push(Edit {
                range: given.inner.clone(),
                text: value,
            }),
            None if value.is_empty() || usual(word) == Some(&*value) => {}
            None => edits.push(Edit {
                range: end..end,
                text: format!(" {word}=\"{value}\""),
            }),
        }
    }
    match edits.is_empty() {
        true => Err(refuse::nothing()),
        false => Ok(tidy(edits)),
    }
}

/// Removes a room; the area stays, and has boards.
pub(in crate::ide::stroke) fn remove(
    sheet: &Sheet<'_>,
    at: StoreyAt,
    number: usize,
) -> Result<Vec<Edit>, Text> {
    let (_, level) = find::storey(sheet, at.house, at.storey)?;
    let element = element(sheet, level, number)?;
    let range = sheet.outline.elements[element].range.clone();
    Ok(tidy(gone(sheet, range)))
}

/// Returns the reason why no stroke can change a room.
pub(in crate::ide) fn room_fixed(sheet: &Sheet<'_>, room: &Room) -> Option<Reason> {
    fixed(sheet, room.span, "Room")
}

/// Returns the reason why no stroke can change the element of a span.
pub(super) fn fixed(sheet: &Sheet<'_>, span: Span, called: &str) -> Option<Reason> {
    if span.file != FileId(0) {
        return Some(Reason::Include);
    }
    match find::element(sheet, span) {
        Some(element) if name(&sheet.outline.elements[element]) == called => {
            sheet.around_fixed(element)
        }
        _ => Some(sheet.made_by(sheet.a.source.text_range(span).start)),
    }
}

fn element(sheet: &Sheet<'_>, storey: &Storey, number: usize) -> Result<usize, Text> {
    let room = storey.rooms.get(number).ok_or_else(refuse::no_such_place)?;
    match room_fixed(sheet, room) {
        Some(reason) => Err(reason.text()),
        None => find::element(sheet, room.span).ok_or_else(refuse::no_such_place),
    }
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

/// Checks that a word is one of those that are known.
pub(super) fn one_of(word: &str, known: &[&str]) -> Result<String, Text> {
    match known.contains(&word) {
        true => Ok(word.to_owned()),
        false => Err(refuse::no_such_place()),
    }
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

/// Returns the edit that puts an element into a storey: behind the last child of these names, or of any if none is given.
/// `lines` makes the element from the line end and blanks before it, and one step more of blanks.
pub(super) fn put(
    sheet: &Sheet<'_>,
    storey: &Storey,
    behind: &[&str],
    lines: &dyn Fn(&str, &str) -> String,
) -> Result<Edit, Text> {
    let at = sheet.a.source.text_range(storey.span).start;
    if storey.span.file == FileId(0) && sheet.outline.line_at(at).is_some() {
        return Err(refuse::no_rooms());
    }
    let element = find::storey_element(sheet, storey)?;
    let own = &sheet.outline.elements[element];
    let outer = gap_before(sheet.text, own.range.start);
    let step = if outer.is_empty() { "" } else { "  " };
    let last = sheet
        .children(element)
        .filter(|c| {
            let name = name(&sheet.outline.elements[*c]);
            behind.is_empty() || behind.contains(&name)
        })
        .last();
    let insert = |at: usize, text: String| Edit {
        range: at..at,
        text,
    };
    if let Some(last) = last {
        let last = &sheet.outline.elements[last].range;
        let gap = gap_before(sheet.text, last.start);
        return Ok(insert(last.end, format!("{gap}{}", lines(gap, step))));
    }
    let gap = format!("{outer}{step}");
    let text = format!("{gap}{}", lines(&gap, step));
    Ok(match own.end_name {
        Some(_) => insert(own.tag.end, text),
        // <Storey/> opens.
        None => Edit {
            range: sheet.text[..own.tag.end - 2].trim_end().len()..own.tag.end,
            text: format!(">{text}{outer}</Storey>"),
        },
    })
}
