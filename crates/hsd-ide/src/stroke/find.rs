//! The target of a stroke, in the building and in the source file.

use super::{WallAt, refuse};
use crate::sections;
use crate::stroke::sheet::{Reason, Sheet, name};
use hsd_base::diagnostic::Text;
use hsd_base::source::{FileId, Span};
use hsd_ir::building::{House, Ring, Storey};

/// Returns a house.
pub(super) fn house<'a>(sheet: &Sheet<'a>, house: usize) -> Result<&'a House, Text> {
    let houses = &sheet.a.checked.building.houses;
    let built = houses.get(house);
    built.map(|b| &b.house).ok_or_else(refuse::no_such_place)
}

/// Returns a storey and its house.
pub(super) fn storey<'a>(
    sheet: &Sheet<'a>,
    number: usize,
    storey: usize,
) -> Result<(&'a House, &'a Storey), Text> {
    let house = house(sheet, number)?;
    let storey = house.storeys.get(storey);
    storey.map(|s| (house, s)).ok_or_else(refuse::no_such_place)
}

/// Returns a ring with its house and storey; checks that the wall exists.
pub(super) fn ring<'a>(
    sheet: &Sheet<'a>,
    at: WallAt,
) -> Result<(&'a House, &'a Storey, &'a Ring), Text> {
    let (house, storey) = storey(sheet, at.house, at.storey)?;
    let ring = storey
        .rings
        .get(at.ring)
        .filter(|r| at.wall < r.walls.len());
    ring.map(|r| (house, storey, r))
        .ok_or_else(refuse::no_such_place)
}

/// The element or lines of a house or a storey in the file.
pub(super) enum Written {
    /// A house of the legacy form: its lines.
    Lines(sections::House),
    /// An element.
    Element(usize),
}

/// Returns the element or lines of a house.
pub(super) fn written_house(sheet: &Sheet<'_>, house: &House) -> Result<Written, Text> {
    if house.span.file != FileId(0) {
        return Err(Reason::Include.text());
    }
    let at = sheet.a.source.text_range(house.span).start;
    if let Some(line) = sheet.outline.line_at(at) {
        let all = sections::houses(sheet.outline, sheet.text);
        let own = all.into_iter().find(|h| h.lines.contains(&line));
        return own.map(Written::Lines).ok_or_else(refuse::no_such_place);
    }
    let element = element(sheet, house.span).ok_or_else(refuse::no_such_place)?;
    match sheet.around_fixed(element) {
        Some(reason) => Err(reason.text()),
        None => Ok(Written::Element(element)),
    }
}

/// Returns the element that begins where a span does.
pub(super) fn element(sheet: &Sheet<'_>, span: Span) -> Option<usize> {
    let at = sheet.a.source.text_range(span).start;
    let element = sheet.outline.element_at(at)?;
    let own = &sheet.outline.elements[element];
    (span.file == FileId(0) && own.range.start == at).then_some(element)
}

/// Returns the element of a storey that is written row by row.
pub(super) fn storey_element(sheet: &Sheet<'_>, storey: &Storey) -> Result<usize, Text> {
    if storey.span.file != FileId(0) {
        return Err(Reason::Include.text());
    }
    let found = element(sheet, storey.span);
    let Some(found) = found.filter(|e| name(&sheet.outline.elements[*e]) == "Storey") else {
        return Err(Reason::Monument.text());
    };
    match sheet.around_fixed(found) {
        Some(reason) => Err(reason.text()),
        None => Ok(found),
    }
}

/// Returns the index of a storey among those of a legacy house.
pub(super) fn storey_lines(
    sheet: &Sheet<'_>,
    house: &sections::House,
    storey: &Storey,
) -> Result<usize, Text> {
    let at = sheet.a.source.text_range(storey.span).start;
    let line = sheet.outline.line_at(at).unwrap_or(usize::MAX);
    let found = house.storeys.iter().position(|s| s.contains(&line));
    found.ok_or_else(refuse::no_such_place)
}
