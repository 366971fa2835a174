//! Checks of shapes: bodies, bounds, faces that fight for the same depth.
#![allow(unreachable_pub)]

use glam::{DVec2, DVec3, dvec2};
use hsd::scene::{Mesh, NodeId, Scene};
use std::collections::BTreeMap;

/// Three corners in metres.
pub type Triangle = [DVec3; 3];

/// A triangle with the number of its material.
pub type Skin = (Triangle, u32);

/// Every triangle of a mesh with its material.
pub fn skins(mesh: &Mesh) -> Vec<Skin> {
    let all = mesh.primitives.iter().flat_map(|p| {
        let at = |i: u32| DVec3::from_array(p.positions[i as usize].map(f64::from));
        let of = move |t: &[u32]| ([at(t[0]), at(t[1]), at(t[2])], p.material.0);
        p.indices.chunks(3).map(of)
    });
    all.collect()
}

/// Every triangle of a mesh.
pub fn triangles(mesh: &Mesh) -> Vec<Triangle> {
    skins(mesh).into_iter().map(|(t, _)| t).collect()
}

/// Every triangle below a node, in the node's frame.
pub fn skins_below(scene: &Scene, root: NodeId) -> Vec<Skin> {
    placed(scene, Some(root))
}

/// Every triangle of a scene.
pub fn skins_of(scene: &Scene) -> Vec<Skin> {
    placed(scene, None)
}

fn placed(scene: &Scene, root: Option<NodeId>) -> Vec<Skin> {
    let mut all = vec![];
    for node in &scene.nodes {
        let mut chain = vec![];
        let mut above = Some(node);
        let mut found = false;
        while let Some(here) = above {
            chain.push(here);
            found |= here.parent == root;
            above = here
                .parent
                .filter(|_| !found)
                .map(|p| &scene.nodes[p.0 as usize]);
        }
        let (true, Some(mesh)) = (found, node.mesh) else {
            continue;
        };
        let place = |p: DVec3| {
            chain
                .iter()
                .fold(p, |p, n| n.turn.rotate(p.truncate()).extend(p.z) + n.at)
        };
        let own = skins(&scene.meshes[mesh.0 as usize]);
        all.extend(own.into_iter().map(|(t, m)| (t.map(place), m)));
    }
    all
}

/// Smallest and largest corner.
pub fn bounds(triangles: &[Triangle]) -> (DVec3, DVec3) {
    let points = triangles.iter().flatten();
    points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(lo, hi), p| {
        (lo.min(*p), hi.max(*p))
    })
}

/// Bodies that hang together by their corners.
pub fn bodies(triangles: &[Triangle]) -> Vec<Vec<Triangle>> {
    type Corner = [i64; 3];
    let key = |p: DVec3| p.to_array().map(|x| (x * 1e5).round() as i64);
    fn root(of: &BTreeMap<Corner, Corner>, mut c: Corner) -> Corner {
        while of[&c] != c {
            c = of[&c];
        }
        c
    }
    let mut of: BTreeMap<Corner, Corner> = BTreeMap::new();
    for t in triangles {
        for p in t {
            of.entry(key(*p)).or_insert(key(*p));
        }
        for p in &t[1..] {
            let (a, b) = (root(&of, key(t[0])), root(&of, key(*p)));
            of.insert(a, b);
        }
    }
    let mut bodies: BTreeMap<Corner, Vec<Triangle>> = BTreeMap::new();
    for t in triangles {
        bodies.entry(root(&of, key(t[0]))).or_default().push(*t);
    }
    bodies.into_values().collect()
}

/// Width, depth and height of each body, millimetres.
pub fn sizes(triangles: &[Triangle]) -> Vec<[f64; 3]> {
    let size = |b: &Vec<Triangle>| {
        let (lo, hi) = bounds(b);
        ((hi - lo) * 1000.0).to_array()
    };
    bodies(triangles).iter().map(size).collect()
}

/// Planes so near, in metres, that a viewer takes one for the other.
pub const SAME_DEPTH: f64 = 3e-4;

/// Overlaps smaller than this, square metres, are seen by nobody.
const SEEN: f64 = 4e-6;

/// Where two faces of unlike materials that look the same way lie in one plane, one over the other, and can be seen: not within
/// other bodies, and not the upper ends of walls, which roofs and storeys cover.
pub fn fights(skins: &[Skin], top: f64) -> Vec<String> {
    let triangles: Vec<Triangle> = skins.iter().map(|s| s.0).collect();
    let triangles = &triangles[..];
    let mut planes: BTreeMap<[i64; 3], Vec<(f64, usize)>> = BTreeMap::new();
    for (i, [a, b, c]) in triangles.iter().enumerate() {
        let normal = (*b - *a).cross(*c - *a).normalize_or_zero();
        let key = normal.to_array().map(|x| (x * 500.0).round() as i64);
        planes.entry(key).or_default().push((normal.dot(*a), i));
    }
    let mut found = vec![];
    for plane in planes.values_mut() {
        plane.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (k, (depth, i)) in plane.iter().enumerate() {
            let near = plane[k + 1..]
                .iter()
                .take_while(|(d, _)| d - depth < SAME_DEPTH);
            for (_, j) in near.filter(|(_, j)| skins[*i].1 != skins[*j].1) {
                if let Some((p, _)) = overlap(&triangles[*i], &triangles[*j]) {
                    let [a, b, c] = triangles[*i];
                    let out = (b - a).cross(c - a).normalize_or_zero();
                    let covered = out.z > 0.99 && p.z > top - 2e-3;
                    if !covered && !is_inside(triangles, p + out * 1e-3) {
                        let mm = (p * 1000.0).round();
                        found.push(format!("at {mm} towards {:.2}", out));
                    }
                }
            }
        }
    }
    found
}

/// The middle and the area of what two triangles of one plane share, where it is large enough to see.
pub fn overlap(a: &Triangle, b: &Triangle) -> Option<(DVec3, f64)> {
    let normal = (a[1] - a[0]).cross(a[2] - a[0]).normalize_or_zero();
    let right = normal.any_orthonormal_vector();
    let up = normal.cross(right);
    let flat = |p: DVec3| dvec2(right.dot(p - a[0]), up.dot(p - a[0]));
    let mut shared: Vec<DVec2> = b.map(flat).to_vec();
    let knife = a.map(flat);
    for i in 0..3 {
        let (p, q) = (knife[i], knife[(i + 1) % 3]);
        let side = |x: DVec2| (q - p).perp_dot(x - p);
        let mut kept = vec![];
        for (k, &x) in shared.iter().enumerate() {
            let y = shared[(k + 1) % shared.len()];
            let (sx, sy) = (side(x), side(y));
            if sx >= 0.0 {
                kept.push(x);
            }
            if (sx > 0.0 && sy < 0.0) || (sx < 0.0 && sy > 0.0) {
                kept.push(x.lerp(y, sx / (sx - sy)));
            }
        }
        shared = kept;
        if shared.len() < 3 {
            return None;
        }
    }
    let next = shared.iter().cycle().skip(1);
    let area: f64 = shared.iter().zip(next).map(|(p, q)| p.perp_dot(*q)).sum();
    let middle = shared.iter().sum::<DVec2>() / shared.len() as f64;
    // Neighbours may share a hundredth of a millimetre where lengths are rounded.
    let longest = shared
        .iter()
        .map(|p| p.distance(middle))
        .fold(0.0, f64::max);
    let area = area.abs() / 2.0;
    let wide = area / longest > SAME_DEPTH;
    let seen = (area > SEEN && wide).then(|| a[0] + right * middle.x + up * middle.y);
    seen.map(|at| (at, area))
}

/// Whether a point lies inside closed bodies: what leaves them more often than it enters.
fn is_inside(triangles: &[Triangle], p: DVec3) -> bool {
    // A ray may graze an edge; three do not.
    let ways = [
        [0.137, 0.211, 0.968],
        [-0.31, 0.173, 0.88],
        [0.093, -0.27, -0.91],
    ];
    let votes = ways
        .iter()
        .filter(|w| exits(triangles, p, DVec3::from_array(**w)) > 0);
    votes.count() > 1
}

/// How often a ray leaves bodies less how often it enters them.
fn exits(triangles: &[Triangle], p: DVec3, way: DVec3) -> i32 {
    let mut exits = 0;
    for [a, b, c] in triangles {
        let (e, f) = (*b - *a, *c - *a);
        let h = way.cross(f);
        let det = e.dot(h);
        if det.abs() < 1e-14 {
            continue;
        }
        let s = p - *a;
        let u = s.dot(h) / det;
        let q = s.cross(e);
        let v = way.dot(q) / det;
        if u >= 0.0 && v >= 0.0 && u + v <= 1.0 && f.dot(q) / det > 0.0 {
            exits += if det < 0.0 { 1 } else { -1 };
        }
    }
    exits
}
