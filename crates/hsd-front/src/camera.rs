//! The camera of a photograph: its lens, and how it sees a plane.

use glam::{DMat3, DVec2, DVec3};

/// Steps of the search for a radius; each doubles the digits that are right.
const STEPS: usize = 6;

/// A lens: focal length and the bending of lines.
///
/// A point at `r` focal lengths from the middle of the straight picture is seen at `r (1 + k1 r^2 + k2 r^4)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// The focal length, pixels.
    pub focal: f64,
    /// The middle of the picture, pixels; the middle of the first pixel is at 0.5, 0.5.
    pub middle: DVec2,
    /// The bending, of the third and the fifth power of the radius.
    pub bend: [f64; 2],
}

impl Lens {
    /// Takes a point of the straight picture to the photograph.
    pub fn bent(&self, at: DVec2) -> DVec2 {
        if self.bend == [0.0; 2] {
            return at;
        }
        let from = (at - self.middle) / self.focal;
        let r2 = from.length_squared().min(self.reach());
        self.middle + from * self.factor(r2) * self.focal
    }

    /// Takes a point of the photograph to the straight picture.
    pub fn straight(&self, at: DVec2) -> DVec2 {
        if self.bend == [0.0; 2] {
            return at;
        }
        let from = (at - self.middle) / self.focal;
        let seen = from.length();
        let mut r = seen;
        let reach = self.reach().sqrt();
        for _ in 0..STEPS {
            let r2 = r * r;
            let slope = 1.0 + 3.0 * self.bend[0] * r2 + 5.0 * self.bend[1] * r2 * r2;
            r = (r - (r * self.factor(r2) - seen) / slope.max(0.1)).clamp(0.0, reach);
        }
        match seen > 0.0 {
            true => self.middle + from * (r / seen) * self.focal,
            false => at,
        }
    }

    fn factor(&self, r2: f64) -> f64 {
        1.0 + r2 * (self.bend[0] + r2 * self.bend[1])
    }

    /// The square of the radius up to which the picture does not fold back on itself.
    fn reach(&self) -> f64 {
        let [k1, k2] = self.bend;
        // Where the slope 1 + 3 k1 s + 5 k2 s^2 vanishes first.
        let inner = 9.0 * k1 * k1 - 20.0 * k2;
        let first = match k2.abs() < 1e-12 {
            true if k1 < 0.0 => -1.0 / (3.0 * k1),
            true => f64::INFINITY,
            false if inner < 0.0 => f64::INFINITY,
            false => {
                let root = inner.sqrt();
                let ends = [
                    (-3.0 * k1 + root) / (10.0 * k2),
                    (-3.0 * k1 - root) / (10.0 * k2),
                ];
                ends.into_iter()
                    .filter(|s| *s > 0.0)
                    .fold(f64::INFINITY, f64::min)
            }
        };
        first.min(9.0) * 0.98
    }

    /// The matrix that takes directions to pixels of the straight picture.
    fn matrix(&self) -> DMat3 {
        DMat3::from_cols(
            DVec3::new(self.focal, 0.0, 0.0),
            DVec3::new(0.0, self.focal, 0.0),
            self.middle.extend(1.0),
        )
    }

    /// The direction in which a point of the straight picture is seen.
    pub fn ray(&self, at: DVec3) -> DVec3 {
        self.matrix().inverse() * at
    }

    /// The width of a rectangle over its height, from the map of the unit square to the straight picture.
    pub fn aspect(&self, unit: DMat3) -> f64 {
        let back = self.matrix().inverse();
        (back * unit.x_axis).length() / (back * unit.y_axis).length()
    }
}

/// The focal length in pixels at which the sides of a rectangle are square to each other, and the aspect does not hang on
/// it too much to be told; from the map of the unit square to the straight picture.
pub fn focal_of(unit: DMat3, middle: DVec2) -> Option<f64> {
    let move_back = DMat3::from_translation(-middle);
    let (h1, h2) = (move_back * unit.x_axis, move_back * unit.y_axis);
    // Square: h1 . diag(1/f^2, 1/f^2, 1) h2 = 0.
    let depth = h1.z * h2.z;
    let across = h1.x * h2.x + h1.y * h2.y;
    let long = h1.truncate().length() * h2.truncate().length();
    // Both sides have to run into the depth, or noise of a pixel says anything.
    let square = -across / depth;
    let steep = |h: DVec3| h.z.abs() * square.max(0.0).sqrt() / h.truncate().length();
    (square > 0.0 && square.is_finite() && long > 0.0 && steep(h1) > 0.1 && steep(h2) > 0.1)
        .then(|| square.sqrt())
}

/// Solves linear equations: the last column is the right side.
pub(super) fn solved<const N: usize, const M: usize>(mut rows: [[f64; M]; N]) -> Option<[f64; N]> {
    for k in 0..N {
        let pivot = (k..N).max_by(|a, b| rows[*a][k].abs().total_cmp(&rows[*b][k].abs()))?;
        rows.swap(k, pivot);
        if rows[k][k].abs() < 1e-12 {
            return None;
        }
        for other in 0..N {
            if other != k {
                let share = rows[other][k] / rows[k][k];
                let pivot = rows[k];
                rows[other]
                    .iter_mut()
                    .zip(pivot)
                    .for_each(|(r, p)| *r -= share * p);
            }
        }
    }
    let mut found = [0.0; N];
    for (k, value) in found.iter_mut().enumerate() {
        *value = rows[k][N] / rows[k][k];
    }
    Some(found)
}
