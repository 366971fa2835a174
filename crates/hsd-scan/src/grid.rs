//! The grid of half ken that a plan keeps to: how long a unit is on the sheet, and where its lines run.

mod period;
mod posts;

use super::sheet::Ink;
use glam::{DMat3, DVec2, dvec2};
use image::GrayImage;
use period::{Strokes, extent, in_phase, near, thick};

/// How far off a unit may be that is known, a share.
const KNOWN: f64 = 0.03;
/// A projective grid has to have more strokes on its lines than a level one by this factor.
const LEANS: f64 = 1.03;

/// The most cells of a grid, since each unit is sampled: plans that can be read have up to 84 by 84.
pub const MOST_CELLS: i64 = 10_000;

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
        super::raster::project(self.to_sheet, dvec2(u, v))
    }

    /// Units of a pixel of the sheet.
    pub fn units_of(&self, pixel: DVec2) -> DVec2 {
        super::raster::project(self.to_sheet.inverse(), pixel)
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
            None => (period::period(&strokes, aspect)?, KNOWN),
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
        let leans = grid.support(ink) >= LEANS * level.support(ink);
        if !leans {
            grid = level;
        }
        if grid.cells() <= MOST_CELLS {
            grid.onto_posts(ink, leans);
        }
        Some(grid)
    }

    /// Returns the number of cells between the first and the last lines.
    pub fn cells(&self) -> i64 {
        let lines = |(first, last): (i32, i32)| i64::from(last) - i64::from(first);
        lines(self.across) * lines(self.down)
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
                    |offset: f64, t1: f64| super::raster::project(self.to_sheet, unit(offset, t1));
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
    level_at(&ink.dark, at)
}

/// The level at the pixel nearest to a place; none outside.
pub(super) fn level_at(levels: &GrayImage, at: DVec2) -> u8 {
    // Not `floor`, which is a call on processors of the common kind: there are millions of places.
    if at.x >= 0.0 && at.y >= 0.0 {
        let (x, y) = (at.x as u32, at.y as u32);
        if x < levels.width() && y < levels.height() {
            return levels.as_raw()[y as usize * levels.width() as usize + x as usize];
        }
    }
    0
}

/// The map that takes the units of strokes to their pixels, without the strokes farthest off; projective if it leans.
fn fitted(seen: &[Seen], now: DMat3, leans: bool) -> Option<DMat3> {
    // Shifted and scaled to about one, so that the equations are well set.
    let middle = seen.iter().map(|s| s.unit).sum::<DVec2>() / seen.len() as f64;
    let centre = super::raster::project(now, middle);
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
            let at = super::raster::project(map, s.unit);
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
