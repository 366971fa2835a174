//! Flat roofs, their parapets and courts.

use crate::roof_shapes::common::*;
use hsd::ast::{RoofShape, StoreyKind};
use hsd::building::Building;

fn flat(storeys: Vec<Vec<hsd::building::Ring>>) -> Building {
    let mut house = house(storeys);
    house.roofs.style.shape = Some(spanned(RoofShape::Flat));
    let building = quiet(house);
    assert_sound(&building);
    building
}

#[test]
fn a_flat_roof_has_a_slab_and_an_upstand() {
    let l = [
        (0.0, 0.0),
        (6.0, 0.0),
        (6.0, 4.0),
        (4.0, 4.0),
        (4.0, 14.0),
        (0.0, 14.0),
    ];
    let building = flat(vec![vec![ring(&l)]]);
    assert_eq!(roofs(&building).len(), 1);
    assert_eq!(roofs(&building)[0].solids.len(), 2);
    near(top_at(&building, 2.0, 10.0).unwrap(), H + 0.03);
    near(top_at(&building, 0.0, 10.0).unwrap(), H + 0.4);
    assert_eq!(top_at(&building, 5.0, 10.0), None);
    let region = &building.houses[0].roofs.plans[0].regions[0];
    assert_eq!(
        (region.shape, region.ridge, region.role),
        (RoofShape::Flat, None, "main")
    );
}

#[test]
fn a_parapet_storey_stands_for_the_upstand() {
    let plan = || ring(&rect(0.0, 0.0, 6.0, 8.0));
    let mut office = house(vec![vec![plan()], vec![plan()]]);
    office.storeys[1].kind = StoreyKind::Parapet;
    office.storeys[1].number = 1;
    office.roofs.style.shape = Some(spanned(RoofShape::Flat));
    let building = quiet(office);
    assert_sound(&building);
    assert_eq!(roofs(&building).len(), 1);
    assert_eq!(roofs(&building)[0].solids.len(), 1);
    assert_eq!(building.houses[0].roofs.plans.len(), 1);
}

#[test]
fn a_flat_terrace_ends_at_the_upper_wall() {
    let building = flat(vec![
        vec![ring(&rect(0.0, 0.0, 6.0, 8.0))],
        vec![ring(&rect(0.0, 0.0, 6.0, 5.0))],
    ]);
    near(top_at(&building, 3.0, 5.2).unwrap(), H + 0.03);
    near(top_at(&building, 3.0, 8.0).unwrap(), H + 0.4);
}

#[test]
fn round_plans_are_flat_with_their_courts_where_asked_for() {
    let circle = |n: usize, r: f64| -> Vec<(f64, f64)> {
        let at = |i: usize| std::f64::consts::TAU * i as f64 / n as f64;
        (0..n)
            .map(|i| (10.0 + r * at(i).cos(), 10.0 + r * at(i).sin()))
            .collect()
    };
    let mut round = house(vec![vec![ring(&circle(36, 9.0)), hole(&circle(24, 4.0))]]);
    round.roofs.style.shape = Some(spanned(RoofShape::Flat));
    let building = quiet(round);
    assert_sound(&building);
    near(top_at(&building, 10.0, 3.0).unwrap(), H + 0.03);
    assert_eq!(top_at(&building, 10.0, 10.0), None);
    let region = &building.houses[0].roofs.plans[0].regions[0];
    assert_eq!(region.polygon.as_ref().unwrap().len(), 36);
    // Storeys that repeat the plan are covered.
    let tower = quiet(house(vec![
        vec![ring(&circle(36, 9.0))],
        vec![ring(&circle(36, 9.0))],
    ]));
    assert_eq!(
        roofs(&tower).iter().map(|r| r.storey).collect::<Vec<_>>(),
        vec![2]
    );
    assert_eq!(tower.houses[0].roofs.plans.len(), 2);
}
