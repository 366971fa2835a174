//! repeat, split, random, replace.

use crate::expand::build::*;
use hsd::ast::{Edit, House, Item, Random};
use hsd::expand::Options;
use hsd::program::{Content, Program};
use hsd::source::NoFiles;

#[test]
fn repetitions_nest() {
    let body = vec![
        part("KTU"),
        repeat(2, vec![part("GSI"), repeat(0, vec![part("APW")])]),
    ];
    let program = clean(one_row(vec![repeat(2, body), part("APW")]));
    assert_eq!(
        names(&program, 0, 0),
        "KTU  |GSI  |GSI  |KTU  |GSI  |GSI  |APW  "
    );
}

#[test]
fn the_example_of_the_contract_has_a_slot_in_a_row() {
    let mut pieces = codes("KTU  ");
    pieces.push(random("TSH 2, TKD 2"));
    pieces.extend(codes("TIT 2KTU"));
    let program = clean(one_row(pieces));
    let units = &line(&program, 0, 0).units;
    assert_eq!((units.len(), width(units)), (4, 6.0));
    assert!(["TSH 2", "TKD 2"].contains(&name(&program, &units[1]).as_str()));
}

#[test]
fn slots_of_one_row_draw_for_themselves() {
    let slot = || random("KTU, KJU, KSK");
    let one = one_row(vec![slot(), part("APW")]);
    let two = one_row(vec![slot(), part("APW"), slot()]);
    let mut alike = 0;
    for seed in 0..60 {
        let options = Options {
            seed: Some(seed),
            ..Options::default()
        };
        let drawn = |house: &House, unit: usize| {
            let (program, said) = run_in(house.clone(), &NoFiles, &options);
            assert!(said.is_empty(), "{said:?}");
            name(&program, &line(&program, 0, 0).units[unit])
        };
        assert_eq!(
            drawn(&one, 0),
            drawn(&two, 0),
            "what follows changes no draw"
        );
        alike += usize::from(drawn(&two, 0) == drawn(&two, 2));
    }
    assert!((8..35).contains(&alike), "{alike} of 60 draws are alike");
}

#[test]
fn random_beside_its_codes_draws_again() {
    let mut pieces = codes(&"KTU  KJU  APW  ".repeat(40));
    pieces.push(random("KTU, KJU, KSK"));
    let program = clean(one_row(pieces));
    let units = &line(&program, 0, 0).units;
    assert_eq!(units.len(), 120);
    let count = |code: &str| units.iter().filter(|u| name(&program, u) == code).count();
    assert_eq!(count("APW  "), 40);
    for code in ["KTU  ", "KJU  ", "KSK  "] {
        assert!(count(code) > 12, "{code}: {}", count(code));
    }
}

#[test]
fn weights_count() {
    let slots = vec![repeat(
        2000,
        vec![weighted("KTU,KJU", Some(vec![3.0, 1.0]))],
    )];
    let program = clean(one_row(slots));
    let units = &line(&program, 0, 0).units;
    let clay = units
        .iter()
        .filter(|u| name(&program, u) == "KTU  ")
        .count();
    assert!(clay.abs_diff(1500) < 80, "{clay}");
}

#[test]
fn bad_weights_are_errors() {
    let slot = |weights| one_row(vec![weighted("KTU,KJU", Some(weights))]);
    assert_eq!(numbers(&run(slot(vec![1.0])).1), [305]);
    // The readers report weights nobody can draw by; here they only must do no harm.
    clean(slot(vec![0.0, 0.0]));
}

#[test]
fn replace_substitutes_in_order_and_at_positions() {
    let mut pieces = codes("KTU  KJU  KTU  ");
    pieces.extend([replace("KTU", "KJU"), replace_at("KJU", "KSK", &[(2, 3)])]);
    let program = clean(one_row(pieces));
    assert_eq!(names(&program, 0, 0), "KJU  |KSK  |KSK  ");
    let mut pieces = codes("KTU  KJU  KTU  ");
    pieces.push(replace_at("", ".....", &[(2, 2)]));
    assert_eq!(names(&clean(one_row(pieces)), 0, 0), "KTU  |.....|KTU  ");
}

#[test]
fn edits_reach_into_splits() {
    let pieces = vec![
        split(codes("NWI  "), codes("NSP  ")),
        part("NAP"),
        replace("NWI", "NGC"),
    ];
    let program = clean(one_row(pieces));
    assert_eq!(names(&program, 0, 0), "(NGC  /NSP  )|NAP  ");
}

#[test]
fn splits_nest_and_must_fit() {
    let inner = split(codes("NWI  "), codes("NSP  "));
    let program = clean(one_row(vec![split(vec![inner], codes("NAP  "))]));
    assert_eq!(names(&program, 0, 0), "((NWI  /NSP  )/NAP  )");
    let (program, said) = run(one_row(vec![split(codes("NWI  NWI  "), codes("NSP  "))]));
    assert_eq!(numbers(&said), [311]);
    let Content::Split(made) = &line(&program, 0, 0).units[0].content else {
        panic!("a split is there");
    };
    assert_eq!((width(&made.upper), width(&made.lower)), (2.0, 2.0));
    let (program, said) = run(one_row(vec![split(codes("NWI  "), vec![])]));
    assert_eq!(numbers(&said), [311]);
    assert_eq!(names(&program, 0, 0), "(NWI  /.....)");
}

#[test]
fn a_row_keeps_its_width() {
    let (program, said) = run(one_row(vec![random("KTU, TSH 2"), part("APW")]));
    assert_eq!(numbers(&said), [306]);
    assert_eq!(width(&line(&program, 0, 0).units), 2.0);
    let mut pieces = codes("KTU  APW  ");
    pieces.push(replace("KTU", "TSH 2"));
    let (program, said) = run(one_row(pieces));
    assert_eq!(numbers(&said), [307]);
    assert_eq!(width(&line(&program, 0, 0).units), 2.0);
}

#[test]
fn idle_operations_are_reported_once() {
    let mut pieces = codes("KTU  APW  ");
    pieces.extend([
        replace("GSI", "KSK"),
        replace_at("KTU", "KSK", &[(1, 1), (5, 7)]),
    ]);
    let (_, said) = run(one_row(vec![repeat(3, pieces)]));
    assert_eq!(numbers(&said), [309, 310]);
    let mut ground = storey(vec![row(codes("KTU  "))]);
    ground.edits.push(Edit::Random(Random {
        span: at(),
        codes: put("GSI, GIT".into()),
        weights: None,
    }));
    assert_eq!(numbers(&run(house(vec![ground])).1), [308]);
}

#[test]
fn with_is_one_code() {
    let mut pieces = codes("KTU  ");
    pieces.push(replace("KTU", "KJU KSK"));
    let (program, said) = run(one_row(pieces));
    assert_eq!(numbers(&said), [322]);
    assert_eq!(names(&program, 0, 0), "KJU  ");
}

/// Two storeys of two rows with twenty slots each.
fn drawn(seed: Option<u64>, name: &str, extra: usize) -> Program {
    let slots = |extra: usize| {
        let mut pieces = codes(&"APW  ".repeat(extra));
        pieces.push(repeat(20, vec![random("KTU,KJU,KSK")]));
        row(pieces)
    };
    let mut made = house(vec![
        storey(vec![slots(0), slots(extra)]),
        storey(vec![slots(0), slots(0)]),
    ]);
    made.name = Some(put(name.into()));
    let options = Options {
        seed,
        ..Options::default()
    };
    let (program, said) = run_in(made, &hsd::source::NoFiles, &options);
    assert!(said.is_empty(), "{said:?}");
    program
}

#[test]
fn an_edit_elsewhere_changes_no_draw() {
    let (before, after) = (drawn(None, "a", 0), drawn(None, "a", 3));
    for (storey, at) in [(0, 0), (1, 0), (1, 1)] {
        assert_eq!(names(&before, storey, at), names(&after, storey, at));
    }
    assert_ne!(names(&before, 0, 0), names(&before, 1, 0));
    assert_ne!(names(&before, 0, 0), names(&before, 0, 1));
}

#[test]
fn seed_and_name_change_the_draws() {
    let zero = names(&drawn(None, "a", 0), 0, 0);
    assert_eq!(zero, names(&drawn(Some(0), "a", 0), 0, 0));
    assert_ne!(zero, names(&drawn(Some(1), "a", 0), 0, 0));
    assert_ne!(zero, names(&drawn(None, "b", 0), 0, 0));
}

#[test]
fn two_draws_at_one_position_are_independent() {
    let mut pieces = codes(&"KTU  ".repeat(400));
    pieces.push(part("KJU")); // So that the second draw has a code to find and is no slot.
    pieces.extend([random("KTU,KJU"), random("KJU,KSK")]);
    let program = clean(one_row(pieces));
    let units = &line(&program, 0, 0).units;
    let clay = units
        .iter()
        .filter(|u| name(&program, u) == "KJU  ")
        .count();
    // Half become KJU, and half of these stay.
    assert!(clay.abs_diff(100) < 35, "{clay}");
}

#[test]
fn edits_of_storeys_and_of_repeated_storeys() {
    let rows = || vec![row(codes("KTU  ")), row(codes("KTU  KJU  "))];
    let upper = repeat(2, vec![Item::One(storey(rows())), replace("KJU", "KSK")]);
    let mut made: House = house(vec![storey(rows())]);
    made.storeys.extend([upper, replace("KTU", "APW")]);
    let program = clean(made);
    assert_eq!(names(&program, 0, 1), "APW  |KJU  ");
    assert_eq!(names(&program, 1, 1), "APW  |KSK  ");
    assert_eq!(names(&program, 2, 0), "APW  ");
}
