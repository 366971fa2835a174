//! Lengths along the scan lines of a raster, as prefix sums: how much of a line inside a
//! cell is wall, and how much of it divides roof.

use hsd_base::geometry::plan::raster::{Raster, Span};

/// The direction of a scan line; `X` sorts first, as "x before y" demands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum ScanDirection {
    /// The line a = c (x in domain 3).
    X,
    /// The line b = c (y in domain 3).
    Y,
}

/// Prefix sums of one kind of length along every grid line.
#[derive(Debug)]
pub(crate) struct Lengths {
    /// Line i of axis a: `x[j * (cols + 1) + i]` = length in front of line j. The lines of a cell, which are visited
    /// one after another, are thus adjacent.
    x: Vec<u64>,
    /// Line j of axis b: `y[i * (rows + 1) + j]` = length right of line i.
    y: Vec<u64>,
    cols: usize,
    rows: usize,
}

impl Lengths {
    /// Returns the outer wall: one side inside, the other outside (001-15).
    pub(crate) fn walls(raster: &Raster) -> Self {
        Self::measure(raster, |one, other| one != other)
    }

    /// Returns the roof that a cut along the line divides: both sides inside.
    pub(crate) fn roof(raster: &Raster) -> Self {
        Self::measure(raster, |one, other| one && other)
    }

    fn measure(raster: &Raster, counts: fn(bool, bool) -> bool) -> Self {
        let (cols, rows) = (raster.cols(), raster.rows());
        let mut x = vec![0; (cols + 1) * (rows + 1)];
        let mut y = vec![0; (cols + 1) * (rows + 1)];
        for j in 0..rows {
            let step = raster.b.step(j);
            for i in 1..cols {
                let field = j * cols + i;
                let hit = counts(raster.inside[field - 1], raster.inside[field]);
                let at = j * (cols + 1) + i;
                x[at + cols + 1] = x[at] + if hit { step } else { 0 };
            }
        }
        for i in 0..cols {
            let step = raster.a.step(i);
            for j in 1..rows {
                let field = j * cols + i;
                let hit = counts(raster.inside[field - cols], raster.inside[field]);
                let at = i * (rows + 1) + j;
                y[at + rows + 1] = y[at] + if hit { step } else { 0 };
            }
        }
        Self { x, y, cols, rows }
    }

    /// Returns the length on line `n` of direction `line`, clipped to the interior of `s`, reduced.
    #[inline]
    pub(crate) fn within(&self, line: ScanDirection, n: usize, s: Span) -> u64 {
        match line {
            ScanDirection::X => {
                let width = self.cols + 1;
                self.x[s.j1 * width + n] - self.x[s.j0 * width + n]
            }
            ScanDirection::Y => {
                let width = self.rows + 1;
                self.y[s.i1 * width + n] - self.y[s.i0 * width + n]
            }
        }
    }
}

/// A scan line that may cut a cell.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub(crate) line: ScanDirection,
    /// Number of the grid line.
    pub(crate) n: usize,
    /// Wall length on it within the cell, above 0.
    pub(crate) wall: u64,
}

impl Candidate {
    /// Returns the order of ties: nearest to the middle of `s`, then smaller c, then x before y. If x and y tie, the
    /// letter compares the two coordinates of the author frame, so the origin counts.
    pub(crate) fn tie(&self, raster: &Raster, s: Span) -> (u128, i64, ScanDirection) {
        let (axis, lo, hi) = match self.line {
            ScanDirection::X => (&raster.a, s.i0, s.i1),
            ScanDirection::Y => (&raster.b, s.j0, s.j1),
        };
        let at = |n: usize| u128::from(axis.at[n]);
        let off_middle = (2 * at(self.n)).abs_diff(at(lo) + at(hi));
        (off_middle, axis.source[self.n], self.line)
    }
}

/// Returns the best of some cuts of `s`: the least rank, then the order of ties.
pub(crate) fn best<R: Ord>(
    raster: &Raster,
    s: Span,
    ranked: impl Iterator<Item = (R, Candidate)>,
) -> Option<Candidate> {
    let tie = |c: &Candidate| c.tie(raster, s);
    ranked
        .min_by(|(r, c), (q, d)| r.cmp(q).then_with(|| tie(c).cmp(&tie(d))))
        .map(|(_, best)| best)
}

/// Returns the scan lines strictly inside `s` with wall on them, x first.
pub(crate) fn candidates(walls: &Lengths, s: Span) -> impl Iterator<Item = Candidate> + '_ {
    let x = (s.i0 + 1..s.i1).map(|n| (ScanDirection::X, n));
    let y = (s.j0 + 1..s.j1).map(|n| (ScanDirection::Y, n));
    x.chain(y).filter_map(move |(line, n)| {
        let wall = walls.within(line, n, s);
        (wall > 0).then_some(Candidate { line, n, wall })
    })
}

/// Returns the two halves of `s`: left or lower first.
pub(crate) fn halves(s: Span, line: ScanDirection, n: usize) -> [Span; 2] {
    match line {
        ScanDirection::X => [Span { i1: n, ..s }, Span { i0: n, ..s }],
        ScanDirection::Y => [Span { j1: n, ..s }, Span { j0: n, ..s }],
    }
}
