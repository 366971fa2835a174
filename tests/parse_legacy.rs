//! The reader of the legacy text: what a house becomes, and which message each slip makes.

use hsd::ast::{Document, House, Item, Piece, RoofDirection, RoofMethod, RoofMode, RoofShape, Row};
use hsd::diagnostic::{Diagnostic, Diagnostics, Severity};
use hsd::source::{FileId, Limits, Source};
use std::path::Path;

/// The example of domain.md 2.6.
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
    let document = hsd::parse::parse(&source, &Limits::default(), &mut out);
    // Most texts here leave the heights out on purpose; a test of its own looks at that note.
    let told = out.into_sorted().into_iter().filter(|d| d.code.0 != 119);
    (source, document, told.collect())
}

/// All messages on a file, the notes on heights among them.
fn read_all(bytes: &[u8]) -> Vec<Diagnostic> {
    let source = Source::new(FileId(0), "a.hsd", bytes);
    let mut out = Diagnostics::new();
    hsd::parse::parse(&source, &Limits::default(), &mut out);
    out.into_sorted()
}

/// Their codes with what they point at.
fn all_told(text: &str) -> Vec<(u16, &str)> {
    let place = |d: &Diagnostic| &text[d.span.start as usize..d.span.end as usize];
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
    let place = |d: &Diagnostic| &text[d.span.start as usize..d.span.end as usize];
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
fn slips_in_walls_are_mended() {
    let codes = |walls: &str| rows(walls).remove(0).0;
    for (walls, meant) in [
        ("GSI　GSI　GDE 2TOD", "GSI  |GSI  |GDE 2|TOD  "),
        ("GSI\tGSI\tKKS", "GSI  |GSI  |KKS  "),
        ("ＧＳＩ　　ＫＫＳ", "GSI  |KKS  "),
        (" GSI  GSI  GDE 2TOD  KKS", "GSI  |GSI  |GDE 2|TOD  |KKS  "),
        ("       GSI  GSI", "     |GSI  |GSI  "),
        ("GSI GSI  GDE 2TOD  KKS", "GSI  |GSI  |GDE 2|TOD  |KKS  "),
        ("GSI  GSI   GDE 2TOD  KKS", "GSI  |GSI  |GDE 2|TOD  |KKS  "),
        ("GSI GSI       KKS", "GSI  |GSI  |     |KKS  "),
        ("GSI .....KKS", "GSI  |     |KKS  "),
        ("GSI  ... KKS", "GSI  |... K|KS   "),
        ("GSI  ...  KKS", "GSI  |     |KKS  "),
        ("GSI  GSI  # front", "GSI  |GSI  "),
        ("GSI  K#1  ", "GSI  |K#1  "),
        ("KSM  X", "KSM  "),
        ("APW  APW L", "APW  |APW  "),
        ("APW  APW   L", "APW  |APW  "),
        ("APW^", "APW  "),
        ("APW  L^", "APW  "),
        ("APW  Ｌ", "APW  "),
        ("APW  ＾", "APW  "),
    ] {
        assert_eq!(codes(walls), meant, "{walls}");
        let told = told(&with_walls(walls));
        let silent = walls.contains("K#1") || walls.contains("... K");
        assert_eq!(told.is_empty(), silent, "{walls}: {told:?}");
    }
    assert_eq!(rows("APW  APW L")[0].1, Some(-90.0));
    assert_eq!(rows("APW  Ｌ")[0].1, Some(-90.0));
    assert_eq!(rows("APW  l")[0].1, Some(-90.0));
}

#[test]
fn one_slip_makes_one_message() {
    for (walls, code, place) in [
        ("GSI　GSI", 120, "　"),
        ("GSI\tGSI", 121, "\t"),
        ("APW  Ｌ", 122, "Ｌ"),
        ("KSM町 KSM", 124, "町"),
        (" GSI  GSI  GDE 2TOD", 131, " "),
        ("GSI GSI  GDE 2TOD  KKS", 132, "GSI  GDE 2TOD  KKS"),
        ("GKO  ANO ANO  ANO  AKI  TTB", 132, "ANO  ANO  AKI  TTB"),
        ("GKO, ANO, TTB", 132, "GKO, ANO, TTB"),
        ("GKO,ANO,TTB", 132, "ANO,TTB"),
        ("KSM       ", 133, "     "),
        ("KSM  X", 126, "X"),
        ("APW  APW L", 127, "L"),
        ("APW  l", 128, "l"),
        ("APW   ^\nAPW", 127, "^"),
        ("APW  L APW", 138, "L"),
        ("APW\nL APW", 138, "L"),
        ("APW  L  ", 129, "  "),
        ("KSM\nAPW  ^KSM", 130, "KSM"),
        ("KSM  # x", 113, "# x"),
        ("KSM  # 壁", 113, "# 壁"),
        ("  # x\nKSM", 113, "# x"),
        ("KSM  ^", 135, "^"),
        ("KSM\n\nKSM", 125, "\n"),
    ] {
        assert_eq!(pointed(&with_walls(walls)), [(code, place)], "{walls:?}");
    }
}

#[test]
fn roofs_are_mended_field_by_field() {
    for (roof, expected) in [
        ("K X * KIR 0 0 2 2", vec![]),
        ("* * * * 0 0 2 2.5", vec![]),
        ("K\tX\u{3000}* KIR 0 0 2 2 O", vec![]),
        ("Q X * KIR 0 0 2 2", vec![(140, "Q")]),
        ("K X * KRI 0 0 2 2 P4,0", vec![(142, "KRI"), (103, "P4,0")]),
        ("KX 14.0 KIR 0 0 6 8", vec![(148, "KX")]),
        ("K 14.0 KIR 0 0 6 8", vec![(145, "")]),
        ("K X KIR 0 0 6 8", vec![(145, "")]),
        ("K X 14 0 0 6 8", vec![(145, "")]),
        ("K X * HSI 0 0 6 8", vec![(142, "HSI")]),
        ("K F * 庇 0 0 6 8", vec![(142, "庇")]),
        ("瓦 X * KIR 0 0 6 8", vec![(140, "瓦")]),
        ("K X * KIR 0 0 6", vec![(146, "")]),
        ("K X * KIR 0 0 6 P4 E2", vec![(146, "")]),
        ("K X * KIR 3 0 3 8", vec![(147, "3")]),
        ("K L * KIR 0 0 6 8", vec![(144, "L")]),
        ("K X * KAT 0 0 6 8", vec![(144, "X")]),
        ("K X * KIR 0 0 6 8 9", vec![(107, "9")]),
        ("K X * KIR 0 0 6 8 P40", vec![(104, "P40")]),
        ("K X * KIR 0 0 6 8 P4 P5", vec![(108, "P5")]),
        ("K X * KIR 0 0 6 8 P 4.0", vec![(150, "P")]),
        ("K X * KIR 0 0 6 8 M2.5", vec![(151, "M2.5")]),
        ("k x * KIR 0 0 6 8 p4", vec![(149, "k x * KIR 0 0 6 8 p4")]),
        ("K X * KIR 0 0 6 8 # main", vec![(113, "# main")]),
        ("K X Ｋ KIR 0 0 6 8", vec![(103, "Ｋ"), (122, "Ｋ")]),
    ] {
        let text = with_roof(roof);
        assert_eq!(pointed(&text), expected, "{roof}");
        let lines = house(&text).roofs.lines;
        let lost = expected
            .iter()
            .any(|(code, _)| matches!(code, 142 | 146 | 147));
        assert_eq!(lines.len(), usize::from(!lost), "{roof}");
    }
}

#[test]
fn headers_are_mended_word_by_word() {
    let with = |header: &str| format!("{header}\n\nKSM\n");
    for (header, expected) in [
        ("0", vec![102]),
        ("0, 0", vec![103]),
        ("０ 0", vec![122]),
        ("0 1e999", vec![103]),
        ("0 0 180 5", vec![107]),
        ("0 0\n9 0", vec![104, 112]),
        ("0 0\n9\n9", vec![111]),
        ("0 0\nUnit 3.25", vec![105]),
        ("0 0\nunit: 3.25", vec![105]),
        ("0 0\nunit=3.25", vec![105]),
        ("0 0\nunit 0", vec![104]),
        ("0 0\nunit", vec![117]),
        ("0 0\nname", vec![117]),
        ("0 0\nseed 1.5", vec![118]),
        ("0 0\nseed x", vec![103]),
        ("0 0\nroofs autos", vec![106]),
        ("町家\n0 0", vec![105]),
    ] {
        let found: Vec<u16> = told(&with(header));
        assert_eq!(found, expected, "{header}");
    }
    let unit = house(&with("0 0\nunit=3.25")).settings.unit;
    assert_eq!(unit.map(|u| u.value), Some(3.25));
    let roofs = house(&with("0 0\nroofs Explicit")).roofs;
    assert_eq!(roofs.mode.map(|m| m.value), Some(RoofMode::Explicit));
    let heights = house("0 0\n0 5\n\nKSM\nKSM  ^\nKSM\n").heights;
    assert_eq!(
        heights.iter().map(|h| h.value).collect::<Vec<_>>(),
        [9.0, 5.0]
    );
}

#[test]
fn heights_left_out_or_in_another_unit_are_told() {
    let with = |header: &str| format!("{header}\n\nKSM\nKSM  ^\nKSM\n");
    for (header, expected) in [
        ("9.5 8", vec![(119, "9.5 8")]),
        ("0", vec![(102, "")]),
        ("0 0\n9", vec![]),
        ("0 0\n9 4", vec![]),
        ("0 0\n2.9 3.9", vec![(137, "2.9"), (137, "3.9")]),
        ("0 0\n95 40", vec![(137, "95")]),
    ] {
        assert_eq!(all_told(&with(header)), expected, "{header}");
    }
    assert_eq!(all_told("KSM\n"), [(101, "")]);
}

#[test]
fn what_belongs_to_other_languages_is_told_once() {
    assert_eq!(all_told("# x\n<House>\n<Row/>\n"), [(139, "<House>")]);
    assert_eq!(all_told("0 0\n<House>\n"), [(139, "<House>")]);
    for sign in ["//", ";"] {
        let text = format!("{sign} front\n0 0\n9\n\nKSM\n{sign} 壁\nKSM\n");
        assert_eq!(all_told(&text), [(113, sign), (113, sign)]);
    }
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
    let span = told[1].span;
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
    let document = hsd::parse::parse(&source, &limits, &mut out);
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
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
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
                .all(|d| !d.help.is_empty() && !d.message.ends_with('.'))
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
    #[test]
    fn any_codes_are_cut_in_fives(codes in proptest::collection::vec("[KTMGHAN][A-Z]{2}[ A-K][ 23]", 1..30)) {
        let rows = rows(&codes.concat());
        assert_eq!(rows[0].0, codes.join("|"));
    }
}
