//! House types written as rows, on outlines of any shape: the first row stands on the front, the others lend their parts to
//! the sides, and automatic roofs of the type's own covering take the place of its own. A type with `Walls` says all that
//! itself.

use crate::ast::{
    Half, House, Item, On, Piece, RoofMode, RoofShape, Row, SidePart, SideWall, Storey, Walls,
};
use crate::geometry::SHAKU;
use crate::source::{Span, Spanned};

/// Rewrites the rows of a house for its outline, whose front is this long in metres; false if it is written otherwise.
pub fn rewrite(house: &mut House, front: f64) -> bool {
    if house.monument.is_some() || !house.structures.is_empty() {
        return false;
    }
    for item in &mut house.storeys {
        match item {
            Item::One(storey) => {
                if !storey_over(storey) {
                    return false;
                }
            }
            _ => return false,
        }
    }
    roofs_over(house, front);
    true
}

/// Returns true if a type has walls for outlines.
pub fn has_walls(house: &House) -> bool {
    house.storeys.iter().any(|item| match item {
        Item::One(storey) => storey.walls.is_some() || storey.loops.is_empty(),
        _ => false,
    })
}

fn storey_over(storey: &mut Storey) -> bool {
    if storey.walls.is_some() {
        return true;
    }
    let Some(walk) = storey.loops.iter().find(|l| !l.hole && !l.inner) else {
        return storey.loops.is_empty();
    };
    let rows: Vec<&Row> = walk.rows.iter().filter_map(one).collect();
    let [front, side, back, ..] = rows[..] else {
        return false;
    };
    let span = walk.span;
    let wall = |on: On, pieces: Vec<Item<Piece>>| SideWall {
        span,
        on: Spanned::new(on, span),
        parts: vec![SidePart::Fill(Half { span, pieces })],
    };
    let sides = vec![
        wall(On::Front, front.pieces.clone()),
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
    true
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
    let is_pent = |line: &crate::ast::RoofLine| {
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
