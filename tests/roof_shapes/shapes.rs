//! Each shape by its dimensions.

use crate::roof_shapes::common::*;
use hsd::ast::{RoofDirection, RoofKind, RoofShape};
use hsd::building::{Building, Finish, Roof};
use hsd::geometry::SHAKU;

fn covering_top(roof: &Roof) -> f64 {
    let mut top = f64::MIN;
    for solid in &roof.solids {
        for face in &solid.faces {
            if matches!(face.finish, Finish::Covering(_)) {
                let z = face.corners.iter().map(|c| solid.points[*c as usize].z);
                top = top.max(z.fold(f64::MIN, f64::max));
            }
        }
    }
    top
}

/// Extent (min, max) of the sheet in the house frame.
fn extent(roof: &Roof) -> (glam::DVec3, glam::DVec3) {
    let covering = roof.solids.iter().filter(|s| {
        s.faces
            .iter()
            .any(|f| matches!(f.finish, Finish::Covering(_)))
    });
    let points = covering.flat_map(|s| &s.points);
    points.fold((glam::DVec3::MAX, glam::DVec3::MIN), |(lo, hi), p| {
        (lo.min(*p), hi.max(*p))
    })
}

fn drop_of(thickness: f64, pitch: f64) -> f64 {
    thickness * (1.0 + pitch * pitch).sqrt()
}

#[test]
fn a_machiya_gable_has_the_dimensions_of_the_formula() {
    let building = quiet(house(vec![vec![ring(&rect(0.0, 0.0, 8.0, 6.0))]]));
    assert_sound(&building);
    let [roof] = roofs(&building) else { panic!() };
    assert_eq!(
        (roof.shape, roof.kind, roof.storey),
        (RoofShape::Gable, RoofKind::Tiles, 1)
    );
    let ridge = H + 0.4 * 3.0 * U + drop_of(0.12, 0.4);
    near(covering_top(roof), ridge);
    let (lo, hi) = extent(roof);
    let (eaves, verge) = (2.5 * SHAKU, 0.5 * SHAKU);
    near(hi.x, verge);
    near(lo.x, -8.0 * U - verge);
    near(lo.y, -eaves);
    near(hi.y, 6.0 * U + eaves);
    near(lo.z, H - 0.4 * eaves);
    // The lower surface passes through the wall plate: the upper one lies one drop above.
    near(top_at(&building, 4.0, 0.0).unwrap(), H + drop_of(0.12, 0.4));
}

#[test]
fn options_of_the_house_are_followed() {
    let mut house = house(vec![vec![ring(&rect(0.0, 0.0, 6.0, 8.0))]]);
    house.roofs.style.kind = Some(spanned(RoofKind::Thatch));
    house.roofs.style.pitch = Some(spanned(9.0));
    house.roofs.style.eaves = Some(spanned(3.0));
    house.roofs.style.verge = Some(spanned(2.0));
    house.roofs.style.thickness = Some(spanned(2.5));
    let building = quiet(house);
    assert_sound(&building);
    let roof = &roofs(&building)[0];
    near(
        covering_top(roof),
        H + 0.9 * 3.0 * U + drop_of(2.5 * SHAKU, 0.9),
    );
    let (lo, hi) = extent(roof);
    near(hi.x, 3.0 * SHAKU);
    near(lo.y, -2.0 * SHAKU);
}

#[test]
fn the_broad_gable_turns_its_ridge() {
    let mut house = house(vec![vec![ring(&rect(0.0, 0.0, 6.0, 4.0))]]);
    house.roofs.style.shape = Some(spanned(RoofShape::BroadGable));
    let building = quiet(house);
    assert_sound(&building);
    assert_eq!(
        building.houses[0].roofs.plans[0].regions[0].ridge,
        Some("b")
    );
    near(
        covering_top(&roofs(&building)[0]),
        H + 0.4 * 3.0 * U + drop_of(0.12, 0.4),
    );
}

#[test]
fn a_branch_dies_in_its_trunk_and_stands_lower() {
    // T: bar 18 x 5, stem 4 wide.
    let t = [
        (0.0, 0.0),
        (18.0, 0.0),
        (18.0, 5.0),
        (11.0, 5.0),
        (11.0, 14.0),
        (7.0, 14.0),
        (7.0, 5.0),
        (0.0, 5.0),
    ];
    let building = quiet(house(vec![vec![ring(&t)]]));
    assert_sound(&building);
    let plan = &building.houses[0].roofs.plans[0];
    assert_eq!(plan.regions.len(), 2);
    assert_eq!(
        (plan.regions[1].role, plan.regions[1].over),
        ("branch", Some(0))
    );
    let drop = drop_of(0.12, 0.4);
    let trunk = H + 0.4 * 2.5 * U + drop;
    let branch = H + 0.4 * 2.0 * U + drop;
    near(covering_top(&roofs(&building)[0]), trunk);
    near(covering_top(&roofs(&building)[1]), branch);
    // The branch's ridge meets the trunk's slope 2 units in, so the surface is level there.
    near(
        top_at(&building, 8.9, 3.1).unwrap(),
        H + drop + 0.4 * 1.9 * U,
    );
    // Before the meeting point the branch's ridge is the highest.
    near(top_at(&building, 9.0, 4.0).unwrap(), branch);
    // Beyond the trunk's ridge nothing of the branch shows.
    near(top_at(&building, 9.0, 1.0).unwrap(), H + drop + 0.4 * U);
    // One gable wall less: none where it runs in.
    let gables = |r: &Roof| {
        r.solids
            .iter()
            .filter(|s| s.faces[0].finish == Finish::Gable)
            .count()
    };
    assert_eq!(
        (gables(&roofs(&building)[0]), gables(&roofs(&building)[1])),
        (2, 1)
    );
}

#[test]
fn eaves_of_a_trunk_stay_out_of_its_branch() {
    let t = [
        (0.0, 0.0),
        (18.0, 0.0),
        (18.0, 5.0),
        (11.0, 5.0),
        (11.0, 14.0),
        (7.0, 14.0),
        (7.0, 5.0),
        (0.0, 5.0),
    ];
    let building = quiet(house(vec![vec![ring(&t)]]));
    let inside =
        |p: &glam::DVec3| p.x < -7.01 * U && p.x > -10.99 * U && p.y > 5.01 * U && p.y < 13.9 * U;
    let below = |p: &glam::DVec3| p.z < H - 1e-6;
    for solid in all_solids(&building) {
        let sheet = solid
            .faces
            .iter()
            .any(|f| matches!(f.finish, Finish::Covering(_)));
        if sheet {
            assert!(!solid.points.iter().any(|p| inside(p) && below(p)));
        }
    }
}

#[test]
fn a_strip_becomes_a_lean_to_under_the_eaves_and_cuts_the_walls() {
    // GEYA: hall 8 x 6 and a strip 4 x 2 behind a part of it.
    let plan = [
        (0.0, 0.0),
        (8.0, 0.0),
        (8.0, 6.0),
        (6.0, 6.0),
        (6.0, 8.0),
        (2.0, 8.0),
        (2.0, 6.0),
        (0.0, 6.0),
    ];
    let building = quiet(house(vec![vec![ring(&plan)]]));
    assert_sound(&building);
    let region = &building.houses[0].roofs.plans[0].regions[1];
    assert_eq!(
        (region.role, region.fall, region.ridge),
        ("lean-to", Some("B"), None)
    );
    let [ceiling] = building.houses[0].roofs.ceilings[..] else {
        panic!()
    };
    assert_eq!(ceiling.rect, [2.0, 6.0, 6.0, 8.0]);
    let low = ceiling.z + ceiling.slope.y * 8.0;
    let high = ceiling.z + ceiling.slope.y * 6.0;
    near(high - low, 2.0 * U * 0.3);
    assert!(low >= 1.8 && high < H, "{low} {high}");
    // Its upper surface lies below the trunk's eaves everywhere.
    let lean = &roofs(&building)[1];
    for (a, b) in [(3.0, 6.1), (4.0, 6.5), (5.0, 6.8)] {
        let p = glam::dvec2(-a * U, b * U);
        let own = lean
            .solids
            .iter()
            .filter_map(|s| top_of(s, p))
            .reduce(f64::max)
            .unwrap();
        let eaves = H - 0.4 * (b - 6.0) * U;
        assert!(own < eaves, "{own} {eaves}");
    }
}

#[test]
fn a_low_storey_is_warned_about() {
    let plan = [
        (0.0, 0.0),
        (8.0, 0.0),
        (8.0, 6.0),
        (6.0, 6.0),
        (6.0, 8.0),
        (2.0, 8.0),
        (2.0, 6.0),
        (0.0, 6.0),
    ];
    let mut house = house(vec![vec![ring(&plan)]]);
    house.storeys[0].z1 = 2.0;
    let (building, out) = build(house);
    assert_eq!(codes(&out), vec![511]);
    assert_sound(&building);
}

#[test]
fn a_rear_strip_leans_against_the_upper_wall() {
    let building = quiet(house(vec![
        vec![ring(&rect(0.0, 0.0, 6.0, 8.0))],
        vec![ring(&rect(0.0, 0.0, 6.0, 5.0))],
    ]));
    assert_sound(&building);
    let plans = &building.houses[0].roofs.plans;
    assert_eq!(
        (plans[0].regions[0].role, plans[0].regions[0].fall),
        ("lean-to", Some("B"))
    );
    let lean = &roofs(&building)[0];
    let drop = drop_of(0.12, 0.3);
    near(covering_top(lean), H + 0.3 * 3.0 * U + drop);
    let (lo, _) = extent(lean);
    near(lo.y, 5.0 * U);
    assert!(building.houses[0].roofs.ceilings.is_empty());
}

#[test]
fn eaves_do_not_enter_the_storey_above() {
    // The upper storey stands on the left half; the right half's gable runs along it.
    let building = quiet(house(vec![
        vec![ring(&rect(0.0, 0.0, 12.0, 5.0))],
        vec![ring(&rect(0.0, 0.0, 5.0, 5.0))],
    ]));
    assert_sound(&building);
    let lower = &roofs(&building)[0];
    assert_eq!(lower.storey, 1);
    for solid in &lower.solids {
        if solid
            .faces
            .iter()
            .any(|f| matches!(f.finish, Finish::Covering(_)))
        {
            assert!(solid.points.iter().all(|p| p.x <= -5.0 * U + 1e-6));
        }
    }
}

#[test]
fn the_example_of_the_domain_sheet_stands() {
    let plan = || ring(&rect(0.0, 0.0, 6.0, 8.0));
    let mut house = house(vec![vec![plan()], vec![plan()]]);
    house.storeys[1].z1 = 14.0 * SHAKU;
    let mut pent = line(
        RoofShape::Pent,
        Some(RoofDirection::Front),
        Some(8.1),
        [0.0, 0.0, 6.0, -1.0],
    );
    pent.style.pitch = Some(spanned(3.0));
    let main = line(
        RoofShape::Gable,
        Some(RoofDirection::AlongFront),
        Some(14.0),
        [0.0, 0.0, 6.0, 8.0],
    );
    house.roofs.lines = vec![main, pent];
    let (building, out) = build(house);
    // The ridge parallel to the street spans 8 units over 6: usual in a street.
    assert!(codes(&out).is_empty());
    assert_sound(&building);
    let [pent, main] = roofs(&building) else {
        panic!()
    };
    assert_eq!(
        (pent.shape, pent.storey, main.shape, main.storey),
        (RoofShape::Pent, 1, RoofShape::Gable, 2)
    );
    let (lo, hi) = extent(pent);
    near(lo.y, -U);
    near(hi.y, 0.03);
    near(covering_top(pent), H + 0.03 * 0.3);
    near(
        top_of(&pent.solids[0], glam::dvec2(-U, -U)).unwrap(),
        8.1 * SHAKU,
    );
    assert!(
        building.houses[0]
            .roofs
            .plans
            .iter()
            .all(|p| p.regions.is_empty())
    );
}

#[test]
fn a_two_storeyed_street_house_gets_its_pent_roof() {
    let plan = || ring(&rect(0.0, 0.0, 6.0, 8.0));
    let mut shop = house(vec![vec![plan()], vec![plan()]]);
    shop.street = true;
    let building = quiet(shop.clone());
    assert_sound(&building);
    let pent = &roofs(&building)[0];
    assert_eq!((pent.shape, pent.storey), (RoofShape::Pent, 1));
    let (lo, hi) = extent(pent);
    near(lo.y, -3.0 * SHAKU);
    near(lo.x, -6.0 * U);
    near(hi.x, 0.0);
    near(top_of(&pent.solids[0], glam::dvec2(-U, 0.0)).unwrap(), H);
    assert_eq!(
        building.houses[0].roofs.plans[1].regions[0].ridge,
        Some("a")
    );
    let bare = explicit_only(shop);
    assert!(roofs(&quiet(bare)).is_empty());
}

#[test]
fn a_street_house_set_back_above_gets_none() {
    let mut shop = house(vec![
        vec![ring(&rect(0.0, 0.0, 6.0, 8.0))],
        vec![ring(&rect(0.0, 1.0, 6.0, 8.0))],
    ]);
    shop.street = true;
    let building = quiet(shop);
    assert!(roofs(&building).iter().all(|r| r.shape != RoofShape::Pent));
    assert_sound(&building);
}

#[test]
fn a_free_lean_to_is_walled_up() {
    for direction in [
        RoofDirection::Front,
        RoofDirection::Back,
        RoofDirection::Left,
        RoofDirection::Right,
    ] {
        let mut shed = house(vec![vec![ring(&rect(0.0, 0.0, 3.0, 4.0))]]);
        shed.roofs.lines = vec![line(
            RoofShape::LeanTo,
            Some(direction),
            None,
            [0.0, 0.0, 3.0, 4.0],
        )];
        let building = quiet(shed);
        assert_sound(&building);
        let roof = &roofs(&building)[0];
        let gables = roof.solids.iter();
        let gables = gables.filter(|s| s.faces[0].finish == Finish::Gable);
        let feet = gables.map(|s| s.points.iter().map(|p| p.z).fold(H + 9.0, f64::min));
        let feet: Vec<f64> = feet.collect();
        assert_eq!(feet.len(), 3);
        assert!(feet.iter().all(|z| *z <= H), "none leaves a gap: {feet:?}");
        let depth = if matches!(direction, RoofDirection::Front | RoofDirection::Back) {
            4.0
        } else {
            3.0
        };
        let over = 0.5 * SHAKU;
        near(
            covering_top(roof),
            H + 0.3 * (depth * U + over) + drop_of(0.12, 0.3),
        );
    }
}

#[test]
fn an_automatic_lean_to_is_that_of_a_line() {
    for (size, direction, fall) in [
        ([6.0, 4.0], RoofDirection::Front, "F"),
        ([3.0, 4.0], RoofDirection::Right, "R"),
    ] {
        let plain = house(vec![vec![ring(&rect(0.0, 0.0, size[0], size[1]))]]);
        let mut automatic = plain.clone();
        automatic.roofs.style.shape = Some(spanned(RoofShape::LeanTo));
        let mut written = explicit_only(plain);
        let corners = [0.0, 0.0, size[0], size[1]];
        written.roofs.lines = vec![line(RoofShape::LeanTo, Some(direction), None, corners)];
        let (automatic, written) = (quiet(automatic), quiet(written));
        assert_sound(&automatic);
        let solids = |b: &Building| format!("{:?}", roofs(b)[0].solids);
        assert_eq!(solids(&automatic), solids(&written));
        let region = &automatic.houses[0].roofs.plans[0].regions[0];
        let told = (region.role, region.fall, region.shape);
        assert_eq!(told, ("lean-to", Some(fall), RoofShape::LeanTo));
    }
}

#[test]
fn explicit_lines_leave_the_rest_to_the_automatic() {
    let l = [
        (0.0, 0.0),
        (6.0, 0.0),
        (6.0, 4.0),
        (4.0, 4.0),
        (4.0, 14.0),
        (0.0, 14.0),
    ];
    let mut house = house(vec![vec![ring(&l)]]);
    house.roofs.lines = vec![line(
        RoofShape::Gable,
        Some(RoofDirection::AlongFront),
        None,
        [0.0, 0.0, 6.0, 4.0],
    )];
    let building = quiet(house.clone());
    assert_sound(&building);
    assert_eq!(building.houses[0].roofs.plans[0].regions.len(), 1);
    assert_eq!(
        building.houses[0].roofs.plans[0].regions[0].rect,
        [0.0, 4.0, 4.0, 14.0]
    );
    assert_eq!(roofs(&building).len(), 2);
    let bare = quiet(explicit_only(house));
    assert_eq!(roofs(&bare).len(), 1);
    assert!(bare.houses[0].roofs.plans[0].regions.is_empty());
}

#[test]
fn a_wing_between_two_halls_dies_in_both() {
    let court = vec![
        ring(&rect(0.0, 0.0, 20.0, 14.0)),
        hole(&rect(6.0, 4.5, 14.0, 9.5)),
    ];
    let building = quiet(house(vec![court]));
    let gables = |r: &Roof| {
        r.solids
            .iter()
            .filter(|s| s.faces[0].finish == Finish::Gable)
            .count()
    };
    let mut walls: Vec<usize> = roofs(&building).iter().map(gables).collect();
    walls.sort_unstable();
    assert_eq!(walls, vec![0, 0, 2, 2]);
}
