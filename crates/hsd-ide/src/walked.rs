//! The lines that the walls of a building come from. A line may make many walls: in a repetition, in a repeated storey,
//! in a definition that is used several times.

use super::Analysis;
use hsd_base::geometry::SHAKU;
use hsd_base::source::{FileId, Span};
use hsd_ir::ast::StoreyKind;
use hsd_ir::building::{Ring, Storey, Wall};
use std::collections::BTreeMap;
use std::ops::Range;

/// A storey as built.
#[derive(Clone, Copy)]
pub(super) struct Built<'a> {
    pub(super) storey: &'a Storey,
}

impl Built<'_> {
    /// Returns its height in shaku.
    pub(super) fn height(self) -> f64 {
        (self.storey.z1 - self.storey.z0) / SHAKU
    }

    /// Returns the length of its outer walls in units.
    pub(super) fn perimeter(self) -> f64 {
        let outer = self.storey.rings.iter().filter(|r| !r.hole && !r.inner);
        outer.flat_map(|r| &r.walls).map(length).sum()
    }
}

/// A wall as built, and its walk.
#[derive(Clone, Copy)]
pub(super) struct Walked<'a> {
    pub(super) wall: &'a Wall,
    pub(super) ring: &'a Ring,
    pub(super) unit: f64,
}

impl Walked<'_> {
    /// Returns true if two walls belong to the same walk.
    pub(super) fn is_beside(&self, other: &Walked<'_>) -> bool {
        std::ptr::eq(self.ring, other.ring)
    }

    /// Returns true for the last wall of its walk.
    pub(super) fn is_last(&self) -> bool {
        let last = self.ring.walls.last();
        last.is_some_and(|w| std::ptr::eq(w, self.wall))
    }
}

/// Returns the length of a wall in units.
pub(super) fn length(wall: &Wall) -> f64 {
    wall.from.distance(wall.to)
}

/// The things built from a range of the file, by its start and end.
pub(super) type Lines<T> = BTreeMap<(usize, usize), Vec<T>>;

/// Returns the storeys by their ranges of the file.
pub(super) fn storeys(a: &Analysis) -> Lines<Built<'_>> {
    let mut found = Lines::new();
    for built in &a.checked.building.houses {
        for storey in &built.house.storeys {
            if let Some(place) = place(a, storey.span) {
                found
                    .entry(place)
                    .or_insert_with(Vec::new)
                    .push(Built { storey });
            }
        }
    }
    found
}

/// Returns the walls whose lines touch a range of the file, by the ranges of these lines.
pub(super) fn walls<'a>(a: &'a Analysis, within: &Range<usize>) -> Lines<Walked<'a>> {
    let mut found = Lines::new();
    let span = a.source.span(within.clone());
    let touches = |s: Span| s.file == FileId(0) && s.start <= span.end && span.start <= s.end;
    for built in &a.checked.building.houses {
        let house = &built.house;
        let unit = house.unit;
        for ring in house.storeys.iter().flat_map(|s| &s.rings) {
            for wall in ring.walls.iter().filter(|w| touches(w.span)) {
                if let Some(place) = place(a, wall.span) {
                    let walked = Walked { wall, ring, unit };
                    found.entry(place).or_insert_with(Vec::new).push(walked);
                }
            }
        }
    }
    found
}

/// Returns the range of a span, if it is in the file itself.
fn place(a: &Analysis, span: Span) -> Option<(usize, usize)> {
    if span.file != a.source.id() {
        return None;
    }
    let range = a.source.text_range(span);
    Some((range.start, range.end))
}

/// Formats a number without needless decimals.
pub(super) fn plain(number: f64) -> String {
    let rounded = (number * 1000.0).round() / 1000.0;
    format!("{}", rounded + 0.0) // no negative zero
}

/// Formats the numbers of storeys as `3`, `2–5` or `2, 4`; `None` if all of them are parapets.
pub(super) fn numbers(storeys: &[Built<'_>]) -> Option<String> {
    let counted = storeys
        .iter()
        .filter(|s| s.storey.kind == StoreyKind::Storey);
    let mut all: Vec<u32> = counted.map(|s| s.storey.number).collect();
    all.sort_unstable();
    all.dedup();
    let (first, last) = (*all.first()?, *all.last()?);
    let whole = (last - first) as usize + 1 == all.len();
    Some(match (first == last, whole) {
        (true, _) => first.to_string(),
        (_, true) => format!("{first}–{last}"),
        _ => {
            let words: Vec<String> = all.iter().map(u32::to_string).collect();
            words.join(", ")
        }
    })
}

/// Formats the least and the greatest of some numbers as `8` or `8–9`.
pub(super) fn span_of(numbers: impl Iterator<Item = f64> + Clone) -> String {
    let least = numbers.clone().fold(f64::INFINITY, f64::min);
    let most = numbers.fold(f64::NEG_INFINITY, f64::max);
    let (least, most) = (plain(least), plain(most));
    if least == most {
        return least;
    }
    format!("{least}–{most}")
}
