//! Corridors round a court, in the manner of the kairo of temples: they mitre at corners and keep gables at free ends.

use crate::roof_shapes::common::*;
use crate::roof_shapes::junctions::worst_overlap;
use crate::roof_shapes::random::Draws;
use hsd::ast::RoofShape;
use hsd::building::{Building, EdgeKind, House, Ring};

/// The width of the corridors, U: a bay of ten shaku.
const BAY: f64 = 10.0 / 3.0;

/// A corridor on all sides of a court.
fn closed(width: f64) -> Vec<Ring> {
    let (long, deep) = (18.0 * BAY, 15.0 * BAY);
    vec![
        ring(&rect(0.0, 0.0, long, deep)),
        hole(&rect(width, width, long - width, deep - width)),
    ]
}

/// The same with an opening of four bays in the front, for a gate.
fn open_for_a_gate() -> Vec<Ring> {
    let (long, deep) = (18.0 * BAY, 15.0 * BAY);
    let (from, to) = (7.0 * BAY, 11.0 * BAY);
    let corners = [
        (0.0, 0.0),
        (from, 0.0),
        (from, BAY),
        (BAY, BAY),
        (BAY, deep - BAY),
        (long - BAY, deep - BAY),
        (long - BAY, BAY),
        (to, BAY),
        (to, 0.0),
        (long, 0.0),
        (long, deep),
        (0.0, deep),
    ];
    vec![ring(&corners)]
}

/// An L of two wings.
fn corner(one: f64, other: f64) -> Vec<Ring> {
    let corners = [
        (0.0, 0.0),
        (one, 0.0),
        (one, BAY),
        (BAY, BAY),
        (BAY, other),
        (0.0, other),
    ];
    vec![ring(&corners)]
}

/// Counts the hips: one at each mitred corner.
fn hips(building: &Building) -> usize {
    let of = |surface: &hsd::building::RoofSurface| {
        let hips = surface.lines(EdgeKind::Hip).into_iter();
        hips.filter(|[p, q]| (*p - *q).length() > 1.0).count()
    };
    surfaces(building).iter().map(of).sum()
}

fn built(rings: Vec<Ring>) -> House {
    house(vec![rings])
}

#[test]
fn corridors_turn_corners_in_hips() {
    let plans = [
        (closed(BAY), 4),
        (open_for_a_gate(), 4),
        (corner(4.0 * BAY, 6.0 * BAY), 1),
    ];
    let mut draws = Draws(7);
    for (rings, corners) in plans {
        let building = quiet(built(rings));
        assert_eq!(hips(&building), corners);
        let deep = worst_overlap(&building, &mut draws, 4000);
        assert!(deep < 0.01, "{deep} m inside each other");
    }
}

/// A ridge that turns has one height all round.
#[test]
fn the_ridge_of_a_corridor_goes_on_round_its_corners() {
    let building = quiet(built(closed(BAY)));
    let ridges = surfaces(&building)
        .iter()
        .flat_map(|surface| surface.lines(EdgeKind::Ridge))
        .collect::<Vec<_>>();
    let length: f64 = ridges.iter().map(|[p, q]| (*p - *q).length()).sum();
    let round = 2.0 * (17.0 + 14.0) * BAY * U;
    assert!((length - round).abs() < 0.1, "{length} of {round} m");
}

#[test]
fn what_is_no_corridor_keeps_its_gables() {
    // Too wide, too short, of two widths.
    let two_widths = vec![
        ring(&rect(0.0, 0.0, 18.0 * BAY, 15.0 * BAY)),
        hole(&rect(BAY, 1.2 * BAY, 17.0 * BAY, 13.8 * BAY)),
    ];
    for rings in [closed(4.6), corner(3.0 * BAY, 9.0 * BAY), two_widths] {
        assert_eq!(hips(&quiet(built(rings))), 0);
    }
}

#[test]
fn a_shape_that_is_asked_for_decides() {
    let mut house = built(closed(BAY));
    house.roofs.style.shape = Some(spanned(RoofShape::Gable));
    assert_eq!(hips(&quiet(house)), 0);
}
