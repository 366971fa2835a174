//! Symbols, folds, selections and layouts.

use crate::ide::{analysis, marked};
use crate::support;
use hsd::diagnostic::Diagnostics;
use hsd::ide::folding::{FoldKind, folds};
use hsd::ide::format::{format, format_range};
use hsd::ide::selection::selection;
use hsd::ide::symbols::{Symbol, SymbolKind, symbols};
use hsd::source::Limits;

const TWO: &str = "# 表\n# 裏\n0 0 180\n9 8\nname 町家\n\nGSI  GSI\nAPW  APW\nKSK  KSK\nAPW  APW  ^\n\
                   KSK  KSK\nAPW  APW\nKSK  KSK\nAPW  APW\n\nK X * KIR 0 0 2 2\n%\n9 9 0\n9\n\nKSK\nKSK\nKSK\nKSK\n";

fn tree(list: &[Symbol], depth: usize, lines: &mut Vec<String>) {
    for symbol in list {
        let Symbol { name, detail, .. } = symbol;
        lines.push(format!("{}{name} | {detail}", "  ".repeat(depth)));
        assert!(symbol.range.start <= symbol.selection.start);
        assert!(symbol.selection.end <= symbol.range.end, "{symbol:?}");
        tree(&symbol.children, depth + 1, lines);
    }
}

fn told(text: &str) -> Vec<String> {
    let mut lines = vec![];
    tree(&symbols(&analysis("a.hsd", text, &[])), 0, &mut lines);
    lines
}

#[test]
fn legacy_symbols() {
    let found = told(TWO);
    assert_eq!(found[0], "町家 | ");
    assert_eq!(found[1], "  Storey 1 | 9 shaku, 8 U");
    assert_eq!(found[2], "    GSI GSI | 2 U");
    assert_eq!(found[6], "  Storey 2 | 8 shaku, 8 U");
    assert_eq!(found[11], "  Roofs | ");
    assert_eq!(found[12], "    KIR K | X *");
    assert_eq!(found[13], "House 2 | ");
    assert_eq!(found.len(), 19);
}

#[test]
fn xml_symbols() {
    let text = r#"<Houses><House name="店"><Param name="n" default="2"/><let name="m" value="{n}"/>
<define name="側" w="1"><Row><repeat num="{w}">APW</repeat></Row></define>
<repeat num="2"><Storey height="9"><Row>KSK  KSK</Row><use name="側" w="2"/><Row>KSK  KSK</Row><use name="側" w="2"/></Storey></repeat>
<Roofs kind="K"><Roof kind="K" shape="KIR" a0="0" b0="0" a1="2" b1="2"/></Roofs></House></Houses>"#;
    let expected = [
        "店 | ",
        "  n | 2",
        "  m | {n}",
        "  側 | w",
        "    APW | 2 U",
        "  Storey 1–2 | 9 shaku, 8 U",
        "    KSK KSK | 2 U",
        "    KSK KSK | 2 U",
        "  Roofs | K",
        "    Roof | KIR K",
    ];
    assert_eq!(told(text), expected);
    let a = analysis("a.hsd", text, &[]);
    let house = &symbols(&a)[0];
    assert_eq!(house.kind, SymbolKind::House);
    assert_eq!(house.children[2].kind, SymbolKind::Piece);
}

/// The first and the last line of each fold.
fn folded(text: &str) -> Vec<(usize, usize, FoldKind)> {
    let a = analysis("a.hsd", text, &[]);
    let line = |at: usize| 1 + text[..at].matches('\n').count();
    let found = folds(&a).into_iter();
    found
        .map(|f| (line(f.range.start), line(f.range.end), f.kind))
        .collect()
}

#[test]
fn folds_of_both_forms() {
    use FoldKind::{Comment, Imports, Region};
    assert_eq!(
        folded(TWO),
        [
            (1, 2, Comment),
            (3, 16, Region),
            (7, 10, Region),
            (11, 14, Region),
            (18, 24, Region),
            (21, 24, Region)
        ]
    );
    let text = "<House>\n<include href=\"a\"/>\n<include href=\"b\"/>\n<!-- a\n b -->\n<Storey>\n  <Row>KSK</Row>\n</Storey>\n</House>\n";
    assert_eq!(
        folded(text),
        [
            (1, 8, Region),
            (2, 3, Imports),
            (4, 5, Comment),
            (6, 7, Region)
        ]
    );
}

/// What is selected step by step, line ends as `/`.
fn steps(text: &str) -> Vec<String> {
    let (a, at) = marked(&[("a.hsd", text)]);
    let found = selection(&a, at);
    assert!(
        found
            .windows(2)
            .all(|w| w[1].start <= w[0].start && w[0].end <= w[1].end)
    );
    found
        .into_iter()
        .map(|r| a.text()[r].replace('\n', "/"))
        .collect()
}

#[test]
fn selections_grow_from_the_word_to_the_house() {
    let text = "0 0 180\n9\n\nKSK  APW  A‸PW  KSK\nKSK  ^\nAPW\n\nK X * KIR 0 0 1 1\n";
    let found = steps(text);
    assert_eq!(
        found[..5],
        [
            "APW",
            "APW  ",
            "APW  APW  ",
            "KSK  APW  APW  KSK",
            "KSK  APW  APW  KSK/KSK  ^"
        ]
    );
    assert!(found[5].starts_with("0 0 180/"), "{found:#?}");
    let text = "<House><Storey><Row><repeat num=\"{幅 + ‸奥}\">APW</repeat></Row></Storey></House>";
    assert_eq!(
        steps(text)[..6],
        [
            "奥",
            "幅 + 奥",
            "{幅 + 奥}",
            "num=\"{幅 + 奥}\"",
            "<repeat num=\"{幅 + 奥}\">",
            "<repeat num=\"{幅 + 奥}\">APW</repeat>"
        ]
    );
    let found = steps("<House><Storey><Row>KSK  K‸SK  TOD  </Row></Storey></House>");
    assert_eq!(found[..4], ["KSK", "KSK  ", "KSK  KSK  ", "KSK  KSK  TOD"]);
    assert_eq!(
        found[4..6],
        ["KSK  KSK  TOD  ", "<Row>KSK  KSK  TOD  </Row>"]
    );
}

#[test]
fn layouts_are_edits_that_make_what_fmt_makes() {
    let mut texts: Vec<String> = ["examples", "library"]
        .iter()
        .flat_map(|folder| support::texts(folder))
        .map(|path| std::fs::read_to_string(path).unwrap())
        .collect();
    texts.push("0 0 180\r\n9\r\n\r\n\r\nKSK  KSK  \r\nKSK\r\nKSK  KSK\r\nKSK\r\n".to_owned());
    texts.push("<House>\n<Storey><Row>家KSK</Row>\n\n\n\n</Storey></House>".to_owned());
    texts.push(
        "<House name='家' ><Storey height=\"9\" ><Row>KSK  </Row></Storey ></House>".to_owned(),
    );
    for text in texts {
        for text in [
            text.clone(),
            text.replace("  <", " <"),
            text.replace('\n', "\n\n"),
        ] {
            let a = analysis("a.hsd", &text, &[]);
            let made = hsd::print::format(&a.source, &Limits::default(), &mut Diagnostics::new());
            let edits = format(&a);
            assert_eq!(edits.is_some(), made.is_some());
            let (Some(edits), Some(made)) = (edits, made) else {
                continue;
            };
            let mut edited = text.clone();
            for edit in edits.iter().rev() {
                edited.replace_range(edit.range.clone(), &edit.text);
            }
            assert!(edited == made, "{text}");
            assert!(edits.windows(2).all(|w| w[0].range.end <= w[1].range.start));
        }
    }
}

#[test]
fn a_layout_changes_what_it_must_and_no_more() {
    let text = "0 0 180\n9\n\nKSK  KSK  \nKSK\nKSK  KSK\nKSK  \n";
    let a = analysis("a.hsd", text, &[]);
    let edits = format(&a).unwrap();
    assert_eq!(edits.len(), 2);
    assert!(
        edits
            .iter()
            .all(|e| e.text.is_empty() && e.range.len() == 2)
    );
    assert_eq!(format_range(&a, 14..14).unwrap().len(), 1);
    assert_eq!(
        format(&analysis("a.hsd", "0 0 180\n9\n\nKSK  X\n?\n", &[])),
        None
    );
}
