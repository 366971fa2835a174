//! Closed solids from an upper surface: the surface, the same lowered by a drop, sides between.
//!
//! [`sheet`] takes any number of convex plan polygons, each under its plane. Where polygons share
//! only a part of an edge, the corners of one are put into the edge of the other, and the polygon
//! is divided so that every face stays strictly convex. Faces connected through edges become
//! one solid; edges of one polygon alone become its sides.

mod near;

use crate::facet::{Convex, Corner, area};
use crate::frame::Plane;
pub(crate) use crate::solid::sheet::near::Sorted;
use glam::{DVec2, DVec3};
use hsd_base::geometry::tolerance::{CUT, HEIGHT};
use hsd_ir::building::{Corners, Face, Finish, Solid};
use smallvec::SmallVec;

/// The finishes of a sheet's faces.
#[derive(Clone, Copy, Debug)]
pub struct Coat {
    /// From above.
    pub top: Finish,
    /// On rims: eaves and verges.
    pub rim: Finish,
    /// On joints with other roofs and walls, mostly hidden.
    pub joint: Finish,
    /// From below.
    pub soffit: Finish,
}

/// A polygon of the upper surface with its plane.
pub type Piece = (Convex, Plane);

/// Returns the closed solids under these pieces, `drop` metres thick measured vertically. Solids that are nowhere
/// higher than `floor` are left out: they are eaves without their roof.
pub fn sheet(pieces: &[Piece], drop: f64, coat: &Coat, floor: f64) -> Vec<Solid> {
    let mut mesh = Mesh::of(pieces);
    if mesh.is_gable() {
        let both: Vec<usize> = (0..mesh.faces.len()).collect();
        return mesh.close(&both, drop, coat);
    }
    if mesh.faces.len() > 1 {
        mesh.conform();
    }
    mesh.components()
        .into_iter()
        .filter(|faces| mesh.reaches(faces) > floor)
        .flat_map(|faces| mesh.close(&faces, drop, coat))
        .collect()
}

/// Returns the upper surface from which a slab was made, and its thickness; none for solids without a covering.
pub(crate) fn surface(solid: &Solid) -> Option<(Vec<Piece>, f64)> {
    let covering = |f: &&Face| matches!(f.finish, Finish::Covering(_));
    let first = solid.faces.iter().find(covering)?;
    let point = |id: u32| solid.points.get(id as usize).copied();
    let id = *first.corners.first()?;
    // Each point is followed by the one below it.
    let drop = point(id)?.z - point(id + 1)?.z;
    let edges = solid
        .faces
        .iter()
        .filter(|f| matches!(f.finish, Finish::Edge(_)));
    let mut rims: Vec<[u32; 2]> = edges.map(|f| [f.corners[1], f.corners[0]]).collect();
    rims.sort_unstable();
    let piece = |face: &Face| {
        let ids = &face.corners;
        let next = ids.iter().cycle().skip(1);
        let corner = |(p, q): (&u32, &u32)| Corner {
            at: solid.points[*p as usize].truncate(),
            rim: rims.binary_search(&[*p, *q]).is_ok(),
        };
        let outline: Convex = ids.iter().zip(next).map(corner).collect();
        let points = || ids.iter().map(|i| solid.points[*i as usize]);
        Some((outline, Plane::around(points())?))
    };
    let pieces = solid.faces.iter().filter(covering).filter_map(piece);
    Some((pieces.collect(), drop))
}

/// A face of the mesh: point indices, each with true if the edge that starts there is a rim.
type Loop = SmallVec<[(u32, bool); 8]>;

#[derive(Default)]
struct Mesh {
    points: Vec<DVec3>,
    faces: Vec<Loop>,
}

impl Mesh {
    fn of(pieces: &[Piece]) -> Mesh {
        let mut mesh = Mesh::default();
        let mut weld = Weld::of(pieces);
        for (outline, plane) in pieces {
            let mut face = Loop::new();
            for corner in outline {
                let at = corner.at.extend(plane.at(corner.at));
                let id = weld.id(at, &mut mesh.points);
                match face.last() {
                    Some(&(last, _)) if last == id => face.pop(),
                    _ => None,
                };
                face.push((id, corner.rim));
            }
            if face.len() > 1 && face[0].0 == face[face.len() - 1].0 {
                face.pop();
            }
            if face.len() > 2 {
                mesh.faces.push(face);
            }
        }
        mesh
    }

    /// Returns true for a plain gable, two quadrilaterals that share an edge; its corners match already.
    fn is_gable(&self) -> bool {
        let [first, second] = &self.faces[..] else {
            return false;
        };
        let edge = |face: &Loop, i: usize| (face[i].0, face[(i + 1) % 4].0);
        let shared =
            |i: usize| (0..4).any(|j| edge(second, j) == (edge(first, i).1, edge(first, i).0));
        first.len() == 4 && second.len() == 4 && self.points.len() == 6 && (0..4).any(shared)
    }

    /// Inserts corners into the edges they lie on, then divides faces that got straight corners.
    fn conform(&mut self) {
        let sorted = Sorted::of(&self.points);
        let faces = std::mem::take(&mut self.faces);
        for face in faces {
            let whole = self.with_corners(&face, &sorted);
            if whole.len() == face.len() {
                self.faces.push(whole);
            } else {
                self.divide(whole);
            }
        }
    }

    fn plan(&self, id: u32) -> DVec2 {
        self.points[id as usize].truncate()
    }

    fn with_corners(&self, face: &Loop, sorted: &Sorted) -> Loop {
        let mut whole = Loop::new();
        let mut on: Vec<(f64, u32)> = vec![];
        for (i, &(from, rim)) in face.iter().enumerate() {
            let to = face[(i + 1) % face.len()].0;
            whole.push((from, rim));
            on.clear();
            let (p, q) = (self.plan(from), self.plan(to));
            let (lo, hi) = (p.min(q) - CUT, p.max(q) + CUT);
            let way = (q - p).normalize_or_zero();
            let (foot, rise) = (self.points[from as usize].z, self.rise(from, to));
            for &(_, id) in sorted.near(lo, hi) {
                let r = self.plan(id);
                let off = r.x < lo.x || r.x > hi.x || r.y < lo.y || r.y > hi.y;
                if off || id == from || id == to {
                    continue;
                }
                let at = way.dot(r - p);
                let level = (foot + rise * at - self.points[id as usize].z).abs() < HEIGHT;
                if level && way.perp_dot(r - p).abs() < CUT {
                    on.push((at, id));
                }
            }
            on.sort_by(|a, b| a.0.total_cmp(&b.0));
            on.iter().for_each(|(_, id)| whole.push((*id, rim)));
        }
        whole
    }

    /// Returns the rise per metre in plan between two points.
    fn rise(&self, from: u32, to: u32) -> f64 {
        let way = self.points[to as usize] - self.points[from as usize];
        way.z / way.truncate().length()
    }

    /// Returns true if `j` lies off the straight line from `i` to `k`.
    fn turns(&self, i: u32, j: u32, k: u32) -> bool {
        let (p, q, r) = (self.plan(i), self.plan(j), self.plan(k));
        let way = (r - p).normalize_or_zero();
        way.perp_dot(q - p).abs() > CUT
    }

    /// Divides a convex face with straight corners into strictly convex ones.
    fn divide(&mut self, face: Loop) {
        let n = face.len();
        let id = |i: usize| face[i % n].0;
        let straight = |i: usize| !self.turns(id(i + n - 1), id(i), id(i + 1));
        let Some(from) = (0..n).find(|i| straight(*i)) else {
            return self.faces.push(face);
        };
        // Another straight corner opposite makes the best cut: both vanish at once.
        let across = |i: &usize| self.turns(id(from), id(from + 1), id(*i)) && *i != from;
        let ahead = (from + 2..from + n - 1).map(|i| i % n);
        let best = ahead.clone().filter(across).find(|i| straight(*i));
        let Some(to) = best.or_else(|| ahead.clone().find(across)) else {
            return;
        };
        let (lo, hi) = (from.min(to), from.max(to));
        let mut first = Loop::from_slice(&face[lo..=hi]);
        let mut second: Loop = face[hi..].iter().chain(&face[..=lo]).copied().collect();
        for half in [&mut first, &mut second] {
            if let Some(last) = half.last_mut() {
                last.1 = false;
            }
        }
        self.divide(first);
        self.divide(second);
    }

    /// Returns every edge as (its ends ascending, its face, its index there), sorted.
    fn edges(&self) -> Vec<(u32, u32, u32, u32)> {
        let mut edges = Vec::with_capacity(self.faces.len() * 4);
        for (f, face) in self.faces.iter().enumerate() {
            let face = &face[..];
            for (i, &(p, _)) in face.iter().enumerate() {
                let q = face.get(i + 1).unwrap_or(&face[0]).0;
                edges.push((p.min(q), p.max(q), f as u32, i as u32));
            }
        }
        edges.sort_unstable();
        edges
    }

    /// Returns faces connected through edges, as components in the order of their first face.
    fn components(&self) -> Vec<Vec<usize>> {
        if self.faces.len() == 1 {
            return vec![vec![0]];
        }
        let mut root: Vec<usize> = (0..self.faces.len()).collect();
        for pair in self.edges().windows(2) {
            if (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1) {
                let (a, b) = (
                    find(&mut root, pair[0].2 as usize),
                    find(&mut root, pair[1].2 as usize),
                );
                root[a.max(b)] = a.min(b);
            }
        }
        let mut groups: Vec<Vec<usize>> = vec![Vec::new(); self.faces.len()];
        for f in 0..self.faces.len() {
            let of = find(&mut root, f);
            groups[of].push(f);
        }
        groups.retain(|g| !g.is_empty());
        groups
    }

    fn reaches(&self, faces: &[usize]) -> f64 {
        let corners = faces.iter().flat_map(|f| &self.faces[*f]);
        corners
            .map(|(id, _)| self.points[*id as usize].z)
            .fold(f64::MIN, f64::max)
    }

    /// Returns the closed solid of one component; one for each face if it touches itself in a corner, since vertical
    /// edges would belong to four sides there.
    fn close(&self, faces: &[usize], drop: f64, coat: &Coat) -> Vec<Solid> {
        let rims = self.rims(faces);
        if faces.len() > 1 && touches_itself(&rims) {
            return faces
                .iter()
                .flat_map(|f| self.close(&[*f], drop, coat))
                .collect();
        }
        vec![self.solid(faces, &rims, drop, coat)]
    }

    /// Returns the edges of these faces that no other of them shares: from, to, true for a rim.
    fn rims(&self, faces: &[usize]) -> Vec<(u32, u32, bool)> {
        let mut edges = Vec::with_capacity(faces.len() * 4);
        for f in faces {
            let face = &self.faces[*f][..];
            for (i, &(p, rim)) in face.iter().enumerate() {
                let q = face.get(i + 1).unwrap_or(&face[0]).0;
                edges.push((p.min(q), p.max(q), p, rim));
            }
        }
        edges.sort_unstable();
        let mut rims = Vec::with_capacity(edges.len());
        let mut i = 0;
        while i < edges.len() {
            let (lo, hi, from, rim) = edges[i];
            if edges.get(i + 1).is_some_and(|e| (e.0, e.1) == (lo, hi)) {
                i += 2;
                continue;
            }
            rims.push((from, if from == lo { hi } else { lo }, rim));
            i += 1;
        }
        rims
    }

    fn solid(&self, faces: &[usize], rims: &[(u32, u32, bool)], drop: f64, coat: &Coat) -> Solid {
        let (points, number) = self.doubled(faces, drop);
        let mut all = Vec::with_capacity(faces.len() * 2 + rims.len());
        let top = |id: &u32| number[*id as usize];
        let mut face = |corners: Corners, finish: Finish| all.push(Face { corners, finish });
        for f in faces {
            let face_of = &self.faces[*f][..];
            let (mut upper, mut lower) = (Corners::new(), Corners::new());
            face_of.iter().for_each(|(id, _)| upper.push(top(id)));
            (face_of.iter().rev()).for_each(|(id, _)| lower.push(top(id) + 1));
            face(upper, coat.top);
            face(lower, coat.soffit);
        }
        for (from, to, rim) in rims {
            let (p, q) = (top(from), top(to));
            face(
                Corners::from_slice(&[q, p, p + 1, q + 1]),
                if *rim { coat.rim } else { coat.joint },
            );
        }
        Solid { points, faces: all }
    }

    /// Returns the points of some faces, each followed by the one below it, and their new numbers.
    fn doubled(&self, faces: &[usize], drop: f64) -> (Vec<DVec3>, Vec<u32>) {
        let mut number = vec![u32::MAX; self.points.len()];
        let mut points = Vec::with_capacity(self.points.len() * 2);
        for (id, _) in faces.iter().flat_map(|f| &self.faces[*f]) {
            let place = &mut number[*id as usize];
            if *place == u32::MAX {
                *place = points.len() as u32;
                let top = self.points[*id as usize];
                points.extend([top, top - DVec3::Z * drop]);
            }
        }
        (points, number)
    }
}

/// Returns true if a border passes through a point twice.
fn touches_itself(rims: &[(u32, u32, bool)]) -> bool {
    let mut starts: Vec<u32> = rims.iter().map(|(p, _, _)| *p).collect();
    starts.sort_unstable();
    starts.windows(2).any(|w| w[0] == w[1])
}

pub(crate) fn find(root: &mut [usize], mut n: usize) -> usize {
    while root[n] != n {
        root[n] = root[root[n]];
        n = root[n];
    }
    n
}

/// Numbers corners, equal ones alike.
struct Weld {
    /// All corners sorted by x, with the number once they have one; `None` while there are few.
    sorted: Option<Vec<(DVec3, u32)>>,
}

impl Weld {
    fn of(pieces: &[Piece]) -> Weld {
        let count: usize = pieces.iter().map(|p| p.0.len()).sum();
        let sorted = (count > 64).then(|| {
            let corners = pieces.iter().flat_map(|p| p.0.iter().map(|c| (c.at, &p.1)));
            let point = |(at, plane): (DVec2, &Plane)| (at.extend(plane.at(at)), u32::MAX);
            let mut all: Vec<(DVec3, u32)> = corners.map(point).collect();
            all.sort_by(|p, q| p.0.x.total_cmp(&q.0.x).then(p.0.y.total_cmp(&q.0.y)));
            all
        });
        Weld { sorted }
    }

    /// Returns the number of a corner, adding new ones with their height.
    fn id(&mut self, at: DVec3, points: &mut Vec<DVec3>) -> u32 {
        let same = |p: DVec3| (p - at).abs().cmplt(DVec3::new(CUT, CUT, HEIGHT)).all();
        let known = match &mut self.sorted {
            None => points.iter().position(|p| same(*p)).map(|n| n as u32),
            Some(sorted) => {
                let start = sorted.partition_point(|p| p.0.x <= at.x - CUT);
                let near = sorted[start..]
                    .iter_mut()
                    .take_while(|p| p.0.x < at.x + CUT);
                let mut equal: Vec<&mut u32> =
                    near.filter(|p| same(p.0)).map(|p| &mut p.1).collect();
                let known = equal.iter().map(|n| **n).find(|n| *n != u32::MAX);
                let id = known.unwrap_or(points.len() as u32);
                equal.iter_mut().for_each(|n| **n = id);
                known
            }
        };
        known.unwrap_or_else(|| {
            points.push(at);
            points.len() as u32 - 1
        })
    }
}

/// Returns true if an outline has enough area for a face.
pub(crate) fn has_area(outline: &[Corner]) -> bool {
    area(outline) > 1e-6
}

#[cfg(test)]
mod tests {
    use crate::solid::sheet::*;
    use glam::dvec2;
    use hsd_ir::check::solid_flaws;

    const COAT: Coat = Coat {
        top: Finish::Plaster,
        rim: Finish::Plaster,
        joint: Finish::Plaster,
        soffit: Finish::Soffit,
    };

    fn square(x0: f64, y0: f64, x1: f64, y1: f64) -> Piece {
        let corners = [dvec2(x0, y0), dvec2(x1, y0), dvec2(x1, y1), dvec2(x0, y1)];
        (
            corners
                .iter()
                .map(|at| Corner { at: *at, rim: true })
                .collect(),
            Plane::level(3.0),
        )
    }

    #[test]
    fn corners_in_mid_edge_make_no_crack() {
        let pieces = [
            square(0.0, 0.0, 4.0, 2.0),
            square(0.0, 2.0, 1.0, 3.0),
            square(1.0, 2.0, 4.0, 4.0),
        ];
        let solids = sheet(&pieces, 0.1, &COAT, 0.0);
        assert_eq!(solids.len(), 1);
        assert_eq!(solid_flaws(&solids[0]).collect::<Vec<_>>(), vec![]);
    }

    #[test]
    fn corners_at_one_place_are_one() {
        let plain = square(0.0, 0.0, 4.0, 2.0);
        let mut doubled = plain.clone();
        doubled.0.insert(1, plain.0[1]);
        doubled.0.push(plain.0[0]);
        let solids = |piece| format!("{:?}", sheet(&[piece], 0.1, &COAT, 0.0));
        assert_eq!(solids(doubled), solids(plain));
    }

    #[test]
    fn pieces_that_touch_in_a_corner_are_two_solids() {
        let pieces = [square(0.0, 0.0, 1.0, 1.0), square(1.0, 1.0, 2.0, 2.0)];
        assert_eq!(sheet(&pieces, 0.1, &COAT, 0.0).len(), 2);
        let ring = [
            square(0.0, 0.0, 1.0, 1.0),
            square(1.0, 1.0, 2.0, 2.0),
            square(0.0, 1.0, 1.0, 2.0),
        ];
        for solid in sheet(&ring, 0.1, &COAT, 0.0) {
            assert_eq!(solid_flaws(&solid).count(), 0);
        }
    }

    #[test]
    fn a_hole_is_walled_too() {
        let ring = [
            square(0.0, 0.0, 3.0, 1.0),
            square(0.0, 2.0, 3.0, 3.0),
            square(0.0, 1.0, 1.0, 2.0),
            square(2.0, 1.0, 3.0, 2.0),
        ];
        let solids = sheet(&ring, 0.1, &COAT, 0.0);
        assert_eq!(solids.len(), 1);
        assert_eq!(solid_flaws(&solids[0]).count(), 0);
    }

    #[test]
    fn eaves_without_a_roof_fall_away() {
        let pieces = [square(0.0, 0.0, 1.0, 1.0)];
        assert!(sheet(&pieces, 0.1, &COAT, 3.0).is_empty());
    }
}
