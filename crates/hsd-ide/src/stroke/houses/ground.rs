//! Strokes that move and turn what stands on the ground as a whole, and those that draw and change surveyed outlines.

use super::behind;
use crate::format::Edit;
use crate::stroke::change::tidy;
use crate::stroke::sheet::Sheet;
use crate::stroke::sheet::first_line::{FirstLine, USUAL};
use crate::stroke::sheet::standing::{PlacedBy, Standing, outlines, standing, turned_by};
use crate::stroke::storeys::checked;
use crate::stroke::xml::plain;
use crate::stroke::{legacy, refuse};
use glam::{DVec2, dvec2};
use hsd_base::diagnostic::Text;
use hsd_base::geometry::area2;
use hsd_syntax::parse::syntax::Element;

/// Places and corners are written to a millimetre, turns to a thousandth of a degree.
const EXACT: f64 = 1e3;
/// The largest coordinate, metres.
const FARTHEST: f64 = 1e6;
/// The least area of an outline, square metres.
const LEAST: f64 = 1.0;
/// The largest number of drawn corners.
const MOST: usize = 1000;
/// The default height of a first storey in shaku.
const HEIGHT: f64 = 9.5;

/// Moves a group or a house to a place in its frame, metres east and north.
pub(in crate::stroke) fn move_to(
    sheet: &Sheet<'_>,
    index: usize,
    to: [f64; 2],
) -> Result<Vec<Edit>, Text> {
    let own = own(sheet, index)?;
    if let Some(reason) = own.fixed {
        return Err(reason.text());
    }
    let to = to.map(rounded);
    if !to.iter().all(|n| n.abs() <= FARTHEST) {
        return Err(refuse::too_far());
    }
    let moved = [0, 1].map(|k| Some(to[k]).filter(|to| (to - own.at[k]).abs() > 0.5 / EXACT));
    done(put_place(sheet, &own.home, moved))
}

/// Turns a group, or the front of a house, to a direction in its frame, degrees.
pub(in crate::stroke) fn turn_to(
    sheet: &Sheet<'_>,
    index: usize,
    to: f64,
) -> Result<Vec<Edit>, Text> {
    let own = own(sheet, index)?;
    if let Some(reason) = own.turn_fixed {
        return Err(reason.text());
    }
    if !to.is_finite() {
        return Err(refuse::too_far());
    }
    let round = rounded(to.rem_euclid(360.0));
    // A group turns either way; a front has a compass direction.
    let to = if own.kind(sheet) == "Group" && round > 180.0 {
        round - 360.0
    } else {
        round % 360.0
    };
    match (to - own.turn).abs() < 0.5 / EXACT {
        true => Err(refuse::nothing()),
        false => done(put_turn(sheet, &own.home, to)),
    }
}

/// Moves a corner of an outline, metres in its frame.
pub(in crate::stroke) fn move_corner(
    sheet: &Sheet<'_>,
    outline: usize,
    corner: usize,
    to: [f64; 2],
) -> Result<Vec<Edit>, Text> {
    let all = outlines(sheet);
    let own = all.get(outline).ok_or_else(refuse::no_such_place)?;
    if let Some(reason) = own.fixed {
        return Err(reason.text());
    }
    let moved = own.corners.get(corner).ok_or_else(refuse::no_such_place)?;
    let to = to.map(rounded);
    let mut ring: Vec<DVec2> = own.corners.iter().map(|c| c.at.into()).collect();
    // A ring may be written closed, with its first corner again.
    let closing = ring.len() > 1 && ring.first() == ring.last();
    let last = own.corners.len() - 1;
    let mut moves = vec![moved];
    if closing && (corner == 0 || corner == last) {
        moves.push(&own.corners[last - corner]);
    }
    for index in [corner, last - corner].into_iter().take(moves.len()) {
        ring[index] = to.into();
    }
    if closing {
        ring.pop();
    }
    sound(&ring)?;
    let numbers = moves.iter().flat_map(|c| c.ranges.iter().zip(c.at).zip(to));
    let edits = numbers.filter(|((_, at), to)| (to - at).abs() > 0.5 / EXACT);
    let edit = |((range, _), to): ((&std::ops::Range<usize>, f64), f64)| Edit {
        range: range.clone(),
        text: plain(to),
    };
    done(edits.map(edit).collect())
}

/// Adds a house on an outline, metres east and north in the world.
pub(in crate::stroke) fn draw(
    sheet: &Sheet<'_>,
    points: &[[f64; 2]],
    height: Option<f64>,
) -> Result<Vec<Edit>, Text> {
    let ring: Vec<DVec2> = points
        .iter()
        .map(|p| dvec2(rounded(p[0]), rounded(p[1])))
        .collect();
    sound(&ring)?;
    let height = checked(height.unwrap_or(HEIGHT))?;
    let corners: Vec<String> = ring
        .iter()
        .map(|p| format!("{} {}", plain(p.x), plain(p.y)))
        .collect();
    let end = legacy::line_end(sheet.text, 0);
    let house = format!(
        "  <House>{end}    <Outline points=\"{}\"/>{end}    <Storey height=\"{}\"/>{end}  </House>{end}",
        corners.join(", "),
        plain(height)
    );
    let mut roots = sheet.outline.elements.iter().filter(|e| e.parent.is_none());
    match (roots.next(), roots.next()) {
        (Some(root), None) => Ok(tidy(behind(sheet, root, &house, end)?)),
        (None, _) if sheet.text.trim().is_empty() => done(vec![Edit {
            range: 0..sheet.text.len(),
            text: format!("<Houses>{end}{house}</Houses>{end}"),
        }]),
        (None, _) => Err(refuse::no_outlines()),
        _ => Err(refuse::structure()),
    }
}

fn own(sheet: &Sheet<'_>, index: usize) -> Result<Standing, Text> {
    let found = standing(sheet).into_iter().nth(index);
    found.ok_or_else(refuse::no_such_place)
}

fn rounded(number: f64) -> f64 {
    (number * EXACT).round() / EXACT + 0.0
}

fn done(edits: Vec<Edit>) -> Result<Vec<Edit>, Text> {
    match edits.is_empty() {
        true => Err(refuse::nothing()),
        false => Ok(tidy(edits)),
    }
}

/// Returns the edits that write a place, metres east and north; a number that is `None` stays.
fn put_place(sheet: &Sheet<'_>, home: &PlacedBy, [x, y]: [Option<f64>; 2]) -> Vec<Edit> {
    match home {
        PlacedBy::Line(line) => put_numbers(sheet.text, line, [x, y, None]),
        PlacedBy::Element(element) => {
            let element = &sheet.outline.elements[*element];
            let words = ["x", "y"].into_iter().zip([x, y]);
            let edits = words.filter_map(|(word, to)| Some(put(element, word, to?)));
            edits.collect()
        }
    }
}

/// Returns the edits that write a direction, degrees.
fn put_turn(sheet: &Sheet<'_>, home: &PlacedBy, to: f64) -> Vec<Edit> {
    match home {
        PlacedBy::Line(line) => put_numbers(sheet.text, line, [None, None, Some(to)]),
        PlacedBy::Element(element) => {
            let element = &sheet.outline.elements[*element];
            vec![put(element, turned_by(element), to)]
        }
    }
}

/// Returns the edits that write some numbers of a first line; those left out before them are written too.
fn put_numbers(text: &str, line: &FirstLine, numbers: [Option<f64>; 3]) -> Vec<Edit> {
    let written = line.numbers(text).unwrap_or(USUAL);
    let count = line.words.len();
    let there = line.words.iter().zip(numbers).filter_map(|(word, number)| {
        let text = plain(number?);
        let range = word.clone();
        Some(Edit { range, text })
    });
    let mut edits: Vec<Edit> = there.collect();
    let last = numbers.iter().rposition(Option::is_some);
    if let Some(last) = last.filter(|n| *n >= count) {
        // A house without a first line gets one with a whole place.
        let missing = (count..=last.max(1)).map(|k| plain(numbers[k].unwrap_or(written[k])));
        let missing: Vec<String> = missing.collect();
        let before = if count > 0 { " " } else { "" };
        let after = legacy::line_end(text, 0).repeat(line.line_ends);
        edits.push(Edit {
            range: line.end..line.end,
            text: format!("{before}{}{after}", missing.join(" ")),
        });
    }
    edits
}

/// Writes the number of an attribute.
fn put(element: &Element, word: &str, number: f64) -> Edit {
    if let Some(given) = element.attribute(word) {
        let (range, text) = (given.inner.clone(), plain(number));
        return Edit { range, text };
    }
    let at = element.attributes.iter().map(|a| a.range.end).max();
    let at = at.unwrap_or(element.name.end);
    let text = format!(" {word}=\"{}\"", plain(number));
    Edit {
        range: at..at,
        text,
    }
}

/// Checks that corners are an area whose sides do not cross.
fn sound(ring: &[DVec2]) -> Result<(), Text> {
    let near = |p: &DVec2| p.is_finite() && p.abs().max_element() <= FARTHEST;
    let count = ring.len();
    let large = (3..=MOST).contains(&count) && ring.iter().all(near);
    if !large || area2(ring).abs() / 2.0 < LEAST || crosses(ring) {
        return Err(refuse::bad_survey());
    }
    Ok(())
}

/// Returns true if two sides that are no neighbours meet.
fn crosses(ring: &[DVec2]) -> bool {
    let count = ring.len();
    let side = |i: usize| (ring[i], ring[(i + 1) % count]);
    let apart = |(p, q): (DVec2, DVec2), (r, s): (DVec2, DVec2)| {
        (q - p).perp_dot(r - p) * (q - p).perp_dot(s - p) > 0.0
    };
    (0..count).any(|i| {
        (i + 2..count)
            .filter(|j| (i + count - j) % count != 1)
            .any(|j| {
                let boxes = |a: DVec2, b: DVec2, c: DVec2, d: DVec2| {
                    a.min(b).cmple(c.max(d)).all() && c.min(d).cmple(a.max(b)).all()
                };
                let (a, b) = (side(i), side(j));
                boxes(a.0, a.1, b.0, b.1) && !apart(a, b) && !apart(b, a)
            })
    })
}
