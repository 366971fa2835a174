//! The walls, storeys, houses and roofs built from the source at a place.

use super::Request;
use crate::card::short;
use crate::vocabulary;
use glam::DVec3;
use hsd_base::diagnostic::{Noun, Text, noun};
use hsd_base::geometry::{SHAKU, area2};
use hsd_base::source::Span;
use hsd_base::text;
use hsd_ir::building::{Built, Finish, House, Ring, Roof, Room, Storey, Wall};
use std::ops::Range;

/// Maximum number of described walls per line; a repetition makes many.
const WALLS: usize = 3;

/// A tsubo, square metres.
const TSUBO: f64 = 400.0 / 121.0;

/// Describes the walls built from a row.
pub(super) fn walls(request: &Request<'_>, row: &Range<usize>) -> Vec<Text> {
    let is = |span: Span| {
        let range = request.a.source.text_range(span);
        span.file == request.a.source.id() && range.start < row.end && row.start < range.end && {
            // The row itself, or the line it was read as.
            range.start >= row.start && range.end <= row.end
                || row.start >= range.start && row.end <= range.end
        }
    };
    let mut found = vec![];
    for house in request.a.checked.building.houses.iter().map(|b| &b.house) {
        for storey in &house.storeys {
            for ring in &storey.rings {
                let walls = ring.walls.iter().filter(|w| is(w.span));
                found.extend(walls.map(|w| wall(house, storey, ring, w)));
            }
        }
    }
    let more = found.len().saturating_sub(WALLS);
    found.truncate(WALLS);
    if more > 0 {
        found.push(text!([more]
            "and {more} more walls of this line",
            "この行の壁はほかに {more} 枚"
        ));
    }
    found
}

fn wall(house: &House, storey: &Storey, ring: &Ring, wall: &Wall) -> Text {
    let units = (wall.to - wall.from).length();
    let (u, shaku, metres) = lengths(units, house.unit);
    let side: Text = side(ring, wall).into();
    let [a0, b0, a1, b1] = [wall.from.x, wall.from.y, wall.to.x, wall.to.y].map(|n| short(n, 3));
    let (parts, number) = (wall.units.len(), storey.number);
    let height = short((storey.z1 - storey.z0) / SHAKU, 2);
    text!([side, number, u, shaku, metres, a0, b0, a1, b1, parts, height]
        "**{side}**, storey {number}: {u} U = {shaku} shaku = {metres} m\n\nfrom ({a0}, {b0}) to ({a1}, {b1}) U, {parts} parts, storey {height} shaku high",
        "**{side}** {number}階: {u} U = {shaku} 尺 = {metres} m\n\n({a0}, {b0}) から ({a1}, {b1}) U まで、部材 {parts}、階高 {height} 尺"
    )
}

/// Formats a length in U, shaku and metres.
fn lengths(units: f64, unit: f64) -> (String, String, String) {
    let metres = units * unit;
    (short(units, 3), short(metres / SHAKU, 2), short(metres, 2))
}

/// Returns the side of a wall, as seen from the street.
fn side(ring: &Ring, wall: &Wall) -> Noun {
    let (x, y) = (wall.direction.x, wall.direction.y);
    match (ring.hole || ring.inner, x.abs() >= y.abs()) {
        (true, _) if ring.hole => noun("wall of a courtyard", "中庭の壁"),
        (true, _) => noun("wall inside", "内側の壁"),
        (_, true) if x > 0.0 => noun("front wall", "正面の壁"),
        (_, true) => noun("back wall", "背面の壁"),
        _ if y > 0.0 => noun("left wall", "左の壁"),
        _ => noun("right wall", "右の壁"),
    }
}

/// Describes the storeys built from an element, or from lines.
pub(super) fn storeys(request: &Request<'_>, element: &Range<usize>) -> Vec<Text> {
    let houses = request.a.checked.building.houses.iter().map(|b| &b.house);
    let all = houses.flat_map(|h| h.storeys.iter().map(move |s| (h, s)));
    let own = all.filter(|(_, s)| same(request, s.span, element));
    own.take(WALLS).map(|(h, s)| storey(h, s)).collect()
}

fn storey(house: &House, storey: &Storey) -> Text {
    let (area, perimeter) = measures(house, storey);
    let (number, z0, z1) = (
        storey.number,
        short(storey.z0 / SHAKU, 2),
        short(storey.z1 / SHAKU, 2),
    );
    let (u, shaku, metres) = lengths(perimeter, house.unit);
    let floor = bounded(area, noun("; area", "、面積"));
    text!([number, z0, z1, u, shaku, metres, floor]
        "storey {number}: {z0} to {z1} shaku above the sill; perimeter {u} U = {shaku} shaku = {metres} m{floor}",
        "{number}階: 土台から {z0}〜{z1} 尺、周長 {u} U = {shaku} 尺 = {metres} m{floor}"
    )
}

/// Formats an area; empty for walls that enclose none.
fn bounded(area: f64, what: Noun) -> Text {
    if area <= 0.0 {
        return "".into();
    }
    let (tsubo, area) = (short(area / TSUBO, 1), short(area, 1));
    text!([what, area, tsubo] "{what} {area} m² = {tsubo} tsubo", "{what} {area} m² = {tsubo} 坪")
}

/// Returns the area in square metres, and the length of the outer walls in U.
fn measures(house: &House, storey: &Storey) -> (f64, f64) {
    let (mut area, mut perimeter) = (0.0, 0.0);
    for ring in storey.rings.iter().filter(|r| !r.inner) {
        if ring.closed {
            let own = area2(&ring.corners()).abs() / 2.0 * house.unit * house.unit;
            area += if ring.hole { -own } else { own };
        }
        if !ring.hole {
            perimeter += ring
                .walls
                .iter()
                .map(|w| (w.to - w.from).length())
                .sum::<f64>();
        }
    }
    (area, perimeter)
}

/// Describes the rooms built from an element.
pub(super) fn rooms(request: &Request<'_>, element: &Range<usize>) -> Vec<Text> {
    let houses = request.a.checked.building.houses.iter();
    let all = houses.flat_map(|b| b.rooms.iter().map(move |r| (&b.house, r)));
    let own = all.filter(|(_, r)| same(request, r.span, element));
    own.take(WALLS).map(|(h, r)| room(h, r)).collect()
}

fn room(house: &House, room: &Room) -> Text {
    let area = bounded(room.area() * house.unit * house.unit, noun("area", "面積"));
    if room.mats.is_empty() {
        return area;
    }
    let mats = short(room.mat_count(), 1);
    text!([mats, area] "{mats} mats; {area}", "{mats}畳、{area}")
}

/// Describes the houses built from an element.
pub(super) fn houses(request: &Request<'_>, element: &Range<usize>) -> Vec<Text> {
    let all = request.a.checked.building.houses.iter();
    let own = all.filter(|b| same(request, b.house.span, element));
    own.take(WALLS)
        .map(|Built { house, roofs, .. }| {
            let area: f64 = house.storeys.iter().map(|s| measures(house, s).0).sum();
            let floors = bounded(area, noun("; floors", "、延べ面積"));
            let count = house.storeys.iter().map(|s| s.number).max().unwrap_or(0);
            let roofs = roofs.roofs.len();
            let top = house.storeys.iter().map(|s| s.z1).fold(0.0, f64::max);
            let (shaku, metres) = (short(top / SHAKU, 2), short(top, 2));
            text!([count, roofs, shaku, metres, floors]
                "{count} storeys, {roofs} roofs; walls {shaku} shaku = {metres} m high{floors}",
                "{count}階建て、屋根 {roofs}、壁の高さ {shaku} 尺 = {metres} m{floors}"
            )
        })
        .collect()
}

/// Describes the roofs built from a line or an element; for the whole section those of its house.
pub(super) fn roofs(request: &Request<'_>, place: &Range<usize>, section: bool) -> Vec<Text> {
    let mut found = vec![];
    for Built { house, roofs, .. } in &request.a.checked.building.houses {
        let here = section
            && request
                .a
                .source
                .text_range(house.span)
                .contains(&place.start);
        let own = roofs
            .roofs
            .iter()
            .filter(|r| here || r.span.is_some_and(|s| same(request, s, place)));
        found.extend(own.map(roof));
    }
    found.truncate(2 * WALLS);
    found
}

fn roof(roof: &Roof) -> Text {
    let letters = roof.shape.letters();
    let shape: Text =
        vocabulary::meaning(vocabulary::ROOF_SHAPES, letters).map_or(letters.into(), Text::from);
    let (mut area, mut steepest) = (0.0, (0.0, 0.0));
    for solid in &roof.solids {
        for face in solid
            .faces
            .iter()
            .filter(|f| matches!(f.finish, Finish::Covering(_)))
        {
            let points: Vec<DVec3> = face
                .corners
                .iter()
                .map(|c| solid.points[*c as usize])
                .collect();
            let normal = twice(&points);
            let own = normal.length() / 2.0;
            area += own;
            if own > steepest.0 && normal.z.abs() > 1e-9 {
                steepest = (own, normal.truncate().length() / normal.z.abs());
            }
        }
    }
    let (area, pitch) = (short(area, 1), short(steepest.1 * 10.0, 2));
    let storey = roof.storey;
    text!([storey, letters, shape, pitch, area]
        "built over storey {storey}: `{letters}` {shape}, pitch {pitch} sun, {area} m²",
        "{storey}階の上: `{letters}` {shape}、勾配 {pitch} 寸、{area} m²"
    )
}

/// Returns twice the area of a polygon, along its normal.
fn twice(points: &[DVec3]) -> DVec3 {
    let Some((first, rest)) = points.split_first() else {
        return DVec3::ZERO;
    };
    let pairs = rest.windows(2);
    pairs.map(|p| (p[0] - *first).cross(p[1] - *first)).sum()
}

fn same(request: &Request<'_>, span: Span, place: &Range<usize>) -> bool {
    let range = request.a.source.text_range(span);
    // Some keep the start tag only.
    span.file == request.a.source.id() && range.start == place.start && range.end <= place.end
}
