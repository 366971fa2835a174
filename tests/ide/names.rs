//! Definitions, references, renames.

use crate::ide::{Texts, analysis, marked, shown};
use crate::support::{root, texts};
use hsd::diagnostic::Diagnostics;
use hsd::ide::Analysis;
use hsd::ide::names::{
    SymbolKind, definition, highlights, prepare_rename, references, rename, rename_symbol,
    symbol_at, uses_of,
};
use hsd::print::essence;
use hsd::source::{FileId, Source};
use std::collections::BTreeMap;

const FRONTS: &str = r#"<Catalog>
  <let name="half" value="2"/>
  <define name="bay" code="" n="{half}"><repeat num="{n}">{code}</repeat></define>
  <PartDef code="GXX 2" base="GSI" width="2"/>
</Catalog>"#;

const HOUSE: &str = r#"<House name="店">
  <include href="lib/fronts.hsd"/>
  <Param name="間口" default="4"/>
  <let name="奥" value="{間口 + 1}"/>
  <define name="裏" n=""><Param name="code" default="KTU"/><repeat num="{n}">{code}</repeat></define>
  <Storey height="9">
    <Row><use name="bay" code="GXX 2" n="{間口 / 2}"/></Row>
    <Row><repeat num="{奥}">APW</repeat></Row>
    <Row><use name="裏" n="{間口}" code="KSK"/></Row>
    <Row><repeat num="{奥}">APW</repeat></Row>
  </Storey>
</House>
"#;

/// The house with a mark before the `nth` place of a text, and so much further on.
fn house(word: &str, nth: usize) -> (Analysis, usize) {
    let at = HOUSE.match_indices(word).nth(nth).unwrap().0;
    let a = analysis("a.hsd", HOUSE, &[("lib/fronts.hsd", FRONTS)]);
    assert!(a.diagnostics.is_empty(), "{:#?}", a.diagnostics);
    (a, at)
}

#[test]
fn definitions_are_found_wherever_they_stand() {
    let defined = |word: &str, nth: usize| {
        let (a, at) = house(word, nth);
        shown(&a, &definition(&a, at))
    };
    assert_eq!(defined("間口", 1), ["a.hsd:3 間口"]);
    assert_eq!(defined("奥}", 0), ["a.hsd:4 奥"]);
    assert_eq!(defined("裏", 1), ["a.hsd:5 裏"]);
    assert_eq!(defined("code=\"KSK", 0), ["a.hsd:5 code"]);
    assert_eq!(defined("bay", 0), ["lib/fronts.hsd:3 bay"]);
    assert_eq!(defined("n=\"{間口 /", 0), ["lib/fronts.hsd:3 n"]);
    assert_eq!(defined("GXX", 0), ["lib/fronts.hsd:4 GXX 2"]);
    assert_eq!(defined("lib/", 0), ["lib/fronts.hsd:1 "]);
    assert_eq!(defined("APW", 0), [""; 0]);
    assert_eq!(defined("<Row>", 0), [""; 0]);
}

#[test]
fn references_lead_through_the_files() {
    let (a, at) = house("bay", 0);
    assert_eq!(
        shown(&a, &references(&a, at, true)),
        ["a.hsd:7 bay", "lib/fronts.hsd:3 bay"]
    );
    assert_eq!(shown(&a, &references(&a, at, false)), ["a.hsd:7 bay"]);
    let (a, at) = house("間口", 0);
    assert_eq!(references(&a, at, true).len(), 4);
    assert_eq!(highlights(&a, at).iter().filter(|h| h.1).count(), 1);
    let (a, at) = house("APW", 0);
    assert_eq!(references(&a, at, true).len(), 2);
}

#[test]
fn names_obey_their_scopes() {
    let text = r#"<House>
  <let name="w" value="2"/>
  <define name="p" w="3"><repeat num="{w}">APW</repeat></define>
  <if test="{w = 2}"><let name="v" value="1"/></if><else><let name="v" value="2"/></else>
  <Storey height="{w + v}"><let name="w" value="{w + 1}"/><Row>{w}<use name="p" w="{w}"/></Row></Storey>
  <Storey height="{w}"/>
</House>"#;
    let a = analysis("a.hsd", text, &[]);
    let lines = |needle: &str, nth: usize| -> Vec<usize> {
        let at = text.match_indices(needle).nth(nth).unwrap().0;
        let list = references(&a, at, true).into_iter();
        list.map(|p| a.source.line_column(a.source.span(p.range)).0)
            .collect()
    };
    let outer = [2, 4, 5, 5, 6];
    assert_eq!(lines("w\" value=\"2", 0), outer);
    assert_eq!(lines("w + 1", 0), outer);
    assert_eq!(lines("w}\"/>\n</House>", 0), outer);
    assert_eq!(lines("w}\">APW", 0), [3, 3, 5]);
    assert_eq!(lines("w}<use", 0), [5, 5, 5]);
    assert_eq!(lines("v\" value=\"1", 0), [4, 4, 5]);
}

#[test]
fn names_that_are_put_together_lead_to_all_that_fit() {
    let text = r#"<House><Param name="t" default="rice"/>
<define name="front_rice" n=""><repeat num="{n}">GKO</repeat></define>
<define name="front_yarn" n=""><repeat num="{n}">GIT</repeat></define>
<define name="back" n=""/>
<Storey><Row><use name="fr‸ont_{t}" n="4"/></Row></Storey></House>"#;
    let (a, at) = marked(&[("a.hsd", text)]);
    let found = shown(&a, &definition(&a, at));
    assert_eq!(found, ["a.hsd:2 front_rice", "a.hsd:3 front_yarn"]);
    assert_eq!(prepare_rename(&a, at), None);
    let rice = a.text().find("front_rice").unwrap();
    assert!(rename(&a, rice, "front_beans").is_err());
    let n = a.text().find("n=\"\"").unwrap();
    let changed = rename(&a, n, "units").unwrap();
    assert_eq!(changed.len(), 5, "{changed:?}");
}

#[test]
fn own_codes_of_legacy_texts_lie_beside_them() {
    let parts = "<Catalog><PartDef code=\"MMC 2\" base=\"MMU 2\"/></Catalog>";
    let text = "0 0 180\n9\n\nKSK  M‸MC 2KSK\nAPW  APW\nKSK  MMC 2KSK\nAPW  APW\n";
    let (a, at) = marked(&[("x/a.hsd", text), ("x/catalog.hsd", parts)]);
    assert_eq!(
        shown(&a, &references(&a, at, true)),
        [
            "x/a.hsd:4 MMC 2",
            "x/a.hsd:6 MMC 2",
            "x/catalog.hsd:1 MMC 2"
        ]
    );
    assert_eq!(
        prepare_rename(&a, at),
        Some((at - 1..at + 4, "MMC 2".to_owned()))
    );
    assert!(rename(&a, at, "MMU 2").is_err());
    assert!(rename(&a, at, "MMC").is_err(), "another width");
    assert!(rename(&a, at, "mushiko").is_err(), "longer than five");
    let changed = rename(&a, at, "MX  2").unwrap();
    assert_eq!(changed.len(), 3);
    let symbol = symbol_at(&a, at).unwrap();
    assert_eq!(symbol.kind, SymbolKind::Part);
    let (other, _) = marked(&[
        ("x/b.hsd", "0 0 180\n9\n\nMMC 2\n"),
        ("x/catalog.hsd", parts),
    ]);
    assert_eq!(
        shown(&other, &uses_of(&other, &symbol)),
        ["x/b.hsd:4 MMC 2"]
    );
}

#[test]
fn short_codes_are_filled_up_where_others_follow() {
    let text = r#"<House><PartDef code="KXXXX" base="KSK" width="1"/><Storey>
<Row>KXXXXAPW  KXXXX</Row><Row>APW  APW<random code="KXXXX, KSK"/></Row></Storey></House>"#;
    let a = analysis("a.hsd", text, &[]);
    let at = text.find("KXXXX").unwrap();
    let changed = rename(&a, at, "KX").unwrap();
    let news: Vec<&str> = changed.iter().map(|c| &*c.2).collect();
    assert_eq!(news, ["KX", "KX   ", "KX   ", "KX"]);
}

#[test]
fn a_house_knows_its_own_part_first() {
    let text = r#"<Houses><PartDef code="KXX" base="KSK"/>
<House><PartDef code="KXX" base="KXX"/><Storey><Row>KXX  K‸XX  </Row></Storey></House>
<House><Storey><Row>KXX</Row></Storey></House></Houses>"#;
    let (a, at) = marked(&[("a.hsd", text)]);
    assert_eq!(shown(&a, &definition(&a, at)), ["a.hsd:2 KXX"]);
    assert_eq!(references(&a, at, true).len(), 3);
    let outer = a.text().find("KXX").unwrap();
    let found = shown(&a, &references(&a, outer, true));
    assert_eq!(found, ["a.hsd:1 KXX", "a.hsd:2 KXX", "a.hsd:3 KXX"]);
}

#[test]
fn floors_of_one_id_share_a_row() {
    let text = r#"<Structure size="100"><Facades><Facade id="A" ratio="1"><Floor id="1">APW</Floor>
<Floor id="u"/><Floor id="u"><random texturecode="fAfuf1, fAfuf2"/></Floor></Facade>
<Facade id="B"><Floor id="‸u">KSK  KSK</Floor></Facade></Facades></Structure>"#;
    let (a, at) = marked(&[("a.hsd", text)]);
    assert_eq!(shown(&a, &definition(&a, at)), ["a.hsd:3 u"]);
    assert_eq!(references(&a, at, true).len(), 5);
    let picture = a.text().find("Afuf1").unwrap();
    assert_eq!(shown(&a, &definition(&a, picture)), ["a.hsd:1 A"]);
    assert!(rename(&a, at, "v").is_err(), "pictures go by it");
}

#[test]
fn names_that_would_be_captured_are_refused() {
    let text = r#"<House><let name="a" value="1"/><let name="b" value="2"/>
<Storey height="{a + 8}"><let name="c" value="{a}"/><Row><repeat num="{a + c + b}">APW</repeat></Row></Storey></House>"#;
    let a = analysis("a.hsd", text, &[]);
    let at = |word: &str| text.find(word).unwrap() + 6;
    for (word, new) in [
        ("name=\"a", "b"),
        ("name=\"a", "c"),
        ("name=\"c", "a"),
        ("name=\"c", "b"),
        ("name=\"a", "1a"),
        ("name=\"a", ""),
        ("name=\"a", "yes"),
        ("name=\"a", "k"),
        ("name=\"a", "x y"),
    ] {
        assert!(rename(&a, at(word), new).is_err(), "{word} to {new}");
    }
    assert_eq!(rename(&a, at("name=\"a"), "幅").unwrap().len(), 4);
    assert_eq!(rename(&a, at("name=\"a"), "a"), Ok(vec![]));
    assert!(rename(&a, text.find("APW").unwrap(), "APX").is_err());
}

#[test]
fn other_texts_follow_a_definition_that_is_renamed() {
    let (a, at) = house("bay", 0);
    let symbol = symbol_at(&a, at).unwrap();
    assert_eq!(symbol.kind, SymbolKind::Piece);
    let other = "<House><include href=\"fronts.hsd\"/><Storey><Row><use name=\"bay\" code=\"APW\"/></Row></Storey></House>";
    let b = analysis("lib/b.hsd", other, &[("lib/fronts.hsd", FRONTS)]);
    assert_eq!(shown(&b, &uses_of(&b, &symbol)), ["lib/b.hsd:1 bay"]);
    assert_eq!(rename_symbol(&b, &symbol, "間").unwrap().len(), 2);
    let far = analysis("c.hsd", "<House/>", &[]);
    assert_eq!(uses_of(&far, &symbol), []);
}

/// A text with some edits done.
fn edited(text: &str, file: FileId, edits: &[hsd::ide::names::Change]) -> String {
    let mut own: Vec<_> = edits.iter().filter(|e| e.0 == file).collect();
    own.sort_by_key(|e| e.1.start);
    let mut made = text.to_owned();
    for (_, range, new) in own.into_iter().rev() {
        made.replace_range(range.clone(), new);
    }
    made
}

/// The building of a text, without places, and the codes of what is said of it.
fn built(name: &str, files: &BTreeMap<String, String>) -> (String, Vec<String>) {
    let world = Texts(files.clone());
    let source = Source::new(FileId(0), name, files[name].as_bytes());
    let mut out = Diagnostics::new();
    let made = hsd::driver::check(&[&source], &world, &hsd::Options::default(), &mut out);
    let codes = out
        .into_sorted()
        .iter()
        .map(|d| d.code.to_string())
        .collect();
    (format!("{:?}", essence(&made.building)), codes)
}

#[test]
fn renamed_texts_build_the_same_houses() {
    let (mut names, mut texts_with) = (0, 0);
    for folder in ["examples", "library"] {
        let mut files = BTreeMap::new();
        let mut paths = texts(folder);
        paths.push(root().join("examples/tea-shop/parts.hsd"));
        for path in &paths {
            let name = path.strip_prefix(root().join(folder));
            if let Ok(name) = name {
                let text = std::fs::read_to_string(path).unwrap();
                files.insert(name.to_string_lossy().into_owned(), text);
            }
        }
        for name in files.keys().filter(|n| !n.contains('/')) {
            let world = Texts(files.clone());
            let source = Source::new(FileId(0), name, files[name].as_bytes());
            let a = Analysis::new(source, &world, &hsd::Options::default());
            let before = built(name, &files);
            let mut seen = vec![];
            for at in 0..a.text().len() {
                let Some((range, old)) = prepare_rename(&a, at) else {
                    continue;
                };
                let symbol = symbol_at(&a, at).unwrap();
                if seen.contains(&symbol) {
                    continue;
                }
                let new = match symbol.kind {
                    SymbolKind::Part if range.len() == 5 => format!("{}ZZ{}", &old[..2], &old[4..]),
                    _ => format!("{old}_名"),
                };
                seen.push(symbol);
                let Ok(edits) = rename(&a, at, &new) else {
                    continue;
                };
                assert!(!edits.is_empty());
                let mut after = files.clone();
                for (file, text) in &mut after {
                    let all = std::iter::once(&a.source).chain(&a.checked.included);
                    if let Some(source) = all.into_iter().find(|s| s.name() == file) {
                        *text = edited(text, source.id(), &edits);
                    }
                }
                assert!(built(name, &after) == before, "{name}: {old} to {new}");
                names += 1;
            }
            texts_with += usize::from(!seen.is_empty());
        }
    }
    assert!(names > 100, "{names} names in {texts_with} texts");
}
