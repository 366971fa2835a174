//! Closed bodies lofted between sections: boards, caps and curved tiles.

use crate::mesh::polygon;
use crate::mesh::{Soup, axes, grain_along, lies};
use glam::{DVec2, DVec3, dvec2};
use hsd_ir::building::Corners;
use hsd_ir::material::SurfaceId;

/// Quads that deviate from a plane by more than this are split, metres.
const PLANE: f64 = 1e-7;

/// Faces at less than this angle are shaded as one curve on smooth bodies, as a cosine.
const SOFT: f64 = 0.6;

/// A closed body in one surface.
#[derive(Clone, Debug)]
pub(crate) struct Body {
    /// Its surface.
    pub(crate) finish: SurfaceId,
    /// True if its sides are shaded as curves where they meet at small angles.
    pub(crate) soft: bool,
    /// Shared corners, metres.
    pub(crate) points: Vec<DVec3>,
    /// Plane faces, counter-clockwise seen from outside: the sides, the ends, then those of what was added to it.
    pub(crate) faces: Vec<Corners>,
    /// Number of points in a section, and in all sections.
    pub(super) round: u32,
    pub(super) lofted: usize,
    /// Number of faces that are sides.
    pub(super) sides: usize,
    /// The name of its row, and the direction that is to the right in the whole row, unit length; `None` if it is not
    /// part of a row.
    pub(super) row: Option<(&'static str, DVec2)>,
}

impl Body {
    /// Lofts between sections with equal numbers of corners, closed at both ends. Sections are plane and share one
    /// orientation, whichever; `None` if the body has no volume.
    pub(super) fn loft(finish: SurfaceId, sections: &[Vec<DVec3>]) -> Option<Body> {
        let n = sections.iter().map(Vec::len).min()?;
        if n < 3 || sections.len() < 2 {
            return None;
        }
        let count = n as u32;
        let last = count * (sections.len() as u32 - 1);
        let mut body = Body::between(finish, sections, n, false);
        body.faces.push((0..count).rev().collect());
        body.faces.push((last..last + count).collect());
        body.outward()
    }

    /// As [`Body::loft`], with the last section connected to the first: a ring without ends.
    pub(super) fn ring(finish: SurfaceId, sections: &[Vec<DVec3>]) -> Option<Body> {
        let n = sections.iter().map(Vec::len).min()?;
        if n < 3 || sections.len() < 3 {
            return None;
        }
        Body::between(finish, sections, n, true).outward()
    }

    /// Builds the sides between sections.
    fn between(finish: SurfaceId, sections: &[Vec<DVec3>], n: usize, round: bool) -> Body {
        let mut points = Vec::with_capacity(n * sections.len());
        points.extend(sections.iter().flat_map(|s| &s[..n]));
        let (count, all) = (n as u32, sections.len() as u32);
        let pieces = if round { all } else { all - 1 };
        let mut faces: Vec<Corners> = Vec::with_capacity(n * pieces as usize + 2);
        for s in 0..pieces {
            for i in 0..count {
                let j = (i + 1) % count;
                let (p, q) = (s * count, (s + 1) % all * count);
                quad(&points, [p + i, p + j, q + j, q + i], &mut faces);
            }
        }
        Body {
            finish,
            soft: false,
            lofted: points.len(),
            points,
            round: count,
            sides: faces.len(),
            faces,
            row: None,
        }
    }

    /// Returns the body with its faces outwards; `None` if it has no volume.
    fn outward(mut self) -> Option<Body> {
        let volume = self.volume();
        if volume.abs() < 1e-9 || !volume.is_finite() {
            return None;
        }
        if volume < 0.0 {
            self.faces.iter_mut().for_each(|f| f.reverse());
        }
        Some(self)
    }

    /// Sweeps a plane section along a straight line.
    pub(super) fn sweep(finish: SurfaceId, section: Vec<DVec3>, way: DVec3) -> Option<Body> {
        let end = section.iter().map(|p| *p + way).collect();
        Body::loft(finish, &[section, end])
    }

    /// Returns the body with its sides shaded as curves.
    pub(super) fn smooth(mut self) -> Body {
        self.soft = true;
        self
    }

    /// Returns the body as one of a row whose bodies have this direction to their right.
    pub(super) fn in_row(mut self, name: &'static str, right: DVec2) -> Body {
        self.row = Some((name, right));
        self
    }

    /// Returns the body together with another one of its surface, which is shaded as it is.
    pub(super) fn and(mut self, other: &Body) -> Body {
        let before = self.points.len() as u32;
        self.points.extend(&other.points);
        let moved = |face: &Corners| face.iter().map(|i| i + before).collect();
        self.faces.extend(other.faces.iter().map(moved));
        self
    }

    /// Returns six times its volume.
    fn volume(&self) -> f64 {
        let Some(apex) = self.points.first() else {
            return 0.0;
        };
        let at = |i: u32| self.points[i as usize] - *apex;
        let fans = self.faces.iter().flat_map(|f| {
            let fan = 1..f.len() - 1;
            fan.map(|i| at(f[0]).dot(at(f[i]).cross(at(f[i + 1]))))
        });
        fans.sum()
    }

    /// Adds its triangles. Face corners with equal normals and texture coordinates share a vertex.
    pub(crate) fn pour(&self, soup: &mut Soup) {
        let shapes: Vec<Vec<DVec3>> = self.faces.iter().map(|f| self.corners(f)).collect();
        let normals: Vec<DVec3> = shapes.iter().map(|s| polygon::normal(s)).collect();
        let shades = Shades::of(self, &normals);
        let unrolled = if self.soft { self.unrolled() } else { vec![] };
        let grain = grain_along(self.finish);
        let mut made: Vec<Vec<u32>> = vec![vec![]; self.points.len()];
        for (n, face) in self.faces.iter().enumerate() {
            // What was added lies on the last end and has its picture.
            let front = if n > self.sides + 1 {
                self.sides + 1
            } else {
                n
            };
            let planar = planar(&shapes[n], normals[front], grain);
            let mut ids: Corners = Corners::new();
            for (k, point) in face.iter().enumerate() {
                let uv = unrolled.get(n).map_or(planar[k], |face| face[k]);
                let (normal, uv) = (
                    shades.at(n, *point).as_vec3().to_array(),
                    uv.as_vec2().to_array(),
                );
                let same = |id: &&u32| {
                    let i = **id as usize;
                    soup.normals[i] == normal && soup.uvs[i] == uv
                };
                let known = made[*point as usize].iter().find(same).copied();
                ids.push(known.unwrap_or_else(|| {
                    let id = soup.positions.len() as u32;
                    soup.positions.push(shapes[n][k].as_vec3().to_array());
                    soup.normals.push(normal);
                    soup.uvs.push(uv);
                    made[*point as usize].push(id);
                    id
                }));
            }
            polygon::triangulate(&shapes[n], normals[n], |triangle| {
                soup.indices.extend(triangle.map(|i| ids[i as usize]));
            });
        }
    }

    fn corners(&self, face: &Corners) -> Vec<DVec3> {
        face.iter().map(|i| self.points[*i as usize]).collect()
    }

    /// Returns texture coordinates of the sides of a smooth body: around its sections, and along it. The remaining
    /// faces are its ends.
    fn unrolled(&self) -> Vec<Vec<DVec2>> {
        let n = self.round as usize;
        if n == 0 {
            return vec![];
        }
        let all = self.lofted / n;
        let lengths = |count: usize, at: &dyn Fn(usize) -> DVec3| -> Vec<f64> {
            let mut sum = 0.0;
            let steps = (0..count).map(|i| {
                sum += at(i).distance(at(i + 1));
                sum
            });
            std::iter::once(0.0).chain(steps).collect()
        };
        let across = lengths(n, &|i| self.points[i % n]);
        let along = lengths(all, &|s| self.points[s % all * n]);
        let side = |face: &Corners| -> Vec<DVec2> {
            let has = |i: usize| face.iter().any(|p| *p as usize % n == i);
            let on = |s: usize| face.iter().any(|p| *p as usize / n == s);
            // The last side of a section ends where the first begins, and so does the last section of a ring.
            let (round, over) = (has(0) && has(n - 1), on(0) && on(all - 1) && all > 2);
            let place = |p: &u32| {
                let (s, i) = (*p as usize / n, *p as usize % n);
                dvec2(
                    across[if i == 0 && round { n } else { i }],
                    along[if s == 0 && over { all } else { s }],
                )
            };
            face.iter().map(place).collect()
        };
        let mut sides: Vec<Vec<DVec2>> = self.faces[..self.sides].iter().map(side).collect();
        // Pictures are not to be seen from behind.
        if sides
            .first()
            .is_some_and(|s| hsd_base::geometry::area2(s) < 0.0)
        {
            sides.iter_mut().flatten().for_each(|uv| uv.x = -uv.x);
        }
        sides
    }
}

/// Returns texture coordinates of a plane face.
fn planar(corners: &[DVec3], normal: DVec3, grain: bool) -> Vec<DVec2> {
    let (right, up) = axes(normal);
    let flat = |p: &DVec3| dvec2(right.dot(*p), up.dot(*p));
    let turned = grain && lies(corners.iter().map(flat));
    let place = |p: &DVec3| {
        let uv = flat(p);
        if turned { dvec2(-uv.y, uv.x) } else { uv }
    };
    corners.iter().map(place).collect()
}

/// Computes the normals of a body's corners, face by face.
struct Shades<'a> {
    normals: &'a [DVec3],
    /// The faces at each point; empty on bodies with hard edges.
    beside: Vec<Vec<u32>>,
}

impl Shades<'_> {
    fn of<'a>(body: &Body, normals: &'a [DVec3]) -> Shades<'a> {
        let mut beside = vec![];
        if body.soft {
            beside = vec![vec![]; body.points.len()];
            for (n, face) in body.faces.iter().enumerate() {
                face.iter().for_each(|i| beside[*i as usize].push(n as u32));
            }
        }
        Shades { normals, beside }
    }

    fn at(&self, face: usize, point: u32) -> DVec3 {
        let own = self.normals[face];
        let Some(near) = self.beside.get(point as usize) else {
            return own;
        };
        let near = near.iter().map(|m| self.normals[*m as usize]);
        let alike = near.filter(|normal| normal.dot(own) > SOFT);
        alike.sum::<DVec3>().normalize_or(own)
    }
}

/// Adds a face of four corners, split in two if it is not plane; coincident corners are merged.
fn quad(points: &[DVec3], corners: [u32; 4], faces: &mut Vec<Corners>) {
    let [a, b, c, d] = corners.map(|i| points[i as usize]);
    let normal = (c - a).cross(d - b).normalize_or_zero();
    if normal.dot(b - a).abs() < PLANE && normal.dot(c - a).abs() < PLANE {
        faces.push(Corners::from_slice(&corners));
        return;
    }
    let [i, j, k, l] = corners;
    faces.push(Corners::from_slice(&[i, j, k]));
    faces.push(Corners::from_slice(&[i, k, l]));
}
