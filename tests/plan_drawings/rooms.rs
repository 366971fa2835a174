//! Rooms: the cells of a house cut by walls from side to side, a passage of earth, a veranda, mats.

use super::mask::Mask;
use super::rng::Rng;
use super::truth::{Area, Floor, Point, RoomTruth};

/// The room of each cell, -1 where there is none.
#[derive(Clone, Debug)]
pub struct RoomGrid {
    width: i32,
    depth: i32,
    ids: Vec<i32>,
}

impl RoomGrid {
    /// The room at a cell.
    pub fn at(&self, a: i32, b: i32) -> i32 {
        if (0..self.width).contains(&a) && (0..self.depth).contains(&b) {
            self.ids[(b * self.width + a) as usize]
        } else {
            -1
        }
    }

    fn give(&mut self, area: Area, id: i32) {
        for (a, b) in area.cells() {
            self.ids[(b * self.width + a) as usize] = id;
        }
    }

    /// Whether a cell is built on and has no room yet.
    fn free(&self, mask: &Mask, a: i32, b: i32) -> bool {
        mask.has(a, b) && self.at(a, b) < 0
    }
}

/// Cut a house into rooms.
pub fn divide(mask: &Mask, rng: &mut Rng) -> (RoomGrid, Vec<RoomTruth>) {
    let mut grid = RoomGrid {
        width: mask.width,
        depth: mask.depth,
        ids: vec![-1; (mask.width * mask.depth) as usize],
    };
    let mut rooms: Vec<RoomTruth> = Vec::new();
    let passage = mask.width >= 5 && rng.chance(0.55);
    if passage {
        let wide = if mask.width >= 8 && rng.chance(0.3) {
            3
        } else {
            2
        };
        let a = if rng.chance(0.5) {
            (0, wide)
        } else {
            (mask.width - wide, mask.width)
        };
        strip(
            mask,
            &mut grid,
            &mut rooms,
            Area {
                from: (a.0, 0),
                to: (a.1, mask.depth),
            },
            Floor::Earth,
        );
    }
    if mask.width * mask.depth >= 40 && rng.chance(0.5) {
        let back = Area {
            from: (0, mask.depth - 1),
            to: (mask.width, mask.depth),
        };
        strip(mask, &mut grid, &mut rooms, back, Floor::Veranda);
    }
    let mut areas = Vec::new();
    split(
        mask,
        &grid,
        Area {
            from: (0, 0),
            to: (mask.width, mask.depth),
        },
        rng,
        &mut areas,
    );
    for area in areas {
        let floor = floor_of(area, passage, rng);
        add(&mut grid, &mut rooms, area, floor);
    }
    for room in rooms.iter_mut().filter(|room| room.floor == Floor::Tatami) {
        room.mats = mats(room.area, rng);
    }
    (grid, rooms)
}

fn add(grid: &mut RoomGrid, rooms: &mut Vec<RoomTruth>, area: Area, floor: Floor) {
    grid.give(area, rooms.len() as i32);
    rooms.push(RoomTruth {
        area,
        floor,
        mats: Vec::new(),
    });
}

fn floor_of(area: Area, passage: bool, rng: &mut Rng) -> Floor {
    let (short, long) = (
        area.width().min(area.depth()),
        area.width().max(area.depth()),
    );
    if short < 2 || (short == 2 && long > 4) {
        return Floor::Board;
    }
    let chance = rng.unit();
    if chance < 0.70 {
        Floor::Tatami
    } else if chance < 0.90 || passage {
        Floor::Board
    } else {
        Floor::Earth
    }
}

/// Give the built and free stretches of a strip (full width only) to rooms of one floor.
fn strip(mask: &Mask, grid: &mut RoomGrid, rooms: &mut Vec<RoomTruth>, area: Area, floor: Floor) {
    let lengthwise = area.depth() > area.width() || floor == Floor::Earth;
    let (first, last) = if lengthwise {
        (area.from.1, area.to.1)
    } else {
        (area.from.0, area.to.0)
    };
    let across = |k: i32| {
        if lengthwise {
            Area {
                from: (area.from.0, k),
                to: (area.to.0, k + 1),
            }
        } else {
            Area {
                from: (k, area.from.1),
                to: (k + 1, area.to.1),
            }
        }
    };
    let mut start = None;
    for k in first..=last {
        let whole = k < last && across(k).cells().all(|(a, b)| grid.free(mask, a, b));
        match (whole, start) {
            (true, None) => start = Some(k),
            (false, Some(begin)) => {
                if k - begin >= 2 {
                    add(
                        grid,
                        rooms,
                        Area {
                            from: across(begin).from,
                            to: across(k - 1).to,
                        },
                        floor,
                    );
                }
                start = None;
            }
            _ => {}
        }
    }
}

/// Cut a rectangle until every piece is a room or holds nothing.
fn split(mask: &Mask, grid: &RoomGrid, area: Area, rng: &mut Rng, out: &mut Vec<Area>) {
    let total = area.width() * area.depth();
    let free = area.cells().filter(|&(a, b)| grid.free(mask, a, b)).count() as i32;
    if free == 0 {
        return;
    }
    let cut = if free == total {
        room_cut(area, rng)
    } else {
        border_cut(mask, grid, area)
    };
    let Some((along_a, at)) = cut else {
        out.push(area);
        return;
    };
    let (mut first, mut second) = (area, area);
    if along_a {
        (first.to.0, second.from.0) = (at, at);
    } else {
        (first.to.1, second.from.1) = (at, at);
    }
    split(mask, grid, first, rng, out);
    split(mask, grid, second, rng, out);
}

/// Where a whole rectangle is divided into two rooms; none if it is one.
fn room_cut(area: Area, rng: &mut Rng) -> Option<(bool, i32)> {
    let (w, d) = (area.width(), area.depth());
    let (short, long) = (w.min(d), w.max(d));
    let target = rng.whole(8, 20);
    if long < 4
        || (w * d <= target && long <= 2 * short + 1 && long <= 6)
        || (short == 1 && long <= 7)
    {
        return None;
    }
    let along_a = if w == d {
        rng.chance(0.5)
    } else {
        (w > d) != (short >= 5 && rng.chance(0.2))
    };
    let (from, n) = if along_a {
        (area.from.0, w)
    } else {
        (area.from.1, d)
    };
    let least = if n >= 5 && rng.chance(0.15) { 1 } else { 2 };
    let mut at = rng.whole(least, n - least);
    if at % 2 == 1 && at + 2 <= n && rng.chance(0.5) {
        at += 1;
    }
    Some((along_a, from + at.clamp(1, n - 1)))
}

/// The line of a mixed rectangle along which most changes between free and not free.
fn border_cut(mask: &Mask, grid: &RoomGrid, area: Area) -> Option<(bool, i32)> {
    let free = |a: i32, b: i32| grid.free(mask, a, b);
    let by_a = (area.from.0 + 1..area.to.0).map(|a| {
        let changes = (area.from.1..area.to.1)
            .filter(|&b| free(a, b) != free(a - 1, b))
            .count();
        (changes, true, a)
    });
    let by_b = (area.from.1 + 1..area.to.1).map(|b| {
        let changes = (area.from.0..area.to.0)
            .filter(|&a| free(a, b) != free(a, b - 1))
            .count();
        (changes, false, b)
    });
    by_a.chain(by_b)
        .max_by_key(|&(changes, _, at)| (changes, -at))
        .map(|(_, along_a, at)| (along_a, at))
}

/// Lay mats: four and a half in a pinwheel, others in rows that turn where they do not fit.
fn mats(area: Area, rng: &mut Rng) -> Vec<Area> {
    let (w, d) = (area.width(), area.depth());
    let mut taken = vec![false; (w * d) as usize];
    let prefer_a = if w == 3 && d == 3 {
        None
    } else {
        Some(rng.chance(0.5))
    };
    let mut out = Vec::new();
    let at = |p: Point| (p.1 * w + p.0) as usize;
    if prefer_a.is_none() {
        let pinwheel = [
            ((0, 0), (2, 1)),
            ((2, 0), (3, 2)),
            ((1, 2), (3, 3)),
            ((0, 1), (1, 3)),
            ((1, 1), (2, 2)),
        ];
        return pinwheel
            .iter()
            .map(|&(from, to)| moved(Area { from, to }, area.from))
            .collect();
    }
    for b in 0..d {
        for a in 0..w {
            if taken[at((a, b))] {
                continue;
            }
            let right = a + 1 < w && !taken[at((a + 1, b))];
            let back = b + 1 < d && !taken[at((a, b + 1))];
            let turn = (a == 0 && b % 2 == 0 && w % 2 == 1) || prefer_a == Some(false);
            let to = match (right, back) {
                (_, true) if turn || !right => (a + 1, b + 2),
                (true, _) => (a + 2, b + 1),
                _ => (a + 1, b + 1),
            };
            let mat = Area { from: (a, b), to };
            mat.cells().for_each(|cell| taken[at(cell)] = true);
            out.push(moved(mat, area.from));
        }
    }
    out
}

fn moved(area: Area, by: Point) -> Area {
    Area {
        from: (area.from.0 + by.0, area.from.1 + by.1),
        to: (area.to.0 + by.0, area.to.1 + by.1),
    }
}
