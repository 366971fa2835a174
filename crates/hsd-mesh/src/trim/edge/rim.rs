//! The rim of a covering in walking order: eaves, verges and crests one after the other, with the roof on the left.

use crate::trim::body::Body;
use crate::trim::seams::REACH;
use crate::trim::surface::Surface;
use glam::{DVec2, DVec3};
use hsd_ir::material::SurfaceId;
use std::collections::BTreeMap;

/// Corners sharper than this are cut off instead of mitred, as the cosine of half their turn.
const SHARP: f64 = 0.35;

/// A section of rim without joints.
#[derive(Clone, Debug)]
pub(in crate::trim) struct Rim {
    /// Its corners on the upper surface.
    pub(in crate::trim) points: Vec<Corner>,
    /// True if it is closed.
    pub(in crate::trim) closed: bool,
}

/// A corner of a rim.
#[derive(Clone, Copy, Debug)]
pub(in crate::trim) struct Corner {
    /// Position on the upper surface, metres.
    pub(in crate::trim) at: DVec3,
    /// Outward direction in plan, scaled so that offsets of neighbours meet.
    pub(in crate::trim) out: DVec2,
    /// Depth of the covering's edge, metres.
    pub(in crate::trim) deep: f64,
}

/// Returns the rims of a covering.
pub(in crate::trim) fn rims(surface: &Surface) -> Vec<Rim> {
    let sides: Vec<(u32, u32, [f64; 2])> = surface.rim_sides().collect();
    let mut starts: BTreeMap<u32, usize> = BTreeMap::new();
    let mut entered: BTreeMap<u32, usize> = BTreeMap::new();
    for (n, (from, to, _)) in sides.iter().enumerate() {
        starts.insert(*from, n);
        entered.insert(*to, n);
    }
    let mut used = vec![false; sides.len()];
    let mut rims = Vec::new();
    // Open stretches first, so that none is begun in its middle.
    let first = |n: &usize| !entered.contains_key(&sides[*n].0);
    let (open, rest): (Vec<usize>, Vec<usize>) = (0..sides.len()).partition(first);
    for start in open.into_iter().chain(rest) {
        let mut walk = Vec::new();
        let mut now = Some(start);
        while let Some(n) = now.filter(|n| !used[*n]) {
            used[n] = true;
            walk.push(n);
            now = starts.get(&sides[n].1).copied();
        }
        let (Some(a), Some(z)) = (walk.first(), walk.last()) else {
            continue;
        };
        let closed = sides[*a].0 == sides[*z].1 && walk.len() > 2;
        rims.extend(rim(
            surface,
            walk.iter().map(|n| sides[*n]).collect(),
            closed,
        ));
    }
    rims
}

/// Returns a rim with its corners; points in the middle of an edge are left out.
fn rim(surface: &Surface, sides: Vec<(u32, u32, [f64; 2])>, closed: bool) -> Option<Rim> {
    let n = sides.len();
    let at = |id: u32| surface.points[id as usize];
    let way = |i: usize| {
        let (from, to, _) = sides[i];
        (at(to) - at(from)).normalize_or_zero()
    };
    let mut points = Vec::with_capacity(n + 1);
    let count = if closed { n } else { n + 1 };
    for i in 0..count {
        let before = match (i, closed) {
            (0, true) => n - 1,
            (0, false) => 0,
            _ => i - 1,
        };
        let after = i.min(n - 1);
        if before != after && way(before).dot(way(after)) > 1.0 - 1e-9 {
            continue;
        }
        let out = |i: usize| -way(i).truncate().perp().normalize_or_zero();
        let both = out(before) + out(after);
        let half = (both.length() / 2.0).max(SHARP);
        let (id, deep) = match i == n {
            true => (sides[n - 1].1, sides[n - 1].2[1]),
            false => (sides[i].0, sides[i].2[0]),
        };
        points.push(Corner {
            at: at(id),
            out: both.normalize_or_zero() / half,
            deep,
        });
    }
    if let (false, [first, .., last]) = (closed, &mut points[..]) {
        first.at -= way(0) * REACH;
        last.at += way(n - 1) * REACH;
    }
    (points.len() > 1).then_some(Rim { points, closed })
}

impl Rim {
    /// Sweeps a body along the rim with a profile of (out of the roof, up) for each of its corners.
    pub(in crate::trim) fn body(
        &self,
        finish: SurfaceId,
        profile: impl Fn(&Corner) -> Vec<(f64, f64)>,
    ) -> Option<Body> {
        let section = |corner: &Corner| -> Vec<DVec3> {
            let place = |(out, up): (f64, f64)| corner.at + (corner.out * out).extend(up);
            profile(corner).into_iter().map(place).collect()
        };
        let sections: Vec<Vec<DVec3>> = self.points.iter().map(section).collect();
        match self.closed {
            true => Body::ring(finish, &sections),
            false => Body::loft(finish, &sections),
        }
    }
}
