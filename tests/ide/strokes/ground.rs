//! What moves as a whole: groups, placed houses, outlines and their corners.

use super::bench::Board;
use serde_json::{Value, json};

const TOWN: &str = r#"<Houses>
  <Group x="2" turn="90">
    <Place type="hiraya" x="6" y="3" frontage="6" depth="6"/>
    <Place type="kura" x="{3 * 4}" y="3"/>
  </Group>
  <House name="shop" y="30">
    <Outline points="0 0, 6.2 -0.4, 6.8 8, 0.6 8.4">
      <Hole points="2 3,4 3,4 5,2 5"/>
    </Outline>
    <Storey height="9"/>
  </House>
</Houses>
"#;

fn origin(board: &Board, house: usize) -> [f64; 2] {
    let plan = board.plan();
    [0, 1].map(|k| plan["houses"][house]["origin"][k].as_f64().unwrap())
}

fn near(found: [f64; 2], wanted: [f64; 2]) {
    let far = (0..2).map(|k| (found[k] - wanted[k]).abs());
    assert!(far.sum::<f64>() < 1e-6, "{found:?}, not {wanted:?}");
}

fn draw(board: &mut Board, stroke: Value) {
    board.draw(&stroke).unwrap();
}

#[test]
fn the_plan_lists_what_can_be_moved() {
    let plan = Board::new(TOWN).plan();
    let kinds: Vec<&str> = (0..4)
        .map(|n| plan["places"][n]["kind"].as_str().unwrap())
        .collect();
    assert_eq!(kinds, ["Group", "Place", "Place", "House"]);
    assert_eq!(plan["places"][0]["houses"], json!([0, 1]));
    assert_eq!(plan["places"][1]["turn"], json!(90));
    assert_eq!(plan["places"][2]["fixed"], "computed");
    assert_eq!(
        plan["places"][3]["turn_fixed"], "outline",
        "an azimuth would change what it means"
    );
    assert_eq!(plan["outlines"][0]["corners"][2], json!([6.8, 8]));
    assert_eq!(plan["outlines"][0]["origin"], json!([0, 30]));
    assert_eq!(plan["outlines"][1]["corners"].as_array().unwrap().len(), 4);
}

#[test]
fn a_group_and_a_house_in_it_are_moved_and_turned_in_the_text() {
    let mut board = Board::new(TOWN);
    let before = origin(&board, 0);
    draw(
        &mut board,
        json!({"do": "move-place", "place": 0, "to": [3.25, 1]}),
    );
    assert!(
        board.text().contains(r#"<Group x="3.25" turn="90" y="1">"#),
        "{}",
        board.text()
    );
    near(origin(&board, 0), [before[0] + 1.25, before[1] + 1.0]);
    // In the frame of the group east points to the south.
    let before = origin(&board, 0);
    draw(
        &mut board,
        json!({"do": "move-place", "place": 1, "to": [7, 3]}),
    );
    assert!(board.text().contains(r#"type="hiraya" x="7" y="3""#));
    near(origin(&board, 0), [before[0], before[1] - 1.0]);
    draw(
        &mut board,
        json!({"do": "turn-place", "place": 0, "to": 270}),
    );
    assert!(board.text().contains(r#"turn="-90""#));
    draw(
        &mut board,
        json!({"do": "turn-place", "place": 1, "to": 365}),
    );
    assert!(
        board.text().contains(r#"depth="6" azimuth="5"/>"#),
        "{}",
        board.text()
    );
}

#[test]
fn what_is_computed_or_repeated_is_refused_with_a_reason() {
    let mut board = Board::new(TOWN);
    let why = board
        .draw(&json!({"do": "move-place", "place": 2, "to": [1, 1]}))
        .unwrap_err();
    assert!(why.contains("computed"), "{why}");
    let why = board
        .draw(&json!({"do": "move-place", "place": 0, "to": [2, 0]}))
        .unwrap_err();
    assert!(why.contains("changes nothing"), "{why}");
    for wrong in [
        json!({"do": "move-place", "place": 9, "to": [1, 1]}),
        json!({"do": "move-place", "place": 0, "to": [1e9, 1]}),
    ] {
        assert!(board.draw(&wrong).is_err());
    }
    let repeated =
        r#"<Houses><repeat num="2" index="i"><Place type="kura" x="{i * 9}"/></repeat></Houses>"#;
    let why = Board::new(repeated)
        .draw(&json!({"do": "turn-place", "place": 0, "to": 90}))
        .unwrap_err();
    assert!(why.contains("repeated"), "{why}");
}

#[test]
fn a_corner_of_an_outline_is_moved_in_the_text() {
    let mut board = Board::new(TOWN);
    draw(
        &mut board,
        json!({"do": "move-corner", "outline": 0, "corner": 2, "to": [7, 8.12345]}),
    );
    assert!(
        board.text().contains("6.2 -0.4, 7 8.123, 0.6 8.4"),
        "{}",
        board.text()
    );
    draw(
        &mut board,
        json!({"do": "move-corner", "outline": 1, "corner": 0, "to": [1.9, 3]}),
    );
    assert!(board.text().contains("1.9 3,4 3"));
    let why = board
        .draw(&json!({"do": "move-corner", "outline": 0, "corner": 0, "to": [20, 5]}))
        .unwrap_err();
    assert!(why.contains("do not cross"), "{why}");
    let mut closed =
        Board::new(r#"<House><Outline points="0 0 6 0 6 8 0 8 0 0"/><Storey height="9"/></House>"#);
    draw(
        &mut closed,
        json!({"do": "move-corner", "outline": 0, "corner": 0, "to": [-1, 0]}),
    );
    assert!(
        closed.text().contains(r#""-1 0 6 0 6 8 0 8 -1 0""#),
        "both ends move: {}",
        closed.text()
    );
}

#[test]
fn an_outline_is_drawn_in_metres() {
    let ring = json!([[0, 0], [6.2, -0.4], [6.8, 8], [0.6, 8.4]]);
    let stroke = json!({"do": "draw-outline", "points": ring});
    for text in [
        TOWN,
        "",
        "<House><Storey><Row>KSK  </Row></Storey></House>\n",
    ] {
        let mut board = Board::new(text);
        draw(&mut board, stroke.clone());
        assert!(
            board
                .text()
                .contains(r#"<Outline points="0 0, 6.2 -0.4, 6.8 8, 0.6 8.4"/>"#)
        );
    }
    let why = Board::new("0 0 180\n9\n\nKSK\n").draw(&stroke).unwrap_err();
    assert!(why.contains("convert"), "{why}");
    for wrong in [
        json!([[0, 0], [6, 0]]),
        json!([[0, 0], [6, 6], [6, 0], [0, 6]]),
        json!([[0, 0], [0.5, 0], [0, 0.5]]),
    ] {
        let why = Board::new("")
            .draw(&json!({"do": "draw-outline", "points": wrong}))
            .unwrap_err();
        assert!(why.contains("square metre"), "{why}");
    }
}

const LEGACY: &str = "# two houses\n2.5 3\n9\n\nKSK  KSK\nKSK\nKSK  KSK\nKSK\n%\nname kura\n\nKSK  KSK\nKSK\nKSK  KSK\nKSK\n%\nKSK  KSK\nKSK\nKSK  KSK\nKSK\n";

#[test]
fn houses_of_the_legacy_form_are_moved_and_turned_by_their_first_lines() {
    let mut board = Board::new(LEGACY);
    let places = &board.plan()["places"];
    assert_eq!(places.as_array().unwrap().len(), 3);
    assert_eq!(places[0]["at"], json!([2.5, 3]));
    assert_eq!(places[1]["heading"], json!(180));
    assert!(places[0]["fixed"].is_null() && places[2]["turn_fixed"].is_null());
    let strokes = [
        json!({"do": "move-place", "place": 0, "to": [-4, 3]}),
        json!({"do": "turn-place", "place": 0, "to": 90}),
        json!({"do": "move-place", "place": 1, "to": [0, 12.25]}),
        json!({"do": "turn-place", "place": 2, "to": -45}),
    ];
    for stroke in strokes {
        draw(&mut board, stroke);
    }
    let text = board.text();
    assert!(text.starts_with("# two houses\n-4 3 90\n9\n"), "{text}");
    assert!(text.contains("%\n0 12.25\nname kura\n"), "{text}");
    assert!(text.contains("%\n0 0 315\n\nKSK  KSK\n"), "{text}");
    near(origin(&board, 0), [-4.0, 3.0]);
    near(origin(&board, 1), [0.0, 12.25]);
    assert_eq!(board.plan()["houses"][2]["azimuth"], json!(315));
    assert!(
        board
            .draw(&json!({"do": "move-place", "place": 1, "to": [0, 12.25]}))
            .is_err(),
        "nothing to do"
    );
}

#[test]
fn a_first_line_with_a_mistake_stays_as_it_is() {
    let board = Board::new(&LEGACY.replace("2.5 3\n", "2.5 3 south\n"));
    let plan = board.plan();
    assert_eq!(plan["places"][0]["fixed"], "mistakes");
}
