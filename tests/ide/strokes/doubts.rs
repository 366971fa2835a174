//! Walls in doubt: found by their comments, and settled.

use super::bench::Board;
use serde_json::{Value, json};

const HOUSE: &str = r#"<House name="read">
  <Storey height="9">
    <!-- in doubt: KTU at 1 0, TSH 2 at 2 0 -->
    <Row>KTU  KTU  TSH 2KTU  KTU</Row>
    <Row>KTU  KTU  KTU  KTU  KTU  KTU  KTU  KTU</Row>
    <Row>KTU  KTU  KTU  KTU  KTU  KTU</Row>
    <Row>KTU  KTU  KTU  KTU  KTU  KTU  KTU  KTU</Row>
    <Loop inner="yes" start="0 4">
      <!-- in doubt: KTU at 2 4, KTU at 3 4, TFU 2 at 4 4 -->
      <Row>TFU 2KTU  KTU  TFU 2</Row>
    </Loop>
    <Loop inner="yes" start="2 4">
      <Row turn="R"/>
      <!-- in doubt: TSH at 2 5 -->
      <Row>KTU  TSH  KTU  KTU</Row>
    </Loop>
  </Storey>
  <Roofs kind="K" shape="KIR" pitch="4.5"/>
</House>
"#;

fn doubts(board: &Board) -> Vec<Value> {
    board.plan()["doubts"].as_array().unwrap().clone()
}

/// The walls inside as stretches: from, to and code, in order.
fn inside(board: &Board) -> Vec<(String, [i64; 4])> {
    let mut found = vec![];
    let rings = board.plan()["houses"][0]["storeys"][0]["rings"].clone();
    for ring in rings
        .as_array()
        .unwrap()
        .iter()
        .filter(|r| r["inner"] == true)
    {
        for unit in ring["walls"]
            .as_array()
            .unwrap()
            .iter()
            .flat_map(|w| w["units"].as_array().unwrap())
        {
            let at = |end: &str, k: usize| unit[end][k].as_f64().unwrap().round() as i64;
            let code = unit["code"].as_str().unwrap().to_owned();
            found.push((
                code,
                [at("from", 0), at("from", 1), at("to", 0), at("to", 1)],
            ));
        }
    }
    found.sort();
    found
}

#[test]
fn doubts_are_found_with_their_parts() {
    let board = Board::new(HOUSE);
    let found = doubts(&board);
    let codes: Vec<&str> = found.iter().map(|d| d["code"].as_str().unwrap()).collect();
    assert_eq!(codes, ["KTU", "TSH 2", "KTU", "KTU", "TFU 2", "TSH"]);
    for doubt in &found {
        let place = &doubt["unit"];
        let index = |name: &str| place[name].as_u64().unwrap_or_else(|| panic!("{doubt}")) as usize;
        let storey = board.plan()["houses"][0]["storeys"][index("storey")].clone();
        let unit = &storey["rings"][index("ring")]["walls"][index("wall")]["units"][index("unit")];
        assert_eq!(unit["code"], doubt["code"]);
        assert_eq!(unit["from"], doubt["at"]);
        let span: [usize; 2] = serde_json::from_value(doubt["span"].clone()).unwrap();
        let entry = &HOUSE[span[0]..span[1]];
        assert!(
            entry.starts_with(doubt["code"].as_str().unwrap()) && entry.contains(" at "),
            "{entry}"
        );
    }
}

#[test]
fn other_comments_are_no_doubts_and_odd_entries_stay() {
    let odd = HOUSE
        .replace(
            "KTU at 1 0, ",
            "somewhere, KTU at 1 0 (see sheet 2), KTU at x y, ",
        )
        .replace("<!-- in doubt: KTU at 2 4", "<!-- no doubt: KTU at 2 4")
        .replace(
            "<!-- in doubt: TSH at 2 5 -->",
            "<!-- in doubt: TSH at 2 5 --><!-- another -->",
        );
    let mut board = Board::new(&odd);
    assert_eq!(doubts(&board).len(), 2, "{:?}", doubts(&board));
    assert!(board.draw_anyhow(&json!({"do": "accept-doubt", "doubt": 0})));
    assert!(
        board
            .text()
            .contains("<!-- in doubt: somewhere, KTU at x y, TSH 2 at 2 0 -->"),
        "{}",
        board.text()
    );
}

#[test]
fn what_is_accepted_is_in_doubt_no_longer() {
    let mut board = Board::new(HOUSE);
    assert!(board.draw_anyhow(&json!({"do": "accept-doubt", "doubt": 1})));
    assert_eq!(board.text(), HOUSE.replace(", TSH 2 at 2 0", ""));
    assert!(board.draw_anyhow(&json!({"do": "accept-doubt", "doubt": 0})));
    assert_eq!(
        board.text(),
        HOUSE.replace("    <!-- in doubt: KTU at 1 0, TSH 2 at 2 0 -->\n", "")
    );
    assert_eq!(doubts(&board).len(), 4);
    assert!(!board.draw_anyhow(&json!({"do": "accept-doubt", "doubt": 4})));
}

#[test]
fn another_kind_has_the_same_width_and_the_parts_of_the_house() {
    let rows = [
        (1, "wall", "KTU  KTU  KTU  KTU  KTU  KTU</Row>"),
        (1, "window", "KTU  KTU  MRE  MRE  KTU  KTU</Row>"),
        (1, "lattice", "KTU  KTU  GSI  GSI  KTU  KTU</Row>"),
        (1, "open", "KTU  KTU  AKI 2KTU  KTU</Row>"),
        (1, "slide", "KTU  KTU  TSH 2KTU  KTU</Row>"),
        (0, "slide", "KTU  TSH  TSH 2KTU  KTU</Row>"),
        (0, "open", "KTU  AKI  TSH 2KTU  KTU</Row>"),
        (4, "wall", "<Row>TFU 2KTU  KTU  KTU  KTU</Row>"),
        (4, "slide", "<Row>TFU 2KTU  KTU  TFU 2</Row>"),
    ];
    for (doubt, kind, row) in rows {
        let mut board = Board::new(HOUSE);
        assert!(board.draw_anyhow(&json!({"do": "change-doubt", "doubt": doubt, "kind": kind})));
        assert!(board.text().contains(row), "{kind}: {}", board.text());
        assert_eq!(doubts(&board).len(), 5, "{kind}");
    }
    let mut board = Board::new(&HOUSE.replacen(
        "<Row>KTU  KTU  KTU  KTU  KTU  KTU</Row>",
        "<Row>KTU  MGA  MGA  MRE  KTU  KTU</Row>",
        1,
    ));
    assert!(board.draw_anyhow(&json!({"do": "change-doubt", "doubt": 1, "kind": "window"})));
    assert!(
        board.text().contains("KTU  KTU  MGA  MGA  KTU  KTU</Row>"),
        "{}",
        board.text()
    );
}

#[test]
fn outside_an_open_way_is_left() {
    let mut board = Board::new(HOUSE);
    assert!(board.draw_anyhow(&json!({"do": "delete-doubt", "doubt": 1})));
    assert_eq!(
        board.text(),
        HOUSE
            .replace(", TSH 2 at 2 0", "")
            .replace("TSH 2KTU", "AKI 2KTU")
    );
}

#[test]
fn inside_the_wall_goes_and_all_others_stay() {
    let all = inside(&Board::new(HOUSE));
    for (number, doubt) in doubts(&Board::new(HOUSE)).iter().enumerate().skip(2) {
        let mut board = Board::new(HOUSE);
        assert!(board.draw_anyhow(&json!({"do": "delete-doubt", "doubt": number})));
        let at: Vec<i64> = doubt["at"]
            .as_array()
            .unwrap()
            .iter()
            .map(|n| n.as_f64().unwrap() as i64)
            .collect();
        let mut rest = all.clone();
        rest.retain(|(_, p)| p[..2] != at || number != 5 && p[0] == p[2]);
        assert_eq!(rest.len(), all.len() - 1);
        assert_eq!(inside(&board), rest, "{}", board.text());
        // The others are in doubt still, each at its part.
        let left = doubts(&board);
        assert_eq!(left.len(), 5, "{}", board.text());
        assert!(
            left.iter().all(|d| !d["unit"].is_null()),
            "{}",
            board.text()
        );
    }
}

#[test]
fn a_walk_that_is_parted_is_written_like_the_one_it_was() {
    let mut board = Board::new(HOUSE);
    assert!(board.draw_anyhow(&json!({"do": "delete-doubt", "doubt": 2})));
    let text = "    <Loop inner=\"yes\" start=\"0 4\">
      <Row>TFU 2</Row>
    </Loop>
    <Loop inner=\"yes\" start=\"3 4\">
      <!-- in doubt: KTU at 3 4, TFU 2 at 4 4 -->
      <Row>KTU  TFU 2</Row>
    </Loop>
";
    assert!(board.text().contains(text), "{}", board.text());
    let mut board = Board::new(HOUSE);
    assert!(board.draw_anyhow(&json!({"do": "delete-doubt", "doubt": 5})));
    let text = "    <Loop inner=\"yes\" start=\"2 4\">
      <Row turn=\"R\"/>
      <Row>KTU  </Row>
    </Loop>
    <Loop inner=\"yes\" start=\"2 6\">
      <Row turn=\"R\"/>
      <Row>KTU  KTU</Row>
    </Loop>
";
    assert!(board.text().contains(text), "{}", board.text());
}

#[test]
fn a_walk_is_emptied_part_by_part() {
    let bent = HOUSE.replace(
        "      <Row>TFU 2KTU  KTU  TFU 2</Row>",
        "      <Row turn=\"R\">TFU 2</Row>\n      <!-- in doubt: KTU at 2 4, KTU at 2 5 -->\n      <Row turn=\"L\">KTU  KTU</Row>\n      <!-- in doubt: TFU 2 at 2 6 -->\n      <Row>TFU 2</Row>",
    );
    let bent = bent.replace("KTU at 2 4, KTU at 3 4, TFU 2 at 4 4", "TFU 2 at 0 4");
    let bent = bent
        .replace("start=\"2 4\"", "start=\"5 4\"")
        .replace("TSH at 2 5", "TSH at 5 5");
    for order in [
        [2, 2, 2, 2],
        [5, 4, 3, 2],
        [3, 3, 2, 2],
        [4, 3, 2, 2],
        [4, 2, 2, 2],
        [3, 2, 2, 2],
    ] {
        let mut board = Board::new(&bent);
        let mut rest = inside(&board);
        for number in order {
            let doubt = doubts(&board)[number].clone();
            let [a, b] = [0, 1].map(|k| doubt["at"][k].as_f64().unwrap() as i64);
            let code = doubt["code"].as_str().unwrap();
            let before = rest.len();
            rest.retain(|(c, p)| !(c == code && p[0] == a && p[1] == b));
            assert_eq!(rest.len(), before - 1, "{doubt}");
            assert!(board.draw_anyhow(&json!({"do": "delete-doubt", "doubt": number})));
            assert_eq!(inside(&board), rest, "{order:?} {number}\n{}", board.text());
            assert!(
                doubts(&board).iter().all(|d| !d["unit"].is_null()),
                "{}",
                board.text()
            );
        }
        assert!(
            !board.text().lines().any(|l| l.trim().is_empty()),
            "{}",
            board.text()
        );
    }
}

#[test]
fn a_doubt_goes_along_with_its_wall_and_one_without_a_wall_is_accepted_only() {
    let mut board = Board::new(HOUSE);
    assert!(board.draw_anyhow(
        &json!({"do": "move-wall", "house": 0, "storey": 0, "ring": 0, "wall": 0, "by": 1})
    ));
    let doubt = doubts(&board)[1].clone();
    assert_eq!(
        (&doubt["unit"]["unit"], &doubt["at"]),
        (&json!(2), &json!([2, -1])),
        "{}",
        board.text()
    );
    // Moved in the text itself, it is found along the walk.
    let board = Board::new(&HOUSE.replace("TSH 2 at 2 0", "TSH 2 at 2 3"));
    assert_eq!(doubts(&board)[1]["unit"]["unit"], 2);
    let mut board = Board::new(&HOUSE.replace("KTU at 1 0", "GSI at 1 7"));
    assert!(doubts(&board)[0]["unit"].is_null());
    assert!(!board.draw_anyhow(&json!({"do": "delete-doubt", "doubt": 0})));
    assert!(!board.draw_anyhow(&json!({"do": "change-doubt", "doubt": 0, "kind": "wall"})));
    assert!(board.draw_anyhow(&json!({"do": "accept-doubt", "doubt": 0})));
    assert_eq!(board.text(), HOUSE.replace("KTU at 1 0, ", ""));
}

#[test]
fn a_straight_wall_inside_is_moved_and_its_doubt_with_it() {
    let mut board = Board::new(HOUSE);
    let all = inside(&board);
    let ring = doubts(&board)[5]["unit"].clone();
    let mut stroke = json!({"do": "move-wall", "by": 1});
    for key in ["house", "storey", "ring", "wall"] {
        stroke[key] = ring[key].clone();
    }
    assert!(board.draw_anyhow(&stroke), "{}", board.text());
    assert_eq!(
        board.text(),
        HOUSE
            .replace("start=\"2 4\"", "start=\"3 4\"")
            .replace("TSH at 2 5", "TSH at 3 5")
    );
    let mut moved = all;
    for (_, p) in &mut moved {
        if p[0] == 2 && p[2] == 2 {
            *p = [3, p[1], 3, p[3]];
        }
    }
    moved.sort();
    assert_eq!(inside(&board), moved);
    stroke["by"] = json!(9);
    assert!(!board.draw_anyhow(&stroke), "out of the house");
    stroke["do"] = json!("break-wall");
    stroke["from"] = json!(0);
    stroke["to"] = json!(1);
    stroke["by"] = json!(1);
    assert!(!board.draw_anyhow(&stroke), "it is not broken");
}

#[test]
fn a_part_that_is_replaced_is_in_doubt_no_longer() {
    let mut board = Board::new(HOUSE);
    assert!(board.draw_anyhow(&json!({"do": "set-part", "house": 0, "storey": 0, "ring": 0, "wall": 0, "unit": 1, "part": "KSK"})));
    assert_eq!(
        board.text(),
        HOUSE
            .replace("KTU at 1 0, ", "")
            .replacen("<Row>KTU  KTU", "<Row>KTU  KSK", 1)
    );
    // Where parts are written once for many, a doubt cannot take one away.
    let run = HOUSE.replace(
        "TFU 2KTU  KTU  TFU 2",
        "TFU 2<repeat num=\"2\"><Part code=\"KTU\"/></repeat>TFU 2",
    );
    let mut board = Board::new(&run);
    assert!(!board.draw_anyhow(&json!({"do": "delete-doubt", "doubt": 2})));
    assert_eq!(board.text(), run);
}
