//! A drawn ring in the legacy form: one line per wall, codes in columns, a letter or none at the end.

use super::change::{Change, padded};
use super::draft::DraftLine;
use super::refuse;
use crate::format::{self, Edit};
use crate::stroke::sheet::{Home, Sheet, What};
use glam::DVec2;
use hsd_base::diagnostic::Text;
use hsd_base::geometry::SAME;
use hsd_syntax::parse::syntax::LineKind;
use std::ops::Range;

/// A visible void.
const POINTS: &str = ".....";

/// Returns the edits of the lines of a ring.
pub(super) fn edits(change: &Change<'_>) -> Result<Vec<Edit>, Text> {
    let mut edits = vec![];
    let mut prefix = leading(change);
    if change.starts_anew() {
        let heading = change.ring.walls[0].direction;
        let (lines, voids) = lead(change.draft.start, heading)?;
        let first = line_of(change, 0).start;
        let end = line_end(change.sheet.text, first);
        let text: String = lines.iter().map(|l| format!("{l}{end}")).collect();
        edits.push(Edit {
            range: first..first,
            text,
        });
        edits.extend(lead_lines(change).map(|range| Edit {
            range,
            text: String::new(),
        }));
        prefix = POINTS.repeat(voids);
    }
    let mut anchor = line_of(change, 0).end;
    for (index, line) in change.draft.lines.iter().enumerate() {
        let before = if index == 0 { &*prefix } else { "" };
        let text = core(change, index, before);
        match line.base {
            Some(base) => {
                let core = core_range(change, base);
                let old = &change.sheet.text[core.clone()];
                edits.extend(format::within(core.start, old, &text));
                anchor = line_of(change, base).end;
            }
            None => {
                let end = line_end(change.sheet.text, anchor);
                edits.push(Edit {
                    range: anchor..anchor,
                    text: [end, &*text].concat(),
                });
            }
        }
    }
    for wall in 0..change.rows.len() {
        if !change.draft.lines.iter().any(|l| l.base == Some(wall)) {
            let range = whole_line(change.sheet, line_of(change, wall));
            edits.push(Edit {
                range,
                text: String::new(),
            });
        }
    }
    Ok(edits)
}

/// Returns the range of the line of a wall, without its line end.
fn line_of(change: &Change<'_>, wall: usize) -> Range<usize> {
    match change.rows[wall].home {
        Home::Line(line) => change.sheet.outline.lines[line].range.clone(),
        Home::Element(_) => 0..0,
    }
}

/// Returns a line with its line end; the last one of a source file with the line end before it.
pub(super) fn whole_line(sheet: &Sheet<'_>, line: Range<usize>) -> Range<usize> {
    let text = sheet.text;
    let rest = &text[line.end..];
    let returns = rest.len() - rest.trim_start_matches('\r').len();
    let end = match rest[returns..].starts_with('\n') {
        true => line.end + returns + 1,
        false => line.end + returns.min(1),
    };
    if end > line.end {
        return line.start..end;
    }
    let before = text[..line.start]
        .trim_end_matches('\n')
        .trim_end_matches('\r');
    let gone = (line.start - before.len()).min(2);
    line.start - gone..line.end
}

/// Returns the line end before or at a place.
pub(super) fn line_end(text: &str, at: usize) -> &str {
    let rest = &text[at..];
    let found = rest.find(['\r', '\n']).map(|i| at + i);
    let found = found.or_else(|| text.find(['\r', '\n']));
    match found.map(|i| &text[i..]) {
        Some(end) if end.starts_with("\r\n") => &end[..2],
        Some(end) => &end[..1],
        None => "\n",
    }
}

/// Returns the range of the codes of a line and its letter.
fn core_range(change: &Change<'_>, wall: usize) -> Range<usize> {
    let Home::Line(line) = change.rows[wall].home else {
        return 0..0;
    };
    let line = &change.sheet.outline.lines[line];
    let codes = change.rows[wall]
        .cells
        .last()
        .map_or(line.range.start, |c| c.range.end);
    let end = line.turn.as_ref().map_or(codes, |t| t.end.max(codes));
    line.range.start..end
}

/// Returns the letter of a line.
fn letter<'a>(change: &Change<'a>, wall: usize) -> &'a str {
    let Home::Line(line) = change.rows[wall].home else {
        return "";
    };
    let turn = change.sheet.outline.lines[line].turn.clone();
    turn.and_then(|t| change.sheet.text.get(t))
        .unwrap_or_default()
}

/// Returns the voids before the first part of the first line.
fn leading(change: &Change<'_>) -> String {
    let row = &change.rows[0];
    let Some(first) = row.cells.get(row.leads()) else {
        return String::new();
    };
    let start = line_of(change, 0).start;
    change.sheet.text[start..first.range.start].to_owned()
}

/// Returns the required end of a line.
fn ending(change: &Change<'_>, index: usize) -> String {
    let line = &change.draft.lines[index];
    let last = change.ring.walls.len() - 1;
    let own = line.base.map_or("", |b| letter(change, b));
    if index + 1 == change.draft.lines.len() {
        let reset = letter(change, last) == "^";
        return match line.base {
            Some(base) if base == last => own.to_owned(),
            _ if reset => "^".to_owned(),
            _ => own.to_owned(),
        };
    }
    let own = if own == "^" { "" } else { own };
    match change.turn(index) {
        None => own.to_owned(),
        Some("L") => "L".to_owned(),
        Some(_) if own.eq_ignore_ascii_case("R") => own.to_owned(),
        Some(_) => String::new(),
    }
}

/// Returns the new codes of a line and its letter.
fn core(change: &Change<'_>, index: usize, prefix: &str) -> String {
    let line = &change.draft.lines[index];
    let ending = ending(change, index);
    let mut text = prefix.to_owned();
    for (number, piece) in line.pieces.iter().enumerate() {
        let last = number + 1 == line.pieces.len() && ending.is_empty();
        text += &cell(change, line, number, last);
        // Blanks at the end of a line are lost, and voids with them.
        if last && piece.what == What::Void && text.ends_with(' ') {
            text.truncate(text.trim_end_matches(' ').len());
            text += POINTS;
        }
    }
    text + &ending
}

fn cell(change: &Change<'_>, line: &DraftLine, number: usize, last: bool) -> String {
    let piece = &line.pieces[number];
    let Some((wall, cell)) = piece.old else {
        return match last {
            true => piece.code.clone(),
            false => padded(&piece.code),
        };
    };
    let cells = &change.rows[wall].cells;
    let range = cells[cell].range.clone();
    let Some(next) = cells.get(cell + 1) else {
        let slice = change.slice((wall, cell));
        return if last {
            slice.to_owned()
        } else {
            padded(slice)
        };
    };
    let text = &change.sheet.text[range.start..next.range.start];
    let void = piece.what == What::Void;
    match last && !void {
        true => text.trim_end_matches(' ').to_owned(),
        false => text.to_owned(),
    }
}

/// Returns the lines that lead to the start of the walk, with their line ends.
fn lead_lines<'a>(change: &'a Change<'_>) -> impl Iterator<Item = Range<usize>> + 'a {
    let lines = &change.sheet.outline.lines;
    let first = match change.rows[0].home {
        Home::Line(line) => line,
        Home::Element(_) => 0,
    };
    let own = |l: &usize| match lines[*l].kind {
        LineKind::Comment => true,
        LineKind::Wall => {
            lines[*l]
                .turn
                .clone()
                .and_then(|t| change.sheet.text.get(t))
                != Some("^")
        }
        _ => false,
    };
    let leads = (0..first).rev().take_while(own);
    let walls = leads.filter(|l| lines[*l].kind == LineKind::Wall);
    walls.map(|l| whole_line(change.sheet, lines[l].range.clone()))
}

/// Returns the lines that lead a walk from the origin to its start, and the voids before its first part.
pub(super) fn lead(start: DVec2, heading: DVec2) -> Result<(Vec<String>, usize), Text> {
    if (start - start.round()).abs().max_element() > SAME || start.abs().max_element() > 1e4 {
        return Err(refuse::odd_start());
    }
    let (a, b) = (start.x.round() as i64, start.y.round() as i64);
    let along_a = (a != 0).then(|| (if a > 0 { 0 } else { 180 }, a.unsigned_abs() as usize));
    let along_b = (b != 0).then(|| (if b > 0 { 90 } else { 270 }, b.unsigned_abs() as usize));
    let last = match (heading.x.round() as i64, heading.y.round() as i64) {
        (1, _) => 0,
        (_, 1) => 90,
        (-1, _) => 180,
        _ => 270,
    };
    let legs = match last % 180 {
        0 => [along_b, along_a],
        _ => [along_a, along_b],
    };
    let (mut lines, mut now, mut voids) = (vec![], 0, 0);
    let legs = legs.into_iter().flatten().chain([(last, 0)]);
    for (way, units) in legs {
        let letters: &[&str] = match (way + 360 - now) % 360 {
            0 => &[],
            90 => &["R"],
            180 => &["R", "R"],
            _ => &["L"],
        };
        for letter in letters {
            lines.push(POINTS.repeat(std::mem::take(&mut voids)) + letter);
        }
        (now, voids) = (way, voids + units);
    }
    Ok((lines, voids))
}
