//! The ink round a unit of the grid, and the posts at its ends.

use super::super::grid::{Grid, dark_at, level_at};
use super::super::sheet::Ink;
use super::blank::DarkBlocks;
use super::nib::quantile;
use super::tones::{ALONG, Tones, tone};
use glam::DVec2;
use std::sync::LazyLock;

/// Samples across it.
pub(super) const ACROSS: usize = 45;
/// How far to its sides is looked, units.
pub(super) const REACH: f64 = 0.3;
/// The share of a unit at its ends that posts and other walls cover.
pub(super) const END: f64 = 0.14;
/// How far from the end of a unit leaves may hang, and the shortest leaf that is looked for there, units: they hang at posts.
const HINGES: [f64; 4] = [0.0, 0.04, 0.08, 0.12];
const LEAVES: [f64; 4] = [0.82, 0.82, 0.82, 0.7];
/// Room of leaves beyond the ends of a unit and on each side of it, units.
const LEAF_ROOM: [f64; 2] = [0.25, 1.2];
/// Darkness below which a sample is paper, and the least darkness of full ink, both in multiples of the threshold of the sheet.
const FAINT: f64 = 0.35;
const FULL: f64 = 2.05;
/// The share of the ink of a sheet that is no darker than full ink.
const DARK: f64 = 0.95;
/// The power of its share of full ink that a stroke counts: by the share itself faint strokes would be nothing beside walls, and
/// if all ink counted alike, blurred strokes beside each other would be a bar.
const POWER: f64 = 0.7;
/// The number of steps in the table of weights.
const STEPS: usize = 4096;
/// Samples to each side over which ink is spread, so that strokes a hair beside each other still agree.
const SOFT: usize = 1;
/// How far from the line of the grid a stroke may lie whose sway is measured, units.
const NEAR: f64 = 0.2;
/// How far from the line of the grid a wall drawn by hand may run, units.
const SWAY: f64 = 0.06;

/// Ink by place: row by row across, from the right side of the unit's direction to the left.
#[derive(Clone)]
pub(super) struct Patch {
    pub(super) black: Tones,
    pub(super) red: Tones,
    /// Ink of both colours.
    pub(super) ink: Vec<i16>,
    /// Their sums: without nothing, without the beginning, without the end, without both.
    pub(super) blacks: [u32; 4],
    pub(super) reds: [u32; 4],
    /// Whether there is red ink in it.
    pub(super) is_red: bool,
    /// The share of ink on the quarter circles about its ends: the way of a leaf.
    pub(super) arc: f64,
    /// The share of ink on a stroke that leaves one of its ends aslant: a leaf that stands open.
    pub(super) leaf: f64,
    /// Whether there is more in it than specks.
    pub(super) is_inked: bool,
    /// How dark each half of it is across, from right to left, 0 to 255: the middle of all samples along the half.
    pub(super) profiles: [[f32; ACROSS]; 2],
}

/// A sheet whose units are sampled.
pub(super) struct InkSheet<'i> {
    /// The ink of walls.
    ink: &'i Ink,
    /// All ink, with what slants.
    all: &'i Ink,
    /// The darkness of full ink, 0 to 255.
    full: f64,
    ink_blocks: DarkBlocks,
    all_blocks: DarkBlocks,
}

impl<'i> InkSheet<'i> {
    /// Prepares a sheet from the ink of its walls and all its ink.
    pub(super) fn new(ink: &'i Ink, all: &'i Ink) -> InkSheet<'i> {
        InkSheet {
            ink,
            all,
            full: full(ink),
            ink_blocks: DarkBlocks::of(&ink.dark),
            all_blocks: DarkBlocks::of(&all.dark),
        }
    }

    /// Returns how clearly a post is at a crossing, 0 to 1.
    pub(super) fn post(&self, grid: &Grid, at: DVec2) -> f64 {
        let around = [at - DVec2::splat(POST_ROOM), at + DVec2::splat(POST_ROOM)];
        match self.all_blocks.is_blank(grid, around, self.all.threshold) {
            true => 0.0,
            false => post(self.all, grid, at.x, at.y),
        }
    }
}

/// Ink as it was sampled, before strokes that sway are straightened.
#[derive(Clone)]
pub(super) struct Raw {
    black: Vec<f32>,
    red: Vec<f32>,
    profiles: [[f32; ACROSS]; 2],
    arc: f64,
    leaf: f64,
}

/// How dark full ink is on a sheet, 0 to 255: walls are as dark as anything on it.
fn full(ink: &Ink) -> f64 {
    let mut counts = [0_u32; 256];
    for pixel in ink.dark.pixels().filter(|p| p[0] > ink.threshold) {
        counts[usize::from(pixel[0])] += 1;
    }
    quantile(&counts, DARK).max(f64::from(ink.threshold) * FULL)
}

/// Weights of shares in equal steps from 0 to 1, and one more for interpolation. A power for each sample would be slow.
static WEIGHTS: LazyLock<[f64; STEPS + 2]> = LazyLock::new(|| {
    std::array::from_fn(|step| libm::pow(step as f64 / STEPS as f64, POWER).min(1.0))
});

/// The weight of a sample that has this share of the darkness of full ink; both are 0 to 1.
pub(super) fn weight(share: f64) -> f64 {
    let at = share.clamp(0.0, 1.0) * STEPS as f64;
    let step = at as usize;
    let [low, high] = [WEIGHTS[step], WEIGHTS[step + 1]];
    low + (high - low) * (at - step as f64)
}

impl Raw {
    /// Samples the ink of a unit that begins at a crossing.
    pub(super) fn of(sheet: &InkSheet<'_>, grid: &Grid, from: DVec2, upright: bool) -> Raw {
        let InkSheet { ink, all, .. } = *sheet;
        let turned = |along: f64, across: f64| match upright {
            false => from + DVec2::new(along, across),
            true => from + DVec2::new(across, along),
        };
        let around =
            |[along, across]: [f64; 2]| [turned(-along, -across), turned(1.0 + along, across)];
        let place = |along: f64, across: f64| match upright {
            false => grid.at(from.x + along, from.y + across),
            true => grid.at(from.x + across, from.y + along),
        };
        let zeros = || vec![0.0; ALONG * ACROSS];
        let (black, red, tone) = match sheet.ink_blocks.is_blank(grid, around([0.0, REACH]), 0) {
            true => (zeros(), zeros(), zeros()),
            false => sampled(ink, sheet.full, &place),
        };
        let has_no_leaf = sheet
            .all_blocks
            .is_blank(grid, around(LEAF_ROOM), all.threshold);
        let (arc, leaf) = match has_no_leaf {
            true => (0.0, 0.0),
            false => (arc(all, &place), leaf(all, &place)),
        };
        Raw {
            black,
            red,
            profiles: profiles(&tone),
            arc,
            leaf,
        }
    }
}

impl Raw {
    /// How far the middle of its ink moves from one half of the unit to the other, units; none without a stroke through both.
    pub(super) fn sway(&self) -> Option<f64> {
        let middle = |columns: std::ops::Range<usize>| {
            let (mut sum, mut moment) = (0.0, 0.0);
            for j in (0..ACROSS).filter(|j| across(*j).abs() < NEAR) {
                for k in columns.clone().map(|i| j * ALONG + i) {
                    let ink = f64::from(self.black[k] + self.red[k]);
                    (sum, moment) = (sum + ink, moment + ink * across(j));
                }
            }
            (sum > columns.len() as f64).then(|| moment / sum)
        };
        let (skip, half) = (skip() + 1, ALONG / 2);
        Some((middle(skip..half)? - middle(half..ALONG - skip)?).abs())
    }
}

impl Patch {
    /// `reach` is how far from the lines of the grid strokes lie that are drawn by hand and sway about them.
    pub(super) fn of(raw: &Raw, reach: Option<f64>) -> Patch {
        let (mut black, mut red) = (raw.black.clone(), raw.red.clone());
        let (arc, leaf) = (raw.arc, raw.leaf);
        if let Some(reach) = reach {
            straighten(&mut black, &mut red, reach);
        }
        let skip = skip();
        let middle = |ink: &[f32]| {
            (0..ACROSS)
                .map(|j| {
                    ink[j * ALONG + skip..(j + 1) * ALONG - skip]
                        .iter()
                        .sum::<f32>()
                })
                .sum::<f32>()
        };
        let (blacks, reds) = (middle(&black), middle(&red));
        let is_inked = blacks + reds > 3.0 || arc > 0.5 || leaf > 0.5;
        let tones = |ink: &[f32]| soft(ink, ALONG).into_iter().map(tone).collect::<Vec<u8>>();
        let (black, red) = (tones(&black), tones(&red));
        let both = |(a, b): (&u8, &u8)| i16::from(*a) + i16::from(*b);
        Patch {
            ink: black.iter().zip(&red).map(both).collect(),
            blacks: sums(&black),
            reds: sums(&red),
            black: Tones::new(black),
            red: Tones::new(red),
            is_red: reds > 3.0,
            arc,
            leaf,
            is_inked,
            profiles: raw.profiles,
        }
    }
}

impl Patch {
    /// How thick a stroke along all of it would have so much ink, units.
    pub(super) fn thickness(&self) -> f64 {
        let ink = f64::from(self.blacks[3] + self.reds[3]) / 255.0;
        let (columns, step) = (ALONG - 2 * skip(), 2.0 * REACH / ACROSS as f64);
        ink / columns as f64 * step
    }
}

/// How dark each half of a unit is across: what crosses it does not count.
fn profiles(tone: &[f32]) -> [[f32; ACROSS]; 2] {
    let (skip, half) = (skip(), ALONG / 2);
    [skip..half, half..ALONG - skip].map(|columns| {
        std::array::from_fn(|j| {
            let row = &tone[j * ALONG..(j + 1) * ALONG];
            let mut row = row[columns.clone()].to_vec();
            row.sort_by(f32::total_cmp);
            row[row.len() / 2]
        })
    })
}

/// Black and red ink on a unit, and how dark it is, four samples to a place.
fn sampled(
    ink: &Ink,
    full: f64,
    place: &dyn Fn(f64, f64) -> DVec2,
) -> (Vec<f32>, Vec<f32>, Vec<f32>) {
    let mut black = vec![0.0; ALONG * ACROSS];
    let mut red = vec![0.0; ALONG * ACROSS];
    let mut tone = vec![0.0; ALONG * ACROSS];
    let faint = f64::from(ink.threshold) * FAINT;
    // Red ink is never as dark as walls.
    let full_red = f64::from(ink.threshold) * (FULL - FAINT) / 2.0;
    for (j, i) in (0..ACROSS).flat_map(|j| (0..ALONG).map(move |i| (j, i))) {
        let (mut dark, mut colour) = (0.0, 0.0);
        for (a, b) in [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)] {
            let at = place(
                (i as f64 + a) / ALONG as f64,
                ((j as f64 + b) / ACROSS as f64 * 2.0 - 1.0) * REACH,
            );
            dark += f64::from(dark_at(ink, at)) / 4.0;
            colour += f64::from(level_at(&ink.red, at)) / 4.0;
        }
        let share = weight(((dark - faint) / (full - faint)).clamp(0.0, 1.0));
        let of_red = (colour / full_red).clamp(0.0, 1.0).min(share);
        black[j * ALONG + i] = (share - of_red) as f32;
        red[j * ALONG + i] = of_red as f32;
        tone[j * ALONG + i] = dark as f32;
    }
    (black, red, tone)
}

fn sums(ink: &[u8]) -> [u32; 4] {
    std::array::from_fn(|ends| {
        let from = if ends & 1 == 1 { skip() } else { 0 };
        let to = if ends & 2 == 2 { ALONG - skip() } else { ALONG };
        (0..ACROSS)
            .flat_map(|j| &ink[j * ALONG + from..j * ALONG + to])
            .map(|d| u32::from(*d))
            .sum()
    })
}

/// Samples at each end that tell nothing of a unit.
pub(super) fn skip() -> usize {
    (END * ALONG as f64).round() as usize
}

/// How far sample `j` lies across, units.
pub(super) fn across(j: usize) -> f64 {
    ((j as f64 + 0.5) / ACROSS as f64 * 2.0 - 1.0) * REACH
}

/// Moves the columns of a patch so that the middle of its strokes lies on the line of the grid; strokes farther than `reach` from
/// it are others.
fn straighten(black: &mut [f32], red: &mut [f32], reach: f64) {
    let is_near = |j: usize| across(j).abs() < reach;
    // For each column its ink, and its ink by place.
    let sums: Vec<[f64; 2]> = (0..ALONG)
        .map(|i| {
            let near = (0..ACROSS).filter(|j| is_near(*j)).map(|j| {
                (
                    j as f64,
                    f64::from(black[j * ALONG + i] + red[j * ALONG + i]),
                )
            });
            near.fold([0.0, 0.0], |[ink, weighed], (j, d)| {
                [ink + d, weighed + d * j]
            })
        })
        .collect();
    let middle = (ACROSS / 2) as f64;
    let skip = skip();
    let shifts: Vec<i64> = (0..ALONG)
        .map(|i| {
            // A few columns together, so that ticks and gaps do not jerk; the ends belong to posts.
            let at = i.clamp(skip, ALONG - 1 - skip);
            let near = &sums[at.saturating_sub(4).max(skip)..(at + 5).min(ALONG - skip)];
            let (ink, weighed) = near
                .iter()
                .fold((0.0, 0.0), |(a, b), [c, d]| (a + c, b + d));
            if ink < 1.0 {
                0
            } else {
                (weighed / ink - middle).round() as i64
            }
        })
        .collect();
    let most = (SWAY / REACH * ACROSS as f64 / 2.0).round() as i64;
    for values in [black, red] {
        let old = values.to_vec();
        for (i, shift) in shifts.iter().enumerate() {
            for j in 0..ACROSS {
                let from = j as i64 + (*shift).clamp(-most, most);
                let inside = from >= 0 && from < ACROSS as i64;
                values[j * ALONG + i] = if inside {
                    old[from as usize * ALONG + i]
                } else {
                    0.0
                };
            }
        }
    }
}

/// The best share of ink along a quarter circle about one of the ends, on one of the sides.
fn arc(ink: &Ink, place: &dyn Fn(f64, f64) -> DVec2) -> f64 {
    let mut most = 0.0_f64;
    let directions: [(f64, f64); 18] = std::array::from_fn(|k| {
        let angle = (14.0 + 62.0 * k as f64 / 17.0_f64).to_radians();
        (libm::cos(angle), libm::sin(angle))
    });
    let ways = |k: usize| [(HINGES[k], 1.0), (1.0 - HINGES[k], -1.0)];
    for (k, (hinge, way)) in (0..HINGES.len()).flat_map(|k| ways(k).map(|w| (k, w))) {
        for (side, step) in [-1.0, 1.0]
            .into_iter()
            .flat_map(|side| (0..8).map(move |step| (side, step)))
        {
            let radius = LEAVES[k] + 0.025 * f64::from(step);
            let seen = directions.iter().filter(|(along, across)| {
                let is_dark = |r: f64| {
                    dark_at(ink, place(hinge + way * r * along, side * r * across)) > ink.threshold
                };
                is_dark(radius) || is_dark(radius - 0.015) || is_dark(radius + 0.015)
            });
            most = most.max(seen.count() as f64 / 18.0);
        }
    }
    most
}

/// The best share of ink on a stroke that leaves one of the ends aslant, ends within the unit's length, and has paper beside it.
fn leaf(ink: &Ink, place: &dyn Fn(f64, f64) -> DVec2) -> f64 {
    let mut most = 0.0_f64;
    for (hinge, way, side) in [
        (0.0, 1.0, -1.0),
        (0.0, 1.0, 1.0),
        (1.0, -1.0, -1.0),
        (1.0, -1.0, 1.0),
    ] {
        let at = |angle: f64, r: f64| {
            let (along, across) = (libm::cos(angle.to_radians()), libm::sin(angle.to_radians()));
            dark_at(ink, place(hinge + way * r * along, side * r * across)) > ink.threshold
        };
        let share = |angle: f64, low: f64, high: f64| {
            (0..12)
                .filter(|k| at(angle, low + (high - low) * f64::from(*k) / 11.0))
                .count() as f64
                / 12.0
        };
        for angle in (0..=20).map(|k| 22.0 + 2.5 * f64::from(k)) {
            let stroke = share(angle, 0.2, 0.58);
            if stroke > 0.6 && stroke > most {
                let beside = share(angle - 14.0, 0.3, 0.6).max(share(angle + 14.0, 0.3, 0.6));
                // Hatching and the lines across closets run on.
                let beyond = [-3.0, 0.0, 3.0]
                    .into_iter()
                    .map(|a| share(angle + a, 0.98, 1.2))
                    .fold(0.0, f64::max);
                most = most.max(stroke - beside.max(beyond) * 0.8);
            }
        }
    }
    most
}

/// How far about a crossing its post is looked for, units.
const POST: f64 = 0.05;
/// Distance from a crossing on each axis that the outlines of posts reach, units.
const POST_ROOM: f64 = 0.25;

/// How clearly a post stands at a crossing, 0 to 1: a filled one, or the outline of one.
fn post(ink: &Ink, grid: &Grid, u: f64, v: f64) -> f64 {
    let dark = |x: f64, y: f64| dark_at(ink, grid.at(u + x, v + y)) > ink.threshold;
    let disc: Vec<(f64, f64)> = (0..81)
        .map(|k| (f64::from(k % 9) / 4.0 - 1.0, f64::from(k / 9) / 4.0 - 1.0))
        .filter(|(x, y)| x * x + y * y <= 1.01)
        .collect();
    let mut most = 0.0_f64;
    for (dx, dy) in (0..9).map(|k| (f64::from(k % 3 - 1) * 0.02, f64::from(k / 3 - 1) * 0.02)) {
        let filled = disc
            .iter()
            .filter(|(x, y)| dark(dx + x * POST, dy + y * POST))
            .count() as f64
            / disc.len() as f64;
        most = most.max(filled);
        for half in (0..7).map(|k| 0.06 + 0.01 * f64::from(k)) {
            let side = |x: f64, y: f64, along: (f64, f64)| {
                (0..9)
                    .filter(|k| {
                        let t = half * 0.85 * (f64::from(*k) / 4.0 - 1.0);
                        dark(dx + x + t * along.0, dy + y + t * along.1)
                    })
                    .count() as f64
                    / 9.0
            };
            let ring = side(-half, 0.0, (0.0, 1.0))
                .min(side(half, 0.0, (0.0, 1.0)))
                .min(side(0.0, -half, (1.0, 0.0)))
                .min(side(0.0, half, (1.0, 0.0)));
            most = most.max(ring * 0.9);
        }
    }
    ((most - 0.5) / 0.35).clamp(0.0, 1.0)
}

/// Values spread a little across.
pub(super) fn soft(values: &[f32], along: usize) -> Vec<f32> {
    let across = values.len() / along;
    let mut out = vec![0.0; values.len()];
    for (j, to) in out.chunks_exact_mut(along).enumerate() {
        for k in j.saturating_sub(SOFT)..=(j + SOFT).min(across - 1) {
            let weight = (SOFT + 1 - k.abs_diff(j)) as f32 / ((SOFT + 1) * (SOFT + 1)) as f32;
            let pairs = to.iter_mut().zip(&values[k * along..(k + 1) * along]);
            pairs.for_each(|(value, from)| *value += weight * from);
        }
    }
    out
}
