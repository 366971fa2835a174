//! `kd` again, naively and by the letter of domain 3.2, on unit fields: no compressed grid, no
//! prefix sums, every wall counted field by field.

use super::outlines::{Bitmap, moved, outlines};
use hsd::geometry::plan::Cell;
use hsd::roof::partition::{Method, cut, partition};

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Axis {
    X,
    Y,
}

/// Every line strictly inside a cell with its wall length there.
fn lines(map: &Bitmap, c: Cell) -> Vec<(Axis, i64, i64)> {
    let mut found: Vec<(Axis, i64, i64)> = Vec::new();
    for x in c.a0 + 1..c.a1 {
        let w = (c.b0..c.b1)
            .filter(|&y| map.at(x - 1, y) != map.at(x, y))
            .count();
        found.push((Axis::X, x, w as i64));
    }
    for y in c.b0 + 1..c.b1 {
        let w = (c.a0..c.a1)
            .filter(|&x| map.at(x, y - 1) != map.at(x, y))
            .count();
        found.push((Axis::Y, y, w as i64));
    }
    found
}

fn kd(map: &Bitmap, c: Cell, last: Option<Axis>, roofs: &mut Vec<Cell>) {
    let mut found = lines(map, c);
    found.retain(|k| k.2 > 0);
    if found.is_empty() {
        if map.at(c.a0, c.b0) {
            roofs.push(c);
        }
        return;
    }
    let mut pool: Vec<(Axis, i64, i64)> = found
        .iter()
        .copied()
        .filter(|k| Some(k.0) != last)
        .collect();
    if pool.is_empty() {
        pool = found;
    }
    let off = |k: &(Axis, i64, i64)| match k.0 {
        Axis::X => (2 * k.1 - c.a0 - c.a1).abs(),
        Axis::Y => (2 * k.1 - c.b0 - c.b1).abs(),
    };
    pool.sort_by(|p, q| {
        q.2.cmp(&p.2)
            .then(off(p).cmp(&off(q)))
            .then(p.1.cmp(&q.1))
            .then(p.0.cmp(&q.0))
    });
    let (axis, at, _) = pool[0];
    let (one, other) = match axis {
        Axis::X => (Cell { a1: at, ..c }, Cell { a0: at, ..c }),
        Axis::Y => (Cell { b1: at, ..c }, Cell { b0: at, ..c }),
    };
    kd(map, one, Some(axis), roofs);
    kd(map, other, Some(axis), roofs);
}

/// The merge of domain 3.2, all pairs afresh each time.
pub(crate) fn merge(mut cells: Vec<Cell>) -> Vec<Cell> {
    loop {
        let mut pairs = Vec::new();
        for p in &cells {
            for q in &cells {
                let union = Cell {
                    a0: p.a0,
                    b0: p.b0,
                    a1: q.a1,
                    b1: q.b1,
                };
                if p.a1 == q.a0 && (p.b0, p.b1) == (q.b0, q.b1) {
                    pairs.push((-(p.b1 - p.b0), -union.area(), p.b0, p.a0, 0, *p, *q, union));
                }
                if p.b1 == q.b0 && (p.a0, p.a1) == (q.a0, q.a1) {
                    pairs.push((-(p.a1 - p.a0), -union.area(), p.b0, p.a0, 1, *p, *q, union));
                }
            }
        }
        let Some(&(.., p, q, union)) = pairs.iter().min() else {
            break;
        };
        cells.retain(|c| *c != p && *c != q);
        cells.push(union);
    }
    cells.sort_by_key(|c| (c.b0, c.a0));
    cells
}

/// Bounds of the inside fields, the box that `kd` starts from.
fn bounds(map: &Bitmap) -> Option<Cell> {
    let inside: Vec<(i64, i64)> = map.all().filter(|&(x, y)| map.at(x, y)).collect();
    Some(Cell {
        a0: inside.iter().map(|p| p.0).min()?,
        b0: inside.iter().map(|p| p.1).min()?,
        a1: inside.iter().map(|p| p.0).max()? + 1,
        b1: inside.iter().map(|p| p.1).max()? + 1,
    })
}

fn compare(map: &Bitmap) {
    let mut cells = Vec::new();
    if let Some(bounds) = bounds(map) {
        kd(map, bounds, None, &mut cells);
    }
    cells.sort_by_key(|c| (c.b0, c.a0));
    assert_eq!(cut(&map.plan(), Method::Kd), cells, "{map:?}");
    let roofs = merge(cells);
    assert_eq!(partition(&map.plan(), Method::Kd), roofs, "{map:?}");
    assert_eq!(partition(&map.fields_plan(), Method::Kd), roofs, "{map:?}");
    let far = partition(
        &moved(&map.plan(), 250_000, -77_000_001, -77_000_001),
        Method::Kd,
    );
    let near: Vec<Cell> = far
        .iter()
        .map(|c| Cell {
            a0: (c.a0 + 77_000_001) / 250_000,
            b0: (c.b0 + 77_000_001) / 250_000,
            a1: (c.a1 + 77_000_001) / 250_000,
            b1: (c.b1 + 77_000_001) / 250_000,
        })
        .collect();
    assert_eq!(near, roofs);
}

#[test]
fn kd_is_the_published_method_on_sound_outlines() {
    outlines(1, 400, 17).iter().for_each(compare);
    outlines(2, 300, 9).iter().for_each(compare);
}

#[test]
fn kd_is_the_published_method_on_odd_regions() {
    let mut dice = super::outlines::Dice::new(3);
    for _ in 0..400 {
        let (w, h) = (dice.roll(1, 14), dice.roll(1, 14));
        compare(&Bitmap::random(&mut dice, w, h, 9));
    }
}
