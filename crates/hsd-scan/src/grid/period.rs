//! How long a unit is and where its lines run, told by sums of ink along the sheet.

use super::super::sheet::Ink;
use glam::{DVec2, dvec2};

/// The shortest unit that is looked for, pixels.
const SHORTEST: f64 = 11.0;
/// The share by which one unit that is tried is longer than the one before.
const STEP: f64 = 1.003;
/// The same, where a unit is known already.
const FINE: f64 = 0.001;
/// The fewest units along the shorter side of a sheet.
const FEWEST: f64 = 5.0;
/// What is on a line of the grid at the edge of a house, beside what is on the strongest one.
const LEAST_LINE: f64 = 0.04;
/// Places of a line within a unit that are tried.
const SLOTS: usize = 60;
/// Places to each side that still count as on the line: an eighth of a unit.
const REACH: i32 = 7;

/// What tells of one direction's lines, by the place across them.
pub(super) type Sums = Vec<f64>;

/// The ink of strokes that run along the sheet, summed along each line of pixels.
pub(super) struct Strokes {
    /// Level strokes, by their y.
    pub(super) level: Sums,
    /// Upright strokes, by their x.
    pub(super) upright: Sums,
    /// What tells of the units to the right and down: strokes; changes along those that cross (posts, ends of doors); thick ink.
    told: [[Sums; 3]; 2],
}

impl Strokes {
    /// Strokes of a length or more.
    pub(super) fn of(ink: &Ink, least: f64, thick: &[Sums; 2]) -> Strokes {
        let (width, height) = ink.dark.dimensions();
        let level = sums(height, width, least, |line, at| ink.is(at, line));
        let upright = sums(width, height, least, |line, at| ink.is(line, at));
        let across = joints(&level, width, |line, at| ink.is(at, line));
        let down = joints(&upright, height, |line, at| ink.is(line, at));
        let told = [
            [upright.clone(), across, thick[0].clone()],
            [level.clone(), down, thick[1].clone()],
        ];
        Strokes {
            level,
            upright,
            told,
        }
    }
}

/// The thickness of ink by x and by y: posts and walls tell of the grid, mats, boards and writing are thin.
///
/// The cube of the distance to paper, of which the root is taken so that one black area does not outweigh all posts.
pub(super) fn thick(ink: &Ink) -> [Sums; 2] {
    let (width, height) = ink.dark.dimensions();
    let (w, h) = (width as usize, height as usize);
    let mut depth = vec![0_u8; w * h];
    // Distances over the eight neighbours, from above and then from below.
    for y in 1..h {
        for x in 1..w.max(1) - 1 {
            if ink.is(x as u32, y as u32) {
                let k = y * w + x;
                let above = depth[k - w - 1].min(depth[k - w]).min(depth[k - w + 1]);
                depth[k] = depth[k - 1].min(above).saturating_add(1);
            }
        }
    }
    let mut out = [vec![0.0; w], vec![0.0; h]];
    for y in (0..h.max(1) - 1).rev() {
        for x in (1..w.max(1) - 1).rev() {
            let k = y * w + x;
            if depth[k] > 0 {
                let below = depth[k + w - 1].min(depth[k + w]).min(depth[k + w + 1]);
                depth[k] = depth[k].min(depth[k + 1].min(below).saturating_add(1));
                let d = f64::from(depth[k]);
                out[0][x] += d * d * d;
                out[1][y] += d * d * d;
            }
        }
    }
    out.map(|sums| sums.into_iter().map(libm::sqrt).collect())
}

/// How much the ink along the strongest lines changes, place by place along them.
fn joints(sums: &[f64], length: u32, is: impl Fn(u32, u32) -> bool) -> Vec<f64> {
    let most = sums.iter().copied().fold(0.0, f64::max);
    let reach = (sums.len() / 250).max(2);
    let mut out = vec![0.0; length as usize];
    for line in 0..sums.len() {
        let near = line.saturating_sub(reach)..(line + reach + 1).min(sums.len());
        let is_peak =
            sums[line] > 0.2 * most && sums[near.clone()].iter().all(|s| *s <= sums[line]);
        if !is_peak {
            continue;
        }
        let count = |at: u32| near.clone().filter(|l| is(*l as u32, at)).count() as f64;
        let mut before = count(0);
        for at in 1..length {
            let now = count(at);
            // A change of one pixel is noise.
            out[at as usize] += ((now - before).abs() - 1.0).max(0.0);
            before = now;
        }
    }
    out
}

/// For each line of pixels how many belong to runs of a length; a run may lie a pixel beside its line, since no sheet is quite straight.
fn sums(lines: u32, length: u32, least: f64, is: impl Fn(u32, u32) -> bool) -> Vec<f64> {
    (0..lines)
        .map(|line| {
            let near = |at: u32| {
                is(line, at)
                    || (line > 0 && is(line - 1, at))
                    || (line + 1 < lines && is(line + 1, at))
            };
            let (mut sum, mut from, mut own) = (0.0, 0, 0_u32);
            for at in 0..=length {
                if at < length && near(at) {
                    own += u32::from(is(line, at));
                    continue;
                }
                if f64::from(at - from) >= least {
                    sum += f64::from(own);
                }
                (from, own) = (at + 1, 0);
            }
            sum
        })
        .collect()
}

/// How well sums keep to a period: the share of them that is in phase, at most 1.
pub(super) fn in_phase(sums: &[f64], period: f64) -> f64 {
    let angle = std::f64::consts::TAU / period;
    let turned = |at: f64| dvec2(libm::cos(at * angle), libm::sin(at * angle));
    let (mut now, step) = (turned(0.5), turned(1.0));
    let (mut all, mut sum) = (0.0, DVec2::ZERO);
    for s in sums {
        sum += now * *s;
        all += s;
        now = now.rotate(step);
    }
    if all > 0.0 {
        libm::sqrt(sum.length_squared()) / all
    } else {
        0.0
    }
}

/// How well a multiple of what fits best has to fit beside it to be the unit.
///
/// Walls on every second line alone are not rare, on every third and fourth they are; the thickness of walls may be a third of a
/// unit, and boards are four to one.
fn nearly(multiple: u32) -> f64 {
    match multiple {
        2 => 0.94,
        3 => 0.85,
        _ => 0.8,
    }
}

/// How well a multiple has to fit each of both directions beside what fits best.
const ONE_WAY: f64 = 0.7;
/// How well half of what fits best has to fit, and how much better in one direction, to be the unit: all walls of the other may stand
/// on every second line.
const HALF: f64 = 0.9;
const CLEARLY: f64 = 1.1;

/// The units to the right and down that the strokes keep to best; the two differ by at most a share.
///
/// Parts of a unit fit as well as the unit where mats and boards are drawn: of what fits best the greatest multiple is
/// taken that fits nearly as well. Multiples of the unit do not, since posts and the ends of doors stand on every line.
pub(super) fn period(strokes: &Strokes, aspect: f64) -> Option<[f64; 2]> {
    let longest = strokes.level.len().min(strokes.upright.len()) as f64 / FEWEST;
    let mut periods = vec![SHORTEST];
    while periods.last().is_some_and(|p| p * STEP <= longest) {
        periods.push(periods[periods.len() - 1] * STEP);
    }
    let [across, down] = [0, 1].map(|axis| {
        let told = &strokes.told[axis];
        let shares: Vec<[f64; 3]> = periods
            .iter()
            .map(|p| [0, 1, 2].map(|k| in_phase(&told[k], *p)))
            .collect();
        let best = [0, 1, 2].map(|k| shares.iter().map(|s| s[k]).fold(1e-9, f64::max));
        shares
            .iter()
            .map(|s| (0..3).map(|k| s[k] / best[k]).sum())
            .collect::<Vec<f64>>()
    });
    let reach = (aspect / (STEP - 1.0)).ceil() as usize;
    let pair = |k: usize| {
        let near = k.saturating_sub(reach)..(k + reach + 1).min(periods.len());
        let other = near.max_by(|a, b| down[*a].total_cmp(&down[*b]))?;
        Some((across[k] + down[other], other))
    };
    let pairs: Vec<(f64, usize)> = (0..periods.len()).map(pair).collect::<Option<_>>()?;
    let better = |a: &usize, b: &usize| pairs[*a].0.total_cmp(&pairs[*b].0);
    let best = (0..pairs.len()).max_by(better)?;
    let near = |times: f64| {
        let middle =
            best.checked_add_signed((libm::log(times) / libm::log(STEP)).round() as isize)?;
        (middle.saturating_sub(6)..(middle + 7).min(pairs.len())).max_by(better)
    };
    // A narrow house has so few lines of one direction that every multiple may fit there, so both count.
    let shares = |k: usize| {
        let (other, best_other) = (pairs[k].1, pairs[best].1);
        [across[k] / across[best], down[other] / down[best_other]]
    };
    let fits = |k: &usize, share: f64| {
        pairs[*k].0 >= share * pairs[best].0 && shares(*k).iter().all(|s| *s >= ONE_WAY)
    };
    let multiple = |n: u32| near(f64::from(n)).filter(|k| fits(k, nearly(n)));
    let is_better_one_way = |k: &usize| shares(*k).iter().any(|s| *s >= CLEARLY);
    let half = || near(0.5).filter(|k| fits(k, HALF) && is_better_one_way(k));
    let peak = (2..=4).rev().find_map(multiple).or_else(half);
    let peak = peak.unwrap_or(best);
    Some([periods[peak], periods[pairs[peak].1]])
}

/// The units to the right and down nearest to some that are known to a share, and where the first line of each lies.
///
/// Counted is what lies on lines: what lies between them may be boards, mats and dimensions. The two units differ by at most
/// `aspect`.
pub(super) fn near(strokes: &Strokes, known: [f64; 2], share: f64, aspect: f64) -> [(f64, f64); 2] {
    let steps = (share / FINE).ceil() as i32;
    let tried = [0, 1].map(|axis| {
        let sums = together(&strokes.told[axis]);
        let periods = (-steps..=steps).map(|k| known[axis] * (1.0 + f64::from(k) * FINE));
        periods.map(|p| (p, on_lines(&sums, p))).collect::<Vec<_>>()
    });
    let mut found = (0.0, known.map(|p| (p, 0.0)));
    for (x, (a, from_x)) in &tried[0] {
        for (y, (b, from_y)) in &tried[1] {
            if a + b > found.0 && (y / x - 1.0).abs() <= aspect {
                found = (a + b, [(*x, *from_x), (*y, *from_y)]);
            }
        }
    }
    found.1
}

/// All that tells of one axis, each with the same weight.
fn together(told: &[Sums; 3]) -> Sums {
    let all = told
        .each_ref()
        .map(|sums| sums.iter().sum::<f64>().max(1e-9));
    (0..told[0].len())
        .map(|k| (0..3).map(|t| told[t][k] / all[t]).sum())
        .collect()
}

/// How much lies on lines of a period, at the best place of the first line.
fn on_lines(sums: &[f64], period: f64) -> (f64, f64) {
    let mut slots = [0.0; SLOTS];
    for (k, s) in sums.iter().enumerate() {
        let at = (k as f64 + 0.5) / period;
        slots[((at - at.floor()) * SLOTS as f64) as usize % SLOTS] += s;
    }
    // The nearer to the line the more it counts.
    let weight = |slot: usize| {
        let sum = |k: i32| {
            f64::from(REACH + 1 - k.abs())
                * slots[(slot as i32 + k).rem_euclid(SLOTS as i32) as usize]
        };
        (-REACH..=REACH).map(sum).sum::<f64>() / f64::from(REACH + 1)
    };
    let best = (0..SLOTS)
        .map(|slot| (slot, weight(slot)))
        .max_by(|a, b| a.1.total_cmp(&b.1));
    best.map_or((0.0, 0.0), |(slot, sum)| {
        (sum, (slot as f64 + 0.5) / SLOTS as f64 * period)
    })
}

/// The first and the last line of a grid with strokes or posts on it, and two more.
pub(super) fn extent(
    strokes: &[f64],
    thick: &[f64],
    phase: f64,
    period: f64,
) -> Option<(i32, i32)> {
    let lines = |sums: &[f64]| {
        let mut lines = std::collections::BTreeMap::new();
        for (k, s) in sums.iter().enumerate() {
            let at = (k as f64 + 0.5 - phase) / period;
            if (at - at.round()).abs() < 0.25 {
                *lines.entry(at.round() as i32).or_insert(0.0) += s;
            }
        }
        let most = lines.values().copied().fold(0.0, f64::max);
        lines.retain(|_, s| *s > LEAST_LINE * most);
        lines
    };
    let (strokes, thick) = (lines(strokes), lines(thick));
    let first = strokes.keys().chain(thick.keys()).min()?;
    let last = strokes.keys().chain(thick.keys()).max()?;
    Some((first - 2, last + 2))
}
