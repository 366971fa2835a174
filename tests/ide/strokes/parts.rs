//! Parts that are set, to the letter.

#![allow(clippy::print_stdout)] // for those who look at what was refused

use super::bench::{At, Board, corners, walls};
use crate::support;
use serde_json::{Value, json};

const HEAD: &str = "# 町家\n0 0 180\n9\n\n";

fn set(at: (usize, usize), unit: usize, part: &str) -> Value {
    json!({"do": "set-part", "house": 0, "storey": at.0, "ring": 0, "wall": at.1, "unit": unit, "part": part})
}

/// The lines of the walls of a legacy house after a part was set.
fn lines(walls: &str, wall: usize, unit: usize, part: &str) -> Result<String, String> {
    let mut board = Board::new(&format!("{HEAD}{walls}"));
    board.draw(&set((0, wall), unit, part))?;
    Ok(board.text()[HEAD.len()..].to_owned())
}

/// The rows of an XML house.
fn rows(rows: &str, wall: usize, unit: usize, part: &str) -> Result<String, String> {
    let (head, tail) = (
        "<House name=\"家\"><Storey height=\"9\">",
        "</Storey></House>",
    );
    let mut board = Board::new(&format!("{head}{rows}{tail}"));
    board.draw(&set((0, wall), unit, part))?;
    let text = board.text();
    Ok(text[head.len()..text.len() - tail.len()].to_owned())
}

const FRONT: &str = "GSI  GSI  GDE 2TOD  KKS\nAPW  APW\nKTU  TSH 2TSH 2KTU\nAPW  APW\n";

#[test]
fn parts_keep_the_length_of_their_wall() {
    let rest = &FRONT[FRONT.find('\n').unwrap()..];
    let front =
        |unit, part| lines(FRONT, 0, unit, part).map(|t| t.strip_suffix(rest).unwrap().to_owned());
    let set = |unit, part| front(unit, part).unwrap();
    assert_eq!(set(0, "KSM"), "KSM  GSI  GDE 2TOD  KKS");
    // A wider one takes what stands to its left, which comes behind it in the walk.
    assert_eq!(set(0, "TKD 2"), "TKD 2GDE 2TOD  KKS");
    assert_eq!(set(3, "TIT 2"), "GSI  GSI  GDE 2TIT 2");
    // Nothing stands to the left of the last one.
    assert_eq!(set(4, "TIT 2"), "GSI  GSI  GDE 2TIT 2");
    // A narrower one is filled up with the plain wall that stands there.
    assert_eq!(set(2, "MRE"), "GSI  GSI  MRE  KKS  TOD  KKS");
    assert_eq!(set(4, "MRE"), "GSI  GSI  GDE 2TOD  MRE");
    // Two lattices of half a unit stand where one of a unit stood.
    assert_eq!(set(1, "GKK h"), "GSI  GKK hGKK hGDE 2TOD  KKS");
    assert_eq!(set(1, ""), "GSI  .....GDE 2TOD  KKS");
    assert_eq!(set(1, "大戸"), "GSI  TOD  GDE 2TOD  KKS");
    // A lattice of two units is not cut in half: what stands to the right goes.
    assert_eq!(set(1, "TKD 2"), "TKD 2GDE 2TOD  KKS");
    let tight = "GDE 2TOD  GDE 2\nAPW\nGDE 2TOD  GDE 2\nAPW\n";
    assert!(
        lines(tight, 0, 1, "TKD 2")
            .unwrap_err()
            .contains("too wide")
    );
    assert!(front(1, "ZZZ").unwrap_err().contains("no part `ZZZ`"));
    assert!(front(0, "").unwrap_err().contains("void"));
    assert!(front(0, "GSI").unwrap_err().contains("nothing"));
}

#[test]
fn lines_keep_their_letters_and_their_odd_characters() {
    // The letter stays in its column, and the other wide blanks as they were typed.
    let bent = "KSK  KSK  KSK\nKSK  KSK\nKSK  L\nKSK\nKSK  KSK\nKSK　　KSK  KSK\n";
    assert_eq!(
        lines(bent, 2, 0, "MRE").unwrap(),
        bent.replace("KSK  L", "MRE  L")
    );
    let wide = "KSK　KSK　KSK\nKSK  KSK\nKSK  KSK  KSK\nKSK  KSK\n";
    assert_eq!(
        lines(wide, 0, 1, "MRE").unwrap(),
        wide.replacen("　KSK　", "　MRE  ", 1)
    );
    let named = "大戸   KSK  KSK\r\nKSK  KSK\r\nKSK  KSK  大戸\r\nKSK  KSK\r\n";
    assert_eq!(
        lines(named, 0, 1, "MRE").unwrap(),
        named.replacen("   KSK", "   MRE", 1)
    );
    assert_eq!(
        lines(named, 2, 2, "MRE").unwrap(),
        named.replacen("大戸\r", "MRE\r", 1)
    );
}

#[test]
fn rows_keep_their_elements() {
    let row = |written: &str, unit, part| {
        let row = format!("<Row>{written}</Row>");
        let n = 4;
        let other = format!("<Row>{}</Row>", "APW  ".repeat(2).trim_end());
        let back = format!("<Row>{}</Row>", "KTU  ".repeat(n).trim_end());
        let all = format!("{row}{other}{back}{other}");
        let made = rows(&all, 0, unit, part)?;
        let rest = all.strip_prefix(&*row).unwrap();
        let made = made.strip_suffix(rest).unwrap();
        Ok::<String, String>(made["<Row>".len()..made.len() - "</Row>".len()].to_owned())
    };
    let set = |written, unit, part| row(written, unit, part).unwrap();
    assert_eq!(set("KSK  MRE  KSK  KSK", 1, "TOD"), "KSK  TOD  KSK  KSK");
    assert_eq!(set("KSK  MRE  KSK  KSK", 3, "TOD"), "KSK  MRE  KSK  TOD");
    assert_eq!(set("KSK  MRE  KSK  KSK", 1, "TKD 2"), "KSK  TKD 2KSK");
    let parts = "<Part code=\"KSK\"/> <!-- 戸 --> <Part code='TKD 2'/><Part code=\"KSK\"/>";
    assert_eq!(set(parts, 1, "TIT 2"), parts.replace("TKD 2", "TIT 2"));
    assert_eq!(
        set(parts, 1, "MRE"),
        parts.replace("'TKD 2'/>", "'MRE'/><Part code=\"KSK\"/>")
    );
    // One of a repetition stands for itself.
    let run = "<repeat num=\"4\">KSK</repeat>";
    assert_eq!(
        set(run, 1, "MRE"),
        "<repeat num=\"1\">KSK</repeat>MRE<repeat num=\"2\">KSK</repeat>"
    );
    let pattern = "<repeat num=\"2\">KSK  <!-- 窓 --><Part code=\"MRE\"/></repeat>";
    assert_eq!(
        set(pattern, 3, "TOD"),
        "<repeat num=\"1\">KSK  <!-- 窓 --><Part code=\"MRE\"/></repeat>KSK  TOD"
    );
    // What is drawn by lot or computed is left alone.
    assert!(row("KSK  <random code=\"MRE, MMM\"/>KSK  KSK", 1, "TOD").is_err());
    assert!(row("<repeat num=\"{2 + 2}\">KSK</repeat>", 1, "TOD").is_err());
    assert!(
        row(
            "<split><upper>MRE</upper><lower>KSK</lower></split>KSK  KSK  KSK",
            0,
            "TOD"
        )
        .is_err()
    );
    let width = "<Part code=\"KSK\" width=\"3\"/>KSK";
    assert_eq!(set(width, 0, "KSM"), width.replacen("KSK", "KSM", 1));
}

#[test]
fn own_parts_have_names() {
    let mut board = Board::open("examples/tea-shop.hsd".as_ref());
    let old = board.text();
    board.draw(&set((1, 0), 1, "signboard")).unwrap();
    let row = "<Row><Part code=\"signboard\"/><Part code=\"signboard\"/>KSK<Part code=\"signboard\"/>MMC 2";
    assert!(board.text().contains(row), "{}", board.text());
    board.draw(&set((1, 0), 1, "MMC 2")).unwrap();
    assert!(
        board.text().contains("<Part code=\"MMC 2\"/><Part"),
        "{}",
        board.text()
    );
    assert_ne!(board.text(), old);
    let mut board = Board::open("examples/hiraya.hsd".as_ref());
    assert!(board.draw(&set((0, 0), 0, "signboard")).is_err());
}

#[test]
fn spans_name_units() {
    let text = format!("{HEAD}{FRONT}");
    let mut board = Board::new(&text);
    let at = text.find("TOD").unwrap();
    let stroke = json!({"do": "set-part", "span": [at, at + 5], "part": "TKD"});
    board.draw(&stroke).unwrap();
    assert_eq!(board.text(), text.replace("TOD", "TKD"));
    let repeated = "<House><Storey><Row><repeat num=\"2\">KSK</repeat></Row><Row>KSK</Row><Row>KSK  KSK</Row>\
                    <Row>KSK</Row></Storey></House>";
    let at = repeated.find("KSK").unwrap();
    let stroke = json!({"do": "set-part", "span": [at, at + 3], "part": "MRE"});
    assert!(Board::new(repeated).draw(&stroke).is_err());
}

#[test]
fn floors_of_facades_take_parts() {
    let text = "<Structure><Facades><Facade><Floor id=\"1\">NTI  NTI  NAD 2</Floor><Floor id=\"2\"><Part code=\"NWI\"/>\
                <Part code=\"NWI\"/><Part code=\"NSW 2\"/></Floor></Facade></Facades></Structure>";
    let mut board = Board::new(text);
    board.draw(&set((0, 0), 2, "NSW 2")).unwrap();
    board.draw(&set((1, 0), 0, "NTI")).unwrap();
    let made = text
        .replace("NAD 2", "NSW 2")
        .replacen("\"NWI\"", "\"NTI\"", 1);
    assert_eq!(board.text(), made);
}

/// In every text: each unit that may be set becomes a window or a door, and nothing else moves.
#[test]
fn every_unit_of_every_text_may_be_set() {
    let (mut sets, mut refused) = (0, 0);
    for folder in ["examples", "library"] {
        for path in support::texts(folder) {
            let mut board = Board::open(&path);
            let (plan, bytes) = (board.plan(), board.bytes.clone());
            let mut number = 0;
            for at in walls(&plan) {
                let wall = &at.ring(&plan)["walls"][at.wall];
                for (unit, own) in wall["units"].as_array().unwrap().iter().enumerate() {
                    number += 1;
                    // A share of them is enough: each is a whole check of the text.
                    let fixed = !own["fixed"].is_null();
                    if number % (if fixed { 11 } else { 5 }) != 0 {
                        continue;
                    }
                    let part = ["MMM", "TKD 2", "KYI", "....."][number / 5 % 4];
                    let stroke = json!({"do": "set-part", "house": at.house, "storey": at.storey, "ring": at.ring,
                        "wall": at.wall, "unit": unit, "part": part});
                    match board.draw(&stroke) {
                        Ok(_) => {
                            assert!(!fixed, "{} {stroke}", board.name);
                            check(&board, &plan, &at, unit, part);
                            sets += 1;
                            board.bytes = bytes.clone();
                        }
                        Err(_) => refused += 1,
                    }
                }
            }
        }
    }
    println!("{sets} parts set, {refused} refused");
    assert!(sets > 60, "{sets} parts set, {refused} refused");
}

fn check(board: &Board, plan: &Value, at: &At, unit: usize, part: &str) {
    let after = board.plan();
    let ring = at.ring(&after);
    assert!(
        corners(ring) == corners(at.ring(plan)),
        "{} {at:?} {unit} {part}",
        board.name
    );
    let units = |plan: &Value| {
        let units = &at.ring(plan)["walls"][at.wall]["units"];
        let codes = units.as_array().unwrap().iter();
        codes
            .map(|u| u["code"].as_str().unwrap().to_owned())
            .collect::<Vec<String>>()
    };
    let (old, new) = (units(plan), units(&after));
    let part = if part == "....." { "" } else { part };
    assert!(
        new.contains(&part.to_owned()),
        "{} {at:?} {unit} {part}: {new:?}",
        board.name
    );
    // What stands before the part and well behind it is as it was.
    let kept = new.iter().zip(&old).take_while(|(a, b)| a == b).count();
    assert!(
        kept + 2 > unit.min(old.len()),
        "{} {at:?} {unit} {part}: {old:?} {new:?}",
        board.name
    );
    for other in walls(plan).iter().filter(|o| *o != at) {
        let same = other.ring(plan)["walls"][other.wall]["to"]
            == other.ring(&after)["walls"][other.wall]["to"];
        assert!(same, "{} {at:?}", board.name);
    }
}
