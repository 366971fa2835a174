//! Faces of unlike materials that look the same way, lie in one plane, one over the other, and can be seen: from some side one
//! looks at them over a metre.

use super::depths::{SAME_DEPTH, Skin, Triangle, overlap};
use glam::{DVec2, DVec3, dvec2};
use std::collections::{BTreeMap, HashMap};

/// The sides of cells in a plane, across a ray and in space, metres.
const CELL: f64 = 0.5;
const COLUMN: f64 = 0.25;
const ROOM: f64 = 1.0;

/// How far an eye is away at least, metres.
const REACH: f64 = 1.0;

/// Directions in which it is looked for.
const WAYS: u32 = 64;

/// A place that two faces share.
pub struct Fight {
    /// Its middle.
    pub at: DVec3,
    /// The direction in which both look.
    pub out: DVec3,
    /// Square metres.
    pub area: f64,
    /// The numbers of the triangles.
    pub pair: [usize; 2],
}

/// Finds them.
pub fn fights(skins: &[Skin]) -> Vec<Fight> {
    let mut planes: BTreeMap<[i64; 3], Vec<(f64, usize)>> = BTreeMap::new();
    let mut ground = f64::MAX;
    for (i, ([a, b, c], _)) in skins.iter().enumerate() {
        ground = ground.min(a.z).min(b.z).min(c.z);
        if let Some(normal) = (*b - *a).cross(*c - *a).try_normalize() {
            let key = normal.to_array().map(|x| (x * 500.0).round() as i64);
            planes.entry(key).or_default().push((normal.dot(*a), i));
        }
    }
    let mut found: Vec<Fight> = planes.values().flat_map(|p| shared(skins, p)).collect();
    found.sort_by_key(|f| f.pair);
    // Undersides at the ground are seen by nobody.
    found.retain(|f| f.out.z > -0.9 || f.at.z > ground + 0.3);
    let columns = Columns::of(skins);
    found.retain(|f| !columns.hold(f.at + f.out * 1e-3));
    let space = Space::of(skins);
    found.retain(|f| space.shows(f.at, f.out));
    found
}

/// What faces that look one way share.
fn shared(skins: &[Skin], plane: &[(f64, usize)]) -> Vec<Fight> {
    let [a, b, c] = skins[plane[0].1].0;
    let out = (b - a).cross(c - a).normalize();
    let right = out.any_orthonormal_vector();
    let up = out.cross(right);
    let bounds = |i: usize| {
        let flat = skins[i].0.map(|p| dvec2(right.dot(p), up.dot(p)));
        (
            flat[0].min(flat[1]).min(flat[2]),
            flat[0].max(flat[1]).max(flat[2]),
        )
    };
    let mut cells: BTreeMap<[i64; 3], Vec<usize>> = BTreeMap::new();
    for (k, (depth, i)) in plane.iter().enumerate() {
        let (lo, hi) = bounds(*i);
        let layer = cell(*depth, 0.01);
        for x in cell(lo.x, CELL)..=cell(hi.x, CELL) {
            for y in cell(lo.y, CELL)..=cell(hi.y, CELL) {
                for z in [layer, layer + 1] {
                    cells.entry([x, y, z]).or_default().push(k);
                }
            }
        }
    }
    let mut pairs: Vec<[usize; 2]> = vec![];
    for list in cells.values() {
        for (n, &i) in list.iter().enumerate() {
            for &j in &list[n + 1..] {
                let ((d, p), (e, q)) = (plane[i], plane[j]);
                let (one, other) = (bounds(p), bounds(q));
                let meet = one.0.cmplt(other.1).all() && other.0.cmplt(one.1).all();
                if (d - e).abs() < SAME_DEPTH && skins[p].1 != skins[q].1 && meet {
                    pairs.push([p.min(q), p.max(q)]);
                }
            }
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    let both = pairs.into_iter().filter_map(|pair| {
        let (at, area) = overlap(&skins[pair[0]].0, &skins[pair[1]].0)?;
        Some(Fight {
            at,
            out,
            area,
            pair,
        })
    });
    both.collect()
}

fn cell(x: f64, side: f64) -> i64 {
    (x / side).floor() as i64
}

/// Triangles by columns along each axis.
struct Columns<'s> {
    skins: &'s [Skin],
    along: [HashMap<[i64; 2], Vec<usize>>; 3],
}

impl<'s> Columns<'s> {
    fn of(skins: &'s [Skin]) -> Columns<'s> {
        let mut along: [HashMap<[i64; 2], Vec<usize>>; 3] = Default::default();
        for (i, (triangle, _)) in skins.iter().enumerate() {
            for (axis, columns) in along.iter_mut().enumerate() {
                let flat = triangle.map(|p| across(p, axis));
                let lo = flat[0].min(flat[1]).min(flat[2]);
                let hi = flat[0].max(flat[1]).max(flat[2]);
                for x in cell(lo.x, COLUMN)..=cell(hi.x, COLUMN) {
                    for y in cell(lo.y, COLUMN)..=cell(hi.y, COLUMN) {
                        columns.entry([x, y]).or_default().push(i);
                    }
                }
            }
        }
        Columns { skins, along }
    }

    /// Whether a point lies inside closed bodies: what leaves them more often than it enters, along two of three axes.
    fn hold(&self, p: DVec3) -> bool {
        // Beside the edges of triangles.
        let p = p + DVec3::new(1.3e-5, 0.7e-5, 1.1e-5);
        (0..3).filter(|axis| self.exits(p, *axis) > 0).count() > 1
    }

    fn exits(&self, p: DVec3, axis: usize) -> i32 {
        let q = across(p, axis);
        let column = self.along[axis].get(&[cell(q.x, COLUMN), cell(q.y, COLUMN)]);
        let mut exits = 0;
        for i in column.into_iter().flatten() {
            let triangle = &self.skins[*i].0;
            let flat = triangle.map(|p| across(p, axis));
            let part = |k: usize| {
                let (a, b) = (flat[(k + 1) % 3], flat[(k + 2) % 3]);
                (b - a).perp_dot(q - a)
            };
            let parts = [0, 1, 2].map(part);
            let whole: f64 = parts.iter().sum();
            if whole == 0.0 || parts.iter().any(|x| x * whole.signum() < 0.0) {
                continue;
            }
            let at: f64 = (0..3).map(|k| parts[k] * triangle[k][axis]).sum();
            if at / whole > p[axis] {
                exits += if whole > 0.0 { 1 } else { -1 };
            }
        }
        exits
    }
}

fn across(p: DVec3, axis: usize) -> DVec2 {
    match axis {
        0 => dvec2(p.y, p.z),
        1 => dvec2(p.z, p.x),
        _ => dvec2(p.x, p.y),
    }
}

/// Triangles by cells of space.
struct Space<'s> {
    skins: &'s [Skin],
    cells: HashMap<[i64; 3], Vec<usize>>,
}

impl<'s> Space<'s> {
    fn of(skins: &'s [Skin]) -> Space<'s> {
        let mut cells: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
        for (i, (t, _)) in skins.iter().enumerate() {
            let (lo, hi) = (t[0].min(t[1]).min(t[2]), t[0].max(t[1]).max(t[2]));
            for key in between(lo, hi) {
                cells.entry(key).or_default().push(i);
            }
        }
        Space { skins, cells }
    }

    /// Whether one sees a face from somewhere before it.
    fn shows(&self, at: DVec3, out: DVec3) -> bool {
        let from = at + out * 1e-3;
        let keys = between(from - REACH, from + REACH);
        let near = keys.filter_map(|key| self.cells.get(&key)).flatten();
        let mut near: Vec<usize> = near.copied().collect();
        near.sort_unstable();
        near.dedup();
        let x = out.any_orthonormal_vector();
        let y = out.cross(x);
        (0..WAYS).any(|k| {
            // Spread evenly over half a ball.
            let (k, n) = (f64::from(k), f64::from(WAYS));
            let (z, turn) = ((k + 0.5) / n, k * 2.399_963);
            let wide = (1.0 - z * z).sqrt();
            let way = x * (wide * turn.cos()) + y * (wide * turn.sin()) + out * z;
            !near.iter().any(|i| is_hit(&self.skins[*i].0, from, way))
        })
    }
}

fn between(lo: DVec3, hi: DVec3) -> impl Iterator<Item = [i64; 3]> {
    let range = |k: usize| cell(lo[k], ROOM)..=cell(hi[k], ROOM);
    let (xs, ys, zs) = (range(0), range(1), range(2));
    xs.flat_map(move |x| {
        let zs = zs.clone();
        ys.clone()
            .flat_map(move |y| zs.clone().map(move |z| [x, y, z]))
    })
}

fn is_hit([a, b, c]: &Triangle, p: DVec3, way: DVec3) -> bool {
    let (e, f) = (*b - *a, *c - *a);
    let h = way.cross(f);
    let det = e.dot(h);
    if det.abs() < 1e-14 {
        return false;
    }
    let s = p - *a;
    let q = s.cross(e);
    let (u, v, t) = (s.dot(h) / det, way.dot(q) / det, f.dot(q) / det);
    u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < REACH
}
