//! Beam tracing with one reflection (003-18): the pyramid from the mirrored viewpoint through a rectangle of a plane contains
//! everything that the rectangle reflects. Rays are evenly spaced on the plane, like the pixels of its image.

use crate::raster::Grid;
use crate::view::{Hit, Triangle};
use glam::{DVec2, DVec3, dvec3};

/// Anything nearer to the plane than this, in metres, belongs to the reflecting wall.
pub(super) const NEAR: f64 = 0.2;

/// A vertical plane and its frame: x to the right as seen from outside, y the world height, z out of the plane.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    /// A point of the plane at height 0.
    pub at: DVec3,
    /// The horizontal unit normal.
    pub out: DVec3,
}

impl Plane {
    /// Returns the direction to the right.
    pub fn right(&self) -> DVec3 {
        DVec3::Z.cross(self.out)
    }

    /// Transforms a point from world space to the frame.
    pub fn of(&self, p: DVec3) -> DVec3 {
        let p = p - self.at;
        dvec3(self.right().dot(p), p.z, self.out.dot(p))
    }

    /// Transforms a point from the frame to world space.
    pub fn world(&self, p: DVec3) -> DVec3 {
        self.at + self.right() * p.x + DVec3::Z * p.y + self.out * p.z
    }
}

/// The reflection in a rectangle of a plane from a viewpoint, in the frame of the plane.
#[derive(Clone, Copy, Debug)]
pub struct Beam {
    /// The viewpoint in front of the plane.
    pub eye: DVec3,
    /// The lower corner of the rectangle.
    pub low: DVec2,
    /// The upper corner of the rectangle.
    pub high: DVec2,
}

/// A corner of a clipped triangle: its projection to the plane, its depth from the mirrored viewpoint, and its barycentric
/// weights.
type Corner = (DVec2, f64, DVec3);

impl Beam {
    /// Projects a point in front of the plane to its reflection in the plane.
    pub fn on_plane(&self, p: DVec3) -> DVec2 {
        let share = self.eye.z / (self.eye.z + p.z);
        let eye = self.eye.truncate();
        eye + (p.truncate() - eye) * share
    }

    /// Returns the direction of the reflected ray at a point of the plane.
    pub fn way(&self, q: DVec2) -> DVec3 {
        (q - self.eye.truncate()).extend(self.eye.z).normalize()
    }

    /// Returns whether the convex hull of these points may intersect the beam.
    pub fn holds(&self, corners: &[DVec3]) -> bool {
        let eye = self.eye.truncate();
        // Tests a point against a side of the pyramid, which intersects the plane at `at`.
        let beyond = |sign: f64, p: f64, eye: f64, at: f64, depth: f64| {
            sign * ((p - eye) * self.eye.z - (at - eye) * (self.eye.z + depth)) > 0.0
        };
        let sides: [&dyn Fn(&DVec3) -> bool; 5] = [
            &|p| p.z < NEAR,
            &|p| beyond(-1.0, p.x, eye.x, self.low.x, p.z),
            &|p| beyond(1.0, p.x, eye.x, self.high.x, p.z),
            &|p| beyond(-1.0, p.y, eye.y, self.low.y, p.z),
            &|p| beyond(1.0, p.y, eye.y, self.high.y, p.z),
        ];
        !sides.iter().any(|side| corners.iter().all(side))
    }

    /// Returns the nearest hit of each ray of a grid on the plane; `corners` are those of the triangles in the frame.
    pub fn look(
        &self,
        triangles: &[Triangle],
        corners: &[[DVec3; 3]],
        grid: &Grid,
        open: impl Fn(&Triangle, [f64; 3]) -> bool,
    ) -> Vec<Option<Hit>> {
        let mut hits: Vec<Option<Hit>> = vec![None; grid.width * grid.height];
        for (index, corners) in corners.iter().enumerate() {
            if !self.holds(corners) {
                continue;
            }
            let (pieces, count) = self.pieces(corners);
            for k in 2..count {
                let piece = [pieces[0], pieces[k - 1], pieces[k]];
                grid.meet(piece.map(|(q, ..)| q), |place, weights| {
                    // Perspective-correct interpolation: attributes divided by depth are linear on the plane.
                    let shares = [0, 1, 2].map(|k| weights[k] / piece[k].1);
                    let depth = 1.0 / shares.iter().sum::<f64>();
                    let hit = &mut hits[place];
                    if hit.is_some_and(|h| h.depth <= depth) {
                        return;
                    }
                    let weights = [0, 1, 2].map(|k| piece[k].2 * shares[k] * depth);
                    let weights = (weights[0] + weights[1] + weights[2]).to_array();
                    if !open(&triangles[index], weights) {
                        *hit = Some(Hit {
                            depth,
                            triangle: index as u32,
                            weights: weights.map(|w| w as f32),
                        });
                    }
                });
            }
        }
        hits
    }

    /// Clips a triangle at the plane; returns the corners and their number: three, four or none.
    fn pieces(&self, corners: &[DVec3; 3]) -> ([Corner; 4], usize) {
        let mut kept = [(DVec2::ZERO, 1.0, DVec3::ZERO); 4];
        let mut count = 0;
        let mut keep = |p: DVec3, weights: DVec3| {
            kept[count] = (self.on_plane(p), self.eye.z + p.z, weights);
            count += 1;
        };
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            let (own, next) = (DVec3::AXES[k], DVec3::AXES[(k + 1) % 3]);
            if a.z >= NEAR {
                keep(a, own);
            }
            if (a.z >= NEAR) != (b.z >= NEAR) {
                let t = (NEAR - a.z) / (b.z - a.z);
                keep(a.lerp(b, t), own.lerp(next, t));
            }
        }
        (kept, count)
    }
}

#[cfg(test)]
mod tests {
    use crate::beam::*;
    use glam::dvec2;

    const BEAM: Beam = Beam {
        eye: dvec3(1.0, 1.6, 5.0),
        low: dvec2(-3.0, 0.0),
        high: dvec2(3.0, 4.0),
    };

    #[test]
    fn lines_run_from_the_mirrored_eye() {
        let p = dvec3(-4.0, 3.0, 7.0);
        let q = BEAM.on_plane(p);
        let mirrored = dvec3(1.0, 1.6, -5.0);
        let line = (q.extend(0.0) - mirrored).normalize();
        assert!((p - mirrored).normalize().distance(line) < 1e-12);
        assert!(BEAM.way(q).distance(line) < 1e-12);
    }

    #[test]
    fn beams_hold_what_they_meet() {
        assert!(BEAM.holds(&[dvec3(0.0, 1.0, 5.0)]));
        assert!(!BEAM.holds(&[dvec3(0.0, 1.0, -5.0), dvec3(9.0, 9.0, 0.0)]));
        // Ten metres from the plane the beam is three times as wide as the rectangle.
        assert!(BEAM.holds(&[dvec3(6.9, 1.0, 10.0)]) && !BEAM.holds(&[dvec3(7.1, 1.0, 10.0)]));
        assert!(BEAM.holds(&[dvec3(-10.9, 1.0, 10.0)]) && !BEAM.holds(&[dvec3(-11.1, 1.0, 10.0)]));
    }

    #[test]
    fn the_nearer_one_is_seen_at_its_weights() {
        let wall = |z: f64| {
            [
                dvec3(-20.0, -20.0, z),
                dvec3(20.0, -20.0, z),
                dvec3(0.0, 30.0, z),
            ]
        };
        // A triangle that intersects the plane covers the others on the left.
        let leaning = [
            dvec3(-9.0, -30.0, -1.0),
            dvec3(-9.0, 30.0, -1.0),
            dvec3(0.0, 0.0, 8.0),
        ];
        let corners = [wall(9.0), wall(6.0), leaning];
        let triangles = corners.map(Triangle::ground);
        let grid = Grid {
            origin: dvec2(-2.9, 0.1),
            step: 0.2,
            width: 30,
            height: 20,
        };
        let hits = BEAM.look(&triangles, &corners, &grid, |_, _| false);
        let mut seen = [0; 3];
        for (place, hit) in hits.iter().enumerate() {
            let hit = hit.expect("the walls are wide enough");
            seen[hit.triangle as usize] += 1;
            let [a, b, c] = hit.weights.map(f64::from);
            let [p, q, r] = corners[hit.triangle as usize];
            let there = p * a + q * b + r * c;
            assert!(BEAM.on_plane(there).distance(grid.at(place)) < 1e-4);
            assert!((hit.depth - 5.0 - there.z).abs() < 1e-4);
        }
        assert!(seen[0] == 0 && seen[1] > 100 && seen[2] > 100, "{seen:?}");
    }
}
