//! The house that the strokes stand round: its outline, its courts, its rooms.

pub mod inside;
mod settle;

use super::legend::Role;
use super::strokes::{Read, Units};
use inside::Floor;
use std::collections::{BTreeMap, BTreeSet};

/// The widest gap without strokes that may be a way between two walls of one line, units: two ken.
const GAP: i32 = 4;
/// The same where posts are seen at both of its ends: three ken.
const BETWEEN_POSTS: i32 = 6;
/// How clearly a post has to be seen to be one.
const CLEAR_POST: f64 = 0.5;
/// The widest gap within a house that is a way and no corner of a room, units.
const DOOR: i32 = 2;

/// The share of corners with posts from which on a drawing shows all of its posts, and how clear the least of these is.
const POSTED: f64 = 0.8;
const BARE: f64 = 0.2;

/// A unit of a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// Where it begins: to the right and down, units.
    pub from: (i32, i32),
    /// Where it ends.
    pub to: (i32, i32),
    /// What it was read as.
    pub read: Read,
    /// Whether nothing was seen there, and it joins two walls.
    pub is_joined: bool,
}

/// A house on its grid.
#[derive(Clone, Debug, Default)]
pub struct Shape {
    /// Cells of the house: their upper left crossings.
    pub cells: BTreeSet<(i32, i32)>,
    /// Its walls to the outside.
    pub outer: Vec<Wall>,
    /// Walls between its cells.
    pub inner: Vec<Wall>,
    /// Rooms: cells without walls between them.
    pub rooms: Vec<BTreeSet<(i32, i32)>>,
    /// The floors of rooms by their index in `rooms`; rooms whose floor the drawing does not show are left out.
    pub floors: BTreeMap<usize, Floor>,
    /// Stairs, closets, stoves and wells in the rooms.
    pub things: Vec<inside::Found>,
}

/// A side of a cell: where it begins, whether it is upright, and the cell beyond it.
type CellSide = ((i32, i32), bool, (i32, i32));

/// A gap between walls that was closed.
#[derive(Clone, Copy)]
struct Gap {
    /// Whether walls of its line stand at both ends and it is no wider than a door.
    is_door: bool,
    /// Units.
    length: i32,
}

/// What parts two cells.
#[derive(Clone)]
struct Lines<'a> {
    units: &'a Units,
    /// The share of corners of walls on which posts are drawn.
    posted: f64,
    joined: BTreeMap<UnitSide, Gap>,
    /// Sides of the house that lie elsewhere if an outline is right that is hardly worse.
    unsure: BTreeSet<UnitSide>,
}

impl Lines<'_> {
    /// Whether a post may stand at a crossing: one is seen, or the drawing shows none.
    fn may_have_post(&self, at: (i32, i32)) -> bool {
        self.posted < POSTED || self.units.post(at) > BARE
    }

    fn read(&self, at: (i32, i32), upright: bool) -> Read {
        if upright {
            self.units.upright(at.0, at.1)
        } else {
            self.units.level(at.0, at.1)
        }
    }

    fn parts(&self, at: (i32, i32), upright: bool) -> bool {
        self.read(at, upright).role.parts() || self.joined.contains_key(&(at, upright))
    }

    /// Cells that walls part from what lies outside.
    fn enclosed(&self) -> BTreeSet<(i32, i32)> {
        let ((u0, u1), (v0, v1)) = (self.units.across, self.units.down);
        let within = |(u, v): (i32, i32)| u >= u0 - 1 && u <= u1 && v >= v0 - 1 && v <= v1;
        let outside = flood((u0 - 1, v0 - 1), within, |cell| self.beside(cell).collect());
        let all = (v0..v1).flat_map(|v| (u0..u1).map(move |u| (u, v)));
        all.filter(|cell| !outside.contains(cell)).collect()
    }

    /// The four sides of a cell, each with the cell beyond it: where it begins, and whether it is upright.
    fn sides((u, v): (i32, i32)) -> [CellSide; 4] {
        [
            ((u, v), true, (u - 1, v)),
            ((u + 1, v), true, (u + 1, v)),
            ((u, v), false, (u, v - 1)),
            ((u, v + 1), false, (u, v + 1)),
        ]
    }

    /// Whether a room without ink in it lies outside a drawing whose strokes are all known: it is open to the outside, and no wall
    /// of it stands between outside and outside.
    fn is_outside(&self, room: &BTreeSet<(i32, i32)>, cells: &BTreeSet<(i32, i32)>) -> bool {
        if room.iter().any(|c| self.units.is_inked(*c)) {
            return false;
        }
        let sides = room
            .iter()
            .flat_map(|c| Lines::sides(*c))
            .filter(|(_, _, beyond)| !cells.contains(beyond));
        let (gaps, walls): (Vec<_>, Vec<_>) =
            sides.partition(|(at, upright, _)| self.joined.contains_key(&(*at, *upright)));
        !gaps.is_empty() && walls.is_empty()
    }

    /// The cells that walls enclose in a drawing whose strokes are all known, without recesses: a recess looks like a room with an
    /// open front, but nothing is drawn in it.
    fn closed(&mut self) -> BTreeSet<(i32, i32)> {
        let mut cells = self.enclosed();
        loop {
            // Ways between rooms part nothing where all strokes are known.
            let drawn = Lines {
                units: self.units,
                posted: self.posted,
                joined: BTreeMap::new(),
                unsure: BTreeSet::new(),
            };
            let open: Vec<BTreeSet<(i32, i32)>> = rooms(&cells, &drawn)
                .into_iter()
                .filter(|r| self.is_outside(r, &cells))
                .collect();
            if open.is_empty() {
                return cells;
            }
            for room in open {
                self.open(&room, &cells);
                cells.retain(|c| !room.contains(c));
            }
        }
    }

    /// Takes back that gaps before a room are ways.
    fn open(&mut self, room: &BTreeSet<(i32, i32)>, cells: &BTreeSet<(i32, i32)>) {
        for (at, upright, beyond) in room.iter().flat_map(|c| Lines::sides(*c)) {
            if !cells.contains(&beyond) {
                self.joined.remove(&(at, upright));
            }
        }
    }

    /// Takes back gaps inside, but for doors where they are kept: walls that face each other across a room are no reason for one between them.
    fn keep_outer(&mut self, cells: &BTreeSet<(i32, i32)>, keeps_doors: bool) {
        self.joined.retain(|((u, v), upright), gap| {
            let other = if *upright { (u - 1, *v) } else { (*u, v - 1) };
            keeps_doors && gap.is_door || cells.contains(&(*u, *v)) != cells.contains(&other)
        });
    }

    /// Takes every side of the house where nothing is drawn for a way.
    fn close(&mut self, cells: &BTreeSet<(i32, i32)>) {
        for (at, upright, beyond) in cells.iter().flat_map(|c| Lines::sides(*c)) {
            if !cells.contains(&beyond) && !self.parts(at, upright) {
                let gap = Gap {
                    is_door: false,
                    length: 1,
                };
                self.joined.insert((at, upright), gap);
            }
        }
    }

    /// Cells beside a cell that no wall parts from it.
    fn beside(&self, (u, v): (i32, i32)) -> impl Iterator<Item = (i32, i32)> {
        [
            ((u - 1, v), self.parts((u, v), true)),
            ((u + 1, v), self.parts((u + 1, v), true)),
            ((u, v - 1), self.parts((u, v), false)),
            ((u, v + 1), self.parts((u, v + 1), false)),
        ]
        .into_iter()
        .filter(|(_, parted)| !parted)
        .map(|(cell, _)| cell)
    }
}

impl Shape {
    /// Finds the house in the units of a grid.
    pub fn of(units: &Units) -> Shape {
        Shape::found(units, false)
    }

    /// How thick the ink of a wall of the outline is, in the middle of all, units.
    pub fn thickness(&self) -> f64 {
        let walls = self.outer.iter().filter(|w| w.read.role == Role::Wall);
        let mut all: Vec<f64> = walls.map(|w| w.read.ink).collect();
        all.sort_by(f64::total_cmp);
        all.get(all.len() / 2).copied().unwrap_or(0.0)
    }

    /// Windows and lattices between rooms of less ink than that: the crossings at which they begin, and whether they run
    /// downwards. They belong into the outline; the edge of a mat with a line beside it looks like them.
    pub fn thin_panes(&self, least: f64) -> Vec<((i32, i32), bool)> {
        let is_pane = |w: &&Wall| matches!(w.read.role, Role::Window | Role::Lattice);
        let thin = self.inner.iter().filter(is_pane);
        let thin = thin.filter(|w| w.read.ink < least);
        thin.map(|w| (w.from.min(w.to), w.from.0 == w.to.0))
            .collect()
    }

    /// Finds the house in the units of a drawing whose strokes are all known: nothing but its outline is closed where nothing is
    /// drawn.
    pub fn drawn(units: &Units) -> Shape {
        Shape::found(units, true)
    }

    fn found(units: &Units, is_drawn: bool) -> Shape {
        let mut lines = Lines {
            units,
            posted: posted(units),
            joined: BTreeMap::new(),
            unsure: BTreeSet::new(),
        };
        lines.joined = gaps(&lines);
        if !is_drawn {
            let corners = corners(&lines);
            corners.into_iter().for_each(|(at, gap)| {
                lines.joined.entry(at).or_insert(gap);
            });
        }
        let cells = if is_drawn {
            lines.closed()
        } else {
            let (cells, unsure) = settle::settled(&lines);
            lines.unsure = unsure;
            cells
        };
        let cells = largest(cells);
        lines.keep_outer(&cells, !is_drawn);
        lines.close(&cells);
        let mut shape = Shape {
            cells,
            ..Shape::default()
        };
        shape.walls(&lines);
        shape.rooms = rooms(&shape.cells, &lines);
        shape.floors = (0..shape.rooms.len())
            .filter(|k| has_mats(&shape.rooms[*k], units))
            .map(|k| (k, Floor::Tatami))
            .collect();
        shape
    }

    fn walls(&mut self, lines: &Lines<'_>) {
        let is = |cell: (i32, i32)| self.cells.contains(&cell);
        let mut outer = Vec::new();
        let mut inner = Vec::new();
        let ((u0, u1), (v0, v1)) = (lines.units.across, lines.units.down);
        for v in v0..=v1 {
            for u in u0..=u1 {
                for (upright, other, to) in [
                    (true, (u - 1, v), (u, v + 1)),
                    (false, (u, v - 1), (u + 1, v)),
                ] {
                    let (a, b) = (is((u, v)), is(other));
                    let mut wall = Wall {
                        from: (u, v),
                        to,
                        read: lines.read((u, v), upright),
                        is_joined: lines.joined.contains_key(&((u, v), upright)),
                    };
                    if a != b {
                        if lines.unsure.contains(&((u, v), upright)) {
                            wall.read.lead = 0.0;
                        }
                        outer.push(wall);
                    } else if a && lines.parts((u, v), upright) {
                        inner.push(wall);
                    }
                }
            }
        }
        self.outer = outer;
        self.inner = inner;
    }
}

/// The share of corners of walls on which posts are drawn.
fn posted(units: &Units) -> f64 {
    let ((u0, u1), (v0, v1)) = (units.across, units.down);
    let level = |u: i32, v: i32| units.level(u, v).role.parts();
    let upright = |u: i32, v: i32| units.upright(u, v).role.parts();
    let turns =
        |&(u, v): &(i32, i32)| level(u, v) != level(u - 1, v) && upright(u, v) != upright(u, v - 1);
    let all = (v0..=v1).flat_map(|v| (u0..=u1).map(move |u| (u, v)));
    let posts: Vec<f64> = all.filter(turns).map(|at| units.post(at)).collect();
    posts.iter().sum::<f64>() / posts.len().max(1) as f64
}

/// Units without strokes between walls of one line, or between such a wall and a corner.
fn gaps(lines: &Lines<'_>) -> BTreeMap<UnitSide, Gap> {
    let ((u0, u1), (v0, v1)) = (lines.units.across, lines.units.down);
    let mut out = BTreeMap::new();
    for upright in [false, true] {
        let (lengthwise, crosswise) = if upright {
            ((v0, v1), (u0, u1))
        } else {
            ((u0, u1), (v0, v1))
        };
        for line in crosswise.0..=crosswise.1 {
            let at = |k: i32| if upright { (line, k) } else { (k, line) };
            let stands =
                |k: i32| k >= lengthwise.0 && k < lengthwise.1 && lines.parts(at(k), upright);
            let crosses = |k: i32| {
                let (u, v) = at(k);
                if upright {
                    lines.parts((u, v), false) || lines.parts((u - 1, v), false)
                } else {
                    lines.parts((u, v), true) || lines.parts((u, v - 1), true)
                }
            };
            let mut k = lengthwise.0;
            while k < lengthwise.1 {
                if stands(k) || !(stands(k - 1) || crosses(k)) {
                    k += 1;
                    continue;
                }
                let mut end = k + 1;
                while end < lengthwise.1 && !stands(end) && !crosses(end) {
                    end += 1;
                }
                let is_held = stands(end) || crosses(end);
                let between_posts =
                    lines.units.post(at(k)).min(lines.units.post(at(end))) > CLEAR_POST;
                let most = if between_posts { BETWEEN_POSTS } else { GAP };
                if end - k <= most && is_held {
                    let is_door = stands(k - 1) && stands(end) && end - k <= DOOR;
                    let gap = Gap {
                        is_door,
                        length: end - k,
                    };
                    out.extend((k..end).map(|j| ((at(j), upright), gap)));
                }
                k = end;
            }
        }
    }
    out
}

/// A unit of a line: where it begins, and true if it is upright.
type UnitSide = ((i32, i32), bool);

/// Units without strokes at both sides of a corner, where two walls would meet if they went on.
fn corners(lines: &Lines<'_>) -> Vec<(UnitSide, Gap)> {
    let ((u0, u1), (v0, v1)) = (lines.units.across, lines.units.down);
    let mut out = Vec::new();
    let all = (v0..=v1).flat_map(|v| (u0..=u1).map(move |u| (u, v)));
    // The corner of a house stands on a post.
    for corner in all.filter(|at| lines.may_have_post(*at)) {
        // The units from the corner to where a wall begins that goes on from there.
        let arm = |upright: bool, step: i32| {
            let unit = |k: i32| {
                let along = if step > 0 { k } else { -k - 1 };
                let at = match upright {
                    true => (corner.0, corner.1 + along),
                    false => (corner.0 + along, corner.1),
                };
                (at, upright)
            };
            let parts = |k: i32| lines.parts(unit(k).0, upright);
            let length = (0..=DOOR).find(|k| parts(*k)).filter(|k| *k > 0)?;
            Some((0..length).map(unit).collect::<Vec<_>>())
        };
        for (level, upright) in [(-1, -1), (-1, 1), (1, -1), (1, 1)] {
            let (Some(level), Some(upright)) = (arm(false, level), arm(true, upright)) else {
                continue;
            };
            for units in [level, upright] {
                let length = units.len() as i32;
                let gap = |at| {
                    (
                        at,
                        Gap {
                            is_door: false,
                            length,
                        },
                    )
                };
                out.extend(units.into_iter().map(gap));
            }
        }
    }
    out
}

fn flood(
    from: (i32, i32),
    within: impl Fn((i32, i32)) -> bool,
    beside: impl Fn((i32, i32)) -> Vec<(i32, i32)>,
) -> BTreeSet<(i32, i32)> {
    let mut seen = BTreeSet::from([from]);
    let mut open = vec![from];
    while let Some(cell) = open.pop() {
        for next in beside(cell) {
            if within(next) && seen.insert(next) {
                open.push(next);
            }
        }
    }
    seen
}

/// The largest group of cells that touch along a side.
fn largest(cells: BTreeSet<(i32, i32)>) -> BTreeSet<(i32, i32)> {
    let mut left = cells.clone();
    let mut best = BTreeSet::new();
    while let Some(&first) = left.iter().next() {
        let group = flood(
            first,
            |c| cells.contains(&c),
            |(u, v)| vec![(u - 1, v), (u + 1, v), (u, v - 1), (u, v + 1)],
        );
        left.retain(|c| !group.contains(c));
        if group.len() > best.len() {
            best = group;
        }
    }
    best
}

/// Groups of cells without walls between them.
fn rooms(cells: &BTreeSet<(i32, i32)>, lines: &Lines<'_>) -> Vec<BTreeSet<(i32, i32)>> {
    let mut left = cells.clone();
    let mut rooms = Vec::new();
    while let Some(&first) = left.iter().next() {
        let room = flood(first, |c| cells.contains(&c), |c| lines.beside(c).collect());
        left.retain(|c| !room.contains(c));
        rooms.push(room);
    }
    rooms
}

/// Whether a third of the units within a room are edges of mats.
fn has_mats(room: &BTreeSet<(i32, i32)>, units: &Units) -> bool {
    let (mut edges, mut all) = (0, 0);
    for &(u, v) in room {
        for (other, read) in [
            ((u - 1, v), units.upright(u, v)),
            ((u, v - 1), units.level(u, v)),
        ] {
            if room.contains(&other) {
                all += 1;
                edges += usize::from(read.role == Role::Mat);
            }
        }
    }
    edges >= 2 && edges * 3 >= all
}
