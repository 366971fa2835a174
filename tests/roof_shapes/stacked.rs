//! Roofs beside written roofs, below other storeys, and under storeys that stand out.

use crate::roof_shapes::common::*;
use crate::roof_shapes::random::{Draws, rings};
use crate::support::Words;
use hsd::ast::{RoofDirection, RoofShape};
use hsd::building::{Building, Finish, House, Roof, Solid};
use hsd::geometry::SHAKU;

fn lines(mut house: House, lines: Vec<hsd::ast::RoofLine>) -> House {
    house.roofs.lines = lines;
    house
}

/// Sets the heights of the storeys, shaku.
fn heights(mut house: House, shaku: &[f64]) -> House {
    let mut z = 0.0;
    for (storey, height) in house.storeys.iter_mut().zip(shaku) {
        storey.z0 = z;
        z += height * SHAKU;
        storey.z1 = z;
    }
    house
}

fn sheets(roof: &Roof) -> impl Iterator<Item = &Solid> {
    let covered = |s: &&Solid| {
        let finishes = s.faces.iter().map(|f| f.finish);
        finishes
            .into_iter()
            .any(|f| matches!(f, Finish::Covering(_)))
    };
    roof.solids.iter().filter(covered)
}

/// Lowest and highest point of a solid over a plan point.
fn over(solid: &Solid, a: f64, b: f64) -> Option<(f64, f64)> {
    let top = top_of(solid, glam::dvec2(-a * U, b * U))?;
    let mut upside_down = solid.clone();
    upside_down.points.iter_mut().for_each(|p| p.z = -p.z);
    let low = -top_of(&upside_down, glam::dvec2(-a * U, b * U))?;
    Some((low, top))
}

/// No sheet of a lower storey's roof stands in one of a higher storey's.
fn assert_apart(what: &str, building: &Building) {
    let roofs = roofs(building);
    for lower in roofs {
        for upper in roofs.iter().filter(|r| r.storey > lower.storey) {
            for (p, q) in sheets(lower).flat_map(|p| sheets(upper).map(move |q| (p, q))) {
                for at in 0..60 * 60 {
                    let (a, b) = (
                        f64::from(at % 60) * 0.21 - 1.3,
                        f64::from(at / 60) * 0.21 - 1.3,
                    );
                    if let (Some(low), Some(high)) = (over(p, a, b), over(q, a, b)) {
                        assert!(
                            low.1 < high.0 + 1e-6 || low.0 > high.1,
                            "{what}: at {a} {b}: {low:?} in {high:?}"
                        );
                    }
                }
            }
        }
    }
}

fn region(
    building: &Building,
    n: usize,
) -> (&'static str, Option<&'static str>, Option<&'static str>) {
    let region = &building.houses[0].roofs.plans[0].regions[n];
    (region.role, region.ridge, region.fall)
}

#[test]
fn a_strip_beside_a_written_roof_leans_on_it() {
    // A hall of 8 x 6 with a written roof; behind it a strip of 8 x 2.
    let whole = house(vec![vec![ring(&rect(0.0, 0.0, 8.0, 8.0))]]);
    let along = Some(RoofDirection::AlongFront);
    let hall = line(RoofShape::Gable, along, Some(9.0), [0.0, 0.0, 8.0, 6.0]);
    let building = quiet(lines(whole.clone(), vec![hall.clone()]));
    assert_sound(&building);
    assert_eq!(region(&building, 0), ("lean-to", None, Some("B")));
    let strip = roofs(&building).iter().find(|r| r.span.is_none()).unwrap();
    assert_eq!(strip.shape, RoofShape::LeanTo);
    // It lies under the eaves of the hall, and the walls below it end there.
    let top = strip.solids.iter().flat_map(|s| &s.points).map(|p| p.z);
    assert!(top.fold(f64::MIN, f64::max) < H + 0.02);
    assert_eq!(building.houses[0].roofs.ceilings.len(), 1);
    // The same where the hall stands three shaku higher: the strip then rises from the plate.
    let high = line(RoofShape::Gable, along, Some(12.0), [0.0, 0.0, 8.0, 6.0]);
    let building = quiet(lines(whole, vec![high]));
    assert_sound(&building);
    assert_eq!(region(&building, 0), ("lean-to", None, Some("B")));
    let strip = roofs(&building).iter().find(|r| r.span.is_none()).unwrap();
    let lowest = strip.solids.iter().flat_map(|s| &s.points).map(|p| p.z);
    assert!(lowest.fold(f64::MAX, f64::min) > H - 0.3);
}

#[test]
fn a_wing_beside_a_written_roof_runs_into_it() {
    let l = [
        (0.0, 0.0),
        (12.0, 0.0),
        (12.0, 6.0),
        (4.0, 6.0),
        (4.0, 11.0),
        (0.0, 11.0),
    ];
    let along = Some(RoofDirection::AlongFront);
    let hall = line(RoofShape::Gable, along, Some(9.0), [0.0, 0.0, 12.0, 6.0]);
    let building = quiet(lines(house(vec![vec![ring(&l)]]), vec![hall]));
    assert_sound(&building);
    assert_eq!(region(&building, 0), ("branch", Some("b"), None));
    assert_eq!(building.houses[0].roofs.plans[0].regions[0].over, None);
    // Like a branch of an automatic trunk: the wing's ridge goes on into the hall's slope.
    let wanted = H + 0.4 * 1.9 * U + 0.12 * (1.0f64 + 0.16).sqrt();
    let found = top_at(&building, 1.9, 5.0).unwrap();
    assert!((found - wanted).abs() < 1e-6, "{found} is not {wanted}");
}

#[test]
fn a_street_front_below_a_set_back_storey_leans_on_it() {
    for by in [1.0, 2.0] {
        let storeys = vec![
            vec![ring(&rect(0.0, 0.0, 6.0, 9.0))],
            vec![ring(&rect(0.0, by, 6.0, 9.0))],
        ];
        let mut house = house(storeys);
        house.street = true;
        let building = quiet(house);
        assert_sound(&building);
        assert_eq!(region(&building, 0), ("lean-to", None, Some("F")), "{by}");
        assert_apart("street", &building);
    }
    // A deep front building keeps its own roof.
    let storeys = vec![
        vec![ring(&rect(0.0, 0.0, 6.0, 9.0))],
        vec![ring(&rect(0.0, 3.0, 6.0, 9.0))],
    ];
    let mut house = house(storeys);
    house.street = true;
    assert_eq!(region(&quiet(house), 0), ("main", Some("a"), None));
}

#[test]
fn lower_roofs_stay_below_the_eaves_of_a_low_storey() {
    for (upper, low) in [
        (rect(0.0, 0.0, 9.0, 4.0), 5.0),
        (rect(0.0, 0.0, 9.0, 4.0), 3.5),
        (rect(4.0, 0.0, 9.0, 9.0), 4.0),
        (rect(0.0, 0.0, 6.0, 9.0), 3.0),
        (rect(2.0, 2.0, 7.0, 7.0), 3.0),
    ] {
        let storeys = vec![vec![ring(&rect(0.0, 0.0, 9.0, 9.0))], vec![ring(&upper)]];
        let building = quiet(heights(house(storeys), &[9.0, low]));
        assert_sound(&building);
        assert_apart(&format!("{upper:?} {low}"), &building);
    }
}

#[test]
fn storeys_that_stand_out_are_closed_below() {
    let upper = rect(-1.0, -1.0, 9.0, 6.0);
    let storeys = vec![vec![ring(&rect(0.0, 0.0, 8.0, 6.0))], vec![ring(&upper)]];
    let (building, out) = build(house(storeys));
    assert_eq!(codes(&out), vec![506]);
    assert!(
        out.iter()
            .next()
            .unwrap()
            .message
            .en()
            .contains("projects 1 U beyond")
    );
    assert_sound(&building);
    let [soffit] = &building.houses[0].roofs.soffits[..] else {
        panic!()
    };
    assert_eq!(soffit.storey, 2);
    // Boards over every overhanging point, just below the floor; none over the rooms.
    for (a, b) in [(-0.5, -0.5), (4.3, -0.5), (8.5, 3.3), (-0.9, 5.9)] {
        let boards = soffit.solids.iter().filter_map(|s| over(s, a, b));
        let top = boards.fold(f64::MIN, |top, s| top.max(s.1));
        assert!((top - H).abs() < 0.01, "{a} {b}: {top}");
    }
    assert!(soffit.solids.iter().all(|s| over(s, 4.1, 3.1).is_none()));
    // Brackets reach from the walls below: 8 before the front, 6 on each side.
    let high = |s: &Solid| {
        let z = s.points.iter().map(|p| p.z);
        z.clone().fold(f64::MIN, f64::max) - z.fold(f64::MAX, f64::min)
    };
    let brackets = soffit
        .solids
        .iter()
        .filter(|s| (high(s) - 0.092).abs() < 0.01);
    assert_eq!(brackets.count(), 8 + 6 + 6);
}

#[test]
fn a_storey_that_touches_nothing_is_a_warning_however_thin() {
    let storeys = vec![
        vec![ring(&rect(0.0, 0.0, 8.0, 6.0))],
        vec![ring(&rect(0.0, 8.0, 8.0, 9.0))],
    ];
    let (building, out) = build(house(storeys));
    assert_eq!(codes(&out), vec![505]);
    assert_sound(&building);
}

#[test]
fn random_storeys_in_and_out_are_sound_and_apart() {
    let mut draws = Draws(19);
    let mut units = |n: u64| draws.below(n) as f64 / 2.0;
    for n in 0..150 {
        let (w, d) = (5.0 + units(8), 5.0 + units(8));
        let (a0, b0) = (units(8) - 1.0, units(8) - 1.0);
        let (a1, b1) = (w + 1.0 - units(6), d + 1.0 - units(6));
        let upper = rect(a0, b0, a1.max(a0 + 2.0), b1.max(b0 + 2.0));
        let storeys = vec![vec![ring(&rect(0.0, 0.0, w, d))], vec![ring(&upper)]];
        let mut house = heights(house(storeys), &[9.0, 4.0 + units(9)]);
        house.street = n % 2 == 0;
        let (building, out) = build(house);
        let known = out.iter().all(|d| [505, 506, 511].contains(&d.code.0));
        assert!(known, "{n}: {:?}", codes(&out));
        assert_sound(&building);
        assert_apart(&format!("house {n}, upper {upper:?}"), &building);
    }
}

#[test]
fn random_mixes_of_written_and_automatic_roofs_are_sound() {
    let mut draws = Draws(23);
    let shapes = [RoofShape::Gable, RoofShape::LeanTo, RoofShape::Flat];
    for n in 0..200 {
        let outer = rings(&mut draws, 16);
        let count = 1 + draws.below(3);
        let mut house = house(vec![outer]);
        house.street = draws.below(3) == 0;
        for _ in 0..count {
            let mut unit = |n: u64| draws.below(n) as f64 / 2.0;
            let (a0, b0) = (unit(16), unit(16));
            let corners = [a0, b0, a0 + 1.0 + unit(16), b0 + 1.0 + unit(16)];
            let height = [9.0, 9.0, 11.0, 8.5][draws.below(4) as usize];
            let shape = shapes[draws.below(3) as usize];
            let direction = match (shape, draws.below(4)) {
                (_, 0) | (RoofShape::Flat, _) => None,
                (RoofShape::LeanTo, 1) => Some(RoofDirection::Back),
                (RoofShape::LeanTo, _) => Some(RoofDirection::Left),
                (_, 1) => Some(RoofDirection::AlongFront),
                _ => Some(RoofDirection::AcrossFront),
            };
            house
                .roofs
                .lines
                .push(line(shape, direction, Some(height), corners));
        }
        let (building, _) = build(house);
        assert!(!roofs(&building).is_empty(), "{n}");
        assert_sound(&building);
    }
}
