//! Finds what lies beyond the joints of a roof: another slope that rises from them, or a wall. Roofs share a mesh only
//! if this is equal as well, so it is determined before the trim.

use crate::trim::seams::{Beyond, End, Kind};
use crate::trim::surface::Surface;
use glam::{DVec2, DVec3};
use hsd_ir::building::{Finish, HouseRoofs, Roof};

/// Houses with more facets than this keep plain joints, to bound the running time.
const MANY: usize = 3000;
/// Horizontal distance beyond a joint at which its neighbour is sought, and the vertical tolerance, metres.
const STEP: f64 = 0.02;
const APART: f64 = 0.04;
/// The longest extension of a ridge into another roof, and the step of the search, metres.
const FARTHEST: f64 = 1.5;
const PACE: f64 = 0.05;

/// The slopes of all roofs of a house.
#[derive(Debug, Default)]
pub(crate) struct Neighbours {
    slopes: Vec<Slope>,
    /// The coverings of the roofs.
    surfaces: Vec<Surface>,
}

/// One facet: its roof, position, outline in plan, a point and its rise.
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
    /// Collects the slopes of the roofs of one house; none if no roof has a joint (the upper gable and the skirt of an
    /// irimoya are one roof), or if there are too many.
    pub(crate) fn of(roofs: &HouseRoofs) -> Neighbours {
        let mut all = Neighbours::default();
        if !roofs.roofs.iter().any(has_joints) {
            return all;
        }
        for (n, surface) in roofs.surfaces().iter().enumerate() {
            let surface = Surface::of(surface);
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

    /// Returns the surroundings of the joints of one roof.
    pub(crate) fn beyond(&self, n: usize, roof: &Roof) -> Beyond {
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
        let height = roof.trim.ridge_height(roof.kind);
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

    /// Returns heights and rises of the other roofs over a point in plan.
    fn over(&self, n: usize, p: DVec2) -> impl Iterator<Item = (f64, DVec2)> + '_ {
        let slopes = self.slopes.iter().filter(move |s| s.roof != n);
        let here = slopes.filter(move |s| s.lo.cmple(p).all() && p.cmple(s.hi).all());
        here.filter(move |s| s.holds(p))
            .map(move |s| (s.at.z + s.rise.dot(p - s.at.truncate()), s.rise))
    }

    /// Returns how far a ridge of this height extends until another roof covers it, or until that roof is highest.
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
    /// Returns true if it contains a point in plan.
    fn holds(&self, p: DVec2) -> bool {
        let next = self.plan.iter().cycle().skip(1);
        let mut sides = self.plan.iter().zip(next);
        sides.all(|(a, b)| (*b - *a).perp_dot(p - *a) >= -1e-9)
    }
}

/// Returns true if a roof has hidden sides, where it meets something.
fn has_joints(roof: &Roof) -> bool {
    let faces = roof.solids.iter().flat_map(|s| &s.faces);
    let mut joints = faces.filter(|f| f.finish == Finish::Plaster);
    joints.next().is_some()
}
