//! Storeys and houses that come and go, heights, and roofs that follow.

#![allow(clippy::print_stdout)] // for those who look at what was refused

use super::bench::{Board, bare, corners, errors, outline};
use crate::support;
use serde_json::{Value, json};

fn storeys(plan: &Value, house: usize) -> Vec<Value> {
    plan["houses"][house]["storeys"].as_array().unwrap().clone()
}

/// On every house of every text a storey, and away again.
#[test]
fn storeys_come_and_go() {
    let (mut added, mut refused) = (0, vec![]);
    for folder in ["examples", "library"] {
        for path in support::texts(folder) {
            let mut board = Board::open(&path);
            let (plan, bytes) = (board.plan(), board.bytes.clone());
            for (house, own) in plan["houses"].as_array().unwrap().iter().enumerate() {
                let stroke = json!({"do": "add-storey", "house": house, "height": 8.5});
                let before = storeys(&plan, house);
                match board.draw(&stroke) {
                    Ok(_) => {
                        assert!(own["fixed"].is_null(), "{} {house}", board.name);
                        let after = storeys(&board.plan(), house);
                        assert_eq!(after.len(), before.len() + 1, "{}", board.name);
                        let (top, new) = (&before[before.len() - 1], &after[before.len()]);
                        assert_eq!(new["height"], 8.5, "{}\n{}", board.name, board.text());
                        let first = |s: &Value| outline(&corners(&s["rings"][0]));
                        assert_eq!(first(new), first(top), "{}\n{}", board.name, board.text());
                        let stroke =
                            json!({"do": "remove-storey", "house": house, "storey": before.len()});
                        board.draw(&stroke).unwrap();
                        assert!(
                            bare(board.plan()) == bare(plan.clone()),
                            "{}\n{}",
                            board.name,
                            board.text()
                        );
                        added += 1;
                        board.bytes = bytes.clone();
                    }
                    Err(why) => refused.push(format!("{} {house}: {why}", board.name)),
                }
            }
        }
    }
    println!("{added} storeys added; refused:\n{}", refused.join("\n"));
    assert!(added > 12, "{added}");
}

#[test]
fn ground_floors_go() {
    let mut board = Board::open("examples/machiya.hsd".as_ref());
    let upper = storeys(&board.plan(), 0)[1].clone();
    board
        .draw(&json!({"do": "remove-storey", "house": 0, "storey": 0}))
        .unwrap();
    let left = storeys(&board.plan(), 0);
    assert_eq!(left.len(), 1);
    assert_eq!(left[0]["height"], upper["height"]);
    let text = board.text();
    assert!(
        text.contains("0 0 180\n5.0\n") && !text.contains('^'),
        "{text}"
    );
    assert!(text.contains("K X   5.0 KIR"), "{text}");
    assert!(
        board
            .draw(&json!({"do": "remove-storey", "house": 0, "storey": 0}))
            .is_err()
    );
}

#[test]
fn heights_change_where_they_are_written() {
    let mut board = Board::open("examples/machiya.hsd".as_ref());
    let old = board.text();
    board
        .draw(&json!({"do": "set-height", "house": 0, "storey": 1, "height": 6.5}))
        .unwrap();
    let new = old
        .replace("\n9.0 5.0\n", "\n9.0 6.5\n")
        .replace("14.0 KIR", "15.5 KIR");
    assert_eq!(board.text(), new);
    // Heights that nobody wrote.
    let mut board = Board::new("0 0 180\n\nKSK\nKSK\nKSK\nKSK ^\nKSK\nKSK\nKSK\nKSK");
    let set = |storey: usize, height: f64| json!({"do": "set-height", "house": 0, "storey": storey, "height": height});
    board.draw(&set(1, 7.0)).unwrap();
    assert!(
        board.text().starts_with("0 0 180\n9 7\n\n"),
        "{}",
        board.text()
    );
    board.draw(&set(0, 10.25)).unwrap();
    assert!(board.text().starts_with("0 0 180\n10.25 7\n\n"));
    assert!(board.draw(&set(0, 0.0)).is_err());
    assert!(board.draw(&set(0, 10.25)).is_err());
    assert!(board.draw(&set(2, 9.0)).is_err());
    let mut board = Board::new(
        "<House><Storey><Row>KSK</Row><Row>KSK</Row><Row>KSK</Row><Row>KSK</Row></Storey></House>",
    );
    board.draw(&set(0, 9.5)).unwrap();
    assert!(
        board
            .text()
            .starts_with("<House><Storey height=\"9.5\"><Row>")
    );
    let mut board = Board::open("examples/param-machiya.hsd".as_ref());
    assert!(
        board.draw(&set(0, 9.5)).is_err(),
        "its height is a parameter"
    );
}

#[test]
fn roofs_follow_the_walls_that_they_lay_on() {
    let wall = |storey: usize, wall: usize, storeys: &str| json!({"do": "move-wall", "house": 0, "storey": storey, "ring": 0, "wall": wall, "by": 2, "storeys": storeys});
    let roofs = |board: &Board| {
        let text = board.text();
        let lines = text.lines().skip_while(|l| !l.starts_with("K X"));
        lines.map(str::to_owned).collect::<Vec<String>>()
    };
    // The back wall of the upper storey: the gable roof alone.
    let mut board = Board::open("examples/machiya.hsd".as_ref());
    board.draw(&wall(1, 2, "one")).unwrap();
    assert_eq!(
        roofs(&board)[0],
        "K X  14.0 KIR   0   0   6  10  P4.0 E2.5 G0.5 M3"
    );
    // The front of the ground floor takes the pent roof along; the upper one keeps its place and its roof.
    let mut board = Board::open("examples/machiya.hsd".as_ref());
    board.draw(&wall(0, 0, "one")).unwrap();
    let lines = roofs(&board);
    assert_eq!(lines[0], "K X  14.0 KIR   0   0   6   8  P4.0 E2.5 G0.5 M3");
    assert_eq!(lines[1], "K F   8.1 HIS   0  -2   6  -3  P3.0");
    // The left side of all storeys: everything becomes wider.
    let mut board = Board::open("examples/machiya.hsd".as_ref());
    board.draw(&wall(0, 1, "all")).unwrap();
    let lines = roofs(&board);
    assert_eq!(lines[0], "K X  14.0 KIR   0   0   8   8  P4.0 E2.5 G0.5 M3");
    assert_eq!(lines[1], "K F   8.1 HIS   0   0   8  -1  P3.0");
    let plan = board.plan();
    for storey in storeys(&plan, 0) {
        let expected = [(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)];
        assert_eq!(outline(&corners(&storey["rings"][0])), outline(&expected));
    }
}

const L: &str = "[[2,1],[2,5],[4,5],[4,3],[8,3],[8,1]]";

#[test]
fn houses_are_drawn() {
    let shape: Value = serde_json::from_str(L).unwrap();
    let draw = |board: &mut Board, house: Option<usize>| {
        board.draw(&json!({"do": "draw-house", "outline": shape, "height": 9.5, "house": house}))
    };
    let l = outline(&[
        (0.0, 0.0),
        (6.0, 0.0),
        (6.0, 2.0),
        (2.0, 2.0),
        (2.0, 4.0),
        (0.0, 4.0),
    ]);
    for text in ["", "\r\n", "# nothing yet", "<Houses>\n</Houses>\n"] {
        let mut board = Board::new(text);
        draw(&mut board, None).unwrap();
        let plan = board.plan();
        assert_eq!(
            outline(&corners(&plan["houses"][0]["storeys"][0]["rings"][0])),
            l,
            "{}",
            board.text()
        );
        assert_eq!(plan["houses"][0]["origin"], json!([-1.818182, 0.909091, 0]));
        assert!(errors(&board.analysis()).is_empty(), "{}", board.text());
        let front = &plan["houses"][0]["storeys"][0]["rings"][0]["walls"][0];
        assert_eq!(front["to"], json!([6, 0]));
        assert_eq!(front["units"][2]["part"], "door");
    }
    for name in ["machiya", "hiraya", "kanban", "years", "pagoda", "tea-shop"] {
        let mut board = Board::open(format!("examples/{name}.hsd").as_ref());
        let before = board.plan();
        let count = before["houses"].as_array().unwrap().len();
        draw(&mut board, Some(0)).unwrap();
        let mut after = board.plan();
        let houses = after["houses"].as_array_mut().unwrap();
        assert_eq!(houses.len(), count + 1, "{name}");
        let new = houses.remove(count);
        assert_eq!(outline(&corners(&new["storeys"][0]["rings"][0])), l);
        assert!(
            bare(after)["houses"] == bare(before)["houses"],
            "{name}: {}",
            board.text()
        );
        let stroke = json!({"do": "remove-house", "house": count});
        board.draw(&stroke).unwrap();
        assert_eq!(
            board.plan()["houses"].as_array().unwrap().len(),
            count,
            "{name}"
        );
    }
    let mut board = Board::open("examples/office.hsd".as_ref());
    assert!(draw(&mut board, None).is_err());
}

#[test]
fn houses_stand_in_the_frame_of_others() {
    let text = "10 20 270\n9\nunit 3.3\n\nKSK\nKSK\nKSK\nKSK\n";
    let mut board = Board::new(text);
    let square = json!([[3, 4], [5, 4], [5, 6], [3, 6]]);
    board
        .draw(&json!({"do": "draw-house", "outline": square, "house": 0}))
        .unwrap();
    let plan = board.plan();
    let house = &plan["houses"][1];
    // The front looks to the west: what lies 3 U to the left lies to the north then, and 4 U back to the east.
    assert_eq!(
        (&house["azimuth"], &house["unit_m"]),
        (&json!(270), &json!(1))
    );
    assert_eq!(house["origin"], json!([14, 23, 0]));
}

#[test]
fn bad_outlines_are_refused() {
    let outlines = [
        "[]",
        "[[0,0],[1,0],[1,1]]",
        "[[0,0],[0,0],[0,0],[0,0]]",
        "[[0,0],[4,1],[4,4],[0,4]]",
        "[[0,0],[1.5,0],[1.5,2],[0,2]]",
        "[[0,0],[4,0],[4,4],[2,4],[2,-1],[0,-1]]",
        "[[0,0],[2000,0],[2000,1],[0,1]]",
        "[[0,0],[1e300,0],[1e300,1],[0,1]]",
        "[[0,0],[2,0],[2,2],[4,2],[4,4],[2,4],[2,2],[0,2]]",
    ];
    for outline in outlines {
        let outline: Value = serde_json::from_str(outline).unwrap();
        let stroke = json!({"do": "draw-house", "outline": outline});
        assert!(Board::new("").draw(&stroke).is_err(), "{outline}");
        let stroke = json!({"do": "add-storey", "house": 0, "outline": outline});
        let mut board = Board::open("examples/hiraya.hsd".as_ref());
        assert!(board.draw(&stroke).is_err(), "{outline}");
    }
}

#[test]
fn upper_storeys_are_drawn_within_the_lower() {
    for name in ["l-house", "court-house"] {
        let mut board = Board::open(format!("examples/{name}.hsd").as_ref());
        let stroke = |outline: Value| json!({"do": "add-storey", "house": 0, "height": 8, "outline": outline});
        let inside = json!([[1, 1], [3, 1], [3, 3], [1, 3]]);
        board.draw(&stroke(inside)).unwrap();
        let plan = board.plan();
        let expected = [(1.0, 1.0), (3.0, 1.0), (3.0, 3.0), (1.0, 3.0)];
        let ring = &storeys(&plan, 0)[1]["rings"][0];
        assert_eq!(
            outline(&corners(ring)),
            outline(&expected),
            "{}",
            board.text()
        );
        let beyond = json!([[0, 0], [30, 0], [30, 2], [0, 2]]);
        assert!(board.draw(&stroke(beyond)).is_err());
    }
    // Over the court there is nothing to stand on.
    let mut board = Board::open("examples/court-house.hsd".as_ref());
    let over =
        json!({"do": "add-storey", "house": 0, "outline": [[2, 2], [12, 2], [12, 10], [2, 10]]});
    assert!(board.draw(&over).is_err());
}

/// A roof whose height is computed would stay behind.
#[test]
fn storeys_under_computed_roofs_are_refused() {
    for stroke in [
        json!({"do": "add-storey", "house": 0, "height": 8.5}),
        json!({"do": "remove-storey", "house": 0, "storey": 1}),
    ] {
        let mut board = Board::open("examples/param-machiya.hsd".as_ref());
        let before = board.text();
        let why = board.draw(&stroke).unwrap_err();
        assert!(why.contains("computed"), "{why}");
        assert_eq!(board.text(), before);
    }
}
