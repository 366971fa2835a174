//! What the strokes on each unit of the grid stand for: the ink round it beside the symbols of a legend.

use super::grid::{Grid, dark_at};
use super::legend::{Legend, Mark, Role, Symbol};
use super::sheet::Ink;
use glam::DVec2;
use std::collections::BTreeSet;

/// Samples along a unit.
const ALONG: usize = 32;
/// Samples across it.
const ACROSS: usize = 45;
/// How far to its sides is looked, units.
const REACH: f64 = 0.3;
/// The share of a unit at its ends that posts and other walls cover.
const END: f64 = 0.14;
/// Spreads of a symbol that are tried.
const SPREADS: usize = 9;
/// What agrees less with every symbol is none: writing, hatching, things that stand in a room.
const CLUTTER: f64 = 0.5;
/// What a change from one symbol to another costs, in shares of a unit.
const CHANGE: f64 = 0.06;

/// What a unit was read as.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Read {
    /// What stands there.
    pub role: Role,
    /// How well the ink agrees with the symbol, 0 to 1.
    pub likeness: f64,
    /// How much better than with the best symbol of another role.
    pub lead: f64,
}

impl Read {
    const EMPTY: Read = Read { role: Role::Empty, likeness: 1.0, lead: 1.0 };
}

/// All units of a grid.
#[derive(Clone, Debug)]
pub struct Units {
    /// The lines of the grid: first and last, to the right.
    pub across: (i32, i32),
    /// The same, downwards.
    pub down: (i32, i32),
    /// Level units, line by line from above.
    level: Vec<Vec<Read>>,
    /// Upright units, line by line from the left.
    upright: Vec<Vec<Read>>,
    /// How well the symbols agree with the ink, 0 to 1.
    pub likeness: f64,
    /// Cells with ink in their middle: writing, mats, what is built in.
    inked: BTreeSet<(i32, i32)>,
}

impl Units {
    /// The same, with what lies in the cells.
    #[must_use]
    pub fn with_cells(self, ink: &Ink, grid: &Grid) -> Units {
        Units { inked: inked(ink, grid), ..self }
    }

    /// Whether there is ink in the middle of the cell below and to the right of a crossing.
    pub fn is_inked(&self, cell: (i32, i32)) -> bool {
        self.inked.contains(&cell)
    }

    /// The unit that begins at a crossing and runs to the right.
    pub fn level(&self, u: i32, v: i32) -> Read {
        look(&self.level, v - self.down.0, u - self.across.0)
    }

    /// The unit that begins at a crossing and runs downwards.
    pub fn upright(&self, u: i32, v: i32) -> Read {
        look(&self.upright, u - self.across.0, v - self.down.0)
    }
}

fn look(lines: &[Vec<Read>], line: i32, at: i32) -> Read {
    let line = usize::try_from(line).ok().and_then(|l| lines.get(l));
    let unit = line.and_then(|l| usize::try_from(at).ok().and_then(|a| l.get(a)));
    unit.copied().unwrap_or(Read::EMPTY)
}

/// Reads the units of a grid by a legend; `ink` is that of walls, `all` has what slants too, `pen` is the width of the thinnest strokes, in units.
pub fn read(ink: &Ink, all: &Ink, grid: &Grid, legend: &Legend, pen: f64) -> Units {
    let stamps = stamps(legend, pen);
    let ((u0, u1), (v0, v1)) = (grid.across, grid.down);
    let line = |count: i32, patch: &dyn Fn(i32) -> Patch| {
        let patches: Vec<Patch> = (0..count).map(patch).collect();
        best(&patches, &stamps, pen)
    };
    let level: Vec<Vec<Read>> = (v0..=v1)
        .map(|v| line(u1 - u0, &|k| Patch::of((ink, all), grid, DVec2::new(f64::from(u0 + k), f64::from(v)), false)))
        .collect();
    let upright: Vec<Vec<Read>> = (u0..=u1)
        .map(|u| line(v1 - v0, &|k| Patch::of((ink, all), grid, DVec2::new(f64::from(u), f64::from(v0 + k)), true)))
        .collect();
    let mut lines = [level, upright];
    settle(&mut lines);
    let [level, upright] = lines;
    let read = level.iter().chain(&upright).flatten().filter(|r| r.role.parts() && r.role != Role::Open);
    let (sum, count) = read.fold((0.0, 0.0), |(s, n), r| (s + r.likeness, n + 1.0));
    let likeness = if count > 0.0 { sum / count } else { 0.0 };
    Units { across: grid.across, down: grid.down, level, upright, likeness, inked: BTreeSet::new() }
}

/// A plan has more walls than ways without doors: where the two are drawn alike, what was read as ways are walls.
fn settle(lines: &mut [Vec<Vec<Read>>; 2]) {
    let count = |role: Role| lines.iter().flatten().flatten().filter(|r| r.role == role).count();
    if count(Role::Open) > count(Role::Wall) {
        for read in lines.iter_mut().flatten().flatten().filter(|r| r.role == Role::Open) {
            read.role = Role::Wall;
        }
    }
}

/// Cells with more ink in their middle than specks.
fn inked(ink: &Ink, grid: &Grid) -> BTreeSet<(i32, i32)> {
    const SAMPLES: i32 = 24;
    let mut out = BTreeSet::new();
    for v in grid.down.0..grid.down.1 {
        for u in grid.across.0..grid.across.1 {
            let inside = |k: i32| 0.2 + 0.6 * (f64::from(k) + 0.5) / f64::from(SAMPLES);
            let places = (0..SAMPLES * SAMPLES).map(|k| grid.at(f64::from(u) + inside(k % SAMPLES), f64::from(v) + inside(k / SAMPLES)));
            if places.filter(|p| dark_at(ink, *p) > ink.threshold).count() >= 8 {
                out.insert((u, v));
            }
        }
    }
    out
}

/// The width of the thinnest common strokes, units: the most frequent length of ink across the sheet, small ones.
pub fn pen(ink: &Ink, grid: &Grid) -> f64 {
    let most = (grid.unit * 0.5) as usize;
    let mut counts = vec![0_u32; most.max(3) + 1];
    for y in (0..ink.dark.height()).step_by(2) {
        let mut run = 0;
        for x in 0..ink.dark.width() {
            if ink.is(x, y) {
                run += 1;
            } else {
                if run > 0 && run < counts.len() {
                    counts[run] += 1;
                }
                run = 0;
            }
        }
    }
    let most = counts.iter().copied().max().unwrap_or(0);
    let common = (1..counts.len()).find(|k| counts[*k] * 4 >= most).unwrap_or(1);
    (common as f64 / grid.unit).clamp(0.02, 0.12)
}

/// The ink round a unit: row by row across, from the right side of its direction to the left.
#[derive(Clone)]
struct Patch {
    dark: Vec<f32>,
    red: Vec<f32>,
    /// The share of ink on the quarter circles about its ends: the way of a leaf.
    arc: f64,
    /// Whether there is more in it than specks.
    is_inked: bool,
}

impl Patch {
    fn of((ink, all): (&Ink, &Ink), grid: &Grid, from: DVec2, upright: bool) -> Patch {
        let place = |along: f64, across: f64| match upright {
            false => grid.at(from.x + along, from.y + across),
            true => grid.at(from.x + across, from.y + along),
        };
        let mut dark = vec![0.0; ALONG * ACROSS];
        let mut red = vec![0.0; ALONG * ACROSS];
        let full = f64::from(ink.threshold) * 1.7;
        for j in 0..ACROSS {
            for i in 0..ALONG {
                let (mut black, mut colour) = (0.0, 0.0);
                for (a, b) in [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)] {
                    let at = place((i as f64 + a) / ALONG as f64, ((j as f64 + b) / ACROSS as f64 * 2.0 - 1.0) * REACH);
                    black += f64::from(dark_at(ink, at)) / 4.0;
                    colour += f64::from(red_at(ink, at)) / 4.0;
                }
                let share = ((black - f64::from(ink.threshold) * 0.35) / full).clamp(0.0, 1.0);
                dark[j * ALONG + i] = share as f32;
                red[j * ALONG + i] = (colour / full * 1.5).clamp(0.0, 1.0).min(share) as f32;
            }
        }
        let skip = (END * ALONG as f64).round() as usize;
        let middle: f32 = (0..ACROSS).map(|j| dark[j * ALONG + skip..(j + 1) * ALONG - skip].iter().sum::<f32>()).sum();
        let arc = arc(all, &place);
        Patch { dark: soft(&dark, ALONG), red: soft(&red, ALONG), arc, is_inked: middle > 4.0 || arc > 0.5 }
    }
}

fn red_at(ink: &Ink, at: DVec2) -> u8 {
    let (x, y) = (at.x.floor(), at.y.floor());
    let inside = x >= 0.0 && y >= 0.0 && x < f64::from(ink.red.width()) && y < f64::from(ink.red.height());
    if inside { ink.red.get_pixel(x as u32, y as u32)[0] } else { 0 }
}

/// The best share of ink along a quarter circle about one of the ends, on one of the sides.
fn arc(ink: &Ink, place: &dyn Fn(f64, f64) -> DVec2) -> f64 {
    let mut most = 0.0_f64;
    for (hinge, way) in [(0.0, 1.0), (0.04, 1.0), (0.08, 1.0), (1.0, -1.0), (0.96, -1.0), (0.92, -1.0)] {
        for (side, k) in [-1.0, 1.0].into_iter().flat_map(|side| (0..8).map(move |k| (side, k))) {
            let radius = 0.82 + 0.025 * f64::from(k);
            let seen = (0..18).filter(|k| {
                let angle = (14.0 + 62.0 * f64::from(*k) / 17.0_f64).to_radians();
                let (along, across) = (libm::cos(angle), libm::sin(angle));
                let dark = |r: f64| dark_at(ink, place(hinge + way * r * along, side * r * across));
                dark(radius).max(dark(radius - 0.015)).max(dark(radius + 0.015)) > ink.threshold
            });
            most = most.max(seen.count() as f64 / 18.0);
        }
    }
    most
}

/// Samples to each side over which ink is spread, so that strokes a hair beside each other still agree.
const SOFT: usize = 2;

/// Values spread a little across.
fn soft(values: &[f32], along: usize) -> Vec<f32> {
    let across = values.len() / along;
    let mut out = vec![0.0; values.len()];
    for j in 0..across {
        let near = j.saturating_sub(SOFT)..=(j + SOFT).min(across - 1);
        for i in 0..along {
            let mut sum = 0.0;
            for k in near.clone() {
                let weight = (SOFT + 1 - k.abs_diff(j)) as f32;
                sum += weight * values[k * along + i];
            }
            out[j * along + i] = sum / ((SOFT + 1) * (SOFT + 1)) as f32;
        }
    }
    out
}

/// A symbol as ink.
struct Stamp {
    role: Role,
    units: usize,
    is_red: bool,
    is_arc: bool,
    /// Whether nothing stands in the way of its leaf.
    is_bare: bool,
    /// For each unit of it.
    ink: Vec<Vec<f32>>,
}

fn stamps(legend: &Legend, pen: f64) -> Vec<Stamp> {
    let mut out = Vec::new();
    for symbol in &legend.symbols {
        for k in 0..SPREADS {
            let [low, high] = symbol.spread;
            let spread = low + (high - low) * k as f64 / (SPREADS - 1) as f64;
            for (turned, mirrored) in [(false, false), (true, false), (false, true), (true, true)] {
                let stamp = stamp(symbol, spread, pen, turned, mirrored);
                if !out.iter().any(|s: &Stamp| s.role == stamp.role && s.is_red == stamp.is_red && s.ink == stamp.ink && s.is_arc == stamp.is_arc) {
                    out.push(stamp);
                }
            }
        }
    }
    out
}

fn stamp(symbol: &Symbol, spread: f64, pen: f64, turned: bool, mirrored: bool) -> Stamp {
    let along = ALONG * symbol.units;
    let mut ink = vec![0.0_f32; along * ACROSS];
    let sub = 3;
    for j in 0..ACROSS {
        for i in 0..along {
            let mut hits = 0;
            for (a, b) in (0..sub * sub).map(|k| (k % sub, k / sub)) {
                let t = (i as f64 + (a as f64 + 0.5) / sub as f64) / along as f64;
                let s = ((j as f64 + (b as f64 + 0.5) / sub as f64) / ACROSS as f64 * 2.0 - 1.0) * REACH;
                let (t, s) = (if turned { 1.0 - t } else { t }, if mirrored { -s } else { s });
                hits += usize::from(symbol.marks.iter().any(|m| covers(*m, t, s, spread, pen, symbol.units)));
            }
            ink[j * along + i] = hits as f32 / (sub * sub) as f32;
        }
    }
    let ink = soft(&ink, along);
    let unit = |k: usize| (0..ACROSS).flat_map(|j| ink[j * along + k * ALONG..j * along + (k + 1) * ALONG].to_vec()).collect();
    Stamp {
        role: symbol.role,
        units: symbol.units,
        is_red: symbol.is_red,
        is_arc: symbol.marks.contains(&Mark::Arc),
        is_bare: symbol.marks == [Mark::Arc],
        ink: (0..symbol.units).map(unit).collect(),
    }
}

/// Whether a mark covers a place.
fn covers(mark: Mark, t: f64, s: f64, spread: f64, pen: f64, units: usize) -> bool {
    match mark {
        Mark::Line { at, from, to, width } => t >= from && t <= to && (s - at * spread).abs() <= pen * width / 2.0,
        Mark::Bar { at: [low, high], from, to } => t >= from && t <= to && s >= low * spread && s <= high * spread,
        Mark::Ticks { at: [low, high], count } => {
            let n = f64::from(count) * units as f64;
            let off = (t * n - 0.5) - libm::round(t * n - 0.5);
            s >= low * spread && s <= high * spread && off.abs() / n * units as f64 <= pen / 2.0
        }
        Mark::Arc => false,
    }
}

/// How well a stamp agrees with patches: twice the ink they share by all ink of both, without the ends.
fn likeness(stamp: &Stamp, patches: &[Patch]) -> f64 {
    let total = ALONG * stamp.units;
    let skip = (END * ALONG as f64).round() as usize;
    let (mut shared, mut all) = (0.0, 0.0);
    for (k, (mine, patch)) in stamp.ink.iter().zip(patches).enumerate() {
        let theirs = if stamp.is_red { &patch.red } else { &patch.dark };
        for j in 0..ACROSS {
            for i in 0..ALONG {
                let at = k * ALONG + i;
                if at < skip || at + skip >= total {
                    continue;
                }
                let (a, b) = (mine[j * ALONG + i], theirs[j * ALONG + i]);
                shared += f64::from(a.min(b));
                all += f64::from(a + b);
                // Red marks have no black ink beside them.
                if stamp.is_red {
                    all += f64::from((patch.dark[j * ALONG + i] - b).max(0.0));
                }
            }
        }
    }
    if all > 0.0 { 2.0 * shared / all } else { 0.0 }
}

/// How empty a patch is, beside a line of the pen through it.
fn emptiness(patch: &Patch, pen: f64) -> f64 {
    let skip = (END * ALONG as f64).round() as usize;
    let mut sum = 0.0;
    for j in 0..ACROSS {
        // What stands in a room is not on its wall.
        let s = ((j as f64 + 0.5) / ACROSS as f64 * 2.0 - 1.0) * REACH;
        if s.abs() < 0.16 {
            sum += (skip..ALONG - skip).map(|i| f64::from(patch.dark[j * ALONG + i])).sum::<f64>();
        }
    }
    let line = (ALONG - 2 * skip) as f64 * (pen / (2.0 * REACH) * ACROSS as f64).max(1.0);
    (1.0 - sum / line).max(0.0)
}

/// The symbols along a line of the grid that agree best with its ink (dynamic programming over its units).
fn best(patches: &[Patch], stamps: &[Stamp], pen: f64) -> Vec<Read> {
    let n = patches.len();
    // For each unit and number of units the best of each role.
    let mut likely: Vec<Vec<(Role, usize, f64)>> = Vec::with_capacity(n);
    for k in 0..n {
        // A leaf's way makes a door of what is empty otherwise.
        let bare = emptiness(&patches[k], pen);
        let leaf = ((patches[k].arc - 0.5) / 0.35).clamp(0.0, 1.0);
        let mut here: Vec<(Role, usize, f64)> = vec![(Role::Empty, 1, bare.max(CLUTTER) * (1.0 - 0.5 * leaf))];
        let mut note = |role: Role, units: usize, value: f64| {
            match here.iter_mut().find(|h| h.0 == role && h.1 == units) {
                Some(h) => h.2 = h.2.max(value),
                None => here.push((role, units, value)),
            }
        };
        // Most of a sheet is empty, and no symbol stands there.
        let reach = |units: usize| k + units <= n && patches[k..k + units].iter().any(|p| p.is_inked);
        for stamp in stamps.iter().filter(|s| reach(s.units)) {
            if stamp.is_arc {
                // A leaf stands open on a drawing: its line is beside the way, not in it.
                let way = if stamp.is_bare { bare } else { likeness(stamp, &patches[k..=k]) };
                note(stamp.role, 1, way * leaf.max(0.01) * 1.1);
            } else {
                note(stamp.role, stamp.units, likeness(stamp, &patches[k..k + stamp.units]));
            }
        }
        likely.push(here);
    }
    let mut table: Vec<Option<(f64, usize, Role, f64)>> = vec![None; n + 1];
    table[0] = Some((0.0, 0, Role::Empty, 1.0));
    for k in 0..n {
        let Some((sum, _, before, _)) = table[k] else { continue };
        for &(role, units, value) in &likely[k] {
            let cost = if role == before && units == 1 { 0.0 } else { CHANGE };
            let total = sum + units as f64 * value - cost;
            if table[k + units].is_none_or(|t| total > t.0) {
                table[k + units] = Some((total, units, role, value));
            }
        }
    }
    let mut out = vec![Read::EMPTY; n];
    let mut end = n;
    while end > 0 {
        let Some((_, units, role, value)) = table[end] else { break };
        for k in end - units..end {
            let others = likely[k].iter().filter(|l| l.0 != role).map(|l| l.2);
            out[k] = Read { role, likeness: value, lead: value - others.fold(0.0, f64::max) };
        }
        end -= units;
    }
    out
}
