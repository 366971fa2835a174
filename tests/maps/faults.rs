//! What is wrong with a map is named with its feature and field, once a kind.

use super::{Read, read_bytes};
use hsd::diagnostic::{Diagnostics, Language, Origin};
use hsd::map::{Crs, Faults, Kind, Options, Outside, Value};
use std::io::Write;

fn json(text: &str) -> Read {
    read_bytes(&[("a.geojson", text.into())], &Options::default()).unwrap()
}

fn kinds(read: &Read) -> (Vec<&Kind>, Vec<&Kind>) {
    (
        read.lost.iter().map(|f| &f.kind).collect(),
        read.remarks.iter().map(|f| &f.kind).collect(),
    )
}

fn feature(geometry: &str) -> String {
    format!(r#"{{"type":"Feature","properties":{{"n":1}},"geometry":{geometry}}}"#)
}

fn collection(features: &[String]) -> String {
    format!(
        r#"{{"type":"FeatureCollection","features":[{}]}}"#,
        features.join(",\n")
    )
}

const SQUARE: &str = r#"{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,1],[0,0]]]}"#;

#[test]
fn features_without_a_usable_shape_are_named() {
    let broken = [
        ("null", Kind::NoGeometry),
        (r#"{"type":"Polygon","coordinates":[]}"#, Kind::NoGeometry),
        (r#"{"type":"Point","coordinates":[]}"#, Kind::NoGeometry),
        (
            r#"{"type":"LineString","coordinates":[[1,2],[1,2]]}"#,
            Kind::TooFewPoints { points: 1 },
        ),
        (
            r#"{"type":"Polygon","coordinates":[[[0,0],[1,1],[0,0]]]}"#,
            Kind::TooFewPoints { points: 2 },
        ),
        (
            r#"{"type":"Point","coordinates":[null,1]}"#,
            Kind::NotFinite,
        ),
        (r#"{"type":"Point","coordinates":[NaN,1]}"#, Kind::NotFinite),
        (
            r#"{"type":"Circle","coordinates":[0,1]}"#,
            Kind::OtherGeometry {
                name: "Circle".into(),
            },
        ),
    ];
    for (geometry, kind) in broken {
        let read = json(&collection(&[
            feature(SQUARE),
            feature(geometry),
            feature(SQUARE),
        ]));
        assert_eq!(kinds(&read).0, [&kind], "{geometry}");
        assert_eq!(read.features.len(), 2, "{geometry}");
        assert_eq!(read.lost[0].feature.as_ref().unwrap().number, 1);
    }
}

#[test]
fn coordinates_outside_their_system_are_refused() {
    let read = json(&feature(r#"{"type":"Point","coordinates":[35,135]}"#));
    assert!(matches!(
        read.lost[0].kind,
        Kind::OutsideCrs {
            seems: Outside::Swapped,
            ..
        }
    ));
    let options = Options {
        crs: Crs::from_epsg(6674),
        ..Options::default()
    };
    let text = feature(r#"{"type":"Point","coordinates":[135.75,35]}"#);
    let read = read_bytes(&[("a.geojson", text.into())], &options).unwrap();
    assert!(matches!(
        read.lost[0].kind,
        Kind::OutsideCrs {
            seems: Outside::Degrees,
            ..
        }
    ));
}

#[test]
fn flaws_are_told_and_the_feature_is_kept() {
    let cases = [
        (
            r#"[[[0,0],[1,0],[1,0],[1,1],[0,0]]]"#,
            Kind::DoubledPoints { points: 1 },
        ),
        (r#"[[[0,0],[1,0],[1,1]]]"#, Kind::Unclosed),
        (r#"[[[0,0],[4,3],[4,0],[0,3],[0,0]]]"#, Kind::Crossing),
        (
            r#"[[[0,0],[9,0],[9,9],[0,9],[0,0]],[[1,1],[2,2],[1,1]]]"#,
            Kind::DroppedParts { parts: 1 },
        ),
    ];
    for (rings, kind) in cases {
        let read = json(&feature(&format!(
            r#"{{"type":"Polygon","coordinates":{rings}}}"#
        )));
        assert_eq!(
            (read.features.len(), kinds(&read).1),
            (1, vec![&kind]),
            "{rings}"
        );
    }
    let twice = feature(SQUARE).replace(r#""n":1"#, r#""n":1,"n":2"#);
    let read = json(&twice);
    assert_eq!(kinds(&read).1, [&Kind::DuplicateField]);
    assert_eq!(read.features[0].field(0), Some(&Value::Integer(2)));
    let same = feature(SQUARE).replace(r#""properties""#, r#""id":7,"properties""#);
    let read = json(&collection(&[same.clone(), same]));
    assert_eq!(kinds(&read).1, [&Kind::DuplicateKey]);
}

#[test]
fn reading_goes_on_after_a_broken_feature() {
    let broken = feature(SQUARE).replace("]]]}", "]]}");
    let read = json(&collection(&[feature(SQUARE), broken, feature(SQUARE)]));
    assert_eq!(read.counts(), (2, 1), "{:?}", read.lost);
    let lines = [feature(SQUARE), feature(SQUARE)].join("\n");
    assert_eq!(json(&lines).counts(), (2, 0), "one a line");
    let sequence = format!("\u{1e}{}\n\u{1e}{}\n", feature(SQUARE), feature(SQUARE));
    assert_eq!(json(&sequence).counts(), (2, 0), "text sequence");
    assert_eq!(json(SQUARE).counts(), (1, 0), "a bare geometry");
}

#[test]
fn other_encodings_and_gzip_are_read() {
    let text = feature(SQUARE).replace(r#""n":1"#, r#""名前":"表通り""#);
    let bytes = shift_jis(&text);
    let read = read_bytes(&[("a.geojson", bytes)], &Options::default()).unwrap();
    assert_eq!(read.columns, ["名前"]);
    assert_eq!(
        read.features[0].field(0),
        Some(&Value::Text("表通り".into()))
    );
    let mut packed = flate2::write::GzEncoder::new(vec![], flate2::Compression::default());
    packed.write_all(text.as_bytes()).unwrap();
    let read = read_bytes(
        &[("a.geojson.gz", packed.finish().unwrap())],
        &Options::default(),
    );
    assert_eq!(read.unwrap().counts(), (1, 0));
}

/// A text in Shift_JIS.
fn shift_jis(text: &str) -> Vec<u8> {
    encoding_rs::SHIFT_JIS.encode(text).0.into_owned()
}

#[test]
fn tables_of_points_know_their_columns() {
    let table =
        "名前,経度,緯度,階数\n\"角屋, 本店\",135.75,35.02,2\n米屋,x,35.02,1\n鍵屋,135.76,35.03\n";
    let read = read_bytes(&[("a.csv", shift_jis(table))], &Options::default()).unwrap();
    assert_eq!(read.counts(), (1, 2));
    assert_eq!(
        read.features[0].field(0),
        Some(&Value::Text("角屋, 本店".into()))
    );
    assert_eq!(read.features[0].field(3), Some(&Value::Integer(2)));
    assert_eq!(read.lost[0].field.as_deref(), Some("経度"));
    assert!(matches!(read.lost[0].kind, Kind::NotANumber { .. }));
    assert!(matches!(read.lost[1].kind, Kind::Malformed { .. }));
    let refused = read_bytes(&[("a.csv", b"a,b\n1,2\n".to_vec())], &Options::default());
    assert_eq!(refused.err().map(|f| f.kind), Some(Kind::NoCoordinates));
}

#[test]
fn unknown_formats_are_refused_with_the_way_out() {
    let refused = read_bytes(&[("a.dxf", b"0\nSECTION\n".to_vec())], &Options::default());
    let fault = refused.err().unwrap();
    assert_eq!(fault.kind, Kind::UnknownFormat);
    let mut faults = Faults::default();
    faults.push(fault);
    let mut out = Diagnostics::new();
    faults.report("houses", None, &mut out);
    let found = out.into_sorted();
    let words = found[0].message.in_language(Language::English).into_owned();
    assert!(
        words.contains("ogr2ogr -f") && words.contains("a.dxf"),
        "{words}"
    );
    assert_eq!(found[0].code.to_string(), "HSD1002");
}

#[test]
fn faults_are_counted_once_a_kind() {
    let bad = feature("null");
    let read = json(&collection(&[
        bad.clone(),
        bad.clone(),
        bad,
        feature(SQUARE),
    ]));
    let mut faults = Faults::default();
    read.lost.into_iter().for_each(|fault| faults.push(fault));
    let mut out = Diagnostics::new();
    faults.report("houses", None, &mut out);
    let found = out.into_sorted();
    assert_eq!(found.len(), 1);
    let [en, ja] = [Language::English, Language::Japanese].map(|l| found[0].message.in_language(l));
    // The feature is where the message stands, so it is not named again.
    assert!(matches!(&found[0].origin, Origin::Feature { key, .. } if **key == *"0"));
    assert!(
        en.starts_with("byte") && en.contains("2 more like it"),
        "{en}"
    );
    assert!(ja.contains("ほか2件"), "{ja}");
}

/// Found by fuzzing: a table of a few bytes whose head speaks of 134 million rows kept its reader busy for half an hour.
#[test]
fn a_table_ends_with_its_file() {
    let mut table = vec![3, 121, 6, 8];
    table.extend(134_217_728_u32.to_le_bytes());
    table.extend([65, 0, 6, 0]);
    table.resize(32, 0);
    table.extend(*b"name\0\0\0\0\0\0\0C\0\0\0\0\x05");
    table.resize(64, 0);
    table.extend(*b"\r one   two  \x1a");
    let read = read_bytes(&[("a.dbf", table)], &Options::default()).unwrap();
    assert_eq!(
        read.counts(),
        (0, 2),
        "rows without a geometry: {:?}",
        read.lost
    );
    let (_, remarks) = kinds(&read);
    let ends = remarks
        .iter()
        .filter(|kind| matches!(kind, Kind::Damaged { .. }));
    assert_eq!(ends.count(), 1, "{remarks:?}");
}

#[test]
fn lots_of_the_registry_are_read() {
    let read = read_bytes(&[("a.xml", MOJ.into())], &Options::default()).unwrap();
    assert_eq!(read.counts(), (1, 0), "{:?}", read.lost);
    assert_eq!(read.crs.unwrap().name, "EPSG:6677".into());
    assert_eq!(read.columns, ["地番"]);
    let first = read.features[0].geometry.points().next().unwrap();
    assert_eq!((first.x, first.y), (25.0, 10.0), "X is north");
}

/// A lot of four sides, of which one runs the other way.
pub(super) const MOJ: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<地図 xmlns="http://www.moj.go.jp/MINJI/tizuxml" xmlns:zmn="http://www.moj.go.jp/MINJI/tizuzumen">
<座標系>公共座標9系</座標系>
<空間属性>
<zmn:GM_Point id="P1"><zmn:GM_Point.position><zmn:DirectPosition><zmn:X>10</zmn:X><zmn:Y>25</zmn:Y></zmn:DirectPosition></zmn:GM_Point.position></zmn:GM_Point>
<zmn:GM_Point id="P2"><zmn:GM_Point.position><zmn:DirectPosition><zmn:X>10</zmn:X><zmn:Y>31</zmn:Y></zmn:DirectPosition></zmn:GM_Point.position></zmn:GM_Point>
<zmn:GM_Point id="P3"><zmn:GM_Point.position><zmn:DirectPosition><zmn:X>30</zmn:X><zmn:Y>31</zmn:Y></zmn:DirectPosition></zmn:GM_Point.position></zmn:GM_Point>
<zmn:GM_Curve id="C1"><zmn:GM_PointRef.point idref="P1"/><zmn:GM_PointRef.point idref="P2"/></zmn:GM_Curve>
<zmn:GM_Curve id="C2"><zmn:GM_PointRef.point idref="P3"/><zmn:GM_PointRef.point idref="P2"/></zmn:GM_Curve>
<zmn:GM_Curve id="C3"><zmn:GM_PointRef.point idref="P3"/><zmn:GM_PointRef.point idref="P1"/></zmn:GM_Curve>
<zmn:GM_Surface id="F1"><zmn:GM_SurfaceBoundary.exterior><zmn:GM_Ring><zmn:GM_CompositeCurve.generator idref="C1"/><zmn:GM_CompositeCurve.generator idref="C2"/><zmn:GM_CompositeCurve.generator idref="C3"/></zmn:GM_Ring></zmn:GM_SurfaceBoundary.exterior></zmn:GM_Surface>
</空間属性>
<主題属性><筆 id="H1"><地番>194-1</地番><形状 idref="F1"/></筆></主題属性>
</地図>"#;

/// A build without GeoPackage or GeoParquet names the feature that reads the file.
#[test]
fn formats_that_were_not_built_are_named() {
    for (name, feature, built) in [
        ("a.gpkg", "geopackage", cfg!(feature = "geopackage")),
        ("a.parquet", "geoparquet", cfg!(feature = "geoparquet")),
    ] {
        let head: &[u8] = match feature {
            "geopackage" => b"SQLite format 3\0 and nothing else",
            _ => b"PAR1 and nothing else",
        };
        let fault = read_bytes(&[(name, head.to_vec())], &Options::default());
        let fault = fault.err().expect("it cannot be read");
        match built {
            false => assert_eq!(fault.kind, Kind::NotBuilt { feature }),
            true => assert!(matches!(fault.kind, Kind::Damaged { .. }), "{fault:?}"),
        }
    }
}

/// QGIS saves queries as views, whose functions are not run.
#[test]
#[cfg(feature = "geopackage")]
fn layers_of_a_geopackage_are_found_or_told() {
    let path = crate::support::root().join("tests/data/houses.gpkg");
    let whole = std::fs::read(path).unwrap();
    let with = |sql: &str| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.gpkg");
        std::fs::write(&path, &whole).unwrap();
        rusqlite::Connection::open(&path)
            .unwrap()
            .execute_batch(sql)
            .unwrap();
        std::fs::read(path).unwrap()
    };
    let read = |bytes: Vec<u8>, layer: Option<&str>| {
        let options = Options {
            layer: layer.map(Box::from),
            ..Options::default()
        };
        let read = read_bytes(&[("a.gpkg", bytes)], &options);
        read.map(|read| read.counts()).map_err(|fault| fault.kind)
    };
    let view = with(
        "CREATE VIEW seen AS SELECT * FROM houses;
         INSERT INTO gpkg_contents (table_name, data_type, identifier) VALUES ('seen', 'features', 'seen');
         INSERT INTO gpkg_geometry_columns SELECT 'seen', column_name, geometry_type_name, srs_id, z, m
         FROM gpkg_geometry_columns WHERE table_name = 'houses';",
    );
    assert_eq!(read(view.clone(), None), Ok((5, 0)));
    let why = "its layer `seen` is a view; save it as a table".into();
    assert_eq!(
        read(view.clone(), Some("seen")),
        Err(Kind::Unreadable { why })
    );
    let layer = "roads".into();
    assert_eq!(read(view, Some("roads")), Err(Kind::NoLayer { layer }));
    let empty = with("UPDATE gpkg_contents SET data_type = 'attributes';");
    let why = "it has no layer of features".into();
    assert_eq!(read(empty, None), Err(Kind::Unreadable { why }));
    // One row is no geometry, another has none; the others are read.
    let broken = with(
        "UPDATE houses SET geom = x'4750' WHERE fid = 2; UPDATE houses SET geom = NULL WHERE fid = 3;",
    );
    assert_eq!(read(broken, None), Ok((3, 2)));
}

#[test]
fn what_is_written_twice_or_deleted_is_told() {
    let twice = format!(
        r#"{{"type":"FeatureCollection","features":[{0}],"features":[{0},{0}]}}"#,
        feature(SQUARE)
    );
    let read = json(&twice);
    assert_eq!(read.counts(), (3, 0));
    assert_eq!(kinds(&read).1, [&Kind::DuplicateList]);

    let doubled = format!(
        r#"{{"type":"Feature","geometry":null,"geometry":{SQUARE},"properties":{{}},"other":1,"other":2}}"#
    );
    let read = json(&doubled);
    assert_eq!(read.counts(), (1, 0));
    assert_eq!(kinds(&read).1, [&Kind::DuplicateField]);
    assert_eq!(read.remarks[0].field.as_deref(), Some("geometry"));

    let tree = |id: u32, action: &str| {
        format!(r#"<node id="{id}" lon="135" lat="35"{action}><tag k="natural" v="tree"/></node>"#)
    };
    let osm = [
        "<osm>",
        &tree(1, ""),
        &tree(2, r#" action="delete""#),
        "</osm>",
    ]
    .concat();
    let read = read_bytes(&[("a.osm", osm.into())], &Options::default()).unwrap();
    assert_eq!(read.counts(), (1, 0));
    assert_eq!(kinds(&read).1, [&Kind::Deleted]);
}

#[test]
fn heights_that_cannot_be_are_missing() {
    let ring = "[[0,0,12],[1,0,-9999],[1,1,14],[0,1,1e9],[0,0,12]]";
    let read = json(&collection(&[feature(&format!(
        r#"{{"type":"Polygon","coordinates":[{ring}]}}"#
    ))]));
    let heights = read.features[0]
        .geometry
        .chains()
        .next()
        .map(|c| c.heights.clone());
    let mean = (12.0 + 14.0 + 12.0) / 3.0;
    assert_eq!(heights, Some(vec![12.0, mean, 14.0, mean]));
    assert_eq!(kinds(&read).1, [&Kind::NoHeights { points: 2 }]);
}

#[test]
fn places_of_local_surveys_have_bounds() {
    let far = r#"{"type":"Point","coordinates":[1e22,0]}"#;
    let options = Options {
        crs: Some(Crs::local()),
        ..Options::default()
    };
    let read = read_bytes(&[("a.geojson", feature(far).into())], &options).unwrap();
    assert_eq!(read.counts(), (0, 1));
    assert!(matches!(read.lost[0].kind, Kind::OutsideCrs { .. }));
}

#[test]
fn shapes_go_on_beyond_180_degrees() {
    let ring = "[[179.9,0],[-179.9,0],[-179.9,1],[179.9,1],[179.9,0]]";
    let read = json(&feature(&format!(
        r#"{{"type":"Polygon","coordinates":[{ring}]}}"#
    )));
    let width = read.features[0].geometry.width().unwrap();
    assert!((width - 1.0).abs() < 1e-9, "{width}");
}
