//! Towns in the preview: tiles are built behind the page, what was skipped is listed, folders of tiles are shown as they are.

use super::{Files, Shown, show};
use crate::view::web::Ear;
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

const TOWN: &str = r#"<Town name="hamlet" seed="1">
  <Layer name="houses" src="maps/houses.geojson" crs="local" key="id" evidence="drawn for a test"/>
  <Layer name="roads" src="maps/roads.geojson" crs="local"/>
  <for each="houses" test="{area &lt; 20}"><Skip because="a shed"/></for>
  <for each="houses" test="{area &gt;= 20}"><Place type="hiraya"/></for>
</Town>
"#;

/// A map of rectangles: id, x and width of each.
fn houses(all: &[(&str, u32, u32)]) -> String {
    let feature = |(id, x, width): &(&str, u32, u32)| {
        let right = x + width;
        json!({ "type": "Feature", "properties": { "id": id }, "geometry": { "type": "Polygon",
            "coordinates": [[[x, 2], [right, 2], [right, 12], [x, 12], [x, 2]]] } })
    };
    let features: Vec<Value> = all.iter().map(feature).collect();
    json!({ "type": "FeatureCollection", "features": features }).to_string()
}

fn roads() -> String {
    json!({ "type": "FeatureCollection", "features": [{ "type": "Feature", "properties": { "highway": "residential" },
        "geometry": { "type": "LineString", "coordinates": [[-20, -2], [80, -2]] } }] })
    .to_string()
}

fn hamlet(text: &str) -> Shown {
    let map = houses(&[("a", 0, 6), ("b", 8, 6), ("shed", 20, 1)]);
    let files = [
        ("town.hsd", text),
        ("maps/houses.geojson", &map),
        ("maps/roads.geojson", &roads()),
    ];
    show(&files, Some("town.hsd"), Files::default())
}

/// Waits until a build has ended; returns the phases that were told, each once.
fn built(ear: &Ear) -> Vec<String> {
    let mut phases: Vec<String> = vec![];
    loop {
        let (name, data) = ear.hear();
        if name != "town" {
            continue;
        }
        let phase = data["phase"].as_str().expect("is a word").to_owned();
        let is_last = phase == "done" || phase == "failed";
        if phases.last() != Some(&phase) {
            phases.push(phase);
        }
        if is_last {
            return phases;
        }
    }
}

/// The names of the contents of a tileset.
fn contents(tile: &Value) -> Vec<String> {
    let own = tile["content"]["uri"].as_str().map(str::to_owned);
    let below = tile["children"].as_array().into_iter().flatten();
    own.into_iter().chain(below.flat_map(contents)).collect()
}

fn tileset(shown: &Shown, town: &Value) -> Value {
    let (id, root) = (&town["id"], town["tileset"].as_str().expect("is built"));
    shown
        .web
        .get(&format!("/api/town/{id}/files/{root}"))
        .json()
}

#[test]
fn a_town_is_built_behind_its_page() {
    let shown = hamlet(TOWN);
    // Nobody looks: nothing is built.
    assert_eq!(shown.web.state("town.hsd")["town"]["tileset"], Value::Null);
    let ear = shown.web.listen("town.hsd");
    assert_eq!(built(&ear), ["maps", "far", "near", "done"]);
    let state = shown.web.state("town.hsd");
    let town = &state["town"];
    assert_eq!(town["features"], 3);
    assert_eq!(town["built"], 2);
    assert_eq!(town["skipped"], 1);
    assert_eq!(town["whole"], true);
    assert_eq!(state["diagnostics"], json!([]));
    let files = contents(&tileset(&shown, town)["root"]);
    assert_eq!(files.len(), 3, "one tile of three levels: {files:?}");
    for file in &files {
        let answer = shown
            .web
            .get(&format!("/api/town/{}/files/{file}", town["id"]));
        assert!(
            answer.body.starts_with(b"glTF"),
            "{file}: {}",
            answer.status
        );
        assert!(answer.headers.contains("immutable"), "{}", answer.headers);
    }
}

#[test]
fn features_and_what_was_skipped_are_told() {
    let shown = hamlet(TOWN);
    built(&shown.web.listen("town.hsd"));
    let id = shown.web.state("town.hsd")["town"]["id"].clone();
    let get = |what: &str| shown.web.get(&format!("/api/town/{id}/{what}")).json();
    let feature = get("feature?layer=houses&key=b");
    assert_eq!(feature["type"], "hiraya");
    assert_eq!(feature["rule"], "2");
    assert_eq!(get("feature?key=a")["layer"], "houses");
    assert_eq!(get("feature?key=nobody"), Value::Null);
    let skipped = get("skipped");
    assert_eq!(skipped["total"], 1);
    let one = &skipped["list"][0];
    assert_eq!(
        (&one["key"], &one["reason"]),
        (&json!("shed"), &json!("a shed"))
    );
    assert_eq!(one["rule"], 1);
    assert_eq!(one["at"], json!([20.5, 7.0]));
}

#[test]
fn places_are_told_in_the_system_of_the_map() {
    let place = |text: &str, map: &str, query: &str| {
        let files = [
            ("town.hsd", text),
            ("maps/houses.geojson", map),
            ("maps/roads.geojson", &roads()),
        ];
        let shown = show(&files, Some("town.hsd"), Files::default());
        built(&shown.web.listen("town.hsd"));
        let id = shown.web.state("town.hsd")["town"]["id"].clone();
        shown
            .web
            .get(&format!("/api/town/{id}/place?{query}"))
            .json()
    };
    let map = houses(&[("a", 0, 6), ("b", 8, 6)]);
    let local = place(TOWN, &map, "east=3.5&north=-2");
    assert_eq!(local["crs"], "local");
    assert_eq!(local["degrees"], Value::Null);
    // Metres from the origin of the town, which stands at a whole place of the map.
    let one = local["at"].as_array().unwrap();
    let other = place(TOWN, &map, "east=0&north=0")["at"].clone();
    let away = |k: usize| one[k].as_f64().unwrap() - other[k].as_f64().unwrap();
    assert_eq!((away(0), away(1)), (3.5, -2.0));
    // By the centre of Kyoto in zone VI (36 N 136 E), worked out on the sphere of the ellipsoid's radius there: 0.1 degrees west
    // of the meridian at 35 degrees are 9.13 km, one degree south of the origin 110.9 km.
    let zone = TOWN.replace("crs=\"local\"", "crs=\"EPSG:6674\"");
    let zone = place(&zone, &houses_at(-9130.0, -110_940.0), "east=0&north=0");
    assert_eq!(zone["crs"], "EPSG:6674");
    let degrees = zone["degrees"].as_array().unwrap();
    assert!(
        (degrees[0].as_f64().unwrap() - 135.9).abs() < 0.01,
        "{zone}"
    );
    assert!((degrees[1].as_f64().unwrap() - 35.0).abs() < 0.01, "{zone}");
}

/// A house at a place.
fn houses_at(x: f64, y: f64) -> String {
    let ring = [[0.0, 2.0], [6.0, 2.0], [6.0, 12.0], [0.0, 12.0], [0.0, 2.0]];
    let ring: Vec<[f64; 2]> = ring.iter().map(|p| [x + p[0], y + p[1]]).collect();
    json!({ "type": "FeatureCollection", "features": [{ "type": "Feature", "properties": { "id": "a" },
        "geometry": { "type": "Polygon", "coordinates": [ring] } }] })
    .to_string()
}

#[test]
fn a_saved_town_and_a_saved_map_are_built_again() {
    let shown = hamlet(TOWN);
    let ear = shown.web.listen("town.hsd");
    built(&ear);
    let before = tileset(&shown, &shown.web.state("town.hsd")["town"]);
    // A comment changes no tile: the root stays the same, so the page loads nothing.
    shown.save(
        "town.hsd",
        &TOWN.replace(
            "<Layer name=\"roads\"",
            "<!-- roads --><Layer name=\"roads\"",
        ),
    );
    assert_eq!(
        built(&ear),
        ["maps", "near", "done"],
        "what is whole is not replaced by less"
    );
    let same = shown.web.state("town.hsd");
    assert_eq!(same["town"]["tileset"], "tileset-2.json");
    let map = houses(&[("a", 0, 6), ("b", 8, 6), ("c", 16, 7)]);
    shown.save("maps/houses.geojson", &map);
    built(&ear);
    let now = &shown.web.state("town.hsd")["town"];
    assert_eq!(now["built"], 3);
    assert_ne!(
        contents(&tileset(&shown, now)["root"]),
        contents(&before["root"])
    );
}

#[test]
fn mistakes_are_told_and_the_last_town_stays() {
    let shown = hamlet(TOWN);
    let ear = shown.web.listen("town.hsd");
    built(&ear);
    shown.save(
        "town.hsd",
        &TOWN.replace("{area &lt; 20}", "{aera &lt; 20}"),
    );
    built(&ear);
    let state = shown.web.state("town.hsd");
    let mut all = state["diagnostics"].as_array().into_iter().flatten();
    let names_it = |d: &&Value| d["message"].as_str().is_some_and(|m| m.contains("aera"));
    let found = all.find(names_it).expect("is told");
    assert_eq!(found["line"], 4, "{found}");
    fs::remove_file(shown.folder.path().join("maps/houses.geojson")).expect("can be removed");
    built(&ear);
    let state = shown.web.state("town.hsd");
    assert!(state["town"]["tileset"].is_string(), "{}", state["town"]);
    let found = state["diagnostics"][0]["message"]
        .as_str()
        .expect("is a text");
    assert!(found.contains("houses.geojson"), "{found}");
}

#[test]
fn a_folder_of_tiles_is_shown_as_it_is() {
    let files = [
        (
            "kyoto/tileset.json",
            r#"{"asset":{"version":"1.1"},"geometricError":1,"root":{}}"#,
        ),
        ("kyoto/tiles/0_0.glb", "glTF"),
        (
            "kyoto/decisions.csv",
            "key,layer,rule,type,x,y\n7,houses,1,hiraya,1,2\n",
        ),
        (
            "kyoto/report.json",
            r#"{"features":1,"built":1,"skipped":[],"corrected":[]}"#,
        ),
        ("secret.json", "{}"),
    ];
    let shown = show(&files, None, Files::default());
    let hello = shown.web.get("/api/hello").json();
    assert_eq!(
        hello["files"],
        json!([{ "path": "kyoto/tileset.json", "kind": "tiles" }])
    );
    let state = shown.web.state("kyoto%2Ftileset.json");
    let town = &state["town"];
    assert_eq!(
        (&town["features"], &town["whole"]),
        (&json!(1), &json!(true))
    );
    let id = &town["id"];
    let get = |what: &str| shown.web.get(&format!("/api/town/{id}/{what}"));
    assert_eq!(get("feature?key=7").json()["type"], "hiraya");
    assert_eq!(get("files/tiles/0_0.glb").text(), "glTF");
    for outside in [
        "files/../secret.json",
        "files/%2e%2e/secret.json",
        "files/decisions.csv",
        "files/%2Fetc%2Fpasswd",
    ] {
        assert_eq!(get(outside).status, 404, "{outside}");
    }
    assert_eq!(shown.web.get("/api/town/999/skipped").status, 404);
}

#[test]
fn links_lead_to_nothing_outside_of_a_folder_of_tiles() {
    let folder = tempfile::tempdir().expect("can be made");
    fs::write(folder.path().join("secret.json"), "{}").expect("can be written");
    let shown = show(
        &[("tileset.json", "{}")],
        Some("tileset.json"),
        Files::default(),
    );
    let link = shown.folder.path().join("linked.json");
    if !linked(&folder.path().join("secret.json"), &link) {
        return;
    }
    let id = shown.web.state("tileset.json")["town"]["id"].clone();
    assert_eq!(
        shown
            .web
            .get(&format!("/api/town/{id}/files/linked.json"))
            .status,
        404
    );
}

#[cfg(unix)]
fn linked(from: &Path, to: &Path) -> bool {
    std::os::unix::fs::symlink(from, to).is_ok()
}

#[cfg(not(unix))]
fn linked(_: &Path, _: &Path) -> bool {
    false
}
