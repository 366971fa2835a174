//! Strokes that draw and remove walls inside a storey.

use super::element::put;
use crate::format::Edit;
use crate::stroke::change::{CELL, Change, padded, tidy};
use crate::stroke::draft::Draft;
use crate::stroke::find;
use crate::stroke::part::meant;
use crate::stroke::refuse;
use crate::stroke::sheet::{Home, Sheet, name};
use crate::stroke::walls::inside;
use crate::stroke::xml::{gone, plain};
use crate::stroke::{StoreyAt, WallAt, write};
use glam::DVec2;
use hsd_base::diagnostic::Text;
use hsd_base::geometry::SAME;
use hsd_ir::building::Storey;

/// The wall that fills what whole parts leave.
const CLAY: &str = "KTU";
/// The largest number of drawn corners, and the longest wall, U.
const MOST: usize = 1000;
const LONGEST: f64 = 1000.0;

/// Draws a wall through some points, of one part that is repeated; clay wall fills the rest.
pub(in crate::stroke) fn draw(
    sheet: &Sheet<'_>,
    at: StoreyAt,
    points: &[[f64; 2]],
    part: Option<&str>,
) -> Result<Vec<Edit>, Text> {
    let (_, level) = find::storey(sheet, at.house, at.storey)?;
    let points: Vec<DVec2> = points.iter().map(|p| DVec2::from(*p)).collect();
    sound(&points)?;
    for side in points.windows(2) {
        stands(level, side[0], side[1])?;
    }
    let rows = rows(sheet, at.house, &points, part)?;
    let start = points[0];
    let lines = |gap: &str, step: &str| {
        let mut text = format!(
            "<Loop inner=\"yes\" start=\"{} {}\">",
            plain(start.x),
            plain(start.y)
        );
        for row in &rows {
            text += &format!("{gap}{step}{row}");
        }
        text + gap + "</Loop>"
    };
    let behind = ["Row", "Loop", "Walls", "repeat", "random", "replace"];
    Ok(vec![put(sheet, level, &behind, &lines)?])
}

/// Removes a walk inside a storey.
pub(in crate::stroke) fn remove(
    sheet: &Sheet<'_>,
    at: StoreyAt,
    ring: usize,
) -> Result<Vec<Edit>, Text> {
    let (_, level) = find::storey(sheet, at.house, at.storey)?;
    let ring = level.rings.get(ring).ok_or_else(refuse::no_such_place)?;
    if !ring.inner {
        return Err(refuse::outer_wall());
    }
    let rows = sheet.rows(ring);
    let Some(first) = rows.first() else {
        return Err(refuse::no_such_place());
    };
    let Home::Element(row) = first.home else {
        return Err(refuse::no_rooms());
    };
    let mut around = sheet.outline.around(row);
    let owner = around.find(|e| name(&sheet.outline.elements[*e]) == "Loop");
    let Some(owner) = owner else {
        return Err(first.fixed.map_or_else(refuse::no_such_place, |r| r.text()));
    };
    if let Some(reason) = sheet.around_fixed(owner) {
        return Err(reason.text());
    }
    let range = sheet.outline.elements[owner].range.clone();
    Ok(tidy(gone(sheet, range)))
}

/// Moves a straight wall inside along its normal.
pub(in crate::stroke) fn shift(
    sheet: &Sheet<'_>,
    at: WallAt,
    way: DVec2,
) -> Result<Vec<Edit>, Text> {
    let (_, level, ring) = find::ring(sheet, at)?;
    let rows = sheet.rows(ring);
    if let Some(reason) = sheet.ring_fixed(ring, &rows, at.wall) {
        return Err(reason.text());
    }
    let wall = &ring.walls[at.wall];
    stands(level, wall.from + way, wall.to + way)?;
    let mut draft = Draft::of(ring, &rows);
    draft.start += way;
    let change = Change {
        sheet,
        ring,
        rows: &rows,
        draft: &draft,
    };
    write::edits(&change)
}

/// Checks that points follow each other along the lines of the grid, whole units apart.
fn sound(points: &[DVec2]) -> Result<(), Text> {
    let near = |p: &DVec2| p.is_finite() && p.abs().max_element() <= 1e6;
    let straight = |side: &[DVec2]| {
        let way = side[1] - side[0];
        let length = way.length();
        let along = way.x.abs() < SAME || way.y.abs() < SAME;
        along && (length - length.round()).abs() < SAME && (1.0 - SAME..=LONGEST).contains(&length)
    };
    let bends = |corner: &[DVec2]| {
        (corner[1] - corner[0])
            .perp_dot(corner[2] - corner[1])
            .abs()
            > SAME
    };
    let count = (2..=MOST).contains(&points.len());
    let fine = count
        && points.iter().all(near)
        && points.windows(2).all(straight)
        && points.windows(3).all(bends);
    fine.then_some(()).ok_or_else(refuse::bad_inner)
}

/// Checks that a wall between two points lies in the storey, and on no other wall.
fn stands(storey: &Storey, from: DVec2, to: DVec2) -> Result<(), Text> {
    let length = (to - from).length();
    let way = (to - from) / length;
    let closed: Vec<(Vec<DVec2>, bool)> = storey
        .rings
        .iter()
        .filter(|r| r.closed && !r.inner)
        .map(|r| (r.corners(), r.hole))
        .collect();
    let within = |p: DVec2| {
        let court = closed.iter().any(|(c, hole)| *hole && inside(c, p));
        !court && closed.iter().any(|(c, hole)| !hole && inside(c, p))
    };
    let walls: Vec<(DVec2, DVec2)> = storey
        .rings
        .iter()
        .flat_map(|r| &r.walls)
        .map(|w| (w.from, w.to))
        .collect();
    let taken = |p: DVec2| {
        walls.iter().any(|(a, b)| {
            let own = *b - *a;
            let long = own.length();
            let along = long > SAME && own.perp_dot(way).abs() < SAME * long;
            let (off, far) = (own.perp_dot(p - *a).abs(), own.dot(p - *a));
            along && off < SAME * long && (0.0..=long * long).contains(&far)
        })
    };
    for half in 0..(length * 2.0).round() as u32 {
        let p = from + way * (f64::from(half) + 0.5) / 2.0;
        if taken(p) {
            return Err(refuse::wall_there());
        }
        if !within(p) {
            return Err(refuse::wall_outside());
        }
    }
    Ok(())
}

/// Returns the rows that only turn a walk, which begins leftwards, until it goes this way.
pub(super) fn leads(way: DVec2) -> Vec<String> {
    match way {
        way if way.x > 0.5 => vec![],
        way if way.x < -0.5 => vec!["<Row turn=\"R\"/>".to_owned(); 2],
        way => vec![format!("<Row turn=\"{}\"/>", turn(DVec2::X, way))],
    }
}

fn turn(from: DVec2, to: DVec2) -> &'static str {
    if from.perp_dot(to) > 0.0 { "R" } else { "L" }
}

/// Returns the rows of a wall, the first of which may only turn the walk, which begins leftwards.
fn rows(
    sheet: &Sheet<'_>,
    house: usize,
    points: &[DVec2],
    part: Option<&str>,
) -> Result<Vec<String>, Text> {
    let part = meant(sheet, house, part.unwrap_or(CLAY))?;
    if part.code.chars().count() > CELL || part.width < SAME {
        return Err(refuse::unknown_part(&part.code));
    }
    let ways: Vec<DVec2> = points
        .windows(2)
        .map(|side| (side[1] - side[0]).normalize().round())
        .collect();
    let mut rows = leads(ways[0]);
    for (number, side) in points.windows(2).enumerate() {
        let length = (side[1] - side[0]).length();
        let count = ((length + SAME) / part.width).floor();
        let rest = length - count * part.width;
        if count < 1.0 {
            return Err(refuse::too_wide(&part.code));
        }
        if (rest - rest.round()).abs() > SAME {
            return Err(refuse::half_units());
        }
        let codes =
            padded(&part.code).repeat(count as usize) + &padded(CLAY).repeat(rest.round() as usize);
        let bend = ways.get(number + 1);
        let bend = bend.map(|next| format!(" turn=\"{}\"", turn(ways[number], *next)));
        rows.push(format!(
            "<Row{}>{}</Row>",
            bend.unwrap_or_default(),
            codes.trim_end()
        ));
    }
    Ok(rows)
}
