//! Lengths along the scan lines of a raster, as prefix sums: how much of a line inside a
//! cell is wall, and how much of it divides roof.

use super::raster::{Raster, Span};

/// Which way a scan line runs; `X` sorts first, as "x before y" demands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Line {
    /// The line a = c (x in domain 3).
    X,
    /// The line b = c (y in domain 3).
    Y,
}

/// Prefix sums of one kind of length along every grid line.
#[derive(Debug)]
pub(super) struct Lengths {
    /// Line i of axis a: `x[i * (rows + 1) + j]` = length in front of line j.
    x: Vec<u64>,
    /// Line j of axis b: `y[j * (cols + 1) + i]` = length right of line i.
    y: Vec<u64>,
    cols: usize,
    rows: usize,
}

impl Lengths {
    /// Outer wall: one side inside, the other outside (001-15).
    pub(super) fn walls(raster: &Raster) -> Self {
        Self::measure(raster, |one, other| one != other)
    }

    /// Roof that a cut along the line divides: both sides inside.
    pub(super) fn roof(raster: &Raster) -> Self {
        Self::measure(raster, |one, other| one && other)
    }

    fn measure(raster: &Raster, counts: fn(bool, bool) -> bool) -> Self {
        let (cols, rows) = (raster.cols(), raster.rows());
        let mut x = vec![0; (cols + 1) * (rows + 1)];
        let mut y = vec![0; (cols + 1) * (rows + 1)];
        for i in 1..cols {
            for j in 0..rows {
                let field = j * cols + i;
                let hit = counts(raster.inside[field - 1], raster.inside[field]);
                let at = i * (rows + 1) + j;
                x[at + 1] = x[at] + if hit { raster.b.step(j) } else { 0 };
            }
        }
        for j in 1..rows {
            for i in 0..cols {
                let field = j * cols + i;
                let hit = counts(raster.inside[field - cols], raster.inside[field]);
                let at = j * (cols + 1) + i;
                y[at + 1] = y[at] + if hit { raster.a.step(i) } else { 0 };
            }
        }
        Self { x, y, cols, rows }
    }

    /// Length on line `n` of direction `line`, clipped to the interior of `s`, reduced.
    #[inline]
    pub(super) fn within(&self, line: Line, n: usize, s: Span) -> u64 {
        match line {
            Line::X => {
                let at = n * (self.rows + 1);
                self.x[at + s.j1] - self.x[at + s.j0]
            }
            Line::Y => {
                let at = n * (self.cols + 1);
                self.y[at + s.i1] - self.y[at + s.i0]
            }
        }
    }
}

/// A scan line that may cut a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub(super) line: Line,
    /// Number of the grid line.
    pub(super) n: usize,
    /// Wall length on it within the cell, above 0.
    pub(super) wall: u64,
    /// Twice its distance from the cell's middle.
    off_middle: u128,
    /// Its coordinate in the plan's own steps: where x and y tie, the letter compares the two
    /// coordinates of the author frame, so the origin counts.
    at: i64,
}

impl Candidate {
    /// The order of ties: nearest to the cell's middle, then smaller c, then x before y.
    pub(super) fn tie(&self) -> (u128, i64, Line) {
        (self.off_middle, self.at, self.line)
    }
}

/// The scan lines strictly inside `s` with wall on them, x first.
pub(super) fn candidates<'r>(
    raster: &'r Raster,
    walls: &'r Lengths,
    s: Span,
) -> impl Iterator<Item = Candidate> + 'r {
    let x = (s.i0 + 1..s.i1).map(|n| (Line::X, n));
    let y = (s.j0 + 1..s.j1).map(|n| (Line::Y, n));
    x.chain(y).filter_map(move |(line, n)| {
        let wall = walls.within(line, n, s);
        let (axis, lo, hi) = match line {
            Line::X => (&raster.a, s.i0, s.i1),
            Line::Y => (&raster.b, s.j0, s.j1),
        };
        let at = &axis.at;
        let off_middle = (2 * u128::from(at[n])).abs_diff(u128::from(at[lo]) + u128::from(at[hi]));
        (wall > 0).then(|| Candidate {
            line,
            n,
            wall,
            off_middle,
            at: axis.source[n],
        })
    })
}

/// The two halves of `s`: left or lower first.
pub(super) fn halves(s: Span, line: Line, n: usize) -> [Span; 2] {
    match line {
        Line::X => [Span { i1: n, ..s }, Span { i0: n, ..s }],
        Line::Y => [Span { j1: n, ..s }, Span { j0: n, ..s }],
    }
}
