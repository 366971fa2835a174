//! Which parts of a drawing belong to its house where nothing is drawn between them and what lies outside: the outline that
//! leaves least unexplained.

use super::super::legend::Role;
use super::super::strokes::Read;
use super::{CLEAR_POST, Lines, flood};
use std::collections::{BTreeMap, BTreeSet};

/// The cost of a unit of the outline that does not close it at all, though something is read there.
const UNDRAWN: f64 = 0.25;
/// The cost of a way in the outline where nothing is drawn: once, since a long one is one symbol too; for each of its units; and for
/// each of its ends where no wall goes on in its line. How far its ends are looked for, units.
const ONCE: f64 = 0.2;
const PER_UNIT: f64 = 0.15;
const TURNS: f64 = 0.1;
const FARTHEST: i32 = 12;
/// The cost of a unit of wall that stands outside of the outline.
const STRAY: f64 = 0.9;
/// The cost of a unit of window or lattice between rooms: they look outside.
const WITHIN: f64 = 0.1;
/// The cost of a cell outside of the outline that has ink in it: mats, writing.
const LEFT_OUT: f64 = 0.2;
/// The cost of a corner of the outline.
const CORNER: f64 = 0.1;
/// The cost of a cell of the house that is blank though one should have ink in it.
const BLANK: f64 = 0.2;
/// The least share of cells with ink in a house, from names, mats, boards and fixtures, and the number of cells that may be blank
/// besides.
const LIVED_IN: f64 = 0.25;
const FEW: f64 = 4.0;
/// The share of the cost of a wall that is not connected to the house.
const APART: f64 = 0.1;
/// How well ink closes a house, and how sure it is that a wall stands there, where it looks like no symbol; and the share of the
/// ink of doors and windows from which on it may be a wall.
const UNREAD: f64 = 0.4;
const MUCH: f64 = 0.6;
/// How much worse another outline has to be so that there is no doubt of the one that is best: two corners and a way.
const HARDLY: f64 = 0.45;
/// The lead over another reading from which on there is no doubt of a wall.
const CLEAR: f64 = 0.2;

/// Cells that no wall and no gap part.
struct Region {
    cells: BTreeSet<(i32, i32)>,
    /// Its sides. A wall inside the region has two sides there, each at half the cost.
    sides: Vec<Border>,
    /// How many of its cells have ink in them.
    inked: f64,
}

/// A side of a region: what lies beyond it, and what it costs as a part of the outline, outside of it and within it.
struct Border {
    beyond: usize,
    undrawn: f64,
    stray: f64,
    within: f64,
}

impl Border {
    /// The same before a region, at a share of the cost.
    fn to(self, beyond: usize, share: f64) -> Border {
        Border {
            beyond,
            undrawn: self.undrawn * share,
            stray: self.stray * share,
            within: self.within * share,
        }
    }
}

/// The cells of the house: of those that walls and gaps enclose, the regions with which the outline is best.
///
/// The sides of the house that would lie elsewhere in an outline that is hardly worse are returned with them.
pub(super) fn settled(lines: &Lines<'_>) -> (BTreeSet<(i32, i32)>, BTreeSet<Side>) {
    let (regions, number) = regions(lines);
    // The first is what lies round the drawing.
    let mut is_in: Vec<bool> = (0..regions.len()).map(|k| k > 0).collect();
    let groups = groups(lines, &number, regions.len());
    // By how much the outline gets worse if a group changes sides, where it may.
    let worse = |is_in: &[bool], group: &[usize]| {
        let is_mixed = group.iter().any(|k| is_in[*k] != is_in[group[0]]);
        let is_met = || {
            let mut all = group.iter();
            all.any(|k| touches(&regions[*k], is_in, !is_in[*k]))
        };
        (!is_mixed && is_met()).then(|| {
            change(&regions, is_in, group)
                + CORNER * f64::from(corners(&regions, &number, is_in, group))
        })
    };
    loop {
        let mut best = (-1e-9, None);
        for group in &groups {
            if let Some(change) = worse(&is_in, group).filter(|change| *change < best.0) {
                best = (change, Some(group));
            }
        }
        let Some(group) = best.1 else { break };
        group.iter().for_each(|k| is_in[*k] = !is_in[*k]);
    }
    let mut unsure = BTreeSet::new();
    let hardly = |group: &&Vec<usize>| worse(&is_in, group).is_some_and(|change| change < HARDLY);
    for group in groups.iter().filter(hardly) {
        let cells = group.iter().flat_map(|k| &regions[*k].cells);
        let sides = cells.flat_map(|cell| Lines::sides(*cell));
        let is_beyond = |cell| is_in[number.get(&cell).copied().unwrap_or(0)] != is_in[group[0]];
        let outer = sides.filter(|side| is_beyond(side.2));
        unsure.extend(outer.map(|(at, upright, _)| (at, upright)));
    }
    let kept = regions.into_iter().zip(is_in).filter(|r| r.1);
    let cells = kept.flat_map(|(region, _)| region.cells).collect();
    (cells, unsure)
}

/// The sets of regions that are tried together: each region alone, and regions that are separated by wide gaps only, as several
/// gaps may cross one recess.
fn groups(
    lines: &Lines<'_>,
    number: &BTreeMap<(i32, i32), usize>,
    count: usize,
) -> BTreeSet<Vec<usize>> {
    let mut out: BTreeSet<Vec<usize>> = (1..count).map(|k| vec![k]).collect();
    for (keeps_doors, widest) in [(false, 0), (true, 0), (true, 1), (true, 2)] {
        let mut some = lines.clone();
        some.joined
            .retain(|_, gap| keeps_doors && gap.is_door || gap.length <= widest);
        let mut left: BTreeSet<(i32, i32)> = lines.enclosed();
        let enclosed = left.clone();
        while let Some(&first) = left.iter().next() {
            let cells = flood(
                first,
                |c| enclosed.contains(&c),
                |c| some.beside(c).collect(),
            );
            left.retain(|c| !cells.contains(c));
            let group: BTreeSet<usize> = cells.iter().map(|c| number[c]).collect();
            out.insert(group.into_iter().collect());
        }
    }
    out
}

/// Whether a region lies beside one that is in, or out.
fn touches(region: &Region, is_in: &[bool], wanted: bool) -> bool {
    region.sides.iter().any(|s| is_in[s.beyond] == wanted)
}

/// By how much the whole gets worse if some regions, all on one side, change it.
fn change(regions: &[Region], is_in: &[bool], group: &[usize]) -> f64 {
    let cost = |k: usize, mine: bool| {
        let side = |side: &Border| {
            // What lies between two of the group is met from both.
            let (theirs, share) = match group.contains(&side.beyond) {
                true if side.beyond != k => (mine, 0.5),
                true => (mine, 1.0),
                false => (is_in[side.beyond], 1.0),
            };
            share
                * match (mine, theirs) {
                    (true, true) => side.within,
                    (false, false) => side.stray,
                    _ => side.undrawn,
                }
        };
        regions[k].sides.iter().map(side).sum::<f64>()
    };
    let sum = |of: fn(&Region) -> f64| group.iter().map(|k| of(&regions[*k])).sum::<f64>();
    let (inked, cells) = (sum(|r| r.inked), sum(|r| r.cells.len() as f64));
    let blank = BLANK * (LIVED_IN * (cells - FEW) - inked).max(0.0);
    let drawn = LEFT_OUT * inked;
    let within = if is_in[group[0]] {
        drawn - blank
    } else {
        blank - drawn
    };
    let changes = group
        .iter()
        .map(|k| cost(*k, !is_in[*k]) - cost(*k, is_in[*k]));
    changes.sum::<f64>() + within
}

/// How many corners more the outline has if some regions, all on one side, change it.
fn corners(
    regions: &[Region],
    number: &BTreeMap<(i32, i32), usize>,
    is_in: &[bool],
    group: &[usize],
) -> i32 {
    let cells = group.iter().flat_map(|k| &regions[*k].cells);
    let crossings: BTreeSet<(i32, i32)> = cells
        .flat_map(|(u, v)| [(*u, *v), (u + 1, *v), (*u, v + 1), (u + 1, v + 1)])
        .collect();
    let count = |changed: bool| {
        let inside = |cell: (i32, i32)| {
            let region = number.get(&cell).copied().unwrap_or(0);
            is_in[region] != (changed && group.contains(&region))
        };
        let is_corner = |(u, v): &&(i32, i32)| {
            let [a, b] = [inside((u - 1, v - 1)), inside((*u, v - 1))];
            let [c, d] = [inside((u - 1, *v)), inside((*u, *v))];
            // Straight on if both cells of one side are alike.
            !(a == b && c == d || a == c && b == d)
        };
        crossings.iter().filter(is_corner).count() as i32
    };
    count(true) - count(false)
}

/// The regions of a drawing; the first is what lies round it.
fn regions(lines: &Lines<'_>) -> (Vec<Region>, BTreeMap<(i32, i32), usize>) {
    let ((u0, u1), (v0, v1)) = (lines.units.across, lines.units.down);
    let within = |(u, v): (i32, i32)| u >= u0 - 1 && u <= u1 && v >= v0 - 1 && v <= v1;
    let mut number: BTreeMap<(i32, i32), usize> = BTreeMap::new();
    let mut groups: Vec<BTreeSet<(i32, i32)>> = Vec::new();
    for cell in (v0 - 1..=v1).flat_map(|v| (u0 - 1..=u1).map(move |u| (u, v))) {
        if number.contains_key(&cell) {
            continue;
        }
        let group = flood(cell, within, |c| lines.beside(c).collect());
        number.extend(group.iter().map(|c| (*c, groups.len())));
        groups.push(group);
    }
    let main = connected(lines);
    let ends = |(u, v): (i32, i32), upright: bool| {
        let end = if upright { (u, v + 1) } else { (u + 1, v) };
        [(u, v), end]
    };
    let crossings: BTreeSet<(i32, i32)> = main.iter().flat_map(|s| ends(s.0, s.1)).collect();
    let unread = unread(lines);
    let region = |(k, cells): (usize, BTreeSet<(i32, i32)>)| {
        let mut sides = Vec::new();
        for (at, upright, beyond) in cells.iter().flat_map(|c| Lines::sides(*c)) {
            let Some(&other) = number.get(&beyond) else {
                continue;
            };
            let read = lines.read(at, upright);
            let is_unread = !read.role.parts() && read.ink > unread;
            let (strength, closes) = match is_unread {
                true => (UNREAD, UNREAD),
                false => (strength(read), closes(read.role)),
            };
            let meets = || ends(at, upright).iter().any(|c| crossings.contains(c));
            let is_main = main.contains(&(at, upright)) || is_unread && meets();
            let share = if is_main { 1.0 } else { APART };
            // What lies within is met from both of its sides.
            let times = if other == k { 0.5 } else { 1.0 };
            if other != k || strength > 0.0 {
                let border = border(lines, (at, upright), share * strength, closes);
                sides.push(border.to(other, times));
            }
        }
        let inked = cells.iter().filter(|c| lines.units.is_inked(**c)).count();
        Region {
            sides,
            inked: inked as f64,
            cells,
        }
    };
    let regions = groups.into_iter().enumerate().map(region).collect();
    (regions, number)
}

/// The costs of one unit of wall or gap that bounds a region.
fn border(lines: &Lines<'_>, (at, upright): Side, strength: f64, closes: f64) -> Border {
    let is_pane = matches!(lines.read(at, upright).role, Role::Window | Role::Lattice);
    Border {
        beyond: 0,
        undrawn: match closes > 0.0 {
            true => UNDRAWN * (1.0 - closes),
            false => undrawn(lines, at, upright),
        },
        stray: STRAY * strength,
        within: if is_pane { WITHIN * strength } else { 0.0 },
    }
}

/// The cost of a unit of the outline where nothing is drawn: its share in that of its way, which ends at the next wall or post.
fn undrawn(lines: &Lines<'_>, at: (i32, i32), upright: bool) -> f64 {
    let along = |k: i32| match upright {
        true => (at.0, at.1 + k),
        false => (at.0 + k, at.1),
    };
    let stands = |at: (i32, i32), upright: bool| lines.read(at, upright).role.parts();
    let goes_on = |k: i32| stands(along(k), upright);
    let is_met = |k: i32| {
        let (u, v) = along(k);
        let before = if upright { (u - 1, v) } else { (u, v - 1) };
        let crosses = stands((u, v), !upright) || stands(before, !upright);
        crosses || lines.units.post((u, v)) > CLEAR_POST
    };
    let back = (0..FARTHEST).find(|k| is_met(-k) || goes_on(-k - 1));
    let ahead = (1..FARTHEST).find(|k| is_met(*k) || goes_on(*k));
    let [back, ahead] = [back, ahead].map(|k| k.unwrap_or(FARTHEST));
    let turns = [-back - 1, ahead].into_iter().filter(|k| !goes_on(*k));
    PER_UNIT + (ONCE + TURNS * turns.count() as f64) / f64::from(back + ahead)
}

/// How thick ink has to be that may be a wall though it was not read as one: units.
fn unread(lines: &Lines<'_>) -> f64 {
    let ((u0, u1), (v0, v1)) = (lines.units.across, lines.units.down);
    let all = (v0..=v1).flat_map(|v| (u0..=u1).map(move |u| (u, v)));
    let reads = all.flat_map(|at| [lines.read(at, false), lines.read(at, true)]);
    let is_opening = |r: &Read| matches!(r.role, Role::Slide | Role::Window);
    let mut ink: Vec<f64> = reads.filter(is_opening).map(|r| r.ink).collect();
    ink.sort_by(f64::total_cmp);
    let middle = ink.get(ink.len() / 2);
    middle.map_or(f64::INFINITY, |ink| MUCH * ink)
}

/// The crossings of walls that touch each other, the largest group first.
fn touching(lines: &Lines<'_>) -> Vec<BTreeSet<(i32, i32)>> {
    let ((u0, u1), (v0, v1)) = (lines.units.across, lines.units.down);
    let all = (v0..=v1).flat_map(|v| (u0..=u1).map(move |u| (u, v)));
    let stands = |at: (i32, i32), upright: bool| lines.read(at, upright).role.parts();
    let beside = |(u, v): (i32, i32)| {
        let ends = [
            ((u + 1, v), stands((u, v), false)),
            ((u - 1, v), stands((u - 1, v), false)),
            ((u, v + 1), stands((u, v), true)),
            ((u, v - 1), stands((u, v - 1), true)),
        ];
        let ends = ends.into_iter().filter(|end| end.1);
        ends.map(|end| end.0).collect::<Vec<_>>()
    };
    let mut left: BTreeSet<(i32, i32)> = all.collect();
    let mut groups = Vec::new();
    while let Some(&first) = left.iter().next() {
        let crossings = flood(first, |_| true, beside);
        left.retain(|c| !crossings.contains(c));
        groups.push(crossings);
    }
    groups.sort_by_key(|g| std::cmp::Reverse(g.len()));
    groups
}

/// Finds the walls of the house: the largest connected group, and smaller groups that a gap in their own line separates from it,
/// beyond its extent only where walls stand at both ends of the gap. Dimension chains stay apart.
fn connected(lines: &Lines<'_>) -> BTreeSet<((i32, i32), bool)> {
    let stands = |at: (i32, i32), upright: bool| lines.read(at, upright).role.parts();
    let mut groups = touching(lines).into_iter();
    let mut most = groups.next().unwrap_or_default();
    let ways = ways(lines);
    let extent = |of: fn(&(i32, i32)) -> i32| {
        let all = || most.iter().map(of);
        all().min().unwrap_or(0)..=all().max().unwrap_or(0)
    };
    let (across, down) = (extent(|c| c.0), extent(|c| c.1));
    // Chains of dimensions lie beyond the walls, and in line with none.
    let is_within = |g: &BTreeSet<(i32, i32)>| {
        g.iter()
            .all(|c| across.contains(&c.0) && down.contains(&c.1))
    };
    let mut others: Vec<_> = groups.filter(|g| g.len() > 1).collect();
    loop {
        let joins = |group: &BTreeSet<(i32, i32)>| {
            let of = |(at, upright): Side, some: &BTreeSet<(i32, i32)>| {
                stands(at, upright) && some.contains(&at)
            };
            let is_within = is_within(group);
            // A way that begins at a post of one and goes on as a wall of the other joins them at a corner.
            let is_posted = |c: &(i32, i32)| group.contains(c) && lines.units.post(*c) > CLEAR_POST;
            ways.iter().any(|way| {
                let [before, after] = [way.before, way.after].map(|s| (of(s, group), of(s, &most)));
                let meets = way.crossings.iter().any(|c| most.contains(c));
                let continues = before.0 && after.1 || before.1 && after.0;
                let turns = (before.1 || after.1) && way.crossings.iter().any(is_posted);
                continues || turns || is_within && meets && (before.0 || after.0)
            })
        };
        let (more, rest): (Vec<_>, Vec<_>) = others.into_iter().partition(joins);
        others = rest;
        if more.is_empty() {
            break;
        }
        most.extend(more.into_iter().flatten());
    }
    let sides = most.into_iter().flat_map(|c| [(c, false), (c, true)]);
    sides
        .filter(|(at, upright)| stands(*at, *upright))
        .collect()
}

/// A unit of the grid: where it begins, and whether it is upright.
type Side = ((i32, i32), bool);

/// A gap between walls: its crossings, and the units of its line before and after it.
struct Way {
    crossings: Vec<(i32, i32)>,
    before: Side,
    after: Side,
}

/// The gaps between walls.
fn ways(lines: &Lines<'_>) -> Vec<Way> {
    let along = |(u, v): (i32, i32), upright: bool, by: i32| match upright {
        true => (u, v + by),
        false => (u + by, v),
    };
    let is_gap = |at: (i32, i32), upright: bool| lines.joined.contains_key(&(at, upright));
    let starts = lines
        .joined
        .keys()
        .filter(|(at, upright)| !is_gap(along(*at, *upright, -1), *upright));
    let way = |(at, upright): &Side| {
        let length = (1..)
            .find(|k| !is_gap(along(*at, *upright, *k), *upright))
            .unwrap_or(1);
        let crossings = (0..=length).map(|k| along(*at, *upright, k)).collect();
        let before = (along(*at, *upright, -1), *upright);
        let after = (along(*at, *upright, length), *upright);
        Way {
            crossings,
            before,
            after,
        }
    };
    starts.map(way).collect()
}

/// How well a unit closes a house, 0 to 1.
fn closes(role: Role) -> f64 {
    match role {
        Role::Empty | Role::Mat => 0.0,
        Role::Hinged => 0.8,
        Role::Open => 0.6,
        Role::Wall | Role::Slide | Role::Window | Role::Lattice => 1.0,
    }
}

/// How sure it is that a wall stands there, 0 to 1.
fn strength(read: Read) -> f64 {
    let sure = 0.5 + 0.5 * (read.lead / CLEAR).clamp(0.0, 1.0);
    match read.role {
        Role::Empty | Role::Mat => 0.0,
        // Trees, rings and the ways of leaves beside them look like one.
        Role::Hinged => 0.5 * sure,
        Role::Open => 0.6 * sure,
        Role::Wall | Role::Slide | Role::Window | Role::Lattice => sure,
    }
}
