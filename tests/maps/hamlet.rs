//! The hamlet of `tests/data` is the same in every format.

use super::{Read, read_in};
use crate::support::root;
use hsd::glam::DVec2;
use hsd::map::{Crs, Datums, Feature, Geometry, Options, Transform, Value};

fn hamlet(name: &str, layer: Option<&str>) -> Read {
    let options = Options {
        layer: layer.map(Box::from),
        ..Options::default()
    };
    read_in(&root().join("tests/data"), name, &options).unwrap()
}

/// The text of a column of a feature.
fn text(read: &Read, feature: &Feature, column: &str) -> String {
    let column = read.columns.iter().position(|c| c == column).unwrap();
    match feature.field(column).unwrap() {
        Value::Text(text) => text.to_string(),
        other => format!("{other:?}"),
    }
}

/// Names, and outlines in metres of the plane zone VI.
fn houses(read: &Read, name: &str) -> Vec<(String, Vec<DVec2>)> {
    let zone = Crs::from_epsg(6674).unwrap();
    let from = read.crs.clone().unwrap();
    let way = Transform::new(&from, &zone, Datums::Exact).unwrap();
    let mut houses: Vec<_> = read
        .features
        .iter()
        .map(|feature| {
            let Geometry::Areas(areas) = &feature.geometry else {
                panic!("{:?}", feature.geometry);
            };
            let points = areas.iter().flat_map(|a| a.rings()).flat_map(|r| &r.points);
            let points: Vec<DVec2> = points.map(|p| way.apply(*p).unwrap()).collect();
            (text(read, feature, name), points)
        })
        .collect();
    houses.sort_by(|p, q| p.0.cmp(&q.0));
    houses
}

/// Every corner of one is a corner of the other, within so many metres.
fn assert_same(one: &[(String, Vec<DVec2>)], two: &[(String, Vec<DVec2>)], within: f64) {
    assert_eq!(one.len(), two.len());
    for ((name, points), (other, corners)) in one.iter().zip(two) {
        assert_eq!(name, other);
        assert_eq!(points.len(), corners.len(), "{name}");
        for p in points {
            let nearest = corners
                .iter()
                .map(|q| p.distance(*q))
                .fold(f64::MAX, f64::min);
            assert!(nearest < within, "{name}: {p} is {nearest} m off");
        }
    }
}

#[test]
fn the_hamlet_is_the_same_in_every_format() {
    let shapes = hamlet("houses.shp", None);
    assert_eq!(shapes.counts(), (5, 0));
    assert_eq!(shapes.crs.as_ref().map(|c| &*c.name), Some("EPSG:6674"));
    assert!(shapes.remarks.is_empty(), "{:?}", shapes.remarks);
    let own = houses(&shapes, "NAME");
    assert_eq!(own[0].0, "中庭の家");
    let json = hamlet("houses.geojson", None);
    assert_same(&houses(&json, "name"), &own, 0.02);
    let flat = hamlet("houses.fgb", None);
    assert_eq!(flat.counts(), (5, 0));
    assert_same(&houses(&flat, "name"), &own, 0.02);
    if cfg!(feature = "geopackage") {
        let package = hamlet("houses.gpkg", None);
        assert_eq!(package.counts(), (5, 0));
        assert!(package.remarks.is_empty(), "{:?}", package.remarks);
        assert_same(&houses(&package, "name"), &own, 0.02);
        assert_eq!(hamlet("houses.gpkg", Some("houses")).counts(), (5, 0));
    }
    if cfg!(feature = "geoparquet") {
        let table = hamlet("houses.parquet", None);
        assert_eq!(table.counts(), (5, 0));
        assert_eq!(table.crs.as_ref().map(|c| &*c.name), Some("EPSG:6674"));
        assert_same(&houses(&table, "name"), &own, 0.02);
    }
    let gml = hamlet("houses.gml", None);
    assert_eq!(gml.counts(), (5, 0));
    assert_same(&houses(&gml, "name"), &own, 0.02);
    let osm = hamlet("hamlet.osm", Some("building"));
    assert_eq!(osm.counts(), (5, 0));
    assert_same(&houses(&osm, "name"), &own, 0.02);
    // Without a theme, the street and the tree come too.
    assert_eq!(hamlet("hamlet.osm", None).counts(), (7, 0));
    assert_eq!(hamlet("street.geojson", None).counts(), (2, 0));
}

#[test]
fn heights_and_storeys_of_plateau_are_numbers() {
    let gml = hamlet("houses.gml", None);
    let column = |name: &str| gml.columns.iter().position(|c| c == name).unwrap();
    let first = &gml.features[0];
    assert_eq!(
        first.field(column("measuredHeight")),
        Some(&Value::Number(5.8))
    );
    assert_eq!(
        first.field(column("storeysAboveGround")),
        Some(&Value::Integer(2))
    );
    assert_eq!(first.id.as_deref(), Some("bldg_a"));
    let court = &gml.features[3];
    assert!(matches!(&court.geometry, Geometry::Areas(areas) if areas[0].holes.len() == 1));
}
