//! The grid that the walls of a drawing keep to: its unit, and where it begins.

use super::lines::{Lines, Stroke};
use super::roles::Means;
use glam::{DVec2, dvec2};

/// Half a ken of usual houses, millimetres: Edo-ma, Chukyo-ma, Kyo-ma, and modules of our days.
pub const HALF_KEN: [f64; 6] = [909.0909, 954.5455, 984.8485, 910.0, 900.0, 1000.0];
/// Lengths of half a ken, millimetres.
const PLAUSIBLE: std::ops::RangeInclusive<f64> = 860.0..=1030.0;
/// Millimetres in the units that drawings without a unit are made in.
pub(in crate::plan) const UNITS: [f64; 5] = [1.0, 10.0, 1000.0, 25.4, 304.8];
/// How far a grid may be from a usual one.
const NEAR: f64 = 0.004;
/// The least agreement of walls with a usual grid, and with any.
const AGREES: [f64; 2] = [0.55, 0.4];
/// Units along a side: the fewest and the most.
const SIDE: [f64; 2] = [2.0, 110.0];
/// The fewest places that say what their grid is: fewer agree with many.
const LEAST: usize = 10;
/// The sine of the least turn of a corner.
const TURNS: f64 = 0.3;
/// The share of places that may lie between the lines of a grid.
const BETWEEN: f64 = 0.04;

/// A grid on a drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// A crossing.
    pub origin: DVec2,
    /// From line to line, units of the drawing.
    pub unit: f64,
    /// Millimetres of the house from line to line, if known.
    pub unit_mm: Option<f64>,
    /// How well walls agree with it, 0 to 1.
    pub fit: f64,
}

impl Grid {
    /// A place of the drawing in units of the grid.
    pub fn units_of(&self, p: DVec2) -> DVec2 {
        (p - self.origin) / self.unit
    }

    /// A place in units of the grid on the drawing.
    pub fn at(&self, p: DVec2) -> DVec2 {
        self.origin + p * self.unit
    }
}

/// Places along one axis with their weights.
#[derive(Default)]
struct Marks(Vec<(f64, f64)>);

impl Marks {
    /// Few places that weigh about the same: those close to each other are one, a long wall weighs little more than a short one.
    fn gathered(mut self, extent: f64) -> Marks {
        self.0.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut out: Vec<(f64, f64)> = vec![];
        for (at, weight) in self.0 {
            match out.last_mut() {
                Some((last, sum)) if at - *last < extent * 2e-4 => *sum += weight,
                _ => out.push((at, weight)),
            }
        }
        out.iter_mut().for_each(|m| m.1 = libm::sqrt(m.1 / extent));
        Marks(out)
    }

    /// The sum of the places on a circle of this many turns in a unit of length.
    fn sum(&self, turns: f64) -> DVec2 {
        let one = |(at, weight): &(f64, f64)| {
            let angle = std::f64::consts::TAU * (at * turns).fract();
            dvec2(libm::cos(angle), libm::sin(angle)) * *weight
        };
        self.0.iter().map(one).sum()
    }

    fn weight(&self) -> f64 {
        self.0.iter().map(|m| m.1).sum()
    }

    /// The share of the places that lie between lines.
    fn between(&self, turns: f64) -> (f64, f64) {
        let sum = self.sum(turns);
        let phase = libm::atan2(sum.y, sum.x) / std::f64::consts::TAU;
        let off = |at: f64| {
            let off = (at * turns - phase).fract().abs();
            off.min(1.0 - off)
        };
        let far = self.0.iter().filter(|m| off(m.0) > 0.3).map(|m| m.1).sum();
        (far, self.weight())
    }
}

/// Places along both axes.
struct Both {
    axes: [Marks; 2],
    extent: f64,
}

impl Both {
    fn of(strokes: &[Stroke], means: &[Option<Means>]) -> Option<Both> {
        let mut axes = [Marks::default(), Marks::default()];
        let (mut low, mut high) = (DVec2::MAX, DVec2::MIN);
        for (stroke, role) in strokes.iter().zip(means) {
            match role {
                Some(Means::Wall | Means::Grid) => {
                    lines(stroke, *role == Some(Means::Wall), &mut axes)
                }
                Some(Means::Post) => {
                    let (a, b) = bounds(&stroke.points);
                    let middle = (a + b) / 2.0;
                    (0..2).for_each(|k| axes[k].0.push((middle[k], (b - a).max_element() * 2.0)));
                }
                _ => continue,
            }
            if *role == Some(Means::Wall) {
                let (a, b) = bounds(&stroke.points);
                (low, high) = (low.min(a), high.max(b));
            }
        }
        let extent = (high - low).max_element();
        if !(extent > 0.0 && extent.is_finite()) {
            return None;
        }
        let axes = axes.map(|a| a.gathered(extent));
        let places: usize = axes.iter().map(|a| a.0.len()).sum();
        (places >= LEAST && axes.iter().all(|a| a.0.len() > 1)).then_some(Both { axes, extent })
    }

    /// How well the places agree with a grid.
    fn fit(&self, turns: f64) -> f64 {
        let sums: f64 = self.axes.iter().map(|a| a.sum(turns).length()).sum();
        sums / self.axes.iter().map(Marks::weight).sum::<f64>()
    }

    fn between(&self, turns: f64) -> f64 {
        let (far, all) = self
            .axes
            .iter()
            .map(|a| a.between(turns))
            .fold((0.0, 0.0), |s, b| (s.0 + b.0, s.1 + b.1));
        far / all
    }

    /// The best grid near one.
    fn refined(&self, turns: f64, by: f64) -> (f64, f64) {
        let steps = ((turns * by * self.extent * 40.0).ceil() as i32).clamp(40, 400);
        let near = (-steps..=steps).map(|k| turns * (1.0 + by * f64::from(k) / f64::from(steps)));
        let best = near
            .map(|t| (self.fit(t), t))
            .max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.total_cmp(&a.1)));
        best.unwrap_or((0.0, turns))
    }

    /// The best of usual grids, given in millimetres of which `scale` are a unit of the drawing: its turns, and its millimetres.
    fn usual(&self, grids: &[f64], scale: f64) -> Option<(f64, f64)> {
        let mut best: Option<(f64, f64, f64)> = None;
        for grid in grids {
            let unit = grid / scale;
            if !(SIDE[0]..SIDE[1]).contains(&(self.extent / unit)) {
                continue;
            }
            let (fit, turns) = self.refined(1.0 / unit, NEAR);
            // Of units that fit equally well the one that needs the least change.
            let worth = fit - (unit * turns - 1.0).abs() * 20.0;
            let is_better = best.is_none_or(|(most, ..)| worth > most);
            if fit > AGREES[0] && is_better && self.between(turns) < BETWEEN {
                best = Some((worth, turns, *grid));
            }
        }
        best.map(|(_, turns, grid)| (turns, grid))
    }

    /// The longest unit that nearly all places agree with.
    fn any(&self) -> Option<(f64, f64)> {
        let step = 1.0 / (12.0 * self.extent);
        let turns = |k: usize| SIDE[0] / self.extent + step * k as f64;
        let count = ((SIDE[1] - SIDE[0]) * 12.0) as usize;
        let fits: Vec<f64> = (0..count).map(|k| self.fit(turns(k))).collect();
        let most = fits.iter().copied().fold(0.0, f64::max);
        let is_peak = |k: &usize| {
            *k > 0 && *k + 1 < count && fits[*k] >= fits[k - 1] && fits[*k] >= fits[k + 1]
        };
        let high = (1..count)
            .filter(is_peak)
            .filter(|k| fits[*k] > most * 0.75);
        let mut refined = high.map(|k| self.refined(turns(k), step / turns(k)));
        refined.find(|(fit, turns)| *fit > AGREES[1] && self.between(*turns) < BETWEEN)
    }
}

fn bounds(points: &[DVec2]) -> (DVec2, DVec2) {
    points
        .iter()
        .fold((DVec2::MAX, DVec2::MIN), |(low, high), p| {
            (low.min(*p), high.max(*p))
        })
}

/// The places of lines along the axes; of walls their ends too.
fn lines(stroke: &Stroke, has_ends: bool, axes: &mut [Marks; 2]) {
    for [p, q] in sides(&smooth(stroke)) {
        let way = (q - p).abs();
        let (along, across) = if way.x > way.y { (0, 1) } else { (1, 0) };
        if way[across] > way[along] * 0.15 {
            continue;
        }
        axes[across]
            .0
            .push(((p[across] + q[across]) / 2.0, way[along]));
        if has_ends {
            axes[along].0.push((p[along], way[along] * 0.25));
            axes[along].0.push((q[along], way[along] * 0.25));
        }
    }
}

/// A stroke without the corners at which it hardly turns: lines that a hand has drawn have many.
fn smooth(stroke: &Stroke) -> Stroke {
    let mut points: Vec<DVec2> = vec![];
    for &p in &stroke.points {
        while let [.., a, b] = points[..] {
            let turn = (b - a)
                .normalize_or_zero()
                .perp_dot((p - b).normalize_or_zero());
            if turn.abs() > TURNS || (b - a).dot(p - b) < 0.0 {
                break;
            }
            points.pop();
        }
        points.push(p);
    }
    // A closed line may start within a side.
    while let ([a, b, ..], [.., z]) = (&points[..], &points[..]) {
        let turn = (*a - *z)
            .normalize_or_zero()
            .perp_dot((*b - *a).normalize_or_zero());
        if !stroke.is_closed
            || points.len() < 4
            || turn.abs() > TURNS
            || (*a - *z).dot(*b - *a) < 0.0
        {
            break;
        }
        points.remove(0);
    }
    Stroke {
        points,
        is_closed: stroke.is_closed,
        ..Stroke::default()
    }
}

/// The sides of a stroke.
pub(super) fn sides(stroke: &Stroke) -> impl Iterator<Item = [DVec2; 2]> {
    let open = stroke.points.windows(2).map(|w| [w[0], w[1]]);
    let closes = stroke.is_closed && stroke.points.len() > 2;
    let last = closes.then(|| [stroke.points[stroke.points.len() - 1], stroke.points[0]]);
    open.chain(last)
}

/// Finds the grid: by a given unit (millimetres of the house), by usual units, or by the walls alone.
pub(super) fn find(lines: &Lines, means: &[Option<Means>], given: Option<f64>) -> Option<Grid> {
    let both = Both::of(&lines.strokes, means)?;
    let scales: Vec<f64> = lines.unit_mm.map_or(UNITS.to_vec(), |mm| vec![mm]);
    let usual = given.map_or(HALF_KEN.to_vec(), |mm| vec![mm]);
    // The first unit of length in which walls agree with a usual grid.
    let tried = scales.iter().filter(|_| lines.is_model);
    let best = tried.filter_map(|scale| both.usual(&usual, *scale)).next();
    let (turns, unit_mm) = match best {
        Some((turns, unit_mm)) => (turns, Some(unit_mm)),
        None => (both.any()?.1, given),
    };
    // Few walls agree with some grid or other. On one as large as the house its unit has to be half a ken.
    let is_half_ken = |scale: &f64| PLAUSIBLE.contains(&(scale / turns));
    if lines.is_model && unit_mm.is_none() && !scales.iter().any(is_half_ken) {
        return None;
    }
    let phase = |k: usize| {
        let sum = both.axes[k].sum(turns);
        libm::atan2(sum.y, sum.x) / std::f64::consts::TAU / turns
    };
    Some(Grid {
        origin: dvec2(phase(0), phase(1)),
        unit: 1.0 / turns,
        unit_mm,
        fit: both.fit(turns),
    })
}
