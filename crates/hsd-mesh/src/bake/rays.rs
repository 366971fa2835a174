//! The grid of rays over a rectangle, and what each of them hits first.

use super::relief::Face;
use super::{FINE, Lens};
use crate::mesh::Soup;
use crate::mesh::panel::Rect;
use glam::{DVec2, DVec3, dvec2};
use hsd_ir::material::SurfaceId;

/// The largest size of an image in each direction, pixels; larger objects get a lower resolution.
const LARGEST: f64 = 500.0;

/// Depth below the surroundings at which darkening is strongest, metres.
const DEEP: f32 = 0.070;

/// Share of light that is left in the deepest corner.
const DARKEST: f32 = 0.45;

/// Distance between neighbours that may darken each other, rays.
const REACH: isize = 4 * FINE as isize;

/// The neighbours that darken a ray, in steps of [`REACH`] to the right and down.
const ROUND: [(isize, isize); 8] = [
    (1, 0),
    (-1, 0),
    (0, -1),
    (0, -2),
    (1, -1),
    (-1, -1),
    (0, 1),
    (0, -3),
];

/// A triangle in ray coordinates: all its attributes vary linearly with the ray's position.
#[derive(Debug)]
pub(super) struct Triangle {
    /// Index of its soup.
    pub(super) surface: usize,
    pub(super) face: Face,
    /// Texture coordinates at ray (0, 0), and their change per ray and per row.
    uv: [DVec2; 3],
}

impl Triangle {
    /// Returns the texture coordinates at a ray.
    pub(super) fn uv(&self, u: usize, v: usize) -> DVec2 {
        self.uv[0] + self.uv[1] * u as f64 + self.uv[2] * v as f64
    }
}

/// The first hit of a ray: its depth and triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hit {
    pub(super) depth: f32,
    pub(super) triangle: u32,
}

impl Hit {
    const NOTHING: Hit = Hit {
        depth: f32::INFINITY,
        triangle: u32::MAX,
    };
}

/// The grid of rays over a rectangle.
pub(super) struct Rays {
    rect: Rect,
    width: usize,
    height: usize,
    pub(super) triangles: Vec<Triangle>,
    hits: Vec<Hit>,
    pub(super) panes: bool,
    /// How far they go to the right and up on each metre into the house, metres.
    slant: DVec2,
}

impl Rays {
    /// Casts rays at soups, from straight ahead or at a slant: how far they go to the right and up on each metre into the house,
    /// metres. The hits are kept in memory that an earlier call has used.
    pub(super) fn cast(
        soups: &[(SurfaceId, Soup)],
        (rect, slant): (Rect, DVec2),
        lens: Lens,
        mut hits: Vec<Hit>,
    ) -> Rays {
        let size = |metres: f64| (metres * lens.density).ceil().clamp(1.0, LARGEST) as usize * FINE;
        let (width, height) = (size(rect.width()), size(rect.height()));
        hits.clear();
        hits.resize(width * height, Hit::NOTHING);
        let mut rays = Rays {
            rect,
            width,
            height,
            triangles: vec![],
            hits,
            panes: lens.panes,
            slant,
        };
        for (i, (_, soup)) in soups.iter().enumerate() {
            for triangle in soup.indices.chunks_exact(3) {
                rays.triangle(i, soup, [triangle[0], triangle[1], triangle[2]]);
            }
        }
        rays
    }

    /// Returns the memory of the hits, for the next image.
    pub(super) fn into_hits(self) -> Vec<Hit> {
        self.hits
    }

    /// Returns the index of the soup that each ray hits, and the ray's height as a share of the rectangle's; those that hit
    /// nothing have none.
    pub(super) fn surfaces(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.hits.iter().enumerate().filter_map(|(n, hit)| {
            let surface = self.triangles.get(hit.triangle as usize)?.surface;
            let down = (n / self.width) as f64 + 0.5;
            Some((surface, 1.0 - down / self.height as f64))
        })
    }

    /// Returns the size of the image, pixels.
    pub(super) fn pixels(&self) -> (usize, usize) {
        (self.width / FINE, self.height / FINE)
    }

    /// Returns the hit of a ray.
    pub(super) fn hit(&self, u: usize, v: usize) -> Hit {
        self.hits[v * self.width + u]
    }

    /// Returns the first hit of a pixel if all its rays hit one triangle, or nothing.
    pub(super) fn one_hit(&self, x: usize, y: usize) -> Option<Hit> {
        let first = self.hit(x * FINE, y * FINE);
        let mut rows = (0..FINE).map(|j| {
            let from = (y * FINE + j) * self.width + x * FINE;
            &self.hits[from..from + FINE]
        });
        let same = rows.all(|row| row.iter().all(|hit| hit.triangle == first.triangle));
        same.then_some(first)
    }

    /// Records the rays that hit this triangle before anything else.
    fn triangle(&mut self, surface: usize, soup: &Soup, corners: [u32; 3]) {
        let point = |i: u32| soup.positions[i as usize].map(f64::from);
        let normal = DVec3::from(soup.normals[corners[0] as usize].map(f64::from));
        // Seen edge-on or from behind.
        if normal.y + normal.x * self.slant.x + normal.z * self.slant.y > -1e-6 {
            return;
        }
        let p = corners.map(|i| DVec3::from(point(i)));
        let uv = corners.map(|i| DVec2::from(soup.uvs[i as usize].map(f64::from)));
        let flat = p.map(|p| self.ray_of(p));
        let area = (flat[1] - flat[0]).perp_dot(flat[2] - flat[0]);
        if area.abs() < 1e-9 {
            return;
        }
        // The shares of the second and third corner at a ray, and their change along a row and down.
        let (e1, e2) = ((flat[1] - flat[0]) / area, (flat[2] - flat[0]) / area);
        let share = |at: DVec2| dvec2((at - flat[0]).perp_dot(e2), e1.perp_dot(at - flat[0]));
        let (start, along, down) = (
            share(DVec2::splat(0.5)),
            dvec2(e2.y, -e1.y),
            dvec2(-e2.x, e1.x),
        );
        let spread = |t: DVec2| (uv[1] - uv[0]) * t.x + (uv[2] - uv[0]) * t.y;
        let number = self.triangles.len() as u32;
        self.triangles.push(Triangle {
            surface,
            face: Face::new(normal, right_of(p, uv)),
            uv: [uv[0] + spread(start), spread(along), spread(down)],
        });
        self.record(number, flat, p.map(|p| p.y), [start, along, down]);
    }

    /// Records the rays that hit a triangle before anything else, by the depths of its corners and by the shares of the
    /// second and third corner at a ray: at ray (0, 0), and their change along a row and down.
    fn record(&mut self, number: u32, flat: [DVec2; 3], y: [f64; 3], shares: [DVec2; 3]) {
        let [start, along, down] = shares;
        let lo = flat[0].min(flat[1]).min(flat[2]).max(DVec2::ZERO);
        let last = dvec2(self.width as f64, self.height as f64) - 1.0;
        let hi = flat[0]
            .max(flat[1])
            .max(flat[2])
            .min(last + 0.5)
            .max(DVec2::ZERO);
        let (first, last) = (lo.x.floor() as usize, hi.x as usize);
        for v in lo.y.floor() as usize..=hi.y as usize {
            let mut t = start + along * first as f64 + down * v as f64;
            let Some(row) = self.hits.get_mut(v * self.width..(v + 1) * self.width) else {
                return;
            };
            let mut entered = false;
            for hit in row.iter_mut().take(last + 1).skip(first) {
                if t.x >= 0.0 && t.y >= 0.0 && t.x + t.y <= 1.0 {
                    entered = true;
                    let depth = y[0] + (y[1] - y[0]) * t.x + (y[2] - y[0]) * t.y;
                    let depth = depth as f32;
                    if depth < hit.depth {
                        *hit = Hit {
                            depth,
                            triangle: number,
                        };
                    }
                } else if entered && (t.min_element() < 0.0 || t.x + t.y > 1.0 + 1e-9) {
                    // A row leaves a triangle once; only along an edge do rounding errors lead in and out.
                    break;
                }
                t += along;
            }
        }
    }

    /// Converts a point to ray coordinates, y down.
    fn ray_of(&self, p: DVec3) -> DVec2 {
        let (right, up) = (p.x - self.slant.x * p.y, p.z - self.slant.y * p.y);
        let x = (right - self.rect.x0) / self.rect.width() * self.width as f64;
        let y = (self.rect.z1 - up) / self.rect.height() * self.height as f64;
        dvec2(x, y)
    }

    /// Returns the share of daylight at a point, reduced where its neighbours protrude.
    pub(super) fn light(&self, u: usize, v: usize, depth: f32) -> f32 {
        let (w, h) = (self.width as isize, self.height as isize);
        let (u, v) = (u as isize, v as isize);
        let within = u >= REACH && u + REACH < w && v >= 3 * REACH && v + REACH < h;
        let at = v * w + u;
        let mut shade = 0.0;
        for (du, dv) in ROUND {
            let (du, dv) = (du * REACH, dv * REACH);
            let (x, y) = (u + du, v + dv);
            if !within && (x < 0 || y < 0 || x >= w || y >= h) {
                continue;
            }
            let near = self.hits[(at + dv * w + du) as usize].depth;
            if near < depth {
                shade += ((depth - near) / DEEP).min(1.0);
            }
        }
        1.0 - (1.0 - DARKEST) * shade / ROUND.len() as f32
    }
}

/// Returns the direction of the image's u axis on a triangle.
fn right_of(p: [DVec3; 3], uv: [DVec2; 3]) -> DVec3 {
    let (e1, e2) = (p[1] - p[0], p[2] - p[0]);
    let (d1, d2) = (uv[1] - uv[0], uv[2] - uv[0]);
    let det = d1.perp_dot(d2);
    ((e1 * d2.y - e2 * d1.y) / det).normalize_or(DVec3::X)
}
