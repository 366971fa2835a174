//! The faces of a house's roofs that a purlin below them may touch.

use glam::{DVec2, DVec3};
use hsd_ir::building::{Face, HouseRoofs, Solid};

/// Every face that looks down and is not nearly vertical.
pub(super) struct Undersides(Vec<Underside>);

struct Underside {
    /// Its bounding box.
    lo: DVec3,
    hi: DVec3,
    /// Its plane: the height at the plan's origin, and the slope along x and y.
    height: f64,
    rise: DVec2,
    /// Corners in plan, clockwise since it looks down.
    corners: Vec<DVec2>,
}

impl Undersides {
    pub(super) fn of(roofs: &HouseRoofs) -> Undersides {
        let solids = roofs.roofs.iter().flat_map(|r| &r.solids);
        let faces = solids.flat_map(|s| s.faces.iter().filter_map(|f| Underside::of(s, f)));
        Undersides(faces.collect())
    }

    /// Returns the lowest underside over a place, between two heights.
    pub(super) fn lowest(&self, p: DVec2, low: f64, high: f64) -> Option<f64> {
        let near = self.0.iter().filter(|u| u.hi.z > low && u.lo.z < high);
        let heights = near.filter_map(|u| u.over(p));
        heights.filter(|z| *z > low && *z < high).reduce(f64::min)
    }
}

impl Underside {
    fn of(solid: &Solid, face: &Face) -> Option<Underside> {
        let corner = |i: &u32| solid.points.get(*i as usize).copied();
        let corners = || face.corners.iter().filter_map(corner);
        let first = corners().next()?;
        let ways = || corners().map(|p| p - first);
        let normal: DVec3 = ways().zip(ways().skip(1)).map(|(p, q)| p.cross(q)).sum();
        if normal.z >= -0.1 * normal.length() {
            return None;
        }
        let rise = -normal.truncate() / normal.z;
        Some(Underside {
            lo: corners().reduce(DVec3::min)?,
            hi: corners().reduce(DVec3::max)?,
            height: first.z - rise.dot(first.truncate()),
            rise,
            corners: corners().map(DVec3::truncate).collect(),
        })
    }

    /// Returns its height over a place that it covers, metres.
    fn over(&self, p: DVec2) -> Option<f64> {
        let beside = |axis: usize| p[axis] < self.lo[axis] - 1e-6 || p[axis] > self.hi[axis] + 1e-6;
        if beside(0) || beside(1) {
            return None;
        }
        let n = self.corners.len();
        let inside = (0..n).all(|i| {
            let (a, b) = (self.corners[i], self.corners[(i + 1) % n]);
            (b - a).perp_dot(p - a) <= 1e-9
        });
        inside.then(|| self.height + self.rise.dot(p))
    }
}
