//! House types written as rows, on outlines of any shape: the first row stands on the front, the others lend their parts to
//! the sides, and automatic roofs of the type's own covering take the place of its own. A type with `Walls` says all that
//! itself.

use hsd_base::geometry::SHAKU;
use hsd_base::source::{Span, Spanned};
use hsd_ir::ast::{
    Half, House, Item, Loop, On, Outline, Piece, Repeat, RoofMode, RoofShape, Row, SidePart,
    SideWall, Storey, Walls,
};

/// The front of an outline.
#[derive(Clone, Copy)]
pub struct Front {
    /// Its length, metres.
    pub length: f64,
    /// How often the type's own front stands on it.
    pub times: u32,
}

/// Puts a house on an outline; the rows of its front were made for a width of so many metres.
pub(super) fn stand_on(house: &mut House, outline: Outline, meant: Option<f64>) {
    let corners = &outline.points.value;
    let front = outline.front.map_or(1, |front| front.value as usize);
    let first = corners.get(front.wrapping_sub(1));
    let second = corners.get(front % corners.len().max(1));
    if let (Some(first), Some(second), false) = (first, second, has_walls(house)) {
        let length = first.value.distance(second.value);
        rewrite(house, Front::of(length, meant.unwrap_or(length)));
    }
    house.outline = Some(Box::new(outline));
}

impl Front {
    /// Creates a front of this length, on which fronts of a type stand that are made for a width.
    pub fn of(length: f64, meant: f64) -> Front {
        let times = (length / meant.max(1e-3)).round().max(1.0) as u32;
        Front { length, times }
    }
}

/// Rewrites the rows of a house for its outline; false, with the house as it was, if it is written otherwise.
pub fn rewrite(house: &mut House, front: Front) -> bool {
    let built = house.monument.is_some() || !house.structures.is_empty();
    if built || !house.storeys.iter().all(can_stand) {
        return false;
    }
    house.storeys.iter_mut().for_each(|item| stand(item, front));
    roofs_over(house, front.length);
    true
}

/// Returns true if storeys can stand on an outline: their rows are front, side and back, or walls inside.
fn can_stand(item: &Item<Storey>) -> bool {
    match item {
        Item::One(storey) => {
            let outer = storey.loops.iter().find(|l| !l.hole && !l.inner);
            let rows = |walk: &Loop| walk.rows.iter().filter_map(one).count();
            storey.walls.is_some() || outer.is_none_or(|walk| rows(walk) >= 3)
        }
        Item::Repeat(repeat) => repeat.body.iter().all(can_stand),
        Item::Random(_) | Item::Replace(_) => false,
    }
}

fn stand(item: &mut Item<Storey>, front: Front) {
    match item {
        Item::One(storey) => storey_over(storey, front),
        Item::Repeat(repeat) => repeat.body.iter_mut().for_each(|item| stand(item, front)),
        Item::Random(_) | Item::Replace(_) => {}
    }
}

/// Returns true if a type has walls for outlines.
pub fn has_walls(house: &House) -> bool {
    house.storeys.iter().any(|item| match item {
        Item::One(storey) => storey.walls.is_some() || storey.loops.is_empty(),
        _ => false,
    })
}

fn storey_over(storey: &mut Storey, front: Front) {
    if storey.walls.is_some() {
        return;
    }
    let Some(walk) = storey.loops.iter().find(|l| !l.hole && !l.inner) else {
        // Walls inside, such as a false front, are as wide as the front.
        let rows = storey.loops.iter_mut().flat_map(|l| &mut l.rows);
        rows.for_each(|row| repeated(row, front.times));
        return;
    };
    let rows: Vec<&Row> = walk.rows.iter().filter_map(one).collect();
    let [first_row, side, back, ..] = rows[..] else {
        return;
    };
    let span = walk.span;
    let wall = |on: On, pieces: Vec<Item<Piece>>| SideWall {
        span,
        on: Spanned::new(on, span),
        parts: vec![SidePart::Fill(Half { span, pieces })],
    };
    let sides = vec![
        wall(On::Front, first_row.pieces.clone()),
        wall(On::Back, back.pieces.clone()),
        wall(On::Any, first(&side.pieces, span)),
    ];
    storey.walls = Some(Box::new(Walls {
        span,
        part: None,
        rest: None,
        sides,
    }));
    storey.loops.clear();
    storey.start = None;
}

/// Repeats the parts of a row.
fn repeated(row: &mut Item<Row>, times: u32) {
    if let Item::One(row) = row
        && times > 1
    {
        let body = std::mem::take(&mut row.pieces);
        row.pieces = vec![Item::Repeat(Box::new(Repeat {
            span: row.span,
            num: Spanned::new(times, row.span),
            body,
        }))];
    }
}

fn one<T>(item: &Item<T>) -> Option<&T> {
    match item {
        Item::One(one) => Some(one),
        _ => None,
    }
}

/// Returns the first part of a row, from which a side can be filled.
fn first(pieces: &[Item<Piece>], _span: Span) -> Vec<Item<Piece>> {
    match pieces.first() {
        Some(Item::Repeat(repeat)) => first(&repeat.body, repeat.span),
        Some(item) => vec![item.clone()],
        None => vec![],
    }
}

/// Keeps the pent roofs along the front, and lets automatic roofs take over the rest.
fn roofs_over(house: &mut House, front: f64) {
    let shaku = house.settings.unit.map_or(3.0, |unit| unit.value);
    let units = front / (shaku * SHAKU);
    if house.roofs.lines.is_empty() {
        return;
    }
    let roofs = &mut *house.roofs;
    let is_pent = |line: &hsd_ir::ast::RoofLine| {
        let [_, b0, _, b1] = line.corners.value;
        line.style.shape.is_some_and(|s| s.value == RoofShape::Pent) && b0.min(b1) < 0.0
    };
    if let Some(main) = roofs.lines.iter().find(|line| !is_pent(line)) {
        roofs.style = main.style.clone();
        roofs.style.shape = None;
    }
    roofs.lines.retain(is_pent);
    for line in &mut roofs.lines {
        line.corners.value[0] = 0.0;
        line.corners.value[2] = units;
    }
    if let Some(mode) = &mut roofs.mode {
        mode.value = RoofMode::Auto;
    }
}
