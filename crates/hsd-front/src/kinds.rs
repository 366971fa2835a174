//! Which cells of a wall show the same part, and which are hidden by something that stands before them.

mod before;

use super::cells::{Cell, Likeness, SIDE, are_equal, compare};
use before::Before;
use std::collections::BTreeSet;

/// The part of two cells that agrees if they show the same.
const SAME: f64 = 0.93;
/// The part of a hidden cell that agrees with what it shows, at least.
const HIDDEN: f64 = 0.36;
/// The same where nothing else has to tell that something stands before it.
const SURE: f64 = 0.75;
/// The part of two cells of one storey or bay that agrees if they show the same behind what hides one of them, at least.
const BOTH: f64 = 0.45;
/// The share of a cell that may differ although its colours are not those of obstacles before the wall.
const UNTOLD: f64 = 0.12;
/// The same where the blot goes on from a cell beside it.
const COVERED: f64 = 0.12;
/// The least part of a cell that something before it hides.
const BLOT: f64 = 0.02;
/// The part of what differs that is mirrored if it was built so.
const EVEN: f64 = 0.7;
/// More than this part of a cell is nearly everything.
const MUCH: f64 = 0.75;

/// What a cell shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown {
    /// The cell whose picture stands for it: itself, or the clean one of its kind.
    pub as_cell: usize,
    /// How far it agrees with that, 0 to 1.
    pub likeness: f64,
    /// How much brighter that one is.
    pub gain: f32,
    /// Whether something stands before it.
    pub is_replaced: bool,
    /// Whether it is not seen whole, and nothing clean stands for it.
    pub is_spoiled: bool,
}

/// Says what each cell shows.
pub fn sorted(cells: &[Cell]) -> Vec<Shown> {
    let pairs = pairs(cells);
    let pair = |a: usize, b: usize| pairs[a * cells.len() + b].as_ref();
    let mut shown: Vec<Option<Shown>> = vec![None; cells.len()];
    let whole: Vec<bool> = cells.iter().map(Cell::is_whole).collect();
    // The cell with which most others agree stands for its kind.
    loop {
        let free = |k: &usize| shown[*k].is_none() && whole[*k];
        let mates = |k: usize| -> Vec<usize> {
            let is_mate = |m: &usize| *m == k || pair(k, *m).is_some_and(|p| p.share >= SAME);
            (0..cells.len()).filter(free).filter(is_mate).collect()
        };
        let core = (0..cells.len())
            .filter(free)
            .map(|k| (mates(k), k))
            .max_by(|a, b| {
                let sum = |of: &(Vec<usize>, usize)| -> f64 {
                    let pairs = of.0.iter().filter_map(|m| pair(of.1, *m));
                    pairs.map(|p| p.share).sum()
                };
                sum(a).total_cmp(&sum(b)).then(b.1.cmp(&a.1))
            });
        let Some((mates, core)) = core.filter(|c| c.0.len() > 1) else {
            break;
        };
        for mate in mates {
            shown[mate] = Some(standing(pair(mate, core), core, false));
        }
    }
    settle(&mut shown, cells, &whole, (SURE, None), &pair);
    let before = Before::of(cells, &shown, &pair);
    paired(&mut shown, cells, &whole, &before, &pair);
    if before.is_known() {
        settle(&mut shown, cells, &whole, (SURE, None), &pair);
        for k in 0..cells.len() {
            if shown[k].is_none() {
                shown[k] = told(k, cells, &shown, &before, &pair);
            }
        }
    } else {
        settle(&mut shown, cells, &whole, (HIDDEN, Some(&before)), &pair);
    }
    // Trees are larger than bays: twice over.
    for _ in 0..2 {
        for k in 0..cells.len() {
            if shown[k].is_none() {
                shown[k] = covered(k, cells, &shown, whole[k], &before, &pair);
            }
        }
    }
    (0..cells.len())
        .map(|k| {
            shown[k].unwrap_or(Shown {
                is_spoiled: !whole[k],
                ..standing(None, k, false)
            })
        })
        .collect()
}

/// Finds replacements for partly hidden cells: another cell that agrees in at least this share. Where colours of obstacles are
/// given, what hides a cell has to have them.
fn settle<'p>(
    shown: &mut [Option<Shown>],
    cells: &[Cell],
    whole: &[bool],
    least: (f64, Option<&Before>),
    pair: &dyn Fn(usize, usize) -> Option<&'p Likeness>,
) {
    for k in 0..cells.len() {
        if shown[k].is_none() {
            shown[k] = hidden(k, cells, shown, whole, least, pair);
        }
    }
}

/// Cells of one storey or bay that show the same, but that something hides a part of one: the other stands for both.
fn paired<'p>(
    shown: &mut [Option<Shown>],
    cells: &[Cell],
    whole: &[bool],
    before: &Before,
    pair: &dyn Fn(usize, usize) -> Option<&'p Likeness>,
) {
    loop {
        let free: Vec<usize> = (0..cells.len())
            .filter(|k| shown[*k].is_none() && whole[*k])
            .collect();
        let both = free.iter().flat_map(|a| free.iter().map(move |b| (*a, *b)));
        let mates = both.filter_map(|(core, mate)| {
            let (a, b) = (&cells[core], &cells[mate]);
            let likeness = (core != mate && (a.row == b.row || a.column == b.column))
                .then(|| pair(mate, core))??;
            let untold = before.untold(b, likeness).min(before.untold(a, likeness));
            let is_mate = likeness.share >= BOTH && untold <= UNTOLD;
            // The one that is free of what stands before the wall stands for the other.
            let covers = |cell: &Cell| 1.0 - likeness.share - before.untold(cell, likeness);
            (is_mate && covers(b) >= covers(a)).then_some((core, mate, likeness))
        });
        let best = mates.max_by(|a, b| a.2.share.total_cmp(&b.2.share));
        let Some((core, mate, likeness)) = best else {
            return;
        };
        shown[core] = Some(standing(None, core, false));
        shown[mate] = Some(standing(Some(likeness), core, true));
    }
}

/// Returns the replacement of a cell, if everything that differs has the colours of obstacles before the wall.
fn told<'p>(
    k: usize,
    cells: &[Cell],
    shown: &[Option<Shown>],
    before: &Before,
    pair: &dyn Fn(usize, usize) -> Option<&'p Likeness>,
) -> Option<Shown> {
    let cores = (0..cells.len()).filter(|m| shown[*m].is_some_and(|s| s.as_cell == *m));
    let tried = cores.filter_map(|core| {
        let likeness = pair(k, core).filter(|_| may_show(k, core, cells, shown))?;
        let untold = before.untold(&cells[k], likeness);
        let score = untold - nearness(k, core, cells, shown);
        (untold <= UNTOLD && likeness.share >= COVERED).then_some((core, likeness, score))
    });
    let (core, likeness, _) = tried.min_by(|a, b| a.2.total_cmp(&b.2))?;
    Some(standing(Some(likeness), core, true))
}

/// Whether a kind may stand in the storey of a cell: where all that is known of it is found in no other storey, as of many a ground
/// storey, nothing of another one stands for a part of it.
fn may_show(k: usize, core: usize, cells: &[Cell], shown: &[Option<Shown>]) -> bool {
    let row = cells[k].row;
    let kinds = |is_in: &dyn Fn(usize) -> bool| -> BTreeSet<usize> {
        let known = (0..cells.len()).filter(|m| is_in(cells[*m].row));
        let known = known.filter_map(|m| shown[m].filter(|s| !s.is_replaced));
        known.map(|s| s.as_cell).collect()
    };
    let (own, others) = (kinds(&|r| r == row), kinds(&|r| r != row));
    own.is_empty() || own.contains(&core) || !own.is_disjoint(&others)
}

/// How much nearer to a cell than any other a kind is seen: in its storey, in its bay.
fn nearness(k: usize, core: usize, cells: &[Cell], shown: &[Option<Shown>]) -> f64 {
    let near = |m: usize| match (
        cells[m].row == cells[k].row,
        cells[m].column == cells[k].column,
    ) {
        (true, _) => 0.06,
        (false, true) => 0.04,
        (false, false) => 0.0,
    };
    let own = (0..cells.len()).filter(|m| shown[*m].is_some_and(|s| s.as_cell == core));
    own.map(near).fold(0.0, f64::max)
}

fn pairs(cells: &[Cell]) -> Vec<Option<Likeness>> {
    use rayon::prelude::*;
    let count = cells.len();
    let one = |k: usize| match (k / count, k % count) {
        (a, b) if a == b => None,
        (a, b) => compare(&cells[a], &cells[b]),
    };
    (0..count * count).into_par_iter().map(one).collect()
}

fn standing(pair: Option<&Likeness>, for_it: usize, is_replaced: bool) -> Shown {
    Shown {
        as_cell: for_it,
        likeness: pair.map_or(1.0, |p| p.share),
        gain: pair.map_or(1.0, |p| p.gain),
        is_replaced,
        is_spoiled: false,
    }
}

/// What stands for a cell that agrees with no other whole one, if something hides a part of it.
fn hidden<'p>(
    k: usize,
    cells: &[Cell],
    shown: &[Option<Shown>],
    whole: &[bool],
    (least, before): (f64, Option<&Before>),
    pair: &dyn Fn(usize, usize) -> Option<&'p Likeness>,
) -> Option<Shown> {
    let is_core = |m: &usize| shown[*m].is_some_and(|s| s.as_cell == *m);
    let cores = (0..cells.len())
        .filter(is_core)
        .filter(|core| may_show(k, *core, cells, shown))
        .filter_map(|m| Some((m, pair(k, m)?)));
    let (core, likeness) = cores
        .map(|(m, p)| (m, p, p.share + nearness(k, m, cells, shown)))
        .max_by(|a, b| a.2.total_cmp(&b.2).then(b.0.cmp(&a.0)))
        .map(|(m, p, _)| (m, p))?;
    let blot = likeness.off.iter().filter(|o| **o).count() as f64 / (SIDE * SIDE) as f64;
    let is_before = before.is_none_or(|b| b.untold(&cells[k], likeness) <= UNTOLD);
    let is_hidden =
        !whole[k] || (is_before && likeness.share >= least && blot >= BLOT && comes_in(likeness));
    is_hidden.then(|| standing(Some(likeness), core, true))
}

/// Whether what differs comes in over the border of the cell: trees and wires do, curtains and blinds do not.
fn comes_in(likeness: &Likeness) -> bool {
    borders(likeness).into_iter().any(|most| most >= 2) && !is_even(likeness)
}

/// Samples that differ at the left, upper, right and lower border.
fn borders(likeness: &Likeness) -> [usize; 4] {
    let at = |x: usize, y: usize| usize::from(likeness.off[y * SIDE + x]);
    let last = SIDE - 1;
    [
        (0..SIDE).map(|t| at(0, t).max(at(1, t))).sum(),
        (0..SIDE).map(|t| at(t, 0).max(at(t, 1))).sum(),
        (0..SIDE).map(|t| at(last, t).max(at(last - 1, t))).sum(),
        (0..SIDE).map(|t| at(t, last).max(at(t, last - 1))).sum(),
    ]
}

/// Whether what differs is the same on the left and on the right: then it was built so, as a door between shop windows.
fn is_even(likeness: &Likeness) -> bool {
    let at = |k: usize| likeness.off[k];
    let (mut both, mut either) = (0, 0);
    for k in 0..SIDE * SIDE {
        let mirrored = k / SIDE * SIDE + (SIDE - 1 - k % SIDE);
        both += usize::from(at(k) && at(mirrored));
        either += usize::from(at(k) || at(mirrored));
    }
    // Where nearly everything differs that says nothing.
    both as f64 > EVEN * either as f64 && (either as f64) < MUCH * (SIDE * SIDE) as f64
}

/// What stands for a cell of which next to nothing is seen, since a mask hides it, or what hides a cell beside it goes on over it:
/// what its bay shows in other storeys, else what its storey shows in other bays.
fn covered<'p>(
    k: usize,
    cells: &[Cell],
    shown: &[Option<Shown>],
    is_whole: bool,
    before: &Before,
    pair: &dyn Fn(usize, usize) -> Option<&'p Likeness>,
) -> Option<Shown> {
    let own = &cells[k];
    let goes_on = (0..cells.len()).any(|m| {
        let side = match (
            cells[m].column as isize - own.column as isize,
            cells[m].row as isize - own.row as isize,
        ) {
            (-1, 0) => 2,
            (1, 0) => 0,
            (0, -1) => 3,
            (0, 1) => 1,
            _ => return false,
        };
        let hidden = shown[m].filter(|s| s.is_replaced);
        hidden.is_some_and(|s| pair(m, s.as_cell).is_some_and(|p| borders(p)[side] >= 2))
    });
    if is_whole && !goes_on {
        return None;
    }
    let of = |along: &dyn Fn(&Cell) -> bool| {
        let clean = (0..cells.len()).filter(|m| along(&cells[*m]));
        let cores = clean.filter_map(|m| shown[m].filter(|s| !s.is_replaced).map(|s| s.as_cell));
        let cores: Vec<usize> = cores
            .filter(|core| are_equal(own, &cells[*core]) && may_show(k, *core, cells, shown))
            .collect();
        let most = cores.iter().copied().max_by_key(|core| {
            (
                cores.iter().filter(|c| *c == core).count(),
                std::cmp::Reverse(*core),
            )
        })?;
        (2 * cores.iter().filter(|c| **c == most).count() > cores.len()).then_some(most)
    };
    let core = of(&|c| c.column == own.column).or_else(|| of(&|c| c.row == own.row))?;
    let likeness = pair(k, core);
    let is_before = |p: &Likeness| match before.is_known() {
        true => before.untold(own, p) <= UNTOLD,
        false => p.share >= COVERED && !is_even(p),
    };
    let agrees = likeness.is_some_and(is_before);
    (!is_whole || agrees).then(|| standing(likeness, core, true))
}
