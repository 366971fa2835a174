//! Symbols of a legend as ink, and how well the ink of a unit agrees with them.

use super::super::legend::{Legend, Mark, Role, Symbol};
use super::patch::{ACROSS, ALONG, Patch, REACH, across, skip, soft};

/// Spreads of a symbol that are tried.
const SPREADS: usize = 9;

/// A symbol as ink.
pub(super) struct Stamp {
    pub(super) role: Role,
    pub(super) units: usize,
    is_red: bool,
    /// The way of a leaf, or the leaf.
    way: Option<Mark>,
    /// Whether nothing stands in the way of its leaf.
    is_bare: bool,
    /// For each unit of it.
    ink: Vec<Vec<f32>>,
}

pub(super) fn stamps(legend: &Legend, pen: f64) -> Vec<Stamp> {
    let mut out = Vec::new();
    for symbol in &legend.symbols {
        for k in 0..SPREADS {
            let [low, high] = symbol.spread;
            let spread = low + (high - low) * k as f64 / (SPREADS - 1) as f64;
            for (turned, mirrored) in [(false, false), (true, false), (false, true), (true, true)] {
                let stamp = stamp(symbol, spread, pen, turned, mirrored);
                if !out.iter().any(|s: &Stamp| s.role == stamp.role && s.is_red == stamp.is_red && s.ink == stamp.ink && s.way == stamp.way) {
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
        way: symbol.marks.iter().copied().find(|m| is_way(*m)),
        is_bare: symbol.marks.iter().all(|m| is_way(*m)),
        ink: (0..symbol.units).map(unit).collect(),
    }
}

fn is_way(mark: Mark) -> bool {
    matches!(mark, Mark::Arc | Mark::Leaf)
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
        Mark::Arc | Mark::Leaf => false,
    }
}

impl Stamp {
    /// How well a unit of it agrees with a patch, 0 to 1.
    pub(super) fn likeness(&self, unit: usize, patch: &Patch, pen: f64) -> f64 {
        let Some(way) = self.way else { return self.agreement(unit, patch) };
        // A leaf stands open on a drawing: its line is beside the way, not in it.
        let seen = if way == Mark::Arc { ((patch.arc - 0.5) / 0.35).clamp(0.0, 1.0) } else { ((patch.leaf - 0.4) / 0.4).clamp(0.0, 1.0) };
        let sill = if self.is_bare { emptiness(patch, pen) } else { self.agreement(unit, patch) };
        if seen > 0.0 { 0.5 * sill * seen + 0.5 * seen } else { 0.0 }
    }

    /// Twice the ink that both share by all ink of both, without the ends.
    fn agreement(&self, unit: usize, patch: &Patch) -> f64 {
        let skip = skip();
        let theirs = if self.is_red { &patch.red } else { &patch.dark };
        let (mut shared, mut all) = (0.0_f32, 0.0_f32);
        for j in 0..ACROSS {
            let row = j * ALONG + if unit == 0 { skip } else { 0 }..(j + 1) * ALONG - if unit + 1 == self.units { skip } else { 0 };
            for (a, b) in self.ink[unit][row.clone()].iter().zip(&theirs[row.clone()]) {
                shared += a.min(*b);
                all += a + b;
            }
            // Red marks have no black ink beside them.
            if self.is_red {
                all += patch.dark[row.clone()].iter().zip(&patch.red[row]).map(|(d, r)| (d - r).max(0.0)).sum::<f32>();
            }
        }
        if all > 0.0 { f64::from(2.0 * shared / all) } else { 0.0 }
    }
}

/// How empty a patch is, beside a line of the pen through it.
pub(super) fn emptiness(patch: &Patch, pen: f64) -> f64 {
    let skip = skip();
    // What stands in a room is not on its wall.
    let near = (0..ACROSS).filter(|j| across(*j).abs() < 0.16);
    let sum: f64 = near.map(|j| patch.dark[j * ALONG + skip..(j + 1) * ALONG - skip].iter().map(|d| f64::from(*d)).sum::<f64>()).sum();
    let line = (ALONG - 2 * skip) as f64 * (pen / (2.0 * REACH) * ACROSS as f64).max(1.0);
    (1.0 - sum / line).max(0.0)
}
