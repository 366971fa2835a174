//! `Rear`: what stands behind the house of a lot, and what is said where nothing can.

use crate::towns::{Built, in_folder, number};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;

const ROAD: &str = r#"{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"width":4},"geometry":{"type":"LineString","coordinates":[[-500,-3],[1500,-3]]}}]}"#;

type Row = BTreeMap<String, String>;
type Point = [f64; 2];

/// Evaluates rules over lots of these keys and corners.
fn lots(rules: &str, lots: &[(String, Vec<Point>)]) -> Built {
    let mut map = String::new();
    for (key, ring) in lots {
        let _ = write!(
            map,
            r#"{{"type":"Feature","properties":{{"key":"{key}"}},"geometry":{{"type":"Polygon","coordinates":[{:?}]}}}}"#,
            ring.iter().chain(&ring[..1]).collect::<Vec<_>>()
        );
        map.push('\n');
    }
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("lots.geojsonl"), map).expect("is written");
    fs::write(folder.path().join("roads.geojson"), ROAD).expect("is written");
    let text = format!(
        r#"<Town seed="1"><Layer name="lots" src="lots.geojsonl" crs="local" key="key"/><Layer name="roads" src="roads.geojson" crs="local"/>{rules}</Town>"#
    );
    in_folder(&text, folder.path(), |_| {})
}

fn rectangle(key: &str, x: f64, width: f64, depth: f64) -> (String, Vec<Point>) {
    let ring = vec![[x, 0.0], [x + width, 0.0], [x + width, depth], [x, depth]];
    (key.to_owned(), ring)
}

fn behind(gap: &str, density: &str) -> String {
    format!(
        r#"<for each="lots"><Place type="chu-nikai" on="plot" cap="9" {gap}/><Rear {density}/></for>"#
    )
}

/// Returns the corners of the rectangle that a line of the table describes.
fn corners(row: &Row) -> [Point; 4] {
    let at = |name: &str| number(row, name);
    let (p, q) = (
        [at("front_x1"), at("front_y1")],
        [at("front_x2"), at("front_y2")],
    );
    let length = f64::hypot(q[0] - p[0], q[1] - p[1]);
    let depth = at("depth") / length;
    // The house lies on the left of its front.
    let back = [(p[1] - q[1]) * depth, (q[0] - p[0]) * depth];
    let moved = |of: Point| [of[0] + back[0], of[1] + back[1]];
    [p, q, moved(q), moved(p)]
}

fn contains(ring: &[Point], p: Point) -> bool {
    let sides = ring.iter().zip(ring.iter().cycle().skip(1));
    let crossed = sides.filter(|(a, b)| {
        (a[1] > p[1]) != (b[1] > p[1])
            && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    });
    crossed.count() % 2 == 1
}

/// Returns places all over a rectangle, a centimetre inside its walls.
fn places([p, q, r, _]: [Point; 4]) -> Vec<Point> {
    const STEPS: usize = 12;
    let share = |n: usize| 0.005 + 0.99 * n as f64 / STEPS as f64;
    let place = |n: usize| {
        let (a, b) = (share(n % (STEPS + 1)), share(n / (STEPS + 1)));
        [0, 1].map(|i| p[i] + (q[i] - p[i]) * a + (r[i] - q[i]) * b)
    };
    (0..(STEPS + 1) * (STEPS + 1)).map(place).collect()
}

#[test]
fn rows_stand_along_an_alley_as_worked_out_by_hand() {
    // A lot of 10 by 30 m. The house is 9 m wide and 9 m deep; the way of 1 m beside it takes a gate of 0.9 m. The yard ends
    // 2 ken (3.636 m) behind the house, so rows begin at 12.788 with their gables; 6 dwellings of 2.727 m end at 29.152. The alley
    // of 4 shaku lies in the middle, from 4.394 to 5.606, and rows of 2 ken on both sides of it: 12 dwellings have room.
    let lot = [rectangle("a", 0.0, 10.0, 30.0)];
    let gap = r#"gap="1" gap_at="right""#;
    let keys = |built: &Built| -> Vec<String> {
        built
            .rows
            .iter()
            .map(|r| format!("{} {}", r["key"], r["what"]))
            .collect()
    };
    let half = lots(&behind(gap, r#"density="0.5""#), &lot);
    assert_eq!(
        keys(&half),
        [
            "a plot",
            "a/row rear",
            "a/gate rear",
            "a/well rear",
            "a/privy rear"
        ]
    );
    assert_eq!((half.features, half.built, half.houses), (1, 1, 5));
    assert_eq!(half.found, [""; 0]);
    let row = &half.rows[1];
    let wanted = [
        ("facing", 90.0),
        ("front_x1", 4.394),
        ("front_y1", 12.788),
        ("front_x2", 4.394),
        ("front_y2", 29.152),
        ("depth", 3.636),
    ];
    for (name, value) in wanted {
        assert!(
            (number(row, name) - value).abs() < 0.0011,
            "{name}: {row:?}"
        );
    }
    assert!(
        row["parameters"].contains("dwellings=6 width=3 depth=4"),
        "{row:?}"
    );
    assert_eq!((&*row["type"], &*row["rule"]), ("ura-nagaya", "1"));
    let gate = &half.rows[2];
    assert!((number(gate, "front_x1") - 9.05).abs() < 0.0011, "{gate:?}");
    assert!(gate["parameters"].contains("width=0.9"), "{gate:?}");
    assert!(
        half.rows[4]["parameters"].contains("stalls=2"),
        "6 dwellings"
    );

    let full = lots(&behind(gap, r#"density="1""#), &lot);
    let dwellings = |row: &Row| row["parameters"].contains("dwellings=6");
    assert_eq!(full.rows.iter().filter(|r| dwellings(r)).count(), 2);
    assert_eq!(
        number(&full.rows[2], "facing"),
        270.0,
        "the other side of the alley"
    );
    let least = lots(&behind(gap, r#"density="0.01""#), &lot);
    assert!(
        least.rows[1]["parameters"].contains("dwellings=2"),
        "one row at least"
    );
    // Without a way beside the house there is no gate, and the table says so.
    let closed = lots(&behind("", r#"density="0.5""#), &lot);
    let gate = closed
        .rows
        .iter()
        .find(|r| r["key"] == "a/gate")
        .expect("a line");
    assert!(
        gate["what"] == "no room" && gate["why"].contains("3 shaku"),
        "{gate:?}"
    );
    // One row where the lot is narrow, none where it is narrower: 3 ken less what an alley may lose.
    let narrow = lots(
        &behind("", r#"density="1""#),
        &[rectangle("a", 0.0, 5.5, 30.0)],
    );
    assert_eq!(
        keys(&narrow).iter().filter(|k| k.contains("row")).count(),
        1
    );
    let least = lots(
        &behind("", r#"density="1""#),
        &[rectangle("a", 0.0, 4.8, 30.0)],
    );
    assert!(
        keys(&least).contains(&"a/row no room".to_owned()),
        "{:?}",
        keys(&least)
    );
    assert!(
        keys(&least).contains(&"a/kura rear".to_owned()),
        "the owner keeps it"
    );
}

#[test]
fn an_owner_has_more_behind_his_house_the_deeper_his_lot_is() {
    let of = |depth: f64| -> Vec<String> {
        let built = lots(&behind("", ""), &[rectangle("a", 0.0, 7.0, depth)]);
        assert_eq!(built.found, [""; 0]);
        built.rows[1..]
            .iter()
            .map(|r| format!("{} {}", r["key"], r["what"]))
            .collect()
    };
    assert_eq!(of(11.9), ["a/rear no room"]);
    assert_eq!(of(12.1), ["a/rear no room"], "its yard is too small");
    assert_eq!(of(16.0), ["a/privy rear"]);
    let one = of(24.0);
    assert!(
        one == ["a/kura rear"] || one == ["a/hanare rear"],
        "{one:?}"
    );
    assert_eq!(of(34.0), ["a/kura rear", "a/hanare rear"]);
}

#[test]
fn nothing_leaves_its_lot_or_stands_in_another_house() {
    // Lots side by side whose borders and back lines slant and break, by a fixed sequence of numbers.
    let mut state = 11u64;
    let mut next = |from: f64, to: f64| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        from + (to - from) * ((state >> 40) as f64 / (1u64 << 24) as f64)
    };
    let mut all = vec![];
    let (mut x, mut back) = (0.0, 0.0);
    for n in 0..60 {
        let (front, depth) = (next(5.0, 14.0), next(14.0, 44.0));
        let next_back = back + front + next(-1.5, 1.5);
        let mut ring = vec![[x, 0.0], [x + front, 0.0], [next_back, depth]];
        if n % 3 == 0 {
            // The back line has a notch.
            let (middle, notch) = ((next_back + back) / 2.0, next(0.5, 0.8) * depth);
            ring.push([middle, depth]);
            ring.push([middle, notch]);
            ring.push([back, notch]);
        } else {
            ring.push([back, next(0.9, 1.1) * depth]);
        }
        all.push((format!("l{n}"), ring));
        (x, back) = (x + front, next_back);
    }
    for density in ["", r#"density="0.6""#] {
        let built = lots(&behind(r#"gap="1.2" gap_at="left""#, density), &all);
        let standing = |r: &&Row| ["plot", "rear"].contains(&&*r["what"]);
        let houses: Vec<&Row> = built.rows.iter().filter(standing).collect();
        let behind: Vec<&Row> = houses
            .iter()
            .copied()
            .filter(|r| r["what"] == "rear")
            .collect();
        assert!(behind.len() > 40, "{} houses stand behind", behind.len());
        let rings: Vec<[Point; 4]> = houses.iter().map(|r| corners(r)).collect();
        for row in behind {
            let key = row["key"].split('/').next().expect("a key");
            let (_, lot) = all.iter().find(|(k, _)| k == key).expect("a lot");
            let own = corners(row);
            for place in places(own) {
                assert!(
                    contains(lot, place),
                    "{} leaves its lot at {place:?}",
                    row["key"]
                );
                let others = rings.iter().filter(|r| **r != own && contains(*r, place));
                assert_eq!(others.count(), 0, "{} stands in a house", row["key"]);
            }
        }
        // Each lot has its line, and a line says what stands behind its house or why nothing does.
        for (key, _) in &all {
            let prefix = format!("{key}/");
            let own = built
                .rows
                .iter()
                .find(|r| r["key"] == *key)
                .expect("a line");
            let told = built.rows.iter().any(|r| r["key"].starts_with(&prefix));
            assert!(told || own["what"] != "plot", "{key}");
        }
        assert_eq!(built.features, built.built + built.skipped);
    }
}

#[test]
fn draws_belong_to_the_lot() {
    let all: Vec<_> = (0..12)
        .map(|n| rectangle(&format!("l{n}"), f64::from(n) * 8.0, 8.0, 25.0))
        .collect();
    let mut turned = all.clone();
    turned.reverse();
    let by_key = |lots_of: &[(String, Vec<Point>)]| -> BTreeMap<String, String> {
        let built = lots(&behind("", ""), lots_of);
        let rows = built.rows.into_iter();
        rows.map(|r| {
            (
                r["key"].clone(),
                format!("{} {}", r["type"], r["parameters"]),
            )
        })
        .collect()
    };
    let one = by_key(&all);
    assert_eq!(one, by_key(&turned));
    for kind in ["kura", "hanare"] {
        assert!(one.keys().any(|key| key.ends_with(kind)), "{kind} is drawn");
    }
}

#[test]
fn what_cannot_be_meant_is_told() {
    let lot = [rectangle("a", 0.0, 9.0, 30.0)];
    let told = |rules: &str| lots(rules, &lot).found.join(" ");
    let place = r#"<Place type="chu-nikai" on="plot"/>"#;
    for density in ["1.5", "-0.1", "{area}", "dense", "{'much'}"] {
        let rules = format!(r#"<for each="lots">{place}<Rear density="{density}"/></for>"#);
        assert_eq!(told(&rules), "HSD1151", "{density}");
    }
    let alone = r#"<for each="lots"><Rear/></for>"#;
    assert_eq!(told(alone), "HSD1152");
    let outline = r#"<for each="lots"><Place type="house" on="outline"/><Rear/></for>"#;
    assert_eq!(told(outline), "HSD1152");
    let roads = format!(r#"<for each="lots">{place}</for><for each="roads"><Rear/></for>"#);
    assert!(told(&roads).contains("HSD1150"), "{}", told(&roads));
    let misspelt = format!(r#"<for each="lots">{place}<Rear densty="1"/></for>"#);
    assert!(told(&misspelt).contains("HSD02"), "{}", told(&misspelt));
    // A second `Rear` builds where the first left room, with names of its own.
    let twice = format!(r#"<for each="lots">{place}<Rear/><Rear/></for>"#);
    let built = lots(&twice, &[rectangle("a", 0.0, 9.0, 46.0)]);
    let keys: std::collections::BTreeSet<&String> = built.rows.iter().map(|r| &r["key"]).collect();
    assert_eq!(keys.len(), built.rows.len(), "{keys:?}");
}
