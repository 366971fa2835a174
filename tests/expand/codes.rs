//! What codes mean.

use crate::expand::build::*;
use crate::support::Words;
use hsd::ast::{CodeText, Document, Item, Part, Piece, Random};
use hsd::diagnostic::Diagnostics;
use hsd::expand::{Options, expand};
use hsd::source::{FileId, Source, Spanned};

#[test]
fn short_codes_are_padded_in_silence() {
    let program = clean(one_row(vec![part("GSI"), part("GDE 2"), part(".....")]));
    assert_eq!(names(&program, 0, 0), "GSI  |GDE 2|.....");
    assert_eq!(width(&line(&program, 0, 0).units), 4.0);
}

#[test]
fn an_underscore_is_a_blank_unless_the_name_is_literal() {
    let program = clean(one_row(vec![part("GDE_2")]));
    assert_eq!(names(&program, 0, 0), "GDE 2");
    let world = Pictures(vec![("GDE_2", (10, 10)), ("wall_old", (10, 10))]);
    let pieces = vec![part("GDE_2"), part("wall_old")];
    let (program, said) = run_in(one_row(pieces), &world, &Options::default());
    assert!(said.is_empty(), "{said:?}");
    assert_eq!(names(&program, 0, 0), "GDE_2|wall_old");
}

#[test]
fn unknown_codes_keep_the_outline() {
    let (program, said) = run(one_row(vec![part("GXX 2"), part("QQQ"), part("TXY")]));
    assert_eq!(numbers(&said), [301, 301, 301]);
    assert_eq!(names(&program, 0, 0), "GSI  |KSK  |TIT  ");
    let widths: Vec<_> = line(&program, 0, 0).units.iter().map(|u| u.width).collect();
    assert_eq!(widths, [2.0, 1.0, 1.0]);
    assert!(
        said[0].help.en().contains("did you mean `G"),
        "{}",
        said[0].help.en()
    );
}

#[test]
fn lost_blanks_and_small_letters_are_named() {
    let (program, said) = run(one_row(vec![part("KSML"), part("gsi"), part("gkk h")]));
    assert_eq!(numbers(&said), [302, 303, 303]);
    assert!(said[0].help.en().contains("`KSM  L`"));
    assert_eq!(names(&program, 0, 0), "KSM  |GSI  |GKK h");
}

#[test]
fn an_error_in_a_repetition_is_said_once() {
    let (_, said) = run(one_row(vec![repeat(100, vec![part("QQQ")])]));
    assert_eq!(numbers(&said), [301]);
}

/// The spans of all messages about a list that stands in a source, as text.
fn said_of_list(text: &str, list: &str) -> Vec<(u16, String)> {
    let source = Source::new(FileId(0), "a.hsd", text.as_bytes());
    let start = text.find('"').unwrap() + 1;
    let end = text.rfind('"').unwrap();
    let span = source.span(start..end);
    let item: Item<Piece> = Item::Random(Box::new(Random {
        span: source.span(0..text.len()),
        codes: Spanned::new(list.into(), span),
        weights: None,
    }));
    let document = Document {
        houses: vec![one_row(vec![item])],
        ..Document::default()
    };
    let mut out = Diagnostics::new();
    expand(
        &[(&source, &document)],
        hsd::parse::builtin(),
        &hsd::source::NoFiles,
        &Options::default(),
        &mut out,
    );
    let text =
        |d: &hsd::diagnostic::Diagnostic| text[source.text_range(d.span().unwrap())].to_owned();
    out.into_sorted()
        .iter()
        .map(|d| (d.code.0, text(d)))
        .collect()
}

#[test]
fn spans_in_lists_are_exact() {
    let said = said_of_list(r#"<random code="KTU, QQQ, KSK"/>"#, "KTU, QQQ, KSK");
    assert_eq!(said, [(301, "QQQ".into())]);
    let said = said_of_list(r#"<random code="KTU,, KSK"/>"#, "KTU,, KSK");
    assert_eq!(said, [(304, "".into())]);
    let said = said_of_list(r#"<random code="KTU KJV KSK"/>"#, "KTU KJV KSK");
    assert_eq!(said, [(301, "KJV".into())]);
    let said = said_of_list(r#"<random code="KTU,&#81;QQ"/>"#, "KTU,QQQ");
    assert_eq!(said, [(301, "KTU,&#81;QQ".into())]);
    let said = said_of_list(r#"<random code="TSH 2 TKD 2"/>"#, "TSH 2 TKD 2");
    assert_eq!(said, [(314, "TSH 2".into()), (314, "TKD 2".into())]);
    assert_eq!(said_of_list(r#"<random code="TSH 2"/>"#, "TSH 2"), []);
    assert_eq!(said_of_list(r#"<random code="     "/>"#, "     "), []);
    let said = said_of_list(r#"<random code=""/>"#, "");
    assert_eq!(said, [(304, "".into())]);
}

#[test]
fn widths_and_heights_of_single_parts() {
    let made = |width, height| {
        Item::One(Piece::Part(Box::new(Part {
            code: put(CodeText::new("KTU")),
            width: Some(put(width)),
            height: Some(put(height)),
        })))
    };
    let program = clean(one_row(vec![made(1.5, 6.0), made(0.0, 1.0)]));
    let units = &line(&program, 0, 0).units;
    assert_eq!((units[0].width, units[0].height), (1.5, Some(6.0)));
    assert_eq!(units[1].width, 0.0);
    // The readers report lengths below zero; here they only must do no harm.
    let program = clean(one_row(vec![made(-1.0, 0.0)]));
    let unit = &line(&program, 0, 0).units[0];
    assert_eq!((unit.width, unit.height), (1.0, None));
}
