//! What stands in the streets of a town: poles that reach every house, signals of crossing roads that never agree, whole bays, signs
//! with their letters.

use crate::town_streets::{area, feature, folder, line, made, point, square, text};
use crate::towns::{in_folder, number};
use hsd::ast::{House, Sheet};
use hsd::glam::{DVec2, DVec3, dvec2};
use std::fs;
use std::path::{Path, PathBuf};

/// The sheets of a kind, each with the place that its faces count from.
fn sheets<'h>(houses: &'h [House], word: &'h str) -> impl Iterator<Item = (&'h Sheet, DVec3)> {
    let of = |v: &Option<hsd::source::Spanned<f64>>| v.as_ref().map_or(0.0, |v| v.value);
    houses.iter().flat_map(move |house| {
        let base = DVec3::new(of(&house.settings.x), of(&house.settings.y), 0.0);
        let outdoors = house.fittings.outdoors.iter();
        let outdoors = outdoors.filter(move |it| it.word == word);
        outdoors.flat_map(move |it| it.sheets.iter().map(move |sheet| (sheet, base)))
    })
}

/// The places of poles: the middles of the tops of their columns.
fn poles(houses: &[House], word: &str) -> Vec<DVec2> {
    let near = sheets(houses, word).filter(|(sheet, _)| sheet.least == 2);
    let near = near.filter(|(sheet, _)| ["concrete", "cedar_dark"].contains(&sheet.finish));
    let mut found = vec![];
    for (sheet, base) in near {
        let tops = sheet.faces.iter().filter(|face| face.len() == 8);
        found.extend(tops.map(|top| (top.iter().sum::<DVec3>() / 8.0 + base).truncate()));
    }
    found
}

/// Both ends of the wires of networks: the first and the last ribbon of each.
fn wires(houses: &[House], word: &str) -> usize {
    let near = sheets(houses, word).filter(|(sheet, _)| sheet.least == 2 && sheet.finish == "iron");
    // Eight pieces, each seen from both sides.
    near.map(|(sheet, _)| sheet.faces.len() / 16).sum()
}

pub(crate) fn off(ring: &[DVec2], p: DVec2) -> f64 {
    let side = |i: usize| {
        let (a, b) = (ring[i], ring[(i + 1) % ring.len()]);
        let t = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        a.lerp(b, t).distance(p)
    };
    (0..ring.len()).map(side).fold(f64::INFINITY, f64::min)
}

pub(crate) fn inside(ring: &[DVec2], p: DVec2) -> bool {
    let crossed = (0..ring.len()).filter(|i| {
        let (a, b) = (ring[*i], ring[(i + 1) % ring.len()]);
        (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
    });
    crossed.count() % 2 == 1
}

#[test]
fn poles_of_a_line_stand_in_whole_spans_with_their_wires() {
    let lines = [line("", &[(0.0, 0.0), (60.0, 0.0), (60.0, 40.0)])];
    let folder = folder(&[("lines", &lines)]);
    let rule = "<for each=\"lines\"><Pole spacing=\"27\" wires=\"4\" made=\"wood\"/></for>";
    let houses = made(&text(&["lines"], rule), folder.path());
    let found = poles(&houses, "pole");
    assert_eq!(found.len(), 5, "four spans of 25 m");
    assert!(found[2].distance(dvec2(50.0, 0.0)) < 1e-6, "{}", found[2]);
    assert!(found[3].distance(dvec2(60.0, 15.0)) < 1e-6, "{}", found[3]);
    assert_eq!(wires(&houses, "pole"), 4 * 4);
    // They hang down by the share of their span, in the middle.
    let (iron, _) = sheets(&houses, "pole")
        .find(|(sheet, _)| sheet.finish == "iron" && sheet.least == 2)
        .expect("has wires");
    let first = &iron.faces[..16];
    let heights = first.iter().flatten().map(|p| p.z);
    let (low, high) = heights.fold((9e9, 0.0), |(low, high), z| {
        (f64::min(low, z), f64::max(high, z))
    });
    assert!(
        (high - low - 25.0 * 0.02 - 0.022).abs() < 1e-6,
        "{low} {high}"
    );
    let plain = "<for each=\"lines\"><Wire height=\"12\" wires=\"2\"/></for>";
    let houses = made(&text(&["lines"], plain), folder.path());
    assert_eq!(
        (wires(&houses, "wire"), poles(&houses, "wire").len()),
        (4, 0)
    );
}

#[test]
fn a_network_reaches_houses_that_stand_far_behind_and_joins_streets() {
    let roads = [
        line(r#""width":6"#, &[(0.0, 0.0), (90.0, 0.0)]),
        line(r#""width":4"#, &[(45.0, 0.0), (45.0, 60.0)]),
    ];
    let houses = [
        square("", (0.0, 4.0), 8.0),
        square("", (78.0, 58.0), 8.0),
        square("", (300.0, 0.0), 8.0),
    ];
    let folder = folder(&[("roads", &roads), ("houses", &houses)]);
    let rules = "<for each=\"houses\"><Place type=\"hiraya\"/></for><for each=\"roads\"><Network spacing=\"30\" wires=\"1\"/></for>";
    let text = text(&["roads", "houses"], rules);
    let built = in_folder(&text, folder.path(), |_| {});
    let rows: Vec<&str> = built
        .rows
        .iter()
        .filter(|r| r["type"] == "network")
        .map(|r| &*r["parameters"])
        .collect();
    // Three poles and a house at the wide street; two, a house and one pole before it at the other. The third house is too far away.
    assert_eq!(rows, ["poles=3 houses=1", "poles=3 houses=1 between=1"]);
    let houses = made(&text, folder.path());
    // Two and one spans along the streets, one between them, one to the pole before the house, two houses.
    assert_eq!(wires(&houses, "network"), 2 + 1 + 1 + 1 + 2);
}

fn data(folder: &str) -> PathBuf {
    let data = std::env::var_os("HSD_SHARED_DATA").map(PathBuf::from);
    let data = data.unwrap_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data"));
    data.join(folder)
}

/// A folder with the roads and houses of Kyoto, and a point at each place where two of its roads meet.
fn kyoto() -> tempfile::TempDir {
    let (folder, data) = (
        tempfile::tempdir().expect("a folder"),
        data("osm_kyoto_route18"),
    );
    for name in ["buildings.geojson", "roads.geojson"] {
        fs::copy(data.join(name), folder.path().join(name)).expect("is copied");
    }
    let roads = fs::read_to_string(data.join("roads.geojson")).expect("is there");
    let roads: serde_json::Value = serde_json::from_str(&roads).expect("is JSON");
    let mut known = std::collections::BTreeMap::new();
    for road in roads["features"].as_array().expect("a list") {
        for place in road["geometry"]["coordinates"].as_array().expect("a line") {
            *known.entry(place.to_string()).or_insert(0) += 1;
        }
    }
    let meets = known.iter().filter(|(_, count)| **count > 1);
    let points: Vec<String> = meets
        .map(|(place, _)| feature("", "Point", place))
        .collect();
    let text = format!(
        r#"{{"type":"FeatureCollection","features":[{}]}}"#,
        points.join(",")
    );
    fs::write(folder.path().join("signals.geojson"), text).expect("is written");
    folder
}

const KYOTO: &str = r#"<Town seed="1"><Layer name="houses" src="buildings.geojson"/><Layer name="roads" src="roads.geojson"/>
    <Layer name="signals" src="signals.geojson"/>
    <for each="houses"><Place type="house" on="outline"/></for>
    <for each="roads"><Network spacing="28" wires="1"/></for><for each="signals"><Signal/></for></Town>"#;

#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn every_house_of_kyoto_is_within_20_metres_of_a_pole_that_stands_in_no_wall() {
    let folder = kyoto();
    let mut rings: Vec<Vec<DVec2>> = vec![];
    let built = in_folder(KYOTO, folder.path(), |plan| {
        let lots = plan.layers[0].lots.iter();
        rings = lots
            .filter_map(|lot| lot.shape.ring().map(<[DVec2]>::to_vec))
            .collect();
    });
    let served: f64 = built
        .rows
        .iter()
        .filter(|r| r["type"] == "network")
        .filter_map(|r| {
            let houses = r["parameters"]
                .split(' ')
                .find_map(|p| p.strip_prefix("houses="))?;
            houses.parse::<f64>().ok()
        })
        .sum();
    assert_eq!(served as usize, rings.len(), "each house has one wire");
    let houses = made(KYOTO, folder.path());
    let found = poles(&houses, "network");
    let far = rings
        .iter()
        .filter(|ring| !found.iter().any(|pole| off(ring, *pole) <= 20.0 + 1e-6));
    assert_eq!(far.count(), 0, "{} poles", found.len());
    let branches: f64 = built
        .rows
        .iter()
        .filter_map(|r| {
            let between = r["parameters"]
                .split(' ')
                .find_map(|p| p.strip_prefix("between="))?;
            between.parse::<f64>().ok()
        })
        .sum();
    let walled = found
        .iter()
        .filter(|pole| rings.iter().any(|ring| inside(ring, **pole)))
        .count();
    println!(
        "{} poles, {branches} between houses, {walled} in outlines",
        found.len()
    );
    assert_eq!(walled, 0, "of {branches}");
}

#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn signals_of_crossing_roads_of_kyoto_never_show_the_same_light() {
    let folder = kyoto();
    let built = in_folder(KYOTO, folder.path(), |_| {});
    let (mut crossings, mut pairs) = (0, 0);
    for row in built.rows.iter().filter(|row| row["type"] == "signal") {
        let lamps = row["parameters"].strip_prefix("lamps=").expect("has lamps");
        let lamps: Vec<(f64, &str)> = lamps
            .split(", ")
            .map(|lamp| {
                let (way, color) = lamp.split_once(' ').expect("direction and colour");
                (way.parse().expect("degrees"), color)
            })
            .collect();
        crossings += usize::from(lamps.len() > 2);
        for (n, (one, a)) in lamps.iter().enumerate() {
            for (two, b) in &lamps[..n] {
                let off = (one - two).rem_euclid(180.0);
                let off = off.min(180.0 - off);
                // Up to their sense, roads of nearly one direction are one.
                if off > 61.0 {
                    pairs += 1;
                    assert_ne!(a, b, "{} at {}", row["parameters"], row["key"]);
                }
                if off < 1.0 {
                    assert_eq!(a, b, "{} at {}", row["parameters"], row["key"]);
                }
            }
        }
        assert!(
            lamps.iter().any(|(_, lamp)| *lamp == "green"),
            "{}",
            row["parameters"]
        );
    }
    println!("{crossings} crossings, {pairs} pairs of roads");
    assert!(crossings > 500 && pairs > 2000, "{crossings} {pairs}");
}

#[test]
fn all_signals_of_a_crossing_agree() {
    let roads = [
        line(r#""width":12"#, &[(-60.0, 0.0), (0.0, 0.0), (60.0, 0.0)]),
        line(r#""width":6"#, &[(0.0, -50.0), (0.0, 0.0), (0.0, 50.0)]),
    ];
    let signals = [
        point(r#""way":-1"#, (3.0, 4.0)),
        point(r#""way":90"#, (-7.0, 5.0)),
        point(r#""way":180"#, (4.0, 8.0)),
    ];
    let folder = folder(&[("roads", &roads), ("signals", &signals)]);
    let rules = "<for each=\"roads\"><Road/></for><for each=\"signals\"><if test=\"{way &lt; 0}\"><Signal/></if><else><Signal azimuth=\"{way}\"/></else></for>";
    let built = in_folder(&text(&["roads", "signals"], rules), folder.path(), |_| {});
    let lamps: Vec<&str> = built
        .rows
        .iter()
        .filter(|r| r["type"] == "signal")
        .map(|r| &*r["parameters"])
        .collect();
    let all: Vec<&str> = lamps[0]
        .strip_prefix("lamps=")
        .expect("lamps")
        .split(", ")
        .collect();
    assert_eq!(all.len(), 4, "{lamps:?}");
    let of = |way: &str| {
        all.iter()
            .find(|l| l.starts_with(way))
            .expect("comes in")
            .split(' ')
            .next_back()
            .expect("colour")
            .to_owned()
    };
    assert_ne!(of("0 "), of("90 "));
    assert_eq!(lamps[1], format!("lamps=90 {}", of("90 ")));
    assert_eq!(lamps[2], format!("lamps=180 {}", of("180 ")));
}

#[test]
fn a_torii_is_as_wide_as_its_line_and_looks_to_the_left() {
    let lines = [line("", &[(0.0, 0.0), (3.0, 0.4), (7.28, 0.0)])];
    let folder = folder(&[("lines", &lines)]);
    let houses = made(
        &text(&["lines"], "<for each=\"lines\"><Torii/></for>"),
        folder.path(),
    );
    let [house] = &houses[..] else {
        panic!("one torii")
    };
    let [part] = &house.fittings.puts[..] else {
        panic!("one part")
    };
    assert_eq!(part.code.value.as_str(), "ORI 4");
    let (width, height) = (part.width.expect("width"), part.height.expect("height"));
    // In units of three shaku; twice its own width makes it twice as high.
    assert!((width * 10.0 / 11.0 - 7.28).abs() < 0.01 * 7.28, "{width}");
    assert!((height / 13.0 - width / 4.0).abs() < 1e-9, "{height}");
    // The line runs to the east: left is north, and an azimuth of 0 looks there.
    let azimuth = house.settings.azimuth.as_ref().expect("faces").value;
    assert!(
        azimuth
            .rem_euclid(360.0)
            .min(360.0 - azimuth.rem_euclid(360.0))
            < 1e-6,
        "{azimuth}"
    );
}

#[test]
fn an_arcade_has_whole_bays_and_a_closed_roof() {
    let lines = [line("", &[(0.0, 0.0), (20.0, 0.0), (20.0, 13.0)])];
    let folder = folder(&[("lines", &lines)]);
    let rule = "<for each=\"lines\"><Arcade depth=\"3\" bay=\"4\"/></for>";
    let town = text(&["lines"], rule);
    let built = in_folder(&town, folder.path(), |_| {});
    assert_eq!(built.rows[0]["parameters"], "bays=8 depth=3");
    let houses = made(&town, folder.path());
    let (roof, _) = sheets(&houses, "arcade")
        .find(|(sheet, _)| sheet.finish == "seam_roof")
        .expect("a roof");
    // Each edge of the roof belongs to two faces, once in each sense.
    let key = |p: DVec3| (p * 1e4).round().to_array().map(|v| v as i64);
    let mut edges = std::collections::BTreeMap::new();
    for face in &roof.faces {
        for i in 0..face.len() {
            *edges
                .entry([key(face[i]), key(face[(i + 1) % face.len()])])
                .or_insert(0) += 1;
        }
    }
    let open = edges.keys().filter(|[p, q]| !edges.contains_key(&[*q, *p]));
    assert_eq!(open.count(), 0);
    let upper: f64 = roof
        .faces
        .iter()
        .map(|face| {
            let flat: Vec<DVec3> = face.iter().map(|p| p.truncate().extend(0.0)).collect();
            area(&flat).max(0.0)
        })
        .sum();
    // To the right of a left turn lies its outside.
    assert!(
        (upper - (20.0 * 3.0 + 13.0 * 3.0 + 9.0)).abs() < 1e-6,
        "{upper}"
    );
    assert!(number(&built.rows[0], "x") > 0.0);
}

/// The bytes of a font that this machine has.
fn font() -> Option<Vec<u8>> {
    [
        "/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc",
        "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    ]
    .iter()
    .find_map(|path| fs::read(path).ok())
}

#[test]
fn a_sign_bears_its_name_on_both_sides() {
    let signs = [
        point(r#""name":"LO 4""#, (5.0, 4.0)),
        point(r#""name":"""#, (9.0, 4.0)),
        point(r#""name":"四条通""#, (13.0, 4.0)),
    ];
    let folder = folder(&[
        ("signs", &signs),
        ("roads", &[line("", &[(0.0, 0.0), (40.0, 0.0)])]),
    ]);
    let rules = "<for each=\"signs\"><Sign text=\"{name}\" size=\"0.3\"/></for>";
    let plain = text(&["signs", "roads"], rules);
    let bare = in_folder(&plain, folder.path(), |_| {});
    let told = |what: &str| {
        bare.told
            .iter()
            .any(|[code, _, message]| code == "HSD1170" && message.contains(what))
    };
    assert!(
        told("no letter of our own for \"四\"") && told("60 letters at most"),
        "{:?}",
        bare.told
    );
    // Without a font there are capitals and figures of our own: L, O with its middle open, and 4.
    assert_eq!(bare.rows[0]["parameters"], "text=LO 4");
    let houses = made(&plain, folder.path());
    let ink = sheets(&houses, "sign").find(|(sheet, _)| sheet.finish == "road_paint");
    let (ink, _) = ink.expect("has letters");
    let of = |face: &Vec<DVec3>| (face[1] - face[0]).cross(face[2] - face[0]).length() / 2.0;
    let inked: f64 = ink.faces.iter().map(of).sum::<f64>() / 2.0;
    // Strokes of 0.84 on a grid of which a letter 0.3 m high has 8.4: an L of 10, an O of 17.7, a 4 of 15, and their ends.
    let unit = 0.3 / 8.4;
    let strokes = (10.0 + 17.7 + 15.0 + 2.5) * 0.84 * unit * unit;
    assert!((inked / strokes - 1.0).abs() < 0.15, "{inked} of {strokes}");
    let lettered = plain.replacen("<Town ", "<Town font=\"gothic.ttf\" ", 1);
    let missing = in_folder(&lettered, folder.path(), |_| {});
    assert!(
        missing.found.contains(&"HSD1172".to_owned()),
        "{:?}",
        missing.found
    );
    fs::write(folder.path().join("gothic.ttf"), "no font").expect("is written");
    assert!(
        in_folder(&lettered, folder.path(), |_| {})
            .told
            .iter()
            .any(|[code, place, _]| code == "HSD1172" && place == "gothic.ttf")
    );
    let Some(bytes) = font() else {
        println!("left out: no font of Noto Sans CJK or DejaVu is installed");
        return;
    };
    fs::write(folder.path().join("gothic.ttf"), bytes).expect("is written");
    let built = in_folder(&lettered, folder.path(), |_| {});
    assert_eq!(
        built
            .rows
            .iter()
            .find(|r| r["type"] == "sign")
            .expect("is built")["parameters"],
        "text=LO 4"
    );
    let houses = made(&lettered, folder.path());
    let (ink, _) = sheets(&houses, "sign")
        .find(|(sheet, _)| sheet.finish == "road_paint")
        .expect("has letters");
    // The letters of the side that faces the traffic from the east, along the street, and the same behind.
    let share = |out: f64| -> f64 {
        let own = ink
            .faces
            .iter()
            .map(|face| (face[1] - face[0]).cross(face[2] - face[0]) / 2.0);
        own.filter(|area| area.x * out > 0.0)
            .map(DVec3::length)
            .sum()
    };
    let (front, back) = (share(1.0), share(-1.0));
    assert!(
        (front - back).abs() < 1e-9 && front > 0.02,
        "{front} {back}"
    );
    // A ring of an O is hollow: L, O and 4 cover less than a third of their boxes.
    assert!(front < 3.0 * 0.3 * 0.3 / 3.0, "{front}");
    let high = ink.faces.iter().flatten().map(|p| p.z);
    let (low, high) = high.fold((9e9, 0.0), |(low, high), z| {
        (f64::min(low, z), f64::max(high, z))
    });
    assert!(
        low > 2.2 && high < 2.2 + 0.3 * 1.7 && high - low > 0.2 && high - low < 0.25,
        "{low} {high}"
    );
}
