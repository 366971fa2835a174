//! What runs of wall stand for: units of a line between posts are of one kind, drawn in one way.

use super::super::legend::Role;
use super::patch::Patch;
use super::stamp::{Stamp, emptiness};
use super::{Read, Sum};

/// What agrees less with every symbol is none: writing, hatching, things that stand in a room.
const CLUTTER: f64 = 0.5;
/// What the beginning of another run costs where no post stands, in shares of a unit.
const CHANGE: f64 = 0.12;
/// The same at a post.
const AT_POST: f64 = 0.02;
/// What an end of a wall without a post costs.
const NO_POST: f64 = 0.1;
/// The longest run of one kind that is tried, units.
const LONGEST: usize = 8;

/// A way to read a run: its role, the sum of likeness, and the place of its stamp.
#[derive(Clone, Copy)]
struct Choice {
    from: usize,
    role: Role,
    value: f64,
    lead: f64,
}

/// The roles of a line of units that agree best with its ink and its posts (dynamic programming over its runs).
pub(super) fn best(
    patches: &[Patch],
    posts: &[f64],
    stamps: &[Stamp],
    pen: f64,
    sum: &mut Sum,
) -> Vec<Read> {
    let n = patches.len();
    let empty: Vec<f64> = patches
        .iter()
        .map(|p| emptiness(p, pen).max(CLUTTER))
        .collect();
    // Most of a sheet is empty, and no symbol stands there.
    let likeness: Vec<Vec<f64>> = patches
        .iter()
        .map(|p| {
            if p.is_inked {
                likenesses(p, stamps, pen)
            } else {
                Vec::new()
            }
        })
        .collect();
    let mut table: Vec<Option<(f64, Choice)>> = vec![None; n + 1];
    for end in 1..=n {
        for from in end.saturating_sub(LONGEST)..end {
            let before = if from == 0 {
                0.0
            } else {
                table[from].map_or(f64::MIN, |t| t.0)
            };
            let ends = [posts[from], posts[end]];
            for choice in choices(from, end, &likeness, &empty, stamps, ends) {
                let total = before + choice.value * (end - from) as f64 - CHANGE
                    + (CHANGE - AT_POST) * posts[from];
                if table[end].is_none_or(|t| total > t.0) {
                    table[end] = Some((total, choice));
                }
            }
        }
    }
    let taken = |from: usize, end: usize, value: f64| {
        sum.add(&empty[from..end], &patches[from..end], value)
    };
    reads(&table, taken)
}

/// What the best choices up to the end of a line read; `taken` is called with each of them, from the end.
fn reads(table: &[Option<(f64, Choice)>], mut taken: impl FnMut(usize, usize, f64)) -> Vec<Read> {
    let mut end = table.len() - 1;
    let mut out = vec![Read::EMPTY; end];
    while let Some((_, choice)) = table[end] {
        let Choice {
            from,
            role,
            value,
            lead,
        } = choice;
        out[from..end].fill(Read {
            role,
            likeness: value.clamp(0.0, 1.0),
            lead,
        });
        taken(from, end, value);
        end = from;
        if end == 0 {
            break;
        }
    }
    out
}

/// How well each unit of each stamp agrees with a patch, stamp after stamp.
fn likenesses(patch: &Patch, stamps: &[Stamp], pen: f64) -> Vec<f64> {
    stamps
        .iter()
        .flat_map(|s| (0..s.units).map(|unit| s.likeness(unit, patch, pen)))
        .collect()
}

/// The best of the ways to read a run, with what it leads by.
fn choices(
    from: usize,
    end: usize,
    likeness: &[Vec<f64>],
    empty: &[f64],
    stamps: &[Stamp],
    ends: [f64; 2],
) -> impl Iterator<Item = Choice> {
    let length = (end - from) as f64;
    let mut best: Vec<(Role, f64)> =
        vec![(Role::Empty, empty[from..end].iter().sum::<f64>() / length)];
    if likeness[from..end].iter().all(|l| !l.is_empty()) {
        let mut at = 0;
        for stamp in stamps {
            if (end - from).is_multiple_of(stamp.units) {
                let units = likeness[from..end]
                    .iter()
                    .enumerate()
                    .map(|(k, l)| l[at + k % stamp.units]);
                let mut value = units.sum::<f64>() / length;
                if stamp.role.parts() {
                    value -= NO_POST * (2.0 - ends[0] - ends[1]) / length;
                }
                match best.iter_mut().find(|b| b.0 == stamp.role) {
                    Some(b) => b.1 = b.1.max(value),
                    None => best.push((stamp.role, value)),
                }
            }
            at += stamp.units;
        }
    }
    best.sort_by(|a, b| b.1.total_cmp(&a.1));
    let lead = best[0].1 - best.get(1).map_or(0.0, |b| b.1);
    let (role, value) = best[0];
    std::iter::once(Choice {
        from,
        role,
        value,
        lead,
    })
}
