//! Texts of other encodings and line ends, strokes that make no sense, and how the time of a stroke grows.

use super::bench::{Board, walls};
use crate::support;
use crate::support::cpu::assert_linear;
use hsd::diagnostic::Language;
use hsd::ide::Analysis;
use hsd::ide::plan::Plan;
use hsd::ide::stroke::{self, Stroke};
use proptest::prelude::*;
use serde_json::{Value, json};

const TEXT: &str = "# 町家 大戸と格子\n0 0 180\n9.0\nname 家\n\nGSI  大戸  GDE 2KSK\n# 側\nAPW  APW  APW\n\
                    KTU  KTU  KTU  KTU  KTU\nAPW　APW　APW\n\n# 屋根\nK X * KIR 0 0 5 3 P4.0\n";

fn in_encoding(text: &str, name: &str) -> Vec<u8> {
    match name {
        "UTF-8" => text.as_bytes().to_vec(),
        "BOM" => ["\u{feff}", text].concat().into_bytes(),
        "UTF-16LE" => {
            let units = ["\u{feff}", text].concat();
            units.encode_utf16().flat_map(u16::to_le_bytes).collect()
        }
        name => {
            let encoding = encoding_rs::Encoding::for_label(name.as_bytes()).unwrap();
            encoding.encode(text).0.into_owned()
        }
    }
}

#[test]
fn bytes_stay_as_they_were() {
    let strokes = [
        json!({"do": "set-part", "house": 0, "storey": 0, "ring": 0, "wall": 0, "unit": 0, "part": "MRE"}),
        json!({"do": "move-wall", "house": 0, "storey": 0, "ring": 0, "wall": 2, "by": 2}),
        json!({"do": "break-wall", "house": 0, "storey": 0, "ring": 0, "wall": 2, "from": 1, "to": 3, "by": 1}),
        json!({"do": "add-storey", "house": 0, "height": 8}),
        json!({"do": "move-wall", "house": 0, "storey": 0, "ring": 0, "wall": 0, "by": 1, "storeys": "all"}),
    ];
    for end in ["\n", "\r\n", "\r"] {
        for name in ["UTF-8", "BOM", "Shift_JIS", "EUC-JP", "UTF-16LE"] {
            let text = TEXT.replace('\n', end);
            let mut board = Board::of_bytes("家.hsd", in_encoding(&text, name));
            for stroke in &strokes {
                board.draw(stroke).unwrap();
            }
            let made = board.text();
            assert_eq!(board.bytes, in_encoding(&made, name), "{name}");
            assert_eq!(
                made.replace("\r\n", "\n")
                    .replace('\r', "\n")
                    .lines()
                    .count(),
                29,
                "{made}"
            );
            for line in [
                "# 町家 大戸と格子",
                "# 側",
                "# 屋根",
                "name 家",
                "K X * KIR 0 -1 5 5 P4.0",
            ] {
                assert!(
                    made.contains(&[line, end].concat()),
                    "{name} {line}: {made}"
                );
            }
            assert!(made.contains("MRE  大戸  GDE 2KSK"), "{made}");
            assert!(made.contains("APW　APW　APW  APW"), "{made}");
        }
    }
}

#[test]
fn ctrl_z_and_missing_line_ends_are_no_hindrance() {
    let mut board = Board::new("0 0 180\n9\n\nKSK  KSK\nKSK\nKSK  KSK\nKSK");
    board
        .draw(&json!({"do": "add-storey", "house": 0, "height": 9}))
        .unwrap();
    assert!(
        board
            .text()
            .ends_with("\nKSK  ^\nKSK  KSK\nKSK\nKSK  KSK\nKSK"),
        "{}",
        board.text()
    );
    board
        .draw(&json!({"do": "remove-storey", "house": 0, "storey": 1}))
        .unwrap();
    assert_eq!(board.text(), "0 0 180\n9\n\nKSK  KSK\nKSK\nKSK  KSK\nKSK");
    let square = json!([[0, 0], [2, 0], [2, 2], [0, 2]]);
    let mut board = Board::new("0 0 180\r\n9\r\n\r\nKSK\r\nKSK\r\nKSK\r\nKSK\u{1a}");
    board
        .draw(&json!({"do": "draw-house", "outline": square}))
        .unwrap();
    assert_eq!(
        board.plan()["houses"].as_array().unwrap().len(),
        2,
        "{}",
        board.text()
    );
}

#[test]
fn walls_merge_in_both_forms() {
    let rows = "KSK  MRE  KSK  KSK\nAPW  APW\nTOD  KTU  L\nAPW  # none\nKTU  MRE\nAPW  APW  APW\n"
        .replace("  # none", "");
    let mut board = Board::new(&format!("0 0 180\n9\n\n{rows}"));
    // The back of the left half comes back to that of the right one.
    let pull = json!({"do": "move-wall", "house": 0, "storey": 0, "ring": 0, "wall": 2, "by": 1});
    board.draw(&pull).unwrap();
    assert!(
        board.text().ends_with(
            "\n\nKSK  MRE  KSK  KSK\nAPW  APW  APW\nTOD  KTU  KTU  MRE\nAPW  APW  APW\n"
        ),
        "{}",
        board.text()
    );
    let xml = "<House>\n <Storey>\n  <Row>KSK  MRE  KSK  KSK</Row>\n  <Row>APW  APW</Row>\n  <Row turn=\"L\">TOD  KTU</Row>\n  \
               <!-- 角 -->\n  <Row>APW</Row>\n  <Row>KTU  MRE</Row>\n  <Row>APW  APW  APW</Row>\n </Storey>\n</House>\n";
    let mut board = Board::new(xml);
    board.draw(&pull).unwrap();
    let made = "<House>\n <Storey>\n  <Row>KSK  MRE  KSK  KSK</Row>\n  <Row>APW  APW  APW</Row>\n  <Row>TOD  KTU  KTU  MRE</Row>\n  \
                <!-- 角 -->\n  <Row>APW  APW  APW</Row>\n </Storey>\n</House>\n";
    assert_eq!(board.text(), made);
}

/// Any stroke at all, in and beyond the places of a plan.
fn strokes() -> impl Strategy<Value = Value> {
    let part = prop::sample::select(vec![
        "KSK",
        "TKD 2",
        "GKK h",
        "",
        "看板",
        "HHA 0",
        "signboard",
        "<&\"'{}",
    ]);
    let at = (0_usize..3, 0_usize..3, 0_usize..2, 0_usize..7);
    let numbers = (-3_i32..4, 0_u32..9, 0_u32..9, 0_usize..9, -1.0_f64..20.0);
    let outline = prop::collection::vec((-2_i32..9, -2_i32..9), 0..7);
    (0..8, at, numbers, part, outline).prop_map(|(kind, at, numbers, part, outline)| {
        let (house, storey, ring, wall) = at;
        let (by, from, to, unit, height) = numbers;
        let storeys = if from > 4 { "all" } else { "one" };
        let outline: Vec<[i32; 2]> = outline.into_iter().map(|(a, b)| [a, b]).collect();
        match kind {
            0 => json!({"do": "set-part", "house": house, "storey": storey, "ring": ring, "wall": wall, "unit": unit, "part": part}),
            1 => json!({"do": "move-wall", "house": house, "storey": storey, "ring": ring, "wall": wall, "by": by, "storeys": storeys}),
            2 => json!({"do": "break-wall", "house": house, "storey": storey, "ring": ring, "wall": wall, "from": from, "to": to, "by": by}),
            3 => json!({"do": "draw-house", "outline": outline, "height": height, "house": house}),
            4 => json!({"do": "add-storey", "house": house, "height": height, "outline": outline}),
            5 => json!({"do": "add-storey", "house": house}),
            6 => json!({"do": "set-height", "house": house, "storey": storey, "height": height}),
            _ => json!({"do": "remove-storey", "house": house, "storey": storey}),
        }
    })
}

/// Texts that are small, and some that are wrong or cut.
fn texts() -> impl Strategy<Value = (String, Vec<u8>)> {
    let names = [
        "machiya",
        "u-house",
        "setback",
        "l-house",
        "court-house",
        "kanban",
        "nagaya",
        "tea-shop",
        "tower",
        "years",
    ];
    let cut = prop_oneof![3 => Just(1.0), 1 => 0.2_f64..1.0];
    (prop::sample::select(names.to_vec()), cut).prop_map(|(name, share)| {
        let bytes = std::fs::read(format!("examples/{name}.hsd")).unwrap();
        let length = (bytes.len() as f64 * share) as usize;
        (name.to_owned(), bytes[..length].to_vec())
    })
}

proptest! {
    #![proptest_config(support::sampled(200))]

    #[test]
    fn any_strokes_are_borne((name, bytes) in texts(), list in prop::collection::vec(strokes(), 1..5)) {
        let mut board = Board::of_bytes(&name, bytes);
        // A text with mistakes may get others: those that were hidden behind them.
        let sound = super::bench::errors(&board.analysis()).is_empty();
        for stroke in list {
            let before = board.bytes.clone();
            let drawn = if sound { board.draw(&stroke).is_ok() } else { board.draw_anyhow(&stroke) };
            prop_assert!(drawn || board.bytes == before);
        }
    }
}

/// A street of machiya in one of both forms.
fn street(lines: usize, xml: bool) -> String {
    let machiya = include_str!("../../../examples/machiya.hsd").trim_end();
    let rows = "<Row>GSI  GSI  GDE 2TOD  KKS</Row>\n<Row><repeat num=\"8\">APW</repeat></Row>\n\
                <Row>KTU  TSH 2TSH 2KTU</Row>\n<Row><repeat num=\"8\">APW</repeat></Row>\n";
    let house = format!(
        "<House>\n<Storey height=\"9\">\n{rows}</Storey>\n<Storey height=\"5\">\n{rows}</Storey>\n</House>\n"
    );
    match xml {
        true => format!("<Houses>\n{}</Houses>\n", house.repeat(lines / 14)),
        false => vec![machiya; lines / 21].join("\n%\n"),
    }
}

#[test]
fn strokes_take_linear_time() {
    for xml in [false, true] {
        let make = |lines| {
            let board = Board::new(&street(lines, xml));
            let analysis = board.analysis();
            analysis.outline();
            (board, analysis)
        };
        let strokes: [fn(usize) -> Value; 6] = [
            |last| json!({"do": "set-part", "house": last, "storey": 0, "ring": 0, "wall": 0, "unit": 0, "part": "MRE"}),
            |last| json!({"do": "move-wall", "house": last / 2, "storey": 0, "ring": 0, "wall": 2, "by": 1, "storeys": "all"}),
            |last| json!({"do": "break-wall", "house": last / 2, "storey": 1, "ring": 0, "wall": 2, "from": 1, "to": 3, "by": 1}),
            |last| json!({"do": "add-storey", "house": last}),
            |_| json!({"do": "set-height", "house": 0, "storey": 0, "height": 10}),
            |_| json!({"do": "draw-house", "house": 0, "outline": [[0, 0], [6, 0], [6, 8], [0, 8]]}),
        ];
        for stroke in strokes {
            let draw = |(board, a): &(Board, Analysis)| {
                let last = a.checked.building.houses.len() - 1;
                let stroke: Stroke = serde_json::from_value(stroke(last)).unwrap();
                let edits = stroke::edits(a, &stroke).unwrap();
                stroke::apply(&a.source, &board.bytes, &edits)
            };
            assert_linear(
                &format!("xml {xml}: {}", stroke(0)["do"]),
                1_000,
                make,
                draw,
            );
        }
        let plan = |(_, a): &(Board, Analysis)| {
            serde_json::to_string(&Plan::of(a, Language::English)).unwrap()
        };
        assert_linear(&format!("xml {xml}: plan"), 1_000, make, plan);
    }
}

#[test]
fn plans_of_all_texts_tell_every_reason() {
    let mut reasons = std::collections::BTreeSet::new();
    for folder in ["examples", "library"] {
        for path in support::texts(folder) {
            let plan = Board::open(&path).plan();
            let known = plan["reasons"].as_object().unwrap();
            for at in walls(&plan) {
                let wall = &at.ring(&plan)["walls"][at.wall];
                let units = wall["units"].as_array().unwrap().iter();
                for thing in units.chain([wall]) {
                    let fixed = thing["fixed"].as_str();
                    assert!(fixed.is_none_or(|f| known.contains_key(f)));
                    reasons.extend(fixed.map(str::to_owned));
                }
            }
        }
    }
    for reason in ["repeat", "piece", "computed", "monument", "include"] {
        assert!(reasons.contains(reason), "{reason}: {reasons:?}");
    }
}
