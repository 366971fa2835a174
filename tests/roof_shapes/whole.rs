//! Storeys roofed as a whole by the straight skeleton.

use crate::roof_shapes::common::*;
use hsd::ast::{RoofDirection, RoofMethod, RoofShape};
use hsd::building::{Building, House, Ring};

fn regular(n: usize, radius: f64) -> Vec<(f64, f64)> {
    let at = |i: usize| std::f64::consts::TAU * i as f64 / n as f64;
    let corner = |i: usize| (10.0 + radius * at(i).cos(), 10.0 + radius * at(i).sin());
    (0..n).map(corner).collect()
}

fn by_skeleton(storeys: Vec<Vec<Ring>>) -> House {
    let mut house = house(storeys);
    house.roofs.method = RoofMethod::Skeleton;
    house
}

fn highest(building: &Building) -> f64 {
    let solids = roofs(building).iter().flat_map(|r| &r.solids);
    solids
        .flat_map(|s| &s.points)
        .map(|p| p.z)
        .fold(0.0, f64::max)
}

#[test]
fn a_hexagon_has_six_slopes_and_one_peak() {
    let building = quiet(house(vec![vec![ring(&regular(6, 3.0))]]));
    assert_sound(&building);
    assert_eq!(roofs(&building)[0].shape, RoofShape::Hip);
    let drop = 0.12 * 1.16_f64.sqrt();
    let apothem = 3.0 * U * (std::f64::consts::PI / 6.0).cos();
    near(
        top_at(&building, 10.0, 10.0).unwrap(),
        H + drop + 0.4 * apothem,
    );
    let region = &building.houses[0].roofs.plans[0].regions[0];
    assert_eq!(region.polygon.as_ref().unwrap().len(), 6);
    assert_eq!(
        (region.shape, region.role, region.ridge),
        (RoofShape::Hip, "main", None)
    );
}

#[test]
fn a_rectangle_by_the_skeleton_is_a_yosemune() {
    let building = quiet(by_skeleton(vec![vec![ring(&rect(0.0, 0.0, 6.0, 10.0))]]));
    assert_sound(&building);
    let top = H + 0.12 * 1.16_f64.sqrt() + 0.4 * 3.0 * U;
    near(highest(&building), top);
    // The ridge is as long as the sides differ.
    for b in [3.0, 5.0, 7.0] {
        near(top_at(&building, 3.0, b).unwrap(), top);
    }
    near(top_at(&building, 3.0, 2.0).unwrap(), top - 0.4 * U);
    near(top_at(&building, 3.0, 9.5).unwrap(), top - 0.4 * 2.5 * U);
}

#[test]
fn a_court_stays_open_and_its_eaves_hang_into_it() {
    let rings = vec![
        ring(&rect(0.0, 0.0, 14.0, 12.0)),
        hole(&rect(4.0, 4.0, 10.0, 8.0)),
    ];
    let building = quiet(by_skeleton(vec![rings]));
    assert_sound(&building);
    assert_eq!(top_at(&building, 7.0, 6.0), None);
    assert!(top_at(&building, 7.0, 4.5).unwrap() < H);
    near(
        highest(&building),
        H + 0.12 * 1.16_f64.sqrt() + 0.4 * 2.0 * U,
    );
}

#[test]
fn eaves_in_a_narrow_court_leave_a_gap() {
    let rings = vec![
        ring(&rect(0.0, 0.0, 11.0, 12.0)),
        hole(&rect(5.0, 4.0, 6.0, 8.0)),
    ];
    let building = quiet(by_skeleton(vec![rings]));
    assert_sound(&building);
    assert_eq!(top_at(&building, 5.5, 6.0), None);
    assert!(top_at(&building, 5.3, 6.0).is_some());
}

#[test]
fn upper_walls_cut_it_at_any_angle_and_stand_without_eaves_upon_its_own() {
    let lower = vec![ring(&rect(0.0, 0.0, 20.0, 20.0))];
    let building = quiet(house(vec![lower.clone(), vec![ring(&regular(8, 4.0))]]));
    assert_sound(&building);
    let storeys: Vec<u32> = roofs(&building).iter().map(|r| r.storey).collect();
    assert_eq!(storeys, [1, 2]);
    assert!(top_at(&building, 3.0, 10.0).unwrap() > H);
    let inside = roofs(&building)[0].solids.iter().flat_map(|s| &s.points);
    let deep = inside
        .map(|p| (p.x / U + 10.0).hypot(p.y / U - 10.0))
        .fold(f64::MAX, f64::min);
    assert!(
        deep > 4.0 * (std::f64::consts::PI / 8.0).cos() - 1e-6,
        "{deep}"
    );
    // A storey as wide as the one below, but half as deep.
    let upper = vec![ring(&rect(0.0, 0.0, 20.0, 10.0))];
    let building = quiet(by_skeleton(vec![lower, upper]));
    assert_sound(&building);
    let first = roofs(&building)[0].solids.iter().flat_map(|s| &s.points);
    let front = first.map(|p| p.y / U).fold(f64::MAX, f64::min);
    near(front, 10.0);
}

#[test]
fn roof_lines_take_their_rectangles_out() {
    let mut house = by_skeleton(vec![vec![ring(&rect(0.0, 0.0, 12.0, 8.0))]]);
    let hall = line(
        RoofShape::Gable,
        Some(RoofDirection::AcrossFront),
        None,
        [0.0, 0.0, 6.0, 8.0],
    );
    house.roofs.lines = vec![hall];
    let (building, _) = build(house);
    assert_sound(&building);
    let shapes: Vec<RoofShape> = roofs(&building).iter().map(|r| r.shape).collect();
    assert_eq!(shapes, [RoofShape::Hip, RoofShape::Gable]);
    assert_eq!(
        building.houses[0].roofs.plans[0].regions[0].rect,
        [6.0, 0.0, 12.0, 8.0]
    );
}

#[test]
fn a_storey_that_the_next_one_repeats_gets_none() {
    let rings = || vec![ring(&regular(5, 4.0))];
    let building = quiet(house(vec![rings(), rings()]));
    assert_eq!(
        roofs(&building)
            .iter()
            .map(|r| r.storey)
            .collect::<Vec<_>>(),
        [2]
    );
}
