//! `least-cut`: the best guillotine tree, exactly, by dynamic programming over all
//! rectangles of grid lines (`language.md` 4; `opt` in domain 3.5).
//!
//! Least roof cut, then fewest roofs, then the largest sum of squared areas: sums over the
//! halves, so the best tree of a rectangle is made of best trees. So is the last criterion,
//! the least sorted list of roofs: of two sets the one holding the least element of their
//! symmetric difference has the lesser list (their sizes are equal by then), and that element
//! stays the same whatever disjoint set joins both. Only rectangles on the way down from the
//! root ever need it, so ties are settled afterwards.

use super::plan::Cell;
use super::raster::{Raster, Span};
use super::scan::{Lengths, Line, halves};
use std::cmp::{Ordering, Reverse};

/// Most distinct coordinates on an axis for which the search is made.
pub(super) const MAX_LINES: usize = 32;

/// The roof cells before merging, in no particular order. Both axes need at most
/// [`MAX_LINES`] lines.
pub(super) fn cut(raster: &Raster) -> Vec<Cell> {
    let table = Table::fill(raster);
    let mut ties = Ties {
        table: &table,
        settled: Vec::new(),
    };
    if table.best[table.at(raster.span())].open {
        ties.settled = vec![None; table.best.len()];
        ties.settle(raster.span());
    }
    let mut spans = Vec::new();
    ties.roofs(raster.span(), &mut spans);
    spans.into_iter().map(|s| raster.cell(s)).collect()
}

/// What a rectangle's best tree reaches, in the order of comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Score {
    /// Roof cut, reduced length.
    cut: u64,
    roofs: u32,
    /// Sum of squared areas, reduced, saturating.
    squares: Reverse<u128>,
}

impl Score {
    fn plus(self, other: Self, cut: u64) -> Self {
        Self {
            cut: self.cut.saturating_add(other.cut).saturating_add(cut),
            roofs: self.roofs + other.roofs,
            squares: Reverse(self.squares.0.saturating_add(other.squares.0)),
        }
    }
}

#[derive(Clone, Copy, Debug)]
struct Best {
    score: Score,
    /// The first best cut; `None` = pure.
    cut: Option<(Line, u8)>,
    /// Fingerprint of its set of roofs: the sum of a hash of each, so that equal sets have equal
    /// sums, whatever the tree. (Should two sets ever collide, the first is kept.)
    print: u64,
    /// Whether another set of roofs scores the same, here or further down.
    open: bool,
}

impl Best {
    /// A rectangle without walls: a roof of its own if `area` is given, else nothing.
    fn pure(area: Option<u128>, s: Span) -> Self {
        let squares = area.map_or(0, |a| a.saturating_mul(a));
        Self {
            score: Score {
                cut: 0,
                roofs: u32::from(area.is_some()),
                squares: Reverse(squares),
            },
            cut: None,
            print: if area.is_some() { print(s) } else { 0 },
            open: false,
        }
    }

    /// What cutting a rectangle into these two reaches.
    fn joined(one: &Best, other: &Best, roof: u64, cut: (Line, u8)) -> Self {
        Self {
            score: one.score.plus(other.score, roof),
            cut: Some(cut),
            print: one.print.wrapping_add(other.print),
            open: one.open || other.open,
        }
    }

    /// Keeps the better of the two; of equals the first, open where they differ.
    fn or(&mut self, rival: Best) {
        match rival.score.cmp(&self.score) {
            Ordering::Less => *self = rival,
            Ordering::Equal => self.open |= rival.open || rival.print != self.print,
            Ordering::Greater => {}
        }
    }
}

struct Table<'r> {
    raster: &'r Raster,
    roof: Lengths,
    /// One entry a rectangle, see [`Table::at`].
    best: Vec<Best>,
    /// The roof cut of each once more, close together: it rules out most cuts.
    least: Vec<u64>,
}

impl<'r> Table<'r> {
    fn fill(raster: &'r Raster) -> Self {
        let (cols, rows) = (raster.cols(), raster.rows());
        let counts = counts(raster);
        let size = pairs(cols) * pairs(rows);
        let mut table = Self {
            raster,
            roof: Lengths::roof(raster),
            best: vec![Best::pure(None, raster.span()); size],
            least: vec![0; size],
        };
        for i1 in 1..=cols {
            for i0 in (0..i1).rev() {
                for j1 in 1..=rows {
                    for j0 in (0..j1).rev() {
                        let s = Span { i0, j0, i1, j1 };
                        let at = table.at(s);
                        let best = table.solve(s, &counts);
                        table.least[at] = best.score.cut;
                        table.best[at] = best;
                    }
                }
            }
        }
        table
    }

    /// Place of a rectangle: intervals i0 < i1 in the order of i1, then i0.
    #[inline]
    fn at(&self, s: Span) -> usize {
        (pairs(s.i1 - 1) + s.i0) * pairs(self.raster.rows()) + pairs(s.j1 - 1) + s.j0
    }

    fn solve(&self, s: Span, counts: &[u32]) -> Best {
        let stride = self.raster.cols() + 1;
        let to = |j: usize, i: usize| counts[j * stride + i];
        let inside = |s: Span| to(s.j1, s.i1) + to(s.j0, s.i0) - to(s.j0, s.i1) - to(s.j1, s.i0);
        let fields = inside(s) as usize;
        if fields == 0 {
            return Best::pure(None, s);
        }
        if fields == (s.i1 - s.i0) * (s.j1 - s.j0) {
            let (a, b) = (&self.raster.a.at, &self.raster.b.at);
            let area = u128::from(a[s.i1] - a[s.i0]) * u128::from(b[s.j1] - b[s.j0]);
            return Best::pure(Some(area), s);
        }
        // An empty margin may go first: it costs nothing, and a tree of the whole cuts what is
        // left just as some tree of what is left does.
        match margins(s).find(|(margin, ..)| inside(*margin) == 0) {
            Some((_, rest, cut)) => Best {
                cut: Some(cut),
                ..self.best[self.at(rest)]
            },
            None => self.best_cut(s),
        }
    }

    fn best_cut(&self, s: Span) -> Best {
        let mut best = Best::pure(None, s);
        best.score.cut = u64::MAX;
        best.score.roofs = u32::MAX;
        // The first criterion of `joined` alone, without its detours: here is where the time goes.
        let (least, stride) = (&self.least, pairs(self.raster.rows()));
        let (a, b) = (pairs(s.i1 - 1), pairs(s.j1 - 1));
        for n in s.i0 + 1..s.i1 {
            let one = least[(pairs(n - 1) + s.i0) * stride + b + s.j0];
            let other = least[(a + n) * stride + b + s.j0];
            let roof = self.roof.within(Line::X, n, s);
            if one.saturating_add(other).saturating_add(roof) <= best.score.cut {
                best.or(self.joined(s, Line::X, n));
            }
        }
        let row = &least[(a + s.i0) * stride..][..stride];
        for n in s.j0 + 1..s.j1 {
            let (one, other) = (row[pairs(n - 1) + s.j0], row[b + n]);
            let roof = self.roof.within(Line::Y, n, s);
            if one.saturating_add(other).saturating_add(roof) <= best.score.cut {
                best.or(self.joined(s, Line::Y, n));
            }
        }
        best
    }

    #[inline]
    fn joined(&self, s: Span, line: Line, n: usize) -> Best {
        let [one, other] = halves(s, line, n).map(|h| &self.best[self.at(h)]);
        Best::joined(one, other, self.roof.within(line, n, s), (line, n as u8))
    }
}

/// The outermost column or row at each side of `s`, what is left without it, and the cut between.
fn margins(s: Span) -> impl Iterator<Item = (Span, Span, (Line, u8))> {
    let x = [(s.i0 + 1, false), (s.i1 - 1, true)].map(|(n, last)| (Line::X, n, last));
    let y = [(s.j0 + 1, false), (s.j1 - 1, true)].map(|(n, last)| (Line::Y, n, last));
    let wide = x.into_iter().filter(move |_| s.i1 - s.i0 > 1);
    let deep = y.into_iter().filter(move |_| s.j1 - s.j0 > 1);
    wide.chain(deep).map(move |(line, n, last)| {
        let [one, other] = halves(s, line, n);
        let (margin, rest) = if last { (other, one) } else { (one, other) };
        (margin, rest, (line, n as u8))
    })
}

/// How many intervals there are between `fields + 1` lines.
#[inline]
fn pairs(fields: usize) -> usize {
    fields * (fields + 1) / 2
}

/// Prefix counts of the fields inside, `counts[j * (cols + 1) + i]`.
fn counts(raster: &Raster) -> Vec<u32> {
    let (cols, rows) = (raster.cols(), raster.rows());
    let stride = cols + 1;
    let mut counts = vec![0u32; stride * (rows + 1)];
    for j in 0..rows {
        let mut row = 0;
        for i in 0..cols {
            row += u32::from(raster.inside[j * cols + i]);
            counts[(j + 1) * stride + i + 1] = counts[j * stride + i + 1] + row;
        }
    }
    counts
}

/// A rectangle whose set of roofs is certain.
#[derive(Clone, Copy)]
struct Settled {
    cut: Option<(Line, u8)>,
    print: u64,
}

/// The last criterion, for the open rectangles on the way down from the root.
struct Ties<'t, 'r> {
    table: &'t Table<'r>,
    /// The open rectangles settled so far; empty if the root is not open.
    settled: Vec<Option<Settled>>,
}

impl Ties<'_, '_> {
    /// Settles `s` and whatever below it matters.
    fn settle(&mut self, s: Span) -> Settled {
        let at = self.table.at(s);
        let best = self.table.best[at];
        if let (true, Some(known)) = (best.open, self.settled[at]) {
            return known;
        }
        let first = Settled {
            cut: best.cut,
            print: best.print,
        };
        if !best.open {
            return first;
        }
        let found = self.least(s, best.score).unwrap_or(first);
        self.settled[at] = Some(found);
        found
    }

    /// Of the cuts that score the same, the one whose sorted list of roofs is least.
    fn least(&mut self, s: Span, score: Score) -> Option<Settled> {
        let mut least: Option<(Settled, Option<Vec<Span>>)> = None;
        let x = (s.i0 + 1..s.i1).map(|n| (Line::X, n));
        let y = (s.j0 + 1..s.j1).map(|n| (Line::Y, n));
        for (line, n) in x.chain(y) {
            if self.table.joined(s, line, n).score != score {
                continue;
            }
            let [one, other] = halves(s, line, n).map(|h| self.settle(h).print);
            let rival = Settled {
                cut: Some((line, n as u8)),
                print: one.wrapping_add(other),
            };
            least = Some(match least {
                None => (rival, None),
                Some(kept) if kept.0.print == rival.print => kept,
                Some((kept, list)) => {
                    let list = list.unwrap_or_else(|| self.list(s, kept));
                    let other = self.list(s, rival);
                    let lesser = other.iter().map(key).lt(list.iter().map(key));
                    if lesser {
                        (rival, Some(other))
                    } else {
                        (kept, Some(list))
                    }
                }
            });
        }
        least.map(|(kept, _)| kept)
    }

    /// The sorted roofs of `s` if it is cut as `by` says.
    fn list(&self, s: Span, by: Settled) -> Vec<Span> {
        let mut spans = Vec::new();
        if let Some((line, n)) = by.cut {
            for half in halves(s, line, usize::from(n)) {
                self.roofs(half, &mut spans);
            }
        }
        spans.sort_unstable_by_key(key);
        spans
    }

    /// Collects the roofs of a settled rectangle.
    fn roofs(&self, s: Span, into: &mut Vec<Span>) {
        let at = self.table.at(s);
        let best = &self.table.best[at];
        let settled = if best.open { self.settled[at] } else { None };
        match settled.map_or(best.cut, |known| known.cut) {
            Some((line, n)) => {
                for half in halves(s, line, usize::from(n)) {
                    self.roofs(half, into);
                }
            }
            None if best.score.roofs > 0 => into.push(s),
            None => {}
        }
    }
}

/// The place of a roof in a sorted list.
fn key(s: &Span) -> (usize, usize, usize, usize) {
    (s.j0, s.i0, s.j1, s.i1)
}

/// A well mixed number for a roof (splitmix64).
fn print(s: Span) -> u64 {
    let packed = [s.i0, s.j0, s.i1, s.j1]
        .iter()
        .fold(1u64, |sum, &n| sum << 6 | n as u64);
    let mut z = packed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
