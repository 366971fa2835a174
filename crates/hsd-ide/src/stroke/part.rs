//! Replaces the part of a unit.

use super::change::{CELL, Change, tidy};
use super::draft::{Draft, DraftPiece, PLAIN, plain};
use super::write;
use super::{UnitAt, WallAt, find, refuse};
use crate::format::Edit;
use crate::stroke::sheet::{Form, Home, Reason, Sheet, SheetRow, What, name};
use hsd_base::diagnostic::Text;
use hsd_base::geometry::SAME;
use hsd_ir::ast::CodeText;
use hsd_ir::building::Wall;
use hsd_ir::program::Content;
use hsd_syntax::parse::schema::lengths::{Measure, length};

/// The visible code of a void.
const VOID: &str = ".....";

/// Returns the edits that replace a unit by parts, which follow each other along the walk.
pub(super) fn set(
    sheet: &Sheet<'_>,
    (at, unit): (WallAt, usize),
    parts: &[&str],
) -> Result<Vec<Edit>, Text> {
    let (_, storey) = find::storey(sheet, at.house, at.storey)?;
    let ring = storey
        .rings
        .get(at.ring)
        .ok_or_else(refuse::no_such_place)?;
    let wall = ring.walls.get(at.wall).ok_or_else(refuse::no_such_place)?;
    if unit >= wall.units.len() {
        return Err(refuse::no_such_place());
    }
    let rows = sheet.rows(ring);
    let row = &rows[at.wall];
    if let Some(reason) = row.unit_fixed(unit) {
        return Err(reason.text());
    }
    let mut new = all_meant(sheet, at.house, row, parts)?;
    let cell = row.cell_of(unit).ok_or_else(refuse::no_such_place)?;
    let mut draft = Draft::of(ring, &rows);
    let usual = draft.plain(at.wall, 1.0)?;
    let usual = usual.first().map_or(PLAIN, |p| &p.code).to_owned();
    let pieces = &mut draft.lines[at.wall].pieces;
    let index = single(pieces, row, cell, unit, row.rightwards);
    let old = pieces[index].clone();
    let [first, rest @ ..] = &mut new[..] else {
        return Err(refuse::nothing());
    };
    if rest.is_empty() && old.code == first.code {
        return Err(refuse::nothing());
    }
    first.instead = true;
    if !rest.is_empty() {
        several(pieces, index, new)?;
    } else {
        let mut new = new.swap_remove(0);
        if scales(sheet, row, wall) {
            new.width = old.width;
        } else if let Some(width) = own_width(sheet, &row.cells[cell].form) {
            new.width = width;
        }
        put(pieces, index, new, &usual)?;
    }
    if at.wall == 0 && leads_away(&draft.lines[0].pieces) {
        return Err(refuse::leading_void());
    }
    let change = Change {
        sheet,
        ring,
        rows: &rows,
        draft: &draft,
    };
    Ok(tidy(write::edits(&change)?))
}

/// Returns the parts that names mean, if their row can have them.
fn all_meant(
    sheet: &Sheet<'_>,
    house: usize,
    row: &SheetRow,
    parts: &[&str],
) -> Result<Vec<DraftPiece>, Text> {
    let is_line = matches!(row.home, Home::Line(_));
    let one = |part: &&str| {
        let meant = meant(sheet, house, part)?;
        match is_line && !(meant.code.len() <= CELL && meant.code.is_ascii()) {
            true => Err(refuse::long_name(&meant.code)),
            false => Ok(meant),
        }
    };
    parts.iter().map(one).collect()
}

/// Returns the place of a unit in the plan.
pub(super) fn place(sheet: &Sheet<'_>, at: UnitAt) -> Result<(WallAt, usize), Text> {
    let [start, end] = match at {
        UnitAt::Place { wall, unit } => return Ok((wall, unit)),
        UnitAt::Span { span } => span,
    };
    let mut found = vec![];
    for (house, own) in sheet.a.checked.building.houses.iter().enumerate() {
        for (storey, own) in own.house.storeys.iter().enumerate() {
            for (ring, own) in own.rings.iter().enumerate() {
                for (wall, own) in own.walls.iter().enumerate() {
                    let here = |s: hsd_base::source::Span| {
                        s.file.0 == 0 && (s.start, s.end) == (start, end)
                    };
                    let units = own.units.iter().enumerate().filter(|(_, u)| here(u.span));
                    let wall = WallAt {
                        house,
                        storey,
                        ring,
                        wall,
                    };
                    found.extend(units.map(|(unit, _)| (wall, unit)));
                }
            }
        }
    }
    match found[..] {
        [one] => Ok(one),
        [] => Err(refuse::no_such_place()),
        _ => Err(Reason::Repeat.text()),
    }
}

/// Returns the part that a name means in a house.
pub(super) fn meant(sheet: &Sheet<'_>, house: usize, part: &str) -> Result<DraftPiece, Text> {
    let catalog = sheet.a.catalog();
    let code = part.trim_end();
    if code.is_empty() || code == VOID {
        return Ok(DraftPiece::new(VOID, What::Void, 1.0));
    }
    let scope = catalog.known_in(0, house);
    let known = |code: &str| catalog.find_in(scope, &CodeText::new(code));
    let found = known(code).or_else(|| known(&code.replace('_', " ")));
    let called = || {
        catalog
            .called(code.trim())
            .and_then(|p| known(p.code().trim_end()))
    };
    if let Some(id) = found.or_else(called) {
        let part = catalog.part(id);
        let unit = hsd_ir::program::Unit {
            span: hsd_base::source::Span::default(),
            width: part.width(),
            content: Content::Part(id),
            height: None,
            reflection: None,
            picture: None,
        };
        let what = sheet.what(&unit);
        return Ok(DraftPiece::new(part.code().trim_end(), what, part.width()));
    }
    let pictures = &sheet.a.checked.building.images;
    let named = |e: &hsd_syntax::parse::syntax::Element| {
        name(e) == "Texture" && e.value("code") == Some(code)
    };
    let picture =
        pictures.iter().any(|p| p.name == code) || sheet.outline.elements.iter().any(named);
    match picture {
        true => Ok(DraftPiece::new(code, What::Other, 1.0)),
        false => Err(refuse::unknown_part(part)),
    }
}

/// Returns the width that a `Part` specifies, which stays.
fn own_width(sheet: &Sheet<'_>, form: &Form) -> Option<f64> {
    let Form::Part(element) = form else {
        return None;
    };
    let elements = &sheet.outline.elements;
    let width = elements[*element].value("width")?.trim();
    let mut around = sheet.outline.around(*element).map(|e| &elements[e]);
    let unit = around.find_map(|e| e.value("unit")?.trim().parse().ok());
    let plain = width.parse().ok().filter(|w: &f64| w.is_finite());
    plain.or_else(|| length(width, Measure::Units, unit.unwrap_or(3.0)))
}

/// Returns true if a line belongs to a floor whose units do not have their natural widths, i.e. the facade scales them.
fn scales(sheet: &Sheet<'_>, row: &SheetRow, wall: &Wall) -> bool {
    let natural = |u: &hsd_ir::program::Unit| match &u.content {
        Content::Void => u.width == 1.0,
        Content::Part(id) => (u.width - sheet.a.catalog().part(*id).width()).abs() < SAME,
        Content::Picture(_) | Content::Split(_) => false,
    };
    sheet.floor(row).is_some() && !wall.units.iter().all(natural)
}

/// Splits a unit off as a piece of its own; returns its index.
fn single(
    pieces: &mut Vec<DraftPiece>,
    row: &SheetRow,
    cell: usize,
    unit: usize,
    rightwards: bool,
) -> usize {
    let index = cell - row.leads();
    let piece = pieces[index].clone();
    if piece.count <= 1 && !piece.is_pattern() {
        return index;
    }
    let units = &row.cells[cell].units;
    let before = if rightwards {
        units.end - 1 - unit
    } else {
        unit - units.start
    };
    let each = (units.len() / piece.count as usize).max(1);
    let (parts, at) = piece.unrolled((before / each) as u32);
    let inner = if piece.is_pattern() { before % each } else { 0 };
    pieces.splice(index..=index, parts);
    index + at + inner
}

/// Replaces a piece by several that are together as wide.
fn several(pieces: &mut Vec<DraftPiece>, index: usize, new: Vec<DraftPiece>) -> Result<(), Text> {
    let width: f64 = new.iter().map(|p| p.width).sum();
    if (width - pieces[index].width).abs() > SAME {
        return Err(refuse::too_wide(&new[0].code));
    }
    pieces.splice(index..=index, new);
    Ok(())
}

/// Replaces a piece by another one; the line keeps its length.
fn put(
    pieces: &mut Vec<DraftPiece>,
    index: usize,
    new: DraftPiece,
    usual: &str,
) -> Result<(), Text> {
    let missing = new.width - pieces[index].width;
    let code = new.code.clone();
    pieces[index] = new;
    if missing < -SAME {
        let twin = pieces[index].clone();
        let fill = match plain(usual, -missing) {
            Ok(fill) => fill,
            Err(_) if (twin.width + missing).abs() < SAME => vec![DraftPiece {
                instead: false,
                ..twin
            }],
            Err(why) => return Err(why),
        };
        pieces.splice(index + 1..index + 1, fill);
        return Ok(());
    }
    let left = cover(pieces, index, missing, usual, true)?;
    let left = cover(pieces, index, left, usual, false)?;
    if left > SAME {
        Err(refuse::too_wide(&code))
    } else {
        Ok(())
    }
}

/// Removes this many units after or before a piece, as far as those are plain or can be removed as a whole; returns the
/// number left.
fn cover(
    pieces: &mut Vec<DraftPiece>,
    index: usize,
    width: f64,
    usual: &str,
    behind: bool,
) -> Result<f64, Text> {
    let (mut left, mut index) = (width, index);
    while left > SAME {
        let beside = match behind {
            true => (index + 1..pieces.len()).find(|i| pieces[*i].what != What::Post),
            false => (0..index).rev().find(|i| pieces[*i].what != What::Post),
        };
        let Some(at) = beside else { break };
        let piece = pieces[at].clone();
        let one = piece.times(1).width;
        let computed = piece.code.is_empty() && piece.old.is_some(); // of patterns each part stands for itself
        if computed || one > left + SAME && piece.what != What::Plain {
            break;
        }
        left -= one;
        let mut rest = vec![];
        if piece.count > 1 {
            rest.push(piece.times(piece.count - 1));
        }
        if left < -SAME {
            let fill = plain(usual, -left)?;
            let place = if behind { 0 } else { rest.len() };
            rest.splice(place..place, fill);
        }
        let more = rest.len();
        pieces.splice(at..=at, rest);
        if !behind {
            index = index + more - 1;
        }
    }
    Ok(left.max(0.0))
}

/// Returns true if a line begins with a void, which would only lead to the start of the walk.
fn leads_away(pieces: &[DraftPiece]) -> bool {
    pieces.first().is_some_and(|p| p.what == What::Void)
}
