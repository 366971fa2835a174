//! Closed bodies with smooth sides: rounded bars, poles, curved laths, folded cloth. Neighbouring sides share normals,
//! so that a few sides look round.

use crate::mesh::{Axis, Bodies, Soup, grain_along};
use glam::{DVec2, DVec3, dvec2};
use hsd_base::geometry::tolerance::POINT;
use hsd_ir::material::SurfaceId;

/// Sides whose normals differ by less than this angle are shaded as one, as a cosine.
const SOFT: f64 = 0.8;

impl Bodies {
    /// Adds a polygon extruded along an axis as by `prism`, shaded smoothly where its sides meet at small angles.
    pub(crate) fn rounded(
        &mut self,
        finish: SurfaceId,
        outline: &[DVec2],
        axis: Axis,
        lo: f64,
        hi: f64,
    ) {
        let mut ring = outline.to_vec();
        ring.dedup_by(|a, b| a.distance(*b) < POINT);
        if ring.len() > 1 && ring[0].distance(ring[ring.len() - 1]) < POINT {
            ring.pop();
        }
        if hsd_base::geometry::area2(&ring) < 0.0 {
            ring.reverse();
        }
        if ring.len() < 3 || hi <= lo {
            return;
        }
        let top: Vec<DVec3> = ring.iter().map(|p| axis.at(*p, hi)).collect();
        let foot: Vec<DVec3> = ring.iter().rev().map(|p| axis.at(*p, lo)).collect();
        if self.measured.is_some() {
            return [top, foot].iter().for_each(|ring| self.cover(ring));
        }
        self.face(finish, &top);
        self.face(finish, &foot);
        let grain = grain_along(finish);
        sides(self.soup(finish), &ring, axis, (lo, hi), grain);
    }

    /// Adds a thin body between two parallel surfaces. `at` maps shares to the right and up to points of the middle
    /// surface; `half` is half its thickness along y; `size` is the extent of its texture, metres.
    pub(crate) fn sheet(
        &mut self,
        finish: SurfaceId,
        [cols, rows]: [u32; 2],
        size: DVec2,
        half: f64,
        at: impl Fn(f64, f64) -> DVec3,
    ) {
        let share = |i: u32, j: u32| {
            (
                f64::from(i) / f64::from(cols),
                f64::from(j) / f64::from(rows),
            )
        };
        let soup = self.soup(finish);
        for side in [-1.0, 1.0] {
            let first = soup.positions.len() as u32;
            for j in 0..=rows {
                for i in 0..=cols {
                    let (u, v) = share(i, j);
                    let normal = normal_at(&at, u, v) * -side;
                    let point = at(u, v) + DVec3::Y * (side * half);
                    vertex(soup, point, normal, dvec2(u * size.x * -side, v * size.y));
                }
            }
            for j in 0..rows {
                for i in 0..cols {
                    let a = first + j * (cols + 1) + i;
                    let (b, c, d) = (a + 1, a + cols + 2, a + cols + 1);
                    soup.indices.extend(match side < 0.0 {
                        true => [a, b, c, a, c, d],
                        false => [a, c, b, a, d, c],
                    });
                }
            }
        }
        let mut rim: Vec<(u32, u32)> = (0..cols).map(|i| (i, 0)).collect();
        rim.extend((0..rows).map(|j| (cols, j)));
        rim.extend((1..=cols).rev().map(|i| (i, rows)));
        rim.extend((1..=rows).rev().map(|j| (0, j)));
        for (k, &(i, j)) in rim.iter().enumerate() {
            let (m, n) = rim[(k + 1) % rim.len()];
            let point = |(u, v): (f64, f64), side: f64| at(u, v) + DVec3::Y * (side * half);
            let (p, q) = (share(i, j), share(m, n));
            self.face(
                finish,
                &[point(p, -1.0), point(p, 1.0), point(q, 1.0), point(q, -1.0)],
            );
        }
    }
}

/// Returns the normal of the front surface, pointing out of the wall.
fn normal_at(at: &impl Fn(f64, f64) -> DVec3, u: f64, v: f64) -> DVec3 {
    let step = 1e-3;
    let right = at(u + step, v) - at(u - step, v);
    let up = at(u, v + step) - at(u, v - step);
    right.cross(up).normalize_or_zero()
}

/// Adds the sides of an extruded polygon, counter-clockwise; pairs of corners are shared along smooth edges.
fn sides(soup: &mut Soup, ring: &[DVec2], axis: Axis, (lo, hi): (f64, f64), grain: bool) {
    let n = ring.len();
    let normal = |i: usize| {
        let along = ring[(i + 1) % n] - ring[i % n];
        dvec2(along.y, -along.x).normalize_or_zero()
    };
    let length = |i: usize| ring[(i + 1) % n].distance(ring[i % n]);
    let round: f64 = (0..n).map(length).sum();
    // The picture's v axis follows the grain, else it runs up.
    let turned = match grain {
        true => round / 2.0 > hi - lo,
        false => axis == Axis::X,
    };
    let soft = |a: DVec2, b: DVec2| {
        if a.dot(b) > SOFT {
            (a + b).normalize()
        } else {
            b
        }
    };
    let mut column = |p: DVec2, normal: DVec2, s: f64| {
        for t in [lo, hi] {
            let uv = if turned { dvec2(t, -s) } else { dvec2(s, t) };
            vertex(soup, axis.at(p, t), axis.at(normal, 0.0), uv);
        }
        soup.positions.len() as u32 - 2
    };
    let mut quads = Vec::with_capacity(n);
    let mut s = 0.0;
    let mut first = 0;
    for i in 0..n {
        let (before, own, after) = (normal(i + n - 1), normal(i), normal(i + 1));
        if i == 0 || before.dot(own) <= SOFT {
            first = column(ring[i], soft(before, own), s);
        }
        s += length(i);
        let next = column(ring[(i + 1) % n], soft(after, own), s);
        quads.push([first, next]);
        first = next;
    }
    for [a, b] in quads {
        soup.indices.extend([a, b, b + 1, a, b + 1, a + 1]);
    }
}

fn vertex(soup: &mut Soup, point: DVec3, normal: DVec3, uv: DVec2) {
    soup.positions.push(point.as_vec3().to_array());
    soup.normals.push(normal.as_vec3().to_array());
    soup.uvs.push(uv.as_vec2().to_array());
}

/// Returns the outline of a bar with edges rounded, or chamfered for one step: front edges always, back edges if `all`.
/// Corners are (x, y), y from `y0` at the front.
pub(crate) fn soft_bar(
    (x0, x1): (f64, f64),
    (y0, y1): (f64, f64),
    edge: f64,
    steps: usize,
    all: bool,
) -> Vec<DVec2> {
    let r = edge.min((x1 - x0) / 2.0).min((y1 - y0) / 2.0);
    let corner = |x: f64, y: f64, dx: f64, dy: f64, cut: bool| {
        let n = if cut { steps } else { 0 };
        let r = if cut { r } else { 0.0 };
        let centre = dvec2(x + dx * r, y + dy * r);
        let arc = (0..=n).map(move |i| {
            let angle = std::f64::consts::FRAC_PI_2 * i as f64 / n.max(1) as f64;
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            // Each corner turns from one axis to the other, the way depending on the corner.
            let (a, b) = if dx * dy > 0.0 {
                (cos, sin)
            } else {
                (sin, cos)
            };
            centre - dvec2(dx * r * a, dy * r * b)
        });
        arc.collect::<Vec<DVec2>>()
    };
    [
        corner(x0, y0, 1.0, 1.0, true),
        corner(x1, y0, -1.0, 1.0, true),
        corner(x1, y1, -1.0, -1.0, all),
        corner(x0, y1, 1.0, -1.0, all),
    ]
    .concat()
}
