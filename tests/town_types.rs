//! Types of the library on outlines of any shape: in a town none warns of its own roofs, and messages name each thing once.

use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// Runs the program in a folder.
pub(crate) fn hsd(folder: &Path, words: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hsd"));
    let run = command.args(words).current_dir(folder).output();
    run.expect("the program runs")
}

pub(crate) fn said(run: &Output) -> String {
    String::from_utf8_lossy(&[&run.stdout[..], &run.stderr].concat()).into_owned()
}

/// Outlines that are no rectangles, and a wide one, along a street on the line north = 0.
fn outlines() -> Vec<Vec<[f64; 2]>> {
    vec![
        vec![[0., 3.], [9., 3.], [9., 9.], [5., 9.], [5., 13.], [0., 13.]],
        vec![
            [0., 6.],
            [4., 6.],
            [4., 3.],
            [13., 3.],
            [13., 12.],
            [0., 12.],
        ],
        vec![[0., 3.], [21., 3.], [21., 12.], [0., 12.]],
        vec![[0., 3.], [7., 3.4], [8., 11.], [3., 14.]],
    ]
}

pub(crate) fn write_map(folder: &Path) {
    let area = |n: usize, ring: Vec<[f64; 2]>| {
        let east = 40.0 * n as f64;
        let mut ring: Vec<[f64; 2]> = ring.iter().map(|[x, y]| [x + east, *y]).collect();
        ring.push(ring[0]);
        json!({"type": "Feature", "properties": {"key": format!("h{n}")},
            "geometry": {"type": "Polygon", "coordinates": [ring]}})
    };
    let houses: Vec<Value> = outlines()
        .into_iter()
        .enumerate()
        .map(|(n, ring)| area(n, ring))
        .collect();
    let street = json!({"type": "Feature", "properties": {"width": 4},
        "geometry": {"type": "LineString", "coordinates": [[-50, 0], [250, 0]]}});
    for (name, features) in [("houses.geojson", houses), ("roads.geojson", vec![street])] {
        let all = json!({"type": "FeatureCollection", "features": features});
        fs::write(folder.join(name), all.to_string()).expect("is written");
    }
}

pub(crate) fn town(place: &str) -> String {
    format!(
        r#"<Town seed="4"><Layer name="houses" src="houses.geojson" crs="local" key="key"/>
           <Layer name="roads" src="roads.geojson" crs="local"/>
           <for each="houses">{place}</for></Town>"#
    )
}

#[test]
fn roofs_of_types_fit_outlines_of_any_shape() {
    let folder = tempfile::tempdir().expect("a folder");
    write_map(folder.path());
    let types = [
        "so-nikai",
        "chu-nikai",
        "sangai",
        "hiraya",
        "shimotaya",
        "kanban",
        "modern-house",
        "office",
        "kura",
    ];
    for word in types
        .iter()
        .chain(&["block", "hospital", "school", "shop-row", "temple", "house"])
    {
        let place = format!(r#"<Place type="{word}" on="outline"/>"#);
        fs::write(folder.path().join("t.hsd"), town(&place)).expect("is written");
        let run = hsd(
            folder.path(),
            &["town", "t.hsd", "-o", "t.glb", "--detail", "0"],
        );
        let text = said(&run);
        // A roof inside a storey, or off its walls, would be the type's own.
        for code in ["HSD0503", "HSD0516", "HSD0502", "error["] {
            assert!(!text.contains(code), "{word}: {text}");
        }
    }
}

#[test]
fn messages_of_init_name_file_and_feature_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let rings = [
        "[[0,0],[9,0],[9,9],[0,9],[0,0]]",
        "[[20,0],[29,9],[29,0],[20,9],[20,0]]",
    ];
    let area = |ring: &&str| {
        format!(
            r#"{{"type":"Feature","properties":{{}},"geometry":{{"type":"Polygon","coordinates":[{ring}]}}}}"#
        )
    };
    let all: Vec<String> = rings.iter().map(area).collect();
    let map = format!(
        r#"{{"type":"FeatureCollection","features":[{}]}}"#,
        all.join(",")
    );
    fs::write(folder.path().join("lots.geojson"), map).expect("is written");
    for language in ["en", "ja"] {
        let run = hsd(
            folder.path(),
            &[
                "town",
                "init",
                "lots.geojson",
                "-o",
                "t.hsd",
                "--lang",
                language,
                "--force",
            ],
        );
        let text = said(&run);
        let line = text
            .lines()
            .find(|l| l.contains('⚠'))
            .unwrap_or_else(|| panic!("{text}"));
        assert_eq!(line.matches("lots.geojson").count(), 1, "{text}");
        assert_eq!(
            line.matches("feature").count() + line.matches("地物").count(),
            1,
            "{text}"
        );
    }
}

/// Candidates of one plot (002-27): the first is what the town builds, all are drawn, each with its line.
#[test]
fn candidates_of_a_plot_are_drawn_side_by_side() {
    let folder = tempfile::tempdir().expect("a folder");
    write_map(folder.path());
    let place = r#"<random><choice weight="1"><Place type="so-nikai"/></choice>
        <choice weight="1"><Place type="house" storeys="{1 + floor(draw(3))}"/></choice></random>"#;
    fs::write(folder.path().join("t.hsd"), town(place)).expect("is written");
    let draw = |key: &str, name: &str| {
        let words = [
            "town",
            "candidates",
            "t.hsd",
            "--key",
            key,
            "--detail",
            "0",
            "-o",
            name,
        ];
        hsd(folder.path(), &words)
    };
    let run = draw("h2", "sheet.png");
    assert!(run.status.success(), "{}", said(&run));
    let lines = String::from_utf8(run.stdout).expect("UTF-8");
    let lines: Vec<Vec<&str>> = lines.lines().map(|l| l.split('\t').collect()).collect();
    let seeds: Vec<&str> = lines.iter().map(|l| l[0]).collect();
    assert_eq!(seeds, ["4", "5", "6", "7", "8", "9", "10", "11", "12"]);
    let kinds: std::collections::BTreeSet<&str> = lines.iter().map(|l| l[1]).collect();
    assert_eq!(kinds.into_iter().collect::<Vec<_>>(), ["house", "so-nikai"]);
    let built = hsd(
        folder.path(),
        &["town", "t.hsd", "--detail", "0", "-o", "t.glb"],
    );
    assert!(built.status.success(), "{}", said(&built));
    let table = fs::read_to_string(folder.path().join("t.decisions.csv")).expect("is there");
    let own = table
        .lines()
        .find(|l| l.starts_with("h2,"))
        .expect("a line");
    assert_eq!(own.split(',').nth(3), Some(lines[0][1]));
    let sheet = image::open(folder.path().join("sheet.png"))
        .expect("an image")
        .into_rgb8();
    // Nine images in three rows, and something else than paper and sky in each.
    let (width, height) = (sheet.width() / 3, sheet.height() / 3);
    for cell in 0..9 {
        let (x, y) = (cell % 3 * width, cell / 3 * height);
        let own = image::imageops::crop_imm(&sheet, x + 20, y + 40, width - 40, height - 60);
        let own = own.to_image();
        let colours: std::collections::BTreeSet<[u8; 3]> = own.pixels().map(|p| p.0).collect();
        assert!(
            colours.len() > 20,
            "image {cell}: {} colours",
            colours.len()
        );
    }
    let map = folder.path().join("houses.geojson");
    let twice = fs::read_to_string(&map)
        .expect("is there")
        .replace("\"h1\"", "\"h0\"");
    fs::write(&map, twice).expect("is written");
    let several = said(&draw("h0", "sheet.png"));
    assert!(
        several.contains("several features of houses have the key `h0`"),
        "{several}"
    );
    let none = draw("h9", "sheet.png");
    assert!(said(&none).contains(
        "no rule of the town takes a feature with the key `h9`; keys are such as h0, h0, h2"
    ));
}
