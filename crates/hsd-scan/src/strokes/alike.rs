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

/// From which share of the darkest on a place is the core of a wall.
const CORE: f32 = 0.85;
/// The share of it at each edge that does not count: a brush is not equally wide everywhere.
const CORE_EDGE: f64 = 0.2;
/// How much paler its core may be, in the same way.
const CORE_TIMES: f64 = 2.0;
const CORE_BESIDES: f64 = 0.08;
const CORE_BOUNDS: [f64; 2] = [0.12, 0.3];

/// How a sheet draws its walls, across.
pub(super) struct Walls {
    profile: [f32; ACROSS],
    band: std::ops::Range<usize>,
    sum: f32,
    /// Where walls are darkest: blurred lines beside each other are never so dark there, whatever lies beside the wall.
    core: Vec<usize>,
    /// The distances of the whole and of the core from which on a unit is unlike.
    near: [f64; 2],
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
        let core: Vec<usize> = (first..last)
            .filter(|j| profile[*j] >= CORE * most)
            .collect();
        let cut = (core.len() as f64 * CORE_EDGE) as usize;
        let core = core[cut..core.len() - cut].iter().copied();
        let mut walls = Walls {
            profile,
            core: core.collect(),
            band: first..last,
            sum,
            near: [0.0; 2],
        };
        let distances: Vec<[f64; 2]> = patches.iter().map(|p| walls.distances(p)).collect();
        let median = |k: usize| {
            let mut all: Vec<f64> = distances.iter().map(|d| d[k]).collect();
            all.sort_by(f64::total_cmp);
            all[all.len() / 2]
        };
        walls.near = [
            (TIMES * median(0) + BESIDES).clamp(BOUNDS[0], BOUNDS[1]),
            (CORE_TIMES * median(1) + CORE_BESIDES).clamp(CORE_BOUNDS[0], CORE_BOUNDS[1]),
        ];
        Some(walls)
    }

    /// How unlike the walls a unit is: beyond 1 it is none of them.
    pub(super) fn unlike(&self, patch: &Patch) -> f64 {
        let [whole, core] = self.distances(patch);
        (whole / self.near[0]).max(core / self.near[1])
    }

    /// How much darker or lighter a unit is than the walls, and how much paler in their core, in shares of them.
    fn distances(&self, patch: &Patch) -> [f64; 2] {
        let halves = patch.profiles.each_ref().map(|half| {
            let all = (-SWAY..=SWAY).map(|shift| self.differences(half, shift));
            all.fold([f32::INFINITY; 2], |a, b| [a[0].min(b[0]), a[1].min(b[1])])
        });
        [0, 1].map(|k| f64::from((halves[0][k] + halves[1][k]) / 2.0))
    }

    /// The same two differences for half a unit, after moving its profile sideways by `shift` samples.
    fn differences(&self, profile: &[f32; ACROSS], shift: i64) -> [f32; 2] {
        let at = |j: usize| {
            let k = usize::try_from(j as i64 + shift).ok();
            k.and_then(|k| profile.get(k)).copied().unwrap_or(0.0)
        };
        let whole = self.band.clone().map(|j| (at(j) - self.profile[j]).abs());
        let core = self
            .core
            .iter()
            .map(|j| (self.profile[*j] - at(*j)).max(0.0));
        let of_core: f32 = self.core.iter().map(|j| self.profile[*j]).sum();
        [
            whole.sum::<f32>() / self.sum.max(1.0),
            core.sum::<f32>() / of_core.max(1.0),
        ]
    }
}
