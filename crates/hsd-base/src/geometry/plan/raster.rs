//! A plan on its own compressed grid: one bit for each field between two neighbouring
//! coordinates.
//!
//! Invariants: lengths are offsets from the least coordinate divided by their common
//! divisor, so that finer source grids cost no range; after [`Raster::of`] every grid line
//! carries a wall somewhere, hence the grid is a function of the region alone.

use crate::geometry::plan::{Cell, Plan};

/// The maximum number of fields of a raster; larger plans are handled in slabs (see `slabs.rs`).
pub const MAX_FIELDS: usize = 1 << 20;

/// A rectangle of fields: grid lines `i0 < i1` along a, `j0 < j1` along b.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// First line along a.
    pub i0: usize,
    /// First line along b.
    pub j0: usize,
    /// Last line along a.
    pub i1: usize,
    /// Last line along b.
    pub j1: usize,
}

/// One axis of the grid: reduced offsets of the lines, and their source coordinates.
#[derive(Clone, Debug, Default)]
pub struct Axis {
    /// Reduced offsets of the grid lines from the first, ascending.
    pub at: Vec<u64>,
    /// The same lines in the plan's own coordinates.
    pub source: Vec<i64>,
}

impl Axis {
    fn new(mut source: Vec<i64>) -> Self {
        source.sort_unstable();
        source.dedup();
        Self {
            at: Vec::new(),
            source,
        }
    }

    /// Returns the number of intervals between lines.
    pub fn fields(&self) -> usize {
        self.source.len().saturating_sub(1)
    }

    /// Returns the number of the line at coordinate `c`, which must be one of the grid's.
    fn line(&self, c: i64) -> usize {
        self.source.partition_point(|&x| x < c)
    }

    /// Returns the length of the interval behind line `i`, reduced.
    pub fn step(&self, i: usize) -> u64 {
        self.at[i + 1] - self.at[i]
    }

    fn keep(&mut self, kept: &[bool]) {
        let mut flags = kept.iter();
        self.source.retain(|_| *flags.next().unwrap_or(&true));
    }

    fn divisor(&self, start: u64) -> u64 {
        let least = self.source.first().copied().unwrap_or(0);
        self.source.iter().fold(start, |g, &x| {
            if g == 1 {
                1
            } else {
                gcd(x.wrapping_sub(least) as u64, g)
            }
        })
    }

    fn reduce(&mut self, divisor: u64) {
        let least = self.source.first().copied().unwrap_or(0);
        self.at = self
            .source
            .iter()
            .map(|&x| x.wrapping_sub(least) as u64 / divisor.max(1))
            .collect();
    }
}

/// The plan's fields, row by row from the front, true = inside.
#[derive(Clone, Debug, Default)]
pub struct Raster {
    /// Lines along a, which bound the columns.
    pub a: Axis,
    /// Lines along b, which bound the rows.
    pub b: Axis,
    /// Fields row by row from the front; true inside the plan.
    pub inside: Vec<bool>,
}

impl Raster {
    /// Returns the raster of a plan; `None` if it would have more than [`MAX_FIELDS`] fields.
    pub fn of(plan: &Plan) -> Option<Self> {
        let mut raster = Self::joint(&[plan])?;
        raster.inside = raster.fill(plan);
        raster.compress();
        let divisor = raster.b.divisor(raster.a.divisor(0));
        raster.a.reduce(divisor);
        raster.b.reduce(divisor);
        Some(raster)
    }

    /// Returns the grid of the coordinates of several plans, all fields outside, offsets not reduced.
    pub fn joint(plans: &[&Plan]) -> Option<Self> {
        let corners = || plans.iter().flat_map(|p| p.loops.iter().flatten());
        let a = Axis::new(corners().map(|p| p.0).collect());
        let b = Axis::new(corners().map(|p| p.1).collect());
        let fields = a.fields().checked_mul(b.fields())?;
        (fields <= MAX_FIELDS).then(|| Self {
            a,
            b,
            inside: Vec::new(),
        })
    }

    /// Returns the number of columns.
    pub fn cols(&self) -> usize {
        self.a.fields()
    }

    /// Returns the number of rows.
    pub fn rows(&self) -> usize {
        self.b.fields()
    }

    /// Returns for each field of this grid whether it lies inside `plan`, by the half-open even-odd rule. A slanting
    /// edge counts as a step.
    pub fn fill(&self, plan: &Plan) -> Vec<bool> {
        let cols = self.cols();
        let mut inside = vec![false; cols * self.rows()];
        for (p, q) in plan.edges().filter(|(p, q)| p.1 != q.1) {
            let i = self.a.line(p.0);
            if i < cols {
                for j in self.b.line(p.1.min(q.1))..self.b.line(p.1.max(q.1)) {
                    inside[j * cols + i] ^= true;
                }
            }
        }
        for row in inside.chunks_exact_mut(cols.max(1)) {
            for i in 1..row.len() {
                row[i] ^= row[i - 1];
            }
        }
        inside
    }

    /// Returns for each field of this grid whether any of some cells covers it, overlapping or not.
    pub fn covered(&self, cells: &[Cell]) -> Vec<bool> {
        let cols = self.cols();
        // Cells that begin minus cells that end along a, then summed.
        let mut count = vec![0i32; (cols + 1) * self.rows()];
        for c in cells {
            for j in self.b.line(c.b0)..self.b.line(c.b1) {
                count[j * (cols + 1) + self.a.line(c.a0)] += 1;
                count[j * (cols + 1) + self.a.line(c.a1)] -= 1;
            }
        }
        let mut covered = Vec::with_capacity(cols * self.rows());
        for row in count.chunks_exact(cols + 1) {
            let mut open = 0;
            covered.extend(row[..cols].iter().map(|n| {
                open += n;
                open > 0
            }));
        }
        covered
    }

    /// Returns true if the field left of line `i` (towards smaller a) in row `j` is inside.
    fn before(&self, i: usize, j: usize) -> bool {
        i > 0 && self.inside[j * self.cols() + i - 1]
    }

    fn behind(&self, i: usize, j: usize) -> bool {
        i < self.cols() && self.inside[j * self.cols() + i]
    }

    /// Removes the lines that carry no wall: corners in mid-wall, doubled edges.
    fn compress(&mut self) {
        let (cols, rows) = (self.cols(), self.rows());
        let keep_a: Vec<bool> = (0..=cols)
            .map(|i| (0..rows).any(|j| self.before(i, j) != self.behind(i, j)))
            .collect();
        let keep_b: Vec<bool> = (0..=rows)
            .map(|j| {
                (0..cols)
                    .any(|i| (j > 0 && self.behind(i, j - 1)) != (j < rows && self.behind(i, j)))
            })
            .collect();
        if keep_a.iter().chain(&keep_b).all(|&k| k) {
            return;
        }
        let field = |j: usize, i: usize| self.inside[j * cols + i];
        let kept = |flags: &[bool]| -> Vec<usize> {
            let lines: Vec<usize> = (0..flags.len()).filter(|&i| flags[i]).collect();
            lines[..lines.len().saturating_sub(1)].to_vec()
        };
        let (cols_kept, rows_kept) = (kept(&keep_a), kept(&keep_b));
        self.inside = rows_kept
            .iter()
            .flat_map(|&j| cols_kept.iter().map(move |&i| field(j, i)))
            .collect();
        self.a.keep(&keep_a);
        self.b.keep(&keep_b);
    }

    /// Returns the whole grid.
    pub fn span(&self) -> Span {
        Span {
            i0: 0,
            j0: 0,
            i1: self.cols(),
            j1: self.rows(),
        }
    }

    /// Returns the area of a rectangle, reduced.
    pub fn area(&self, s: Span) -> u128 {
        let (a, b) = (&self.a.at, &self.b.at);
        u128::from(a[s.i1] - a[s.i0]) * u128::from(b[s.j1] - b[s.j0])
    }

    /// Converts a rectangle of fields to the plan's coordinates.
    pub fn cell(&self, s: Span) -> Cell {
        let (a, b) = (&self.a.source, &self.b.source);
        Cell {
            a0: a[s.i0],
            b0: b[s.j0],
            a1: a[s.i1],
            b1: b[s.j1],
        }
    }

    /// Returns the boundary as closed loops of corners: round outer loops (0,0) (w,0) (w,d) (0,d), round holes the
    /// other way; where two corners touch, the loops touch and do not cross.
    pub fn loops(&self) -> Vec<Vec<(i64, i64)>> {
        let stride = self.cols() + 1;
        let mut out = self.outgoing();
        let mut loops = Vec::new();
        for start in 0..out.len() {
            while out[start] != 0 {
                loops.push(self.walk(start, stride, &mut out));
            }
        }
        loops
    }

    /// Returns for each grid point the walls that leave it, as bits: +a, +b, -a, -b.
    fn outgoing(&self) -> Vec<u8> {
        let (cols, rows) = (self.cols(), self.rows());
        if cols == 0 || rows == 0 {
            return Vec::new();
        }
        let stride = cols + 1;
        let mut out = vec![0u8; stride * (rows + 1)];
        for (n, _) in self
            .inside
            .iter()
            .enumerate()
            .filter(|(_, inside)| **inside)
        {
            let (i, j) = (n % cols, n / cols);
            let corner = j * stride + i;
            if j == 0 || !self.inside[n - cols] {
                out[corner] |= 1;
            }
            if i + 1 == cols || !self.inside[n + 1] {
                out[corner + 1] |= 2;
            }
            if j + 1 == rows || !self.inside[n + cols] {
                out[corner + stride + 1] |= 4;
            }
            if i == 0 || !self.inside[n - 1] {
                out[corner + stride] |= 8;
            }
        }
        out
    }

    /// Walks one loop from `start` and removes its walls from `out`.
    fn walk(&self, start: usize, stride: usize, out: &mut [u8]) -> Vec<(i64, i64)> {
        let mut corners = Vec::new();
        let (mut at, mut heading) = (start, None::<u32>);
        loop {
            // Right first (towards the interior), so that touching pieces stay apart.
            let turns = heading.map_or([0, 1, 2, 3], |h| [h + 1, h, h + 3, h + 2].map(|t| t % 4));
            let Some(next) = turns.into_iter().find(|&t| out[at] >> t & 1 == 1) else {
                return corners;
            };
            if heading != Some(next) {
                corners.push((self.a.source[at % stride], self.b.source[at / stride]));
            }
            out[at] &= !(1 << next);
            at = match next {
                0 => at + 1,
                1 => at + stride,
                2 => at - 1,
                _ => at - stride,
            };
            heading = Some(next);
            if at == start {
                return corners;
            }
        }
    }
}

fn gcd(mut x: u64, mut y: u64) -> u64 {
    while y != 0 {
        (x, y) = (y, x % y);
    }
    x
}
