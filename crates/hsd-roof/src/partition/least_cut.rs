//! `least-cut`: the best guillotine tree, exactly, by dynamic programming over all
//! rectangles of grid lines (`docs/contract.md` 4; `opt` in domain 3.5).
//!
//! Least roof cut, then fewest roofs narrower than a metre, then fewest roofs, then the largest sum of squared areas: sums over the
//! halves, so the best tree of a rectangle is made of best trees. So is the last criterion,
//! the least sorted list of roofs: of two sets the one holding the least element of their
//! symmetric difference has the lesser list (their sizes are equal by then), and that element
//! stays the same whatever disjoint set joins both. Only rectangles on the way down from the
//! root ever need it, so ties are settled afterwards.

use crate::partition::scan::{Lengths, ScanDirection, halves};
use hsd_base::geometry::STEPS;
use hsd_base::geometry::plan::Cell;
use hsd_base::geometry::plan::raster::{Raster, Span};
use std::cmp::{Ordering, Reverse};

/// Maximum number of distinct coordinates on an axis for which the search is made.
pub(crate) const MAX_LINES: usize = 32;

/// Returns the roof cells before merging, in no particular order, and the number of steps the search took; no cells if
/// it would take more than `most`. Both axes need at most [`MAX_LINES`] lines.
pub(crate) fn cut(raster: &Raster, most: u64) -> (Option<Vec<Cell>>, u64) {
    // If merely visiting all rectangles takes too long, the search is not begun.
    let size = interval(0, raster.cols() + 1) * interval(0, raster.rows() + 1);
    if size as u64 > most {
        return (None, 0);
    }
    let Some(search) = Search::fill(raster, most) else {
        return (None, most);
    };
    let mut ties = Ties {
        steps: search.steps,
        settled: vec![None; search.best.len()],
        search: &search,
    };
    let cells = ties.settle(raster.span()).map(|_| {
        let mut spans = Vec::new();
        ties.roofs(raster.span(), &mut spans);
        spans.into_iter().map(|s| raster.cell(s)).collect()
    });
    (cells, most - ties.steps)
}

/// Roofs of less width or depth are teeth on an outline: a metre, in steps of the usual unit. On coarser grids all roofs
/// are, and the criterion decides nothing.
const NARROW: i64 = STEPS * 11 / 10;

/// The score of a rectangle's best tree, in the order of comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Score {
    /// Roof cut, reduced length.
    cut: u64,
    /// Roofs narrower than [`NARROW`].
    narrow: u32,
    roofs: u32,
    /// Sum of squared areas, reduced, saturating.
    squares: Reverse<u128>,
}

impl Score {
    fn plus(self, other: Self, cut: u64) -> Self {
        Self {
            cut: self.cut.saturating_add(other.cut).saturating_add(cut),
            narrow: self.narrow + other.narrow,
            roofs: self.roofs + other.roofs,
            squares: Reverse(self.squares.0.saturating_add(other.squares.0)),
        }
    }
}

#[derive(Clone, Copy, Debug)]
struct Best {
    score: Score,
    /// The first best cut; `None` = pure.
    cut: Option<(ScanDirection, u8)>,
    /// Fingerprint of its set of roofs: the sum of a hash of each, so that equal sets have equal
    /// sums, whatever the tree. (Should two sets ever collide, the first is kept.)
    print: u64,
    /// True if another set of roofs scores the same, here or further down.
    open: bool,
}

impl Best {
    /// A rectangle without walls that is nothing but roof.
    fn roof(raster: &Raster, s: Span) -> Self {
        let area = raster.area(s);
        let cell = raster.cell(s);
        Self {
            score: Score {
                cut: 0,
                narrow: u32::from(cell.width().min(cell.depth()) < NARROW),
                roofs: 1,
                squares: Reverse(area.saturating_mul(area)),
            },
            cut: None,
            print: print(s),
            open: false,
        }
    }

    /// A rectangle without any roof.
    fn empty() -> Self {
        Self {
            score: Score {
                cut: 0,
                narrow: 0,
                roofs: 0,
                squares: Reverse(0),
            },
            cut: None,
            print: 0,
            open: false,
        }
    }

    /// Returns the score of cutting a rectangle into these two.
    fn joined(one: &Best, other: &Best, roof: u64, cut: (ScanDirection, u8)) -> Self {
        Self {
            score: one.score.plus(other.score, roof),
            cut: Some(cut),
            print: one.print.wrapping_add(other.print),
            open: one.open || other.open,
        }
    }

    /// Keeps the better of the two; of equals the first, open if they differ.
    fn or(&mut self, rival: Best) {
        match rival.score.cmp(&self.score) {
            Ordering::Less => *self = rival,
            Ordering::Equal => self.open |= rival.open || rival.print != self.print,
            Ordering::Greater => {}
        }
    }
}

/// All rectangles of grid lines, each solved after those inside it.
///
/// Three observations make most of them cheap without changing the result:
/// - Empty margins are trimmed off: a tree of the whole cuts the rest just as some tree of the rest does.
/// - A cut that divides no roof goes first and alone, for the same reason.
/// - A line without wall in a rectangle never cuts it best: moved aside until it meets a wall or another
///   cut, it would divide no more roof in one of the two directions, and where both are equal the squares
///   of the areas beside it, being convex, grow in one.
struct Search<'r> {
    raster: &'r Raster,
    roof: Lengths,
    /// Marks between two lines b = c, for each interval as numbered by [`interval`].
    across: Vec<Marks>,
    /// Marks between two lines a = c, likewise.
    along: Vec<Marks>,
    /// For each rectangle, see [`Search::at`], the index in `best` of its trimmed rectangle.
    place: Vec<u32>,
    /// The roof cut of each again, stored compactly: it rules out most cuts.
    least: Vec<u64>,
    /// The best trees; the first one is that of all empty rectangles.
    best: Vec<Best>,
    /// The remaining number of rectangles and cuts to examine.
    steps: u64,
}

/// The content of a strip between two lines, as bits.
#[derive(Clone, Copy, Debug, Default)]
struct Marks {
    /// The inner lines across it that have wall in it.
    walls: u32,
    /// The fields across it with roof in it.
    roofs: u32,
}

impl<'r> Search<'r> {
    /// Solves all rectangles; `None` if that takes more steps.
    fn fill(raster: &'r Raster, steps: u64) -> Option<Self> {
        let (cols, rows) = (raster.cols(), raster.rows());
        let size = interval(0, cols + 1) * interval(0, rows + 1);
        let field = |i: usize, j: usize| u32::from(raster.inside[j * cols + i]);
        let row = |j: usize| (0..cols).fold(0, |bits, i| bits | field(i, j) << i);
        let col = |i: usize| (0..rows).fold(0, |bits, j| bits | field(i, j) << j);
        let mut search = Self {
            raster,
            roof: Lengths::roof(raster),
            across: marks(rows, cols, row),
            along: marks(cols, rows, col),
            steps: steps.checked_sub(size as u64)?,
            place: vec![0; size],
            least: vec![0; size],
            best: vec![Best::empty()],
        };
        for i1 in 1..=cols {
            for i0 in (0..i1).rev() {
                for j1 in 1..=rows {
                    for j0 in (0..j1).rev() {
                        search.solve(Span { i0, j0, i1, j1 })?;
                    }
                }
            }
        }
        Some(search)
    }

    /// Returns the index of a rectangle.
    #[inline]
    fn at(&self, s: Span) -> usize {
        interval(s.i0, s.i1) * interval(0, self.raster.rows() + 1) + interval(s.j0, s.j1)
    }

    #[inline]
    fn best(&self, s: Span) -> &Best {
        &self.best[self.place[self.at(s)] as usize]
    }

    /// Returns a rectangle without its empty margins; `None` if all of it is empty.
    fn trimmed(&self, s: Span) -> Option<Span> {
        let cols = self.across[interval(s.j0, s.j1)].roofs & bits(s.i0, s.i1);
        if cols == 0 {
            return None;
        }
        let (i0, i1) = ends(cols);
        let (j0, j1) = ends(self.along[interval(i0, i1)].roofs & bits(s.j0, s.j1));
        Some(Span { i0, j0, i1, j1 })
    }

    /// Returns the lines with wall in a rectangle.
    fn walls(&self, s: Span) -> impl Iterator<Item = (ScanDirection, usize)> + use<> {
        let x = self.across[interval(s.j0, s.j1)].walls & bits(s.i0 + 1, s.i1);
        let y = self.along[interval(s.i0, s.i1)].walls & bits(s.j0 + 1, s.j1);
        ones(x, ScanDirection::X).chain(ones(y, ScanDirection::Y))
    }

    /// Solves a rectangle after those inside it; `None` if the steps are used up.
    fn solve(&mut self, s: Span) -> Option<()> {
        let Some(rest) = self.trimmed(s) else {
            return Some(());
        };
        let at = self.at(s);
        if rest != s {
            let of = self.at(rest);
            (self.place[at], self.least[at]) = (self.place[of], self.least[of]);
            return Some(());
        }
        let best = match self.best_cut(s)? {
            Some(best) => best,
            None => Best::roof(self.raster, s),
        };
        self.place[at] = self.best.len() as u32;
        self.least[at] = best.score.cut;
        self.best.push(best);
        Some(())
    }

    /// Returns the best cut of a rectangle; `None` if it has no walls.
    fn best_cut(&mut self, s: Span) -> Option<Option<Best>> {
        let mut best: Option<Best> = None;
        let mut most = u64::MAX;
        for (line, n) in self.walls(s) {
            self.steps = self.steps.checked_sub(1)?;
            let roof = self.roof.within(line, n, s);
            if roof == 0 {
                return Some(Some(self.joined(s, line, n)));
            }
            // The first criterion alone, inlined: most of the time is spent here.
            let [one, other] = halves(s, line, n).map(|half| self.least[self.at(half)]);
            if one.saturating_add(other).saturating_add(roof) > most {
                continue;
            }
            let rival = self.joined(s, line, n);
            match &mut best {
                Some(best) => best.or(rival),
                None => best = Some(rival),
            }
            most = best.map_or(most, |b| b.score.cut);
        }
        Some(best)
    }

    fn joined(&self, s: Span, line: ScanDirection, n: usize) -> Best {
        let [one, other] = halves(s, line, n).map(|half| self.best(half));
        Best::joined(one, other, self.roof.within(line, n, s), (line, n as u8))
    }
}

/// Returns the index of the interval from line `lo` to line `hi`: in the order of `hi`, then `lo`. With 0 and one more
/// than the fields it is the number of all intervals.
#[inline]
fn interval(lo: usize, hi: usize) -> usize {
    hi * (hi - 1) / 2 + lo
}

/// Returns the bits from `lo` up to but excluding `hi`, at most 31.
#[inline]
fn bits(lo: usize, hi: usize) -> u32 {
    (1u32 << hi) - (1u32 << lo.min(hi))
}

/// Returns the first of some bits and the one after the last.
fn ends(bits: u32) -> (usize, usize) {
    let (lo, hi) = (bits.trailing_zeros(), u32::BITS - bits.leading_zeros());
    (lo as usize, hi as usize)
}

/// Returns the lines whose bits are set, in ascending order.
fn ones(mut bits: u32, line: ScanDirection) -> impl Iterator<Item = (ScanDirection, usize)> {
    std::iter::from_fn(move || {
        let n = bits.trailing_zeros();
        bits &= bits.checked_sub(1)?;
        Some((line, n as usize))
    })
}

/// Returns the marks of all intervals of `count` strips, each with the bits of its fields inside.
fn marks(count: usize, fields: usize, strip: impl Fn(usize) -> u32) -> Vec<Marks> {
    let mut marks = vec![Marks::default(); interval(0, count + 1)];
    for hi in 1..=count {
        let roofs = strip(hi - 1);
        let walls = (roofs ^ (roofs << 1)) & bits(1, fields);
        for lo in 0..hi {
            let before = if lo + 1 < hi {
                marks[interval(lo, hi - 1)]
            } else {
                Marks::default()
            };
            marks[interval(lo, hi)] = Marks {
                walls: before.walls | walls,
                roofs: before.roofs | roofs,
            };
        }
    }
    marks
}

/// A rectangle whose set of roofs is certain.
#[derive(Clone, Copy)]
struct Settled {
    cut: Option<(ScanDirection, u8)>,
    print: u64,
}

/// The last criterion, for the open rectangles on the way down from the root.
struct Ties<'t, 'r> {
    search: &'t Search<'r>,
    /// The open rectangles settled so far.
    settled: Vec<Option<Settled>>,
    /// The remaining number of roofs to compare.
    steps: u64,
}

impl Ties<'_, '_> {
    /// Settles `s` and the relevant rectangles below it; `None` if the steps are used up.
    fn settle(&mut self, s: Span) -> Option<Settled> {
        let (at, best) = (self.search.place[self.search.at(s)], self.search.best(s));
        let first = Settled {
            cut: best.cut,
            print: best.print,
        };
        if !best.open {
            return Some(first);
        }
        if let Some(known) = self.settled[at as usize] {
            return Some(known);
        }
        // The cuts of a rectangle are those of its trimmed rectangle.
        let rest = self.search.trimmed(s).unwrap_or(s);
        let found = self.least(rest, best.score)?.unwrap_or(first);
        self.settled[at as usize] = Some(found);
        Some(found)
    }

    /// Returns, of the cuts that score the same, the one whose sorted list of roofs is least.
    fn least(&mut self, s: Span, score: Score) -> Option<Option<Settled>> {
        let mut least: Option<(Settled, Option<Vec<Span>>)> = None;
        for (line, n) in self.search.walls(s) {
            if self.search.joined(s, line, n).score != score {
                continue;
            }
            let [one, other] = halves(s, line, n);
            let prints = [self.settle(one)?.print, self.settle(other)?.print];
            let rival = Settled {
                cut: Some((line, n as u8)),
                print: prints[0].wrapping_add(prints[1]),
            };
            least = Some(match least {
                None => (rival, None),
                Some(kept) if kept.0.print == rival.print => kept,
                Some((kept, list)) => {
                    self.steps = self.steps.checked_sub(u64::from(score.roofs))?;
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
        Some(least.map(|(kept, _)| kept))
    }

    /// Returns the sorted roofs of `s` if it is cut according to `by`.
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
        let Some(rest) = self.search.trimmed(s) else {
            return;
        };
        let (at, best) = (self.search.place[self.search.at(s)], self.search.best(s));
        let settled = self.settled[at as usize].filter(|_| best.open);
        match settled.map_or(best.cut, |known| known.cut) {
            Some((line, n)) => {
                for half in halves(rest, line, usize::from(n)) {
                    self.roofs(half, into);
                }
            }
            None => into.push(rest),
        }
    }
}

/// Returns the position of a roof in a sorted list.
fn key(s: &Span) -> (usize, usize, usize, usize) {
    (s.j0, s.i0, s.j1, s.i1)
}

/// Returns a well-mixed hash of a roof (splitmix64).
fn print(s: Span) -> u64 {
    let packed = [s.i0, s.j0, s.i1, s.j1]
        .iter()
        .fold(1u64, |sum, &n| sum << 6 | n as u64);
    let mut z = packed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
