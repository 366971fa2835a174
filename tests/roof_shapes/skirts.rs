//! Skirts: hipped roofs of storeys that carry a smaller one, cut by its walls (docs/evidence.md 7.10).

use crate::roof_shapes::common::*;
use crate::roof_shapes::halls::{close, covering, extent};
use hsd::ast::RoofShape;
use hsd::building::{Building, House};

/// A storey of 14 x 10 units with one inside it.
fn gate(shape: RoofShape, upper: [f64; 4]) -> House {
    let [a0, b0, a1, b1] = upper;
    let mut gate = house(vec![
        vec![ring(&rect(0.0, 0.0, 14.0, 10.0))],
        vec![ring(&rect(a0, b0, a1, b1))],
    ]);
    gate.roofs.style.shape = Some(spanned(shape));
    gate.roofs.style.pitch = Some(spanned(5.0));
    gate.roofs.style.sori = Some(spanned(0.0));
    gate
}

#[test]
fn a_skirt_runs_round_the_storey_above() {
    for shape in [
        RoofShape::Hip,
        RoofShape::HipAndGable,
        RoofShape::Pyramid,
        RoofShape::Temple,
    ] {
        let building = quiet(gate(shape, [2.0, 2.0, 12.0, 8.0]));
        assert_sound(&building);
        // What is open is covered once, by strips that fall away from the storey above.
        let strips = &building.houses[0].roofs.plans[0].regions;
        let told: Vec<_> = strips.iter().map(|r| (r.rect, r.role, r.fall)).collect();
        let strip = |rect, fall| (rect, "lean-to", Some(fall));
        let wanted = [
            strip([0.0, 0.0, 14.0, 2.0], "F"),
            strip([0.0, 2.0, 2.0, 8.0], "R"),
            strip([12.0, 2.0, 14.0, 8.0], "L"),
            strip([0.0, 8.0, 14.0, 10.0], "B"),
        ];
        assert_eq!(told, wanted);
        let [skirt, upper] = roofs(&building) else {
            panic!()
        };
        assert_eq!((skirt.storey, upper.shape), (1, shape));
        let drop = 0.12 * (1.25_f64).sqrt();
        // Up to z0 + t c at the walls above, and nothing inside them.
        let (lo, hi) = extent(skirt);
        close(hi.z, H + drop + 0.5 * 2.0 * U, "top of the skirt");
        close(
            hi.x - lo.x,
            14.0 * U + 2.0 * skirt.trim.eaves,
            "eaves all round",
        );
        let inside = |s: &hsd::building::Solid| top_of(s, glam::dvec2(-7.0 * U, 5.0 * U));
        assert!(skirt.solids.iter().all(|s| inside(s).is_none()));
    }
}

#[test]
fn a_skirt_stops_where_the_storey_above_stands_on_the_wall_below() {
    let building = quiet(gate(RoofShape::Hip, [2.0, 0.0, 14.0, 8.0]));
    assert_sound(&building);
    let skirt = &roofs(&building)[0];
    // At the front right corner no eaves are left, on the other sides they are.
    let (lo, hi) = extent(skirt);
    close(lo.x, -14.0 * U - skirt.trim.eaves, "left");
    close(hi.y, 10.0 * U + skirt.trim.eaves, "back");
    let corner = covering(skirt).filter(|p| p.x > -13.9 * U && p.x < -2.1 * U && p.y < 7.9 * U);
    assert_eq!(corner.count(), 0);
}

#[test]
fn written_skirts_do_the_same() {
    let automatic = quiet(gate(RoofShape::Hip, [2.0, 2.0, 12.0, 8.0]));
    let mut written = gate(RoofShape::Hip, [2.0, 2.0, 12.0, 8.0]);
    let mut line = line(RoofShape::Hip, None, Some(9.0), [0.0, 0.0, 14.0, 10.0]);
    line.style.pitch = Some(spanned(5.0));
    written.roofs.lines = vec![line];
    let written = quiet(written);
    let solids = |b: &Building| {
        serde_json::to_string(&roofs(b).iter().map(|r| &r.solids).collect::<Vec<_>>()).unwrap()
    };
    let (mut p, mut q) = (solids(&automatic), solids(&written));
    p.truncate(p.len() / 3);
    q.truncate(p.len());
    assert_eq!(p, q);
}

#[test]
fn a_tower_of_skirts_is_a_pagoda() {
    let storeys = (0..5).map(|k| {
        let inset = 0.5 * f64::from(k);
        vec![ring(&rect(inset, inset, 7.0 - inset, 7.0 - inset))]
    });
    let mut tower = house(storeys.collect());
    tower.roofs.style.shape = Some(spanned(RoofShape::Pyramid));
    tower.roofs.style.pitch = Some(spanned(4.5));
    tower.roofs.style.sori = Some(spanned(4.0));
    tower.roofs.style.eaves = Some(spanned(6.0));
    let building = quiet(tower);
    assert_sound(&building);
    assert_eq!(roofs(&building).len(), 5);
    let plans = building.houses[0].roofs.plans.iter();
    let counts: Vec<_> = plans
        .map(|p| (p.regions.len(), p.regions[0].role))
        .collect();
    let strips = (4, "lean-to");
    assert_eq!(counts, [strips, strips, strips, strips, (1, "main")]);
}

#[test]
fn a_skirt_without_room_is_gentler_and_said() {
    let mut low = gate(RoofShape::Hip, [4.0, 4.0, 10.0, 6.0]);
    low.storeys[1].z1 = H + 1.0;
    let (building, out) = build(low);
    assert_eq!(codes(&out), vec![510]);
    assert_sound(&building);
    let skirt = &roofs(&building)[0];
    let upper = &roofs(&building)[1];
    assert!(extent(skirt).1.z < extent(upper).0.z);
}
