//! How the plan of an upper storey lies over the one on the ground: where walls stand on walls.

use super::shape::{Shape, Wall};
use std::collections::BTreeSet;

/// What a wall to the outside on a wall to the outside counts, beside one on any other wall.
const OUTER: i32 = 2;
/// What a cell over no cell costs: upper storeys seldom stand out.
const OVERHANG: i32 = 2;

/// Ends of a unit of a wall, the lesser first.
type Side = ((i32, i32), (i32, i32));

/// Finds how the units of an upper storey are moved to lie on those of the ground, to the right and down; where walls agree
/// equally, the least move.
pub fn register(ground: &Shape, upper: &Shape) -> (i32, i32) {
    let outer: BTreeSet<Side> = ground.outer.iter().map(side).collect();
    let inner: BTreeSet<Side> = ground.inner.iter().map(side).collect();
    let moves = between(ground, upper, |c| c.0)
        .flat_map(|u| between(ground, upper, |c| c.1).map(move |v| (u, v)));
    let agreement = |&by: &(i32, i32)| {
        let on = |wall: &Wall, most: i32| match moved(side(wall), by) {
            at if outer.contains(&at) => most,
            at if inner.contains(&at) => 1,
            _ => 0,
        };
        let outside = upper
            .cells
            .iter()
            .filter(|c| !ground.cells.contains(&(c.0 + by.0, c.1 + by.1)))
            .count() as i32;
        upper.outer.iter().map(|w| on(w, OUTER)).sum::<i32>()
            + upper.inner.iter().map(|w| on(w, 1)).sum::<i32>()
            - OVERHANG * outside
    };
    moves
        .max_by_key(|by| (agreement(by), -by.0.abs() - by.1.abs(), -by.1, -by.0))
        .unwrap_or_default()
}

/// Moves along one direction after which the storeys lie over each other: from one's end at the other's end to the reverse.
fn between(
    ground: &Shape,
    upper: &Shape,
    of: impl Fn(&(i32, i32)) -> i32,
) -> std::ops::RangeInclusive<i32> {
    let ends = |shape: &Shape| {
        let all = || shape.cells.iter().map(&of);
        (all().min().unwrap_or(0), all().max().unwrap_or(0))
    };
    let (g, u) = (ends(ground), ends(upper));
    let (one, other) = (g.0 - u.0, g.1 - u.1);
    one.min(other)..=one.max(other)
}

fn side(wall: &Wall) -> Side {
    (wall.from.min(wall.to), wall.from.max(wall.to))
}

fn moved(side: Side, by: (i32, i32)) -> Side {
    let at = |p: (i32, i32)| (p.0 + by.0, p.1 + by.1);
    (at(side.0), at(side.1))
}
