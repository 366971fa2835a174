//! A grid of parallel rays in projection, and their intersection with triangles.

use glam::{DVec2, dvec2};

/// Rays at equal distances.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    /// The first ray.
    pub origin: DVec2,
    /// The distance between rays, in both directions.
    pub step: f64,
    /// Rays per row.
    pub width: usize,
    /// Rows.
    pub height: usize,
}

impl Grid {
    /// Returns the finest grid of `width` x `height` rays centred on all points, with a margin as a fraction of its sides.
    pub fn around(
        points: impl Iterator<Item = DVec2>,
        (width, height): (u32, u32),
        margin: f64,
    ) -> Grid {
        let fold = |(low, high): (DVec2, DVec2), p: DVec2| (low.min(p), high.max(p));
        let (low, high) = points.fold((DVec2::MAX, DVec2::MIN), fold);
        let (low, high) = match low.x <= high.x {
            true => (low, high),
            false => (DVec2::NEG_ONE, DVec2::ONE),
        };
        let lines = dvec2(f64::from(width.max(1)), f64::from(height.max(1)));
        let step = ((high - low) / (lines * (1.0 - 2.0 * margin)))
            .max_element()
            .max(1e-6);
        Grid {
            origin: (low + high) / 2.0 - lines * step / 2.0 + step / 2.0,
            step,
            width: width.max(1) as usize,
            height: height.max(1) as usize,
        }
    }

    /// Returns the position of a ray by its index.
    pub fn at(&self, place: usize) -> DVec2 {
        let line = dvec2((place % self.width) as f64, (place / self.width) as f64);
        self.origin + line * self.step
    }

    /// Returns the index of the ray nearest to a point, if it is in the grid.
    pub fn nearest(&self, point: DVec2) -> Option<usize> {
        let line = ((point - self.origin) / self.step).round();
        let inside = line.cmpge(DVec2::ZERO).all()
            && line.x < self.width as f64
            && line.y < self.height as f64;
        inside.then(|| line.y as usize * self.width + line.x as usize)
    }

    /// Visits every ray that intersects the triangle, with its index and the barycentric weights. Triangles seen edge-on are
    /// not visited.
    pub fn meet(&self, [p, q, r]: [DVec2; 3], mut visit: impl FnMut(usize, [f64; 3])) {
        let area = (q - p).perp_dot(r - p);
        if area.abs() < 1e-12 {
            return;
        }
        let last = dvec2(self.width as f64 - 1.0, self.height as f64 - 1.0);
        let line = |p: DVec2| (p - self.origin) / self.step;
        let low = line(p.min(q).min(r)).ceil().max(DVec2::ZERO);
        let high = line(p.max(q).max(r)).floor().min(last);
        if low.x > high.x || low.y > high.y {
            return;
        }
        for j in low.y as usize..=high.y as usize {
            for i in low.x as usize..=high.x as usize {
                let at = self.origin + dvec2(i as f64, j as f64) * self.step;
                let side = |a: DVec2, b: DVec2| (b - a).perp_dot(at - a) / area;
                let weights = [side(q, r), side(r, p), side(p, q)];
                if weights.iter().all(|w| *w >= 0.0) {
                    visit(j * self.width + i, weights);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::raster::*;

    #[test]
    fn a_square_of_two_triangles_is_met_by_its_lines() {
        let grid = Grid {
            origin: dvec2(0.5, 0.5),
            step: 1.0,
            width: 10,
            height: 8,
        };
        let [a, b, c, d] = [(2.0, 1.0), (6.0, 1.0), (6.0, 5.0), (2.0, 5.0)].map(DVec2::from);
        let mut met = vec![0; 80];
        for triangle in [[a, b, c], [d, a, c]] {
            grid.meet(triangle, |place, [u, v, w]| {
                met[place] += 1;
                let there = triangle[0] * u + triangle[1] * v + triangle[2] * w;
                assert!((there - grid.at(place)).length() < 1e-12);
            });
        }
        // Rays on the common edge intersect both.
        assert_eq!(met.iter().filter(|n| **n > 0).count(), 16);
        assert_eq!(met.iter().sum::<i32>(), 20);
        assert_eq!(grid.nearest(dvec2(2.4, 1.6)), Some(12));
        assert_eq!(grid.nearest(dvec2(-0.2, 1.6)), None);
    }

    #[test]
    fn everything_is_within_the_margin() {
        let points = [dvec2(-3.0, 2.0), dvec2(5.0, 2.5), dvec2(0.0, 9.0)];
        let grid = Grid::around(points.into_iter(), (200, 100), 0.1);
        for p in points {
            let line = (p - grid.origin) / grid.step;
            assert!(
                line.y > 9.0 && line.y < 90.0 && line.x > 19.0 && line.x < 180.0,
                "{line}"
            );
        }
    }
}
