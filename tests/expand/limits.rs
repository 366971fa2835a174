//! Careless numbers cost no time and no memory: what they ask for is counted before it is made. Made first, a billion of
//! anything would not end.

use crate::expand::build::*;
use crate::support::cpu::assert_linear;
use hsd::ast::{Item, Piece};
use hsd::expand::Options;
use hsd::source::{Limits, NoFiles, Span};

fn assert_too_many(house: hsd::ast::House) {
    let (program, said) = run(house);
    assert_eq!(numbers(&said), [904]);
    assert!(program.houses.is_empty());
}

#[test]
fn large_and_nested_repetitions_are_caught_before_they_run() {
    let billion = 1_000_000_000;
    assert_too_many(one_row(vec![repeat(billion, vec![part("KTU")])]));
    let mut nest = part("KTU");
    for _ in 0..60 {
        nest = repeat(u32::MAX, vec![nest]);
    }
    assert_too_many(one_row(vec![nest]));
    let mut many = house(vec![]);
    many.storeys = vec![repeat(billion, vec![Item::One(storey(vec![]))])];
    assert_too_many(many);
    let rows = storey(vec![repeat(billion, vec![row(vec![])])]);
    assert_too_many(house(vec![rows]));
    let floors = facade(vec![repeat(billion, vec![floor("1", codes("NAP  "))])]);
    assert_too_many(structure(None, vec![floors]));
}

#[test]
fn repetitions_of_nothing_end_at_once() {
    let empty: Item<Piece> = repeat(u32::MAX, vec![repeat(u32::MAX, vec![])]);
    let program = clean(one_row(vec![part("KTU"), empty]));
    assert_eq!(names(&program, 0, 0), "KTU  ");
}

#[test]
fn the_sum_counts_as_well() {
    let options = Options {
        limits: Limits {
            parts: 100,
            ..Limits::default()
        },
        ..Options::default()
    };
    let rows = |n| (0..n).map(|_| row(codes("KTU  KTU  "))).collect();
    let (_, said) = run_in(house(vec![storey(rows(50))]), &NoFiles, &options);
    assert!(said.is_empty(), "{said:?}");
    let (_, said) = run_in(house(vec![storey(rows(51))]), &NoFiles, &options);
    assert_eq!(numbers(&said), [904]);
}

/// Houses of a run share a limit of what repetitions add; what is written out does not count, however much it is.
#[test]
fn repetitions_of_all_houses_count_together() {
    let mut options = hsd::Options::default();
    options.expand.limits.repeated_parts = 1_000;
    let made = |text: &str| {
        let source = hsd::source::Source::new(Default::default(), "all.hsd", text.as_bytes());
        let mut out = hsd::diagnostic::Diagnostics::new();
        let checked = hsd::driver::check(&[&source], &NoFiles, &options, &mut out);
        let names = checked.building.houses.iter().map(|b| b.house.name.clone());
        let told = out.iter().filter(|d| d.code.0 == 907).count();
        (names.collect::<Vec<_>>().concat(), told)
    };
    let house = |name: &str, row: &str| {
        format!("<House name='{name}'><Storey><Row>{row}</Row></Storey></House>")
    };
    let repeated = |name, number| house(name, &format!("<repeat num='{number}'>KSK</repeat>"));
    let all = |houses: &[String]| format!("<Houses>{}</Houses>", houses.concat());
    let two = [repeated("a", 500), repeated("b", 600), repeated("c", 700)];
    assert_eq!(made(&all(&two)), ("ab".into(), 1));
    let between = [repeated("a", 900), repeated("b", 900), repeated("c", 80)];
    assert_eq!(made(&all(&between)), ("ac".into(), 1), "later ones may fit");
    let written = house("w", &"KSK,".repeat(5_000));
    assert_eq!(made(&written), ("w".into(), 0));
    let storeys = |number| {
        let storey = "<Storey><Row>KSK</Row></Storey>";
        format!("<House name='t'><repeat num='{number}'>{storey}</repeat></House>")
    };
    assert_eq!(made(&storeys(60)), ("t".into(), 0));
    assert_eq!(made(&storeys(100)), (String::new(), 1), "storeys take room");
    let edits = house(
        "e",
        &("KSK,".repeat(200) + &"<replace code='KSK' with='KTU'/>".repeat(200)),
    );
    assert_eq!(made(&edits), ("e".into(), 0));
}

/// What a repetition would make is counted at its number, whatever it repeats, and not at the part that is one too many.
#[test]
fn repetitions_are_caught_at_their_number() {
    fn number<T>(item: &Item<T>) -> Span {
        match item {
            Item::Repeat(repeat) => repeat.num.span,
            _ => unreachable!("is a repetition"),
        }
    }
    let limits = Limits {
        parts: 100,
        ..Limits::default()
    };
    let options = Options {
        limits,
        ..Options::default()
    };
    let parts = || codes(&"KTU  ".repeat(20));
    let storeys = repeat(6, vec![Item::One(storey(vec![row(parts())]))]);
    let rows = repeat(6, vec![row(parts())]);
    let floors = repeat(6, vec![floor("1", parts())]);
    let spans = [number(&storeys), number(&rows), number(&floors)];
    let mut high = house(vec![]);
    high.storeys = vec![storeys];
    let long = house(vec![storey(vec![rows])]);
    let broad = structure(None, vec![facade(vec![floors])]);
    for (house, span) in [high, long, broad].into_iter().zip(spans) {
        let (_, said) = run_in(house, &NoFiles, &options);
        assert_eq!(numbers(&said), [904]);
        assert_eq!(said[0].span().unwrap(), span);
    }
}

#[test]
fn operations_on_many_parts_are_counted() {
    let mut pieces = vec![repeat(100_000, vec![part("KTU")])];
    pieces.extend((0..20_000).map(|_| replace("KTU", "KTU")));
    assert_too_many(one_row(pieces));
}

#[test]
fn long_lists_take_linear_time() {
    let row = |length: usize| {
        let list = vec!["KTU"; length].join(",");
        one_row(vec![repeat(2 * length as u32, vec![random(&list)])])
    };
    assert_linear("a long list", 25_000, row, |row| clean(row.clone()));
}
