//! The grid of half ken that a plan keeps to: how long a unit is on the sheet, and where its lines run.

use super::sheet::Ink;
use glam::{DMat3, DVec2, dvec2};

/// The shortest unit that is looked for, pixels.
const SHORTEST: f64 = 11.0;
/// A unit is believed if the strokes keep to it nearly as well as to the best one.
const NEARLY: f64 = 0.8;
/// What joints count beside strokes.
const JOINTS: f64 = 1.2;

/// Where units are on a sheet.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    /// Takes units, to the right and down from a crossing of the grid, to pixels of the sheet.
    pub to_sheet: DMat3,
    /// Units that strokes cover, to the right: the first and the last line.
    pub across: (i32, i32),
    /// The same, downwards.
    pub down: (i32, i32),
    /// How well the strokes keep to it: 1 is perfect, strokes anywhere reach about 0.2.
    pub fit: f64,
    /// The length of a unit, pixels.
    pub unit: f64,
    /// The middle distance of strokes from their lines, units.
    pub residual: f64,
}

impl Grid {
    /// Pixels of a place in units.
    pub fn at(&self, u: f64, v: f64) -> DVec2 {
        super::flatten::project(self.to_sheet, dvec2(u, v))
    }

    /// Units of a pixel of the sheet.
    pub fn units_of(&self, pixel: DVec2) -> DVec2 {
        super::flatten::project(self.to_sheet.inverse(), pixel)
    }

    /// Finds the grid that the strokes of a sheet keep to; `unit` is its length in pixels where it is known.
    ///
    /// `aspect` is how much the units along and across may differ: the proportions of a photographed sheet are guessed.
    pub fn find(ink: &Ink, unit: Option<f64>, aspect: f64) -> Option<Grid> {
        let size = f64::from(ink.dark.width().max(ink.dark.height()));
        let mut least = (size / 55.0).max(9.0);
        let mut strokes = Strokes::of(ink, least);
        let mut found = period(&strokes, unit, aspect)?;
        // Strokes of a unit's length are the walls; writing is shorter.
        for _ in 0..2 {
            least = 0.7 * found.0;
            strokes = Strokes::of(ink, least);
            found = period(&strokes, unit.or(Some(found.0)), aspect)?;
        }
        let (px, py, fit) = found;
        let origin = dvec2(phase(&strokes.upright, px), phase(&strokes.level, py));
        let mut grid = Grid {
            to_sheet: DMat3::from_translation(origin) * DMat3::from_diagonal(dvec2(px, py).extend(1.0)),
            across: extent(&strokes.upright, origin.x, px)?,
            down: extent(&strokes.level, origin.y, py)?,
            fit,
            unit: px,
            residual: 0.0,
        };
        for reach in [0.24, 0.16, 0.12] {
            grid.refine(ink, reach);
        }
        Some(grid)
    }

    /// Moves the lines onto the strokes near them: a projective map, by least squares.
    fn refine(&mut self, ink: &Ink, reach: f64) {
        let mut seen = Vec::new();
        let ((u0, u1), (v0, v1)) = (self.across, self.down);
        for k in u0..=u1 {
            for v in v0..v1 {
                let place = |offset: f64, along: f64| self.at(f64::from(k) + offset, f64::from(v) + along);
                if let Some(offset) = stroke_near(ink, self.unit, reach, place) {
                    let at = self.at(f64::from(k) + offset, f64::from(v) + 0.5);
                    seen.push(Seen { unit: dvec2(f64::from(k), f64::from(v) + 0.5), pixel: at.x, upright: true, off: offset });
                }
            }
        }
        for k in v0..=v1 {
            for u in u0..u1 {
                let place = |offset: f64, along: f64| self.at(f64::from(u) + along, f64::from(k) + offset);
                if let Some(offset) = stroke_near(ink, self.unit, reach, place) {
                    let at = self.at(f64::from(u) + 0.5, f64::from(k) + offset);
                    seen.push(Seen { unit: dvec2(f64::from(u) + 0.5, f64::from(k)), pixel: at.y, upright: false, off: offset });
                }
            }
        }
        let mut offs: Vec<f64> = seen.iter().map(|s| s.off.abs()).collect();
        if offs.len() < 12 {
            return;
        }
        let half = offs.len() / 2;
        self.residual = *offs.select_nth_unstable_by(half, f64::total_cmp).1;
        if let Some(map) = fitted(&seen, self.to_sheet) {
            self.to_sheet = map;
        }
    }
}

/// A stroke seen near a line of the grid.
struct Seen {
    unit: DVec2,
    /// Its place across the line, pixels.
    pixel: f64,
    /// Whether the line is upright.
    upright: bool,
    off: f64,
}

/// How far from a line of the grid the ink along one unit of it lies, in units: its middle, if it is a stroke.
fn stroke_near(ink: &Ink, unit: f64, reach: f64, place: impl Fn(f64, f64) -> DVec2) -> Option<f64> {
    let steps = ((reach * unit).ceil() as i32).max(2);
    let along = 12;
    let (mut sum, mut moment, mut most) = (0.0, 0.0, 0.0_f64);
    for k in -steps..=steps {
        let offset = f64::from(k) / f64::from(steps) * reach;
        let mut count = 0.0;
        for t in 0..along {
            let at = place(offset, 0.2 + 0.6 * (f64::from(t) + 0.5) / f64::from(along));
            count += f64::from(dark_at(ink, at)) / 255.0;
        }
        let share = count / f64::from(along);
        // What crosses the line is in every row; a stroke along it in some.
        let weight = if share > 0.35 { share } else { 0.0 };
        most = most.max(share);
        sum += weight;
        moment += weight * offset;
    }
    (most > 0.5).then(|| moment / sum)
}

/// The ink at the pixel nearest to a place; none outside.
pub fn dark_at(ink: &Ink, at: DVec2) -> u8 {
    let (x, y) = (at.x.floor(), at.y.floor());
    let inside = x >= 0.0 && y >= 0.0 && x < f64::from(ink.dark.width()) && y < f64::from(ink.dark.height());
    if inside { ink.dark.get_pixel(x as u32, y as u32)[0] } else { 0 }
}

/// The projective map that takes the units of strokes to their pixels, without the strokes farthest off.
fn fitted(seen: &[Seen], now: DMat3) -> Option<DMat3> {
    // Shifted and scaled to about one, so that the equations are well set.
    let middle = seen.iter().map(|s| s.unit).sum::<DVec2>() / seen.len() as f64;
    let centre = super::flatten::project(now, middle);
    let scale = seen.iter().map(|s| (s.unit - middle).abs().max_element()).fold(1.0, f64::max);
    let pixels = (now.x_axis.x.abs() + now.y_axis.y.abs()) / 2.0 * scale;
    let mut kept: Vec<&Seen> = seen.iter().collect();
    let mut map = now;
    for _ in 0..3 {
        let mut normal = [[0.0; 9]; 8];
        for s in &kept {
            let p = (s.unit - middle) / scale;
            let centre = if s.upright { centre.x } else { centre.y };
            let q = (s.pixel - centre) / pixels;
            let row = match s.upright {
                true => [p.x, p.y, 1.0, 0.0, 0.0, 0.0, -q * p.x, -q * p.y, q],
                false => [0.0, 0.0, 0.0, p.x, p.y, 1.0, -q * p.x, -q * p.y, q],
            };
            for i in 0..8 {
                for j in 0..9 {
                    normal[i][j] += row[i] * row[j];
                }
            }
        }
        // A little weight on no perspective, for sheets with strokes in one corner only.
        normal[6][6] += 1e-3 * kept.len() as f64;
        normal[7][7] += 1e-3 * kept.len() as f64;
        let h = solved(normal)?;
        let local = DMat3::from_cols_array(&[h[0], h[3], h[6], h[1], h[4], h[7], h[2], h[5], 1.0]);
        let out = DMat3::from_translation(centre) * DMat3::from_diagonal(DVec2::splat(pixels).extend(1.0));
        let into = DMat3::from_diagonal(DVec2::splat(1.0 / scale).extend(1.0)) * DMat3::from_translation(-middle);
        map = out * local * into;
        let off = |s: &Seen| {
            let at = super::flatten::project(map, s.unit);
            (if s.upright { at.x } else { at.y } - s.pixel).abs()
        };
        let mut offs: Vec<f64> = kept.iter().map(|s| off(s)).collect();
        let half = offs.len() / 2;
        let middle = *offs.select_nth_unstable_by(half, f64::total_cmp).1;
        kept.retain(|s| off(s) <= (3.0 * middle).max(0.7));
        if kept.len() < 12 {
            return None;
        }
    }
    Some(map)
}

/// Solves eight equations, of which the ninth column is the right side.
fn solved(mut m: [[f64; 9]; 8]) -> Option<[f64; 8]> {
    for i in 0..8 {
        let pivot = (i..8).max_by(|a, b| m[*a][i].abs().total_cmp(&m[*b][i].abs()))?;
        m.swap(i, pivot);
        if m[i][i].abs() < 1e-12 {
            return None;
        }
        let row = m[i];
        for (k, other) in m.iter_mut().enumerate() {
            if k != i {
                let share = other[i] / row[i];
                (i..9).for_each(|j| other[j] -= share * row[j]);
            }
        }
    }
    Some(std::array::from_fn(|i| m[i][8] / m[i][i]))
}

/// The ink of strokes that run along the sheet, summed along each line of pixels.
struct Strokes {
    /// Level strokes, by their y.
    level: Vec<f64>,
    /// Upright strokes, by their x.
    upright: Vec<f64>,
    /// Changes along level lines, by their x: posts, ends of doors.
    joints_across: Vec<f64>,
    /// Changes along upright lines, by their y.
    joints_down: Vec<f64>,
}

impl Strokes {
    /// Strokes of a length or more.
    fn of(ink: &Ink, least: f64) -> Strokes {
        let (width, height) = ink.dark.dimensions();
        let level = sums(height, width, least, |line, at| ink.is(at, line));
        let upright = sums(width, height, least, |line, at| ink.is(line, at));
        let joints_across = joints(&level, width, |line, at| ink.is(at, line));
        let joints_down = joints(&upright, height, |line, at| ink.is(line, at));
        Strokes { level, upright, joints_across, joints_down }
    }
}

/// How much the ink along the strongest lines changes, place by place along them.
fn joints(sums: &[f64], length: u32, is: impl Fn(u32, u32) -> bool) -> Vec<f64> {
    let most = sums.iter().copied().fold(0.0, f64::max);
    let reach = (sums.len() / 250).max(2);
    let mut out = vec![0.0; length as usize];
    for line in 0..sums.len() {
        let near = line.saturating_sub(reach)..(line + reach + 1).min(sums.len());
        let is_peak = sums[line] > 0.2 * most && sums[near.clone()].iter().all(|s| *s <= sums[line]);
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
            let near = |at: u32| is(line, at) || (line > 0 && is(line - 1, at)) || (line + 1 < lines && is(line + 1, at));
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
fn in_phase(sums: &[f64], period: f64) -> (f64, f64) {
    let (mut re, mut im, mut all) = (0.0, 0.0, 0.0);
    for (k, s) in sums.iter().enumerate().filter(|(_, s)| **s > 0.0) {
        let angle = std::f64::consts::TAU * (k as f64 + 0.5) / period;
        re += s * libm::cos(angle);
        im += s * libm::sin(angle);
        all += s;
    }
    if all == 0.0 {
        return (0.0, 0.0);
    }
    (libm::sqrt(re * re + im * im) / all, libm::atan2(im, re))
}

/// Where the first line of a period lies.
fn phase(sums: &[f64], period: f64) -> f64 {
    in_phase(sums, period).1 / std::f64::consts::TAU * period
}

/// A period that is tried: how well the strokes of each axis keep to it, and their joints.
struct Tried {
    period: f64,
    fit: [f64; 2],
    joints: [f64; 2],
}

impl Tried {
    /// Multiples and parts of a unit fit as well as the unit where a plan has few lines or single strokes; posts and the ends
    /// of doors tell which it is.
    fn score(&self, axis: usize) -> f64 {
        self.fit[axis] + JOINTS * self.joints[axis]
    }
}

/// The units to the right and down that the strokes keep to best, and how well; the two differ by at most a share.
fn period(strokes: &Strokes, given: Option<f64>, aspect: f64) -> Option<(f64, f64, f64)> {
    let longest = strokes.level.len().min(strokes.upright.len()) as f64 / 3.0;
    let (low, high) = match given {
        Some(unit) => (unit * 0.96, unit * 1.04),
        None => (SHORTEST, longest),
    };
    let mut tries = Vec::new();
    let mut period = low;
    while period <= high {
        let of = |sums: [&[f64]; 2]| sums.map(|s| in_phase(s, period).0);
        let fit = of([&strokes.upright, &strokes.level]);
        let joints = of([&strokes.joints_across, &strokes.joints_down]);
        tries.push(Tried { period, fit, joints });
        period *= 1.003;
    }
    let best = tries.iter().map(|t| t.fit[0] + t.fit[1]).fold(0.0, f64::max);
    let mut found: Option<(f64, (f64, f64, f64))> = None;
    for (k, across) in tries.iter().enumerate() {
        let near = tries[k.saturating_sub(60)..(k + 60).min(tries.len())].iter();
        let near = near.filter(|t| (t.period / across.period - 1.0).abs() <= aspect);
        let Some(down) = near.max_by(|a, b| a.score(1).total_cmp(&b.score(1))) else {
            continue;
        };
        let fit = across.fit[0] + down.fit[1];
        let score = across.score(0) + down.score(1);
        if fit >= NEARLY * best && found.is_none_or(|f| score > f.0) {
            found = Some((score, (across.period, down.period, fit / 2.0)));
        }
    }
    found.map(|f| f.1)
}

/// The first and the last line of a grid with strokes on it.
fn extent(sums: &[f64], phase: f64, period: f64) -> Option<(i32, i32)> {
    let mut lines = std::collections::BTreeMap::new();
    for (k, s) in sums.iter().enumerate() {
        let at = (k as f64 + 0.5 - phase) / period;
        if (at - at.round()).abs() < 0.25 {
            *lines.entry(at.round() as i32).or_insert(0.0) += s;
        }
    }
    let most = lines.values().copied().fold(0.0, f64::max);
    let strong = |(_, s): &(&i32, &f64)| **s > 0.04 * most;
    let first = lines.iter().find(strong)?.0;
    let last = lines.iter().rev().find(strong)?.0;
    Some((first - 1, last + 1))
}
