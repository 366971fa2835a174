//! `least-cut` against every guillotine tree there is.

use super::kd_check::merge;
use super::outlines::{Bitmap, Dice};
use hsd::geometry::plan::{Cell, Plan};
use hsd::roof::partition::{Method, cut, partition};
use std::collections::{BTreeMap, BTreeSet};

/// A region on uneven coordinates: fields of a bitmap stretched.
struct Uneven {
    map: Bitmap,
    a: Vec<i64>,
    b: Vec<i64>,
}

impl Uneven {
    fn random(dice: &mut Dice, most: i64) -> Self {
        let (w, h) = (dice.roll(1, most + 1), dice.roll(1, most + 1));
        let mut line = |n: i64, big: i64| {
            let mut at = dice.roll(-9, 9);
            (0..=n)
                .map(|_| {
                    at += dice.roll(1, big);
                    at
                })
                .collect::<Vec<i64>>()
        };
        let (a, b) = (line(w, 4), line(h, 3));
        let mut map = Bitmap::new(w, h);
        let share = dice.roll(2, 6);
        for (x, y) in map.all() {
            map.set((x, y, x + 1, y + 1), dice.roll(0, share) > 0);
        }
        Self { map, a, b }
    }

    fn plan(&self) -> Plan {
        let fields = self.map.all().filter(|&(x, y)| self.map.at(x, y));
        let cells: Vec<Cell> = fields
            .map(|(x, y)| self.cell((x, y, x + 1, y + 1)))
            .collect();
        Plan::from_cells(&cells).clean()
    }

    fn cell(&self, c: Fields) -> Cell {
        let at = |v: &[i64], i: i64| v[i as usize];
        Cell {
            a0: at(&self.a, c.0),
            b0: at(&self.b, c.1),
            a1: at(&self.a, c.2),
            b1: at(&self.b, c.3),
        }
    }
}

type Fields = (i64, i64, i64, i64);
type Sets = BTreeSet<Vec<(i64, i64, i64, i64)>>;

/// The lists of roofs, sorted by (b0, a0, b1, a1), of all guillotine trees of a rectangle.
fn all_trees(u: &Uneven, c: Fields, known: &mut BTreeMap<Fields, Sets>) -> Sets {
    if let Some(sets) = known.get(&c) {
        return sets.clone();
    }
    let fields = || (c.1..c.3).flat_map(|y| (c.0..c.2).map(move |x| (x, y)));
    let inside = fields().filter(|&(x, y)| u.map.at(x, y)).count();
    let mut sets = Sets::new();
    if inside == 0 {
        sets.insert(Vec::new());
    } else if inside == fields().count() {
        let k = u.cell(c);
        sets.insert(vec![(k.b0, k.a0, k.b1, k.a1)]);
    } else {
        let xs = (c.0 + 1..c.2).map(|m| ((c.0, c.1, m, c.3), (m, c.1, c.2, c.3)));
        let ys = (c.1 + 1..c.3).map(|m| ((c.0, c.1, c.2, m), (c.0, m, c.2, c.3)));
        for (one, other) in xs.chain(ys) {
            let (p, q) = (all_trees(u, one, known), all_trees(u, other, known));
            for left in &p {
                for right in &q {
                    let mut both: Vec<_> = left.iter().chain(right).copied().collect();
                    both.sort_unstable();
                    sets.insert(both);
                }
            }
        }
    }
    known.insert(c, sets.clone());
    sets
}

/// Round of all roofs: twice the roof cut, and the region's own boundary, which is constant.
fn round(list: &[Fields]) -> i64 {
    list.iter().map(|c| 2 * (c.2 - c.0 + c.3 - c.1)).sum()
}

fn squares(list: &[Fields]) -> i128 {
    list.iter()
        .map(|c| i128::from((c.2 - c.0) * (c.3 - c.1)).pow(2))
        .sum()
}

fn compare(u: &Uneven) {
    let (w, h) = (u.map.w, u.map.h);
    let sets = all_trees(u, (0, 0, w, h), &mut BTreeMap::new());
    let best = sets
        .into_iter()
        .min_by_key(|l| (round(l), l.len(), -squares(l), l.clone()))
        .unwrap();
    let best: Vec<Cell> = best
        .iter()
        .map(|c| Cell {
            a0: c.1,
            b0: c.0,
            a1: c.3,
            b1: c.2,
        })
        .collect();
    assert_eq!(
        cut(&u.plan(), Method::LeastCut),
        best,
        "{:?} {:?} {:?}",
        u.map,
        u.a,
        u.b
    );
    assert_eq!(partition(&u.plan(), Method::LeastCut), merge(best));
}

#[test]
fn least_cut_is_the_best_of_all_trees() {
    let mut dice = Dice::new(11);
    for _ in 0..600 {
        compare(&Uneven::random(&mut dice, 4));
    }
}

#[test]
fn least_cut_settles_ties_on_even_grids() {
    let mut dice = Dice::new(12);
    for _ in 0..600 {
        let mut u = Uneven::random(&mut dice, 4);
        u.a = (0..=u.map.w).collect();
        u.b = (0..=u.map.h).collect();
        compare(&u);
    }
}
