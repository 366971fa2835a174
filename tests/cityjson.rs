//! Towns as CityJSON 2.0 and CityJSONSeq, held against the rules of the specification: https://www.cityjson.org/specs/2.0.1/

use crate::town_types::{hsd, said, town, write_map};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;

/// The surfaces that a building may have, of those that are written.
const SURFACES: [&str; 5] = [
    "WallSurface",
    "RoofSurface",
    "GroundSurface",
    "Door",
    "Window",
];

/// Writes a town of houses to a file of this name; returns its text.
fn written(name: &str, more: &[&str]) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    write_map(folder.path());
    let place = r#"<Place type="house" storeys="2" evidence="drawn &quot;here&quot;"/>"#;
    fs::write(folder.path().join("t.hsd"), town(place)).expect("is written");
    let words = [&["town", "t.hsd", "-o", name][..], more].concat();
    let run = hsd(folder.path(), &words);
    assert!(run.status.success(), "{}", said(&run));
    fs::read_to_string(folder.path().join(name)).expect("is there")
}

fn corner(value: &Value) -> [i64; 3] {
    let all = value.as_array().expect("a corner");
    assert_eq!(all.len(), 3);
    [0, 1, 2].map(|k| all[k].as_i64().expect("whole millimetres"))
}

/// The rings of a surface.
fn rings(surface: &Value) -> Vec<Vec<usize>> {
    let number = |v: &Value| v.as_u64().expect("a number of a vertex") as usize;
    let ring = |v: &Value| v.as_array().expect("a ring").iter().map(number).collect();
    surface
        .as_array()
        .expect("a surface")
        .iter()
        .map(ring)
        .collect()
}

/// Checks that a shell is closed: each edge is passed once in each direction; returns its volume, cubic metres.
fn volume(shell: &[Value], corners: &[[i64; 3]]) -> f64 {
    let mut edges: BTreeMap<(usize, usize), i32> = BTreeMap::new();
    let mut six = 0.0;
    for ring in shell.iter().flat_map(rings) {
        for k in 0..ring.len() {
            *edges
                .entry((ring[k], ring[(k + 1) % ring.len()]))
                .or_default() += 1;
        }
        let at = |n: usize| corners[n].map(|x| x as f64 / 1000.0);
        for k in 1..ring.len() - 1 {
            let [a, b, c] = [ring[0], ring[k], ring[k + 1]].map(at);
            six += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                + a[2] * (b[0] * c[1] - b[1] * c[0]);
        }
    }
    for ((a, b), count) in &edges {
        assert_eq!(
            (*count, edges.get(&(*b, *a))),
            (1, Some(&1)),
            "edge {a} {b}"
        );
    }
    six / 6.0
}

/// Checks a building; returns its levels of detail and the vertices that it uses.
fn checked(object: &Value, corners: &[[i64; 3]]) -> (Vec<String>, BTreeSet<usize>) {
    assert_eq!(object["type"], "Building");
    let attributes = &object["attributes"];
    assert_eq!(attributes["type"], "house");
    assert_eq!(attributes["storeysAboveGround"], 2);
    assert_eq!(attributes["evidence"], "drawn \"here\"");
    assert_eq!(attributes["line"], 3);
    let (mut lods, mut used) = (vec![], BTreeSet::new());
    for geometry in object["geometry"].as_array().expect("geometry") {
        lods.push(geometry["lod"].as_str().expect("a text").to_owned());
        let boundaries = geometry["boundaries"].as_array().expect("boundaries");
        let surfaces = match geometry["type"].as_str() {
            Some("Solid") => {
                let shell = boundaries[0].as_array().expect("a shell");
                assert!(volume(shell, corners) > 50.0);
                shell
            }
            Some("MultiSurface") => {
                let of = &geometry["semantics"];
                let kinds = of["surfaces"].as_array().expect("surfaces");
                let values = of["values"].as_array().expect("values");
                assert_eq!(values.len(), boundaries.len());
                assert!(
                    kinds
                        .iter()
                        .all(|k| SURFACES.contains(&k["type"].as_str().unwrap()))
                );
                let known = |v: &Value| (v.as_u64().unwrap() as usize) < kinds.len();
                assert!(values.iter().all(known));
                let has = |kind: &str| kinds.iter().any(|k| k["type"] == kind);
                assert!(has("RoofSurface") && has("WallSurface"), "{kinds:?}");
                assert_eq!(has("Door"), geometry["lod"] == "3", "{kinds:?}");
                boundaries
            }
            other => panic!("{other:?}"),
        };
        for ring in surfaces.iter().flat_map(rings) {
            assert!(ring.len() >= 3 && ring.iter().all(|n| *n < corners.len()));
            used.extend(ring);
        }
    }
    (lods, used)
}

#[test]
fn a_city_is_one_object() {
    let city: Value = serde_json::from_str(&written("t.city.json", &[])).expect("is JSON");
    assert_eq!(city["type"], "CityJSON");
    assert_eq!(city["version"], "2.0");
    assert!(
        city.get("metadata").is_none(),
        "local metres have no system"
    );
    let scale = city["transform"]["scale"].as_array().expect("a scale");
    assert!(scale.iter().all(|s| s.as_f64() == Some(0.001)));
    let corners: Vec<[i64; 3]> = city["vertices"]
        .as_array()
        .unwrap()
        .iter()
        .map(corner)
        .collect();
    let objects = city["CityObjects"].as_object().expect("objects");
    assert_eq!(objects.len(), 4);
    let mut used = BTreeSet::new();
    for object in objects.values() {
        let (lods, own) = checked(object, &corners);
        assert_eq!(lods, ["1", "2", "3"]);
        used.extend(own);
    }
    assert_eq!(used.len(), corners.len(), "every vertex is used");
    let unlike: BTreeSet<&[i64; 3]> = corners.iter().collect();
    assert_eq!(unlike.len(), corners.len(), "no vertex stands twice");
}

#[test]
fn a_sequence_has_a_line_for_each_house() {
    let text = written("t.city.jsonl", &["--detail", "0"]);
    let mut lines = text
        .lines()
        .map(|l| serde_json::from_str::<Value>(l).expect("is JSON"));
    let head = lines.next().expect("a head");
    assert_eq!(
        (&head["type"], &head["version"]),
        (&"CityJSON".into(), &"2.0".into())
    );
    assert_eq!(head["CityObjects"], serde_json::json!({}));
    let mut ids = BTreeSet::new();
    for line in lines {
        assert_eq!(line["type"], "CityJSONFeature");
        let id = line["id"].as_str().expect("an id");
        let corners: Vec<[i64; 3]> = line["vertices"]
            .as_array()
            .unwrap()
            .iter()
            .map(corner)
            .collect();
        let (lods, used) = checked(&line["CityObjects"][id], &corners);
        assert_eq!(lods, ["1", "2"]);
        assert_eq!(used.len(), corners.len());
        ids.insert(id.to_owned());
    }
    assert_eq!(ids.len(), 4);
}

#[test]
fn a_missing_folder_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    write_map(folder.path());
    let place = r#"<Place type="house" storeys="2"/>"#;
    fs::write(folder.path().join("t.hsd"), town(place)).expect("is written");
    let run = hsd(folder.path(), &["town", "t.hsd", "-o", "none/t.city.json"]);
    let told = said(&run);
    assert!(
        !run.status.success() && told.contains("no such folder: none"),
        "{told}"
    );
}

/// Objects are told apart by their names, so features of one key must not replace each other.
#[test]
fn features_of_one_key_are_objects_of_their_own() {
    let folder = tempfile::tempdir().expect("a folder");
    write_map(folder.path());
    let map = folder.path().join("houses.geojson");
    let one_key = fs::read_to_string(&map)
        .expect("is there")
        .replace("\"h1\"", "\"h0\"");
    fs::write(&map, one_key).expect("is written");
    let place = r#"<Place type="house" storeys="2"/>"#;
    fs::write(folder.path().join("t.hsd"), town(place)).expect("is written");
    for name in ["t.city.json", "t.city.jsonl"] {
        let run = hsd(
            folder.path(),
            &["town", "t.hsd", "--detail", "0", "-o", name],
        );
        assert!(run.status.success(), "{}", said(&run));
        let text = fs::read_to_string(folder.path().join(name)).expect("is there");
        for object in ["\"houses h0\"", "\"houses h0_2\"", "\"houses h2\""] {
            assert!(text.contains(object), "{name} lacks {object}");
        }
    }
}
