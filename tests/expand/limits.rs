//! Careless numbers cost no time and no memory.

use crate::build::*;
use hsd::ast::{Item, Piece};
use hsd::expand::Options;
use hsd::source::{Limits, NoPictures};
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
    let (_, said) = run_in(house(vec![storey(rows(50))]), &NoPictures, &options);
    assert!(said.is_empty(), "{said:?}");
    let (_, said) = run_in(house(vec![storey(rows(51))]), &NoPictures, &options);
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

/// Prints the time of a megabyte of codes; `cargo test --release -- --ignored --nocapture` to measure.
#[test]
#[ignore = "a measurement"]
#[allow(clippy::print_stderr)]
fn a_megabyte_of_codes() {
    let text = "GSI  GSI  GDE 2TOD  KKS  APW  KTU  TSH 2KSK  MMU 2".repeat(200);
    let rows: Vec<_> = (0..100).map(|_| row(codes(&text))).collect();
    let made = house(vec![storey(rows)]);
    let source = hsd::source::Source::new(hsd::source::FileId(0), "a", b"");
    let document = hsd::ast::Document { houses: vec![made] };
    let (mut least, mut copy) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..100 {
        let mut out = hsd::diagnostic::Diagnostics::new();
        let start = Instant::now();
        let program = hsd::expand::expand(
            &[(&source, &document)],
            hsd::catalog::Catalog::builtin(),
            &NoPictures,
            &Options::default(),
            &mut out,
        );
        least = least.min(start.elapsed().as_secs_f64());
        let start = Instant::now();
        let copied = program.clone();
        copy = copy.min(start.elapsed().as_secs_f64());
        assert_eq!(copied.houses[0].storeys[0].loops[0].lines.len(), 100);
    }
    let (made, copied) = (least * 1e3, copy * 1e3);
    eprintln!("{made:.2} ms for 200,000 parts; copying the program takes {copied:.2} ms");
}
