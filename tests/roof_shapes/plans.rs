//! Plans of the domain sheet: covered without gaps, nothing sticks out.

use crate::roof_shapes::common::*;
use hsd::building::{Building, Ring};

type Corners = Vec<(f64, f64)>;

/// Names, outlines and courts (docs/evidence.md 3.6).
fn shapes() -> Vec<(&'static str, Corners, Option<Corners>)> {
    let z = vec![
        (0.0, 0.0),
        (10.0, 0.0),
        (10.0, 6.0),
        (16.0, 6.0),
        (16.0, 12.0),
        (6.0, 12.0),
        (6.0, 6.0),
        (0.0, 6.0),
    ];
    let u = vec![
        (0.0, 0.0),
        (16.0, 0.0),
        (16.0, 12.0),
        (11.0, 12.0),
        (11.0, 6.0),
        (5.0, 6.0),
        (5.0, 12.0),
        (0.0, 12.0),
    ];
    let h = vec![
        (0.0, 0.0),
        (5.0, 0.0),
        (5.0, 5.0),
        (10.0, 5.0),
        (10.0, 0.0),
        (15.0, 0.0),
        (15.0, 14.0),
        (10.0, 14.0),
        (10.0, 9.0),
        (5.0, 9.0),
        (5.0, 14.0),
        (0.0, 14.0),
    ];
    let plus = vec![
        (5.0, 0.0),
        (11.0, 0.0),
        (11.0, 5.0),
        (16.0, 5.0),
        (16.0, 11.0),
        (11.0, 11.0),
        (11.0, 16.0),
        (5.0, 16.0),
        (5.0, 11.0),
        (0.0, 11.0),
        (0.0, 5.0),
        (5.0, 5.0),
    ];
    let stair = vec![
        (0.0, 0.0),
        (8.0, 0.0),
        (8.0, 3.0),
        (14.0, 3.0),
        (14.0, 6.0),
        (20.0, 6.0),
        (20.0, 12.0),
        (12.0, 12.0),
        (12.0, 9.0),
        (6.0, 9.0),
        (6.0, 6.0),
        (0.0, 6.0),
    ];
    vec![
        (
            "L",
            vec![
                (0.0, 0.0),
                (14.0, 0.0),
                (14.0, 6.0),
                (6.0, 6.0),
                (6.0, 12.0),
                (0.0, 12.0),
            ],
            None,
        ),
        (
            "L2",
            vec![
                (0.0, 0.0),
                (6.0, 0.0),
                (6.0, 4.0),
                (4.0, 4.0),
                (4.0, 14.0),
                (0.0, 14.0),
            ],
            None,
        ),
        (
            "T",
            vec![
                (0.0, 0.0),
                (18.0, 0.0),
                (18.0, 5.0),
                (12.0, 5.0),
                (12.0, 14.0),
                (6.0, 14.0),
                (6.0, 5.0),
                (0.0, 5.0),
            ],
            None,
        ),
        ("U", u, None),
        ("Z", z, None),
        ("H", h, None),
        ("PLUS", plus, None),
        ("STAIR", stair, None),
        (
            "COURT",
            rect(0.0, 0.0, 20.0, 14.0),
            Some(rect(6.0, 4.5, 14.0, 9.5)),
        ),
        (
            "HALF",
            vec![
                (0.0, 0.0),
                (7.5, 0.0),
                (7.5, 2.25),
                (9.0, 2.25),
                (9.0, 6.5),
                (0.0, 6.5),
            ],
            None,
        ),
    ]
}

fn rings(outline: &Corners, court: &Option<Corners>) -> Vec<Ring> {
    let mut rings = vec![ring(outline)];
    rings.extend(court.iter().map(|c| hole(c)));
    rings
}

#[test]
fn shapes_of_the_sheet_are_covered_and_closed() {
    for (name, outline, court) in shapes() {
        for kd in [false, true] {
            for street in [false, true] {
                let mut house = house(vec![rings(&outline, &court)]);
                house.street = street;
                if kd {
                    house.roofs.method = hsd::ast::RoofMethod::Kd;
                }
                let building = quiet(house);
                assert_sound(&building);
                assert_covered(name, &building, 0, &[]);
                assert_within(&building, &outline);
            }
        }
    }
}

#[test]
fn rectangles_of_all_sizes_are_closed() {
    for w in [0.5, 1.0, 2.0, 3.5, 6.0, 17.0, 40.0] {
        for d in [0.5, 1.0, 2.25, 5.0, 9.0, 33.0] {
            let building = quiet(house(vec![vec![ring(&rect(0.0, 0.0, w, d))]]));
            assert_sound(&building);
            assert_covered("rectangle", &building, 0, &[]);
        }
    }
}

#[test]
fn setbacks_are_covered_on_every_side() {
    let ground = rect(0.0, 0.0, 12.0, 10.0);
    let uppers = [
        rect(0.0, 0.0, 12.0, 6.0),
        rect(0.0, 2.0, 12.0, 10.0),
        rect(2.0, 2.0, 9.0, 8.0),
        rect(0.0, 0.0, 8.0, 7.0),
        rect(3.0, 0.0, 9.0, 10.0),
        rect(5.0, 4.0, 7.0, 6.0),
    ];
    for upper in uppers {
        let building = quiet(house(vec![vec![ring(&ground)], vec![ring(&upper)]]));
        assert_sound(&building);
        assert_covered("setback", &building, 0, &upper);
        assert_covered("upper", &building, 1, &[]);
    }
}

/// Rays from above hit a roof of the storey, at the wall plate or higher, all over its regions; under
/// ceilings of lean-tos at 1.8 m or higher.
pub fn assert_covered(name: &str, building: &Building, k: usize, _upper: &[(f64, f64)]) {
    let house = &building.houses[0].house;
    let storey = &house.storeys[k];
    let ceilings = &building.houses[0].roofs.ceilings;
    for region in &building.houses[0].roofs.plans[k].regions {
        let [a0, b0, a1, b1] = region.rect;
        for i in 0..9 {
            for j in 0..9 {
                let at =
                    |lo: f64, hi: f64, n: usize| lo + (hi - lo) * (0.013 + 0.974 * n as f64 / 8.0);
                let (a, b) = (at(a0, a1, i), at(b0, b1, j));
                let top = top_at(building, a, b);
                let low = ceilings
                    .iter()
                    .any(|c| c.storey == storey.number && c.rect == region.rect);
                let least = if low { storey.z0 + 1.5 } else { storey.z1 };
                assert!(
                    top.is_some_and(|t| t >= least),
                    "{name}: ({a}, {b}) has {top:?}, not {least}"
                );
            }
        }
    }
}

/// Nothing stands farther out than the deepest eaves, and nothing higher than a ridge can be.
pub fn assert_within(building: &Building, outline: &[(f64, f64)]) {
    let (mut lo, mut hi) = (glam::DVec2::MAX, glam::DVec2::MIN);
    for (a, b) in outline {
        let p = glam::dvec2(-a * U, b * U);
        (lo, hi) = (lo.min(p), hi.max(p));
    }
    let (lo, hi) = (lo - 0.8, hi + 0.8);
    let top = H + 0.6 * (hi - lo).min_element() / 2.0 + 1.0;
    for p in all_solids(building).flat_map(|s| &s.points) {
        assert!(
            p.x >= lo.x && p.x <= hi.x && p.y >= lo.y && p.y <= hi.y && p.z <= top,
            "{p}"
        );
    }
}
