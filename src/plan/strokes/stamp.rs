//! Symbols of a legend as ink, and how well the ink of a unit agrees with them.

use super::super::legend::{Legend, Mark, Role, Symbol};
use super::patch::{ACROSS, ALONG, Patch, REACH, across, skip, soft, tone};

/// Spreads of a symbol that are tried.
const SPREADS: usize = 7;
/// How many pens strokes lie apart at least, from middle to middle.
const APART: f64 = 1.6;

/// A symbol as ink.
pub(super) struct Stamp {
    pub(super) role: Role,
    pub(super) units: usize,
    /// The symbol's place in its legend, and which of its spreads this is.
    pub(super) kind: (usize, usize),
    /// Whether it has red marks.
    is_red: bool,
    /// The way of a leaf, or the leaf.
    way: Option<Mark>,
    /// Whether nothing stands in the way of its leaf.
    is_bare: bool,
    /// Its black ink and its red ink, for each unit of it.
    ink: [Vec<Vec<u8>>; 2],
}

pub(super) fn stamps(legend: &Legend, pen: f64) -> Vec<Stamp> {
    let mut out = Vec::new();
    for (place, symbol) in legend.symbols.iter().enumerate() {
        for (units, k) in (symbol.units[0]..=symbol.units[1])
            .flat_map(|units| (0..SPREADS).map(move |k| (units, k)))
        {
            let [low, high] = symbol.spread;
            let spread = low + (high - low) * k as f64 / (SPREADS - 1) as f64;
            // Strokes that run into each other are a bar.
            if narrowest(symbol) * spread < APART * pen {
                continue;
            }
            for (turned, mirrored) in [(false, false), (true, false), (false, true), (true, true)] {
                let stamp = Stamp {
                    kind: (place, k),
                    ..stamp(symbol, units, spread, pen, turned, mirrored)
                };
                if !out.iter().any(|s: &Stamp| {
                    s.role == stamp.role && s.ink == stamp.ink && s.way == stamp.way
                }) {
                    out.push(stamp);
                }
            }
        }
    }
    out
}

/// The least distance between strokes that run beside each other, in spreads.
fn narrowest(symbol: &Symbol) -> f64 {
    let lines = || {
        symbol.marks.iter().filter_map(|(m, _)| {
            if let Mark::Line { at, from, to, .. } = m {
                Some((*at, *from, *to))
            } else {
                None
            }
        })
    };
    let pairs = lines().flat_map(|a| lines().map(move |b| (a, b)));
    let beside = pairs.filter(|(a, b)| a.0 < b.0 && a.1.max(b.1) + 0.2 < a.2.min(b.2));
    beside.map(|(a, b)| b.0 - a.0).fold(f64::INFINITY, f64::min)
}

fn stamp(
    symbol: &Symbol,
    units: usize,
    spread: f64,
    pen: f64,
    turned: bool,
    mirrored: bool,
) -> Stamp {
    let along = ALONG * units;
    let sub = 3;
    let ink = [false, true].map(|is_red| {
        let marks: Vec<_> = symbol
            .marks
            .iter()
            .filter(|(_, p)| p.is_red == is_red)
            .collect();
        let mut ink = vec![0.0_f32; along * ACROSS];
        for (at, value) in ink.iter_mut().enumerate().filter(|_| !marks.is_empty()) {
            let (j, i) = (at / along, at % along);
            for (a, b) in (0..sub * sub).map(|k| (k % sub, k / sub)) {
                let t = (i as f64 + (a as f64 + 0.5) / sub as f64) / along as f64;
                let s = ((j as f64 + (b as f64 + 0.5) / sub as f64) / ACROSS as f64 * 2.0 - 1.0)
                    * REACH;
                let (t, s) = (
                    if turned { 1.0 - t } else { t },
                    if mirrored { -s } else { s },
                );
                let inks = marks
                    .iter()
                    .filter(|(m, _)| covers(*m, t, s, spread, pen, units))
                    .map(|(_, p)| p.ink as f32);
                *value += inks.fold(0.0, f32::max) / (sub * sub) as f32;
            }
        }
        let ink = soft(&ink, along);
        let unit = |k: usize| {
            let within = |at: usize| at >= skip() && at + skip() < along;
            let value = &|j: usize, i: usize| {
                if within(k * ALONG + i) {
                    tone(ink[j * along + k * ALONG + i])
                } else {
                    0
                }
            };
            (0..ACROSS)
                .flat_map(|j| (0..ALONG).map(move |i| value(j, i)))
                .collect()
        };
        (0..units).map(unit).collect::<Vec<Vec<u8>>>()
    });
    Stamp {
        role: symbol.role,
        units,
        kind: (0, 0),
        is_red: symbol.marks.iter().any(|(_, p)| p.is_red),
        way: symbol.marks.iter().map(|(m, _)| *m).find(|m| is_way(*m)),
        is_bare: symbol.marks.iter().all(|(m, _)| is_way(*m)),
        ink,
    }
}

fn is_way(mark: Mark) -> bool {
    matches!(mark, Mark::Arc | Mark::Leaf)
}

/// Whether a mark covers a place.
fn covers(mark: Mark, t: f64, s: f64, spread: f64, pen: f64, units: usize) -> bool {
    match mark {
        Mark::Line {
            at,
            from,
            to,
            width,
        } => t >= from && t <= to && (s - at * spread).abs() <= pen * width / 2.0,
        Mark::Bar {
            at: [low, high],
            from,
            to,
        } => t >= from && t <= to && s >= low * spread && s <= high * spread,
        Mark::Ticks {
            at: [low, high],
            count,
            width,
            between_posts,
        } => {
            // In units from an end of one.
            let along = (t * units as f64).fract();
            let (n, shift) = if between_posts {
                (f64::from(count) + 1.0, 0.0)
            } else {
                (f64::from(count), 0.5)
            };
            let off = along * n - shift - libm::round(along * n - shift);
            s >= low * spread && s <= high * spread && off.abs() / n <= pen * width / 2.0
        }
        Mark::Arc | Mark::Leaf => false,
    }
}

impl Stamp {
    /// How well a unit of it agrees with a patch, 0 to 1.
    pub(super) fn likeness(&self, unit: usize, patch: &Patch, pen: f64) -> f64 {
        let Some(way) = self.way else {
            return self.agreement(unit, patch);
        };
        // A leaf stands open on a drawing: its line is beside the way, not in it.
        let seen = if way == Mark::Arc {
            ((patch.arc - 0.5) / 0.35).clamp(0.0, 1.0)
        } else {
            ((patch.leaf - 0.4) / 0.4).clamp(0.0, 1.0)
        };
        let sill = if self.is_bare {
            emptiness(patch, pen)
        } else {
            self.agreement(unit, patch)
        };
        if seen > 0.0 {
            0.5 * sill * seen + 0.5 * seen
        } else {
            0.0
        }
    }

    /// Twice the ink that both share by all ink of both, without the ends.
    fn agreement(&self, unit: usize, patch: &Patch) -> f64 {
        let ends = usize::from(unit == 0) + 2 * usize::from(unit + 1 == self.units);
        let (mut shared, mut all) = (0, 0);
        for (mine, theirs, sums, is_there) in [
            (&self.ink[0], &patch.black, &patch.blacks, true),
            (
                &self.ink[1],
                &patch.red,
                &patch.reds,
                self.is_red || patch.is_red,
            ),
        ] {
            if is_there {
                shared += mine[unit]
                    .iter()
                    .zip(theirs)
                    .map(|(a, b)| u32::from(*a.min(b)))
                    .sum::<u32>();
                all += mine[unit].iter().map(|a| u32::from(*a)).sum::<u32>() + sums[ends];
            }
        }
        if all > 0 {
            2.0 * f64::from(shared) / f64::from(all)
        } else {
            0.0
        }
    }
}

/// How empty a patch is, beside a line of the pen through it.
pub(super) fn emptiness(patch: &Patch, pen: f64) -> f64 {
    let skip = skip();
    // What stands in a room is not on its wall.
    let near = (0..ACROSS).filter(|j| across(*j).abs() < 0.16);
    let cells = near.flat_map(|j| j * ALONG + skip..(j + 1) * ALONG - skip);
    let sum = cells
        .map(|k| f64::from(patch.black[k]) + f64::from(patch.red[k]))
        .sum::<f64>()
        / 255.0;
    let line = (ALONG - 2 * skip) as f64 * (pen / (2.0 * REACH) * ACROSS as f64).max(1.0);
    (1.0 - sum / line).max(0.0)
}
