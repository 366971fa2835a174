//! Gable infills where roofs meet: a gable wall is cut by the roofs of its neighbours and by their infills.
//!
//! A neighbour's slab that passes through a gable wall is built in: the wall ends under it and continues over it. If two
//! walls stand back to back on one line, that of the earlier roof is built and the other adds what extends beyond it.
//! All parts are convex, so that cutting is clipping by planes.

use crate::solid::SUNK;
use crate::solid::{clip, columns};
use glam::{DVec2, DVec3};
use hsd_base::geometry::tolerance::HEIGHT;
use hsd_ir::building::{Face, Finish, Solid};
use smallvec::SmallVec;

/// Overlaps of two solids below this volume stay, cubic metres: they touch.
const TOUCH: f64 = 1e-7;
/// Remains of a wall below this volume are left out, cubic metres.
const CHIP: f64 = 2e-5;

/// One roof of a group before it becomes solids.
pub(crate) struct Built {
    /// Its closed slabs.
    pub(crate) sheets: Vec<Solid>,
    /// Vertical thickness, metres.
    pub(crate) drop: f64,
    /// Gable infills and brackets under them.
    pub(crate) fills: Vec<Solid>,
}

/// A convex body as the intersection of half-spaces: outward normals, and their distances.
struct Body {
    planes: SmallVec<[(DVec3, f64); 8]>,
    lo: DVec3,
    hi: DVec3,
}

impl Body {
    /// Returns true if all these points lie beyond one of its planes, as for most bodies nearby.
    fn is_apart(&self, points: &[DVec3]) -> bool {
        let mut planes = self.planes.iter();
        planes.any(|(normal, at)| points.iter().all(|p| normal.dot(*p) - at > -HEIGHT))
    }
}

/// Cuts the gable walls of every roof by the slabs of the others and by the walls of those before it.
pub(crate) fn fit(roofs: &mut [Built]) {
    let mut walls = roofs.iter().flat_map(|r| &r.fills);
    if roofs.len() < 2 || !walls.any(is_wall) {
        return;
    }
    let sheets: Vec<Vec<Body>> = roofs.iter().map(bodies).collect();
    let boxes: Vec<(DVec3, DVec3)> = sheets.iter().map(|s| around(s)).collect();
    let mut standing: Vec<Body> = vec![];
    for (n, roof) in roofs.iter_mut().enumerate() {
        let mut built = vec![];
        for fill in std::mem::take(&mut roof.fills) {
            if !is_wall(&fill) {
                built.push(fill);
                continue;
            }
            let (lo, hi) = bounds(&fill.points);
            let others = (0..sheets.len()).filter(|i| *i != n && meets(boxes[*i], (lo, hi)));
            let near = others.flat_map(|i| &sheets[i]).chain(&standing);
            let near: Vec<&Body> = near.filter(|b| meets((b.lo, b.hi), (lo, hi))).collect();
            built.extend(left(fill, &near));
        }
        standing.extend(
            built
                .iter()
                .filter(|f| is_wall(f))
                .flat_map(columns)
                .map(of),
        );
        roof.fills = built;
    }
}

fn is_wall(fill: &Solid) -> bool {
    fill.faces.iter().all(|f| f.finish == Finish::Gable)
}

/// Returns the parts of an infill outside the bodies; the whole infill if none of them cuts it.
fn left(fill: Solid, near: &[&Body]) -> Vec<Solid> {
    let whole = columns(&fill);
    let mut parts = whole.clone();
    let mut cut = false;
    for body in near {
        let mut rest = Vec::with_capacity(parts.len());
        for part in parts {
            match outside(&part, body) {
                Some(pieces) => {
                    cut = true;
                    rest.extend(pieces);
                }
                None => rest.push(part),
            }
        }
        parts = rest;
    }
    if cut { parts } else { vec![fill] }
}

/// Returns the convex parts of a convex solid outside a body; `None` if they hardly touch.
fn outside(part: &Solid, body: &Body) -> Option<Vec<Solid>> {
    if !meets(bounds(&part.points), (body.lo, body.hi)) || body.is_apart(&part.points) {
        return None;
    }
    let mut inside = part.clone();
    let mut off = vec![];
    for &(normal, at) in &body.planes {
        // Most planes of a body miss the remaining part.
        if inside.points.iter().all(|p| normal.dot(*p) - at < HEIGHT) {
            continue;
        }
        off.extend(clip(&inside, -normal, -at));
        inside = clip(&inside, normal, at)?;
    }
    (volume(&inside) > TOUCH).then(|| {
        off.retain(|p| volume(p) > CHIP);
        off
    })
}

/// Divides the slabs of a roof into convex bodies, one under each face of its upper surface. Infills may penetrate
/// slightly from above and below.
fn bodies(roof: &Built) -> Vec<Body> {
    let sunk = SUNK.min(roof.drop / 4.0);
    let faces = |s: &Solid| -> Vec<Body> {
        let tops = s.faces.iter();
        let tops = tops.filter(|f| matches!(f.finish, Finish::Covering(_)));
        tops.filter_map(|f| below(s, f, roof.drop, sunk)).collect()
    };
    roof.sheets.iter().flat_map(faces).collect()
}

/// Returns the body under a face of the upper surface.
fn below(solid: &Solid, face: &Face, drop: f64, sunk: f64) -> Option<Body> {
    let points: SmallVec<[DVec3; 6]> = corners(solid, face).collect();
    let normal = outward(&points)?;
    if normal.z < 1e-3 {
        return None;
    }
    let at = normal.dot(points[0]);
    let mut planes = SmallVec::new();
    planes.push((normal, at - sunk * normal.z));
    planes.push((-normal, (drop - sunk) * normal.z - at));
    for (i, p) in points.iter().enumerate() {
        let way = (points[(i + 1) % points.len()] - *p).truncate();
        let side: DVec2 = -way.try_normalize()?.perp();
        planes.push((side.extend(0.0), side.dot(p.truncate())));
    }
    let (lo, hi) = bounds(&points);
    Some(Body {
        planes,
        lo: lo - DVec3::Z * drop,
        hi,
    })
}

/// Converts a convex solid to a body.
fn of(solid: Solid) -> Body {
    let plane = |face: &Face| {
        let points: SmallVec<[DVec3; 6]> = corners(&solid, face).collect();
        outward(&points).map(|normal| (normal, normal.dot(points[0])))
    };
    let (lo, hi) = bounds(&solid.points);
    Body {
        planes: solid.faces.iter().filter_map(plane).collect(),
        lo,
        hi,
    }
}

fn corners<'s>(solid: &'s Solid, face: &'s Face) -> impl Iterator<Item = DVec3> + 's {
    face.corners.iter().map(|c| solid.points[*c as usize])
}

fn outward(points: &[DVec3]) -> Option<DVec3> {
    let mut sum = DVec3::ZERO;
    for w in points.windows(2) {
        sum += (w[0] - points[0]).cross(w[1] - points[0]);
    }
    sum.try_normalize()
}

fn volume(solid: &Solid) -> f64 {
    let Some(from) = solid.points.first() else {
        return 0.0;
    };
    let of = |face: &Face| -> f64 {
        let at = |c: u32| solid.points[c as usize] - *from;
        let corners = &face.corners[..];
        let first = corners.first().map_or(DVec3::ZERO, |c| at(*c));
        let fan = corners.windows(2);
        fan.fold(0.0_f64, |sum, w| sum + first.dot(at(w[0]).cross(at(w[1]))))
    };
    solid.faces.iter().map(of).sum::<f64>() / 6.0
}

fn bounds(points: &[DVec3]) -> (DVec3, DVec3) {
    let none = (DVec3::MAX, DVec3::MIN);
    points
        .iter()
        .fold(none, |(lo, hi), p| (lo.min(*p), hi.max(*p)))
}

fn around(bodies: &[Body]) -> (DVec3, DVec3) {
    let none = (DVec3::MAX, DVec3::MIN);
    bodies
        .iter()
        .fold(none, |(lo, hi), b| (lo.min(b.lo), hi.max(b.hi)))
}

fn meets(one: (DVec3, DVec3), other: (DVec3, DVec3)) -> bool {
    one.0.cmplt(other.1).all() && other.0.cmplt(one.1).all()
}
