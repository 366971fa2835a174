//! Houses one by one: who has some of a model is handed the others.

use super::{Files, Shown, show};
use crate::support::png;
use serde_json::{Value, json};
use std::fs;

const WALLS: [&str; 4] = [
    "KKS  TKD 2MRE",
    "KSK  MRE  KSK",
    "KKS  TIT 2KKS",
    "KSK  KSK  KSK",
];

/// A street of houses with these codes in the front wall.
fn street(fronts: &[&str]) -> String {
    let house = |(i, front): (usize, &&str)| {
        let [_, others @ ..] = WALLS;
        let walls = [&[*front], &others[..]].concat();
        let rows: String = walls.iter().map(|w| format!("<Row>{w}</Row>")).collect();
        format!(
            "<House x=\"{}\"><Storey height=\"9\">{rows}</Storey></House>\n",
            i * 6
        )
    };
    let houses: String = fronts.iter().enumerate().map(house).collect();
    format!("<Houses>\n{houses}</Houses>\n")
}

/// What a page learns of `a.hsd`.
struct Known {
    state: Value,
    keys: Vec<String>,
}

fn known(shown: &Shown) -> Known {
    let state = shown.web.state("a.hsd");
    let keys = state["houses"].as_array().expect("is a list").iter();
    let keys = keys.map(|house| house[0].as_str().expect("is text").to_owned());
    Known {
        keys: keys.collect(),
        state,
    }
}

/// What somebody is handed who had these houses.
enum Handed {
    Whole,
    /// Where everything is written, and the numbers of the houses and the document of them.
    Others(Vec<[u32; 3]>, Vec<u32>, Value),
}

fn handed(shown: &Shown, now: &Known, had: &[String]) -> Handed {
    let asks = json!({ "file": "a.hsd", "revision": now.state["revision"], "had": had });
    let answer = shown.web.post("/api/houses", &asks);
    assert_eq!(answer.status, 200, "{}", answer.text());
    if answer.headers.contains("model/gltf-binary") {
        assert!(answer.body.starts_with(b"glTF"));
        return Handed::Whole;
    }
    let body = &answer.body;
    let number = |at: usize| {
        let four = body[at..at + 4].try_into().expect("four bytes");
        u32::from_le_bytes(four)
    };
    let count = number(0) as usize;
    let place = |n: usize| [0, 4, 8].map(|offset| number(4 + 12 * n + offset));
    let places = (0..count).map(place).collect();
    let lacks = 4 + 12 * count;
    let end = lacks + 4 + 4 * number(lacks) as usize;
    let houses: Vec<u32> = (lacks + 4..end).step_by(4).map(number).collect();
    let document = match houses.is_empty() {
        true => Value::Null,
        false => document(&body[end..]),
    };
    assert_eq!(houses.is_empty(), end == body.len());
    Handed::Others(places, houses, document)
}

fn document(glb: &[u8]) -> Value {
    let (header, rest) = glb.split_at(20);
    assert_eq!(&header[..4], b"glTF");
    let length = u32::from_le_bytes(header[12..16].try_into().expect("four bytes"));
    serde_json::from_slice(&rest[..length as usize]).expect("is JSON")
}

/// Where each node of a document is written.
fn places_in(document: &Value) -> Vec<[u32; 3]> {
    let nodes = document["nodes"].as_array().expect("are there").iter();
    let place = |node: &Value| {
        let Some(span) = node["extras"]["span"].as_array() else {
            return [u32::MAX, 0, 0];
        };
        let number = |v: &Value| v.as_u64().expect("is a number") as u32;
        let file = node["extras"]["file"].as_u64().unwrap_or_default();
        [file as u32, number(&span[0]), number(&span[1])]
    };
    nodes.map(place).collect()
}

fn others(handed: Handed) -> (Vec<[u32; 3]>, Vec<u32>, Value) {
    match handed {
        Handed::Others(places, houses, document) => (places, houses, document),
        Handed::Whole => panic!("the whole model is handed out"),
    }
}

#[test]
fn only_the_house_that_has_changed_is_handed_out() {
    let shown = show(
        &[("a.hsd", &street(&[WALLS[0]; 4]))],
        None,
        Files::default(),
    );
    let before = known(&shown);
    assert_eq!(before.keys.len(), 4);
    let ear = shown.web.listen("a.hsd");
    ear.hear();
    let fronts = [WALLS[0], WALLS[0], "KSK  TKD 2MRE", WALLS[0]];
    shown.save("a.hsd", &street(&fronts));
    ear.hear();
    let now = known(&shown);
    let same: Vec<bool> = (0..4).map(|i| now.keys[i] == before.keys[i]).collect();
    assert_eq!(same, [true, true, false, true]);
    let (places, houses, house) = others(handed(&shown, &now, &before.keys));
    let whole = shown.web.get(&format!(
        "/api/model/{}/house.glb?file=a.hsd",
        now.state["revision"]
    ));
    let whole = document(&whole.body);
    assert_eq!(places, places_in(&whole));
    assert_eq!(houses, [2]);
    let names = |document: &Value, list: &str| -> Vec<Value> {
        let all = document[list].as_array().expect("are there").iter();
        all.map(|one| one["name"].clone()).collect()
    };
    // Its nodes are those of the whole, under the same names of pictures and materials.
    let roots = whole["scenes"][0]["nodes"].as_array().expect("are there");
    let first = roots[2].as_u64().expect("is a number") as usize;
    let nodes = names(&house, "nodes");
    assert_eq!(nodes, names(&whole, "nodes")[first..first + nodes.len()]);
    assert_eq!(house["images"], whole["images"]);
    assert_eq!(names(&house, "materials"), names(&whole, "materials"));
    let bytes = |document: &Value| document["buffers"][0]["byteLength"].as_u64();
    assert!(bytes(&house) <= bytes(&whole));
}

#[test]
fn what_only_moves_in_the_text_is_not_read_again() {
    let text = street(&[WALLS[0]; 3]);
    let shown = show(&[("a.hsd", &text)], None, Files::default());
    let before = known(&shown);
    let (places, none, _) = others(handed(&shown, &before, &before.keys));
    assert!(none.is_empty());
    let ear = shown.web.listen("a.hsd");
    ear.hear();
    let comment = "<!-- 通り -->\n";
    shown.save("a.hsd", &format!("{comment}{text}"));
    ear.hear();
    let now = known(&shown);
    assert_eq!(now.keys, before.keys);
    let (moved, none, _) = others(handed(&shown, &now, &before.keys));
    assert!(none.is_empty());
    let by = comment.len() as u32;
    let shifted: Vec<[u32; 3]> = places
        .iter()
        .map(|&[file, start, end]| match file {
            u32::MAX => [file, start, end],
            _ => [file, start + by, end + by],
        })
        .collect();
    assert_eq!(moved, shifted);
}

#[test]
fn who_has_none_of_the_houses_is_handed_the_whole() {
    let fronts = [WALLS[0], "MRE  TKD 2KSK", WALLS[0], "KKS  KKS  KKS"];
    let shown = show(&[("a.hsd", &street(&fronts))], None, Files::default());
    let now = known(&shown);
    for had in [vec![], vec!["other".to_owned()]] {
        assert!(matches!(handed(&shown, &now, &had), Handed::Whole));
    }
    let (places, two, document) = others(handed(&shown, &now, &now.keys[1..3]));
    assert_eq!(two, [0, 3]);
    // Both in one model, each with its own nodes, and what they share once.
    let roots = document["scenes"][0]["nodes"].as_array();
    assert_eq!(roots.map(Vec::len), Some(2));
    let written: Vec<[u32; 3]> = places_in(&document);
    assert!(written.len() < places.len());
    assert_eq!(places[..3], written[..3]);
    assert_eq!(places[places.len() - 3..], written[written.len() - 3..]);
    let asks = json!({ "file": "a.hsd", "revision": 0, "had": [] });
    assert_eq!(shown.web.post("/api/houses", &asks).status, 410);
}

#[test]
fn houses_that_are_alike_in_everything_have_keys_of_their_own() {
    let house = street(&[WALLS[0]]);
    let one = house.lines().nth(1).expect("is a house");
    let text = format!("<Houses>{one}{one}{one}</Houses>");
    let shown = show(&[("a.hsd", &text)], None, Files::default());
    let mut keys = known(&shown).keys;
    keys.sort();
    keys.dedup();
    assert_eq!(keys.len(), 3);
}

#[test]
fn a_house_is_another_when_its_picture_is() {
    let fronts = [WALLS[0], "SIGN1KKS  KKS  KKS"];
    let shown = show(&[("a.hsd", &street(&fronts))], None, Files::default());
    let picture = shown.folder.path().join("SIGN1.png");
    let ear = shown.web.listen("a.hsd");
    ear.hear();
    let mut keys = vec![];
    for side in [8, 16] {
        // Put in place at once, so that it is told once.
        let new = shown.folder.path().join("new");
        fs::write(&new, png(side, side)).expect("can be written");
        fs::rename(new, &picture).expect("can be renamed");
        while ear.hear().0 != "state" {} // there are other files, too
        let now = known(&shown);
        assert_eq!(
            now.state["diagnostics"],
            json!([]),
            "{}",
            now.state["diagnostics"]
        );
        keys.push(now.keys);
    }
    let [before, now] = &keys[..] else {
        unreachable!("two pictures were written");
    };
    assert_eq!(now[0], before[0]);
    assert_ne!(now[1], before[1]);
}
