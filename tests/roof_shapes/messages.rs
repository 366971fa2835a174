//! Each message on the span it is about.

use crate::roof_shapes::common::*;
use crate::support::Words;
use hsd::ast::{RoofDirection, RoofMethod, RoofShape};
use hsd::building::{House, Ring};
use hsd::source::{Span, Spanned};

const NONE: Vec<u16> = vec![];

fn plain() -> House {
    house(vec![vec![ring(&rect(0.0, 0.0, 6.0, 8.0))]])
}

fn with(mut house: House, line: hsd::ast::RoofLine) -> House {
    house.roofs.lines.push(line);
    house
}

fn span(start: u32) -> Span {
    Span {
        start,
        end: start + 3,
        ..Span::default()
    }
}

fn said(house: House) -> Vec<u16> {
    let (building, out) = build(house);
    assert_sound(&building);
    for d in out.iter() {
        assert!(
            !d.help.is_empty() && !d.message.en().ends_with('.'),
            "{d:?}"
        );
    }
    codes(&out)
}

#[test]
fn a_roof_on_an_open_facade_is_an_error_only_when_asked_for() {
    let walls = walk(&[(0.0, 0.0), (6.0, 0.0), (6.0, 8.0)], false);
    let open = Ring {
        closed: false,
        walls,
        ..ring(&rect(0.0, 0.0, 6.0, 8.0))
    };
    let mut facade = house(vec![vec![open]]);
    assert_eq!(said(facade.clone()), NONE);
    facade.roofs.wished = Some(span(7));
    let (_, out) = build(facade);
    assert!(out.has_errors());
    assert_eq!(out.iter().next().unwrap().span().unwrap(), span(7));
}

#[test]
fn rectangles_beside_the_walls_are_warned_about() {
    let at = |corners| line(RoofShape::Gable, None, Some(9.0), corners);
    assert_eq!(said(with(plain(), at([20.0, 0.0, 26.0, 8.0]))), vec![502]);
    assert_eq!(said(with(plain(), at([0.0, 0.0, 7.0, 8.0]))), vec![503]);
    assert_eq!(said(with(plain(), at([0.0, 0.0, 6.0, 8.0]))), NONE);
}

#[test]
fn overlapping_roofs_are_noted() {
    let at = |corners| line(RoofShape::Gable, None, Some(9.0), corners);
    let two = with(
        with(plain(), at([0.0, 0.0, 6.0, 5.0])),
        at([0.0, 3.0, 6.0, 8.0]),
    );
    assert_eq!(said(two), vec![504]);
    let same = with(
        with(plain(), at([0.0, 0.0, 6.0, 8.0])),
        at([0.0, 0.0, 6.0, 8.0]),
    );
    assert_eq!(said(same), vec![504]);
}

#[test]
fn overhangs_are_told_by_their_size() {
    let storeys = |upper: Vec<(f64, f64)>| {
        house(vec![
            vec![ring(&rect(0.0, 0.0, 6.0, 8.0))],
            vec![ring(&upper)],
        ])
    };
    assert_eq!(said(storeys(rect(0.0, -0.5, 6.0, 8.0))), vec![506]);
    assert_eq!(said(storeys(rect(0.0, 0.0, 8.0, 8.0))), vec![505]);
    let (_, out) = build(storeys(rect(0.0, 0.0, 8.0, 8.0)));
    assert!(out.iter().next().unwrap().message.en().contains("2 U"));
}

#[test]
fn odd_options_are_warned_about() {
    let mut steep = plain();
    steep.roofs.style.pitch = Some(Spanned::new(12.0, span(3)));
    let (_, out) = build(steep);
    let first = out.iter().next().unwrap();
    assert_eq!((first.code.0, first.span().unwrap()), (507, span(3)));
    let gable = |d, h| line(RoofShape::Gable, d, h, [0.0, 0.0, 6.0, 8.0]);
    let slim = |d, h| line(RoofShape::Gable, d, h, [0.0, 0.0, 4.0, 8.0]);
    assert_eq!(
        said(with(
            plain(),
            slim(Some(RoofDirection::AlongFront), Some(9.0))
        )),
        vec![508]
    );
    assert_eq!(
        said(with(
            plain(),
            gable(Some(RoofDirection::AcrossFront), Some(9.0))
        )),
        NONE
    );
    assert_eq!(said(with(plain(), gable(None, Some(12.5)))), vec![509]);
    assert_eq!(
        said(with(plain(), gable(Some(RoofDirection::Left), Some(9.0)))),
        vec![514]
    );
    let lean = line(
        RoofShape::LeanTo,
        Some(RoofDirection::AlongFront),
        None,
        [0.0, 0.0, 6.0, 8.0],
    );
    assert_eq!(said(with(plain(), lean)), vec![514]);
    let hip = line(RoofShape::Hip, None, None, [0.0, 0.0, 6.0, 8.0]);
    assert_eq!(said(with(plain(), hip)), NONE);
}

#[test]
fn pent_roofs_hang_on_walls() {
    let pent = |h, corners| {
        line(
            RoofShape::Pent,
            Some(RoofDirection::Front),
            Some(h),
            corners,
        )
    };
    assert_eq!(said(with(plain(), pent(7.8, [0.0, 0.0, 6.0, -1.0]))), NONE);
    assert_eq!(
        said(with(plain(), pent(7.8, [0.0, -2.0, 6.0, -3.0]))),
        vec![512]
    );
    assert_eq!(
        said(with(plain(), pent(9.0, [0.0, 0.0, 6.0, -1.0]))),
        vec![513]
    );
}

#[test]
fn a_wish_for_slopes_over_a_round_plan_is_answered() {
    let hexagon = [
        (2.0, 0.0),
        (4.0, 0.0),
        (6.0, 3.0),
        (4.0, 6.0),
        (2.0, 6.0),
        (0.0, 3.0),
    ];
    let mut house = house(vec![vec![ring(&hexagon)]]);
    assert_eq!(said(house.clone()), vec![520]);
    house.roofs.style.shape = Some(spanned(RoofShape::Gable));
    assert_eq!(said(house.clone()), vec![515]);
    house.roofs.style.shape = Some(spanned(RoofShape::Hip));
    assert_eq!(said(house.clone()), NONE);
    house.roofs.style.shape = None;
    house.roofs.method = RoofMethod::Skeleton;
    assert_eq!(said(house), NONE);
}

#[test]
fn a_roof_inside_the_storey_above_is_told() {
    let plan = || ring(&rect(0.0, 0.0, 6.0, 8.0));
    let two = house(vec![vec![plan()], vec![plan()]]);
    let inside = line(RoofShape::Gable, None, Some(9.0), [0.0, 0.0, 6.0, 8.0]);
    assert_eq!(said(with(two, inside)), vec![516]);
}
