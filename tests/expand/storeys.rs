//! Houses written row by row.

use crate::expand::build::*;
use hsd::ast::{Item, Loop, RoofMode, Row};
use hsd::program::Content;

/// The example of `docs/evidence.md` 2.6: 6 x 8 units, two storeys.
#[test]
fn the_legacy_example() {
    let deep = "APW  ".repeat(8);
    let ground = [
        "GSI  GSI  GDE 2TOD  KKS  ",
        &deep,
        "KTU  TSH 2TSH 2KTU  ",
        &deep,
    ];
    let upper = ["KSK  MMU 2MMU 2KSK  ", &deep, "KTU  MMU 2MMU 2KTU  ", &deep];
    let made = |rows: [&str; 4]| storey(rows.iter().map(|r| row(codes(r))).collect());
    let mut house = house(vec![made(ground), made(upper)]);
    house.heights = vec![put(9.0), put(5.0)];
    let program = clean(house);
    let made = &program.houses[0];
    assert_eq!(
        (made.azimuth, made.unit_shaku, made.street),
        (180.0, 3.0, false)
    );
    let heights: Vec<_> = made.storeys.iter().map(|s| s.height).collect();
    assert_eq!(heights, [9.0, 5.0]);
    for storey in &made.storeys {
        let lines = &storey.loops[0].lines;
        let widths: Vec<_> = lines.iter().map(|l| width(&l.units)).collect();
        assert_eq!(widths, [6.0, 8.0, 6.0, 8.0]);
        assert!(lines.iter().all(|line| line.turn == 90.0));
    }
}

#[test]
fn heights_by_default_and_in_the_header() {
    let mut made = house(vec![storey(vec![row(codes("KTU  "))])]);
    assert_eq!(clean(made.clone()).houses[0].storeys[0].height, 9.0);
    // The legacy reader reports surplus heights.
    made.heights = vec![put(8.0), put(7.0)];
    assert_eq!(clean(made).houses[0].storeys[0].height, 8.0);
}

#[test]
fn leading_voids_are_kept() {
    let program = clean(one_row(codes("          KTU  ")));
    let units = &line(&program, 0, 0).units;
    assert_eq!(units[0].content, Content::Void);
    assert_eq!(width(units), 3.0);
}

#[test]
fn holes_turn_left_and_need_a_start() {
    let hole = |start| Loop {
        span: at(),
        hole: true,
        inner: false,
        start,
        rows: vec![row(codes("KTU  KTU  "))],
    };
    let mut ground = storey(vec![row(codes("KTU  "))]);
    ground.start = Some(put((1.0, 2.0)));
    ground.loops.push(hole(Some(put((2.0, 5.0)))));
    let program = clean(house(vec![ground.clone()]));
    let loops = &program.houses[0].storeys[0].loops;
    assert_eq!((loops[0].start, loops[1].start), ((1.0, 2.0), (2.0, 5.0)));
    assert_eq!(
        (loops[0].lines[0].turn, loops[1].lines[0].turn),
        (90.0, -90.0)
    );
    ground.loops.push(hole(None));
    let (program, said) = run(house(vec![ground]));
    assert_eq!(numbers(&said), [313]);
    assert_eq!(program.houses[0].storeys[0].loops.len(), 2);
}

#[test]
fn turns_as_written() {
    let mut left = Row {
        span: at(),
        pieces: codes("KTU  "),
        turn: None,
    };
    left.turn = Some(put(-90.0));
    let program = clean(house(vec![storey(vec![Item::One(left), row(vec![])])]));
    assert_eq!(line(&program, 0, 0).turn, -90.0);
    assert!(line(&program, 0, 1).units.is_empty());
}

#[test]
fn a_house_of_nothing() {
    assert_eq!(numbers(&run(house(vec![])).1), [318]);
    let mut none = house(vec![]);
    none.storeys
        .push(repeat(0, vec![Item::One(storey(vec![]))]));
    assert_eq!(numbers(&run(none).1), [318]);
}

#[test]
fn roofs_and_settings_get_their_defaults() {
    let mut made = one_row(codes("KTU  "));
    made.settings.x = Some(put(3.0));
    made.settings.unit = Some(put(3.25));
    made.settings.street = Some(put(true));
    let program = clean(made.clone());
    let house = &program.houses[0];
    assert_eq!(house.origin, [3.0, 0.0, 0.0]);
    assert_eq!((house.unit_shaku, house.street), (3.25, true));
    assert!(house.roofs.wished.is_none());
    made.roofs.style.pitch = Some(put(4.0));
    assert!(clean(made.clone()).houses[0].roofs.wished.is_some());
    made.roofs.mode = Some(put(RoofMode::Explicit));
    assert!(clean(made.clone()).houses[0].roofs.wished.is_none());
    made.settings.unit = Some(put(0.0));
    assert_eq!(clean(made).houses[0].unit_shaku, 3.0);
}

#[test]
fn storeys_or_facades() {
    let mut made = one_row(codes("KTU  "));
    let other = structure(None, vec![facade(vec![floor("1", codes("KTU  "))])]);
    made.structures = other.structures;
    assert_eq!(numbers(&run(made).1), [321]);
}
