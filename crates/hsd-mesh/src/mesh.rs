//! Closed bodies from polygons: boxes, prisms, polyhedra. Every face is flat, has its own vertices, a unit
//! normal, and texture coordinates in metres.

pub(crate) mod lathe;
pub(crate) mod panel;
pub(crate) mod polygon;
pub(crate) mod smooth;

use crate::mesh::panel::{Panel, Rect};
use glam::{DVec2, DVec3, dvec2, dvec3};
use hsd_ir::material::SurfaceId;
use smallvec::SmallVec;

/// Triangles of one surface, before it has a material in the scene.
#[derive(Clone, Debug, Default)]
pub(super) struct Soup {
    pub(super) positions: Vec<[f32; 3]>,
    pub(super) normals: Vec<[f32; 3]>,
    pub(super) uvs: Vec<[f32; 2]>,
    pub(super) indices: Vec<u32>,
    /// The number of triangles that were left out, since a part of a house has fewer.
    pub(super) left_out: usize,
}

/// Bodies under construction: one soup per surface, in the order of first use.
#[derive(Clone, Debug, Default)]
pub(super) struct Bodies {
    pub(super) soups: Vec<(SurfaceId, Soup)>,
    /// Panels to be baked to images.
    pub(super) panels: Vec<Panel>,
    /// The faces that show the part's texture.
    pub(super) shown: Soup,
    /// The box around those that are only measured, its least and its greatest corner, if nobody will ask for more than
    /// the extent of these bodies.
    pub(super) measured: Option<[[f32; 3]; 2]>,
}

/// The most triangles of a surface of a part: 230 MiB while its lists grow.
const MOST_TRIANGLES: usize = 1 << 21;

/// Bodies thinner than this are left out, metres.
pub(super) const THIN: f64 = 1e-3;

impl Soup {
    /// Returns both as one.
    pub(super) fn joined(mut self, other: Soup) -> Soup {
        let first = self.positions.len() as u32;
        self.positions.extend(other.positions);
        self.normals.extend(other.normals);
        self.uvs.extend(other.uvs);
        self.indices.extend(other.indices.iter().map(|i| i + first));
        self.left_out += other.left_out;
        self
    }
}

impl Bodies {
    /// Returns the soup of a surface.
    pub(super) fn soup(&mut self, finish: SurfaceId) -> &mut Soup {
        let at = self.soups.iter().position(|(f, _)| *f == finish);
        let at = at.unwrap_or_else(|| {
            self.soups.push((finish, Soup::default()));
            self.soups.len() - 1
        });
        &mut self.soups[at].1
    }

    /// Adds a box between two corners; nothing if it is too thin to see.
    pub(super) fn block(&mut self, finish: SurfaceId, lo: DVec3, hi: DVec3) {
        if (hi - lo).min_element() < THIN {
            return;
        }
        let outline = [
            dvec2(lo.x, lo.y),
            dvec2(hi.x, lo.y),
            dvec2(hi.x, hi.y),
            dvec2(lo.x, hi.y),
        ];
        self.prism(finish, &outline, Axis::Z, lo.z, hi.z);
    }

    /// Adds a polygon extruded along an axis, in either orientation. Its corners are (x, y) for z, (y, z) for x, (z, x)
    /// for y.
    pub(super) fn prism(
        &mut self,
        finish: SurfaceId,
        outline: &[DVec2],
        axis: Axis,
        lo: f64,
        hi: f64,
    ) {
        let at = |p: DVec2, t: f64| axis.at(p, t);
        let area = hsd_base::geometry::area2(outline);
        if self.measured.is_some() && area.abs() > THIN * THIN && (hi - lo).abs() > THIN {
            return outline
                .iter()
                .for_each(|p| self.cover(&[at(*p, lo), at(*p, hi)]));
        }
        let mut outline: SmallVec<[DVec2; 8]> = SmallVec::from_slice(outline);
        if area < 0.0 {
            outline.reverse();
        }
        let n = outline.len();
        let top: SmallVec<[DVec3; 8]> = outline.iter().map(|p| at(*p, hi)).collect();
        let foot: SmallVec<[DVec3; 8]> = outline.iter().rev().map(|p| at(*p, lo)).collect();
        let side = |i: usize| {
            let (p, q) = (outline[i], outline[(i + 1) % n]);
            [at(p, lo), at(q, lo), at(q, hi), at(p, hi)]
        };
        if self.measured.is_some() {
            self.cover_face(&top);
            self.cover_face(&foot);
            return (0..n).for_each(|i| self.cover_face(&side(i)));
        }
        let grain = grain_along(finish);
        let soup = self.soup(finish);
        soup.reserve(6 * n, 12 * n);
        soup.face(&top, grain);
        soup.face(&foot, grain);
        (0..n).for_each(|i| soup.face(&side(i), grain));
    }

    /// Adds a plane polygon extruded along a vector, in either orientation. With `round`, sides that meet at less than
    /// 60 degrees are shaded as one curve.
    pub(super) fn slide(&mut self, finish: SurfaceId, ring: &[DVec3], way: DVec3, round: bool) {
        let mut ring = ring.to_vec();
        if polygon::normal(&ring).dot(way) < 0.0 {
            ring.reverse();
        }
        let n = ring.len();
        let grain = grain_along(finish);
        let soup = self.soup(finish);
        let top: Vec<DVec3> = ring.iter().map(|p| *p + way).collect();
        let foot: Vec<DVec3> = ring.iter().rev().copied().collect();
        soup.face(&top, grain);
        soup.face(&foot, grain);
        let side = |i: usize| {
            (ring[(i + 1) % n] - ring[i % n])
                .cross(way)
                .normalize_or_zero()
        };
        for i in 0..n {
            let (p, q) = (ring[i], ring[(i + 1) % n]);
            let own = side(i);
            let shade = |other: DVec3| match round && own.dot(other) > 0.5 {
                true => (own + other).normalize_or_zero(),
                false => own,
            };
            let (before, after) = (shade(side(i + n - 1)), shade(side(i + 1)));
            let corners = [p, q, q + way, p + way];
            soup.shaded(&corners, &[before, after, after, before], grain);
        }
    }

    /// Adds a plane polygon with one normal per corner, counter-clockwise seen from outside.
    pub(super) fn shaded(&mut self, finish: SurfaceId, corners: &[DVec3], normals: &[DVec3]) {
        if self.measured.is_some() {
            return self.cover_face(corners);
        }
        let grain = grain_along(finish);
        self.soup(finish).shaded(corners, normals, grain);
    }

    /// Adds a plane polygon, counter-clockwise seen from outside.
    pub(super) fn face(&mut self, finish: SurfaceId, corners: &[DVec3]) {
        if self.measured.is_some() {
            return self.cover_face(corners);
        }
        let grain = grain_along(finish);
        self.soup(finish).face(corners, grain);
    }

    /// Lets the bodies that follow be measured only.
    pub(super) fn measure(&mut self) {
        self.measured = Some([[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]]);
    }

    /// Grows the box around bodies that are only measured.
    fn cover(&mut self, points: &[DVec3]) {
        let Some([lo, hi]) = &mut self.measured else {
            return;
        };
        for p in points.iter().map(|p| p.as_vec3().to_array()) {
            *lo = std::array::from_fn(|k| lo[k].min(p[k]));
            *hi = std::array::from_fn(|k| hi[k].max(p[k]));
        }
    }

    /// Covers a face, unless it has no area and would be left out.
    fn cover_face(&mut self, corners: &[DVec3]) {
        if polygon::normal(corners) != DVec3::ZERO {
            self.cover(corners);
        }
    }
}

/// The axis of an extrusion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Axis {
    X,
    Y,
    Z,
}

impl Axis {
    /// Returns the point of an extruded polygon at distance `t` along the axis.
    pub(super) fn at(self, p: DVec2, t: f64) -> DVec3 {
        match self {
            Axis::X => dvec3(t, p.x, p.y),
            Axis::Y => dvec3(p.y, t, p.x),
            Axis::Z => dvec3(p.x, p.y, t),
        }
    }
}

/// Returns true if the texture has a grain that runs along a member.
pub(super) fn grain_along(finish: SurfaceId) -> bool {
    finish.surface().grain()
}

impl Soup {
    /// Creates an empty one with room for faces of four corners.
    pub(super) fn with_room_for(faces: usize) -> Soup {
        let mut soup = Soup::default();
        soup.reserve(4 * faces, 6 * faces);
        soup
    }

    /// Makes room for vertices and indices at once.
    fn reserve(&mut self, vertices: usize, indices: usize) {
        if self.indices.len() > 3 * MOST_TRIANGLES {
            return;
        }
        self.positions.reserve(vertices);
        self.normals.reserve(vertices);
        self.uvs.reserve(vertices);
        self.indices.reserve(indices);
    }

    /// Adds a plane polygon as triangles. With `grain`, the texture's v axis follows the longer side.
    pub(super) fn face(&mut self, corners: &[DVec3], grain: bool) {
        self.shaded(corners, &[], grain);
    }

    /// As [`Soup::face`], with the direction up the texture where it is another than up the face.
    pub(super) fn covering(
        &mut self,
        corners: &[DVec3],
        up: impl Fn(DVec3) -> Option<DVec3>,
        grain: bool,
    ) {
        let normal = polygon::normal(corners);
        if normal != DVec3::ZERO {
            let along = |up: DVec3| (-up.truncate().perp().normalize_or_zero().extend(0.0), up);
            let ways = up(normal).map_or_else(|| axes(normal), along);
            self.laid(corners, &[], (normal, ways), grain);
        }
    }

    /// As [`Soup::face`], with one normal per corner; with none, corners take the normal of the face.
    pub(super) fn shaded(&mut self, corners: &[DVec3], normals: &[DVec3], grain: bool) {
        let normal = polygon::normal(corners);
        if normal != DVec3::ZERO {
            self.laid(corners, normals, (normal, axes(normal)), grain);
        }
    }

    /// Adds a plane polygon with these directions of its texture.
    fn laid(
        &mut self,
        corners: &[DVec3],
        normals: &[DVec3],
        (normal, (right, up)): (DVec3, (DVec3, DVec3)),
        grain: bool,
    ) {
        if self.indices.len() > 3 * MOST_TRIANGLES {
            self.left_out += corners.len().saturating_sub(2);
            return;
        }
        let flat = |p: &DVec3| dvec2(right.dot(*p), up.dot(*p));
        let turned = grain && lies(corners.iter().map(flat));
        let first = self.positions.len() as u32;
        let small = normal.as_vec3().to_array();
        let uv = |corner: &DVec3| {
            let uv = flat(corner);
            // A quarter turn, not a mirror image: the picture's normals keep their sense.
            let uv = if turned { dvec2(-uv.y, uv.x) } else { uv };
            uv.as_vec2().to_array()
        };
        self.positions
            .extend(corners.iter().map(|p| p.as_vec3().to_array()));
        match normals.is_empty() {
            true => self
                .normals
                .extend(std::iter::repeat_n(small, corners.len())),
            false => self
                .normals
                .extend(normals.iter().map(|n| n.as_vec3().to_array())),
        }
        self.uvs.extend(corners.iter().map(uv));
        polygon::triangulate(corners, normal, |triangle| {
            self.indices.extend(triangle.map(|i| first + i));
        });
    }
}

impl Soup {
    /// Adds a rectangle that faces out of the house, `front` metres outside the centre line; `uv` gives its lower left
    /// and upper right corners in the image.
    pub(super) fn front(&mut self, rect: Rect, front: f64, uv: [[f32; 2]; 2]) {
        let first = self.positions.len() as u32;
        let corners = [
            (rect.x0, rect.z0, uv[0][0], uv[0][1]),
            (rect.x1, rect.z0, uv[1][0], uv[0][1]),
            (rect.x1, rect.z1, uv[1][0], uv[1][1]),
            (rect.x0, rect.z1, uv[0][0], uv[1][1]),
        ];
        for (x, z, u, v) in corners {
            self.positions
                .push(dvec3(x, -front, z).as_vec3().to_array());
            self.normals.push([0.0, -1.0, 0.0]);
            self.uvs.push([u, v]);
        }
        let quad = [0, 1, 2, 0, 2, 3];
        self.indices.extend(quad.map(|i: u32| first + i));
    }
}

/// Returns the texture axes of a face: right along its horizontal, and up its slope; x and y on level faces.
pub(super) fn axes(normal: DVec3) -> (DVec3, DVec3) {
    let level = dvec2(normal.x, normal.y).length();
    if level < 1e-6 {
        return (DVec3::X, DVec3::Y * normal.z.signum());
    }
    let right = dvec3(-normal.y / level, normal.x / level, 0.0);
    (right, normal.cross(right))
}

/// Returns true if points spread farther in x than in y.
pub(super) fn lies(points: impl Iterator<Item = DVec2>) -> bool {
    let (mut lo, mut hi) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for p in points {
        lo = lo.min(p);
        hi = hi.max(p);
    }
    let size = hi - lo;
    size.x > size.y
}
