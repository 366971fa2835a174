//! The accounts of `hsd town` are the same in every form of output.

use super::{code, hsd, stderr};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// A long fence, two houses of which one is drawn twice, a line that is too short for a fence, and a layer without rules.
const MAPS: [(&str, &str); 3] = [
    (
        "fences.geojson",
        r#"{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[0,-9],[4000,-9]]}},
{"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[0,-5],[9,-5]]}},
{"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[0,-3],[0.1,-3]]}}]}"#,
    ),
    (
        "houses.geojson",
        r#"{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[0,0],[8,0],[8,8],[0,8],[0,0]]]}},
{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[0,0],[8,0],[8,8],[0,8],[0,0]]]}},
{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[20,0],[28,0],[28,8],[20,8],[20,0]]]}}]}"#,
    ),
    (
        "others.geojson",
        r#"{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[40,40]}}]}"#,
    ),
];

const TOWN: &str = r#"<Town seed="1">
<Layer name="fences" src="fences.geojson" crs="local"/>
<Layer name="houses" src="houses.geojson" crs="local"/>
<Layer name="others" src="others.geojson" crs="local"/>
<for each="fences"><Fence/></for>
<for each="houses"><Place type="kura" on="centre"/></for>
</Town>"#;

fn report(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

#[test]
fn outputs_agree_on_every_feature() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (name, text) in MAPS {
        fs::write(folder.join(name), text).unwrap();
    }
    fs::write(folder.join("t.hsd"), TOWN).unwrap();
    let mut first: Option<(Value, Vec<String>)> = None;
    for (output, tables) in [
        ("tiles/", "tiles/"),
        ("one.glb", "one."),
        ("objects.obj", "objects."),
        ("city.city.json", "city.city."),
        ("lines.city.jsonl", "lines.city."),
    ] {
        let of_limit = ["--max-triangles", "9000", "--detail", "0"];
        let made = hsd(
            folder,
            &[&["town", "t.hsd", "-o", output], &of_limit[..]].concat(),
        );
        assert_eq!(code(&made), 1, "{output}: {}", stderr(&made));
        let told = "7 features: 3 built, 3 skipped, 1 unused";
        assert!(stderr(&made).contains(told), "{output}: {}", stderr(&made));
        let found = report(&folder.join(format!("{tables}report.json")));
        let codes = found["skipped"].as_array().unwrap().iter();
        let mut codes: Vec<&str> = codes.map(|s| s["code"].as_str().unwrap()).collect();
        codes.sort_unstable();
        assert_eq!(codes, ["HSD0911", "HSD1118", "HSD1170"], "{output}");
        let table = fs::read_to_string(folder.join(format!("{tables}decisions.csv"))).unwrap();
        let lines: Vec<String> = table.lines().map(str::to_owned).collect();
        assert_eq!(lines.len(), 8, "{output}");
        let counts = Value::from(vec![
            found["features"].clone(),
            found["built"].clone(),
            found["unused"].clone(),
            found["layers"].clone(),
            found["skipped"].clone(),
        ]);
        match &first {
            None => first = Some((counts, lines)),
            Some((known, table)) => {
                assert_eq!((&counts, &lines), (known, table), "{output}");
            }
        }
    }
    // The tiles are there already, and so is what they lack.
    let again = [
        "town",
        "t.hsd",
        "-o",
        "tiles/",
        "--max-triangles",
        "9000",
        "--detail",
        "0",
    ];
    let again = hsd(folder, &again);
    assert_eq!(code(&again), 1, "{}", stderr(&again));
    let found = report(&folder.join("tiles/report.json"));
    assert_eq!(
        (&found["built"], &found["features"]),
        (&3.into(), &7.into())
    );
}
