//! Walls that slide and break, over every text of the repository.

#![allow(clippy::print_stdout)] // for those who look at what was refused

use super::bench::{At, Board, bare, corners, moved, outline, point, walls};
use crate::support;
use serde_json::{Value, json};

fn all() -> Vec<Board> {
    let folders = ["examples", "library"].into_iter();
    let texts = folders.flat_map(|folder| support::texts_in_turn(folder, 1));
    texts.map(|path| Board::open(&path)).collect()
}

/// What stands in storeys and rings other than one.
fn others(plan: &Value, at: &At) -> Value {
    let mut plan = bare(plan.clone());
    let house = &mut plan["houses"][at.house];
    house["roofs"] = Value::Null;
    for storey in house["storeys"].as_array_mut().unwrap() {
        storey["regions"] = Value::Null;
        for room in storey["rooms"].as_array_mut().unwrap() {
            // They follow the walls.
            (room["area"], room["laid"]) = (Value::Null, Value::Null);
        }
        for fixture in storey["fixtures"].as_array_mut().unwrap() {
            fixture["built"] = Value::Null;
        }
    }
    house["storeys"][at.storey]["rings"][at.ring] = Value::Null;
    plan
}

/// Looks that a stroke has made a ring what is expected and nothing else; the plan after it.
fn only_this(board: &Board, before: &Value, at: &At, expected: &[(f64, f64)]) -> Value {
    let (after, name) = (board.plan(), &board.name);
    assert_eq!(
        outline(&corners(at.ring(&after))),
        expected,
        "{name} {at:?}\n{}",
        board.text()
    );
    let same = others(&after, at) == others(before, at);
    assert!(same, "{name} {at:?}\n{}", board.text());
    after
}

/// What stands in a ring besides walls.
fn openings(ring: &Value) -> usize {
    let walls = ring["walls"].as_array().unwrap().iter();
    let units = walls.flat_map(|w| w["units"].as_array().unwrap());
    units.filter(|u| u["part"] != "wall").count()
}

#[test]
fn walls_move_out_and_back() {
    let (mut moves, mut back, mut fixed) = (0, 0, 0);
    for mut board in all() {
        let (plan, bytes) = (board.plan(), board.bytes.clone());
        for at in walls(&plan) {
            let wall = &at.ring(&plan)["walls"][at.wall];
            if at.ring(&plan)["inner"] == true && wall["fixed"].is_null() {
                continue; // see below
            }
            let there = board.draw(&at.stroke("move-wall", 1));
            if !wall["fixed"].is_null() {
                assert!(there.is_err(), "{} {at:?}", board.name);
                assert!(plan["reasons"][wall["fixed"].as_str().unwrap()].is_string());
                fixed += 1;
                continue;
            }
            if let Err(why) = there {
                panic!("{} {at:?}: {why}", board.name);
            }
            let expected = moved(at.ring(&plan), at.wall, 1.0);
            let after = only_this(&board, &plan, &at, &expected);
            let count = |plan: &Value| at.ring(plan)["walls"].as_array().unwrap().len();
            if count(&after) == count(&plan) {
                board.draw(&at.stroke("move-wall", -1)).unwrap();
                let (again, name) = (board.plan(), &board.name);
                assert!(
                    corners(at.ring(&again)) == corners(at.ring(&plan)),
                    "{name} {at:?}"
                );
                // Doors and windows that found no place are gone.
                let whole = openings(at.ring(&after)) == openings(at.ring(&plan));
                assert!(
                    !whole || bare(again) == bare(plan.clone()),
                    "{name} {at:?}\n{}",
                    board.text()
                );
                back += usize::from(whole);
            }
            moves += 1;
            board.bytes = bytes.clone();
        }
    }
    println!("{moves} walls moved, {back} back with every door; {fixed} fixed");
    assert!(back > 100, "{moves} walls moved, {back} back");
}

#[test]
fn walls_move_in() {
    let (mut moves, mut refused) = (0, vec![]);
    for mut board in all() {
        let (plan, bytes) = (board.plan(), board.bytes.clone());
        for at in walls(&plan) {
            let ring = at.ring(&plan);
            if !ring["walls"][at.wall]["fixed"].is_null() || ring["inner"] == true {
                continue;
            }
            match board.draw(&at.stroke("move-wall", -1)) {
                Ok(_) => {
                    let expected = moved(at.ring(&plan), at.wall, -1.0);
                    only_this(&board, &plan, &at, &expected);
                    moves += 1;
                }
                Err(why) => refused.push(format!("{} {at:?}: {why}", board.name)),
            }
            board.bytes = bytes.clone();
        }
    }
    println!("{moves} walls moved; refused:\n{}", refused.join("\n"));
    assert!(moves > 100);
}

#[test]
fn straight_walls_inside_move_as_a_whole() {
    let (mut moves, mut refused) = (0, vec![]);
    for mut board in all() {
        let (plan, bytes) = (board.plan(), board.bytes.clone());
        for at in walls(&plan) {
            let ring = at.ring(&plan);
            if ring["inner"] != true || !ring["walls"][at.wall]["fixed"].is_null() {
                continue;
            }
            for by in [1, -1] {
                if let Err(why) = board.draw(&at.stroke("move-wall", by)) {
                    refused.push(format!("{} {at:?}: {why}", board.name));
                    continue;
                }
                let after = board.plan();
                let ends = |plan: &Value| {
                    let wall = &at.ring(plan)["walls"][at.wall];
                    [point(&wall["from"]), point(&wall["to"])]
                };
                let ([from, to], long) =
                    (ends(&plan), |x: f64| x.signum() * f64::from(x.abs() > 0.5));
                let (a, b) = (long(to.1 - from.1), -long(to.0 - from.0));
                let by = by as f64;
                let expected = [from, to].map(|p| (p.0 + a * by, p.1 + b * by));
                assert_eq!(ends(&after), expected, "{}", board.text());
                assert!(
                    others(&after, &at) == others(&plan, &at),
                    "{}",
                    board.text()
                );
                moves += 1;
                board.bytes = bytes.clone();
            }
        }
    }
    println!("{moves} walls moved; refused:\n{}", refused.join("\n"));
    assert!(moves > 3, "{moves}: {}", refused.join("\n"));
}

/// The corners of a ring with a part of one wall pushed out.
fn broken(ring: &Value, wall: usize, part: (f64, f64), by: f64) -> Vec<(f64, f64)> {
    let all = corners(ring);
    let (from, to) = (all[wall], all[(wall + 1) % all.len()]);
    let length = ((to.0 - from.0).powi(2) + (to.1 - from.1).powi(2)).sqrt();
    let along = ((to.0 - from.0) / length, (to.1 - from.1) / length);
    let out = (along.1 * by, -along.0 * by);
    let at = |s: f64, t: f64| {
        (
            from.0 + along.0 * s + out.0 * t,
            from.1 + along.1 * s + out.1 * t,
        )
    };
    let mut new = vec![];
    for (i, corner) in all.iter().enumerate() {
        new.push(*corner);
        if i == wall {
            new.extend([
                at(part.0, 0.0),
                at(part.0, 1.0),
                at(part.1, 1.0),
                at(part.1, 0.0),
            ]);
        }
    }
    new.dedup();
    if new.first() == new.last() {
        new.pop();
    }
    outline(&new)
}

#[test]
fn walls_break() {
    let (mut breaks, mut refused) = (0, vec![]);
    for mut board in all() {
        let (plan, bytes) = (board.plan(), board.bytes.clone());
        for (number, at) in walls(&plan).into_iter().enumerate() {
            let wall = &at.ring(&plan)["walls"][at.wall];
            let (from, to) = (
                super::bench::point(&wall["from"]),
                super::bench::point(&wall["to"]),
            );
            let length = ((to.0 - from.0).abs() + (to.1 - from.1).abs()).round() as i64;
            let parts = [(0, 1), (1, length - 1), (length - 1, length), (1, 2)];
            let (part, by) = (parts[number % 4], if number % 3 == 0 { -1 } else { 1 });
            if !wall["fixed"].is_null() || part.0 >= part.1 || length < 2 {
                continue;
            }
            let mut stroke = at.stroke("break-wall", by);
            (stroke["from"], stroke["to"]) = (json!(part.0), json!(part.1));
            match board.draw(&stroke) {
                Ok(_) => {
                    let part = (part.0 as f64, part.1 as f64);
                    let expected = broken(at.ring(&plan), at.wall, part, by as f64);
                    only_this(&board, &plan, &at, &expected);
                    breaks += 1;
                }
                Err(why) => refused.push(format!("{} {at:?} {part:?} {by}: {why}", board.name)),
            }
            board.bytes = bytes.clone();
        }
    }
    println!("{breaks} walls broken; refused:\n{}", refused.join("\n"));
    assert!(breaks > 60);
}

#[test]
fn walls_of_facades_move() {
    let floors = |ground: &str, upper: &str| {
        format!("<Facade><Floor id=\"g\">{ground}</Floor><Floor id=\"u\">{upper}</Floor></Facade>")
    };
    for order in ["left", "right"] {
        let text = format!(
            "<Structure order=\"{order}\"><Facades>\n{}\n{}\n{}\n{}\n</Facades></Structure>\n",
            floors("NTI  NAD 2KSK  KSK", "NTI  NTI  NTI  NTI  NTI"),
            floors(
                "NTI  KSK  KSK",
                "<Part code=\"NTI\"/><!-- corner --><Part code=\"KSK\"/><Part code=\"NTI\"/>"
            ),
            floors(
                "KSK  KSK  KSK  KSK  NTI",
                "<repeat num=\"5\"><Part code=\"KSK\"/></repeat>"
            ),
            floors("KSK  NTI  KSK", "NTI  KSK  KSK"),
        );
        for (storey, wall) in [(0, 1), (0, 2), (1, 1), (1, 2)] {
            let mut board = Board::new(&text);
            let plan = board.plan();
            let at = At {
                house: 0,
                storey,
                ring: 0,
                wall,
            };
            assert_eq!(
                at.ring(&plan)["walls"][wall]["fixed"],
                Value::Null,
                "{order}"
            );
            for by in [2, -1] {
                let (plan, before) = (board.plan(), board.text());
                board.draw(&at.stroke("move-wall", by)).unwrap();
                let expected = moved(at.ring(&plan), wall, by as f64);
                let after = only_this(&board, &plan, &at, &expected);
                // What stood at the far end of the neighbours stays there.
                for (beside, far) in [((wall + 3) % 4, 0), ((wall + 1) % 4, 1)] {
                    let end = |plan: &Value| {
                        let units = at.ring(plan)["walls"][beside]["units"].clone();
                        let units = units.as_array().unwrap().clone();
                        units[if far == 0 { 0 } else { units.len() - 1 }]["code"].clone()
                    };
                    assert_eq!(
                        end(&plan),
                        end(&after),
                        "{order} {storey} {wall} {by}\n{before}"
                    );
                }
            }
            let broken = json!({"do": "break-wall", "house": 0, "storey": storey, "ring": 0, "wall": wall,
                "from": 1, "to": 2, "by": 1});
            assert!(board.draw(&broken).unwrap_err().contains("Facade"));
        }
        // The walk of all floors begins at one corner.
        let plan = Board::new(&text).plan();
        for wall in [0, 3] {
            let walls = &plan["houses"][0]["storeys"][0]["rings"][0]["walls"];
            assert_eq!(walls[wall]["fixed"], "first");
        }
    }
}

/// A bay does not widen the roof, and a wall that is moved after it takes the roof's edge along.
#[test]
fn roofs_stay_over_bays_and_follow_walls() {
    let mut board = Board::open("examples/machiya.hsd".as_ref());
    let roof = "K X  14.0 KIR   0   0   6   8  P4.0";
    board
        .draw(&json!({"do": "break-wall", "house": 0, "storey": 1, "ring": 0, "wall": 1, "from": 3, "to": 4, "by": 1}))
        .unwrap();
    assert!(board.text().contains(roof), "{}", board.text());
    // The front of both storeys; the bay is at the side.
    board
        .draw(&json!({"do": "move-wall", "house": 0, "storey": 1, "ring": 0, "wall": 0, "by": 1, "storeys": "all"}))
        .unwrap();
    let text = board.text();
    assert!(
        text.contains("K X  14.0 KIR   0  -1   6   8  P4.0"),
        "{text}"
    );
    assert!(
        text.contains("K F   8.1 HIS   0  -1   6  -2  P3.0"),
        "{text}"
    );
}

/// What stands but once is not taken for what is repeated.
#[test]
fn doors_stay_where_a_repetition_can_be_shorter() {
    for (wall, by) in [(1, -1), (3, -1)] {
        let mut board = Board::open("examples/court-house.hsd".as_ref());
        board
            .draw(&json!({"do": "move-wall", "house": 0, "storey": 0, "ring": 0, "wall": wall, "by": by}))
            .unwrap();
        assert!(
            board.text().contains("<Part code=\"TKD 2\"/>"),
            "{}",
            board.text()
        );
    }
}
