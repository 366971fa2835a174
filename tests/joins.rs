//! Points that are joined to outlines: by place, by key, and what is said of those that are not.

use crate::towns::{Built, in_folder};
use std::fs;

const ROAD: &str = r#"{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"width":4},"geometry":{"type":"LineString","coordinates":[[-50,-3],[50,-3]]}}]}"#;

/// Three houses of 5 by 8 m, from west to east; the second has a use of its own, the third lies round the fourth.
const HOUSES: &str = r#"{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"id":"a"},"geometry":{"type":"Polygon","coordinates":[[[0,0],[5,0],[5,8],[0,8],[0,0]]]}},
{"type":"Feature","properties":{"id":"b","use":"shop"},"geometry":{"type":"Polygon","coordinates":[[[5,0],[10,0],[10,8],[5,8],[5,0]]]}},
{"type":"Feature","properties":{"id":"c"},"geometry":{"type":"Polygon","coordinates":[[[10,0],[30,0],[30,20],[10,20],[10,0]]]}},
{"type":"Feature","properties":{"id":"d"},"geometry":{"type":"Polygon","coordinates":[[[14,0],[19,0],[19,8],[14,8],[14,0]]]}}
]}"#;

/// Evaluates houses joined to points; each house stands where its joined `number` is asked for.
fn joined(join: &str, points: &str, attributes: &str) -> Built {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in [
        ("houses.geojson", HOUSES),
        ("points.csv", points),
        ("roads.geojson", ROAD),
    ] {
        fs::write(folder.path().join(name), text).expect("is written");
    }
    let text = format!(
        r#"<Town seed="1"><Layer name="houses" src="houses.geojson" crs="local" {attributes}>{join}</Layer>
        <Layer name="points" src="points.csv" crs="local"><Field name="owner" from="name"/></Layer>
        <Layer name="roads" src="roads.geojson" crs="local"/>
        <for each="houses"><if test="{{number > 0}}"><Skip because="{{number}} {{use}} {{owner}}"/></if>
        <else><Skip because="none"/></else></for></Town>"#
    );
    in_folder(&text, folder.path(), |_| {})
}

fn what(built: &Built) -> Vec<String> {
    built
        .rows
        .iter()
        .map(|r| format!("{} {}", r["key"], r["why"]))
        .collect()
}

const KEY: &str = r#"key="id""#;

#[test]
fn fields_of_the_point_in_an_outline_are_its_own() {
    // By hand: (2, 4) lies in a; (7, 4) in b; (16, 4) in c and d, of which d is smaller; (25, 10) in c alone.
    let points = "x,y,number,use,name\n2,4,11,dwelling,Ito\n7,4,12,shop,Mori\n16,4,13,store,Abe\n25,10,14,hall,Ono\n";
    let built = joined(r#"<Join layer="points"/>"#, points, KEY);
    assert_eq!(built.found, [""; 0]);
    assert_eq!(
        what(&built),
        [
            "a 11 dwelling Ito",
            "b 12 shop Mori",
            "c 14 hall Ono",
            "d 13 store Abe"
        ]
    );
}

#[test]
fn points_that_are_not_used_are_counted_and_listed() {
    // a has two points, of which (2.4, 4.1) is nearer to its middle (2.5, 4); (2, -1.5) lies 1.5 m before a; b says `shop` itself.
    let points = "x,y,number,use,name\n1,1,1,dwelling,Ito\n2.4,4.1,2,dwelling,Mori\n7,4,3,store,Abe\n7,-1.5,4,hall,Ono\n";
    let built = joined(r#"<Join layer="points"/>"#, points, KEY);
    assert_eq!(what(&built)[..2], ["a 2 dwelling Mori", "b 3 shop Abe"]);
    let mut found = built.found.clone();
    found.retain(|code| code != "HSD1106");
    assert_eq!(found, ["HSD1154", "HSD1155", "HSD1156"]);
    let listed: Vec<String> = built.corrected.iter().map(|c| c.join(" ")).collect();
    assert_eq!(
        listed,
        [
            "points 3 HSD1155 it belongs to no outline",
            "points 0 HSD1154 another point of its outline counts"
        ]
    );
    // Within 2 m it belongs to b, whose own point is nearer.
    let near = joined(r#"<Join layer="points" within="2"/>"#, points, KEY);
    assert_eq!(what(&near)[1], "b 3 shop Abe");
    assert!(
        !near.found.contains(&"HSD1155".to_owned()),
        "{:?}",
        near.found
    );
}

#[test]
fn points_with_a_house_number_belong_to_it_wherever_they_lie() {
    let points = "x,y,house,number,use,name\n90,90,b,5,shop,Ito\n91,90,a,6,dwelling,Mori\n92,90,a,7,hall,Abe\n93,90,zz,8,hall,Ono\n";
    let built = joined(r#"<Join layer="points" by="house"/>"#, points, KEY);
    assert_eq!(
        what(&built)[..2],
        ["a 6 dwelling Mori", "b 5 shop Ito"],
        "the first of a key"
    );
    let told = |code: &str| built.found.iter().any(|c| c == code);
    assert!(told("HSD1154") && told("HSD1155"), "{:?}", built.found);
}

#[test]
fn a_key_and_a_where_may_come_from_the_points() {
    let points = "x,y,number,use,name\n2,4,11,dwelling,Ito\n7,4,12,shop,Mori\n16,4,13,store,Abe\n25,10,14,hall,Ono\n";
    let built = joined(
        r#"<Join layer="points"/>"#,
        points,
        r#"key="owner" where="number > 11""#,
    );
    assert_eq!(
        what(&built),
        ["Mori 12 shop Mori", "Ono 14 hall Ono", "Abe 13 store Abe"]
    );
}

#[test]
fn what_cannot_be_joined_is_told() {
    let points = "x,y,number,use,name\n2,4,11,dwelling,Ito\n";
    let told = |join: &str| joined(join, points, KEY).found.join(" ");
    assert!(told(r#"<Join layer="roads"/>"#).contains("HSD1153"));
    assert!(told(r#"<Join layer="houses"/>"#).contains("HSD1153"));
    assert!(told(r#"<Join layer="poinst"/>"#).contains("HSD1101"));
    assert!(told(r#"<Join layer="points" by="hous"/>"#).contains("HSD1141"));
    assert!(told(r#"<Join layer="points" within="-2"/>"#).contains("HSD02"));
    assert!(told("<Join/>").contains("HSD02"));
    // No points at all are no fault of the join.
    let none = joined(r#"<Join layer="points"/>"#, "x,y,number,use,name\n", KEY);
    assert!(
        !none.found.iter().any(|c| c.starts_with("HSD115")),
        "{:?}",
        none.found
    );
}
