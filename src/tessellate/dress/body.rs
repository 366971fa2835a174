//! Closed bodies between sections: boards, caps and tiles of any bend.

use super::super::mesh::{Soup, grain_along};
use super::super::polygon;
use crate::building::Corners;
use crate::material::SurfaceId;
use glam::DVec3;

/// Quads that leave their plane by more than this are divided, metres.
const PLANE: f64 = 1e-7;

/// Faces that bend less than this to each other, in the cosine, are shaded as one curve on soft bodies.
const SOFT: f64 = 0.6;

/// A closed body in one surface.
#[derive(Clone, Debug)]
pub(in crate::tessellate) struct Body {
    /// What it shows.
    pub(in crate::tessellate) finish: SurfaceId,
    /// Whether its sides are shaded as curves where they bend little.
    pub(in crate::tessellate) soft: bool,
    /// Shared corners, metres.
    pub(in crate::tessellate) points: Vec<DVec3>,
    /// Plane faces, counter-clockwise seen from outside.
    pub(in crate::tessellate) faces: Vec<Corners>,
}

impl Body {
    /// What lies between sections of equally many corners, closed at both ends. Sections are plane, all run the
    /// same way round, either; nothing where the whole has no volume.
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

    /// The same where the last section goes on in the first: a ring without ends.
    pub(super) fn ring(finish: SurfaceId, sections: &[Vec<DVec3>]) -> Option<Body> {
        let n = sections.iter().map(Vec::len).min()?;
        if n < 3 || sections.len() < 3 {
            return None;
        }
        Body::between(finish, sections, n, true).outward()
    }

    /// The sides between sections.
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
            points,
            faces,
        }
    }

    /// The body with its faces outward; nothing where it has no volume.
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

    /// A plane section swept along a straight way.
    pub(super) fn sweep(finish: SurfaceId, section: Vec<DVec3>, way: DVec3) -> Option<Body> {
        let end = section.iter().map(|p| *p + way).collect();
        Body::loft(finish, &[section, end])
    }

    /// The same with its sides shaded as curves.
    pub(super) fn softly(mut self) -> Body {
        self.soft = true;
        self
    }

    /// Six times its volume.
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

    /// Its triangles.
    pub(super) fn pour(&self, soup: &mut Soup) {
        let grain = grain_along(self.finish);
        let corners = |face: &Corners| -> Vec<DVec3> {
            face.iter().map(|i| self.points[*i as usize]).collect()
        };
        if !self.soft {
            self.faces
                .iter()
                .for_each(|f| soup.face(&corners(f), grain));
            return;
        }
        let faces: Vec<Vec<DVec3>> = self.faces.iter().map(corners).collect();
        let normals: Vec<DVec3> = faces.iter().map(|f| polygon::normal(f)).collect();
        let mut beside: Vec<Vec<u32>> = vec![vec![]; self.points.len()];
        for (n, face) in self.faces.iter().enumerate() {
            face.iter().for_each(|i| beside[*i as usize].push(n as u32));
        }
        for (n, face) in self.faces.iter().enumerate() {
            let shade = |i: &u32| -> DVec3 {
                let near = beside[*i as usize].iter().map(|m| normals[*m as usize]);
                let alike = near.filter(|normal| normal.dot(normals[n]) > SOFT);
                alike.sum::<DVec3>().normalize_or_zero()
            };
            let shades: Vec<DVec3> = face.iter().map(shade).collect();
            soup.shaded(&faces[n], &shades, grain);
        }
    }
}

/// A face of four corners, in two where it is bent; corners that coincide are one.
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
