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
        ("houses.hsd", "houses."),
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
    // A check reports the same features.
    let checked = hsd(
        folder,
        &[
            "check",
            "--format",
            "json",
            "--max-triangles",
            "9000",
            "t.hsd",
        ],
    );
    assert_eq!(code(&checked), 1, "{}", stderr(&checked));
    let told = String::from_utf8_lossy(&checked.stdout);
    for code in ["HSD0911", "HSD1118", "HSD1170"] {
        assert!(told.contains(code), "{code}: {told}");
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

/// Writes a town with one layer of features, given as geometries with their properties, and a rule for it.
fn town_of(folder: &Path, features: &[(&str, &str)], rule: &str) {
    let feature = |(geometry, properties): &(&str, &str)| {
        format!(r#"{{"type":"Feature","properties":{{{properties}}},"geometry":{geometry}}}"#)
    };
    let features: Vec<String> = features.iter().map(feature).collect();
    let features = features.join(",");
    let map = format!(r#"{{"type":"FeatureCollection","features":[{features}]}}"#);
    fs::write(folder.join("a.geojson"), map).unwrap();
    let layer = r#"<Layer name="a" src="a.geojson" crs="local"/>"#;
    let town = format!(r#"<Town seed="1">{layer}<for each="a">{rule}</for></Town>"#);
    fs::write(folder.join("t.hsd"), town).unwrap();
}

/// Returns the exit status of a check, then those of a build in each form of output.
fn statuses(folder: &Path, options: &[&str]) -> Vec<i32> {
    let checked = hsd(folder, &[&["check", "t.hsd"], options].concat());
    let builds = ["o.glb", "o.hsd", "tiles/", "o.city.json", "o.obj"];
    let builds = builds.map(|output| {
        let command = ["town", "-q", "t.hsd", "-o", output];
        code(&hsd(folder, &[&command[..], options].concat()))
    });
    std::iter::once(code(&checked)).chain(builds).collect()
}

#[test]
fn a_check_fails_where_a_build_skips_a_feature() {
    let square = r#"{"type":"Polygon","coordinates":[[[0,0],[9,0],[9,7],[0,7],[0,0]]]}"#;
    let tie = r#"{"type":"Polygon","coordinates":[[[40,3],[52,11],[52,3.001],[40,11],[40,3]]]}"#;
    let fence = r#"{"type":"LineString","coordinates":[[0,-9],[30000000,-9]]}"#;
    for (features, rule, status) in [
        (&[(square, "")][..], r#"<Place type="kura"/>"#, 0),
        (&[(square, ""), (tie, "")], r#"<Place type="kura"/>"#, 1),
        (&[(fence, "")], "<Hedge/>", 1),
        (
            &[(square, r#""n":1"#), (square, r#""n":2"#)],
            r#"<Place type="hiraya"/>"#,
            1,
        ),
    ] {
        let folder = tempfile::tempdir().unwrap();
        town_of(folder.path(), features, rule);
        let found = statuses(folder.path(), &[]);
        assert!(found.iter().all(|s| *s == status), "{rule}: {found:?}");
    }
}

/// A house that is too large for a level of detail is shown in a plainer form, and is never counted as built and missing.
#[test]
fn an_oversized_house_is_shown_plainer_or_skipped_everywhere() {
    let hall = r#"{"type":"Polygon","coordinates":[[[0,0],[310,0],[310,45],[0,45],[0,0]]]}"#;
    let small = r#"{"type":"Polygon","coordinates":[[[0,90],[9,90],[9,97],[0,97],[0,90]]]}"#;
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let rule = r#"<Place type="block" on="outline" storeys="4"/>"#;
    town_of(folder, &[(hall, ""), (small, "")], rule);
    for (most, status, built) in [("90000", 0, 2), ("500", 1, 0)] {
        let found = statuses(folder, &["--max-triangles", most]);
        assert!(found.iter().all(|s| *s == status), "{most}: {found:?}");
        for tables in ["o.", "tiles/"] {
            let report = report(&folder.join(format!("{tables}report.json")));
            assert_eq!(report["built"], built, "{most}: {report}");
        }
    }
    let checked = hsd(
        folder,
        &[
            "check",
            "--format",
            "short",
            "--max-triangles",
            "90000",
            "t.hsd",
        ],
    );
    let told = String::from_utf8_lossy(&checked.stdout);
    assert!(
        told.contains("at detail 3; it is shown at detail"),
        "{told}"
    );
}
