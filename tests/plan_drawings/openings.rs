//! What stands on each unit of wall: doors so that every room is reached, lattices to the street, windows and sliding
//! doors to gardens and courtyards, plain wall for the rest.

use super::mask::Mask;
use super::rng::Rng;
use super::rooms::RoomGrid;
use super::truth::{Floor, Kind, Point, RoomTruth, Unit};

/// A straight stretch of wall between the same two rooms, or between one room and the outside.
struct Stretch {
    from: Point,
    along: Point,
    length: i32,
    rooms: (i32, i32),
}

/// Lays symbols one after the other and numbers them.
#[derive(Default)]
pub struct Layer {
    symbols: u32,
}

impl Layer {
    fn lay(&mut self, stretch: &Stretch, pieces: &[(Kind, i32)], out: &mut Vec<Unit>) {
        let mut at = stretch.from;
        for &(kind, length) in pieces.iter().filter(|piece| piece.1 > 0) {
            for _ in 0..length {
                let to = (at.0 + stretch.along.0, at.1 + stretch.along.1);
                out.push(Unit {
                    from: at,
                    to,
                    kind,
                    symbol: self.symbols,
                });
                at = to;
            }
            self.symbols += 1;
        }
    }
}

/// The units of the outline and of the courtyards.
pub fn outer(
    mask: &Mask,
    grid: &RoomGrid,
    rooms: &[RoomTruth],
    layer: &mut Layer,
    rng: &mut Rng,
) -> Vec<Unit> {
    let detached = rng.chance(0.45);
    let mut out = Vec::new();
    let mut entrance = false;
    for (number, path) in mask.loops().iter().enumerate() {
        for stretch in outer_stretches(path, grid) {
            let floor = rooms[stretch.rooms.0 as usize].floor;
            let side = if number > 0 {
                Side::Court
            } else if stretch.along == (1, 0) {
                Side::Front
            } else if stretch.along == (-1, 0) || detached {
                Side::Back
            } else {
                Side::Party
            };
            let mut pieces = outer_pieces(stretch.length, side, floor, rng);
            let door =
                |piece: &(Kind, i32)| matches!(piece.0, Kind::Slide | Kind::Hinged | Kind::Open);
            if side == Side::Front && !entrance && !pieces.iter().any(door) {
                pieces = entrance_pieces(stretch.length, rng);
            }
            entrance |= side == Side::Front && pieces.iter().any(door);
            layer.lay(&stretch, &pieces, &mut out);
        }
    }
    out
}

/// Which way an outer wall looks.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Front,
    Back,
    Party,
    Court,
}

fn outer_stretches(path: &[Point], grid: &RoomGrid) -> Vec<Stretch> {
    let n = path.len();
    let mut list: Vec<Stretch> = Vec::new();
    for k in 0..n {
        let (from, to) = (path[k], path[(k + 1) % n]);
        let along = (to.0 - from.0, to.1 - from.1);
        let cell = match along {
            (1, 0) => from,
            (0, 1) => (from.0 - 1, from.1),
            (-1, 0) => (to.0, from.1 - 1),
            _ => to,
        };
        let room = grid.at(cell.0, cell.1);
        match list.last_mut() {
            Some(last) if last.along == along && last.rooms.0 == room => last.length += 1,
            _ => list.push(Stretch {
                from,
                along,
                length: 1,
                rooms: (room, -1),
            }),
        }
    }
    list
}

fn entrance_pieces(length: i32, rng: &mut Rng) -> Vec<(Kind, i32)> {
    let wide = length.min(2);
    let kind = if wide == 2 {
        rng.pick(&[Kind::Slide, Kind::Slide, Kind::Open, Kind::Hinged])
    } else {
        rng.pick(&[Kind::Hinged, Kind::Slide])
    };
    let wide = if kind == Kind::Hinged { 1 } else { wide };
    let before = rng.whole(0, length - wide);
    vec![
        (Kind::Wall, before),
        (kind, wide),
        (Kind::Wall, length - wide - before),
    ]
}

/// What is usual on a side of the house; what stands twice is twice as usual.
#[rustfmt::skip]
fn bag(side: Side, floor: Floor) -> &'static [(Kind, i32)] {
    use Kind::*;
    let earth = floor == Floor::Earth;
    match side {
        Side::Front if earth => &[(Slide, 2), (Slide, 2), (Open, 2), (Hinged, 1), (Wall, 1), (Lattice, 1), (Slide, 1)],
        Side::Front => &[(Lattice, 2), (Lattice, 3), (Lattice, 1), (Window, 2), (Wall, 1), (Slide, 2), (Wall, 2), (Window, 1)],
        Side::Back if floor == Floor::Veranda => {
            &[(Slide, 2), (Slide, 4), (Open, 2), (Slide, 2), (Wall, 1)]
        }
        Side::Back if earth => &[(Hinged, 1), (Slide, 2), (Wall, 1), (Wall, 2), (Window, 1), (Slide, 1)],
        Side::Back => &[(Slide, 2), (Wall, 1), (Window, 2), (Wall, 2), (Window, 1), (Slide, 4), (Wall, 3)],
        Side::Court => &[(Slide, 2), (Slide, 2), (Window, 1), (Wall, 1), (Wall, 2), (Open, 1), (Window, 2)],
        Side::Party => &[(Wall, 3), (Wall, 4), (Wall, 5), (Wall, 2), (Wall, 6), (Window, 1), (Window, 2), (Hinged, 1), (Slide, 1)],
    }
}

/// Fill a stretch of outer wall from a bag of symbols that suits its side.
fn outer_pieces(length: i32, side: Side, floor: Floor, rng: &mut Rng) -> Vec<(Kind, i32)> {
    let bag = bag(side, floor);
    let mut pieces: Vec<(Kind, i32)> = Vec::new();
    let mut left = length;
    while left > 0 {
        let (kind, wide) = rng.pick(bag);
        let wide = if kind == Kind::Wall {
            wide.min(left)
        } else {
            wide
        };
        if wide > left {
            if left == 1 || rng.chance(0.3) {
                let kind = if rng.chance(0.7) {
                    Kind::Wall
                } else {
                    Kind::Window
                };
                push(&mut pieces, kind, 1);
                left -= 1;
            }
            continue;
        }
        push(&mut pieces, kind, wide);
        left -= wide;
    }
    pieces
}

/// Walls and lattices run together, everything else stands for itself.
fn push(pieces: &mut Vec<(Kind, i32)>, kind: Kind, wide: i32) {
    match pieces.last_mut() {
        Some(last) if last.0 == kind && matches!(kind, Kind::Wall | Kind::Lattice | Kind::Open) => {
            last.1 += wide
        }
        _ => pieces.push((kind, wide)),
    }
}

/// The units between rooms: a tree of doors reaches every room, more doors stand where it pleases.
pub fn inner(
    mask: &Mask,
    grid: &RoomGrid,
    rooms: &[RoomTruth],
    layer: &mut Layer,
    rng: &mut Rng,
) -> Vec<Unit> {
    let stretches = inner_stretches(mask, grid);
    let floor = |id: i32| rooms[id as usize].floor;
    let mut order: Vec<(i32, usize)> = Vec::new();
    for (k, stretch) in stretches.iter().enumerate() {
        let loved = i32::from(floor(stretch.rooms.0) != Floor::Board)
            + i32::from(floor(stretch.rooms.1) != Floor::Board);
        order.push((
            -(stretch.length.min(4) * 2 + loved * 3 + rng.whole(0, 8)),
            k,
        ));
    }
    order.sort_unstable();
    let mut group: Vec<usize> = (0..rooms.len()).collect();
    let mut doors = vec![false; stretches.len()];
    for (_, k) in order {
        let (first, second) = (
            root(&group, stretches[k].rooms.0),
            root(&group, stretches[k].rooms.1),
        );
        let mats = floor(stretches[k].rooms.0) == Floor::Tatami
            && floor(stretches[k].rooms.1) == Floor::Tatami;
        doors[k] = first != second || rng.chance(if mats { 0.55 } else { 0.2 });
        group[first] = second;
    }
    let mut out = Vec::new();
    for (stretch, door) in stretches.iter().zip(doors) {
        let pieces = if door {
            door_pieces(
                stretch.length,
                (floor(stretch.rooms.0), floor(stretch.rooms.1)),
                rng,
            )
        } else {
            closed_pieces(stretch.length, rng)
        };
        layer.lay(stretch, &pieces, &mut out);
    }
    out
}

fn root(group: &[usize], id: i32) -> usize {
    let mut at = id as usize;
    while group[at] != at {
        at = group[at];
    }
    at
}

fn closed_pieces(length: i32, rng: &mut Rng) -> Vec<(Kind, i32)> {
    if length >= 2 && rng.chance(0.08) {
        let before = rng.whole(0, length - 1);
        let kind = if rng.chance(0.6) {
            Kind::Window
        } else {
            Kind::Lattice
        };
        return vec![
            (Kind::Wall, before),
            (kind, 1),
            (Kind::Wall, length - 1 - before),
        ];
    }
    vec![(Kind::Wall, length)]
}

/// A door in an inner wall, with wall on both sides of it.
fn door_pieces(length: i32, floors: (Floor, Floor), rng: &mut Rng) -> Vec<(Kind, i32)> {
    use Kind::*;
    let veranda = floors.0 == Floor::Veranda || floors.1 == Floor::Veranda;
    let mats = floors == (Floor::Tatami, Floor::Tatami);
    if (veranda || (mats && rng.chance(0.4))) && length >= 2 {
        let mut pieces = vec![(Slide, 2); (length / 2) as usize];
        if length >= 4 && rng.chance(0.4) {
            pieces[0] = (Slide, 4);
            pieces.pop();
        }
        if length % 2 == 1 {
            pieces.insert(if rng.chance(0.5) { 0 } else { pieces.len() }, (Wall, 1));
        }
        return pieces;
    }
    let (kind, wide) = match length {
        1 => (rng.pick(&[Slide, Slide, Hinged, Open]), 1),
        2 | 3 => rng.pick(&[
            (Slide, 2),
            (Slide, 2),
            (Slide, 1),
            (Hinged, 1),
            (Open, 1),
            (Open, 2),
        ]),
        _ => rng.pick(&[
            (Slide, 2),
            (Slide, 2),
            (Slide, 4),
            (Slide, 1),
            (Hinged, 1),
            (Open, 2),
            (Open, 1),
        ]),
    };
    let spare = length - wide;
    let before = match spare {
        0 => 0,
        n if n % 2 == 0 && rng.chance(0.5) => n / 2,
        n => rng.whole(0, n),
    };
    vec![(Wall, before), (kind, wide), (Wall, spare - before)]
}

fn inner_stretches(mask: &Mask, grid: &RoomGrid) -> Vec<Stretch> {
    let mut list: Vec<Stretch> = Vec::new();
    let mut add = |from: Point, along: Point, rooms: (i32, i32)| {
        if rooms.0 < 0 || rooms.1 < 0 || rooms.0 == rooms.1 {
            return;
        }
        let end = |s: &Stretch| {
            (
                s.from.0 + s.along.0 * s.length,
                s.from.1 + s.along.1 * s.length,
            )
        };
        match list.last_mut() {
            Some(last) if last.along == along && last.rooms == rooms && end(last) == from => {
                last.length += 1
            }
            _ => list.push(Stretch {
                from,
                along,
                length: 1,
                rooms,
            }),
        }
    };
    for a in 1..mask.width {
        for b in 0..mask.depth {
            add((a, b), (0, 1), (grid.at(a - 1, b), grid.at(a, b)));
        }
    }
    for b in 1..mask.depth {
        for a in 0..mask.width {
            add((a, b), (1, 0), (grid.at(a, b - 1), grid.at(a, b)));
        }
    }
    list
}
