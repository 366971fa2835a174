//! Layers of several files: read in a fixed order, keys and faults that name their file, and how `hsd town init` finds them.

use crate::support::root;
use crate::towns::{Built, in_folder};
use hsd::FolderWorld;
use hsd::source::World;
use hsd::survey::{Kind, Plane, Surveyed, joined, standing, survey, town};
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// A map of squares of 8 m in metres: west, south, and the fields of each.
fn squares(all: &[(i32, i32, &str)]) -> String {
    let feature = |(x, y, fields): &(i32, i32, &str)| {
        let (e, n) = (x + 8, y + 8);
        format!(
            r#"{{"type":"Feature","properties":{{{fields}}},"geometry":{{"type":"Polygon","coordinates":[[[{x},{y}],[{e},{y}],[{e},{n}],[{x},{n}],[{x},{y}]]]}}}}"#
        )
    };
    let all: Vec<String> = all.iter().map(feature).collect();
    format!(
        r#"{{"type":"FeatureCollection","features":[{}]}}"#,
        all.join(",")
    )
}

fn folder(files: &[(&str, String)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("has one")).expect("is made");
        fs::write(path, text).expect("is written");
    }
    folder
}

/// Skips each feature of a layer with its fields as the reason.
fn town_of(src: &str, rest: &str) -> String {
    format!(
        r#"<Town><Layer name="houses" src="{src}" crs="local" {rest}/>
        <for each="houses"><if test="{{use = 'inn'}}"><Skip because="an inn"/></if><else><Skip because="{{use}} {{levels}}"/></else></for></Town>"#
    )
}

fn rows(built: &Built) -> Vec<String> {
    let row = |r: &std::collections::BTreeMap<String, String>| format!("{} {}", r["key"], r["why"]);
    built.rows.iter().map(row).collect()
}

/// Two sheets whose fields come in different orders.
fn two() -> tempfile::TempDir {
    let north = squares(&[(0, 20, r#""use":"shop","levels":2"#)]);
    let south = squares(&[
        (0, 0, r#""levels":3,"use":"shop""#),
        (20, 0, r#""use":"inn""#),
    ]);
    folder(&[
        ("sheets/b-north.geojson", north),
        ("sheets/a-south.geojson", south),
        (
            "other.geojson",
            squares(&[(90, 0, r#""use":"shop","levels":9"#)]),
        ),
    ])
}

#[test]
fn files_of_a_list_are_read_in_its_order_and_those_of_a_pattern_by_name() {
    let two = two();
    let list = town_of("sheets/b-north.geojson, sheets/a-south.geojson", "");
    let built = in_folder(&list, two.path(), |_| {});
    let north = "b-north:0 shop 2";
    let south = ["a-south:0 shop 3", "a-south:1 an inn"];
    assert_eq!(rows(&built), [north, south[0], south[1]]);
    for pattern in ["sheets/*.geojson", "sheets/?-*.geojson"] {
        let built = in_folder(&town_of(pattern, ""), two.path(), |_| {});
        assert_eq!(rows(&built), [south[0], south[1], north]);
        assert!(!built.found.iter().any(|c| c == "HSD1112"), "keys differ");
    }
    // A file that two patterns name is read once, where the first one names it.
    let both = town_of("sheets/b*.geojson, sheets/*.geojson, other.geojson", "");
    let built = in_folder(&both, two.path(), |_| {});
    assert_eq!(rows(&built), [north, south[0], south[1], "other:0 shop 9"]);
    // A `where` and a key hold for all.
    let some = town_of("sheets/*.geojson", r#"where="levels > 2" key="levels""#);
    let built = in_folder(&some, two.path(), |_| {});
    assert_eq!(rows(&built), ["3 shop 3"]);
}

#[test]
fn a_file_whose_name_looks_like_a_list_is_one() {
    let one = folder(&[(
        "a, b.geojson",
        squares(&[(0, 0, r#""use":"shop","levels":1"#)]),
    )]);
    let built = in_folder(&town_of("a, b.geojson", ""), one.path(), |_| {});
    assert_eq!(rows(&built), ["0 shop 1"]);
}

#[test]
fn each_fault_names_its_file() {
    let spike = r#"{"type":"FeatureCollection","features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[0,0],[5,5],[0,0]]]}}]}"#;
    let files = folder(&[
        ("a.geojson", spike.to_owned()),
        ("b.geojson", squares(&[(0, 0, r#""use":"inn""#)])),
        ("c.geojson", spike.to_owned()),
    ]);
    let text = town_of("*.geojson", "");
    let built = in_folder(&text, files.path(), |plan| {
        let faults: Vec<String> = plan.layers[0]
            .faults
            .iter()
            .map(|(fault, count)| format!("{count} {}", fault.file.rsplit('/').next().unwrap()))
            .collect();
        assert_eq!(faults, ["1 a.geojson", "1 c.geojson"]);
    });
    assert_eq!(rows(&built)[0], "b:0 an inn");
    let unread = built.rows.iter().filter(|row| row["what"] == "not read");
    let unread: Vec<&str> = unread.map(|row| &*row["key"]).collect();
    assert_eq!(unread, ["a:0", "c:0"]);
    assert_eq!((built.features, built.built, built.skipped), (3, 0, 3));
}

#[test]
fn what_is_not_there_is_told_at_its_place() {
    let two = two();
    let told = |src: &str| {
        let built = in_folder(&town_of(src, ""), two.path(), |_| {});
        let [code, place, _] = built.told[0].clone();
        assert_eq!(code, "HSD1115", "{src}");
        place
    };
    assert_eq!(
        told("other.geojson, sheets/nort.geojson"),
        "sheets/nort.geojson"
    );
    assert_eq!(told("sheets/*.shp"), "sheets/*.shp");
    assert_eq!(told("s*/a-south.geojson"), "s*/a-south.geojson");
    assert_eq!(told("nowhere/*.xml, other.geojson"), "nowhere/*.xml");
    assert_eq!(told(","), ",");
    assert_eq!(told("../*.geojson"), "../*.geojson");
}

/// A map of the registry: lots of 10 by 20 m, from a corner (north, east).
fn sheet(system: &str, (x, y): (f64, f64), lots: usize) -> String {
    let (mut space, mut theme) = (String::new(), String::new());
    for n in 0..lots {
        let (west, east) = (y + 10.0 * n as f64, y + 10.0 * (n + 1) as f64);
        let corners = [(x, west), (x, east), (x + 20.0, east), (x + 20.0, west)];
        for side in 0..4 {
            let position = |(x, y): (f64, f64)| {
                format!(
                    "<zmn:GM_PointArray.column><zmn:GM_Position.direct><zmn:X>{x}</zmn:X><zmn:Y>{y}</zmn:Y></zmn:GM_Position.direct></zmn:GM_PointArray.column>"
                )
            };
            let (from, to) = (position(corners[side]), position(corners[(side + 1) % 4]));
            let _ = write!(
                space,
                r#"<zmn:GM_Curve id="C{n}{side}">{from}{to}</zmn:GM_Curve>"#
            );
        }
        let ring: String = (0..4)
            .map(|side| format!(r#"<zmn:GM_CompositeCurve.generator idref="C{n}{side}"/>"#))
            .collect();
        let _ = write!(
            space,
            r#"<zmn:GM_Surface id="F{n}"><zmn:GM_SurfaceBoundary.exterior>{ring}</zmn:GM_SurfaceBoundary.exterior></zmn:GM_Surface>"#
        );
        let _ = write!(
            theme,
            r#"<筆 id="H{n}"><地番>{n}</地番><形状 idref="F{n}"/></筆>"#
        );
    }
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?><地図 xmlns="http://www.moj.go.jp/MINJI/tizuxml" xmlns:zmn="http://www.moj.go.jp/MINJI/tizuzumen"><座標系>{system}</座標系><空間属性>{space}</空間属性><主題属性>{theme}</主題属性></地図>"#
    )
}

/// Surveys maps as `hsd town init` does.
fn surveyed(folder: &Path, maps: &[&str]) -> Vec<Surveyed> {
    let world = FolderWorld::new(vec![], 0).with_roots(vec![folder.to_owned()]);
    let from = folder.join("town.hsd");
    let from = from.to_string_lossy();
    let mut all = vec![];
    for map in maps {
        let path = world.text(&from, map).expect("is there");
        all.extend(survey(&world, &path, map).unwrap_or_else(|e| panic!("{map}: {e:?}")));
    }
    joined(all, &|folder| {
        world.names(&from, folder).unwrap_or_default()
    })
}

/// Four sheets of a row of lots, 30 m each, in zone 9.
fn row() -> Vec<(&'static str, String)> {
    let zone = "公共座標9系";
    vec![
        ("sheets/1.xml", sheet(zone, (-42_000.0, 25_000.0), 3)),
        ("sheets/2.xml", sheet(zone, (-42_000.0, 25_030.0), 3)),
        ("sheets/3.xml", sheet(zone, (-42_000.0, 25_060.0), 0)),
        ("sheets/4.xml", sheet(zone, (-42_000.0, 25_090.0), 2)),
    ]
}

#[test]
fn sheets_of_the_registry_become_one_layer() {
    let files = folder(&row());
    let maps = [
        "sheets/1.xml",
        "sheets/2.xml",
        "sheets/3.xml",
        "sheets/4.xml",
    ];
    let layers = surveyed(files.path(), &maps);
    let [lots] = &layers[..] else {
        panic!("{layers:?}");
    };
    assert_eq!((lots.kind, lots.features), (Kind::Lots, 8));
    let text = town("joetsu", &layers);
    assert!(text.contains(r#"src="sheets/*.xml""#), "{text}");
    let built = in_folder(&text, files.path(), |_| {});
    assert_eq!((built.features, built.built, built.houses), (8, 8, 8));
    assert_eq!(built.rows[3]["key"], "2:H0", "ids occur in every sheet");
    // Some of the files of a folder are listed.
    let layers = surveyed(files.path(), &maps[..2]);
    assert_eq!(layers[0].src, "sheets/1.xml, sheets/2.xml");
    let built = in_folder(&town("joetsu", &layers), files.path(), |_| {});
    assert_eq!(built.houses, 6);
}

#[test]
fn maps_of_one_place_stay_layers_of_their_own() {
    let (here, there) = (
        [(0, 0, r#""building":"yes""#)],
        [(2, 0, r#""building":"yes""#)],
    );
    let files = folder(&[
        ("1928.geojson", squares(&here)),
        ("1998.geojson", squares(&there)),
        ("east.geojson", squares(&[(9, 0, r#""building":"yes""#)])),
    ]);
    let layers = surveyed(
        files.path(),
        &["1928.geojson", "1998.geojson", "east.geojson"],
    );
    let srcs: Vec<&str> = layers.iter().map(|l| &*l.src).collect();
    assert_eq!(srcs, ["1928.geojson, east.geojson", "1998.geojson"]);
}

#[test]
fn surveys_of_their_own_do_not_stand_in_a_town_with_others() {
    let own = "任意座標系";
    let mut all = row();
    all.push(("sheets/own-1.xml", sheet(own, (0.0, 0.0), 2)));
    all.push(("sheets/own-2.xml", sheet(own, (5.0, 5.0), 3)));
    let files = folder(&all);
    let maps = [
        "sheets/own-1.xml",
        "sheets/1.xml",
        "sheets/2.xml",
        "sheets/own-2.xml",
    ];
    let layers = surveyed(files.path(), &maps);
    let planes: Vec<bool> = layers.iter().map(|l| l.plane == Plane::OwnSurvey).collect();
    assert_eq!(
        (planes, standing(&layers)),
        (vec![true, false, true], vec![false, true, false])
    );
    let text = town("town", &layers);
    assert!(
        text.contains("Not in this town") && text.contains("2: src=\"sheets/own-1.xml\""),
        "{text}"
    );
    let built = in_folder(&text, files.path(), |_| {});
    assert_eq!((built.features, built.houses), (6, 6));
    // Alone it is a town that stands nowhere on the earth.
    let layers = surveyed(files.path(), &maps[..1]);
    let text = town("town", &layers);
    assert!(text.contains("a survey of its own"), "{text}");
    assert_eq!(in_folder(&text, files.path(), |_| {}).houses, 2);
}

/// Maps in metres without a word of it, small enough that each coordinate could be one in degrees.
#[test]
fn small_maps_in_metres_are_no_degrees() {
    let houses: Vec<(i32, i32, &str)> = (-15..15)
        .flat_map(|i| (-6..6).map(move |j| (i * 9, j * 12, r#""building":"yes""#)))
        .collect();
    let road = r#"{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"highway":"residential"},"geometry":{"type":"LineString","coordinates":[[-120,-3],[120,-3]]}}]}"#;
    let tree = r#"{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"natural":"tree"},"geometry":{"type":"Point","coordinates":[3,-2]}}]}"#;
    let far = r#"{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"natural":"tree"},"geometry":{"type":"Point","coordinates":[135.7,35.01]}}]}"#;
    let files = folder(&[
        ("houses.geojson", squares(&houses)),
        ("roads.geojson", road.to_owned()),
        ("trees.geojson", tree.to_owned()),
    ]);
    let layers = surveyed(
        files.path(),
        &["houses.geojson", "roads.geojson", "trees.geojson"],
    );
    let planes: Vec<&Plane> = layers.iter().map(|l| &l.plane).collect();
    assert_eq!(planes, [&Plane::Metres; 3]);
    let text = town("town", &layers);
    assert_eq!(text.matches("crs=\"local\"").count(), 3, "{text}");
    let built = in_folder(&text, files.path(), |_| {});
    assert_eq!((built.features, built.houses), (360, 360));
    // A town that says nothing of them is refused before anything is looked for across continents.
    let silent = text.replace(" crs=\"local\"", "");
    let built = in_folder(&silent, files.path(), |_| {});
    assert_eq!(built.features, 0);
    assert!(
        built.found.contains(&"HSD1143".to_owned()),
        "{:?}",
        built.found
    );
    // Points in degrees stay what they are.
    let files = folder(&[("trees.geojson", far.to_owned())]);
    let layers = surveyed(files.path(), &["trees.geojson"]);
    assert_eq!(layers[0].plane, Plane::Said("EPSG:4326".into()));
}

/// Coordinates of a plane zone in a file that should have degrees.
#[test]
fn plane_coordinates_without_a_word_of_it_are_metres() {
    let files = folder(&[(
        "houses.geojson",
        squares(&[
            (-21_000, -110_000, r#""building":"yes""#),
            (-20_990, -110_000, r#""building":"yes""#),
        ]),
    )]);
    let layers = surveyed(files.path(), &["houses.geojson"]);
    assert_eq!((layers[0].features, &layers[0].plane), (2, &Plane::Metres));
    assert!(layers[0].files[0].faults.iter().next().is_none());
    let built = in_folder(&town("town", &layers), files.path(), |_| {});
    assert_eq!(built.houses, 2);
}

#[test]
fn grids_in_sheets_are_one_ground() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["hill-houses.geojson", "hill-roads.geojson"] {
        fs::copy(
            root().join("examples/towns").join(name),
            folder.path().join(name),
        )
        .expect("is there");
    }
    // The hill, cut into a western and an eastern half, and a sheet far off.
    let hill = fs::read_to_string(root().join("examples/towns/hill.asc")).expect("is there");
    let number = |name: &str| -> f64 {
        let line = hill.lines().find(|l| l.to_lowercase().starts_with(name));
        let value = line.and_then(|l| l.split_whitespace().nth(1));
        value.and_then(|v| v.parse().ok()).expect("is there")
    };
    let is_head = |line: &&str| line.starts_with(|c: char| c.is_ascii_alphabetic());
    let head: Vec<&str> = hill.lines().filter(is_head).collect();
    let rows: Vec<Vec<&str>> = hill
        .lines()
        .filter(|l| !is_head(l))
        .map(|l| l.split_whitespace().collect())
        .collect();
    let half = rows[0].len() / 2;
    let cell = number("cellsize");
    let corner = if hill.contains("xllcenter") {
        "xllcenter"
    } else {
        "xllcorner"
    };
    let part = |from: usize, to: usize, west: f64| {
        let mut text = String::new();
        for line in &head {
            let name = line.split_whitespace().next().unwrap_or_default();
            let _ = match name.to_lowercase().as_str() {
                "ncols" => writeln!(text, "ncols {}", to - from),
                "xllcenter" | "xllcorner" => writeln!(text, "{name} {west}"),
                _ => writeln!(text, "{line}"),
            };
        }
        for row in &rows {
            let _ = writeln!(text, "{}", row[from..to].join(" "));
        }
        text
    };
    let west = number(corner);
    fs::create_dir(folder.path().join("dem")).expect("is made");
    // One column in common, so that no place between the halves is without a height.
    let sheets = [
        ("dem/1.asc", part(0, half + 1, west)),
        (
            "dem/2.asc",
            part(half, rows[0].len(), west + cell * half as f64),
        ),
        ("dem/3.asc", part(0, half, west + 1.0e6)),
    ];
    for (name, text) in &sheets {
        fs::write(folder.path().join(name), text).expect("is written");
    }
    fs::write(folder.path().join("hill.asc"), &hill).expect("is written");
    let town = fs::read_to_string(root().join("examples/towns/hill.hsd")).expect("is there");
    let whole = in_folder(&town, folder.path(), |_| {});
    let sheets = town.replace("src=\"hill.asc\"", "src=\"dem/*.asc\"");
    let cut = in_folder(&sheets, folder.path(), |plan| {
        assert_eq!(plan.ground.layers().len(), 2);
    });
    assert_eq!(whole.rows, cut.rows);
    assert_eq!(whole.found, cut.found);
}
