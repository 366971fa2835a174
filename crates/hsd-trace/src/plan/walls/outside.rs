//! The outside: all that a disc wider than an opening reaches from the edges of the sheet.

use super::field::Field;
use crate::plan::raster::Extent;
use std::collections::VecDeque;

/// Lengths of a step to the side and aslant, for distances.
const STEPS: [u32; 2] = [5, 7];
/// The length to a pixel that nothing reaches.
const FAR: u32 = u32::MAX / 2;
/// The most of the rim of a recess that may be open to the outside if it is a room.
const OPEN: f64 = 0.22;

/// The widest opening of a room, as a share of its side.
const JAMBS: f64 = 0.85;

/// Returns the distance of each pixel from the nearest that is set, pixels.
pub fn distances(set: &Field<bool>) -> Field<f32> {
    // A rim of far pixels spares the loops a look at the edges.
    let row = set.width + 2;
    let mut out = vec![FAR; row * (set.height + 2)];
    let start = |y: usize| (y + 1) * row + 1;
    for y in 0..set.height {
        for x in (0..set.width).filter(|x| set[(*x, y)]) {
            out[start(y) + x] = 0;
        }
    }
    let [straight, aslant] = STEPS;
    for at in (0..set.height).flat_map(|y| start(y)..start(y) + set.width) {
        let near = out[at - 1].min(out[at - row]) + straight;
        let corners = out[at - row - 1].min(out[at - row + 1]) + aslant;
        out[at] = out[at].min(near).min(corners);
    }
    for at in (0..set.height)
        .flat_map(|y| start(y)..start(y) + set.width)
        .rev()
    {
        let near = out[at + 1].min(out[at + row]) + straight;
        let corners = out[at + row + 1].min(out[at + row - 1]) + aslant;
        out[at] = out[at].min(near).min(corners);
    }
    Field::new(set.width, set.height, |x, y| {
        out[start(y) + x] as f32 / straight as f32
    })
}

/// Returns what a disc of a radius reaches from the edges of a sheet without touching a wall; `free` are the distances from walls.
fn reached((walls, free): (&Field<bool>, &Field<f32>), radius: f64) -> Field<bool> {
    let is_free = |p: (usize, usize)| f64::from(free[p]) > radius;
    let mut core = walls.map(|_| false);
    let mut open = VecDeque::new();
    let (width, height) = (walls.width, walls.height);
    let edge = (0..width).flat_map(|x| [(x, 0), (x, height - 1)]);
    for p in edge.chain((0..height).flat_map(|y| [(0, y), (width - 1, y)])) {
        if is_free(p) && !core[p] {
            core[p] = true;
            open.push_back(p);
        }
    }
    while let Some(p) = open.pop_front() {
        for n in core.beside(p) {
            if !core[n] && is_free(n) {
                core[n] = true;
                open.push_back(n);
            }
        }
    }
    let near = distances(&core);
    Field::new(width, height, |x, y| {
        f64::from(near[(x, y)]) <= radius && !walls[(x, y)]
    })
}

/// A line between two pixels.
pub type Chord = [(usize, usize); 2];

fn length([a, b]: &Chord) -> f64 {
    (a.0.abs_diff(b.0) as f64).hypot(a.1.abs_diff(b.1) as f64)
}

/// Returns true if a room in a box is wider than the opening at its side.
fn has_jambs(chord: &Chord, room: &Extent) -> bool {
    let [a, b] = *chord;
    let is_upright = a.1.abs_diff(b.1) > a.0.abs_diff(b.0);
    length(chord) <= JAMBS * room.size()[usize::from(is_upright)] as f64
}

/// Returns lines that part rooms from the outside where a disc does not come in: from wall to wall. `free` are the distances from
/// walls.
pub fn chords((walls, free): (&Field<bool>, &Field<f32>), radius: f64) -> Vec<Chord> {
    let outside = reached((walls, free), radius);
    let mut seen = walls.map(|w| w);
    let mut out = vec![];
    for y in 0..walls.height {
        for x in 0..walls.width {
            if seen[(x, y)] || outside[(x, y)] {
                continue;
            }
            // A part that the disc does not reach.
            let mut part = vec![(x, y)];
            seen[(x, y)] = true;
            let mut at = 0;
            let (mut walled, mut crossed, mut open) = (0, 0, vec![]);
            while at < part.len() {
                let p = part[at];
                at += 1;
                for n in walls.beside(p) {
                    if outside[n] {
                        open.push(p);
                        crossed += 1;
                    } else if walls[n] {
                        walled += 1;
                    } else if !seen[n] {
                        seen[n] = true;
                        part.push(n);
                    }
                }
            }
            open.sort_unstable();
            open.dedup();
            let across: Vec<Chord> = groups(&open)
                .iter()
                .filter_map(|group| chord(group, walls))
                .collect();
            // A disc bulges into a wide opening, which makes the rim longer than the opening. A recess is open from wall to wall.
            let rim = walled + crossed;
            let is_closed = f64::from(crossed) <= OPEN * f64::from(rim);
            let opening: f64 = across.iter().map(length).sum();
            let is_room = || {
                let mut room = Extent::default();
                part.iter().for_each(|(x, y)| room.add(*x, *y));
                opening <= OPEN * (opening + f64::from(walled))
                    && across.iter().all(|chord| has_jambs(chord, &room))
            };
            if is_closed || is_room() {
                out.extend(across);
            }
        }
    }
    out
}

/// Divides pixels into those that touch.
fn groups(pixels: &[(usize, usize)]) -> Vec<Vec<(usize, usize)>> {
    let mut left: std::collections::BTreeSet<_> = pixels.iter().copied().collect();
    let mut out = vec![];
    while let Some(first) = left.pop_first() {
        let mut group = vec![first];
        let mut at = 0;
        while at < group.len() {
            let (x, y) = group[at];
            at += 1;
            for (dx, dy) in (0..5).flat_map(|dx| (0..5).map(move |dy| (dx, dy))) {
                let n = ((x + dx).wrapping_sub(2), (y + dy).wrapping_sub(2));
                if left.remove(&n) {
                    group.push(n);
                }
            }
        }
        out.push(group);
    }
    out
}

/// Returns the line between the two ends of a row of pixels, prolonged to the walls beside them.
fn chord(group: &[(usize, usize)], walls: &Field<bool>) -> Option<Chord> {
    let touches = |&&(x, y): &&(usize, usize)| {
        let around = (0..5).flat_map(|dx| (0..5).map(move |dy| (dx, dy)));
        let mut around = around.filter_map(|(dx, dy)| {
            let (x, y) = (x as isize + dx - 2, y as isize + dy - 2);
            walls.get(x, y).filter(|w| *w)
        });
        around.next().is_some()
    };
    let ends: Vec<_> = group.iter().filter(touches).copied().collect();
    let apart =
        |a: (usize, usize), b: (usize, usize)| a.0.abs_diff(b.0).pow(2) + a.1.abs_diff(b.1).pow(2);
    let first = *ends.first()?;
    let far = *ends.iter().max_by_key(|p| apart(first, **p))?;
    let other = *ends.iter().max_by_key(|p| apart(far, **p))?;
    let at_wall = |p: (usize, usize)| {
        let around = (0..7).flat_map(|dx| (0..7).map(move |dy| (dx, dy)));
        let places = around.filter_map(|(dx, dy)| {
            let (x, y) = (p.0 as isize + dx - 3, p.1 as isize + dy - 3);
            walls.get(x, y).filter(|w| *w)?;
            Some((x as usize, y as usize))
        });
        places.min_by_key(|q| (apart(p, *q), *q))
    };
    Some([at_wall(far)?, at_wall(other)?])
}

/// Draws a line.
pub fn draw(walls: &mut Field<bool>, [a, b]: Chord) {
    let steps = a.0.abs_diff(b.0).max(a.1.abs_diff(b.1)).max(1);
    for k in 0..=steps {
        let t = k as f64 / steps as f64;
        let along = |a: usize, b: usize| (a as f64 + (b as f64 - a as f64) * t).round() as usize;
        let (x, y) = (along(a.0, b.0), along(a.1, b.1));
        for (x, y) in [(x, y), (x + 1, y), (x, y + 1)] {
            if x < walls.width && y < walls.height {
                walls[(x, y)] = true;
            }
        }
    }
}
