//! Things that stand in rooms: the ink of each place beside the symbols of the legend, turned and mirrored.

use super::Found;
use super::canvas::{Canvas, FINE, spread};
use crate::legend::Thing;
use crate::shape::Shape;
use glam::{DVec2, dvec2};
use std::collections::BTreeSet;

/// How far ink may be off its symbol, samples: of a draughtsman's pen, and of a hand.
const OFF: [i32; 2] = [2, 3];
/// The least share of a symbol that has to be seen, as far as walls do not hide it, beyond chance.
const SEEN: f64 = 0.75;
/// The least share of the ink at its place that has to belong to it, beyond chance.
const OWN: f64 = 0.5;
/// Walls may hide so much of a symbol.
const HIDDEN: f64 = 0.5;

/// A symbol in one of its ways.
struct Stamp {
    kind: super::ThingKind,
    size: (i32, i32),
    faces: (i32, i32),
    /// Whether the symbol itself shows where its front is.
    is_told: bool,
    /// Samples along its strokes within its edges, from its upper left corner.
    points: Vec<(i32, i32)>,
    /// What lies near its strokes, line by line.
    near: Vec<bool>,
}

/// Finds the things in all rooms of a house.
pub(super) fn things(
    canvas: &Canvas,
    shape: &Shape,
    symbols: &[Thing],
    is_by_hand: bool,
) -> Vec<Found> {
    let reach = OFF[usize::from(is_by_hand)];
    let near = canvas.near(reach);
    let stamps: Vec<Stamp> = symbols.iter().flat_map(|t| stamps(t, reach)).collect();
    let mut seen: Vec<Found> = vec![];
    for room in &shape.rooms {
        // The rims of the walls round a single cell look like a ring.
        let is_wide = |stamp: &&Stamp| room.len() > 1 || stamp.size != (1, 1);
        for stamp in stamps.iter().filter(is_wide) {
            for &at in room {
                if stamp.cells(at).all(|c| room.contains(&c))
                    && let Some(likeness) = stamp.likeness(canvas, &near, at)
                {
                    let faces = match stamp.is_told {
                        true => stamp.faces,
                        false => front(shape, room, at, stamp),
                    };
                    let found = Found {
                        kind: stamp.kind,
                        at,
                        size: stamp.size,
                        faces,
                        likeness,
                    };
                    seen.push(found);
                }
            }
        }
    }
    // Where two overlap, the one that explains more ink stays: likeness counts by area.
    let size = |f: &Found| f.size.0 * f.size.1;
    seen.sort_by(|a, b| {
        let (x, y) = (a.likeness * size(a) as f64, b.likeness * size(b) as f64);
        y.total_cmp(&x).then(a.at.cmp(&b.at))
    });
    let mut out: Vec<Found> = vec![];
    for found in seen {
        if !out.iter().any(|o| o.overlaps(&found)) {
            out.push(found);
        }
    }
    out.sort_by_key(|f| (f.at.1, f.at.0));
    out
}

impl Found {
    /// Whether it stands on a cell.
    pub fn covers(&self, (u, v): (i32, i32)) -> bool {
        (self.at.0..self.at.0 + self.size.0).contains(&u)
            && (self.at.1..self.at.1 + self.size.1).contains(&v)
    }

    fn overlaps(&self, other: &Found) -> bool {
        let apart = |a: i32, w: i32, b: i32, x: i32| a + w <= b || b + x <= a;
        !apart(self.at.0, self.size.0, other.at.0, other.size.0)
            && !apart(self.at.1, self.size.1, other.at.1, other.size.1)
    }
}

/// The side of a thing along which its room lies open; of several the longest.
fn front(shape: &Shape, room: &BTreeSet<(i32, i32)>, at: (i32, i32), stamp: &Stamp) -> (i32, i32) {
    let (w, d) = stamp.size;
    let is_wall = |(u, v): (i32, i32), (dx, dy): (i32, i32)| {
        // The side of the cell that way.
        let from = (u + dx.max(0), v + dy.max(0));
        let to = (from.0 + dy.abs(), from.1 + dx.abs());
        shape.inner.iter().any(|w| w.from == from && w.to == to)
    };
    let free = |side: (i32, i32)| {
        let is_free = |c: &(i32, i32)| {
            let beyond = (c.0 + side.0, c.1 + side.1);
            let outside = !stamp.cells(at).any(|own| own == beyond);
            outside && room.contains(&beyond) && !is_wall(*c, side)
        };
        stamp.cells(at).filter(is_free).count() as i32
    };
    // Of equal ones that at the front of the house.
    let sides = [((0, -1), w), ((-1, 0), d), ((1, 0), d), ((0, 1), w)];
    let best = sides
        .iter()
        .max_by_key(|(side, length)| (free(*side) == *length, *length, free(*side)));
    best.map_or((0, 1), |(side, _)| *side)
}

impl Stamp {
    fn cells(&self, (u, v): (i32, i32)) -> impl Iterator<Item = (i32, i32)> + use<> {
        let (w, d) = self.size;
        (0..d).flat_map(move |y| (0..w).map(move |x| (u + x, v + y)))
    }

    /// How well the ink at a place agrees; none if it does not.
    ///
    /// Two shares beyond what chance would give: of the symbol, that with ink near it, where ink all over is near
    /// everything; of the ink, that near the symbol, where a dense symbol is near everything.
    fn likeness(&self, canvas: &Canvas, near: &[bool], at: (i32, i32)) -> Option<f64> {
        let (x0, y0) = canvas.corner(at);
        let mut symbol = Share::default();
        for (x, y) in &self.points {
            let (x, y) = (
                (x0 + x).min(canvas.size.0 - 1),
                (y0 + y).min(canvas.size.1 - 1),
            );
            let k = canvas.number(x, y);
            if !canvas.hidden[k] {
                symbol.take(near[k]);
            }
        }
        if symbol.all < HIDDEN * self.points.len() as f64 || symbol.part() < SEEN {
            return None;
        }
        let (mut ink, mut inked, mut covered) =
            (Share::default(), Share::default(), Share::default());
        for y in 0..self.size.1 * FINE {
            for x in 0..self.size.0 * FINE {
                let k = canvas.number(x0 + x, y0 + y);
                if !canvas.hidden[k] {
                    let is_own = self.near[(y * self.size.0 * FINE + x) as usize];
                    inked.take(near[k]);
                    covered.take(is_own);
                    if canvas.ink[k] {
                        ink.take(is_own);
                    }
                }
            }
        }
        let (seen, own) = (symbol.beyond(inked), ink.beyond(covered));
        (seen >= SEEN && own >= OWN).then(|| 2.0 * seen * own / (seen + own))
    }
}

/// How many of some.
#[derive(Clone, Copy, Default)]
struct Share {
    some: f64,
    all: f64,
}

impl Share {
    fn take(&mut self, is: bool) {
        self.some += f64::from(u8::from(is));
        self.all += 1.0;
    }

    fn part(self) -> f64 {
        self.some / self.all.max(1.0)
    }

    /// What it is more than by chance, of what it could be.
    fn beyond(self, chance: Share) -> f64 {
        (self.part() - chance.part()) / (1.0 - chance.part()).max(1e-9)
    }
}

/// All ways in which a thing is drawn: by its number of treads, in four turns, and mirrored.
fn stamps(thing: &Thing, reach: i32) -> Vec<Stamp> {
    let mut out: Vec<Stamp> = vec![];
    for strokes in thing.drawn() {
        for turn in 0..4 {
            for is_mirrored in [false, true] {
                let stamp = stamp(thing, &strokes, (turn, is_mirrored), reach);
                let same = |o: &Stamp| {
                    o.size == stamp.size && o.near == stamp.near && o.faces == stamp.faces
                };
                if !out.iter().any(same) {
                    out.push(stamp);
                }
            }
        }
    }
    // What looks the same from two sides does not tell its front.
    let alike = |k: usize| {
        let other =
            |o: &Stamp| o.size == out[k].size && o.near == out[k].near && o.faces != out[k].faces;
        out.iter().any(other)
    };
    let told: Vec<bool> = (0..out.len()).map(|k| !alike(k)).collect();
    out.iter_mut().zip(told).for_each(|(s, t)| s.is_told = t);
    out
}

fn stamp(
    thing: &Thing,
    strokes: &[Vec<DVec2>],
    (turn, is_mirrored): (i32, bool),
    reach: i32,
) -> Stamp {
    let (w, d) = (f64::from(thing.size.0), f64::from(thing.size.1));
    // Quarter turns about the upper left corner, back into the positive.
    let place = |p: DVec2| {
        let p = if is_mirrored { dvec2(w - p.x, p.y) } else { p };
        match turn {
            0 => p,
            1 => dvec2(d - p.y, p.x),
            2 => dvec2(w - p.x, d - p.y),
            _ => dvec2(p.y, w - p.x),
        }
    };
    let size = match turn % 2 {
        0 => thing.size,
        _ => (thing.size.1, thing.size.0),
    };
    let faces = [(0, 1), (-1, 0), (0, -1), (1, 0)][turn as usize];
    let mut points: Vec<(i32, i32)> = vec![];
    for pair in strokes.iter().flat_map(|s| s.windows(2)) {
        let (p, q) = (place(pair[0]), place(pair[1]));
        let count = (p.distance(q) * f64::from(FINE) / 2.0).ceil() as i32;
        for k in 0..=count {
            let at = p.lerp(q, f64::from(k) / f64::from(count.max(1))) * f64::from(FINE);
            points.push((at.x.floor() as i32, at.y.floor() as i32));
        }
    }
    points.sort_unstable();
    points.dedup();
    let (width, height) = (size.0 * FINE, size.1 * FINE);
    let mut on = vec![false; (width * height) as usize];
    for (x, y) in &points {
        on[(y.clamp(&0, &(height - 1)) * width + x.clamp(&0, &(width - 1))) as usize] = true;
    }
    // Lines of the grid, walls and mats lie on the edges of everything.
    let within = |k: i32, most: i32| k > reach && k < most - 1 - reach;
    points.retain(|(x, y)| within(*x, width) && within(*y, height));
    Stamp {
        kind: thing.kind,
        size,
        faces,
        is_told: true,
        points,
        near: spread(&on, (width, height), reach),
    }
}
