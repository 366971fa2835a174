//! What lies beyond the joints of a roof: another slope that rises from them, or a wall. Roofs that are alike show
//! one mesh only where this is the same as well, so that it is found before anything is dressed.

use crate::building::{Finish, HouseRoofs, Roof};
use crate::tessellate::trim::seams::{End, Kind};
use crate::tessellate::trim::surface::Surface;
use glam::{DVec2, DVec3};

/// Houses with more facets than this have their joints left plain: nobody looks at each of them.
const MANY: usize = 3000;
/// How far beyond a joint its neighbour is looked for, and how far it may lie above or below, metres.
const STEP: f64 = 0.02;
const APART: f64 = 0.04;
/// How far a ridge runs on into another roof at most, and in which steps, metres.
const FARTHEST: f64 = 1.5;
const PACE: f64 = 0.05;

/// What lies beyond the joints of one roof.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::tessellate) struct Beyond {
    /// The rise of the slope beyond each joint in the order of edges, where there is one; empty where nobody looked.
    pub(super) rises: Vec<Option<DVec2>>,
    /// How far ridges run on beyond their ends at joints, metres, in the order of seams.
    pub(super) runs: Vec<f64>,
}

/// The slopes of all roofs of a house.
#[derive(Debug, Default)]
pub(in crate::tessellate) struct Neighbours {
    slopes: Vec<Slope>,
    /// The coverings of the roofs.
    surfaces: Vec<Surface>,
}

/// One facet: whose it is, where it lies, its plan, a point and its rise.
#[derive(Debug)]
struct Slope {
    roof: usize,
    lo: DVec2,
    hi: DVec2,
    plan: Vec<DVec2>,
    at: DVec3,
    rise: DVec2,
}

impl Neighbours {
    /// The slopes of the roofs of one house; none where no roof has a joint (the upper gable of an irimoya is one
    /// with its skirt), or where there are too many.
    pub(in crate::tessellate) fn of(roofs: &HouseRoofs) -> Neighbours {
        let mut all = Neighbours::default();
        if !roofs.roofs.iter().any(has_joints) {
            return all;
        }
        for (n, roof) in roofs.roofs.iter().enumerate() {
            let surface = Surface::of(&roof.surface);
            for facet in &surface.facets {
                let points = facet.corners.iter().map(|i| surface.points[*i as usize]);
                let plan: Vec<DVec2> = points.map(DVec3::truncate).collect();
                let none = (DVec2::INFINITY, DVec2::NEG_INFINITY);
                let grow = |(lo, hi): (DVec2, DVec2), p: &DVec2| (lo.min(*p), hi.max(*p));
                let (lo, hi) = plan.iter().fold(none, grow);
                all.slopes.push(Slope {
                    roof: n,
                    lo,
                    hi,
                    plan,
                    at: surface.points[facet.corners[0] as usize],
                    rise: facet.rise,
                });
            }
            all.surfaces.push(surface);
        }
        if all.slopes.len() > MANY {
            all.slopes.clear();
        }
        all
    }

    /// What lies beyond the joints of one of them.
    pub(in crate::tessellate) fn beyond(&self, n: usize, roof: &Roof) -> Beyond {
        let mut beyond = Beyond::default();
        let Some(surface) = self.surfaces.get(n).filter(|_| !self.slopes.is_empty()) else {
            return beyond;
        };
        for (from, to) in surface.joints() {
            let middle = from.midpoint(to);
            let out = -(to - from).truncate().perp().normalize_or_zero();
            let place = middle.truncate() + out * STEP;
            let near = |(z, _): &(f64, DVec2)| (z - middle.z).abs() < APART;
            let found = self.over(n, place).find(near);
            beyond.rises.push(found.map(|(_, rise)| rise));
        }
        let height = roof.dress.ridge_height(roof.kind);
        for seam in surface.seams(&beyond) {
            if !matches!(seam.kind, Kind::Ridge | Kind::Hip) {
                continue;
            }
            let last = seam.points.len() - 1;
            for (end, at, back) in [(0, 0, 1), (1, last, last - 1)] {
                if seam.ends[end] == End::Joint {
                    let (at, back) = (seam.points[at], seam.points[back]);
                    beyond.runs.push(self.run(n, at, at - back, height));
                }
            }
        }
        beyond
    }

    /// Heights and rises of the other roofs over a place in plan.
    fn over(&self, n: usize, p: DVec2) -> impl Iterator<Item = (f64, DVec2)> + '_ {
        let slopes = self.slopes.iter().filter(move |s| s.roof != n);
        let here = slopes.filter(move |s| s.lo.cmple(p).all() && p.cmple(s.hi).all());
        here.filter(move |s| s.holds(p))
            .map(move |s| (s.at.z + s.rise.dot(p - s.at.truncate()), s.rise))
    }

    /// How far a ridge of this height runs on until another roof covers it, or until that roof is highest.
    fn run(&self, n: usize, at: DVec3, way: DVec3, height: f64) -> f64 {
        let way = way.truncate().normalize_or_zero();
        let (mut best, mut far) = (at.z, PACE);
        let steps = (FARTHEST / PACE) as u32;
        for i in 1..=steps {
            let distance = PACE * f64::from(i);
            let heights = self.over(n, at.truncate() + way * distance).map(|(z, _)| z);
            let Some(z) = heights.reduce(f64::max) else {
                break;
            };
            if z > best {
                (best, far) = (z, distance);
            }
            if z > at.z + height {
                break;
            }
        }
        far
    }
}

impl Slope {
    /// Whether a place in plan lies on it.
    fn holds(&self, p: DVec2) -> bool {
        let next = self.plan.iter().cycle().skip(1);
        let mut sides = self.plan.iter().zip(next);
        sides.all(|(a, b)| (*b - *a).perp_dot(p - *a) >= -1e-9)
    }
}

/// Whether a roof has hidden sides: where it meets something.
fn has_joints(roof: &Roof) -> bool {
    let faces = roof.solids.iter().flat_map(|s| &s.faces);
    let mut joints = faces.filter(|f| f.finish == Finish::Plaster);
    joints.next().is_some()
}
