//! The grid of half ken that a plan keeps to: how long a unit is on the sheet, and where its lines run.

use super::sheet::Ink;
use glam::{DMat3, DVec2, dvec2};

/// The shortest unit that is looked for, pixels.
const SHORTEST: f64 = 11.0;
/// The share by which one unit that is tried is longer than the one before.
const STEP: f64 = 1.003;
/// The same, where a unit is known already.
const FINE: f64 = 0.001;
/// How far off a unit may be that is known, a share.
const KNOWN: f64 = 0.03;
/// A unit is believed if all that tells of it keeps to it nearly as well as to the best one.
const NEARLY: f64 = 0.94;
/// A projective grid has to have more strokes on its lines than a level one by this factor.
const LEANS: f64 = 1.03;
/// The fewest units along the shorter side of a sheet.
const FEWEST: f64 = 5.0;
/// What is on a line of the grid at the edge of a house, beside what is on the strongest one.
const LEAST_LINE: f64 = 0.04;

/// Places of a line within a unit that are tried.
const SLOTS: usize = 60;
/// Places to each side that still count as on the line: an eighth of a unit.
const REACH: i32 = 7;

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
        let thick = thick(ink);
        let mut strokes = Strokes::of(ink, (size / 55.0).max(9.0), &thick);
        let (known, share) = match unit {
            Some(unit) => ([unit; 2], aspect.max(KNOWN)),
            None => (period(&strokes, aspect)?, KNOWN),
        };
        let mut lines = near(&strokes, known, share, aspect);
        // Strokes of a unit's length are the walls; writing is shorter.
        for share in [KNOWN, KNOWN / 2.0] {
            strokes = Strokes::of(ink, 0.7 * lines[0].0, &thick);
            lines = near(&strokes, lines.map(|l| l.0), share, aspect);
        }
        let [(px, x), (py, y)] = lines;
        let fit = (in_phase(&strokes.upright, px) + in_phase(&strokes.level, py)) / 2.0;
        let origin = dvec2(x, y);
        let mut grid = Grid {
            to_sheet: DMat3::from_translation(origin)
                * DMat3::from_diagonal(dvec2(px, py).extend(1.0)),
            across: extent(&strokes.upright, &thick[0], origin.x, px)?,
            down: extent(&strokes.level, &thick[1], origin.y, py)?,
            fit,
            unit: px,
            residual: 0.0,
        };
        // Farther than that from a line stand boards, four to a unit.
        for reach in [0.18, 0.15, 0.12] {
            grid.refine(ink, reach, false);
        }
        // Perspective is what is left over when the lines are nearly right; before that it only fits noise.
        let level = grid;
        for _ in 0..2 {
            grid.refine(ink, 0.15, true);
        }
        if grid.support(ink) < LEANS * level.support(ink) {
            grid = level;
        }
        Some(grid)
    }

    /// Moves the lines onto the strokes near them by least squares; projective if the sheet leans.
    fn refine(&mut self, ink: &Ink, reach: f64, leans: bool) {
        let seen = self.seen(ink, reach);
        let mut offs: Vec<f64> = seen.iter().map(|s| s.off.abs()).collect();
        if offs.len() < 12 {
            return;
        }
        let half = offs.len() / 2;
        self.residual = *offs.select_nth_unstable_by(half, f64::total_cmp).1;
        if let Some(map) = fitted(&seen, self.to_sheet, leans) {
            self.to_sheet = map;
        }
    }

    /// How many strokes lie on its lines: each counts the less the farther it is off.
    fn support(&self, ink: &Ink) -> f64 {
        self.seen(ink, 0.12)
            .iter()
            .map(|s| 1.0 - s.off.abs() / 0.12)
            .sum()
    }

    /// The strokes near its lines.
    fn seen(&self, ink: &Ink, reach: f64) -> Vec<Seen> {
        let mut seen = Vec::new();
        for upright in [true, false] {
            let (lines, along) = if upright {
                (self.across, self.down)
            } else {
                (self.down, self.across)
            };
            for (k, t) in (lines.0..=lines.1).flat_map(|k| (along.0..along.1).map(move |t| (k, t)))
            {
                let unit = |offset: f64, t1: f64| {
                    let (line, at) = (f64::from(k) + offset, f64::from(t) + t1);
                    if upright {
                        dvec2(line, at)
                    } else {
                        dvec2(at, line)
                    }
                };
                let place =
                    |offset: f64, t1: f64| super::flatten::project(self.to_sheet, unit(offset, t1));
                if let Some((off, weight)) = stroke_near(ink, self.unit, reach, place) {
                    let at = place(off, 0.5);
                    seen.push(Seen {
                        unit: unit(0.0, 0.5),
                        pixel: if upright { at.x } else { at.y },
                        upright,
                        off,
                        weight,
                    });
                }
            }
        }
        seen
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
    /// How thick it is: walls count more than mats.
    weight: f64,
}

/// How far from a line of the grid the ink along one unit of it lies, in units, if it is a stroke: its middle, and its share.
fn stroke_near(
    ink: &Ink,
    unit: f64,
    reach: f64,
    place: impl Fn(f64, f64) -> DVec2,
) -> Option<(f64, f64)> {
    let steps = ((reach * unit).ceil() as i32).max(2);
    let along = 12;
    let (mut sum, mut moment, mut most) = (0.0, 0.0, 0.0_f64);
    for k in -steps..=steps {
        let offset = f64::from(k) / f64::from(steps) * reach;
        let mut count = 0.0;
        for t in 0..along {
            let at = place(offset, 0.2 + 0.6 * (f64::from(t) + 0.5) / f64::from(along));
            count += f64::from(u8::from(dark_at(ink, at) > ink.threshold));
        }
        let share = count / f64::from(along);
        // What crosses the line is in every row; a stroke along it in some.
        let weight = if share > 0.35 { share } else { 0.0 };
        most = most.max(share);
        sum += weight;
        moment += weight * offset;
    }
    (most > 0.5).then(|| (moment / sum, sum / f64::from(2 * steps + 1)))
}

/// The ink at the pixel nearest to a place; none outside.
pub fn dark_at(ink: &Ink, at: DVec2) -> u8 {
    let (x, y) = (at.x.floor(), at.y.floor());
    let inside =
        x >= 0.0 && y >= 0.0 && x < f64::from(ink.dark.width()) && y < f64::from(ink.dark.height());
    if inside {
        ink.dark.get_pixel(x as u32, y as u32)[0]
    } else {
        0
    }
}

/// The map that takes the units of strokes to their pixels, without the strokes farthest off; projective if it leans.
fn fitted(seen: &[Seen], now: DMat3, leans: bool) -> Option<DMat3> {
    // Shifted and scaled to about one, so that the equations are well set.
    let middle = seen.iter().map(|s| s.unit).sum::<DVec2>() / seen.len() as f64;
    let centre = super::flatten::project(now, middle);
    let scale = seen
        .iter()
        .map(|s| (s.unit - middle).abs().max_element())
        .fold(1.0, f64::max);
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
                    normal[i][j] += s.weight * row[i] * row[j];
                }
            }
        }
        // A little weight on no perspective, for sheets with strokes in one corner only.
        let level = if leans { 2e-3 } else { 1e6 } * kept.iter().map(|s| s.weight).sum::<f64>();
        normal[6][6] += level;
        normal[7][7] += level;
        let h = solved(normal)?;
        let local = DMat3::from_cols_array(&[h[0], h[3], h[6], h[1], h[4], h[7], h[2], h[5], 1.0]);
        let out = DMat3::from_translation(centre)
            * DMat3::from_diagonal(DVec2::splat(pixels).extend(1.0));
        let into = DMat3::from_diagonal(DVec2::splat(1.0 / scale).extend(1.0))
            * DMat3::from_translation(-middle);
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

/// What tells of one direction's lines, by the place across them.
type Sums = Vec<f64>;

/// The ink of strokes that run along the sheet, summed along each line of pixels.
struct Strokes {
    /// Level strokes, by their y.
    level: Sums,
    /// Upright strokes, by their x.
    upright: Sums,
    /// What tells of the units to the right and down: strokes; changes along those that cross (posts, ends of doors); thick ink.
    told: [[Sums; 3]; 2],
}

impl Strokes {
    /// Strokes of a length or more.
    fn of(ink: &Ink, least: f64, thick: &[Sums; 2]) -> Strokes {
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
fn thick(ink: &Ink) -> [Sums; 2] {
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
fn in_phase(sums: &[f64], period: f64) -> f64 {
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

/// The units to the right and down that the strokes keep to best; the two differ by at most a share.
///
/// Parts of a unit fit as well as the unit where mats and boards are drawn: of what fits best the greatest multiple is
/// taken that fits nearly as well. Multiples of the unit do not, since posts and the ends of doors stand on every line.
fn period(strokes: &Strokes, aspect: f64) -> Option<[f64; 2]> {
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
    let multiple = |n: u32| {
        let middle = best + (libm::log(f64::from(n)) / libm::log(STEP)).round() as usize;
        (middle.saturating_sub(6)..(middle + 7).min(pairs.len())).max_by(better)
    };
    let peak = (2..=4)
        .filter_map(multiple)
        .rfind(|k| pairs[*k].0 >= NEARLY * pairs[best].0)
        .unwrap_or(best);
    Some([periods[peak], periods[pairs[peak].1]])
}

/// The units to the right and down nearest to some that are known to a share, and where the first line of each lies.
///
/// Counted is what lies on lines: what lies between them may be boards, mats and dimensions. The two units differ by at most
/// `aspect`.
fn near(strokes: &Strokes, known: [f64; 2], share: f64, aspect: f64) -> [(f64, f64); 2] {
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
fn extent(strokes: &[f64], thick: &[f64], phase: f64, period: f64) -> Option<(i32, i32)> {
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
