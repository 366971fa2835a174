//! Walls in doubt: a reader of plans that is not certain of a wall says so in a comment directly before its `Row`.
//!
//! ```xml
//! <!-- in doubt: KTU at 3 0, TSH 2 at 7 0 -->
//! <Row>KTU  KTU  KTU  KTU  KTU  KTU  KTU  TSH 2</Row>
//! ```
//!
//! An entry has the code of a part and the place where the part begins, U to the left and back in the frame of the house, as
//! authors count. The comment is the only record: who takes an entry out has settled it. Where the wall has moved since, an
//! entry stands for the nearest part of its code at the same place along the walk; an entry that fits nothing stays, without
//! a wall.

use crate::stroke::WallAt;
use crate::stroke::sheet::{Sheet, name};
use glam::DVec2;
use hsd_base::geometry::SAME;
use hsd_base::source::FileId;
use std::collections::BTreeMap;
use std::ops::Range;

/// The words that begin such a comment.
const HEAD: &str = "in doubt:";

/// A wall in doubt.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Doubt {
    /// Its comment, among those of the file.
    pub(crate) comment: usize,
    /// Its entry in the comment.
    pub(crate) entry: Range<usize>,
    /// The numbers of its place.
    pub(crate) numbers: Range<usize>,
    /// The code that the entry names.
    pub(crate) code: String,
    /// The place that the entry names, U.
    pub(crate) at: DVec2,
    /// The `Row` behind the comment.
    pub(crate) row: usize,
    /// The part; none if nothing fits.
    pub(crate) unit: Option<(WallAt, usize)>,
}

/// Returns the walls in doubt of a file, in its order.
pub(crate) fn doubts(sheet: &Sheet<'_>) -> Vec<Doubt> {
    let mut found = written(sheet);
    if found.is_empty() {
        return found;
    }
    let walls = walls(sheet);
    for doubt in &mut found {
        let start = sheet.outline.elements[doubt.row].range.start;
        let wall = walls.get(&start).copied();
        doubt.unit = wall.and_then(|wall| unit(sheet, wall, doubt));
    }
    found
}

/// Returns the entries of a comment, whether they are understood or not.
pub(crate) fn entries(text: &str, comment: &Range<usize>) -> Vec<Range<usize>> {
    let written = &text[comment.clone()];
    let inner = written.strip_prefix("<!--").unwrap_or(written);
    let inner = inner.strip_suffix("-->").unwrap_or(inner);
    let body = inner.trim_start();
    let Some(list) = body.strip_prefix(HEAD) else {
        return vec![];
    };
    let mut at = comment.start + (inner.as_ptr() as usize - written.as_ptr() as usize);
    at += inner.len() - list.len();
    let mut found = vec![];
    for entry in list.split(',') {
        let blanks = entry.len() - entry.trim_start().len();
        let long = entry.trim().len();
        if long > 0 {
            found.push(at + blanks..at + blanks + long);
        }
        at += entry.len() + 1;
    }
    found
}

/// Returns the doubts as they are written, without their walls.
fn written(sheet: &Sheet<'_>) -> Vec<Doubt> {
    let (text, elements) = (sheet.text, &sheet.outline.elements);
    let mut found = vec![];
    for (comment, range) in sheet.outline.comments.iter().enumerate() {
        let entries = entries(text, range);
        let behind = elements.partition_point(|e| e.range.start < range.end);
        let row = elements.get(behind).filter(|e| name(e) == "Row");
        let Some(row) = row.filter(|_| !entries.is_empty()) else {
            continue;
        };
        if !text[range.end..row.range.start].trim().is_empty() {
            continue;
        }
        for entry in entries {
            if let Some((code, at, numbers)) = understood(&text[entry.clone()]) {
                found.push(Doubt {
                    comment,
                    numbers: entry.start + numbers.start..entry.start + numbers.end,
                    entry,
                    code,
                    at,
                    row: behind,
                    unit: None,
                });
            }
        }
    }
    found
}

/// Reads `TSH 2 at 7 0`; more words may follow. Returns also where the numbers are.
fn understood(entry: &str) -> Option<(String, DVec2, Range<usize>)> {
    let (code, place) = entry.rsplit_once(" at ")?;
    let mut words = place.split_whitespace();
    let (first, second) = (words.next()?, words.next()?);
    let (a, b): (f64, f64) = (first.parse().ok()?, second.parse().ok()?);
    let start = first.as_ptr() as usize - entry.as_ptr() as usize;
    let end = second.as_ptr() as usize - entry.as_ptr() as usize + second.len();
    let fine = !code.trim().is_empty() && a.is_finite() && b.is_finite();
    fine.then(|| (code.trim().to_owned(), DVec2::new(a, b), start..end))
}

/// Returns the walls of the file by the offsets of their rows; the first where a row makes several.
fn walls(sheet: &Sheet<'_>) -> BTreeMap<usize, WallAt> {
    let mut found = BTreeMap::new();
    for (house, built) in sheet.a.checked.building.houses.iter().enumerate() {
        for (storey, level) in built.house.storeys.iter().enumerate() {
            for (ring, walk) in level.rings.iter().enumerate() {
                for (wall, own) in walk.walls.iter().enumerate() {
                    if own.span.file == FileId(0) {
                        let start = sheet.a.source.text_range(own.span).start;
                        found.entry(start).or_insert(WallAt {
                            house,
                            storey,
                            ring,
                            wall,
                        });
                    }
                }
            }
        }
    }
    found
}

/// Returns the part of an entry: the one at its place in the wall, else the nearest of its code along the walk.
fn unit(sheet: &Sheet<'_>, at: WallAt, doubt: &Doubt) -> Option<(WallAt, usize)> {
    let storey = &sheet.a.checked.building.houses[at.house].house.storeys[at.storey];
    let ring = &storey.rings[at.ring];
    let way = ring.walls[at.wall].direction;
    let mut nearest: Option<(f64, WallAt, usize)> = None;
    for (wall, own) in ring.walls.iter().enumerate() {
        let mut from = own.from;
        for (unit, part) in own.units.iter().enumerate() {
            let off = doubt.at - from;
            from += own.direction * part.width;
            let here = wall == at.wall && off.length() < SAME;
            let code = || sheet.code(part) == doubt.code;
            let along = off.dot(own.direction).abs() < SAME && own.direction.distance(way) < SAME;
            if part.width < SAME || !(here || along && code()) {
                continue;
            }
            let far = if here { -1.0 } else { off.length() };
            if nearest.is_none_or(|(least, ..)| far < least) {
                nearest = Some((far, WallAt { wall, ..at }, unit));
            }
        }
    }
    nearest.map(|(_, wall, unit)| (wall, unit))
}
