//! Plans made in the manner of the worst of real ones: what a roofer would not build may not come back.

use crate::roof_shapes::common::*;
use crate::roof_shapes::plans::assert_covered;
use crate::roof_shapes::random::{Draws, rings};
use crate::support::assert_none;
use crate::support::cpu::spent;
use crate::support::crossings::deepest;
use hsd::building::{Building, PlanRegion, Ring};
use hsd::diagnostic::Diagnostics;
use hsd::geometry::plan::{Cell, Plan};

/// Roofs stand in each other by no more, metres: what fills their gables is let in by 0.01.
const THROUGH: f64 = 0.012;

fn corners(of: &[[f64; 2]]) -> Vec<(f64, f64)> {
    of.iter().map(|p| (p[0], p[1])).collect()
}

/// A house over the union of some rectangles a0 b0 a1 b1, in half units.
fn joined(cells: &[[i64; 4]]) -> Vec<Ring> {
    let cells = cells.iter().map(|c| Cell {
        a0: c[0],
        b0: c[1],
        a1: c[2],
        b1: c[3],
    });
    let plan = Plan::from_cells(&cells.collect::<Vec<_>>()).clean();
    let area = |l: &[(i64, i64)]| -> i64 {
        let next = l.iter().cycle().skip(1);
        l.iter().zip(next).map(|(p, q)| p.0 * q.1 - q.0 * p.1).sum()
    };
    let walk = |l: &Vec<(i64, i64)>| Ring {
        hole: area(l) < 0,
        ..ring(
            &l.iter()
                .map(|p| (p.0 as f64 / 2.0, p.1 as f64 / 2.0))
                .collect::<Vec<_>>(),
        )
    };
    plan.loops.iter().map(walk).collect()
}

/// Builds a plan; whatever it is, its roofs are sound and stand in no other.
fn built(rings: Vec<Ring>) -> (Building, Diagnostics) {
    let (building, out) = build(house(vec![rings]));
    assert_sound(&building);
    let deep = deepest(roofs(&building));
    assert!(deep.depth < THROUGH, "{deep:?}");
    (building, out)
}

fn regions(building: &Building) -> &[PlanRegion] {
    &building.houses[0].roofs.plans[0].regions
}

/// The region over a rectangle.
fn over(building: &Building, rect: [f64; 4]) -> &PlanRegion {
    let all = regions(building);
    let found = all.iter().find(|r| r.rect == rect);
    found.unwrap_or_else(|| panic!("{rect:?} is none of {all:#?}"))
}

#[test]
fn bays_on_the_flank_of_a_hall_are_lean_tos() {
    let (building, _) = built(joined(&[[0, 0, 28, 16], [2, 16, 8, 19], [18, 16, 26, 19]]));
    for bay in [[1.0, 8.0, 4.0, 9.5], [9.0, 8.0, 13.0, 9.5]] {
        assert_eq!(over(&building, bay).fall, Some("B"));
    }
}

#[test]
fn a_branch_wider_than_deep_is_a_lean_to() {
    let (building, _) = built(joined(&[[0, 0, 28, 16], [4, 16, 24, 22]]));
    assert_eq!(over(&building, [2.0, 8.0, 12.0, 11.0]).fall, Some("B"));
}

#[test]
fn a_link_between_two_halls_falls_on_neither() {
    let (building, _) = built(joined(&[[0, 0, 16, 20], [16, 6, 19, 14], [19, 0, 37, 18]]));
    let link = over(&building, [8.0, 3.0, 9.5, 7.0]);
    assert_eq!((link.fall, link.ridge), (None, Some("a")));
}

#[test]
fn teeth_of_a_metre_become_no_gables() {
    // A front that steps back by a unit at each of four houses.
    let steps = [
        [0, 0, 10, 24],
        [10, 2, 20, 24],
        [20, 4, 30, 24],
        [30, 6, 40, 24],
    ];
    let (building, _) = built(joined(&steps));
    let narrow = |r: &&PlanRegion| (r.rect[2] - r.rect[0]).min(r.rect[3] - r.rect[1]) < 1.1;
    let narrow: Vec<_> = regions(&building).iter().filter(narrow).collect();
    assert!(narrow.iter().all(|r| r.fall.is_some()), "{narrow:#?}");
}

#[test]
fn a_skew_corridor_leaves_gables_on_the_palace() {
    let palace = corners(&[
        [0.0, 0.0],
        [20.0, 0.0],
        [20.0, 4.0],
        [28.0, 10.0],
        [26.8, 11.6],
        [20.0, 6.5],
        [20.0, 14.0],
        [12.0, 14.0],
        [12.0, 22.0],
        [0.0, 22.0],
    ]);
    let (building, out) = built(vec![ring(&palace)]);
    assert_eq!(codes(&out), [522]);
    let shapes: Vec<_> = roofs(&building).iter().map(|r| r.shape.letters()).collect();
    assert_eq!(shapes, ["KIR", "KIR", "YOS"]);
    for at in [
        (1.0, 1.0),
        (19.0, 13.0),
        (6.0, 21.0),
        (22.0, 6.5),
        (26.0, 9.5),
    ] {
        assert!(
            top_at(&building, at.0, at.1).is_some_and(|z| z > H),
            "a hole at {at:?}"
        );
    }
    // The ridge of the corridor goes on into the hall's slope: no pocket at the neck.
    for at in [(19.5, 5.2), (20.5, 5.6)] {
        let top = top_at(&building, at.0, at.1).expect("is covered");
        assert!(top > H + 0.3, "{top} at {at:?}");
    }
}

#[test]
fn halls_too_wide_at_odd_angles_end_in_decks() {
    let hall = corners(&[[0.0, 0.0], [140.0, 12.0], [128.0, 100.0], [-8.0, 84.0]]);
    let (building, out) = built(vec![ring(&hall)]);
    assert_eq!(codes(&out), [520, 523]);
    let top = all_solids(&building).flat_map(|s| s.points.iter().map(|p| p.z));
    assert!(top.fold(0.0, f64::max) < H + 9.5);
    for at in [(60.0, 48.0), (10.0, 40.0), (2.0, 3.0), (130.0, 90.0)] {
        assert!(top_at(&building, at.0, at.1).is_some(), "a hole at {at:?}");
    }
}

/// A main hall of eight courts with bays all round, 43 corners and more.
fn hall_of_courts() -> Vec<Ring> {
    let mut outline = vec![(0.0, 0.0)];
    for k in 0..8 {
        let a = 4.0 + 9.0 * f64::from(k);
        outline.extend([(a, 0.0), (a, -1.5), (a + 3.25, -1.5), (a + 3.25, 0.0)]);
    }
    outline.extend([
        (78.0, 0.0),
        (78.0, 41.0),
        (70.5, 41.0),
        (70.5, 44.0),
        (20.0, 44.0),
    ]);
    outline.extend([(20.0, 42.25), (0.0, 42.25)]);
    let court = |k: usize| {
        let (a, b) = ((k % 4) as f64, (k / 4) as f64);
        let (a, b) = (7.0 + 18.0 * a + b, 6.0 + 18.0 * b + a * 0.5);
        hole(&rect(a, b, a + 7.5 + b * 0.25, b + 8.0))
    };
    std::iter::once(ring(&outline))
        .chain((0..8).map(court))
        .collect()
}

#[test]
fn a_hall_of_many_courts_is_roofed_in_little_time() {
    let ((building, _), took) = spent(|| build(house(vec![hall_of_courts()])));
    assert_sound(&building);
    assert_covered("hall", &building, 0, &[]);
    let deep = deepest(roofs(&building));
    assert!(deep.depth < THROUGH, "{deep:?}");
    // Such a hall took 4.4 s, while a plain house takes a millisecond at most.
    let (_, plain) = spent(|| build(house(vec![joined(&[[0, 0, 28, 16], [0, 16, 12, 30]])])));
    assert!(took < plain * 2000, "{took:?}, a plain house {plain:?}");
}

/// Verges and eaves of a branch do not go through the gable of its trunk, nor eaves through a lean-to that is tucked
/// under those of another roof.
#[test]
fn roofs_of_random_plans_do_not_stand_in_each_other() {
    let mut draws = Draws(29);
    let mut found = vec![];
    for n in 0..999 {
        let outer = rings(&mut draws, 24);
        let (building, _) = build(house(vec![outer.clone()]));
        let deep = deepest(roofs(&building));
        if deep.depth > THROUGH {
            let corners: Vec<_> = outer[0].corners().iter().map(|p| (p.x, p.y)).collect();
            found.push(format!("plan {n}: {deep:?}, {corners:?}"));
        }
    }
    assert_none(&found);
}
