//! Which parts of a drawing belong to its house where nothing is drawn between them and what lies outside: the outline that
//! leaves least unexplained.

use super::super::legend::Role;
use super::super::strokes::Read;
use super::{Lines, flood};
use std::collections::{BTreeMap, BTreeSet};

/// What a unit of the outline counts where nothing is drawn.
const UNDRAWN: f64 = 0.5;
/// What a unit of wall counts that stands outside.
const STRAY: f64 = 0.7;
/// What a cell outside counts that has ink in it: mats, writing.
const LEFT_OUT: f64 = 0.2;
/// The lead over another reading from which on there is no doubt of a wall.
const CLEAR: f64 = 0.2;

/// Cells that no wall and no gap part.
struct Region {
    cells: BTreeSet<(i32, i32)>,
    /// What lies beyond its sides: the number of the region, and the side; twice what lies within.
    sides: Vec<(usize, f64, f64)>,
    inked: f64,
}

/// The cells of the house: of those that walls and gaps enclose, the regions with which the outline is best.
pub(super) fn settled(lines: &Lines<'_>) -> BTreeSet<(i32, i32)> {
    let regions = regions(lines);
    // The first is what lies round the drawing.
    let mut is_in: Vec<bool> = (0..regions.len()).map(|k| k > 0).collect();
    loop {
        let gain = |k: usize| (change(&regions, &is_in, k), k);
        let best = (1..regions.len())
            .filter(|k| touches(&regions[*k], &is_in, !is_in[*k]))
            .map(gain)
            .min_by(|a, b| a.0.total_cmp(&b.0));
        match best {
            Some((change, k)) if change < -1e-9 => is_in[k] = !is_in[k],
            _ => break,
        }
    }
    let kept = regions.into_iter().zip(is_in).filter(|r| r.1);
    kept.flat_map(|(region, _)| region.cells).collect()
}

/// Whether a region lies beside one that is in, or out.
fn touches(region: &Region, is_in: &[bool], wanted: bool) -> bool {
    region.sides.iter().any(|s| is_in[s.0] == wanted)
}

/// By how much the whole gets worse if a region changes sides.
fn change(regions: &[Region], is_in: &[bool], k: usize) -> f64 {
    let region = &regions[k];
    let cost = |mine: bool| {
        let side = |(other, undrawn, stray): &(usize, f64, f64)| {
            let theirs = if *other == k { mine } else { is_in[*other] };
            match (mine, theirs) {
                (true, true) => 0.0,
                (false, false) => *stray,
                _ => *undrawn,
            }
        };
        let inked = if mine { 0.0 } else { region.inked };
        region.sides.iter().map(side).sum::<f64>() + inked
    };
    cost(!is_in[k]) - cost(is_in[k])
}

/// The regions of a drawing; the first is what lies round it.
fn regions(lines: &Lines<'_>) -> Vec<Region> {
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
    let region = |(k, cells): (usize, BTreeSet<(i32, i32)>)| {
        let mut sides = Vec::new();
        for (at, upright, beyond) in cells.iter().flat_map(|c| Lines::sides(*c)) {
            let Some(&other) = number.get(&beyond) else {
                continue;
            };
            let strength = strength(lines.read(at, upright));
            // What lies within is met from both of its sides.
            let times = if other == k { 0.5 } else { 1.0 };
            let undrawn = UNDRAWN * (1.0 - strength);
            if other != k || strength > 0.0 {
                sides.push((other, undrawn * times, STRAY * strength * times));
            }
        }
        let inked = cells.iter().filter(|c| lines.units.is_inked(**c)).count();
        Region {
            sides,
            inked: LEFT_OUT * inked as f64,
            cells,
        }
    };
    groups.into_iter().enumerate().map(region).collect()
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
