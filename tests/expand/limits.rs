//! Careless numbers cost no time and no memory.

use crate::expand::build::*;
use hsd::ast::{Item, Piece};
use hsd::expand::Options;
use hsd::source::{Limits, NoFiles};
use std::time::Instant;

fn assert_too_many(house: hsd::ast::House) {
    let start = Instant::now();
    let (program, said) = run(house);
    assert_eq!(numbers(&said), [904]);
    assert!(program.houses.is_empty());
    assert!(start.elapsed().as_secs_f64() < 8.0, "{:?}", start.elapsed());
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

#[test]
fn operations_on_many_parts_end() {
    let mut pieces = vec![repeat(100_000, vec![part("KTU")])];
    pieces.extend((0..20_000).map(|_| replace("KTU", "KTU")));
    assert_too_many(one_row(pieces));
}

#[test]
fn long_lists_are_quick() {
    let start = Instant::now();
    let list = vec!["KTU"; 100_000].join(",");
    let slots = vec![repeat(200_000, vec![random(&list)])];
    clean(one_row(slots));
    assert!(start.elapsed().as_secs_f64() < 8.0, "{:?}", start.elapsed());
}
