//! Converts faces on numbered points to closed solids.

use crate::solid::massive::merge::{BENT, Polygon, merge};
use crate::solid::sheet::find;
use glam::{DVec2, DVec3};
use hsd_base::geometry::tolerance::STRAIGHT;
use hsd_base::geometry::triangulate::ears;
use hsd_ir::building::{Corners, Face, Solid};

/// Returns the closed solids that some faces bound. Points over one place have numbers in ascending order from one of
/// `starts` on; vertical edges pass through those between their ends. None if an edge belongs to more than two faces of
/// a solid.
pub(super) fn solids(
    points: Vec<DVec3>,
    starts: &[u32],
    mut faces: Vec<Polygon>,
) -> Option<Vec<Solid>> {
    let mut used = vec![false; points.len()];
    for id in faces.iter().flat_map(|f| &f.0) {
        used[*id as usize] = true;
    }
    let place = |id: u32| starts.partition_point(|s| *s <= id);
    for (corners, _) in &mut faces {
        pass_through(corners, &used, place);
    }
    faces.retain(|f| f.0.len() > 2);
    merge(&points, &mut faces);
    straighten(&points, &mut faces);
    let faces: Vec<Polygon> = faces
        .into_iter()
        .filter(|f| f.0.len() > 2)
        .flat_map(|f| flat(&points, f))
        .collect();
    bounded(&points, faces)
}

/// Returns the closed solids that some faces bound, those closed on all sides inwards left out; none if an edge belongs
/// to more than two faces of a solid.
pub(super) fn bounded(points: &[DVec3], faces: Vec<Polygon>) -> Option<Vec<Solid>> {
    let of = components(points.len(), &faces)?;
    let count = of.iter().max().map_or(0, |n| n + 1);
    let mut solids = vec![Solid::default(); count];
    if let [only] = &mut solids[..] {
        only.points.reserve(points.len());
        only.faces.reserve(faces.len());
    }
    let mut numbers = vec![(usize::MAX, 0); points.len()];
    for ((mut corners, finish), n) in faces.into_iter().zip(of) {
        let solid = &mut solids[n];
        let mut number = |id: u32| {
            let known = &mut numbers[id as usize];
            if known.0 != n {
                let point = points[id as usize];
                // Solids that touch in a point have it twice; in most it occurs here first.
                let own = match known.0 {
                    usize::MAX => None,
                    _ => solid.points.iter().position(|p| *p == point),
                };
                let own = own.unwrap_or_else(|| {
                    solid.points.push(point);
                    solid.points.len() - 1
                });
                *known = (n, own as u32);
            }
            known.1
        };
        corners.iter_mut().for_each(|c| *c = number(*c));
        solid.faces.push(Face { corners, finish });
    }
    // Cavities closed on all sides are filled, since they are never seen; what has no volume is not seen either.
    solids.retain(|s| volume(s) > NOTHING);
    Some(solids)
}

/// Six times the least volume of a solid, cubic metres.
const NOTHING: f64 = 6e-9;

/// Returns six times the volume.
fn volume(solid: &Solid) -> f64 {
    let from = solid.points.first().copied().unwrap_or_default();
    let of = |face: &Face| -> f64 {
        let at = |c: u32| solid.points[c as usize] - from;
        let corners = &face.corners[..];
        let first = corners.first().map_or(DVec3::ZERO, |c| at(*c));
        let pairs = corners.windows(2);
        pairs.fold(0.0_f64, |sum, w| sum + first.dot(at(w[0]).cross(at(w[1]))))
    };
    solid.faces.iter().fold(0.0_f64, |sum, face| sum + of(face))
}

/// Inserts used points into the vertical edges of a face.
fn pass_through(corners: &mut Corners, used: &[bool], place: impl Fn(u32) -> usize) {
    let n = corners.len();
    let upright = |i: usize| place(corners[i]) == place(corners[(i + 1) % n]);
    if !(0..n).any(upright) {
        return;
    }
    let mut whole = Corners::with_capacity(n + 2);
    for i in 0..n {
        let (p, q) = (corners[i], corners[(i + 1) % n]);
        whole.push(p);
        if upright(i) {
            let between = |id: &u32| used[*id as usize];
            match p < q {
                true => whole.extend((p + 1..q).filter(between)),
                false => whole.extend((q + 1..p).rev().filter(between)),
            }
        }
    }
    *corners = whole;
}

/// Removes points that are the corner of no face.
fn straighten(points: &[DVec3], faces: &mut [Polygon]) {
    let mut turns = vec![false; points.len()];
    for (corners, _) in faces.iter() {
        let n = corners.len();
        for i in 0..n {
            let [p, q, r] = [i, i + 1, i + 2].map(|k| points[corners[k % n] as usize]);
            let (one, other) = ((q - p).normalize_or_zero(), (r - q).normalize_or_zero());
            turns[corners[(i + 1) % n] as usize] |=
                one.cross(other).length() > STRAIGHT || one.dot(other) <= 0.0;
        }
    }
    for (corners, _) in faces.iter_mut() {
        corners.retain(|c| turns[*c as usize]);
    }
}

/// Divides a face that welding has bent into triangles.
pub(super) fn flat(points: &[DVec3], face: Polygon) -> Vec<Polygon> {
    let (corners, finish) = &face;
    let at = |k: usize| points[corners[k] as usize] - points[corners[0] as usize];
    let fan = 1..corners.len() - 1;
    let normal: DVec3 = fan.map(|k| at(k).cross(at(k + 1))).sum();
    let unit = normal.normalize_or_zero();
    if (1..corners.len()).all(|k| unit.dot(at(k)).abs() < BENT) {
        return vec![face];
    }
    let (x, y) = unit.any_orthonormal_pair();
    let plan: Vec<DVec2> = (0..corners.len())
        .map(|k| DVec2::new(x.dot(at(k)), y.dot(at(k))))
        .collect();
    let mut triangles = Vec::with_capacity(plan.len());
    ears(&plan, |t| {
        let corners = t.map(|k| corners[k as usize]).into_iter().collect();
        triangles.push((corners, *finish));
    });
    triangles
}

/// An edge of a face from the point with the lower number: the other point, true if the face runs from the lower one to
/// it, and the face.
type Edge = (u32, bool, u32);

/// Returns the edges of all faces by their lower point, those of each sorted, and for each point where its edges end.
fn edges(points: usize, faces: &[Polygon]) -> (Vec<Edge>, Vec<u32>) {
    let mut ends = vec![0_u32; points + 1];
    each_edge(faces, |p, q, _| ends[p.min(q) as usize + 1] += 1);
    for n in 1..ends.len() {
        ends[n] += ends[n - 1];
    }
    let mut edges = vec![(0, false, 0); ends[points] as usize];
    each_edge(faces, |p, q, face| {
        let place = &mut ends[p.min(q) as usize];
        edges[*place as usize] = (p.max(q), p < q, face);
        *place += 1;
    });
    ends.pop();
    let mut first = 0;
    for end in &ends {
        edges[first..*end as usize].sort_unstable();
        first = *end as usize;
    }
    (edges, ends)
}

/// Passes on all edges: from, to, face.
fn each_edge(faces: &[Polygon], mut out: impl FnMut(u32, u32, u32)) {
    for ((corners, _), face) in faces.iter().zip(0..) {
        let corners = &corners[..];
        let Some(mut p) = corners.last().copied() else {
            continue;
        };
        for &q in corners {
            out(p, q, face);
            p = q;
        }
    }
}

/// Returns for each face the solid it belongs to, in the order of their first faces: faces are connected through edges
/// that have two of them.
fn components(points: usize, faces: &[Polygon]) -> Option<Vec<usize>> {
    let (edges, ends) = edges(points, faces);
    let mut root: Vec<usize> = (0..faces.len()).collect();
    // The edges that more than two faces share.
    let mut shared: Vec<&[Edge]> = vec![];
    let mut from = 0;
    for end in &ends {
        let mut own = &edges[from..*end as usize];
        from = *end as usize;
        while let [first, rest @ ..] = own {
            let count = 1 + rest.iter().take_while(|e| e.0 == first.0).count();
            let (edge, after) = own.split_at(count);
            own = after;
            match edge {
                [one, other] if one.1 != other.1 => {
                    let [a, b] = [one.2, other.2].map(|f| find(&mut root, f as usize));
                    root[a.max(b)] = a.min(b);
                }
                [_] | [_, _] => return None,
                edge => shared.push(edge),
            }
        }
    }
    let roots: Vec<usize> = (0..faces.len()).map(|f| find(&mut root, f)).collect();
    // Each solid may have two of the faces that share an edge.
    for edge in shared {
        let mut of: Vec<(usize, bool)> = edge.iter().map(|e| (roots[e.2 as usize], e.1)).collect();
        of.sort_unstable();
        let pair = |c: &[(usize, bool)]| matches!(c, [(a, false), (b, true)] if a == b);
        if !of.chunks(2).all(pair) || of.windows(3).any(|w| w[0].0 == w[2].0) {
            return None;
        }
    }
    let mut numbers = vec![usize::MAX; faces.len()];
    let mut next = 0;
    let number = |r: &usize| {
        if numbers[*r] == usize::MAX {
            numbers[*r] = next;
            next += 1;
        }
        numbers[*r]
    };
    Some(roots.iter().map(number).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use hsd_ir::building::Finish;

    fn faces(corners: &[[u32; 3]]) -> Vec<Polygon> {
        let face = |c: &[u32; 3]| (Corners::from_slice(c), Finish::Plaster);
        corners.iter().map(face).collect()
    }

    #[test]
    fn only_closed_faces_are_solids() {
        let one = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let other = one.map(|face| face.map(|c| c + 4));
        let both = [one, other].concat();
        assert_eq!(
            components(8, &faces(&both)),
            Some(vec![0, 0, 0, 0, 1, 1, 1, 1])
        );
        assert_eq!(components(4, &faces(&one[1..])), None, "one is missing");
        let mut turned = one;
        turned[0].swap(0, 1);
        assert_eq!(components(4, &faces(&turned)), None, "one looks inwards");
        // Two that share an edge, and a third face upon it.
        let beside = [[0, 1, 4], [1, 0, 5], [0, 4, 5], [1, 5, 4]];
        let touching = [&one[..], &beside[..]].concat();
        assert_eq!(
            components(6, &faces(&touching)),
            Some(vec![0, 0, 0, 0, 1, 1, 1, 1])
        );
        let fin = [&one[..], &[[0, 1, 4]]].concat();
        assert_eq!(components(5, &faces(&fin)), None, "a face too many");
    }
}
