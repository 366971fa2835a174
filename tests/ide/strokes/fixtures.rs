//! What is built into rooms: placed, moved, turned, drawn larger and removed; and the heights of rooms.

use super::bench::Board;
use serde_json::{Value, json};

const HOUSE: &str = r#"<Houses>
  <House name="small">
    <Storey height="9">
      <Row>KSK  KSK  TKD 2KSK  KSK  </Row>
      <Row><repeat num="8"><Part code="KTU"/></repeat></Row>
      <Row><repeat num="6"><Part code="KTU"/></repeat></Row>
      <Row><repeat num="8"><Part code="KTU"/></repeat></Row>
      <Loop inner="yes" start="0 4"><Row>TFU 2TFU 2TFU 2</Row></Loop>
      <Room name="奥" at="3 6" floor="tatami"/>
    </Storey>
    <Storey height="7">
      <Row>KTU  KTU  MMU 2KTU  KTU  </Row>
      <Row><repeat num="8"><Part code="KTU"/></repeat></Row>
      <Row><repeat num="6"><Part code="KTU"/></repeat></Row>
      <Row><repeat num="8"><Part code="KTU"/></repeat></Row>
      <Room at="3 3"/>
    </Storey>
  </House>
</Houses>
"#;

fn stroke(kind: &str, words: Value) -> Value {
    let mut stroke = json!({"do": kind, "house": 0, "storey": 0});
    let own = stroke.as_object_mut().unwrap();
    own.extend(words.as_object().unwrap().clone());
    stroke
}

fn fixtures(board: &Board) -> Vec<Value> {
    let all = board.plan()["houses"][0]["storeys"][0]["fixtures"].clone();
    all.as_array().unwrap().clone()
}

fn set(board: &mut Board, words: Value) {
    let mut words = words;
    words["fixture"] = 0.into();
    board.draw(&stroke("set-fixture", words)).unwrap();
}

#[test]
fn a_fixture_is_placed_moved_turned_drawn_larger_and_removed() {
    let mut board = Board::new(HOUSE);
    board
        .draw(&stroke(
            "add-fixture",
            json!({"kind": "tokonoma", "at": [1, 7], "size": [2, 1], "faces": "F"}),
        ))
        .unwrap();
    // Behind the room, without what is usual.
    assert!(
        board.text().contains(
            "floor=\"tatami\"/>\n      <Fixture kind=\"tokonoma\" at=\"1 7\"/>\n    </Storey>"
        ),
        "{}",
        board.text()
    );
    set(&mut board, json!({"at": [3.25, 7]}));
    set(&mut board, json!({"size": [2.5, 1]}));
    let own = fixtures(&board)[0].clone();
    assert_eq!(own["at"], json!([3.25, 7]));
    assert_eq!(own["size"], json!([2.5, 1]));
    assert_eq!(own["built"], true);
    // Turned it is as wide and deep, and goes back from the wall.
    set(&mut board, json!({"faces": "R"}));
    let own = fixtures(&board)[0].clone();
    assert_eq!(own["size"], json!([1, 2.5]));
    assert_eq!(own["at"], json!([3.25, 5.5]));
    set(&mut board, json!({"size": [1, 2]}));
    assert!(!board.text().contains("size="), "{}", board.text());
    set(
        &mut board,
        json!({"kind": "oshi-ire", "faces": "F", "at": [4, 7]}),
    );
    let element = "<Fixture kind=\"oshi-ire\" at=\"4 7\" faces=\"F\"/>";
    assert!(board.text().contains(element), "{}", board.text());
    board
        .draw(&stroke("remove-fixture", json!({"fixture": 0})))
        .unwrap();
    assert_eq!(board.text(), HOUSE);
}

#[test]
fn each_kind_is_placed_by_its_word_and_looks_to_each_side() {
    for kind in [
        "tokonoma",
        "chigaidana",
        "butsudan",
        "oshi-ire",
        "stairs",
        "hako-kaidan",
        "kamado",
        "well",
        "sink",
    ] {
        for faces in ["F", "B", "L", "R"] {
            let mut board = Board::new(HOUSE);
            let words = json!({"kind": kind, "at": [1.5, 0.5], "faces": faces});
            board.draw(&stroke("add-fixture", words)).unwrap();
            let own = fixtures(&board)[0].clone();
            assert_eq!(own["kind"], kind);
            assert_eq!(own["faces"], faces);
            assert_eq!(own["built"], true, "{kind} {faces}");
            assert!(!board.text().contains("size="), "{}", board.text());
        }
    }
}

#[test]
fn what_does_not_fit_is_refused_with_a_reason() {
    let mut board = Board::new(HOUSE);
    let well = json!({"kind": "well", "at": [1, 1]});
    board.draw(&stroke("add-fixture", well)).unwrap();
    let text = board.text();
    let add = |words: Value| stroke("add-fixture", words);
    for (stroke, reason) in [
        (add(json!({"kind": "tokonoma", "at": [7, 1]})), "outside"),
        (add(json!({"kind": "tokonoma", "at": [2, 3.5]})), "a wall"),
        (add(json!({"kind": "kamado", "at": [0, 1]})), "(`well`)"),
        (add(json!({"kind": "throne", "at": [3, 1]})), "draw that"),
        (add(json!({"kind": "well", "at": [1e9, 1]})), "farther"),
        (add(json!({"kind": "well"})), "draw that"),
        (
            add(json!({"kind": "well", "at": [3, 1], "size": [0.1, 1]})),
            "between 0.25 and 60",
        ),
        (
            add(json!({"kind": "well", "at": [3, 1], "faces": "X"})),
            "draw that",
        ),
        // They rise to the back, where the house ends.
        (
            add(json!({"kind": "stairs", "at": [4, 5]})),
            "upstairs a wall is in the way",
        ),
        (
            stroke("set-fixture", json!({"fixture": 0, "at": [1, 3.5]})),
            "a wall would run",
        ),
        (
            stroke("set-fixture", json!({"fixture": 0, "faces": "F"})),
            "changes nothing",
        ),
        (
            stroke("set-fixture", json!({"fixture": 3, "faces": "B"})),
            "draw that",
        ),
        (
            json!({"do": "add-fixture", "house": 0, "storey": 1, "kind": "stairs", "at": [1, 1]}),
            "no storey stands above",
        ),
        (
            stroke("set-room", json!({"room": 0, "height": 0.5})),
            "between 1 and 100",
        ),
    ] {
        let why = board.draw(&stroke).unwrap_err();
        assert!(why.contains(reason), "{stroke}: {why}");
        assert_eq!(board.text(), text);
    }
}

#[test]
fn stairs_do_not_rise_into_what_stands_upstairs_nor_is_anything_put_in_their_opening() {
    let mut board = Board::new(HOUSE);
    let upstairs = |kind: &str, at: Value| json!({"do": "add-fixture", "house": 0, "storey": 1, "kind": kind, "at": at});
    board.draw(&upstairs("oshi-ire", json!([0, 1]))).unwrap();
    let stairs = |at: Value| stroke("add-fixture", json!({"kind": "stairs", "at": at}));
    let why = board.draw(&stairs(json!([1, 0]))).unwrap_err();
    assert!(why.contains("(`oshi-ire`)"), "{why}");
    board.draw(&stairs(json!([4, 0]))).unwrap();
    let why = board
        .draw(&upstairs("butsudan", json!([4, 1])))
        .unwrap_err();
    assert!(why.contains("stairs come up"), "{why}");
}

#[test]
fn what_the_text_says_and_does_not_fit_is_in_the_plan_as_left_out() {
    let text = HOUSE.replacen(
        "<Room name",
        "<Fixture kind=\"well\" at=\"8 1\"/>\n      <Room name",
        1,
    );
    let mut board = Board::new(&text);
    assert_eq!(fixtures(&board)[0]["built"], false);
    set(&mut board, json!({"at": [2, 1]}));
    assert_eq!(fixtures(&board)[0]["built"], true);
}

#[test]
fn a_fixture_whose_place_is_computed_is_not_moved() {
    let text = HOUSE.replacen(
        "<Room name",
        "<Fixture kind=\"well\" at=\"{1 + 1} 1\"/>\n      <Room name",
        1,
    );
    let mut board = Board::new(&text);
    assert_eq!(fixtures(&board)[0]["at"], json!([2, 1]));
    let words = json!({"fixture": 0, "at": [3, 1]});
    let why = board.draw(&stroke("set-fixture", words)).unwrap_err();
    assert!(why.contains("computed"), "{why}");
    assert_eq!(board.text(), text);
}

#[test]
fn the_height_of_a_room_is_written_and_taken_out_again() {
    let mut board = Board::new(HOUSE);
    board
        .draw(&stroke("set-room", json!({"room": 0, "height": 7.5})))
        .unwrap();
    assert!(board.text().contains("floor=\"tatami\" height=\"7.5\"/>"));
    let room = board.plan()["houses"][0]["storeys"][0]["rooms"][0].clone();
    assert_eq!(room["height"], 7.5);
    board
        .draw(&stroke("set-room", json!({"room": 0, "height": 0})))
        .unwrap();
    assert_eq!(board.text(), HOUSE);
}

#[test]
fn fixtures_of_the_examples_are_in_the_plan_and_stand_where_they_are() {
    for (text, count) in [
        (include_str!("../../../examples/rooms.hsd"), 5),
        (include_str!("../../../examples/tsushi.hsd"), 8),
    ] {
        let mut board = Board::new(text);
        let all = fixtures(&board);
        assert_eq!(all.len(), count);
        for (number, fixture) in all.iter().enumerate() {
            assert_eq!(fixture["built"], true, "{fixture}");
            // Where it stands it may be put: it does not stand in its own way.
            let words = json!({"fixture": number, "at": fixture["at"]});
            let why = board.draw(&stroke("set-fixture", words)).unwrap_err();
            assert!(why.contains("changes nothing"), "{fixture}: {why}");
        }
    }
}
