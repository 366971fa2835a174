//! The reader of the legacy text: what a house becomes, and which message each slip makes.

use hsd_base::diagnostic::{Diagnostic, Diagnostics, Severity};
use hsd_base::source::{FileId, Limits, Source};
use hsd_ir::ast::{
    Document, House, Item, Piece, RoofDirection, RoofMethod, RoofMode, RoofShape, Row,
};
use hsd_testing::Words;
use std::path::Path;

mod fixes;
mod line;

/// The example of docs/evidence.md 2.6.
const TOWN_HOUSE: &str = "\
0 0 180
9.0 5.0

GSI  GSI  GDE 2TOD  KKS
APW  APW  APW  APW  APW  APW  APW  APW
KTU  TSH 2TSH 2KTU
APW  APW  APW  APW  APW  APW  APW  APW  ^
KSK  MMU 2MMU 2KSK
APW  APW  APW  APW  APW  APW  APW  APW
KTU  MMU 2MMU 2KTU
APW  APW  APW  APW  APW  APW  APW  APW

K X  14.0 KIR   0   0   6   8  P4.0 E2.5 G0.5 M3
K F   8.1 HIS   0   0   6  -1  P3.0
";

fn read_bytes(bytes: &[u8]) -> (Source, Document, Vec<Diagnostic>) {
    let source = Source::new(FileId(0), "a.hsd", bytes);
    let mut out = Diagnostics::new();
    let document = hsd_syntax::parse::parse(&source, &Limits::default(), &mut out);
    // Most texts here leave the heights out on purpose; a test of its own looks at that note.
    let told = out.into_sorted().into_iter().filter(|d| d.code.0 != 119);
    (source, document, told.collect())
}

/// All messages on a file, the notes on heights among them.
fn read_all(bytes: &[u8]) -> Vec<Diagnostic> {
    let source = Source::new(FileId(0), "a.hsd", bytes);
    let mut out = Diagnostics::new();
    hsd_syntax::parse::parse(&source, &Limits::default(), &mut out);
    out.into_sorted()
}

/// Their codes with what they point at.
fn all_told(text: &str) -> Vec<(u16, &str)> {
    let place =
        |d: &Diagnostic| &text[d.span().unwrap().start as usize..d.span().unwrap().end as usize];
    let told = read_all(text.as_bytes());
    told.iter().map(|d| (d.code.0, place(d))).collect()
}

fn read(text: &str) -> (Document, Vec<Diagnostic>) {
    let (_, document, told) = read_bytes(text.as_bytes());
    (document, told)
}

/// The codes of the messages on a text.
fn told(text: &str) -> Vec<u16> {
    read(text).1.iter().map(|d| d.code.0).collect()
}

/// What the messages on a text point at.
fn pointed(text: &str) -> Vec<(u16, &str)> {
    let (_, told) = read(text);
    let place =
        |d: &Diagnostic| &text[d.span().unwrap().start as usize..d.span().unwrap().end as usize];
    told.iter().map(|d| (d.code.0, place(d))).collect()
}

/// A house of one storey with these walls.
fn with_walls(walls: &str) -> String {
    format!("0 0 180\n9.0\n\n{walls}\n")
}

fn with_roof(roof: &str) -> String {
    with_walls(&format!("KSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n\n{roof}"))
}

fn house(text: &str) -> House {
    read(text).0.houses.remove(0)
}

/// Rows of each storey as codes and turns.
fn storeys(house: &House) -> Vec<Vec<(String, Option<f64>)>> {
    let mut all = vec![];
    for storey in &house.storeys {
        let Item::One(storey) = storey else {
            panic!("{storey:?}")
        };
        assert_eq!(storey.loops.len(), 1);
        all.push(storey.loops[0].rows.iter().map(row).collect());
    }
    all
}

fn row(row: &Item<Row>) -> (String, Option<f64>) {
    let Item::One(row) = row else {
        panic!("{row:?}")
    };
    let code = |piece: &Item<Piece>| match piece {
        Item::One(piece) => piece.code().expect("a code").value.as_str().to_owned(),
        other => panic!("{other:?}"),
    };
    let codes: Vec<String> = row.pieces.iter().map(code).collect();
    (codes.join("|"), row.turn.map(|t| t.value))
}

/// The rows of the first storey of a house with these walls.
fn rows(walls: &str) -> Vec<(String, Option<f64>)> {
    storeys(&house(&with_walls(walls))).remove(0)
}

#[test]
fn the_town_house_is_read_as_written() {
    let (document, told) = read(TOWN_HOUSE);
    assert_eq!(told, []);
    let house = &document.houses[0];
    assert_eq!(
        house.heights.iter().map(|h| h.value).collect::<Vec<_>>(),
        [9.0, 5.0]
    );
    assert_eq!(house.settings.azimuth.map(|a| a.value), Some(180.0));
    let storeys = storeys(house);
    assert_eq!(storeys.len(), 2);
    assert_eq!(
        storeys[0][0],
        ("GSI  |GSI  |GDE 2|TOD  |KKS  ".to_owned(), None)
    );
    assert_eq!(storeys[0][3].0.matches("APW").count(), 8);
    assert_eq!(storeys[0][3].1, None);
    let [main, pent] = &house.roofs.lines[..] else {
        panic!("two roofs")
    };
    assert_eq!(main.corners.value, [0.0, 0.0, 6.0, 8.0]);
    assert_eq!(
        main.direction.map(|d| d.value),
        Some(RoofDirection::AlongFront)
    );
    assert_eq!(main.style.noshi.map(|m| m.value), Some(3));
    assert_eq!(main.style.eaves.map(|m| m.value), Some(2.5));
    assert_eq!(pent.height.map(|h| h.value), Some(8.1));
    assert_eq!(pent.style.shape.map(|s| s.value), Some(RoofShape::Pent));
    assert_eq!(pent.corners.value[3], -1.0);
    assert_eq!(
        &TOWN_HOUSE[house.span.start as usize..house.span.end as usize],
        TOWN_HOUSE.trim()
    );
}

#[test]
fn header_lines_come_in_any_order() {
    let text = "name 町家 no. 3\nunit 3.25\n-12.5 3\nseed 7\nroofs explicit\nmethod kd\nstreet yes\n\nKSM\n";
    let (document, told) = read(text);
    assert_eq!(told, []);
    let house = &document.houses[0];
    assert_eq!(
        house.name.as_ref().map(|n| n.value.as_str()),
        Some("町家 no. 3")
    );
    assert_eq!(house.settings.x.map(|x| x.value), Some(-12.5));
    assert_eq!(house.settings.azimuth, None);
    assert_eq!(house.settings.unit.map(|u| u.value), Some(3.25));
    assert_eq!(house.settings.seed.map(|s| s.value), Some(7));
    assert_eq!(house.settings.street.map(|s| s.value), Some(true));
    assert_eq!(house.roofs.mode.map(|m| m.value), Some(RoofMode::Explicit));
    assert_eq!(house.roofs.method.map(|m| m.value), Some(RoofMethod::Kd));
}

#[test]
fn remainders_follow_the_rules() {
    let turn = |codes: &str, turn| vec![(codes.to_owned(), turn)];
    assert_eq!(rows("APW  KSM"), turn("APW  |KSM  ", None));
    assert_eq!(rows("APW  KSM  L"), turn("APW  |KSM  ", Some(-90.0)));
    assert_eq!(rows("APW  KSM  R"), turn("APW  |KSM  ", Some(90.0)));
    assert_eq!(rows("APW  KSM  ^"), turn("APW  |KSM  ", None));
    assert_eq!(
        rows("L\nKSM"),
        [("".to_owned(), Some(-90.0)), ("KSM  ".to_owned(), None)]
    );
    assert_eq!(rows("KSM  .....KSM"), turn("KSM  |     |KSM  ", None));
    assert_eq!(rows("     KSM  L"), turn("     |KSM  ", Some(-90.0)));
    assert_eq!(
        rows("GAA 2AAA  HOG 2     AAA 2").len(),
        1,
        "no roof, though HOG is a shape"
    );
    assert_eq!(rows("KSM     "), turn("KSM  ", None));
    assert!(
        told(&with_walls("KSM     ")).is_empty(),
        "a remainder of blanks only is dropped"
    );
    assert_eq!(
        rows("KSM  ABCDL"),
        turn("KSM  |ABCDL", None),
        "remainder 0 is codes only"
    );
}

#[test]
fn a_storey_end_on_its_own_line_is_no_wall() {
    let house = house(&with_walls("KSM\nKSM\n^\nAPW\nAPW"));
    let storeys = storeys(&house);
    assert_eq!(storeys.iter().map(Vec::len).collect::<Vec<_>>(), [2, 2]);
}

#[test]
fn short_codes_cover_what_is_written() {
    let text = with_walls("APW  KSM");
    let house = house(&text);
    let Item::One(storey) = &house.storeys[0] else {
        panic!()
    };
    let Item::One(row) = &storey.loops[0].rows[0] else {
        panic!()
    };
    let spans: Vec<&str> = row
        .pieces
        .iter()
        .map(|p| match p {
            Item::One(piece) => {
                let span = piece.code().expect("a code").span;
                &text[span.start as usize..span.end as usize]
            }
            _ => panic!(),
        })
        .collect();
    assert_eq!(spans, ["APW  ", "KSM"]);
    assert_eq!(
        &text[row.span.start as usize..row.span.end as usize],
        "APW  KSM"
    );
}

#[test]
fn a_text_without_header_is_read_all_the_same() {
    assert_eq!(told("KSM  KSM\nKSM  X\n"), [101, 126]);
    assert_eq!(told("unit 3.25\n\nKSM\n"), [101]);
    assert_eq!(told("0 0\nKSM\nK X * KIR 0 0 1 1\n"), [110, 110]);
    assert_eq!(told("K X * KIR 0 0 1 1\n"), [101, 116]);
}

#[test]
fn houses_are_parted_by_a_line() {
    let one = "0 0\n\nKSM\n";
    let (document, told) = read(&format!("%\n{one}%\n\n# nothing\n%\n{one}%\n"));
    assert_eq!(told, []);
    assert_eq!(document.houses.len(), 2);
    let (document, told) = read(&format!("{one}\n{one}\n"));
    assert_eq!(document.houses.len(), 2);
    assert_eq!(told.iter().map(|d| d.code.0).collect::<Vec<_>>(), [115]);
}

#[test]
fn line_ends_and_marks_are_all_the_same() {
    let dump = |text: &[u8]| {
        let (_, document, told) = read_bytes(text);
        assert_eq!(told, []);
        storeys(&document.houses[0])
    };
    let plain = dump(TOWN_HOUSE.as_bytes());
    assert_eq!(dump(TOWN_HOUSE.trim_end().as_bytes()), plain);
    assert_eq!(dump(TOWN_HOUSE.replace('\n', "\r\n").as_bytes()), plain);
    assert_eq!(dump(TOWN_HOUSE.replace('\n', "\r\r\n").as_bytes()), plain);
    assert_eq!(
        dump(format!("\u{feff}{TOWN_HOUSE}\u{1a}").as_bytes()),
        plain
    );
    assert_eq!(told(&TOWN_HOUSE.replace('\n', "\r")), [7]);
}

#[test]
fn shift_jis_spans_count_bytes_of_the_file() {
    let text = format!("# 町家\n{}", with_walls("GSI　GSI"));
    let (bytes, ..) = encoding_rs::SHIFT_JIS.encode(&text);
    let (source, _, told) = read_bytes(&bytes);
    assert_eq!(told.iter().map(|d| d.code.0).collect::<Vec<_>>(), [2, 120]);
    let span = told[1].span().unwrap();
    assert_eq!(&bytes[span.start as usize..span.end as usize], b"\x81\x40");
    assert_eq!(source.line_column(span), (5, 4));
}

#[test]
fn large_and_hopeless_files_are_refused_shortly() {
    let source = Source::new(FileId(0), "a.hsd", TOWN_HOUSE.as_bytes());
    let mut out = Diagnostics::new();
    let limits = Limits {
        bytes: 100,
        ..Limits::default()
    };
    let document = hsd_syntax::parse::parse(&source, &limits, &mut out);
    assert!(document.houses.is_empty());
    assert_eq!(out.iter().map(|d| d.code.0).collect::<Vec<_>>(), [901]);
    let told = told(&with_walls(&"KSM  X\n".repeat(10_000)));
    assert_eq!(told.len(), 501);
    assert_eq!(told.last(), Some(&909));
    let warnings = read(&with_walls(&"KSM       \n".repeat(600))).1;
    assert!(warnings.iter().all(|d| d.severity == Severity::Warning));
}

/// The number in the name of a fixture or page, if it is one of this reader.
fn own_code(path: &Path) -> Option<u16> {
    let code = path
        .file_name()?
        .to_str()?
        .strip_prefix("HSD")?
        .get(..4)?
        .parse()
        .ok()?;
    matches!(code, 1..=199 | 901 | 909).then_some(code)
}

fn files(folder: &str) -> Vec<(u16, std::path::PathBuf)> {
    let folder = hsd_testing::root().join(folder);
    let mut found: Vec<_> = std::fs::read_dir(folder)
        .expect("the folder is part of the repository")
        .filter_map(|entry| entry.ok().map(|e| e.path()))
        .filter(|path| path.extension().is_none_or(|e| e != "txt"))
        .filter_map(|path| own_code(&path).map(|code| (code, path)))
        .collect();
    found.sort();
    found
}

#[test]
fn each_fixture_triggers_its_message_and_no_other() {
    let fixtures = files("tests/suite/diagnostics");
    assert!(fixtures.len() > 40);
    for (code, path) in fixtures {
        let told = read_all(&std::fs::read(&path).expect("can be read"));
        let found: Vec<u16> = told.iter().map(|d| d.code.0).collect();
        assert_eq!(found, [code], "{}", path.display());
        assert!(
            told.iter()
                .all(|d| !d.help.is_empty() && !d.message.en().ends_with('.'))
        );
    }
}

#[test]
fn each_page_has_a_title_and_an_example_that_triggers_it() {
    for (code, path) in files("grammar/diagnostics") {
        let page = std::fs::read_to_string(&path).expect("can be read");
        assert!(
            page.starts_with(&format!("# HSD{code:04}: ")),
            "{}",
            path.display()
        );
        let Some((_, rest)) = page.split_once("```hsd\n") else {
            continue;
        };
        let example = rest.split("```").next().expect("the fence is closed");
        let told = read_all(example.as_bytes());
        assert!(told.iter().any(|d| d.code.0 == code), "{}", path.display());
    }
}

proptest::proptest! {
    #![proptest_config(hsd_testing::sampled(256))]

    #[test]
    fn any_codes_are_cut_in_fives(codes in proptest::collection::vec("[KTMGHAN][A-Z]{2}[ A-K][ 23]", 1..30)) {
        let text = codes.concat();
        // A line that begins with a key is a setting, in whatever case it is written.
        proptest::prop_assume!(!["NAME ", "AGE "].iter().any(|key| text.starts_with(key)));
        assert_eq!(rows(&text)[0].0, codes.join("|"));
    }
}
