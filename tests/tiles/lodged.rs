//! Towns whose features wait in a spool: the same bytes as those of towns that are in memory.

use super::{Memory, Reach, build_within};
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// Lots that touch each other, in rows that cross borders of tiles, one file or two.
fn map(folder: &Path) {
    let mut files = [vec![], vec![]];
    for row in 0..5 {
        let mut x = -70.0;
        for n in 0..24 {
            let (w, y) = (
                4.0 + f64::from((n * 7 + row * 3) % 5) * 0.7,
                f64::from(row) * 26.0,
            );
            let back = y + 9.0 + f64::from(n % 4);
            let (e, key) = (x + w, if n == 20 { 19 } else { n });
            files[usize::from(row > 2)].push(format!(
                r#"{{"type":"Feature","properties":{{"key":"h{row}-{key}","quarter":"{}","{}":{n}}},"geometry":{{"type":"Polygon","coordinates":[[[{x},{y}],[{e},{y}],[{e},{back}],[{x},{back}],[{x},{y}]]]}}}}"#,
                ["west", "東", "mid"][n as usize % 3],
                if row > 2 { "late" } else { "early" },
            ));
            x += w + if n % 6 == 5 { 2.5 } else { 0.0 };
        }
    }
    // One that reaches over several tiles.
    files[0].push(r#"{"type":"Feature","properties":{"key":"long","quarter":"mid"},"geometry":{"type":"Polygon","coordinates":[[[-80,-40],[90,-42],[90,-30],[-80,-30],[-80,-40]]]}}"#.into());
    let roads = (0..6).map(|row| {
        let y = f64::from(row) * 26.0 - 4.0;
        format!(
            r#"{{"type":"Feature","properties":{{"width":4}},"geometry":{{"type":"LineString","coordinates":[[-90,{y}],[95,{y}]]}}}}"#
        )
    });
    let blocks = (0..3).map(|n| {
        let (w, e) = (n * 60 - 90, n * 60 - 30);
        format!(
            r#"{{"type":"Feature","properties":{{"key":"b{n}"}},"geometry":{{"type":"Polygon","coordinates":[[[{w},-50],[{e},-50],[{e},150],[{w},150],[{w},-50]]]}}}}"#
        )
    });
    let points = (0..24).map(|n| {
        let (x, y) = (n * 6 - 69, (n % 5) * 26 + 3);
        format!(
            r#"{{"type":"Feature","properties":{{"name":"p{n}"}},"geometry":{{"type":"Point","coordinates":[{x},{y}]}}}}"#
        )
    });
    let [first, second] = files;
    let lists = [
        ("houses-1", first),
        ("houses-2", second),
        ("roads", roads.collect()),
        ("areas", blocks.collect()),
        ("points", points.collect::<Vec<_>>()),
    ];
    for (name, list) in lists {
        let text = format!(
            r#"{{"type":"FeatureCollection","features":[{}]}}"#,
            list.join(",")
        );
        fs::write(folder.join(format!("{name}.geojson")), text).expect("is written");
    }
    let mut heights = "ncols 60\nnrows 60\nxllcorner -140\nyllcorner -100\ncellsize 6\n".to_owned();
    for n in 0..3600 {
        let _ = write!(
            heights,
            "{} ",
            f64::from(n % 60) * 0.3 + f64::from(n / 60) * 0.1
        );
    }
    fs::write(folder.join("ground.asc"), heights).expect("is written");
}

/// What is built of layers and rules, in memory and in a spool.
fn compare(layers: &str, rules: &str, tiles: &str) {
    let folder = tempfile::tempdir().expect("a folder");
    map(folder.path());
    let text = format!("<Town seed=\"3\">{layers}{rules}{tiles}</Town>");
    let of = |spooled, threads| {
        let store = Memory::default();
        let reach = (Reach::All, spooled);
        let built = build_within(reach, &text, folder.path(), &store, threads);
        let built = built.expect("nothing fails");
        let report = serde_json::to_string(&built.town.ledger.report).expect("is JSON");
        let keys = built.town.tiles.len();
        (built.all(), report, keys)
    };
    let kept = of(false, 2);
    assert!(kept.2 >= 2, "{} tiles", kept.2);
    let lines = kept.0.2.lines().count();
    assert!(lines > 60, "{lines} lines");
    for threads in [1, 7] {
        let lodged = of(true, threads);
        assert!(kept.0.2 == lodged.0.2, "decisions");
        assert_eq!(kept.1, lodged.1, "report");
        assert!(kept.0 == lodged.0, "files");
    }
}

const HOUSES: &str =
    r#"<Layer name="houses" src="houses-1.geojson, houses-2.geojson" crs="local" key="key"/>"#;
const ROADS: &str = r#"<Layer name="roads" src="roads.geojson" crs="local"/>"#;
const RULES: &str = r#"<for each="houses"><if test="{left + right &gt; 1 or corner}"><Place type="so-nikai"/></if><else><random><choice weight="2"><Place type="kanban"/></choice><choice weight="1"><Place type="block" on="outline"/></choice></random></else></for>"#;

#[test]
fn towns_in_a_spool_are_those_in_memory() {
    let layers = format!("{HOUSES}{ROADS}");
    compare(&layers, RULES, r#"<Tiles size="31" detail="0"/>"#);
}

#[test]
fn so_are_tiles_by_a_field_and_a_layer_that_leaves_features_out() {
    let houses = HOUSES.replace("/>", r#" where="quarter != 'mid' or key = 'long'"/>"#);
    let layers = format!("{houses}{ROADS}");
    compare(
        &layers.replace("'long'", "'long' or late &gt; 3"),
        RULES,
        r#"<Tiles by="quarter" detail="0"/>"#,
    );
}

#[test]
fn so_are_streets_with_rules_joined_points_blocks_and_ground() {
    let houses = HOUSES.replace("/>", r#"><Join layer="points"/></Layer>"#);
    let layers = format!(
        r#"{houses}{ROADS}<Layer name="areas" src="areas.geojson" crs="local" key="key"/><Layer name="points" src="points.geojson" crs="local"/><Layer name="ground" src="ground.asc" crs="local"/>"#
    );
    let rules = format!(
        r#"{RULES}<for each="roads"><Skip because="{{block}}"/></for><for each="points"><Place type="kura" on="centre"/></for>"#
    );
    compare(&layers, &rules, r#"<Tiles size="40" detail="0"/>"#);
}
