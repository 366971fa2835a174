//! What looks like a wall but holds on to nothing: leaves that stand open, strokes of writing on the edges of mats.

use super::Read;
use crate::legend::Role;
use std::collections::{BTreeMap, BTreeSet};

/// How clearly a post has to stand so that it holds the end of a wall.
const LEAST_POST: f64 = 0.7;
/// The longest stroke of writing, units.
const LONGEST: usize = 2;

/// The most ink of a chain of dimensions beside that of walls.
const THIN: f64 = 0.7;

/// Level lines from above, upright lines from the left.
type Sides = [Vec<Vec<Read>>; 2];

/// Removes leaves and short walls that have an end where no post stands and no other wall.
///
/// A leaf that stands open across its wall looks like the door itself; it is held by its hinge alone.
pub(super) fn remove(sides: &mut Sides, posts: &[Vec<f64>]) {
    for leaves in [true, false] {
        let is_meant = |role: Role| match leaves {
            true => role == Role::Hinged,
            false => role.parts(),
        };
        let mut loose = Vec::new();
        for side in 0..2 {
            for (line, reads) in sides[side].iter().enumerate() {
                let longest = if leaves { 1 } else { LONGEST };
                for run in runs(reads, &is_meant, longest) {
                    let is_held = |at: usize| holds(sides, posts, (side, line, at), leaves);
                    if !is_held(run.start) || !is_held(run.end) {
                        loose.push((side, line, run));
                    }
                }
            }
        }
        for (side, line, run) in loose {
            sides[side][line][run].fill(Read::EMPTY);
        }
    }
}

/// Removes straight rows of thin strokes, and of any at whose ends no posts stand, that stand apart from the house, beyond all of
/// it: chains of dimensions, which may lie a unit from a wall.
pub(super) fn remove_chains(sides: &mut Sides, posts: &[Vec<f64>]) {
    let groups = connected(sides);
    let Some(house) = groups.iter().max_by_key(|g| g.len()) else {
        return;
    };
    // Of each direction the walls farthest out: a leaf that stands open may reach a chain.
    let reach = |side: usize| {
        let lines = house
            .iter()
            .filter(|unit| unit.0 == side)
            .map(|unit| unit.1);
        lines.fold((usize::MAX, 0), |(low, high), line| {
            (low.min(line), high.max(line))
        })
    };
    let reach = [reach(0), reach(1)];
    let read = |&(side, line, at): &Place| sides[side][line][at];
    let walls = house.iter().map(read).filter(|r| r.role == Role::Wall);
    let least = THIN * middle(walls.map(|r| r.ink).collect());
    let is_chain = |group: &&Vec<Place>| {
        let (side, line, _) = group[0];
        let is_straight = group.iter().all(|unit| (unit.0, unit.1) == (side, line));
        let (low, high) = reach[side];
        let ink = || middle(group.iter().map(|unit| read(unit).ink).collect());
        let is_bare = || {
            let ends = group.iter().flat_map(|unit| crossings(*unit));
            ends.filter(|(u, v)| posts[*v][*u] > LEAST_POST).count() < 2
        };
        is_straight && (line < low || line > high) && (ink() < least || is_bare())
    };
    let chains: Vec<Place> = groups.iter().filter(is_chain).flatten().copied().collect();
    for (side, line, at) in chains {
        sides[side][line][at] = Read::EMPTY;
    }
}

/// The middle one of some values; 0 of none.
fn middle(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

/// A unit: level or upright, its line, its place on it.
type Place = (usize, usize, usize);

/// The crossings at the ends of a unit: to the right and down.
fn crossings((side, line, at): Place) -> [(usize, usize); 2] {
    match side {
        0 => [(at, line), (at + 1, line)],
        _ => [(line, at), (line, at + 1)],
    }
}

/// The groups of units of wall that hold on to each other.
fn connected(sides: &Sides) -> Vec<Vec<Place>> {
    let mut at_crossings: BTreeMap<(usize, usize), Vec<Place>> = BTreeMap::new();
    for (side, lines) in sides.iter().enumerate() {
        for (line, reads) in lines.iter().enumerate() {
            for (at, _) in reads.iter().enumerate().filter(|r| r.1.role.parts()) {
                let unit = (side, line, at);
                for crossing in crossings(unit) {
                    at_crossings.entry(crossing).or_default().push(unit);
                }
            }
        }
    }
    let mut groups = Vec::new();
    while let Some((_, mut open)) = at_crossings.pop_first() {
        let mut group = BTreeSet::new();
        while let Some(unit) = open.pop() {
            if group.insert(unit) {
                let beside = crossings(unit).into_iter();
                open.extend(beside.filter_map(|c| at_crossings.remove(&c)).flatten());
            }
        }
        groups.push(group.into_iter().collect());
    }
    groups
}

/// Stretches of a line that are meant, no longer than that; leaves stand each for itself.
fn runs(
    reads: &[Read],
    is_meant: &dyn Fn(Role) -> bool,
    longest: usize,
) -> Vec<std::ops::Range<usize>> {
    let mut out = Vec::new();
    let mut from = 0;
    while from < reads.len() {
        let end = match longest {
            1 => from + usize::from(is_meant(reads[from].role)),
            _ => {
                from + reads[from..]
                    .iter()
                    .take_while(|r| is_meant(r.role))
                    .count()
            }
        };
        if end > from && end - from <= longest {
            out.push(from..end);
        }
        from = end.max(from + 1);
    }
    out
}

/// Whether something holds the end of a wall at a crossing: a post, a wall that goes on or one across it.
fn holds(
    [level, upright]: &Sides,
    posts: &[Vec<f64>],
    (side, line, at): (usize, usize, usize),
    is_leaf: bool,
) -> bool {
    let (u, v) = if side == 0 { (at, line) } else { (line, at) };
    let stands = |reads: &[Vec<Read>], line: usize, at: Option<usize>| {
        let read = at.and_then(|at| reads.get(line)?.get(at));
        read.is_some_and(|r| r.role.parts() && !(is_leaf && r.role == Role::Hinged))
    };
    let across = match side {
        0 => stands(upright, u, Some(v)) || stands(upright, u, v.checked_sub(1)),
        _ => stands(level, v, Some(u)) || stands(level, v, u.checked_sub(1)),
    };
    // The wall in question is one of the two of its own line.
    let along = match side {
        0 => stands(level, v, Some(u)) && stands(level, v, u.checked_sub(1)),
        _ => stands(upright, u, Some(v)) && stands(upright, u, v.checked_sub(1)),
    };
    let beside = match (is_leaf, side) {
        (false, _) => along,
        (true, 0) => stands(level, v, Some(u)) || stands(level, v, u.checked_sub(1)),
        (true, _) => stands(upright, u, Some(v)) || stands(upright, u, v.checked_sub(1)),
    };
    across || beside || posts[v][u] > LEAST_POST
}
