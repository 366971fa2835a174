//! Rooms and the walls between them: drawn, changed and removed.

use super::bench::Board;
use serde_json::{Value, json};

const HOUSE: &str = r#"<Houses>
  <House name="small">
    <!-- Six by eight. -->
    <Storey height="9">
      <Row>KSK  KSK  TKD 2KSK  KSK  </Row>
      <Row><repeat num="8"><Part code="KTU"/></repeat></Row>
      <Row><repeat num="6"><Part code="KTU"/></repeat></Row>
      <Row><repeat num="8"><Part code="KTU"/></repeat></Row>
    </Storey>
  </House>
</Houses>
"#;

fn wall(points: Value, part: Option<&str>) -> Value {
    let mut stroke = json!({"do": "draw-wall", "house": 0, "storey": 0, "points": points});
    if let Some(part) = part {
        stroke["part"] = part.into();
    }
    stroke
}

fn room(kind: &str, words: Value) -> Value {
    let mut stroke = json!({"do": kind, "house": 0, "storey": 0});
    let own = stroke.as_object_mut().unwrap();
    own.extend(words.as_object().unwrap().clone());
    stroke
}

fn storey(board: &Board) -> Value {
    board.plan()["houses"][0]["storeys"][0].clone()
}

/// The corners of a walk inside, without lines that only turn it.
fn walk(ring: &Value) -> Vec<[f64; 2]> {
    let point = |p: &Value| [p[0].as_f64().unwrap(), p[1].as_f64().unwrap()];
    let walls = ring["walls"].as_array().unwrap().iter();
    let mut corners: Vec<[f64; 2]> = walls
        .flat_map(|w| [point(&w["from"]), point(&w["to"])])
        .collect();
    corners.dedup();
    corners
}

/// Twice the area within a ring.
fn area2(ring: &Value) -> f64 {
    let ring = ring.as_array().unwrap();
    let at = |i: usize| {
        let p = &ring[i % ring.len()];
        (p[0].as_f64().unwrap(), p[1].as_f64().unwrap())
    };
    let cross = |i: usize| at(i).0 * at(i + 1).1 - at(i + 1).0 * at(i).1;
    (0..ring.len()).map(cross).sum()
}

#[test]
fn a_wall_inside_stands_where_it_is_drawn_in_every_direction() {
    for points in [
        json!([[0, 4], [6, 4]]),
        json!([[6, 4], [0, 4]]),
        json!([[2, 0], [2, 8]]),
        json!([[2, 8], [2, 0]]),
        json!([[0, 3], [4, 3], [4, 8]]),
        json!([[4, 8], [4, 3], [0, 3]]),
        json!([[1, 1], [5, 1], [5, 5], [1, 5], [1, 1]]),
    ] {
        let mut board = Board::new(HOUSE);
        board.draw(&wall(points.clone(), None)).unwrap();
        let ring = storey(&board)["rings"][1].clone();
        assert_eq!(ring["inner"], true, "{}", board.text());
        let wanted: Vec<[f64; 2]> = serde_json::from_value(points).unwrap();
        assert_eq!(walk(&ring), wanted, "{}", board.text());
    }
}

#[test]
fn a_wall_is_of_one_part_and_clay_wall_fills_the_rest() {
    let mut board = Board::new(HOUSE);
    board
        .draw(&wall(json!([[1, 4], [6, 4]]), Some("TFU 2")))
        .unwrap();
    assert!(
        board.text().contains(
            "      <Loop inner=\"yes\" start=\"1 4\">\n        <Row>TFU 2TFU 2KTU</Row>\n      </Loop>\n    </Storey>"
        ),
        "{}",
        board.text()
    );
    // A part of it is another one, and the wall goes again.
    board
        .draw(&json!({"do": "set-part", "house": 0, "storey": 0, "ring": 1, "wall": 0, "unit": 2, "part": "TIT  "}))
        .unwrap();
    assert!(board.text().contains("TFU 2TFU 2TIT"), "{}", board.text());
    let gone = json!({"do": "remove-wall", "house": 0, "storey": 0, "ring": 1});
    board.draw(&gone).unwrap();
    assert_eq!(board.text(), HOUSE);
    assert!(board.draw(&gone).is_err());
    let outer = json!({"do": "remove-wall", "house": 0, "storey": 0, "ring": 0});
    assert!(board.draw(&outer).unwrap_err().contains("outer wall"));
}

#[test]
fn a_room_is_made_changed_moved_and_removed() {
    let mut board = Board::new(HOUSE);
    board.draw(&wall(json!([[0, 4], [6, 4]]), None)).unwrap();
    let before = board.text();
    board
        .draw(&room(
            "add-room",
            json!({"at": [3, 6], "name": "座敷 十二畳", "floor": "tatami", "mats": "festive"}),
        ))
        .unwrap();
    let element = r#"<Room name="座敷 十二畳" at="3 6" floor="tatami"/>"#;
    assert!(
        board
            .text()
            .contains(&format!("      {element}\n    </Storey>")),
        "{}",
        board.text()
    );
    let own = storey(&board)["rooms"][0].clone();
    assert_eq!(own["name"], "座敷 十二畳");
    assert_eq!(area2(&own["area"][0]).abs(), 2.0 * 6.0 * 4.0);
    assert_eq!(own["laid"].as_array().unwrap().len(), 12);
    board
        .draw(&room(
            "set-room",
            json!({"room": 0, "name": "Bob's \"<den>\" & co", "floor": "boards", "ceiling": "none", "at": [1.5, 7]}),
        ))
        .unwrap();
    let own = storey(&board)["rooms"][0].clone();
    assert_eq!(own["name"], "Bob's \"<den>\" & co");
    assert_eq!(
        (&own["floor"], &own["ceiling"]),
        (&json!("boards"), &json!("none"))
    );
    assert_eq!(own["at"], json!([1.5, 7]));
    board
        .draw(&room("set-room", json!({"room": 0, "name": " "})))
        .unwrap();
    assert!(!board.text().contains("name=\"Bob"), "{}", board.text());
    board
        .draw(&room("remove-room", json!({"room": 0})))
        .unwrap();
    assert_eq!(board.text(), before);
}

#[test]
fn rooms_and_walls_that_cannot_be_are_refused_with_a_reason() {
    let mut board = Board::new(HOUSE);
    board.draw(&wall(json!([[0, 4], [6, 4]]), None)).unwrap();
    board
        .draw(&room("add-room", json!({"at": [3, 6], "name": "奥"})))
        .unwrap();
    for (stroke, reason) in [
        (room("add-room", json!({"at": [1, 5]})), "the room `奥`"),
        (room("add-room", json!({"at": [1, 4]})), "a wall stands"),
        (room("add-room", json!({"at": [9, 5]})), "outside"),
        (
            room("add-room", json!({"at": [3, 2], "name": "a{b}"})),
            "braces",
        ),
        (
            room("add-room", json!({"at": [3, 2], "floor": "lava"})),
            "draw that again",
        ),
        (room("set-room", json!({"room": 0, "at": [3, 2]})), ""),
        (
            room("set-room", json!({"room": 0, "name": "奥"})),
            "changes nothing",
        ),
        (
            room("set-room", json!({"room": 7, "name": "奥"})),
            "draw that again",
        ),
        (wall(json!([[2, 4], [5, 4]]), None), "stands there"),
        (wall(json!([[0, 0], [0, 4]]), None), "stands there"),
        (wall(json!([[2, 2], [2, 12]]), None), "leaves the storey"),
        (wall(json!([[2, 2], [3, 3]]), None), "lines of the grid"),
        (wall(json!([[2, 2]]), None), "lines of the grid"),
        (wall(json!([[2, 1], [2, 3]]), Some("XYZ")), "no part `XYZ`"),
        (wall(json!([[2, 1], [2, 2]]), Some("TFU 2")), "too wide"),
    ] {
        if reason.is_empty() {
            // To a free area a room may go.
            board.draw(&stroke).unwrap();
            board
                .draw(&room("set-room", json!({"room": 0, "at": [3, 6]})))
                .unwrap();
            continue;
        }
        let why = board.draw(&stroke).unwrap_err();
        assert!(why.contains(reason), "{stroke}: {why}");
    }
}

#[test]
fn the_legacy_form_has_no_rooms_and_says_so() {
    let text =
        "# A house.\n0 0 180\n9.0\nname plain\n\nKSK  KSK  \nKTU  KTU  \nKTU  KTU  \nKTU  KTU  \n";
    let mut board = Board::new(text);
    let why = board
        .draw(&room("add-room", json!({"at": [1, 1]})))
        .unwrap_err();
    assert!(why.contains("--to xml"), "{why}");
    let why = board
        .draw(&wall(json!([[0, 1], [2, 1]]), None))
        .unwrap_err();
    assert!(why.contains("--to xml"), "{why}");
}

#[test]
fn rooms_of_the_examples_are_in_the_plan_with_areas_that_hold_their_points() {
    let board = Board::new(include_str!("../../../examples/rooms.hsd"));
    let rooms = storey(&board)["rooms"].as_array().unwrap().clone();
    assert_eq!(rooms.len(), 6);
    for room in &rooms {
        assert_eq!(room["fixed"], Value::Null);
        assert!(area2(&room["area"][0]) > 1.0, "{room}");
    }
    let zashiki = rooms.iter().find(|r| r["name"] == "座敷 十畳").unwrap();
    let mats = zashiki["laid"].as_array().unwrap().iter();
    let [a0, b0, a1, b1] = [0, 1, 2, 3].map(|k| move |m: &Value| m[k].as_f64().unwrap());
    let area: f64 = mats.map(|m| (a1(m) - a0(m)) * (b1(m) - b0(m))).sum();
    assert_eq!(area, 20.0, "ten mats of two units");
}
