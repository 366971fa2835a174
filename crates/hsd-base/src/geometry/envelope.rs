//! The solid over a plot under planes: each plane limits heights over a part of the ground, and the least one counts. All parts
//! are divided by half-planes, so volumes, areas of sections and faces are exact. Rings run counter-clockwise, heights count
//! from the ground, lengths are metres.

mod faces;

pub use faces::{Bound, Face, faces};

use super::area2;
use super::convex::parts;
use super::triangulate::triangles;
use glam::DVec2;

/// Values below this count as 0: metres from a line, or of height.
const ON: f64 = 1e-9;
/// Twice the area below which a piece is none, square metres.
const NOTHING: f64 = 1e-9;

/// The ground on one side of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Half {
    /// A point of the line.
    pub at: DVec2,
    /// The direction from the line into the half-plane, unit length.
    pub inward: DVec2,
}

impl Half {
    /// Returns how far a place lies inside, metres; below 0 outside.
    pub fn depth(self, p: DVec2) -> f64 {
        (p - self.at).dot(self.inward)
    }
}

/// A plane that limits heights over a part of the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// The line at which it has its least height, and the way in which it rises.
    pub from: Half,
    /// Its height over that line.
    pub base: f64,
    /// Its rise per metre; 0 for a level.
    pub gradient: f64,
    /// The half-planes in all of which it counts; none if it counts everywhere.
    pub within: Vec<Half>,
}

impl Limit {
    /// Creates a level that counts everywhere.
    pub fn level(height: f64) -> Limit {
        let from = Half {
            at: DVec2::ZERO,
            inward: DVec2::Y,
        };
        Limit {
            from,
            base: height,
            gradient: 0.0,
            within: vec![],
        }
    }

    /// Returns its height over a place, wherever it counts.
    pub fn height(&self, p: DVec2) -> f64 {
        self.base + self.gradient * self.from.depth(p)
    }

    /// Returns true if it counts over a place.
    pub fn counts_at(&self, p: DVec2) -> bool {
        self.within.iter().all(|half| half.depth(p) >= 0.0)
    }
}

/// A part of the ground over which one limit is the least.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// Its outline, convex.
    pub ring: Vec<DVec2>,
    /// The number of the limit.
    pub limit: usize,
}

impl Cell {
    /// Returns its area.
    pub fn area(&self) -> f64 {
        area_of(&self.ring)
    }

    /// Returns the volume under its limit.
    pub fn volume(&self, limits: &[Limit]) -> f64 {
        // A plane over a triangle has the mean height of its corners.
        let height = |p: DVec2| limits[self.limit].height(p);
        let first = self.ring[0];
        let fans = self.ring[1..].windows(2).map(|two| {
            let area = (two[0] - first).perp_dot(two[1] - first) / 2.0;
            area * (height(first) + height(two[0]) + height(two[1])) / 3.0
        });
        fans.sum()
    }
}

fn area_of(ring: &[DVec2]) -> f64 {
    let Some(first) = ring.first() else {
        return 0.0;
    };
    let about: Vec<DVec2> = ring.iter().map(|p| *p - *first).collect();
    area2(&about) / 2.0
}

/// Divides a convex ring by the sign of a linear function; returns where it is above 0, and the rest. What has no area is empty;
/// where it is 0 everywhere, as between two rules that agree, nothing is above.
fn divided(ring: &[DVec2], of: impl Fn(DVec2) -> f64) -> [Vec<DVec2>; 2] {
    let snap = |value: f64| if value.abs() < ON { 0.0 } else { value };
    let values: Vec<f64> = ring.iter().map(|p| snap(of(*p))).collect();
    if values.iter().all(|value| *value <= 0.0) {
        return [vec![], ring.to_vec()];
    }
    let [mut above, mut below] = [vec![], vec![]];
    for (i, (p, s)) in ring.iter().zip(&values).enumerate() {
        let next = (i + 1) % ring.len();
        let t = values[next];
        if *s >= 0.0 {
            above.push(*p);
        }
        if *s <= 0.0 {
            below.push(*p);
        }
        if *s * t < 0.0 {
            let cut = p.lerp(ring[next], s / (s - t));
            above.push(cut);
            below.push(cut);
        }
    }
    [above, below].map(
        |ring| match ring.len() > 2 && area_of(&ring) * 2.0 > NOTHING {
            true => ring,
            false => vec![],
        },
    )
}

/// Returns what a convex ring has inside all of some half-planes, and convex pieces of the rest.
fn parted(ring: &[DVec2], within: &[Half]) -> (Vec<DVec2>, Vec<Vec<DVec2>>) {
    let (mut inside, mut rest) = (ring.to_vec(), vec![]);
    for half in within {
        let [own, other] = divided(&inside, |p| half.depth(p));
        inside = own;
        if !other.is_empty() {
            rest.push(other);
        }
        if inside.is_empty() {
            break;
        }
    }
    (inside, rest)
}

/// Returns convex pieces that make up an area; holes run clockwise.
pub fn pieces(ring: &[DVec2], holes: &[Vec<DVec2>]) -> Vec<Vec<DVec2>> {
    match holes.is_empty() {
        true => {
            let corners = |part: Vec<usize>| part.into_iter().map(|i| ring[i]).collect();
            parts(ring).into_iter().map(corners).collect()
        }
        false => triangles(ring, holes).iter().map(|t| t.to_vec()).collect(),
    }
}

/// Returns pieces without what lies in all of some half-planes.
pub fn without(pieces: Vec<Vec<DVec2>>, within: &[Half]) -> Vec<Vec<DVec2>> {
    let left = |ring: Vec<DVec2>| match parted(&ring, within) {
        (inside, _) if inside.is_empty() => vec![ring],
        (_, rest) => rest,
    };
    pieces.into_iter().flat_map(left).collect()
}

/// Divides convex pieces of a plot into cells under some limits, of which the first counts everywhere.
pub fn cells(pieces: Vec<Vec<DVec2>>, limits: &[Limit]) -> Vec<Cell> {
    let whole = |ring: Vec<DVec2>| (ring.len() > 2).then_some(Cell { ring, limit: 0 });
    let mut cells: Vec<Cell> = pieces.into_iter().filter_map(whole).collect();
    for (number, limit) in limits.iter().enumerate().skip(1) {
        let under = |cell: Cell| lowered(cell, number, limit, limits);
        cells = cells.into_iter().flat_map(under).collect();
    }
    cells
}

/// Puts a cell under another limit.
fn lowered(cell: Cell, number: usize, limit: &Limit, limits: &[Limit]) -> Vec<Cell> {
    let of = |ring: Vec<DVec2>| Cell {
        ring,
        limit: cell.limit,
    };
    let before = &limits[cell.limit];
    let [lower, above] = divided(&cell.ring, |p| before.height(p) - limit.height(p));
    if lower.is_empty() {
        return vec![cell];
    }
    let (under, mut rest) = parted(&lower, &limit.within);
    if under.is_empty() {
        return vec![cell];
    }
    if !above.is_empty() {
        rest.push(above);
    }
    let mut found: Vec<Cell> = rest.into_iter().map(of).collect();
    found.push(Cell {
        ring: under,
        limit: number,
    });
    found
}

/// Returns the volume of the solid over some cells.
pub fn volume(cells: &[Cell], limits: &[Limit]) -> f64 {
    cells.iter().map(|cell| cell.volume(limits)).sum()
}

/// Returns the area of the section of the solid at a height.
pub fn section(cells: &[Cell], limits: &[Limit], height: f64) -> f64 {
    let of = |cell: &Cell| {
        // What is level with it still bears a floor.
        let [below, _] = divided(&cell.ring, |p| height - limits[cell.limit].height(p));
        cell.area() - area_of(&below)
    };
    cells.iter().map(of).sum()
}

/// Returns the greatest height of the solid; 0 if there is none.
pub fn highest(cells: &[Cell], limits: &[Limit]) -> f64 {
    let heights = cells.iter().flat_map(|cell| {
        let limit = &limits[cell.limit];
        cell.ring.iter().map(|p| limit.height(*p))
    });
    heights.fold(0.0, f64::max)
}
