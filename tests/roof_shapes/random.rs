//! Random orthogonal plans: whatever the regions, roofs are closed and leave no gap.

use crate::roof_shapes::common::*;
use crate::roof_shapes::plans::{assert_covered, assert_within};
use hsd::ast::{RoofKind, RoofMethod, RoofShape};
use hsd::building::Ring;
use hsd::geometry::plan::{Cell, Plan};

/// A small generator of its own: the same plans on every machine.
pub struct Draws(pub u64);

impl Draws {
    fn next(&mut self) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 ^ (self.0 >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd) >> 20
    }

    pub fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }
}

/// The union of some rectangles on a quarter-unit grid, as rings.
pub fn rings(draws: &mut Draws, size: u64) -> Vec<Ring> {
    let count = 1 + draws.below(5);
    let mut plan = Plan::default();
    for _ in 0..count {
        let (a0, b0) = (draws.below(size) as i64, draws.below(size) as i64);
        let (w, d) = (2 + draws.below(size) as i64, 2 + draws.below(size) as i64);
        plan = plan.union(&Plan::from_cells(&[Cell {
            a0,
            b0,
            a1: a0 + w,
            b1: b0 + d,
        }]));
    }
    // Pieces that meet in a corner only would be an error of the plan.
    let plan = plan.components().into_iter().next().unwrap();
    let corner = |p: &(i64, i64)| (p.0 as f64 / 2.0, p.1 as f64 / 2.0);
    let area = |l: &Vec<(i64, i64)>| -> i64 {
        (0..l.len())
            .map(|i| l[i].0 * l[(i + 1) % l.len()].1 - l[(i + 1) % l.len()].0 * l[i].1)
            .sum()
    };
    plan.loops
        .iter()
        .map(|l| Ring {
            hole: area(l) < 0,
            ..ring(&l.iter().map(corner).collect::<Vec<_>>())
        })
        .collect()
}

#[test]
fn random_plans_are_closed_and_covered() {
    let mut draws = Draws(7);
    for n in 0..300 {
        let outer = rings(&mut draws, 20);
        for method in [RoofMethod::LeastCut, RoofMethod::Kd] {
            let mut house = house(vec![outer.clone()]);
            house.roofs.method = method;
            house.street = draws.below(2) == 0;
            let style = &mut house.roofs.style;
            style.kind = Some(spanned(RoofKind::ALL[draws.below(6) as usize].1));
            match draws.below(4) {
                0 => style.eaves = Some(spanned(draws.below(40) as f64 / 10.0)),
                1 => style.verge = Some(spanned(draws.below(20) as f64 / 10.0)),
                2 => style.shape = Some(spanned(RoofShape::BroadGable)),
                _ => {}
            }
            let (building, out) = build(house);
            assert!(out.iter().all(|d| d.code.0 == 511), "{n}");
            assert_sound(&building);
            assert_covered(&format!("plan {n}"), &building, 0, &[]);
        }
    }
}

#[test]
fn random_plans_under_every_shape_are_closed_and_covered() {
    let mut draws = Draws(23);
    for n in 0..240 {
        let mut house = house(vec![rings(&mut draws, 20)]);
        house.street = draws.below(3) == 0;
        let style = &mut house.roofs.style;
        let shape = [
            RoofShape::Hip,
            RoofShape::HipAndGable,
            RoofShape::Temple,
            RoofShape::HalfHip,
            RoofShape::Karahafu,
            RoofShape::Gable,
        ][n % 6];
        style.shape = Some(spanned(shape));
        match draws.below(4) {
            0 => style.sori = Some(spanned(4.0)),
            1 => style.sori = Some(spanned(-3.0)),
            2 => style.ratio = Some(spanned(0.4)),
            _ => style.gable = Some(spanned(draws.below(50) as f64 / 100.0)),
        }
        let (building, out) = build(house);
        assert!(out.iter().all(|d| d.code.0 == 511), "{n}");
        assert_sound(&building);
        assert_covered(&format!("plan {n} {shape:?}"), &building, 0, &[]);
    }
}

#[test]
fn random_plans_with_plain_eaves_stay_within_bounds() {
    let mut draws = Draws(11);
    for _ in 0..60 {
        let outer = rings(&mut draws, 24);
        let corners: Vec<(f64, f64)> = outer[0].corners().iter().map(|p| (p.x, p.y)).collect();
        let (building, _) = build(house(vec![outer]));
        assert_within(&building, &corners);
    }
}

#[test]
fn random_towers_are_closed() {
    let mut draws = Draws(13);
    for n in 0..120 {
        let storeys = vec![
            rings(&mut draws, 20),
            rings(&mut draws, 14),
            rings(&mut draws, 8),
        ];
        let mut house = house(storeys);
        if n % 3 == 0 {
            house.roofs.style.shape = Some(spanned(RoofShape::Flat));
        }
        let (building, out) = build(house);
        assert!(
            out.iter().all(|d| [505, 506, 511].contains(&d.code.0)),
            "{n}"
        );
        assert_sound(&building);
    }
}

#[test]
fn the_same_house_has_the_same_roofs() {
    let mut draws = Draws(17);
    for _ in 0..10 {
        let house = house(vec![rings(&mut draws, 20)]);
        let json = |b| serde_json::to_string(&b).unwrap();
        assert_eq!(
            json(build(house.clone()).0.houses),
            json(build(house).0.houses)
        );
    }
}
