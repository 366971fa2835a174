//! Records of vertices that are joined to outlines (000-25): in their order, with their fields, and what is wrong with them.

use crate::towns::{Built, in_folder};
use hsd::town::plan::Plan;
use std::fs;

const ROAD: &str = r#"{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"width":4},"geometry":{"type":"LineString","coordinates":[[-50,-3],[50,-3]]}}]}"#;

/// Two houses: a rectangle of 6 by 9 m whose records are mixed up, and an L of 8 by 10 m less 4 by 5, both 2 m above zero.
const TABLE: &str = "\
house,number,x,y,z,use
a,3,6,9,2,
b,1,10,0,2,shop
a,1,0,0,2,dwelling
a,4,0,9,2,
b,2,18,0,2,
b,3,18,5,2,
a,2,6,0,2,
b,4,14,5,2,
b,5,14,10,2,
b,6,10,10,2,
";

fn town(layer: &str, table: &str, look: impl FnOnce(&Plan)) -> Built {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in [("vertices.csv", table), ("roads.geojson", ROAD)] {
        fs::write(folder.path().join(name), text).expect("is written");
    }
    let text = format!(
        r#"<Town seed="1"><Layer name="houses" src="vertices.csv" crs="local" {layer}/>
        <Layer name="roads" src="roads.geojson" crs="local"/>
        <for each="houses"><Place type="hiraya"/></for></Town>"#
    );
    in_folder(&text, folder.path(), look)
}

const BY: &str = r#"outline="house" order="number""#;

/// Twice the area of a ring, by the corners.
fn twice_area(ring: &[glam::DVec2]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter()
        .zip(next)
        .map(|(p, q)| p.x * q.y - q.x * p.y)
        .sum()
}

#[test]
fn vertices_become_outlines_in_their_order() {
    let built = town(BY, TABLE, |plan| {
        let houses = &plan.layers[0];
        let keys: Vec<&str> = houses.lots.iter().map(|lot| &*lot.key).collect();
        assert_eq!(keys, ["a", "b"], "in the order of their first records");
        let areas: Vec<f64> = houses
            .lots
            .iter()
            .map(|lot| twice_area(lot.shape.ring().expect("an outline")) / 2.0)
            .collect();
        // By hand: 6 x 9, and 8 x 10 less 4 x 5.
        assert_eq!(areas, [54.0, 60.0]);
        let uses: Vec<Option<String>> = houses.lots.iter().map(|l| houses.word(l, "use")).collect();
        assert_eq!(uses, [Some("dwelling".into()), Some("shop".into())]);
        assert_eq!(houses.lots[0].z, 2.0);
    });
    assert_eq!(built.found, [""; 0]);
    assert_eq!((built.features, built.houses), (2, 2));
    assert_eq!(
        built.rows[0]["facing"], "180.000",
        "to the street in the south"
    );
}

#[test]
fn a_table_and_a_map_of_the_same_outlines_make_the_same_houses() {
    let closed = TABLE.replace("b,6,10,10,2,\n", "b,6,10,10,2,\nb,7,10,0,2,\n");
    let (open, closed) = (town(BY, TABLE, |_| {}), town(BY, &closed, |_| {}));
    let renamed = TABLE.replace("house,number", "家屋,順");
    let japanese = town(r#"outline="家屋" order="順""#, &renamed, |_| {});
    assert_eq!(open.rows, closed.rows);
    assert_eq!(open.rows, japanese.rows);
    // In the order of the file, the rectangle crosses itself.
    let mixed = town(r#"outline="house""#, TABLE, |_| {});
    assert!(
        mixed.found.contains(&"HSD1006".to_owned()),
        "{:?}",
        mixed.found
    );
    let sorted = "house,x,y\na,0,0\na,6,0\na,6,9\na,0,9\n";
    let built = town(r#"outline="house""#, sorted, |_| {});
    assert_eq!((built.found.len(), built.houses), (0, 1));
}

#[test]
fn records_that_make_no_outline_are_told_and_listed() {
    let told = |rows: &str, code: &str, words: &str| {
        let table = format!("{TABLE}{rows}");
        let built = town(BY, &table, |_| {});
        let found: Vec<&[String; 3]> = built.told.iter().filter(|t| t[0] == code).collect();
        let [one] = &found[..] else {
            panic!("{rows}: {:?}", built.told);
        };
        assert!(one[2].contains(words), "{words}: {}", one[2]);
        assert_eq!(one[1], "vertices.csv");
        assert_eq!(built.features, built.built + built.skipped, "{rows}");
        assert!(built.houses >= 2, "the others are built: {rows}");
    };
    told("c,1,30,0,0,\nc,2,36,0,0,\n", "HSD1005", "feature c");
    told(
        "c,1,30,0,0,\nc,2,36,9,0,\nc,3,36,0,0,\nc,4,30,9,0,\n",
        "HSD1006",
        "feature c",
    );
    told(",1,30,0,0,\n", "HSD1158", "names no outline");
    told(
        "c,1,30,0,0,\nc,2,36,0,0,\nc,last,36,9,0,\n",
        "HSD1158",
        "1 vertices of the outline",
    );
    told(
        "c,1,30,0,0,\nc,2,36,0,0,\nc,2,36,9,0,\nc,4,30,9,0,\n",
        "HSD1158",
        "the same number, 2,",
    );
}

#[test]
fn what_a_layer_cannot_say_is_told_at_its_place() {
    let told = |layer: &str| {
        let built = town(layer, TABLE, |_| {});
        [built.told[0][0].clone(), built.told[0][1].clone()]
    };
    assert_eq!(told(r#"outline="hose""#), ["HSD1141", "hose"]);
    assert_eq!(
        told(r#"outline="house" order="numbr""#),
        ["HSD1141", "numbr"]
    );
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("roads.geojson"), ROAD).expect("is written");
    let text = r#"<Town><Layer name="houses" src="roads.geojson" crs="local" outline="width"/><for each="houses"><Skip/></for></Town>"#;
    let built = in_folder(text, folder.path(), |_| {});
    assert_eq!(built.told[0][..2], ["HSD1157", "width"]);
}
