//! One slope with its frame: lays out rows up the slope and courses along it, in one phase over all facets of the
//! slope.

use crate::trim::body::Body;
use crate::trim::surface::Surface;
use glam::{DVec2, DVec3, dvec2};
use hsd_ir::building::{EdgeKind, RoofSurface};
use hsd_ir::material::SurfaceId;

/// Pieces shorter than this are left out, metres.
const SHORTEST: f64 = 0.02;
/// No cut in t.
const EVERYWHERE: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);

/// A facet in the frame of its slope. Plan coordinates: s to the right as seen from outside, t up the slope, both in
/// metres from the origin of the house, so that rows match the textures of coverings.
#[derive(Clone, Debug)]
pub(super) struct Field {
    right: DVec2,
    up: DVec2,
    /// The number of its slope.
    slope: usize,
    /// A point of its plane and the plane's rise.
    at: DVec3,
    rise: DVec2,
    /// Its corners as (s, t), counter-clockwise.
    corners: Vec<DVec2>,
}

/// A facet that falls in another direction than its slope, as under a raised corner: known by its rise.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Twist {
    rise: DVec2,
    /// Up its slope in plan, unit length.
    up: DVec2,
}

impl Twist {
    /// Facets that fall less across their slope are not twisted, metres per metre in plan.
    const LEAST: f64 = 1e-3;

    /// Returns the twisted facets of a roof. Those that fall mostly across their slope, as on a karahafu, keep their own direction.
    pub(crate) fn all(surface: &RoofSurface) -> Vec<Twist> {
        if surface.edges.iter().all(|e| e.kind != EdgeKind::Fold) {
            return vec![];
        }
        let fields = Field::all(&Surface::of(surface)).into_iter();
        let twists = fields.filter(|f| f.rise.dot(f.right).abs() > Twist::LEAST);
        let twists = twists.filter(|f| f.pitch() > 0.5 * f.rise.length());
        twists
            .map(|f| Twist {
                rise: f.rise,
                up: f.up,
            })
            .collect()
    }

    /// Returns the direction up the slope, along the face, if a face that looks to `normal` is this facet.
    pub(crate) fn up(&self, normal: DVec3) -> Option<DVec3> {
        let rise = -normal.truncate() / normal.z;
        let own = normal.z > 0.0 && rise.distance(self.rise) < 1e-6;
        own.then(|| self.up.extend(self.rise.dot(self.up)).normalize())
    }
}

impl Field {
    /// Returns every facet, in the frame of the largest facet of its slope.
    pub(super) fn all(surface: &Surface) -> Vec<Field> {
        let count = surface.facets.len();
        let mut slope: Vec<usize> = (0..count).collect();
        // Slopes are small groups: names run along until nothing changes.
        for _ in 0..count {
            let mut changed = false;
            for (f, g) in surface.kinks() {
                let least = slope[f].min(slope[g]);
                changed |= slope[f] != slope[g];
                (slope[f], slope[g]) = (least, least);
            }
            if !changed {
                break;
            }
        }
        let mut largest: Vec<(f64, usize)> = vec![(0.0, 0); count];
        for f in 0..count {
            let area = surface.area(f);
            if area > largest[slope[f]].0 {
                largest[slope[f]] = (area, f);
            }
        }
        let field = |f: usize| {
            let main = &surface.facets[largest[slope[f]].1];
            let facet = &surface.facets[f];
            let up = -main.fall();
            let right = -up.perp();
            let points = facet.corners.iter().map(|i| surface.points[*i as usize]);
            let frame = |p: DVec3| dvec2(right.dot(p.truncate()), up.dot(p.truncate()));
            Field {
                right,
                up,
                slope: slope[f],
                at: surface.points[facet.corners[0] as usize],
                rise: facet.rise,
                corners: points.map(frame).collect(),
            }
        };
        (0..count).map(field).collect()
    }

    /// Returns the number of its slope, equal for all facets of it.
    pub(super) fn slope(&self) -> usize {
        self.slope
    }

    /// Returns the direction to the right in plan as seen from outside, unit length.
    pub(super) fn right(&self) -> DVec2 {
        self.right
    }

    /// Returns the s of a point.
    pub(super) fn s(&self, p: DVec3) -> f64 {
        self.right.dot(p.truncate())
    }

    /// Returns the rise in metres per metre in plan.
    pub(super) fn pitch(&self) -> f64 {
        self.rise.dot(self.up)
    }

    /// Returns the factor from a distance at right angles to the slope to the vertical distance.
    pub(super) fn stretch(&self) -> f64 {
        (1.0 + self.rise.length_squared()).sqrt()
    }

    /// Returns the point of the surface at (s, t), raised vertically by `lift`.
    pub(super) fn point(&self, s: f64, t: f64, lift: f64) -> DVec3 {
        let plan = self.right * s + self.up * t;
        let z = self.at.z + self.rise.dot(plan - self.at.truncate());
        plan.extend(z + lift)
    }

    /// Returns the least and greatest s and t.
    pub(super) fn bounds(&self) -> (DVec2, DVec2) {
        let none = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let corners = self.corners.iter();
        corners.fold(none, |(lo, hi), c| (lo.min(*c), hi.max(*c)))
    }

    /// Returns the extent of the facet in t on the line of a given s.
    pub(super) fn column(&self, s: f64) -> Option<(f64, f64)> {
        self.across(|c| c, s).filter(|(lo, hi)| hi - lo > SHORTEST)
    }

    /// Returns the extent of the facet in s on the line of a given t.
    pub(super) fn course(&self, t: f64) -> Option<(f64, f64)> {
        self.across(|c| dvec2(c.y, c.x), t)
            .filter(|(lo, hi)| hi - lo > SHORTEST)
    }

    fn across(&self, turn: impl Fn(DVec2) -> DVec2, x: f64) -> Option<(f64, f64)> {
        let n = self.corners.len();
        let (mut lo, mut hi) = (f64::INFINITY, f64::NEG_INFINITY);
        for i in 0..n {
            let (p, q) = (turn(self.corners[i]), turn(self.corners[(i + 1) % n]));
            if (p.x - x) * (q.x - x) <= 0.0 && (p.x - q.x).abs() > 1e-9 {
                let y = p.y + (q.y - p.y) * (x - p.x) / (q.x - p.x);
                (lo, hi) = (lo.min(y), hi.max(y));
            }
        }
        (lo <= hi).then_some((lo, hi))
    }

    /// Builds a row up the slope at `s`: a profile of (s, height at right angles to the slope), cut vertically at the
    /// ends of the facet.
    pub(super) fn row(&self, finish: SurfaceId, s: f64, profile: &[(f64, f64)]) -> Option<Body> {
        let raised = raised(profile, self.stretch());
        Body::loft(finish, &self.ends(s, &raised, EVERYWHERE)?)
    }

    /// Adds such rows over all facets of a slope, each as one body as far as it continues from facet to facet. A row
    /// follows its middle, since facets of a slope twisted towards a raised corner are narrower than a tile.
    pub(super) fn rows(
        slope: &[&Field],
        finish: SurfaceId,
        s: f64,
        profile: &[(f64, f64)],
    ) -> Vec<Body> {
        let stretch = slope.iter().map(|f| f.stretch()).fold(1.0, f64::max);
        let profile = raised(profile, stretch);
        let crossed = slope
            .iter()
            .filter_map(|f| f.whole_column(s).map(|(lo, hi)| (*f, lo, hi)));
        let mut crossed: Vec<(&Field, f64, f64)> = crossed.collect();
        crossed.sort_by(|a, b| a.1.total_cmp(&b.1));
        let goes_on = |a: &(&Field, f64, f64), b: &(&Field, f64, f64)| {
            let step = a.0.point(s, a.2, 0.0).distance(b.0.point(s, b.1, 0.0));
            step < 1e-3
        };
        let runs = crossed.chunk_by(goes_on);
        runs.filter_map(|run| Field::run(run, finish, s, &profile))
            .collect()
    }

    /// Builds one row over consecutive facets up the slope, each with the extent of the row's middle.
    fn run(
        run: &[(&Field, f64, f64)],
        finish: SurfaceId,
        s: f64,
        profile: &[(f64, f64)],
    ) -> Option<Body> {
        let (first, last) = (run.first()?, run.last()?);
        if last.2 - first.1 < SHORTEST {
            return None;
        }
        let level = |f: &Field, t: f64| -> Vec<DVec3> {
            let ends: Vec<_> = profile.iter().map(|(x, _)| (*x, t)).collect();
            f.section(s, &ends, profile)
        };
        let mut joints = vec![];
        let mut before = first.1;
        for (f, _, hi) in &run[..run.len() - 1] {
            if hi - before > SHORTEST && last.2 - hi > SHORTEST {
                joints.push((*hi, level(f, *hi)));
                before = *hi;
            }
        }
        let (from, to) = match &joints[..] {
            [] => (last.2, first.1),
            [(low, _), ..] => (*low, before),
        };
        // Ends follow the border where it is straight under the whole row and leaves room, else they are square.
        let t = |p: &DVec3| first.0.up.dot(p.truncate());
        let low = first.0.ends(s, profile, EVERYWHERE).map(|[low, _]| low);
        let low = low.filter(|end| end.iter().all(|p| t(p) < from - SHORTEST));
        let high = last.0.ends(s, profile, EVERYWHERE).map(|[_, high]| high);
        let high = high.filter(|end| end.iter().all(|p| t(p) > to + SHORTEST));
        let mut sections = vec![low.unwrap_or_else(|| level(first.0, first.1))];
        sections.extend(joints.into_iter().map(|(_, section)| section));
        sections.push(high.unwrap_or_else(|| level(last.0, last.2)));
        Body::loft(finish, &sections)
    }

    /// As [`Field::column`], without a minimum length.
    fn whole_column(&self, s: f64) -> Option<(f64, f64)> {
        self.across(|c| c, s).filter(|(lo, hi)| hi - lo > 1e-6)
    }

    /// Builds a row with vertical heights, so that it follows the curve of its slope, and clipped to t in `within`.
    pub(super) fn upright_row(
        &self,
        finish: SurfaceId,
        s: f64,
        profile: &[(f64, f64)],
        within: (f64, f64),
    ) -> Option<Body> {
        Body::loft(finish, &self.ends(s, profile, within)?)
    }

    /// Returns the sections at both ends of such a row.
    fn ends(&self, s: f64, profile: &[(f64, f64)], within: (f64, f64)) -> Option<[Vec<DVec3>; 2]> {
        let mut ends = [Vec::new(), Vec::new()];
        for (x, _) in profile {
            let (lo, hi) = self.column(s + x)?;
            let (lo, hi) = (lo.max(within.0), hi.min(within.1));
            if hi - lo < SHORTEST {
                return None;
            }
            ends[0].push((*x, lo));
            ends[1].push((*x, hi));
        }
        // Where the border turns inside the row it is cut square.
        square(&mut ends[0], f64::max);
        square(&mut ends[1], f64::min);
        if ends[0]
            .iter()
            .zip(&ends[1])
            .any(|(lo, hi)| hi.1 - lo.1 < SHORTEST)
        {
            return None;
        }
        Some(ends.map(|end| self.section(s, &end, profile)))
    }

    /// Returns a section of a row whose positions are (x, t), at the height of its middle above the slope, so that rows
    /// do not lean with the slope.
    fn section(&self, s: f64, end: &[(f64, f64)], profile: &[(f64, f64)]) -> Vec<DVec3> {
        let places = end.iter().zip(profile);
        let at = |((x, t), (_, height)): (&(f64, f64), &(f64, f64))| {
            self.point(s, *t, *height) + (self.right * *x).extend(0.0)
        };
        places.map(at).collect()
    }

    /// Builds a bar along the slope at `t`: a profile of (t, height), cut vertically slightly beyond the ends of the
    /// facet, so that its ends are not coplanar with the roof.
    pub(super) fn bar(&self, finish: SurfaceId, t: f64, profile: &[(f64, f64)]) -> Option<Body> {
        const OVER: f64 = 0.01;
        let stretch = self.stretch();
        let mut sections = [Vec::new(), Vec::new()];
        for (y, height) in profile {
            let (lo, hi) = self.course(t + y)?;
            sections[0].push(self.point(lo - OVER, t + y, height * stretch));
            sections[1].push(self.point(hi + OVER, t + y, height * stretch));
        }
        Body::loft(finish, &sections)
    }

    /// Returns the positions of rows: multiples of `step` shifted by `phase` inside the facet, at least `margin` from
    /// its ends.
    pub(super) fn places(&self, step: f64, phase: f64, margin: f64) -> impl Iterator<Item = f64> {
        let (lo, hi) = self.bounds();
        places(lo.x + margin, hi.x - margin, step, phase)
    }
}

/// Returns multiples of `step` shifted by `phase`, from `lo` to `hi`; at most a few thousand.
pub(super) fn places(lo: f64, hi: f64, step: f64, phase: f64) -> impl Iterator<Item = f64> {
    const MOST: i64 = 4000;
    let first = ((lo - phase) / step).ceil() as i64;
    let last = ((hi - phase) / step).floor() as i64;
    let count = (last.saturating_sub(first) + 1).clamp(0, MOST);
    (first..first + count).map(move |i| i as f64 * step + phase)
}

/// Converts a profile's heights at right angles to a slope to vertical ones.
fn raised(profile: &[(f64, f64)], stretch: f64) -> Vec<(f64, f64)> {
    profile.iter().map(|(x, h)| (*x, h * stretch)).collect()
}

/// Cuts an end of a row, as (x, t), at right angles if its points are not collinear.
fn square(end: &mut [(f64, f64)], inner: fn(f64, f64) -> f64) {
    let none = (f64::INFINITY, f64::NEG_INFINITY);
    let by_x = |a: &(f64, f64), b: &(f64, f64)| a.0.total_cmp(&b.0);
    let first = end.iter().copied().min_by(by_x).unwrap_or(none);
    let last = end.iter().copied().max_by(by_x).unwrap_or(none);
    let slope = (last.1 - first.1) / (last.0 - first.0);
    let straight = |(x, t): &(f64, f64)| (first.1 + slope * (x - first.0) - t).abs() < 1e-7;
    if !end.iter().all(straight) {
        let cut = end.iter().map(|p| p.1).reduce(inner).unwrap_or_default();
        end.iter_mut().for_each(|p| p.1 = cut);
    }
}
