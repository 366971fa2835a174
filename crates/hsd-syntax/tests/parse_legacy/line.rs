//! Lines of the legacy form: ends, columns, names of parts.

use hsd_base::source::Source;
use hsd_syntax::parse::legacy::line::{SourceLine, lines};

fn split(text: &str) -> Vec<&str> {
    lines(text).map(|(line, _)| &text[line]).collect()
}

#[test]
fn lines_end_in_every_known_way() {
    assert_eq!(split("a\nb\r\nc\rd"), ["a", "b", "c", "d"]);
    assert_eq!(
        split("a\r\r\nb\r\n\r\nc\r\rd\n"),
        ["a", "b", "", "c", "", "d"]
    );
    assert!(split("").is_empty());
}

#[test]
fn a_fixed_line_knows_what_is_written() {
    let source = Source::new(Default::default(), "a.hsd", "GSI　Ｌ\tX".as_bytes());
    let line = SourceLine::new(source.text(), 0);
    assert_eq!(line.text, "GSI  L    X");
    assert_eq!(source.text_range(line.span(&source, 3..5)), 3..6);
    assert_eq!(source.text_range(line.span(&source, 5..6)), 6..9);
    assert_eq!(source.text_range(line.span(&source, 10..11)), 10..11);
    assert_eq!(line.findings.len(), 3);
}

#[test]
fn names_of_parts_are_read_as_their_codes() {
    let text = |raw| SourceLine::new(raw, 0).text.into_owned();
    assert_eq!(text("GSI  大戸   KSM  "), "GSI  TOD  KSM  ");
    assert_eq!(text("大戸 KSM  "), "TOD  KSM  ");
    assert_eq!(text("ガラスカーテンウォールKSM"), "NGC  KSM");
    assert_eq!(text("格子戸引違い    KSM"), "TKD 2KSM");
    assert_eq!(text("大戸前  KSM"), "大戸前  KSM");
    let source = Source::new(Default::default(), "a.hsd", "大戸   KSM".as_bytes());
    let line = SourceLine::new(source.text(), 0);
    assert_eq!(source.text_range(line.span(&source, 5..8)), 9..12);
}

#[test]
fn blanks_among_wide_letters_are_one_column() {
    assert_eq!(SourceLine::new("ＧＳＩ　　ＫＫＳ", 0).text, "GSI  KKS");
}
