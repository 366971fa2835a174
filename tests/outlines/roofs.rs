//! Roofs over outlines: by what a house is for, and where not all sides are at right angles.

use super::{apart, codes, ground, house, points, run, turned};
use crate::support::{Numbers, assert_none, compile, flaws};
use glam::{DVec2, dvec2};
use hsd::ast::RoofShape;

/// A palace as surveyed, its walls off by a few centimetres, with a corridor at an odd angle: the palace is squared and gets
/// gables, the corridor a hip roof of its own.
#[test]
fn a_skew_corridor_leaves_the_rest_square() {
    const PALACE: [DVec2; 10] = [
        dvec2(0.0, 0.0),
        dvec2(18.0, 0.0),
        dvec2(18.0, 9.0),
        dvec2(26.0, 15.0),
        dvec2(24.9, 16.5),
        dvec2(18.0, 11.3),
        dvec2(18.0, 14.0),
        dvec2(9.0, 14.0),
        dvec2(9.0, 22.0),
        dvec2(0.0, 22.0),
    ];
    for seed in 0..20 {
        let mut numbers = Numbers(seed);
        let mut noise = || numbers.below(100) as f64 / 1000.0 - 0.05;
        let survey = turned(&PALACE, seed as f64 * 17.3, DVec2::ZERO);
        let survey: Vec<DVec2> = survey
            .iter()
            .map(|p| *p + dvec2(noise(), noise()))
            .collect();
        let run = house(&format!("points='{}' front='1'>", points(&survey)), "");
        assert_eq!(codes(&run), [422], "{seed}: {}", run.short());
        assert_none(&flaws(&run));
        assert!(apart(&ground(&run, 0), &survey) < 0.3, "{seed}");
        let roofs = &run.building.houses[0].roofs.roofs;
        let gables = roofs.iter().filter(|r| r.shape == RoofShape::Gable);
        let hips = roofs.iter().filter(|r| r.shape == RoofShape::Hip);
        assert_eq!((gables.count(), hips.count()), (2, 1), "{seed}: {roofs:?}");
    }
}

#[test]
fn roofs_follow_the_purpose_of_a_house() {
    let shape = |purpose: &str, points: &str, roofs: &str| {
        let run = run(&format!(
            "<House use='{purpose}'><Outline points='{points}'/>{roofs}</House>"
        ));
        assert!(!run.has_errors(), "{}", run.short());
        let roof = &run.building.houses[0].roofs.roofs[0];
        (roof.shape, roof.kind)
    };
    use hsd::ast::RoofKind::{Bark, CoverTiles, Tiles};
    use hsd::ast::RoofShape::{Gable, Hip, HipAndGable, Pyramid};
    let (square, long) = ("0 0, 9 0, 9 8.2, 0 8.2", "0 0, 12 0, 12 8, 0 8");
    let slanting = "0 0, 9 0, 12 4, 12 8, 0 8";
    assert_eq!(shape("hall", square, ""), (Pyramid, CoverTiles));
    assert_eq!(shape("hall", long, ""), (Gable, CoverTiles));
    assert_eq!(shape("temple", square, ""), (HipAndGable, CoverTiles));
    assert_eq!(shape("temple", slanting, ""), (Hip, Tiles));
    assert_eq!(shape("shrine", long, ""), (Gable, Bark));
    for purpose in ["dwelling", "store", "gate"] {
        assert_eq!(shape(purpose, square, ""), (Gable, Tiles), "{purpose}");
    }
    let own = "<Roofs shape='YOS' kind='Y'/>";
    assert_eq!(shape("hall", square, own).0, Hip);
    // An L of a hall is no square, though its bounds are.
    let corner = "0 0, 9 0, 9 4, 4 4, 4 9, 0 9";
    assert_eq!(shape("hall", corner, "").0, Gable);
}

/// A nearly square hall keeps its pyramid behind a porch, which gets a small roof of its own.
#[test]
fn a_hall_keeps_its_pyramid_behind_its_porch() {
    let text = r#"<House use="hall">
  <Outline points="0 0, 6 0, 6 -2, 9 -2, 9 0, 15 0, 15 14.6, 0 14.6"/>
</House>
"#;
    let run = compile("hall.hsd", text.as_bytes());
    assert!(!run.has_errors(), "{}", run.short());
    assert_none(&flaws(&run));
    let roofs = &run.building.houses[0].roofs;
    let [plan] = &roofs.plans[..] else {
        panic!("one storey");
    };
    let [_, hall] = &plan.regions[..] else {
        panic!("{:?}", plan.regions);
    };
    assert_eq!(hall.shape, hsd::ast::RoofShape::Pyramid);
    let surfaces = roofs.surfaces().iter();
    let ridge = surfaces.flat_map(|s| s.lines(hsd::building::EdgeKind::Ridge));
    let longest = ridge.map(|[p, q]| (p - q).length()).fold(0.0, f64::max);
    assert!(longest < 4.0, "a ridge of {longest} m");
}
