//! Roofs that stand in each other: how deep the slabs and gable walls of one roof reach into those of another, by convex
//! bodies cut with each other. An opinion of its own: nothing here is what the roofs are built with.

use glam::DVec3;
use hsd::building::{Face, Finish, Roof, Solid};

/// A place where two roofs stand in each other.
#[derive(Clone, Copy, Debug, Default)]
pub struct Crossing {
    /// How deep, metres.
    pub depth: f64,
    /// The two roofs.
    pub roofs: [usize; 2],
    /// True where the body of a roof is a gable wall, false for a slab.
    pub walls: [bool; 2],
    /// The middle of what they share, in the frame of the house, metres.
    pub at: DVec3,
}

/// A convex body: its faces, and their planes (outward normal, distance).
struct Body {
    is_wall: bool,
    faces: Vec<Vec<DVec3>>,
    planes: Vec<(DVec3, f64)>,
    low: DVec3,
    high: DVec3,
}

impl Body {
    fn of(faces: Vec<Vec<DVec3>>, is_wall: bool) -> Option<Body> {
        let plane = |face: &Vec<DVec3>| {
            let fan = face.windows(2);
            let sum: DVec3 = fan.map(|w| (w[0] - face[0]).cross(w[1] - face[0])).sum();
            let normal = sum.try_normalize()?;
            Some((normal, normal.dot(face[0])))
        };
        let planes: Vec<_> = faces.iter().filter_map(plane).collect();
        let points = || faces.iter().flatten().copied();
        let (low, high) = (points().reduce(DVec3::min)?, points().reduce(DVec3::max)?);
        Some(Body {
            is_wall,
            faces,
            planes,
            low,
            high,
        })
    }

    fn is_convex(&self) -> bool {
        let mut points = self.faces.iter().flatten();
        points.all(|p| self.planes.iter().all(|(n, at)| n.dot(*p) - at < 1e-4))
    }

    /// The corners of what another body's surface has inside this one.
    fn inside(&self, other: &Body) -> Vec<DVec3> {
        let mut found = vec![];
        for face in &other.faces {
            let mut left = face.clone();
            for (normal, at) in &self.planes {
                left = clipped(&left, *normal, *at);
            }
            found.extend(left);
        }
        found
    }

    /// How deep two bodies stand in each other, the least way to push them apart along one of their planes, metres; and
    /// where.
    fn crossing(&self, other: &Body) -> Option<(f64, DVec3)> {
        if self.low.cmpge(other.high).any() || other.low.cmpge(self.high).any() {
            return None;
        }
        let mut common = self.inside(other);
        common.extend(other.inside(self));
        let deep = |(normal, at): &(DVec3, f64)| {
            let depths = common.iter().map(|p| at - normal.dot(*p));
            depths.fold(0.0, f64::max)
        };
        let planes = self.planes.iter().chain(&other.planes);
        let middle = common.iter().sum::<DVec3>() / common.len() as f64;
        (!common.is_empty()).then(|| (planes.map(deep).fold(f64::MAX, f64::min), middle))
    }
}

/// The part of a polygon behind a plane.
fn clipped(polygon: &[DVec3], normal: DVec3, at: f64) -> Vec<DVec3> {
    let mut kept = vec![];
    for (k, p) in polygon.iter().enumerate() {
        let q = &polygon[(k + 1) % polygon.len()];
        let (d, e) = (normal.dot(*p) - at, normal.dot(*q) - at);
        if d <= 0.0 {
            kept.push(*p);
        }
        if d * e < 0.0 {
            kept.push(p.lerp(*q, d / (d - e)));
        }
    }
    kept
}

/// The bodies of a solid: one under each face of a covering, or the whole of a convex gable wall.
fn bodies(solid: &Solid) -> Vec<Body> {
    let points = |f: &Face| -> Vec<DVec3> {
        f.corners
            .iter()
            .map(|c| solid.points[*c as usize])
            .collect()
    };
    if solid.faces.iter().all(|f| f.finish == Finish::Gable) {
        let whole = Body::of(solid.faces.iter().map(points).collect(), true);
        return whole.into_iter().filter(Body::is_convex).collect();
    }
    let tops = solid
        .faces
        .iter()
        .filter(|f| matches!(f.finish, Finish::Covering(_)));
    let slab = |face: &Face| {
        let top = points(face);
        // The lower surface is the upper one, moved down.
        let under = |p: &DVec3| {
            let below = solid
                .points
                .iter()
                .filter(|q| q.truncate().distance(p.truncate()) < 1e-6);
            below.map(|q| q.z).fold(p.z, f64::min)
        };
        let drop = top.iter().map(|p| p.z - under(p)).fold(0.0, f64::max);
        let low: Vec<DVec3> = top.iter().map(|p| *p - DVec3::Z * drop).collect();
        let count = top.len();
        let side = |k: usize| {
            let n = (k + 1) % count;
            vec![top[n], top[k], low[k], low[n]]
        };
        let mut faces: Vec<Vec<DVec3>> = (0..count).map(side).collect();
        faces.push(low.iter().rev().copied().collect());
        faces.push(top);
        Body::of(faces, false)
    };
    tops.filter_map(slab).collect()
}

/// The deepest place where two roofs of a house stand in each other.
pub fn deepest(roofs: &[Roof]) -> Crossing {
    let bodies = |r: &Roof| -> Vec<Body> { r.solids.iter().flat_map(bodies).collect() };
    let all: Vec<Vec<Body>> = roofs.iter().map(bodies).collect();
    let mut worst = Crossing::default();
    for (n, one) in all.iter().enumerate() {
        for (m, other) in all.iter().enumerate().skip(n + 1) {
            for (p, q) in one.iter().flat_map(|p| other.iter().map(move |q| (p, q))) {
                // Gable walls of two roofs may meet at a corner.
                if p.is_wall && q.is_wall {
                    continue;
                }
                if let Some((depth, at)) = p.crossing(q).filter(|c| c.0 > worst.depth) {
                    worst = Crossing {
                        depth,
                        roofs: [n, m],
                        walls: [p.is_wall, q.is_wall],
                        at,
                    };
                }
            }
        }
    }
    worst
}
