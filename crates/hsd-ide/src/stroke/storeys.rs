//! Strokes that add and remove storeys and change their heights.

pub(super) mod doubts;
mod element;
pub(super) mod fixtures;
pub(super) mod inner;
pub(super) mod rooms;

use super::change::{padded, tidy};
use super::draft::{Draft, PLAIN};
use super::find::{self, Written};
use super::legacy::whole_line;
use super::outline::{self, Walk};
use super::roofs::{self, like, words};
use super::xml::{gap_before, plain};
use super::{legacy, refuse};
use crate::format::Edit;
use crate::sections;
use crate::stroke::sheet::{Reason, Sheet, name};
use glam::DVec2;
use hsd_base::diagnostic::Text;
use hsd_base::geometry::SHAKU;
use hsd_base::source::Span;
use hsd_ir::ast::StoreyKind;
use hsd_ir::building::{House, Storey};
use hsd_syntax::parse::syntax::LineKind;
use std::ops::Range;

/// Default storey height in shaku.
const HEIGHT: f64 = 9.0;

/// Checks a height of a storey, shaku.
pub(super) fn checked(height: f64) -> Result<f64, Text> {
    let fits = (0.1..=1000.0).contains(&height);
    fits.then_some(height).ok_or_else(refuse::odd_height)
}

/// Changes the height of a storey.
pub(super) fn set_height(
    sheet: &Sheet<'_>,
    house: usize,
    storey: usize,
    height: f64,
) -> Result<Vec<Edit>, Text> {
    let (own, level) = find::storey(sheet, house, storey)?;
    let height = checked(height)?;
    let by = height - (level.z1 - level.z0) / SHAKU;
    if by.abs() < 1e-9 {
        return Err(refuse::nothing());
    }
    let mut edits = match find::written_house(sheet, own)? {
        Written::Lines(lines) => {
            let number = find::storey_lines(sheet, &lines, level)?;
            vec![header_height(sheet, &lines, number, height)?]
        }
        Written::Element(_) => element_heights(sheet, level, height)?,
    };
    let moved = |s: usize| (s >= storey).then(|| own.storeys[s].z1 / SHAKU + by);
    edits.extend(roofs::raise(sheet, own, &moved)?);
    Ok(tidy(edits))
}

/// Returns the words of the two lines of numbers that begin a legacy house, and the end of each line.
fn header(sheet: &Sheet<'_>, house: &sections::House) -> Vec<(Vec<Range<usize>>, usize)> {
    let lines = house.header.clone().unwrap_or(0..0);
    let lines = sheet.outline.lines[lines].iter();
    let headers = lines.filter(|l| l.kind == LineKind::Header);
    let numbers = headers.filter_map(|l| {
        let words = words(sheet.text, l.range.clone());
        let first = sheet.text.get(words.first()?.clone())?;
        let numeric = first
            .starts_with(|c: char| c.is_ascii_digit() || "+-.０１２３４５６７８９".contains(c));
        numeric.then_some((words, l.range.end))
    });
    numbers.collect()
}

/// Returns the edit of a height in the header.
fn header_height(
    sheet: &Sheet<'_>,
    house: &sections::House,
    storey: usize,
    height: f64,
) -> Result<Edit, Text> {
    let numbers = header(sheet, house);
    if let Some((heights, _)) = numbers.get(1) {
        if let Some(word) = heights.get(storey) {
            let text = like(&sheet.text[word.clone()], height);
            return Ok(Edit {
                range: word.clone(),
                text,
            });
        }
        let at = heights.last().map_or(0, |w| w.end);
        let missing = format!(" {}", plain(HEIGHT)).repeat(storey - heights.len());
        let text = format!("{missing} {}", plain(height));
        return Ok(Edit {
            range: at..at,
            text,
        });
    }
    let Some((_, at)) = numbers.first() else {
        return Err(Reason::Mistakes.text());
    };
    let missing = format!("{} ", plain(HEIGHT)).repeat(storey);
    let end = legacy::line_end(sheet.text, *at);
    let text = format!("{end}{missing}{}", plain(height));
    Ok(Edit {
        range: *at..*at,
        text,
    })
}

/// Returns the edits of the elements that specify the height of a storey.
fn element_heights(sheet: &Sheet<'_>, storey: &Storey, height: f64) -> Result<Vec<Edit>, Text> {
    let mut spans: Vec<Span> = vec![storey.span];
    spans.extend(storey.rings.iter().flat_map(|r| &r.walls).map(|w| w.span));
    spans.dedup();
    let (mut edits, mut first) = (vec![], None);
    for span in spans {
        let Some(element) = find::element(sheet, span) else {
            continue;
        };
        let own = &sheet.outline.elements[element];
        if !matches!(name(own), "Storey" | "Floor") {
            continue;
        }
        if let Some(reason) = sheet.around_fixed(element) {
            return Err(reason.text());
        }
        first = first.or(Some(own));
        if let Some(given) = own.attribute("height") {
            if !given.expressions.is_empty() {
                return Err(Reason::Computed.text());
            }
            let (range, text) = (given.inner.clone(), like(&given.value, height));
            edits.push(Edit { range, text });
        }
    }
    match first {
        None => Err(Reason::Monument.text()),
        Some(own) if edits.is_empty() => {
            let at = own.name.end;
            let text = format!(" height=\"{}\"", plain(height));
            Ok(vec![Edit {
                range: at..at,
                text,
            }])
        }
        Some(_) => Ok(edits),
    }
}

/// Returns the highest storey that has rooms.
fn top(house: &House) -> Result<(usize, &Storey), Text> {
    let mut storeys = house.storeys.iter().enumerate().rev();
    let found = storeys.find(|(_, s)| s.kind == StoreyKind::Storey);
    found.ok_or_else(refuse::no_such_place)
}

/// Returns the reason why no storey can be added on a house.
pub(crate) fn house_fixed(sheet: &Sheet<'_>, house: &House) -> Option<Reason> {
    let Ok((_, top)) = top(house) else {
        return Some(Reason::Monument);
    };
    if house.span.file.0 != 0 {
        return Some(Reason::Include);
    }
    let facades = find::element(sheet, top.span);
    let facades = facades.is_some_and(|e| name(&sheet.outline.elements[e]) != "Storey");
    let open = !top.rings.iter().any(|r| r.closed);
    storey_fixed(sheet, top)
        .or(facades.then_some(Reason::Shared))
        .or(open.then_some(Reason::Open))
}

/// Returns the reason why a storey cannot be removed or raised, by its place in the file.
pub(crate) fn storey_fixed(sheet: &Sheet<'_>, storey: &Storey) -> Option<Reason> {
    if storey.span.file.0 != 0 {
        return Some(Reason::Include);
    }
    let at = sheet.a.source.text_range(storey.span).start;
    if sheet.outline.line_at(at).is_some() {
        return None;
    }
    match find::element(sheet, storey.span) {
        Some(element) if matches!(name(&sheet.outline.elements[element]), "Storey" | "Floor") => {
            sheet.around_fixed(element)
        }
        _ => Some(sheet.made_by(at)),
    }
}

/// Adds a storey on the highest one.
pub(super) fn add(
    sheet: &Sheet<'_>,
    house: usize,
    height: Option<f64>,
    drawn: Option<&[[f64; 2]]>,
) -> Result<Vec<Edit>, Text> {
    let own = find::house(sheet, house)?;
    let (below, storey) = top(own)?;
    if let Some(reason) = house_fixed(sheet, own) {
        return Err(reason.text());
    }
    let height = checked(height.unwrap_or((storey.z1 - storey.z0) / SHAKU))?;
    let walks = match drawn {
        Some(outline) => vec![within(storey, outline)?],
        None => copied(sheet, storey)?,
    };
    let mut edits = match find::written_house(sheet, own)? {
        Written::Lines(lines) => on_lines(sheet, &lines, &walks, height)?,
        Written::Element(_) => vec![on_element(sheet, storey, &walks, height)?],
    };
    let new_top = storey.z1 / SHAKU + height;
    let whole = drawn.is_none();
    let moved = |s: usize| (whole && s == below).then_some(new_top);
    edits.extend(roofs::raise(sheet, own, &moved)?);
    Ok(tidy(edits))
}

/// Returns the walks of a storey, all of plain wall.
fn copied(sheet: &Sheet<'_>, storey: &Storey) -> Result<Vec<Walk>, Text> {
    let mut walks = vec![];
    for ring in storey.rings.iter().filter(|r| r.closed && !r.inner) {
        let draft = Draft::of(ring, &sheet.rows(ring));
        let code = |wall: usize| {
            let plain = draft.plain(wall, 1.0).ok();
            let first = plain.and_then(|p| p.into_iter().next());
            first.map_or(PLAIN.to_owned(), |p| p.code)
        };
        let codes: Vec<String> = (0..ring.walls.len()).map(code).collect();
        let corners: Vec<DVec2> = ring.walls.iter().map(|w| w.from).collect();
        walks.push(Walk::new(&corners, &codes, ring.hole)?);
    }
    Ok(walks)
}

/// Returns a walk within a storey.
fn within(storey: &Storey, outline: &[[f64; 2]]) -> Result<Walk, Text> {
    let corners = outline::checked(outline)?;
    let rings = storey.rings.iter().filter(|r| r.closed && !r.inner);
    let below: Vec<_> = rings.map(|r| (r.corners(), r.hole)).collect();
    if !outline::lies_in(&corners, &below) {
        return Err(refuse::outside());
    }
    let codes = vec![PLAIN.to_owned(); corners.len()];
    Walk::new(&corners, &codes, false)
}

/// Adds a storey after the last one of a legacy house.
fn on_lines(
    sheet: &Sheet<'_>,
    house: &sections::House,
    walks: &[Walk],
    height: f64,
) -> Result<Vec<Edit>, Text> {
    let [walk] = walks else {
        return Err(refuse::structure());
    };
    let lines = &sheet.outline.lines;
    let last = house.storeys.last().cloned().unwrap_or(0..0);
    let last = last.rev().find(|l| lines[*l].kind == LineKind::Wall);
    let last = &lines[last.ok_or_else(refuse::no_such_place)?];
    let mut edits = vec![];
    let codes = last.codes.last().map_or(last.range.start, |c| c.end);
    let letter = last.turn.clone();
    if letter.clone().and_then(|l| sheet.text.get(l)) != Some("^") {
        let range = letter.unwrap_or(codes..codes);
        let written = last.codes.last().map_or("", |c| &sheet.text[c.clone()]);
        let blanks = padded(written)[written.len()..].to_owned();
        let blanks = if range.is_empty() {
            blanks
        } else {
            String::new()
        };
        edits.push(Edit {
            range,
            text: blanks + "^",
        });
    }
    let end = legacy::line_end(sheet.text, last.range.end);
    let rows = walk.lines()?;
    let at = last.range.end;
    let text = rows.iter().map(|r| format!("{end}{r}")).collect();
    edits.push(Edit {
        range: at..at,
        text,
    });
    let number = house.storeys.len();
    let heights = header(sheet, house).get(1).map_or(0, |h| h.0.len());
    if heights > number || (height - HEIGHT).abs() > 1e-9 {
        edits.push(header_height(sheet, house, number, height)?);
    }
    Ok(edits)
}

/// Adds a storey after another one in the XML form.
fn on_element(
    sheet: &Sheet<'_>,
    storey: &Storey,
    walks: &[Walk],
    height: f64,
) -> Result<Edit, Text> {
    let element = find::storey_element(sheet, storey)?;
    let own = &sheet.outline.elements[element];
    let gap = gap_before(sheet.text, own.range.start);
    let step = if gap.is_empty() { "" } else { "  " };
    let inner = format!("{gap}{step}");
    let mut text = String::new();
    for (number, walk) in walks.iter().enumerate() {
        text += &match number {
            0 => format!(
                "{gap}<Storey height=\"{}\"{}>",
                plain(height),
                walk.start_attribute()
            ),
            _ => format!(
                "{inner}<Loop{}{}>",
                walk.hole_attribute(),
                walk.start_attribute()
            ),
        };
        let deeper = if number == 0 {
            inner.clone()
        } else {
            format!("{inner}{step}")
        };
        for row in walk.rows() {
            text += &format!("{deeper}{row}");
        }
        if number > 0 {
            text += &format!("{inner}</Loop>");
        }
    }
    text += &format!("{gap}</Storey>");
    let at = own.range.end;
    Ok(Edit {
        range: at..at,
        text,
    })
}

/// Removes a storey.
pub(super) fn remove(sheet: &Sheet<'_>, house: usize, storey: usize) -> Result<Vec<Edit>, Text> {
    let (own, level) = find::storey(sheet, house, storey)?;
    let others = own.storeys.iter().enumerate().filter(|(s, _)| *s != storey);
    if !others.clone().any(|(_, s)| s.kind == StoreyKind::Storey) {
        return Err(refuse::last_storey());
    }
    let mut edits = match find::written_house(sheet, own)? {
        Written::Lines(lines) => {
            let number = find::storey_lines(sheet, &lines, level)?;
            lines_gone(sheet, &lines, number)
        }
        Written::Element(_) => {
            let element = find::storey_element(sheet, level)?;
            super::xml::gone(sheet, sheet.outline.elements[element].range.clone())
        }
    };
    let by = if level.kind == StoreyKind::Parapet {
        0.0
    } else {
        (level.z1 - level.z0) / SHAKU
    };
    let is_top = top(own)?.0 == storey;
    let moved = |s: usize| match s.cmp(&storey) {
        std::cmp::Ordering::Greater => Some(own.storeys[s].z1 / SHAKU - by),
        std::cmp::Ordering::Equal if is_top => Some(level.z0 / SHAKU),
        _ => None,
    };
    edits.extend(roofs::raise(sheet, own, &moved)?);
    Ok(tidy(edits))
}

/// Removes the lines of a storey of the legacy form, and its height.
fn lines_gone(sheet: &Sheet<'_>, house: &sections::House, storey: usize) -> Vec<Edit> {
    let lines = &sheet.outline.lines;
    let nothing = |range| Edit {
        range,
        text: String::new(),
    };
    let walls = house.storeys[storey]
        .clone()
        .filter(|l| lines[*l].kind == LineKind::Wall);
    let mut edits: Vec<Edit> = walls
        .map(|l| nothing(whole_line(sheet, lines[l].range.clone())))
        .collect();
    let below = storey
        .checked_sub(1)
        .filter(|_| storey + 1 == house.storeys.len());
    if let Some(below) = below.map(|s| house.storeys[s].clone()) {
        // The storey below is the last one now.
        let last = below.rev().find(|l| lines[*l].kind == LineKind::Wall);
        let last = last.map(|l| &lines[l]);
        if let Some((line, turn)) = last.and_then(|l| Some((l, l.turn.clone()?))) {
            let blanks = sheet.text[line.range.start..turn.start]
                .trim_end_matches(' ')
                .len();
            let range = match line.codes.is_empty() {
                true => whole_line(sheet, line.range.clone()),
                false => line.range.start + blanks..turn.end,
            };
            edits.push(nothing(range));
        }
    }
    let numbers = header(sheet, house);
    if let Some((heights, end)) = numbers.get(1)
        && let Some(word) = heights.get(storey)
    {
        let range = match (storey.checked_sub(1), heights.get(storey + 1)) {
            (Some(before), _) => heights[before].end..word.end,
            (None, Some(next)) => word.start..next.start,
            (None, None) => {
                let line = sheet.outline.line_at(*end).map(|l| lines[l].range.clone());
                whole_line(sheet, line.unwrap_or(word.clone()))
            }
        };
        edits.push(nothing(range));
    }
    edits
}
