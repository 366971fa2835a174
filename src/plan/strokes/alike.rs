//! How far what is drawn on a unit is from the walls of its sheet: one hand draws all of its walls alike, and what looks like a wall
//! of a legend but not like the others on the sheet is something else.

use super::patch::{ACROSS, Patch};

/// The fewest halves of units whose mean is how a sheet draws its walls.
const LEAST: usize = 8;
/// The share of the darkest from which on there is wall.
const DARK: f32 = 0.15;
/// Samples to each side of it that count too.
const BESIDE: usize = 2;
/// Samples to the side that a wall may lie beside its line.
const SWAY: i64 = 3;

/// How far a wall may differ from the typical wall of its sheet, as a share of the ink of that wall: the median difference times the
/// first number, plus the second, within these bounds.
const TIMES: f64 = 1.4;
const BESIDES: f64 = 0.1;
const BOUNDS: [f64; 2] = [0.25, 0.5];

/// How a sheet draws its walls, across.
pub(super) struct Walls {
    profile: [f32; ACROSS],
    band: std::ops::Range<usize>,
    sum: f32,
    /// The distance from which on a unit is unlike.
    near: f64,
}

impl Walls {
    /// The middle of all that was read as walls.
    pub(super) fn of(patches: &[&Patch]) -> Option<Walls> {
        let halves: Vec<&[f32; ACROSS]> = patches.iter().flat_map(|p| &p.profiles).collect();
        if halves.len() < LEAST {
            return None;
        }
        let profile: [f32; ACROSS] = std::array::from_fn(|j| {
            let mut all: Vec<f32> = halves.iter().map(|h| h[j]).collect();
            all.sort_by(f32::total_cmp);
            all[all.len() / 2]
        });
        let most = profile.iter().copied().fold(0.0, f32::max);
        let is_dark = |j: &usize| profile[*j] > DARK * most;
        let middle = ACROSS / 2;
        let first = (0..=middle)
            .rev()
            .take_while(|j| is_dark(j) || middle - j < 4)
            .last();
        let last = (middle..ACROSS)
            .take_while(|j| is_dark(j) || j - middle < 4)
            .last();
        let (first, last) = (
            first?.saturating_sub(BESIDE),
            (last? + BESIDE + 1).min(ACROSS),
        );
        let sum = profile[first..last].iter().sum();
        let mut walls = Walls {
            profile,
            band: first..last,
            sum,
            near: 0.0,
        };
        let mut all: Vec<f64> = patches.iter().map(|p| walls.distance(p)).collect();
        all.sort_by(f64::total_cmp);
        let near = TIMES * all[all.len() / 2] + BESIDES;
        walls.near = near.clamp(BOUNDS[0], BOUNDS[1]);
        Some(walls)
    }

    /// How unlike the walls a unit is: beyond 1 it is none of them.
    pub(super) fn unlike(&self, patch: &Patch) -> f64 {
        self.distance(patch) / self.near
    }

    /// How much darker or lighter a unit is than the walls, in shares of them.
    fn distance(&self, patch: &Patch) -> f64 {
        let half = |profile: &[f32; ACROSS]| {
            let by = |shift: i64| {
                let at = |j: usize| {
                    usize::try_from(j as i64 + shift)
                        .ok()
                        .and_then(|k| profile.get(k))
                        .copied()
                        .unwrap_or(0.0)
                };
                self.band
                    .clone()
                    .map(|j| (at(j) - self.profile[j]).abs())
                    .sum::<f32>()
            };
            (-SWAY..=SWAY).map(by).fold(f32::INFINITY, f32::min)
        };
        let halves = patch.profiles.each_ref().map(half);
        f64::from((halves[0] + halves[1]) / 2.0 / self.sum.max(1.0))
    }
}
