//! Strokes that settle a wall in doubt: it is right as it is, it is of another kind, or there is none. Each takes the entry
//! out of its comment.

use super::inner::{self, leads};
use crate::format::Edit;
use crate::stroke::change::{Change, tidy};
use crate::stroke::draft::Draft;
use crate::stroke::sheet::doubts::{Doubt, doubts, entries};
use crate::stroke::sheet::{Cell, Form, Home, Reason, Sheet, SheetRow, What, name};
use crate::stroke::xml::{gap_before, gone, plain};
use crate::stroke::{StoreyAt, WallAt, find, part, refuse, write};
use glam::DVec2;
use hsd_base::diagnostic::Text;
use hsd_base::geometry::SAME;
use hsd_ir::building::{Ring, Wall};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::ops::Range;

/// What a wall in doubt may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A wall without an opening.
    Wall,
    /// Sliding doors.
    Slide,
    /// A window.
    Window,
    /// A lattice.
    Lattice,
    /// A way without a door.
    Open,
}

impl Kind {
    /// Returns the parts of one or two units that a reader of plans writes for it; of equals the first is taken.
    fn parts(self, is_inner: bool, width: u32) -> &'static [&'static str] {
        match (self, width) {
            (Kind::Slide, 2) if is_inner => &["TFU 2", "TSH 2", "TGL 2"],
            (Kind::Slide, 2) => &["TSH 2", "TGL 2", "TFU 2"],
            (Kind::Slide, 1) => &["TSH"],
            (Kind::Window, 1) => &["MRE", "MHI", "MGA"],
            (Kind::Lattice, 1) => &["GSI"],
            (Kind::Open, 2) => &["AKI 2"],
            (Kind::Open, 1) => &["AKI"],
            (Kind::Wall, 1) => &["KTU"],
            _ => &[],
        }
    }
}

/// Takes a wall as it is.
pub(in crate::stroke) fn accept(sheet: &Sheet<'_>, number: usize) -> Result<Vec<Edit>, Text> {
    let doubt = doubt(sheet, number)?;
    Ok(vec![settled(sheet, &doubt)])
}

/// Replaces a wall in doubt by parts of a kind.
pub(in crate::stroke) fn change(
    sheet: &Sheet<'_>,
    number: usize,
    kind: Kind,
) -> Result<Vec<Edit>, Text> {
    let doubt = doubt(sheet, number)?;
    let (at, unit) = doubt.unit.ok_or_else(refuse::no_doubtful_wall)?;
    let ring = ring(sheet, at)?;
    let own = ring.walls[at.wall].units.get(unit);
    let own = own.ok_or_else(refuse::no_such_place)?;
    let parts = parts(sheet, (at, ring), kind, own.width)?;
    let mut edits = vec![settled(sheet, &doubt)];
    if parts != [sheet.code(own)] {
        let parts: Vec<&str> = parts.iter().map(|p| &**p).collect();
        edits.extend(part::set(sheet, (at, unit), &parts)?);
    }
    Ok(tidy(edits))
}

/// Takes a wall in doubt away: outside an open way is left, inside nothing, and the walk ends before it and goes on behind.
pub(in crate::stroke) fn delete(sheet: &Sheet<'_>, number: usize) -> Result<Vec<Edit>, Text> {
    let found = doubt(sheet, number)?;
    let (at, _) = found.unit.ok_or_else(refuse::no_doubtful_wall)?;
    match ring(sheet, at)?.inner {
        true => Ok(tidy(taken_out(sheet, &found)?)),
        false => change(sheet, number, Kind::Open),
    }
}

/// Returns the edit that settles what is in doubt about a unit, if anything is.
pub(in crate::stroke) fn settles(sheet: &Sheet<'_>, at: WallAt, unit: usize) -> Option<Edit> {
    let mut all = doubts(sheet).into_iter();
    let found = all.find(|d| d.unit == Some((at, unit)))?;
    Some(settled(sheet, &found))
}

/// Returns the edits that write the new places of what is in doubt about a wall that moves.
pub(in crate::stroke) fn shifted(sheet: &Sheet<'_>, wall: WallAt, way: DVec2) -> Vec<Edit> {
    let own = |d: &Doubt| d.unit.is_some_and(|(at, _)| at == wall);
    let moved = doubts(sheet).into_iter().filter(own).map(|doubt| {
        let to = doubt.at + way;
        Edit {
            range: doubt.numbers,
            text: format!("{} {}", plain(to.x), plain(to.y)),
        }
    });
    moved.collect()
}

fn doubt(sheet: &Sheet<'_>, number: usize) -> Result<Doubt, Text> {
    let found = doubts(sheet).into_iter().nth(number);
    found.ok_or_else(refuse::no_such_place)
}

fn ring<'a>(sheet: &Sheet<'a>, at: WallAt) -> Result<&'a Ring, Text> {
    find::ring(sheet, at).map(|(_, _, ring)| ring)
}

/// Returns the edit that takes an entry out of its comment, and the comment with its line if nothing else is in it.
fn settled(sheet: &Sheet<'_>, doubt: &Doubt) -> Edit {
    without(sheet, doubt.comment, &|entry| *entry == doubt.entry)
}

fn without(sheet: &Sheet<'_>, comment: usize, gone: &dyn Fn(&Range<usize>) -> bool) -> Edit {
    let range = sheet.outline.comments[comment].clone();
    let all = entries(sheet.text, &range);
    let rest: Vec<&str> = all
        .iter()
        .filter(|e| !gone(e))
        .map(|e| &sheet.text[e.clone()])
        .collect();
    match (all.first(), all.last()) {
        (Some(first), Some(last)) if !rest.is_empty() => Edit {
            range: first.start..last.end,
            text: rest.join(", "),
        },
        _ => Edit {
            range: range.start - gap_before(sheet.text, range.start).len()..range.end,
            text: String::new(),
        },
    }
}

/// Returns parts of a kind that are together this wide: those that the house has most often on the same side of its walls.
fn parts(
    sheet: &Sheet<'_>,
    (at, ring): (WallAt, &Ring),
    kind: Kind,
    width: f64,
) -> Result<Vec<String>, Text> {
    let (mut left, mut found) = (width, vec![]);
    for wide in [2, 1] {
        let known = kind.parts(ring.inner, wide);
        let Some(first) = known.first().filter(|_| left > f64::from(wide) - SAME) else {
            continue;
        };
        let used = used(sheet, at.house, ring.inner, &|code, what| match kind {
            Kind::Wall => what == What::Plain,
            _ => known.contains(&code),
        });
        let order = |code: &str| known.iter().position(|k| *k == code).unwrap_or(known.len());
        let of_width = used.into_iter().filter(|((_, w), _)| *w == wide);
        let most =
            of_width.max_by_key(|((code, _), count)| (*count, std::cmp::Reverse(order(code))));
        let code = most.map_or_else(|| (*first).to_owned(), |((code, _), _)| code);
        while left > f64::from(wide) - SAME {
            found.push(code.clone());
            left -= f64::from(wide);
        }
    }
    match left > SAME || found.is_empty() {
        true => Err(refuse::half_units()),
        false => Ok(found),
    }
}

/// Counts the parts of a house on one side of its walls, by code and width.
fn used(
    sheet: &Sheet<'_>,
    house: usize,
    is_inner: bool,
    is_such: &dyn Fn(&str, What) -> bool,
) -> BTreeMap<(String, u32), usize> {
    let mut counts = BTreeMap::new();
    let built = sheet.a.checked.building.houses.get(house);
    let rings = built
        .iter()
        .flat_map(|b| &b.house.storeys)
        .flat_map(|s| &s.rings);
    for ring in rings.filter(|r| r.inner == is_inner) {
        for unit in ring.walls.iter().flat_map(|w| &w.units) {
            let code = sheet.code(unit);
            if is_such(&code, sheet.what(unit)) && (unit.width - unit.width.round()).abs() < SAME {
                *counts.entry((code, unit.width.round() as u32)).or_insert(0) += 1;
            }
        }
    }
    counts
}

/// A part that is taken out of a walk inside.
struct Taken<'a> {
    sheet: &'a Sheet<'a>,
    doubt: &'a Doubt,
    ring: &'a Ring,
    rows: &'a [SheetRow],
    at: WallAt,
    unit: usize,
    /// Its cell in its row.
    cell: usize,
    /// The `Row`, and the `Loop` around it.
    row: usize,
    owner: usize,
}

fn taken_out(sheet: &Sheet<'_>, doubt: &Doubt) -> Result<Vec<Edit>, Text> {
    let (at, unit) = doubt.unit.ok_or_else(refuse::no_doubtful_wall)?;
    let ring = ring(sheet, at)?;
    let rows = sheet.rows(ring);
    if let Some(reason) = rows[at.wall].unit_fixed(unit) {
        return Err(reason.text());
    }
    let cell = rows[at.wall]
        .cell_of(unit)
        .ok_or_else(refuse::no_such_place)?;
    if matches!(rows[at.wall].cells[cell].form, Form::Run(..)) {
        return Err(Reason::Repeat.text());
    }
    let Home::Element(row) = rows[at.wall].home else {
        return Err(refuse::no_rooms());
    };
    let mut around = sheet.outline.around(row);
    let owner = around.find(|e| name(&sheet.outline.elements[*e]) == "Loop");
    let owner = owner.ok_or_else(refuse::no_such_place)?;
    if let Some(reason) = sheet.around_fixed(owner) {
        return Err(reason.text());
    }
    let taken = Taken {
        sheet,
        doubt,
        ring,
        rows: &rows,
        at,
        unit,
        cell,
        row,
        owner,
    };
    let bare = |w: &Wall| w.units.iter().all(|u| u.width < SAME);
    let is_first = unit == 0 && ring.walls[..at.wall].iter().all(bare);
    let units = ring.walls[at.wall].units.len();
    let is_last = unit + 1 == units && ring.walls[at.wall + 1..].iter().all(bare);
    match (is_first, is_last) {
        (true, true) => taken.all(),
        (true, false) if taken.alone() => taken.moved_on(),
        (false, true) if taken.alone() => {
            let mut edits = gone(sheet, sheet.outline.elements[row].range.clone());
            edits.push(taken.settled());
            Ok(edits)
        }
        (true, false) | (false, true) => taken.shortened(is_first),
        (false, false) => taken.parted(),
    }
}

impl Taken<'_> {
    fn settled(&self) -> Edit {
        settled(self.sheet, self.doubt)
    }

    fn wall(&self) -> &Wall {
        &self.ring.walls[self.at.wall]
    }

    /// Returns true if nothing else is in its row.
    fn alone(&self) -> bool {
        self.rows[self.at.wall].cells.len() == 1
    }

    /// The walk goes as a whole.
    fn all(&self) -> Result<Vec<Edit>, Text> {
        let WallAt {
            house,
            storey,
            ring,
            ..
        } = self.at;
        let mut edits = inner::remove(self.sheet, StoreyAt { house, storey }, ring)?;
        let range = self.sheet.outline.elements[self.owner].range.clone();
        if self.has_comments(&range) {
            edits.push(self.settled());
            return Ok(edits);
        }
        // With its line.
        let start = range.start - gap_before(self.sheet.text, range.start).len();
        let text = String::new();
        Ok(vec![Edit {
            range: start..range.end,
            text,
        }])
    }

    /// Returns true if a comment other than its own is in a range.
    fn has_comments(&self, range: &Range<usize>) -> bool {
        let inside = |c: &Range<usize>| range.start <= c.start && c.end <= range.end;
        let mut comments = self.sheet.outline.comments.iter().enumerate();
        comments.any(|(n, c)| n != self.doubt.comment && inside(c))
    }

    /// The walk begins with its next row.
    fn moved_on(&self) -> Result<Vec<Edit>, Text> {
        let (text, elements) = (self.sheet.text, &self.sheet.outline.elements);
        let (row, owner) = (&elements[self.row], &elements[self.owner]);
        let range = owner.range.start..row.range.end;
        if self.has_comments(&range) {
            return Err(refuse::comments());
        }
        let gap = gap_before(text, row.range.start);
        let mut new = self.tag();
        for lead in leads(self.way(self.at.wall + 1)?) {
            new += &format!("{gap}{lead}");
        }
        Ok(vec![Edit { range, text: new }])
    }

    /// Returns the way of a wall, along an axis.
    fn way(&self, wall: usize) -> Result<DVec2, Text> {
        let way = self.ring.walls[wall].direction;
        match way.distance(way.round()) > SAME {
            true => Err(Reason::Slanted.text()),
            false => Ok(way.round()),
        }
    }

    /// The walk begins later, or ends earlier.
    fn shortened(&self, is_first: bool) -> Result<Vec<Edit>, Text> {
        let mut draft = Draft::of(self.ring, self.rows);
        let row = &self.rows[self.at.wall];
        let piece = draft.lines[self.at.wall]
            .pieces
            .remove(self.cell - row.leads());
        if is_first {
            draft.start += self.wall().direction * piece.width;
        }
        let change = Change {
            sheet: self.sheet,
            ring: self.ring,
            rows: self.rows,
            draft: &draft,
        };
        let mut edits = write::edits(&change)?;
        edits.push(self.settled());
        Ok(edits)
    }

    /// The walk becomes two: what comes before, and what follows.
    fn parted(&self) -> Result<Vec<Edit>, Text> {
        let (text, elements) = (self.sheet.text, &self.sheet.outline.elements);
        let (row, owner) = (&elements[self.row], &elements[self.owner]);
        let cells = &self.rows[self.at.wall].cells;
        let own: &Cell = &cells[self.cell];
        let (gap, outer) = (
            gap_before(text, row.range.start),
            gap_before(text, owner.range.start),
        );
        let (leads_off, ends) = (self.cell == 0, self.cell + 1 == cells.len());
        let ways = leads(self.way(self.at.wall + usize::from(ends))?);
        let later = self.later();
        let mut behind = format!("{outer}</Loop>{outer}{}", self.tag());
        ways.iter()
            .for_each(|lead| behind += &format!("{gap}{lead}"));
        let mut edits = vec![];
        let mut range = own.range.clone();
        if leads_off {
            // Its comment goes along with the row.
            let comment = self.sheet.outline.comments[self.doubt.comment].clone();
            let is_own = self.doubt.row == self.row;
            let first = if is_own {
                comment.start
            } else {
                row.range.start
            };
            range.start = first - gap_before(text, first).len();
        } else {
            behind.insert_str(0, "</Row>");
        }
        if ends {
            range.end = row.range.end;
        } else {
            if !later.is_empty() {
                let list: Vec<&str> = later.iter().map(|e| &text[e.clone()]).collect();
                behind += &format!("{gap}<!-- in doubt: {} -->", list.join(", "));
            }
            behind += &format!("{gap}{}", &text[row.tag.clone()]);
        }
        if !leads_off || self.doubt.row != self.row {
            let gone = |entry: &Range<usize>| *entry == self.doubt.entry || later.contains(entry);
            edits.push(without(self.sheet, self.doubt.comment, &gone));
        }
        edits.push(Edit {
            range,
            text: behind,
        });
        Ok(edits)
    }

    /// Returns the start tag of a `Loop` that begins behind the part.
    fn tag(&self) -> String {
        let units = &self.wall().units[..=self.unit];
        let length: f64 = units.iter().map(|u| u.width).sum();
        let start = self.wall().from + self.wall().direction * length;
        let element = &self.sheet.outline.elements[self.owner];
        let mut tag = "<Loop".to_owned();
        for attribute in element.attributes.iter().filter(|a| a.word != "start") {
            tag += &format!(" {}", &self.sheet.text[attribute.range.clone()]);
        }
        tag + &format!(" start=\"{} {}\">", plain(start.x), plain(start.y))
    }

    /// Returns the entries of the same comment that stand for parts behind this one in its row.
    fn later(&self) -> Vec<Range<usize>> {
        let behind = |d: &Doubt| {
            d.unit
                .is_some_and(|(at, unit)| at == self.at && unit > self.unit)
        };
        let all = doubts(self.sheet).into_iter();
        let own = all.filter(|d| d.comment == self.doubt.comment && behind(d));
        own.map(|d| d.entry).collect()
    }
}
