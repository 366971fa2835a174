//! What must hold for every region: exact cover, independence of how the outline is written,
//! and the branch rule looked at pair by pair.

use super::outlines::{Bitmap, Dice, moved, outlines};
use hsd::geometry::plan::{Cell, Plan};
use hsd::roof::partition::{Method, partition};
use hsd::roof::plan::roles::regions;
use hsd::roof::plan::street::street_front;
use hsd::roof::region::{Region, Ridge, Role};

const ALL: [Method; 3] = [Method::Kd, Method::LeastCut, Method::BranchCut];

fn cells(regions: &[Region]) -> Vec<Cell> {
    regions.iter().map(|r| r.cell).collect()
}

/// The first wall line of a plan: the front edge of its first loop.
fn first_line(plan: &Plan) -> ((i64, i64), (i64, i64)) {
    (plan.loops[0][0], plan.loops[0][1])
}

fn sane(found: &[Region]) {
    assert!(found.is_sorted_by_key(|r| (r.cell.b0, r.cell.a0)));
    for r in found {
        assert_eq!(r.ridge.is_none(), r.role == Role::LeanTo);
        assert_eq!(r.fall.is_some(), r.role == Role::LeanTo);
        assert!(r.role != Role::Branch || r.over.is_some());
        if let (Some(t), false) = (r.over, r.street) {
            assert!(found[t].street || found[t].cell.area() > r.cell.area());
        }
    }
}

#[test]
fn regions_cover_the_plan_once() {
    let mut streets = 0;
    for map in outlines(21, 300, 15) {
        let plan = map.plan();
        for method in ALL {
            let found = regions(&plan, None, method, None, 1);
            assert!(map.is_covered_by(&cells(&found)));
            sane(&found);
            let front = street_front(&plan, first_line(&plan));
            let found = regions(&plan, None, method, front, 1);
            assert!(map.is_covered_by(&cells(&found)));
            sane(&found);
            let street = found.iter().find(|r| r.street);
            assert_eq!(street.map(|r| r.cell), front);
            assert!(street.is_none_or(|r| r.ridge == Some(Ridge::A) && r.role == Role::Main));
            streets += usize::from(front.is_some_and(|f| f.area() < plan.area()));
        }
    }
    assert!(streets > 100);
}

#[test]
fn regions_cover_what_the_upper_storey_leaves_open() {
    let mut dice = Dice::new(22);
    for map in outlines(23, 300, 15) {
        let upper = Bitmap::random(&mut dice, map.w, map.h, 3);
        for method in ALL {
            let found = regions(&map.plan(), Some(&upper.plan()), method, None, 1);
            assert!(map.minus(&upper).is_covered_by(&cells(&found)));
            sane(&found);
            let open = map.plan().difference(&upper.plan());
            assert_eq!(regions(&open, Some(&upper.plan()), method, None, 1), found);
        }
    }
}

#[test]
fn street_front_is_the_deepest_rectangle_on_the_first_line() {
    for map in outlines(24, 300, 15) {
        let plan = map.plan();
        let (p, q) = first_line(&plan);
        let full = |y: i64| (p.0..q.0).all(|x| map.at(x, y));
        let to = (p.1..).find(|&y| !full(y)).unwrap();
        let want = Cell {
            a0: p.0,
            b0: p.1,
            a1: q.0,
            b1: to,
        };
        assert_eq!(street_front(&plan, (p, q)), Some(want));
    }
}

/// Starts each loop elsewhere, walks some the other way, and puts corners into mid-wall.
fn rewritten(plan: &Plan, dice: &mut Dice) -> Plan {
    let mut loops = plan.loops.clone();
    for l in &mut loops {
        let mut split = Vec::new();
        for n in 0..l.len() {
            let (p, q) = (l[n], l[(n + 1) % l.len()]);
            split.push(p);
            if dice.roll(0, 2) == 0 {
                split.push(((p.0 + q.0) / 2, (p.1 + q.1) / 2));
            }
        }
        let by = dice.roll(0, split.len() as i64) as usize;
        split.rotate_left(by);
        if dice.roll(0, 2) == 0 {
            split.reverse();
        }
        *l = split;
    }
    loops.reverse();
    Plan::from_loops(loops)
}

#[test]
fn how_the_outline_is_written_does_not_matter() {
    let mut dice = Dice::new(25);
    for map in outlines(26, 300, 15) {
        let plan = moved(&map.plan(), 4, -8, 4);
        for method in ALL {
            let found = regions(&plan, None, method, None, 4);
            for _ in 0..3 {
                assert_eq!(
                    regions(&rewritten(&plan, &mut dice), None, method, None, 4),
                    found
                );
            }
        }
    }
}

#[test]
fn set_operations_are_exact() {
    let mut dice = Dice::new(27);
    for _ in 0..300 {
        let (w, h) = (dice.roll(1, 12), dice.roll(1, 12));
        let (p, q) = (
            Bitmap::random(&mut dice, w, h, 6),
            Bitmap::random(&mut dice, w, h, 6),
        );
        let (rest, both) = (p.plan().difference(&q.plan()), p.plan().union(&q.plan()));
        let pieces = rest.components();
        assert_eq!(pieces.iter().map(Plan::area).sum::<i128>(), rest.area());
        let mut common = false;
        for (x, y) in p.all() {
            assert_eq!(contains(&rest, x, y), p.at(x, y) && !q.at(x, y));
            assert_eq!(contains(&both, x, y), p.at(x, y) || q.at(x, y));
            assert_eq!(
                pieces.iter().filter(|k| contains(k, x, y)).count(),
                usize::from(contains(&rest, x, y))
            );
            common |= p.at(x, y) && q.at(x, y);
        }
        assert_eq!(p.plan().intersects(&q.plan()), common);
        assert_eq!(
            rest.is_empty(),
            p.minus(&q).all().all(|(x, y)| !p.minus(&q).at(x, y))
        );
    }
}

/// Even-odd test of the middle of a unit field.
fn contains(plan: &Plan, x: i64, y: i64) -> bool {
    let beyond = |(p, q): &((i64, i64), (i64, i64))| {
        p.0 == q.0 && p.0 > x && p.1.min(q.1) <= y && y < p.1.max(q.1)
    };
    plan.edges().filter(beyond).count() % 2 == 1
}

/// Rule 3.7 pair by pair.
#[test]
fn the_branch_rule_holds_for_every_region() {
    for map in outlines(28, 400, 17) {
        for method in ALL {
            let found = regions(&map.plan(), None, method, None, 1);
            for (n, r) in found.iter().enumerate() {
                let mut trunks: Vec<(bool, i128, usize, bool)> = Vec::new();
                for (m, t) in found
                    .iter()
                    .enumerate()
                    .filter(|(_, t)| t.cell.area() > r.cell.area())
                {
                    if let Some(along_a) = lies_on(&r.cell, &t.cell) {
                        let strip = is_strip(&r.cell, along_a);
                        trunks.push((!strip, -t.cell.area(), m, along_a));
                    }
                }
                judge(r, trunks.into_iter().min(), &found, n);
            }
        }
    }
}

/// Whether a whole edge of r lies on a side of t, and if so whether that edge runs along a.
fn lies_on(r: &Cell, t: &Cell) -> Option<bool> {
    let in_a = t.a0 <= r.a0 && r.a1 <= t.a1;
    let in_b = t.b0 <= r.b0 && r.b1 <= t.b1;
    if in_a && (r.b0 == t.b1 || r.b1 == t.b0) {
        return Some(true);
    }
    (in_b && (r.a0 == t.a1 || r.a1 == t.a0)).then_some(false)
}

/// Whether a region may lean by an edge along a or b.
fn is_strip(r: &Cell, along_a: bool) -> bool {
    let (w, d) = (r.width(), r.depth());
    let (edge, depth) = if along_a { (w, d) } else { (d, w) };
    depth <= 2 && edge >= 2 * depth || depth <= 3 && 2 * edge > 5 * depth
}

/// Whether some other region lies along the far side of a region that leans on another.
fn falls_on_roof(r: &Cell, t: &Cell, along_a: bool, found: &[Region]) -> bool {
    let over = |lo: i64, hi: i64, from: i64, to: i64| hi.min(to) > lo.max(from);
    found.iter().map(|f| &f.cell).filter(|c| *c != r).any(|c| {
        if along_a {
            let far = if r.b0 == t.b1 {
                c.b0 == r.b1
            } else {
                c.b1 == r.b0
            };
            far && over(r.a0, r.a1, c.a0, c.a1)
        } else {
            let far = if r.a0 == t.a1 {
                c.a0 == r.a1
            } else {
                c.a1 == r.a0
            };
            far && over(r.b0, r.b1, c.b0, c.b1)
        }
    })
}

fn judge(r: &Region, trunk: Option<(bool, i128, usize, bool)>, found: &[Region], n: usize) {
    let (w, d) = (r.cell.width(), r.cell.depth());
    let Some((_, _, t, along_a)) = trunk else {
        let long = if d > w { Ridge::B } else { Ridge::A };
        assert_eq!((r.role, r.ridge), (Role::Main, Some(long)), "{n} {found:?}");
        return;
    };
    let edge = if along_a { w } else { d };
    let against = falls_on_roof(&r.cell, &found[t].cell, along_a, found);
    if is_strip(&r.cell, along_a) && !against {
        assert_eq!((r.role, r.over), (Role::LeanTo, Some(t)));
        return;
    }
    assert_eq!(r.ridge, Some(if along_a { Ridge::B } else { Ridge::A }));
    if found[t].role != Role::LeanTo && edge > found[t].span() {
        assert_eq!((r.role, r.through), (Role::Main, Some(t)));
    } else {
        assert_eq!((r.role, r.over), (Role::Branch, Some(t)));
    }
}

#[test]
fn vast_and_hostile_plans_are_survived() {
    let (lo, hi) = (i64::MIN, i64::MAX);
    let vast = Plan::from_loops(vec![vec![
        (lo, lo),
        (hi, lo),
        (hi, 0),
        (0, 0),
        (0, hi),
        (lo, hi),
    ]]);
    let slant = Plan::from_loops(vec![
        vec![(0, 0), (9, 3), (5, 8), (1, 7)],
        vec![(4, 4)],
        vec![],
    ]);
    // A stair of many steps: too many lines for a raster.
    let mut stair = vec![(0, 0)];
    for n in 0..3000 {
        stair.extend([(3000 - n, n), (3000 - n, n + 1)]);
    }
    stair.push((0, 3000));
    let stair = Plan::from_loops(vec![stair]);
    for method in ALL {
        assert_eq!(partition(&vast, method).len(), 2);
        regions(&vast, Some(&slant), method, None, 4);
        regions(&slant, Some(&vast), method, None, i64::MAX);
        partition(&slant, method);
        let found = regions(&stair, None, method, None, 4);
        assert_eq!(
            found.iter().map(|r| r.cell.area()).sum::<i128>(),
            stair.area()
        );
    }
}

#[test]
fn chord_stands_in_for_the_search_on_long_outlines() {
    for method in ALL {
        let teeth: Vec<Cell> = (0..40)
            .map(|n| Cell {
                a0: 3 * n,
                b0: 5,
                a1: 3 * n + 2,
                b1: 7 + n,
            })
            .collect();
        let comb = Plan::from_cells(&teeth).union(&Plan::from_cells(&[Cell {
            a0: 0,
            b0: 0,
            a1: 119,
            b1: 5,
        }]));
        assert_eq!(
            partition(&comb, method)
                .iter()
                .map(Cell::area)
                .sum::<i128>(),
            comb.area()
        );
        assert_eq!(partition(&comb, method).len(), 41);
    }
}
