//! Thinning of a square lattice of heights to right-angled triangles: a triangle is halved at the middle of its longest side
//! as long as anything in it is too far from the heights. Both triangles at a side decide alike, so no cracks open.

use glam::DVec2;

/// The heights of a square lattice.
pub(super) struct Lattice {
    /// The number of cells of a side, a power of two.
    side: usize,
    /// Row by row; NaN where there is none.
    heights: Vec<f64>,
    /// Corners of the border that its thinned lines keep.
    kept: Vec<usize>,
}

/// A mesh over a lattice.
pub(super) struct Triangles {
    /// The corners of each triangle, counter-clockwise, by their number in the lattice.
    pub(super) corners: Vec<[usize; 3]>,
    /// The heights of all corners of the lattice.
    pub(super) heights: Vec<f64>,
}

/// A corner of the lattice: columns east, rows north.
type Corner = (usize, usize);

/// A triangle: the ends of its longest side, and the corner with the right angle.
type Triangle = [Corner; 3];

impl Lattice {
    pub(super) fn new(side: usize, heights: Vec<f64>) -> Lattice {
        Lattice {
            side,
            heights,
            kept: vec![],
        }
    }

    fn number(&self, (x, y): Corner) -> usize {
        y * (self.side + 1) + x
    }

    /// Replaces the heights on each side of the square by a line with as few corners as the tolerance allows. It depends on
    /// these heights alone.
    pub(super) fn thin_border(&mut self, tolerance: f64) {
        let n = self.side;
        let sides: [fn(usize, usize) -> Corner; 4] =
            [|k, _| (k, 0), |k, n| (k, n), |k, _| (0, k), |k, n| (n, k)];
        for side in sides {
            let line: Vec<usize> = (0..=n).map(|k| self.number(side(k, n))).collect();
            self.thin_line(&line, tolerance);
        }
    }

    /// Thins a line of corners, whose ends are kept.
    fn thin_line(&mut self, line: &[usize], tolerance: f64) {
        let last = line.len() - 1;
        if last < 2 {
            return;
        }
        let (from, to) = (self.heights[line[0]], self.heights[line[last]]);
        let on_chord = |k: usize| from + (to - from) * (k as f64 / last as f64);
        let near = |k: usize| {
            let height = self.heights[line[k]];
            let off = (height - on_chord(k)).abs();
            off <= tolerance || (height.is_nan() && from.is_nan() && to.is_nan())
        };
        if (1..last).all(near) {
            for (k, corner) in line.iter().enumerate().take(last).skip(1) {
                self.heights[*corner] = on_chord(k);
            }
            return;
        }
        let middle = last / 2;
        self.kept.push(line[middle]);
        self.thin_line(&line[..=middle], tolerance);
        self.thin_line(&line[middle..], tolerance);
    }

    /// Calls `each` with the triangles of one depth that can be halved, and the middle of their longest side.
    fn at_depth(&self, depth: u32, each: &mut dyn FnMut(Triangle, Corner)) {
        let n = self.side;
        let halves = [[(0, 0), (n, n), (n, 0)], [(n, n), (0, 0), (0, n)]];
        for triangle in halves {
            descend(triangle, depth, each);
        }
    }

    /// Returns how far the heights in a triangle are from its plane; infinitely if only some of them are known.
    fn off(&self, triangle: Triangle) -> f64 {
        let [a, b, c] = triangle.map(|(x, y)| DVec2::new(x as f64, y as f64));
        let [ha, hb, hc] = triangle.map(|corner| self.heights[self.number(corner)]);
        let (u, v) = (b - a, c - a);
        let whole = u.perp_dot(v);
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let (mut off, mut known, mut unknown) = (0.0f64, false, false);
        for y in low.y as usize..=high.y as usize {
            for x in low.x as usize..=high.x as usize {
                let p = DVec2::new(x as f64, y as f64) - a;
                let (to_b, to_c) = (p.perp_dot(v) / whole, u.perp_dot(p) / whole);
                if to_b < 0.0 || to_c < 0.0 || to_b + to_c > 1.0 {
                    continue;
                }
                let height = self.heights[self.number((x, y))];
                (known, unknown) = (known || height.is_finite(), unknown || height.is_nan());
                let plane = ha + (hb - ha) * to_b + (hc - ha) * to_c;
                off = off.max((height - plane).abs());
            }
        }
        match known && unknown {
            true => f64::INFINITY,
            false => off,
        }
    }

    /// Returns the depth of the smallest triangles that can be halved.
    fn deepest(&self) -> u32 {
        2 * self.side.ilog2() - 1
    }
}

/// Returns the middle of the longest side of a triangle; `None` if it is no corner of the lattice.
fn middle([a, b, _]: Triangle) -> Option<Corner> {
    let (x, y) = (a.0 + b.0, a.1 + b.1);
    (x % 2 == 0 && y % 2 == 0).then_some((x / 2, y / 2))
}

/// Returns the halves of a triangle.
fn halves([a, b, c]: Triangle, m: Corner) -> [Triangle; 2] {
    [[c, a, m], [b, c, m]]
}

fn descend(triangle: Triangle, depth: u32, each: &mut dyn FnMut(Triangle, Corner)) {
    let Some(m) = middle(triangle) else {
        return;
    };
    match depth {
        0 => each(triangle, m),
        _ => halves(triangle, m)
            .into_iter()
            .for_each(|half| descend(half, depth - 1, each)),
    }
}

/// Returns the mesh that keeps within a tolerance of the heights. Triangles with a corner that has no height are left out.
pub(super) fn triangles(lattice: Lattice, tolerance: f64) -> Triangles {
    // How far a triangle would be off, if it were not halved there or below.
    let mut errors = vec![0.0f64; lattice.heights.len()];
    for kept in &lattice.kept {
        errors[*kept] = f64::INFINITY;
    }
    // The smallest first, so that each takes over what is known of its halves on both sides.
    for depth in (0..=lattice.deepest()).rev() {
        lattice.at_depth(depth, &mut |triangle, m| {
            let at = lattice.number(m);
            let off = lattice.off(triangle);
            let below = halves(triangle, m).map(|half| {
                let m = middle(half);
                m.map_or(0.0, |m| errors[lattice.number(m)])
            });
            errors[at] = below.into_iter().fold(errors[at].max(off), f64::max);
        });
    }
    let mut corners = vec![];
    let n = lattice.side;
    let mut open: Vec<Triangle> = vec![[(0, 0), (n, n), (n, 0)], [(n, n), (0, 0), (0, n)]];
    while let Some(triangle) = open.pop() {
        match middle(triangle).filter(|m| errors[lattice.number(*m)] > tolerance) {
            Some(m) => open.extend(halves(triangle, m)),
            None => corners.push(upward(triangle).map(|corner| lattice.number(corner))),
        }
    }
    let heights = lattice.heights;
    corners.retain(|triangle| triangle.iter().all(|corner| heights[*corner].is_finite()));
    Triangles { corners, heights }
}

/// Returns the corners of a triangle counter-clockwise.
fn upward([a, b, c]: Triangle) -> Triangle {
    let [(ax, ay), (bx, by), (cx, cy)] = [a, b, c].map(|(x, y)| (x as i64, y as i64));
    let area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    if area > 0 { [a, b, c] } else { [a, c, b] }
}
