//! `branch-cut`: the six-vertex algorithm by hand, every word of bends up to fourteen corners, and what must
//! hold for any outline.

use super::outlines::{moved, outlines};
use super::shapes::{NINOMARU, cell, plan, total_cut};
use hsd::geometry::plan::{Cell, Plan};
use hsd::roof::partition::six_vertex::SixVertex;
use hsd::roof::partition::{Method, cut, partition};
use hsd::roof::plan::roles::regions;
use hsd::roof::region::{Role, Side};

type Point = (i64, i64);

/// An L walked round: along a so far, along b so far, with these thicknesses.
fn l_shape(along_a: i64, along_b: i64, thick_a: i64, thick_b: i64) -> [Point; 6] {
    [
        (0, 0),
        (along_a, 0),
        (along_a, thick_a),
        (thick_b, thick_a),
        (thick_b, along_b),
        (0, along_b),
    ]
}

#[test]
fn six_corners_by_hand() {
    // A hall of 14 by 6 with a wing of 5 by 7 behind its right end.
    let six = SixVertex::divide(&l_shape(14, 13, 6, 5)).unwrap();
    assert_eq!(
        (six.box1, six.box2),
        (cell([0, 0, 14, 6]), cell([0, 6, 5, 13]))
    );
    assert_eq!((six.l_box1, six.w_box1), (14, 6));
    assert_eq!((six.l_box2, six.w_box2), (13, 5));
    // Roof2 is 13 - 6/2 long and ends beside (0, 3), on the outer wall, under Roof1's ridge.
    assert_eq!(six.roof2_doubled(), 20);
    assert_eq!(six.prf2_doubled(), (0, 6));
    // The printed numbers, with the corners that 7.4 puts in: P3 + (P4 - P3) * 0.5 W_box1 / L_box2.
    let (p3, p4) = ((0.0, 0.0), (0.0, 13.0));
    let factor = 0.5 * 6.0 / 13.0;
    assert!((p3.1 + (p4.1 - p3.1) * factor - 3.0_f64).abs() < 1e-12);
    // The same from the far end, the first case of 002-21: P1 + (P2 - P1) (L_box2 - W_box1 / 2) / L_box2.
    assert!((p4.1 + (p3.1 - p4.1) * (13.0 - 3.0) / 13.0 - 3.0_f64).abs() < 1e-12);
}

#[test]
fn where_box2_would_be_wider_the_boxes_change_their_parts() {
    // By the letter a thin strip along the longest edge, and a second roof that stands higher.
    let corners = l_shape(20, 9, 3, 8);
    let printed = SixVertex::by_longest_edge(&corners).unwrap();
    assert_eq!(
        (printed.box1, printed.box2),
        (cell([0, 0, 20, 3]), cell([0, 3, 8, 9]))
    );
    assert!(printed.w_box2 > printed.w_box1);
    let six = SixVertex::divide(&corners).unwrap();
    assert_eq!(
        (six.box1, six.box2),
        (cell([0, 0, 8, 9]), cell([8, 0, 20, 3]))
    );
    assert_eq!((six.roof2_doubled(), six.prf2_doubled()), (32, (8, 0)));
    assert_eq!(six.exchanged(), printed);
}

#[test]
fn six_corners_may_be_written_any_way() {
    for (along_a, along_b, thick_a, thick_b) in [(14, 13, 6, 5), (20, 9, 3, 8), (9, 9, 4, 4)] {
        let corners = l_shape(along_a, along_b, thick_a, thick_b);
        let want = SixVertex::divide(&corners);
        for turns in 0..6 {
            let mut other = corners;
            other.rotate_left(turns);
            assert_eq!(SixVertex::divide(&other), want);
            other.reverse();
            assert_eq!(SixVertex::divide(&other), want);
        }
    }
    // No L: a rectangle with corners in mid-wall, a slant, one corner six times.
    let straight = [(0, 0), (2, 0), (5, 0), (5, 4), (2, 4), (0, 4)];
    let slant = [(0, 0), (9, 1), (9, 4), (4, 4), (4, 8), (0, 8)];
    for corners in [straight, slant, [(3, 3); 6]] {
        assert_eq!(SixVertex::divide(&corners), None);
    }
    let (lo, hi) = (i64::MIN, i64::MAX);
    let vast = [(lo, lo), (hi, lo), (hi, 0), (0, 0), (0, hi), (lo, hi)];
    let vast = SixVertex::divide(&vast).unwrap();
    assert_eq!(vast.l_box1, i128::from(hi) - i128::from(lo));
    assert!(!vast.box1.overlaps(&vast.box2));
}

/// Domain 7.4 has some 62 % of all L up to 20 by 20 in which the letter makes Box2 shorter than wide, and as
/// many in which it makes it wider than Box1.
#[test]
fn how_often_the_letter_of_the_paper_goes_wrong() {
    let (mut all, mut short, mut wide) = (0.0, 0.0, 0.0);
    for along_a in 2..=20 {
        for along_b in 2..=20 {
            for thick_a in 1..along_b {
                for thick_b in 1..along_a {
                    let corners = l_shape(along_a, along_b, thick_a, thick_b);
                    let six = SixVertex::by_longest_edge(&corners).unwrap();
                    all += 1.0;
                    short += f64::from(u8::from(six.l_box2 - six.w_box1 < six.w_box2));
                    wide += f64::from(u8::from(six.w_box2 > six.w_box1));
                    let fixed = SixVertex::divide(&corners).unwrap();
                    assert!(fixed.w_box2 <= fixed.w_box1);
                    assert!(fixed.w_box2 == six.w_box2.min(six.w_box1));
                }
            }
        }
    }
    let percent = |part: f64| (100.0 * part / all).round();
    assert_eq!((percent(short), percent(wide)), (63.0, 60.0));
}

#[test]
fn the_boxes_become_main_roof_and_branch() {
    for (along_a, along_b, thick_a, thick_b) in [(14, 13, 6, 5), (9, 16, 6, 5), (12, 12, 5, 5)] {
        let corners = l_shape(along_a, along_b, thick_a, thick_b);
        let six = SixVertex::divide(&corners).unwrap();
        let outline = Plan::from_loops(vec![corners.to_vec()]);
        let found = regions(&outline, None, Method::BranchCut, None, 1);
        let main = found.iter().position(|r| r.cell == six.box1).unwrap();
        let branch = found.iter().find(|r| r.cell == six.box2).unwrap();
        assert_eq!(found[main].role, Role::Main);
        assert_eq!((branch.role, branch.over), (Role::Branch, Some(main)));
        // Roof2 reaches Roof1's ridge: half of Box1 further than the wall between them.
        let side = branch.joins.unwrap();
        let box2 = side.opposite().measure(&branch.cell).1;
        let half = side.measure(&found[main].cell).1;
        assert_eq!(i128::from(2 * box2 + half), six.roof2_doubled());
    }
}

/// All words of so many bends, true = R, one of each kind (002-08 to 002-10).
fn words(corners: u32) -> Vec<Vec<bool>> {
    let of = |bits: u32| -> Vec<bool> { (0..corners).map(|k| bits >> k & 1 == 1).collect() };
    let least = |word: &Vec<bool>| {
        (0..word.len()).all(|turns| {
            let mut other = word.clone();
            other.rotate_left(turns);
            *word <= other
        })
    };
    let bends_right = |bits: &u32| 2 * bits.count_ones() == corners + 4;
    (0..1 << corners)
        .filter(bends_right)
        .map(of)
        .filter(least)
        .collect()
}

/// A simple outline with these bends, clockwise: a square into whose walls steps are put one by one, each so
/// small that nothing else is met.
fn outline_of(word: &[bool]) -> Vec<Point> {
    if word.len() == 4 {
        return vec![(0, 0), (0, 1), (1, 1), (1, 0)];
    }
    let n = word.len();
    let step = (0..n).find(|&k| word[k] != word[(k + 1) % n]).unwrap();
    let mut rest = word.to_vec();
    rest.rotate_left((step + 2) % n);
    let right = rest[n - 2];
    rest.truncate(n - 2);
    let mut corners: Vec<Point> = outline_of(&rest)
        .iter()
        .map(|p| (4 * p.0, 4 * p.1))
        .collect();
    let (from, to) = (corners[n - 3], corners[0]);
    let middle = ((from.0 + to.0) / 2, (from.1 + to.1) / 2);
    let ahead = ((to.0 - from.0).signum(), (to.1 - from.1).signum());
    let aside = if right {
        (ahead.1, -ahead.0)
    } else {
        (-ahead.1, ahead.0)
    };
    let shifted = |p: Point| (p.0 + aside.0, p.1 + aside.1);
    corners[0] = shifted(to);
    corners.extend([middle, shifted(middle)]);
    // Back to the start that the word has.
    corners.rotate_right((step + 2) % n);
    corners
}

fn bends(corners: &[Point]) -> Vec<bool> {
    let n = corners.len();
    let turn = |k: usize| {
        let (p, q, r) = (corners[(k + n - 1) % n], corners[k], corners[(k + 1) % n]);
        (q.0 - p.0) * (r.1 - q.1) - (q.1 - p.1) * (r.0 - q.0)
    };
    (0..n).map(|k| turn(k) < 0).collect()
}

/// Whether the cells cover the plan and nothing twice.
fn tiles(cells: &[Cell], plan: &Plan) -> bool {
    let apart = cells
        .iter()
        .enumerate()
        .all(|(n, c)| cells[..n].iter().all(|d| !c.overlaps(d)));
    let covered = Plan::from_cells(cells);
    apart && covered.difference(plan).is_empty() && plan.difference(&covered).is_empty()
}

#[test]
fn every_word_of_bends_is_divided() {
    let mut counts = vec![];
    for corners in (4..=14).step_by(2) {
        let words = words(corners);
        counts.push(words.len());
        for word in words {
            let outline = outline_of(&word);
            assert_eq!(bends(&outline), word);
            for mirrored in [false, true] {
                let flip = |p: &Point| (if mirrored { -p.0 } else { p.0 }, p.1);
                let plan = Plan::from_loops(vec![outline.iter().map(flip).collect()]);
                let cells = cut(&plan, Method::BranchCut);
                assert!(tiles(&cells, &plan), "{word:?}");
                let inner = word.iter().filter(|right| !**right).count();
                assert!(cells.len() <= inner + 1, "{word:?}");
            }
        }
    }
    assert_eq!(counts, [1, 1, 4, 12, 43, 143]);
}

#[test]
fn any_region_is_tiled_with_a_cut_for_every_inner_corner_at_most() {
    for (n, map) in outlines(31, 1500, 15).iter().enumerate() {
        let plan = moved(&map.plan(), 3, -7, 5);
        let cells = cut(&plan, Method::BranchCut);
        assert!(tiles(&cells, &plan), "outline {n}");
        // R - L = 4 round the outline and -4 round each hole, and a hole takes a cut to be opened.
        let corners = plan.corners();
        let holes = plan.loops.len() - 1;
        let inner = (corners + 4 * holes - 4) / 2;
        assert!(cells.len() + holes <= inner + 1, "outline {n}");
    }
}

#[test]
fn courts_are_opened_and_pieces_divided_apart() {
    let court = Plan::from_loops(vec![
        vec![(0, 0), (20, 0), (20, 14), (0, 14)],
        vec![(6, 5), (6, 10), (14, 10), (14, 5)],
    ]);
    // As short as the best tree, 18, where the published method cuts 22.
    let cells = partition(&court, Method::BranchCut);
    assert_eq!((cells.len(), total_cut(&cells, &court)), (4, 18));
    // A court in an island in a court: pieces within pieces.
    let ring = |k: i64| vec![(k, k), (40 - k, k), (40 - k, 40 - k), (k, 40 - k)];
    let nested = Plan::from_loops([0, 6, 9, 14].map(ring).to_vec());
    let cells = cut(&nested, Method::BranchCut);
    assert!(tiles(&cells, &nested));
    assert_eq!(cells.len(), 8);
}

#[test]
fn where_other_walls_stand_in_the_way_of_a_branch_the_least_cut_divides() {
    // Two interlocking combs round a winding corridor: no line cuts off a rectangle at one end.
    let winding = plan(&[
        [0, 0, 30, 4],
        [26, 4, 30, 20],
        [4, 16, 26, 20],
        [4, 8, 8, 16],
        [8, 8, 20, 12],
    ]);
    let cells = partition(&winding, Method::BranchCut);
    assert!(tiles(&cells, &winding));
    assert_eq!((cells.len(), total_cut(&cells, &winding)), (5, 16));
}

#[test]
fn ninomaru_keeps_its_eight_halls() {
    let palace = plan(&NINOMARU);
    let found = regions(&palace, None, Method::BranchCut, None, 1);
    let cells: Vec<Cell> = found.iter().map(|r| r.cell).collect();
    assert_eq!(cells, NINOMARU.map(cell));
    assert_eq!(total_cut(&cells, &palace), 54);
    let entrance = found.iter().find(|r| r.cell == cell(NINOMARU[0])).unwrap();
    assert_eq!(
        (entrance.role, entrance.joins),
        (Role::Branch, Some(Side::Back))
    );
}
