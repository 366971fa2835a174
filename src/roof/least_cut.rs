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
use std::collections::BTreeMap;

/// Most distinct coordinates on an axis for which the search is made.
pub(super) const MAX_LINES: usize = 32;

/// The roof cells before merging, in no particular order. Both axes need at most
/// [`MAX_LINES`] lines.
pub(super) fn cut(raster: &Raster) -> Vec<Cell> {
    let table = Table::fill(raster);
    let mut ties = Ties {
        table: &table,
        settled: BTreeMap::new(),
    };
    ties.settle(raster.span());
    let mut spans = Vec::new();
    ties.roofs(raster.span(), &mut spans);
    spans.into_iter().map(|s| raster.cell(s)).collect()
}

/// What a rectangle's best tree reaches, in the order of comparison.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
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

#[derive(Clone, Copy)]
struct Best {
    score: Score,
    /// The first best cut; `None` = pure.
    cut: Option<(Line, u8)>,
    /// Whether another cut scores the same.
    tied: bool,
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
        let blank = Score {
            cut: 0,
            roofs: 0,
            squares: Reverse(0),
        };
        let size = pairs(cols) * pairs(rows);
        let best = vec![
            Best {
                score: blank,
                cut: None,
                tied: false
            };
            size
        ];
        let least = vec![0; size];
        let mut table = Self {
            raster,
            roof: Lengths::roof(raster),
            best,
            least,
        };
        for i1 in 1..=cols {
            for i0 in (0..i1).rev() {
                for j1 in 1..=rows {
                    for j0 in (0..j1).rev() {
                        let s = Span { i0, j0, i1, j1 };
                        let at = table.at(s);
                        let best = table.solve(s, &counts);
                        table.best[at] = best;
                        table.least[at] = best.score.cut;
                    }
                }
            }
        }
        table
    }

    /// Place of a rectangle: intervals i0 < i1 in the order of i1, then i0.
    #[inline]
    fn at(&self, s: Span) -> usize {
        let a = s.i1 * (s.i1 - 1) / 2 + s.i0;
        let b = s.j1 * (s.j1 - 1) / 2 + s.j0;
        a * pairs(self.raster.rows()) + b
    }

    fn solve(&self, s: Span, counts: &[u32]) -> Best {
        let stride = self.raster.cols() + 1;
        let to = |j: usize, i: usize| counts[j * stride + i];
        let inside = to(s.j1, s.i1) + to(s.j0, s.i0) - to(s.j0, s.i1) - to(s.j1, s.i0);
        if inside == 0 {
            let score = Score {
                cut: 0,
                roofs: 0,
                squares: Reverse(0),
            };
            return Best {
                score,
                cut: None,
                tied: false,
            };
        }
        if inside as usize == (s.i1 - s.i0) * (s.j1 - s.j0) {
            let (a, b) = (&self.raster.a.at, &self.raster.b.at);
            let area = u128::from(a[s.i1] - a[s.i0]) * u128::from(b[s.j1] - b[s.j0]);
            let score = Score {
                cut: 0,
                roofs: 1,
                squares: Reverse(area.saturating_mul(area)),
            };
            return Best {
                score,
                cut: None,
                tied: false,
            };
        }
        self.best_cut(s)
    }

    fn best_cut(&self, s: Span) -> Best {
        let worst = Score {
            cut: u64::MAX,
            roofs: u32::MAX,
            squares: Reverse(0),
        };
        let mut best = Best {
            score: worst,
            cut: None,
            tied: false,
        };
        let mut consider = |least: u64, line, n: usize| {
            if least > best.score.cut {
                return;
            }
            let score = self.score(s, line, n);
            match score.cmp(&best.score) {
                Ordering::Less => {
                    best = Best {
                        score,
                        cut: Some((line, n as u8)),
                        tied: false,
                    }
                }
                Ordering::Equal => best.tied = true,
                Ordering::Greater => {}
            }
        };
        // The same as `score` for the first criterion alone, without its detours: this is where
        // the time goes.
        let (least, stride) = (&self.least, pairs(self.raster.rows()));
        let (a, b) = (pairs(s.i1 - 1), pairs(s.j1 - 1));
        for n in s.i0 + 1..s.i1 {
            let one = least[(pairs(n - 1) + s.i0) * stride + b + s.j0];
            let other = least[(a + n) * stride + b + s.j0];
            let roof = self.roof.within(Line::X, n, s);
            consider(one.saturating_add(other).saturating_add(roof), Line::X, n);
        }
        let row = &least[(a + s.i0) * stride..][..stride];
        for n in s.j0 + 1..s.j1 {
            let (one, other) = (row[pairs(n - 1) + s.j0], row[b + n]);
            let roof = self.roof.within(Line::Y, n, s);
            consider(one.saturating_add(other).saturating_add(roof), Line::Y, n);
        }
        best
    }

    #[inline]
    fn score(&self, s: Span, line: Line, n: usize) -> Score {
        let [one, other] = halves(s, line, n).map(|h| self.best[self.at(h)].score);
        one.plus(other, self.roof.within(line, n, s))
    }
}

/// The cuts of a rectangle, x first.
fn cuts(s: Span) -> impl Iterator<Item = (Line, usize)> {
    (s.i0 + 1..s.i1)
        .map(|n| (Line::X, n))
        .chain((s.j0 + 1..s.j1).map(|n| (Line::Y, n)))
}

/// How many intervals `fields + 1` lines have.
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

/// A rectangle whose tie is settled: its cut, and a fingerprint of its set of roofs.
#[derive(Clone, Copy)]
struct Settled {
    cut: Option<(Line, u8)>,
    /// Sum of 128-bit hashes of the roofs: equal sets have equal sums, whatever the tree.
    print: u128,
}

struct Ties<'t, 'r> {
    table: &'t Table<'r>,
    settled: BTreeMap<usize, Settled>,
}

impl Ties<'_, '_> {
    /// Settles `s` and whatever below it matters.
    fn settle(&mut self, s: Span) -> Settled {
        let at = self.table.at(s);
        if let Some(known) = self.settled.get(&at) {
            return *known;
        }
        let best = self.table.best[at];
        let found = match best.cut {
            None if best.score.roofs == 0 => Settled {
                cut: None,
                print: 0,
            },
            None => Settled {
                cut: None,
                print: print(s),
            },
            Some(cut) if !best.tied => self.try_cut(s, cut),
            Some(_) => self.least(s, best.score),
        };
        self.settled.insert(at, found);
        found
    }

    fn try_cut(&mut self, s: Span, cut: (Line, u8)) -> Settled {
        let [one, other] = halves(s, cut.0, usize::from(cut.1)).map(|h| self.settle(h).print);
        Settled {
            cut: Some(cut),
            print: one.wrapping_add(other),
        }
    }

    /// Of the cuts that score the same, the one whose sorted list of roofs is least.
    fn least(&mut self, s: Span, score: Score) -> Settled {
        let mut least: Option<(Settled, Option<Vec<Span>>)> = None;
        for (line, n) in cuts(s) {
            if self.table.score(s, line, n) != score {
                continue;
            }
            let rival = self.try_cut(s, (line, n as u8));
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
        least.map_or(
            Settled {
                cut: None,
                print: 0,
            },
            |(kept, _)| kept,
        )
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
        match self.settled.get(&at).and_then(|known| known.cut) {
            Some((line, n)) => {
                for half in halves(s, line, usize::from(n)) {
                    self.roofs(half, into);
                }
            }
            None if self.table.best[at].score.roofs > 0 => into.push(s),
            None => {}
        }
    }
}

fn key(s: &Span) -> (usize, usize, usize, usize) {
    (s.j0, s.i0, s.j1, s.i1)
}

/// A well mixed number for a roof (splitmix64, twice).
fn print(s: Span) -> u128 {
    let packed = [s.i0, s.j0, s.i1, s.j1]
        .iter()
        .fold(1u64, |sum, &n| sum << 6 | n as u64);
    u128::from(mix(packed)) << 64 | u128::from(mix(packed ^ 0x5bd1_e995_9e37_79b9))
}

fn mix(seed: u64) -> u64 {
    let mut z = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
