//! Gables and monitors on other roofs: closed, joined without gaps, as high as their width and pitch say.

use crate::roof_shapes::common::*;
use crate::roof_shapes::halls::close;
use hsd::ast::{RoofDirection, RoofLine, RoofShape};
use hsd::building::{Building, Finish, House, Roof};

/// A house of 9 x 5 units at 5 sun under a roof of one shape, with further lines.
fn under(shape: RoofShape, lines: Vec<RoofLine>) -> House {
    let mut house = house(vec![vec![ring(&rect(0.0, 0.0, 9.0, 5.0))]]);
    let mut main = line(shape, None, None, [0.0, 0.0, 9.0, 5.0]);
    main.style.pitch = Some(spanned(5.0));
    main.style.sori = Some(spanned(0.0));
    house.roofs.lines = vec![main];
    house.roofs.lines.extend(lines);
    house
}

fn on(shape: RoofShape, side: RoofDirection, corners: [f64; 4], pitch: f64) -> RoofLine {
    let mut line = line(shape, Some(side), None, corners);
    line.style.pitch = Some(spanned(pitch));
    line.style.sori = Some(spanned(0.0));
    line
}

fn last(building: &Building) -> &Roof {
    roofs(building).last().expect("there are roofs")
}

/// The height of the upper surface of a slope of 5 sun, `inward` units behind the wall.
fn slope(inward: f64) -> f64 {
    H + 0.12 * 1.25_f64.sqrt() + 0.5 * inward * U
}

/// No place under the roof is open to the sky, except where `but` says so.
fn assert_covered(building: &Building, but: impl Fn(f64, f64) -> bool) {
    for i in 1..180 {
        for j in 1..100 {
            let (a, b) = (f64::from(i) * 0.05 + 0.0013, f64::from(j) * 0.05 + 0.0017);
            let top = top_at(building, a, b);
            assert!(top.is_some() || but(a, b), "{a} {b}: no roof");
        }
    }
}

#[test]
fn a_chidori_hafu_is_as_high_as_its_pitch_says_and_dies_in_its_slope() {
    let shapes = [RoofShape::Gable, RoofShape::Hip, RoofShape::HipAndGable];
    for (shape, pitch) in shapes.into_iter().flat_map(|s| [(s, 6.0), (s, 8.0)]) {
        let corners = [3.5, 0.5, 5.5, 1.0];
        let house = under(
            shape,
            vec![on(RoofShape::Chidori, RoofDirection::Front, corners, pitch)],
        );
        let building = quiet(house);
        assert_sound(&building);
        let (foot, ridge) = (slope(0.5), slope(0.5) + pitch / 10.0 * U);
        let top = |a, b| top_at(&building, a, b).expect("is roofed");
        close(top(4.5, 0.6), ridge, "ridge");
        close(top(4.0, 0.6), ridge - pitch / 10.0 * 0.5 * U, "slope");
        // Where the slope reaches the ridge the gable ends, and beside its feet the slope goes on.
        let dies = 0.5 + 2.0 * pitch / 10.0;
        close(top(4.5, dies + 0.1), slope(dies + 0.1), "behind");
        close(top(3.2, 0.6), slope(0.6), "beside");
        assert!(top(3.55, 0.55) >= foot);
        assert_covered(&building, |_, _| false);
        let gable = last(&building);
        assert_eq!(gable.shape, RoofShape::Chidori);
        assert!(gable.trim.pendant);
        let walls = gable
            .solids
            .iter()
            .filter(|s| s.faces.iter().all(|f| f.finish == Finish::Gable));
        assert!(walls.count() >= 1, "a gable wall");
    }
}

#[test]
fn a_noki_karahafu_lifts_the_eaves_from_foot_to_foot() {
    let corners = [3.0, 0.0, 6.0, 1.0];
    let building = quiet(under(
        RoofShape::Gable,
        vec![on(
            RoofShape::EavesKarahafu,
            RoofDirection::Front,
            corners,
            4.0,
        )],
    ));
    assert_sound(&building);
    let main = &roofs(&building)[0];
    let eaves = main.trim.eaves / U;
    let edge = slope(-eaves);
    let top = |a, b| top_at(&building, a, b).expect("is roofed");
    let front = -eaves + 0.01;
    close(top(4.5, front), edge + 0.4 * 1.5 * U, "crown");
    assert!((top(3.02, front) - edge).abs() < 0.01);
    close(top(2.9, front), slope(front), "eaves beside");
    // Its edge is that of the roof.
    let (lo, _) = crate::roof_shapes::halls::extent(last(&building));
    assert!((lo.y + main.trim.eaves).abs() < 1e-5, "{lo}");
    assert_covered(&building, |_, _| false);
    let wall = last(&building)
        .solids
        .iter()
        .any(|s| s.faces[0].finish == Finish::Gable);
    assert!(wall, "the wall goes on up to the karahafu");
}

#[test]
fn a_gable_that_would_overtop_its_roof_is_lowered() {
    let corners = [1.0, 0.5, 8.0, 1.0];
    let house = under(
        RoofShape::Gable,
        vec![on(RoofShape::Chidori, RoofDirection::Front, corners, 8.0)],
    );
    let (building, out) = build(house);
    assert_eq!(codes(&out), vec![525]);
    assert_sound(&building);
    let top = top_at(&building, 4.5, 0.6).expect("is roofed");
    assert!((slope(2.5) - top - 0.05).abs() < 0.02, "{top}");
}

#[test]
fn dormers_need_a_slope_that_falls_to_their_side() {
    for (shape, side, corners) in [
        (
            RoofShape::Chidori,
            RoofDirection::Back,
            [3.0, 0.5, 6.0, 1.0],
        ),
        (
            RoofShape::Chidori,
            RoofDirection::Left,
            [3.0, 0.5, 6.0, 2.0],
        ),
        (
            RoofShape::Chidori,
            RoofDirection::Front,
            [13.0, 0.5, 16.0, 2.0],
        ),
        (
            RoofShape::Chidori,
            RoofDirection::Front,
            [3.0, 0.5, 3.25, 2.0],
        ),
        (
            RoofShape::EavesKarahafu,
            RoofDirection::Front,
            [-6.0, 0.0, -4.0, 2.0],
        ),
        (
            RoofShape::Monitor,
            RoofDirection::AlongFront,
            [7.0, 2.0, 10.0, 3.0],
        ),
    ] {
        let (building, out) = build(under(RoofShape::Gable, vec![on(shape, side, corners, 6.0)]));
        assert_eq!(codes(&out), vec![524], "{shape:?}");
        assert_eq!(roofs(&building).len(), 1);
    }
}

#[test]
fn a_monitor_stands_over_an_opening_in_the_ridge() {
    let corners = [3.0, 2.0, 6.0, 3.0];
    for shape in [RoofShape::Gable, RoofShape::Hip, RoofShape::Gambrel] {
        let building = quiet(under(
            shape,
            vec![on(
                RoofShape::Monitor,
                RoofDirection::AlongFront,
                corners,
                4.0,
            )],
        ));
        assert_sound(&building);
        let [main, monitor] = roofs(&building) else {
            panic!("two roofs")
        };
        let p = glam::dvec2(-4.5 * U, 2.3 * U);
        assert!(
            main.solids.iter().all(|s| top_of(s, p).is_none()),
            "open below"
        );
        let ridge = top_at(&building, 1.5, 2.5).expect("the main ridge");
        let top = top_at(&building, 4.5, 2.5).expect("its own");
        // The plate clears the ridge by 0.12 m or has 0.54 m of vents above the slope.
        assert!(top > ridge + 0.12 + 0.2 * U, "{top} {ridge}");
        assert!(top < ridge + 1.2, "{top} {ridge}");
        assert_covered(&building, |_, _| false);
        let timber = monitor
            .solids
            .iter()
            .filter(|s| s.faces[0].finish == Finish::Timber);
        assert!(timber.count() > 20, "louvres and posts");
    }
}

#[test]
fn a_fire_wall_follows_the_roof_at_one_height() {
    for (shape, corners) in [
        (RoofShape::Gable, [3.0, -1.0, 3.25, 6.0]),
        (RoofShape::Hip, [4.5, -0.5, 5.0, 5.5]),
        (RoofShape::Gambrel, [0.0, -1.0, 0.25, 6.0]),
    ] {
        let building = quiet(under(
            shape,
            vec![on(
                RoofShape::FireWall,
                RoofDirection::AcrossFront,
                corners,
                5.0,
            )],
        ));
        assert_sound(&building);
        let mut bare = under(shape, vec![]);
        bare.roofs.lines.truncate(1);
        let bare = quiet(bare);
        let middle = (corners[0] + corners[2]) / 2.0;
        let half = (corners[2] - corners[0]) / 2.0 * U;
        for b in [-0.3, 0.4, 1.7, 2.4, 3.1, 4.6] {
            let below = top_at(&bare, middle, b).expect("the roof");
            let top = top_at(&building, middle, b).expect("the wall");
            // 0.45 m of wall, and its tiles.
            let wanted = below + 0.45 + 0.5 * half + 0.05;
            assert!(
                (top - wanted).abs() < 0.012,
                "{shape:?} {b}: {top} {wanted}"
            );
        }
        assert_covered(&building, |_, _| false);
    }
}

#[test]
fn a_roof_ends_in_the_fire_wall_at_its_gable() {
    let wall = |corners| {
        on(
            RoofShape::FireWall,
            RoofDirection::AcrossFront,
            corners,
            5.0,
        )
    };
    let bare = quiet(under(RoofShape::Gable, vec![]));
    let building = quiet(under(
        RoofShape::Gable,
        vec![wall([0.0, -1.0, 0.25, 6.0]), wall([8.8, -1.0, 9.2, 6.0])],
    ));
    assert_sound(&building);
    // The verges of the bare roof reach 0.16 units beyond its gables: there are the tiles of the wall now, above them, or nothing.
    for (a, b) in [(-0.14, 1.2), (-0.14, 3.6)] {
        let verge = top_at(&bare, a, b).expect("a verge");
        let top = top_at(&building, a, b);
        assert!(
            top.is_none_or(|top| top > verge + 0.3),
            "{a} {b}: {top:?} {verge}"
        );
    }
    // Far from it the other end of a roof keeps its verge.
    let one = quiet(under(RoofShape::Gable, vec![wall([0.0, -1.0, 0.25, 6.0])]));
    assert!(top_at(&one, 9.14, 1.2).is_some());
    assert_covered(&building, |_, _| false);
}

#[test]
fn a_chidori_hafu_high_on_a_hollow_slope_takes_nothing_beside_it() {
    for b in [0.5, 1.2, 1.6] {
        let corners = [3.5, b, 5.5, b + 1.0];
        let gable = on(RoofShape::Chidori, RoofDirection::Front, corners, 5.5);
        let mut house = under(RoofShape::Temple, vec![gable]);
        house.roofs.lines[0].style.sori = Some(spanned(4.0));
        let mut hollow = house.clone();
        hollow.roofs.lines[1].style.sori = None;
        for house in [house, hollow] {
            let (building, _) = build(house);
            assert_sound(&building);
            assert_eq!(roofs(&building).len(), 2);
            assert_covered(&building, |_, _| false);
        }
    }
}

#[test]
fn dormers_of_every_kind_are_closed_everywhere() {
    let sides = [
        (RoofDirection::Front, [3.3, 0.4, 5.1, 1.0]),
        (RoofDirection::Back, [2.0, 3.5, 4.4, 4.7]),
        (RoofDirection::Left, [7.8, 1.7, 8.6, 3.3]),
        (RoofDirection::Right, [0.3, 1.5, 1.0, 3.5]),
    ];
    for shape in [RoofShape::Hip, RoofShape::Temple, RoofShape::Pyramid] {
        for kind in [RoofShape::Chidori, RoofShape::EavesKarahafu] {
            let lines = sides.map(|(side, corners)| {
                let mut one = line(kind, Some(side), None, corners);
                one.style.sori = Some(spanned(3.0));
                one
            });
            let mut house = under(shape, lines.to_vec());
            house.roofs.lines[0].style.sori = Some(spanned(4.0));
            let (building, _) = build(house);
            assert_sound(&building);
            assert_eq!(roofs(&building).len(), 5, "{shape:?} {kind:?}");
            assert_covered(&building, |_, _| false);
        }
    }
}
