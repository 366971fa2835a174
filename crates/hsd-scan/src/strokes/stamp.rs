//! Symbols of a legend as ink, and how well the ink of a unit agrees with them.

use super::super::legend::{Legend, Mark, Role, Symbol};
use super::Nib;
use super::patch::{ACROSS, Patch, REACH, across, skip, soft, weight};
use super::proof::{Proof, opposites};
use super::tones::{ALONG, Tones, tone};

/// Spreads of a symbol that are tried.
const SPREADS: usize = 7;
/// How many pens strokes lie apart at least, from middle to middle.
const APART: f64 = 1.6;
/// The most that is taken off the score of a symbol whose strokes run into each other when blurred.
const VAGUE: f64 = 0.3;
/// How many times as far apart as they are wide blurred strokes are still told apart.
const BLURRED_APART: f64 = 1.2;
/// How wide a bell curve is at half its height, in spreads.
const BELL: f64 = 2.355;

/// A symbol as ink.
#[derive(Clone)]
pub(super) struct Stamp {
    pub(super) role: Role,
    pub(super) units: usize,
    /// The symbol's place in its legend, and which of its spreads this is.
    pub(super) kind: (usize, usize),
    /// The penalty on its score, 0 to 0.3, for strokes so near each other that blur joins them.
    pub(super) cost: f64,
    /// Whether it has red marks.
    pub(super) is_red: bool,
    /// The way of a leaf, or the leaf.
    way: Option<Mark>,
    /// Whether nothing stands in the way of its leaf.
    is_bare: bool,
    /// How far on in the list it stands mirrored.
    pub(super) mirrored: Option<isize>,
    /// What tells it from others.
    pub(super) proof: Option<Proof>,
    /// Black and red ink, for each unit.
    ink: [Vec<Tones>; 2],
}

pub(super) fn stamps(legend: &Legend, nib: Nib) -> Vec<Stamp> {
    let mut out = Vec::new();
    for (place, symbol) in legend.symbols.iter().enumerate() {
        for (units, k) in (symbol.units[0]..=symbol.units[1])
            .flat_map(|units| (0..SPREADS).map(move |k| (units, k)))
        {
            let [low, high] = symbol.spread;
            let spread = low + (high - low) * k as f64 / (SPREADS - 1) as f64;
            // Strokes that run into each other are a bar.
            let gap = narrowest(symbol) * spread;
            if gap < APART * nib.width {
                continue;
            }
            let first = out.len();
            let upright = Stamp {
                kind: (place, k),
                cost: VAGUE * (1.0 - gap / apart(nib)).max(0.0),
                ..stamp(symbol, units, spread, nib)
            };
            for (turned, mirrored) in [(false, false), (true, false), (false, true), (true, true)] {
                let stamp = upright.flipped(turned, mirrored);
                let alike = |s: &Stamp| s.ink == stamp.ink && s.way == stamp.way;
                if !out[first..].iter().any(alike) {
                    out.push(stamp);
                }
            }
            oppose(&mut out[first..], symbol, nib, spread);
        }
    }
    out
}

/// How far apart blurred strokes are from middle to middle that are seen as two.
fn apart(nib: Nib) -> f64 {
    let blur = BELL * nib.blur;
    BLURRED_APART * libm::sqrt(nib.width * nib.width + blur * blur)
}

/// Gives the stamps of a symbol what they have to prove.
fn oppose(stamps: &mut [Stamp], symbol: &Symbol, nib: Nib, spread: f64) {
    if let Some(pair) = opposites(symbol) {
        let Some(units) = stamps.first().map(|s| s.units) else {
            return;
        };
        let ink = |s: &Symbol| stamp(s, units, spread, nib).whole();
        let proof = Proof::of(&ink(&pair[0]), &ink(&pair[1]));
        stamps
            .iter_mut()
            .for_each(|own| own.proof = Some(proof.clone()));
    } else if let [one, other] = stamps {
        // One is the other in a mirror: the ink must be on the right sides.
        one.proof = Some(Proof::of(&one.whole(), &other.whole()));
        other.proof = Some(Proof::of(&other.whole(), &one.whole()));
        (one.mirrored, other.mirrored) = (Some(1), Some(-1));
    }
}

/// The least distance between strokes that run beside each other from end to end, in spreads.
fn narrowest(symbol: &Symbol) -> f64 {
    let through = |mark: Mark| match mark {
        Mark::Line { at, from, to, .. } if from <= 0.0 && to >= 1.0 => Some(at),
        _ => None,
    };
    let lines = || symbol.marks.iter().filter_map(|(m, _)| through(*m));
    let pairs = lines().flat_map(|a| lines().map(move |b| b - a));
    pairs.filter(|d| *d > 0.0).fold(f64::INFINITY, f64::min)
}

fn stamp(symbol: &Symbol, units: usize, spread: f64, nib: Nib) -> Stamp {
    let along = ALONG * units;
    let ink = [false, true].map(|is_red| {
        let mut ink = vec![0.0_f32; along * ACROSS];
        for (mark, drawn) in symbol.marks.iter().filter(|(_, p)| p.is_red == is_red) {
            let Some((rows, columns)) = covered(*mark, spread, nib.width, units) else {
                continue;
            };
            for (row, values) in rows
                .iter()
                .zip(ink.chunks_exact_mut(along))
                .filter(|r| *r.0 > 0.0)
            {
                let row = row * drawn.ink as f32;
                let pairs = values.iter_mut().zip(&columns);
                pairs.for_each(|(value, column)| *value = value.max(row * column));
            }
        }
        let mut ink = blurred(ink, along, nib.blur);
        let inked = ink.iter_mut().filter(|v| **v > 0.0);
        inked.for_each(|v| *v = weight(f64::from(*v)) as f32);
        let ink = soft(&ink, along);
        (0..units)
            .map(|k| part(&ink, k, along))
            .collect::<Vec<Tones>>()
    });
    Stamp {
        role: symbol.role,
        units,
        kind: (0, 0),
        cost: 0.0,
        mirrored: None,
        proof: None,
        is_red: symbol.marks.iter().any(|(_, p)| p.is_red),
        way: symbol.marks.iter().map(|(m, _)| *m).find(|m| is_way(*m)),
        is_bare: symbol.marks.iter().all(|(m, _)| is_way(*m)),
        ink,
    }
}

/// The ink of one unit of a stamp, without its ends.
fn part(ink: &[f32], unit: usize, along: usize) -> Tones {
    let columns = unit * ALONG..(unit + 1) * ALONG;
    let within = skip().max(columns.start)..(along - skip()).min(columns.end);
    let mut out = vec![0; ACROSS * ALONG];
    for (to, from) in out.chunks_exact_mut(ALONG).zip(ink.chunks_exact(along)) {
        let to = &mut to[within.start - columns.start..within.end - columns.start];
        let pairs = to.iter_mut().zip(&from[within.clone()]);
        pairs.for_each(|(to, from)| *to = tone(*from));
    }
    Tones::new(out)
}

/// Ink spread by a bell curve of so many units.
fn blurred(ink: Vec<f32>, along: usize, blur: f64) -> Vec<f32> {
    let rows = bell(blur / (2.0 * REACH) * ACROSS as f64);
    let columns = bell(blur * ALONG as f64);
    let mut down = vec![0.0; ink.len()];
    for (j, from) in ink.chunks_exact(along).enumerate() {
        if from.iter().all(|v| *v == 0.0) {
            continue;
        }
        for (k, weight) in rows.iter().enumerate() {
            let row = j + k;
            if row >= rows.len() / 2 && row - rows.len() / 2 < ACROSS {
                let row = (row - rows.len() / 2) * along;
                let pairs = down[row..row + along].iter_mut().zip(from);
                pairs.for_each(|(to, value)| *to += value * weight);
            }
        }
    }
    let mut out = vec![0.0; ink.len()];
    let reach = columns.len() / 2;
    let mut wide = vec![0.0; along + 2 * reach];
    for (from, to) in down.chunks_exact(along).zip(out.chunks_exact_mut(along)) {
        // Strokes go on beyond the ends.
        wide[..reach].fill(from[0]);
        wide[reach..reach + along].copy_from_slice(from);
        wide[reach + along..].fill(from[along - 1]);
        for (k, weight) in columns.iter().enumerate() {
            let pairs = to.iter_mut().zip(&wide[k..k + along]);
            pairs.for_each(|(value, from)| *value += from * weight);
        }
    }
    out
}

/// Weights of a bell curve so many samples wide; their sum is 1.
fn bell(spread: f64) -> Vec<f32> {
    let reach = (spread * 2.5).ceil() as i32;
    let weight = |k: i32| libm::exp(-0.5 * f64::from(k * k) / (spread * spread).max(1e-9));
    let sum: f64 = (-reach..=reach).map(weight).sum();
    (-reach..=reach).map(|k| (weight(k) / sum) as f32).collect()
}

fn is_way(mark: Mark) -> bool {
    matches!(mark, Mark::Arc | Mark::Leaf)
}

/// The shares of rows, from right to left, and of columns, from end to end, that a mark covers.
fn covered(mark: Mark, spread: f64, pen: f64, units: usize) -> Option<(Vec<f32>, Vec<f32>)> {
    let rows =
        |low: f64, high: f64| cells(ACROSS, low / REACH / 2.0 + 0.5, high / REACH / 2.0 + 0.5);
    let along = ALONG * units;
    Some(match mark {
        Mark::Line {
            at,
            from,
            to,
            width,
        } => {
            let half = pen * width / 2.0;
            (
                rows(at * spread - half, at * spread + half),
                cells(along, from, to),
            )
        }
        Mark::Bar {
            at: [low, high],
            from,
            to,
        } => (rows(low * spread, high * spread), cells(along, from, to)),
        Mark::Ticks {
            at: [low, high],
            count,
            width,
            between_posts,
        } => {
            let (spaces, shift) = if between_posts {
                (f64::from(count) + 1.0, 0.0)
            } else {
                (f64::from(count), 0.5)
            };
            let half = pen * width / 2.0;
            let middles = (0..=count).map(|k| (f64::from(k) + shift) / spaces);
            let mut unit = [0.0_f32; ALONG];
            for middle in middles {
                let tick = cells(ALONG, middle - half, middle + half);
                unit.iter_mut().zip(tick).for_each(|(a, b)| *a = a.max(b));
            }
            (rows(low * spread, high * spread), unit.repeat(units))
        }
        Mark::Arc | Mark::Leaf => return None,
    })
}

/// How much of each of so many equal parts of 0 to 1 lies between two places.
fn cells(count: usize, low: f64, high: f64) -> Vec<f32> {
    let n = count as f64;
    let share =
        |k: usize| ((k as f64 + 1.0).min(high * n) - (k as f64).max(low * n)).clamp(0.0, 1.0);
    (0..count).map(|k| share(k) as f32).collect()
}

impl Stamp {
    /// Whether it is told by the way of a leaf.
    pub(super) fn is_way(&self) -> bool {
        self.way.is_some()
    }

    /// The same symbol with other ink: its black ink and its red ink, for each unit of it.
    pub(super) fn with_ink(&self, ink: [Vec<Tones>; 2]) -> Stamp {
        Stamp {
            mirrored: None,
            ink,
            ..self.clone()
        }
    }

    /// The same from the other end, or from the other side.
    fn flipped(&self, turned: bool, mirrored: bool) -> Stamp {
        let ink = self.ink.each_ref().map(|units| {
            let mut units: Vec<Tones> = units
                .iter()
                .map(|unit| {
                    let mut ink = unit.by_place().to_vec();
                    if mirrored != turned {
                        ink.chunks_exact_mut(ALONG).for_each(<[u8]>::reverse);
                    }
                    if mirrored {
                        ink.reverse();
                    }
                    Tones::new(ink)
                })
                .collect();
            if turned {
                units.reverse();
            }
            units
        });
        Stamp {
            ink,
            ..self.clone()
        }
    }

    /// Its ink of both colours, unit by unit.
    fn whole(&self) -> Vec<Vec<i16>> {
        let both = |(a, b): (&u8, &u8)| (i16::from(*a) + i16::from(*b)).min(255);
        let units = self.ink[0].iter().zip(&self.ink[1]);
        units
            .map(|(a, b)| a.by_place().iter().zip(b.by_place()).map(both).collect())
            .collect()
    }

    /// How well a unit of it agrees with a patch, 0 to 1, and how much of what tells it from others is there.
    pub(super) fn likeness(&self, unit: usize, patch: &Patch, nib: Nib) -> (f64, [f32; 2]) {
        let Some(way) = self.way else {
            let (likeness, shift) = self.agreement(unit, patch);
            let proof = self.proof.as_ref();
            return (
                likeness,
                proof.map_or([0.0; 2], |p| p.shown(unit, patch, shift)),
            );
        };
        // A leaf stands open on a drawing: its line is beside the way, not in it.
        let seen = if way == Mark::Arc {
            ((patch.arc - 0.5) / 0.35).clamp(0.0, 1.0)
        } else {
            ((patch.leaf - 0.4) / 0.4).clamp(0.0, 1.0)
        };
        let sill = if self.is_bare {
            emptiness(patch, nib)
        } else {
            self.agreement(unit, patch).0
        };
        (
            if seen > 0.0 {
                0.5 * sill * seen + 0.5 * seen
            } else {
                0.0
            },
            [0.0; 2],
        )
    }

    /// Twice the ink that both share by all ink of both, without the ends; a hair to one side is tried too.
    fn agreement(&self, unit: usize, patch: &Patch) -> (f64, i32) {
        let ends = usize::from(unit == 0) + 2 * usize::from(unit + 1 == self.units);
        let mut shared = [0_u32; 3];
        let mut all = 0;
        let red = self.is_red || patch.is_red;
        for (mine, theirs, sums, is_there) in [
            (&self.ink[0], &patch.black, &patch.blacks, true),
            (&self.ink[1], &patch.red, &patch.reds, red),
        ] {
            if is_there {
                let mine = &mine[unit];
                let common = mine.common(theirs);
                shared
                    .iter_mut()
                    .zip(common)
                    .for_each(|(sum, own)| *sum += own);
                all += mine.all() + sums[ends];
            }
        }
        // Of two that agree alike the one in the middle.
        let best = [1, 0, 2]
            .into_iter()
            .reduce(|a, b| if shared[b] > shared[a] { b } else { a });
        let best = best.unwrap_or(1);
        let value = if all > 0 {
            2.0 * f64::from(shared[best]) / f64::from(all)
        } else {
            0.0
        };
        (value, best as i32 - 1)
    }
}

/// How empty a patch is, beside a line of the pen through it.
pub(super) fn emptiness(patch: &Patch, nib: Nib) -> f64 {
    let (black, red) = (patch.black.by_place(), patch.red.by_place());
    let skip = skip();
    // What stands in a room is not on its wall.
    let near = (0..ACROSS).filter(|j| across(*j).abs() < 0.16);
    let cells = near.flat_map(|j| j * ALONG + skip..(j + 1) * ALONG - skip);
    let sum = cells
        .map(|k| f64::from(black[k]) + f64::from(red[k]))
        .sum::<f64>()
        / 255.0;
    let line = (ALONG - 2 * skip) as f64 * (nib.width / (2.0 * REACH) * ACROSS as f64).max(1.0);
    (1.0 - sum / line).max(0.0)
}
