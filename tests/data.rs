//! The hamlet of `tests/data` in the formats of maps and drawings: the files are whole, have the same houses, and those get whole roofs.

use crate::support::root;
use glam::{DVec2, dvec2};
use hsd::check::solid_flaws;
use hsd::roof::shape::hipped::over;
use hsd::roof::shape::look::Look;
use quick_xml::events::Event;
use serde_json::Value;
use std::fs;

/// Its houses.
const HOUSES: usize = 5;

fn bytes(name: &str) -> Vec<u8> {
    fs::read(root().join("tests/data").join(name)).expect("the file is there")
}

fn text(name: &str) -> String {
    String::from_utf8(bytes(name)).expect("UTF-8")
}

fn json(name: &str) -> Value {
    serde_json::from_slice(&bytes(name)).expect("JSON")
}

/// How many elements of this name an XML file has, which is read to its end.
fn elements(name: &str, element: &str) -> usize {
    let text = text(name);
    let mut reader = quick_xml::Reader::from_str(&text);
    let mut count = 0;
    loop {
        match reader.read_event().expect("well-formed") {
            Event::Start(tag) | Event::Empty(tag) if tag.name().as_ref() == element => count += 1,
            Event::Eof => return count,
            _ => {}
        }
    }
}

/// The outlines of the GeoJSON in metres from the first corner, courts behind each.
fn outlines() -> Vec<Vec<Vec<DVec2>>> {
    let map = json("houses.geojson");
    let features = map["features"].as_array().expect("features");
    let first = &features[0]["geometry"]["coordinates"][0][0];
    let number = |v: &Value| v.as_f64().expect("a number");
    let (lon, lat) = (number(&first[0]), number(&first[1]));
    let metres = |p: &Value| {
        let east = (number(&p[0]) - lon) * 111_320.0 * lat.to_radians().cos();
        dvec2(east, (number(&p[1]) - lat) * 110_940.0)
    };
    let ring = |ring: &Value| -> Vec<DVec2> {
        let points = ring.as_array().expect("a ring");
        points[1..].iter().map(metres).collect()
    };
    let rings = |f: &Value| -> Vec<Vec<DVec2>> {
        let rings = f["geometry"]["coordinates"].as_array().expect("rings");
        rings.iter().map(ring).collect()
    };
    features.iter().map(rings).collect()
}

#[test]
fn the_files_have_the_same_houses() {
    assert_eq!(outlines().len(), HOUSES);
    let city = json("houses.city.json");
    let objects = city["CityObjects"].as_object().expect("objects");
    assert_eq!(objects.len(), HOUSES);
    assert_eq!(elements("houses.gml", "bldg:Building"), HOUSES);
    assert_eq!(elements("hamlet.osm", "way"), HOUSES + 2);
    assert_eq!(elements("hamlet.osm", "relation"), 1);
    let drawing = text("houses.dxf");
    let groups: Vec<&str> = drawing.lines().map(str::trim).collect();
    let closed = groups
        .windows(4)
        .filter(|w| w == &["POLYLINE", "8", "HOUSE", "66"]);
    assert_eq!(closed.count(), HOUSES);
    assert!(groups.ends_with(&["0", "EOF"]) && groups.contains(&"AC1009"));
    assert_eq!(text("ground.asc").lines().count(), 6 + 6);
}

#[test]
fn the_shapefile_is_whole() {
    let (shp, shx, dbf) = (
        bytes("houses.shp"),
        bytes("houses.shx"),
        bytes("houses.dbf"),
    );
    let big =
        |from: &[u8], at: usize| i32::from_be_bytes(from[at..at + 4].try_into().expect("four"));
    for file in [&shp, &shx] {
        assert_eq!(
            (big(file, 0), big(file, 24) as usize * 2),
            (9994, file.len())
        );
    }
    let mut at = 100;
    for house in 0..HOUSES {
        let index = 100 + 8 * house;
        assert_eq!(big(&shx, index) as usize * 2, at);
        assert_eq!(big(&shp, at), house as i32 + 1);
        at += 8 + big(&shp, at + 4) as usize * 2;
    }
    assert_eq!((at, shx.len()), (shp.len(), 100 + 8 * HOUSES));
    let rows = u32::from_le_bytes(dbf[4..8].try_into().expect("four")) as usize;
    let sizes = [8, 10].map(|at| usize::from(u16::from_le_bytes([dbf[at], dbf[at + 1]])));
    assert_eq!((rows, sizes[0] + rows * sizes[1] + 1), (HOUSES, dbf.len()));
    let name = encoding_rs::SHIFT_JIS
        .decode(&dbf[sizes[0] + 5..sizes[0] + 21])
        .0;
    assert_eq!(name.trim_end(), "角屋");
}

#[test]
fn every_house_gets_a_whole_roof() {
    let look = Look::gable(None, &Default::default(), 6.0, 0.909);
    for (number, rings) in outlines().iter().enumerate() {
        let roof = over(&rings[0], &rings[1..], 3.0, &look);
        let roof = roof.unwrap_or_else(|why| panic!("house {number}: {why}"));
        assert!(!roof.solids.is_empty());
        for solid in &roof.solids {
            assert!(solid_flaws(solid).next().is_none(), "house {number}");
        }
    }
}
