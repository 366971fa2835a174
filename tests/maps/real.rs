//! The maps beside the repository, with the counts that their descriptions give.

use super::read_in;
use crate::support::maps::data;
use hsd::map::{Crs, Datums, Fault, Feature, Kind, Options, Transform};
use std::fs;
use std::path::{Path, PathBuf};

/// Maps of GeoJSON with the number of their features.
const GEOJSON: &[(&str, usize)] = &[
    ("edo_codh/edo-coastline-clip.geojson", 3),
    ("edo_codh/edo-machiya-areas.geojson", 28),
    ("edo_codh/edo-places.geojson", 5784),
    ("edo_codh/kyoto-bakumatsu-places.geojson", 36),
    ("moj_parcels/joetsu_15222.geojson", 541),
    ("osm_kyoto_route18/buildings.geojson", 1771),
    ("osm_kyoto_route18/hedges.geojson", 48),
    ("osm_kyoto_route18/roads.geojson", 1276),
    ("osm_kyoto_route18/sidewalks.geojson", 270),
    ("osm_kyoto_route18/trees.geojson", 439),
    ("osm_kyoto_streets/streets.geojson", 620),
    ("osm_kyoto_streets/water.geojson", 130),
    ("osm_meijimura/barriers.geojson", 169),
    ("osm_meijimura/buildings.geojson", 143),
    ("osm_meijimura/landuse.geojson", 128),
    ("osm_meijimura/roads.geojson", 366),
    ("osm_meijimura/trees.geojson", 20),
    ("osm_tokyo_asakusa/barriers.geojson", 211),
    ("osm_tokyo_asakusa/buildings.geojson", 1489),
    ("osm_tokyo_asakusa/landuse.geojson", 20),
    ("osm_tokyo_asakusa/roads.geojson", 488),
    ("osm_tokyo_asakusa/trees.geojson", 150),
    ("plateau_kyoto_roads/blocks_derived.geojson", 640),
    ("plateau_kyoto_roads/roads_tran.geojson", 1311),
    ("plateau_tokyo_yanaka/buildings.geojson", 1307),
];

#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn every_map_of_geojson_has_its_features() {
    for (name, count) in GEOJSON {
        let read = read_in(&data(), name, &Options::default()).unwrap();
        let (built, lost) = read.counts();
        assert_eq!(built + lost, *count, "{name}");
        // Three lines of Kyoto have two equal points.
        let short = |fault: &Fault| matches!(fault.kind, Kind::TooFewPoints { points: 1 });
        assert!(
            read.lost.iter().all(short) && lost < 3,
            "{name}: {:?}",
            read.lost
        );
    }
}

/// The corners of a feature in metres of a system.
fn corners(feature: &Feature, from: &Crs, to: &Crs) -> Vec<hsd::glam::DVec2> {
    let way = Transform::new(from, to, Datums::Exact).unwrap();
    let points = feature.geometry.points();
    points.map(|p| way.apply(p).unwrap()).collect()
}

/// Compares the shapes of two maps of the same features.
fn assert_same(json: &str, shapes: &str, count: usize, within: f64) {
    let json = read_in(&data(), json, &Options::default()).unwrap();
    let shapes = read_in(&data(), shapes, &Options::default()).unwrap();
    assert_eq!((json.counts(), shapes.counts()), ((count, 0), (count, 0)));
    let (from, to) = (json.crs.unwrap(), shapes.crs.unwrap());
    for (one, two) in json.features.iter().zip(&shapes.features) {
        let (one, two) = (corners(one, &from, &to), corners(two, &to, &to));
        assert_eq!(one.len(), two.len());
        for p in &one {
            let off = two.iter().map(|q| p.distance(*q)).fold(f64::MAX, f64::min);
            assert!(off < within, "{p} is {off} m off");
        }
    }
}

#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn shapefiles_agree_with_geojson() {
    let yanaka = "plateau_tokyo_yanaka";
    let (json, shapes) = ("buildings.geojson", "shapefile_cp932/tatemono.shp");
    assert_same(
        &format!("{yanaka}/{json}"),
        &format!("{yanaka}/{shapes}"),
        1307,
        0.01,
    );
    let (json, shapes) = ("joetsu_15222.geojson", "joetsu_shapefile_cp932/fude.shp");
    assert_same(
        &format!("moj_parcels/{json}"),
        &format!("moj_parcels/{shapes}"),
        541,
        0.02,
    );
    let read = read_in(
        &data(),
        "moj_parcels/joetsu_shapefile_cp932/fude.shp",
        &Options::default(),
    )
    .unwrap();
    assert_eq!(
        read.columns[..3],
        ["筆ID", "市区町村名", "大字名"],
        "CP932 without a .cpg"
    );
}

#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn the_registry_has_one_lot_in_chiba() {
    let read = read_in(
        &data(),
        "moj_parcels/12103-0400-76.xml",
        &Options::default(),
    )
    .unwrap();
    assert_eq!((read.counts(), read.remarks.len()), ((1, 0), 0));
    assert_eq!(&*read.crs.unwrap().name, "EPSG:6677");
    let points = Options {
        layer: Some("基準点".into()),
        ..Options::default()
    };
    let read = read_in(&data(), "moj_parcels/12103-0400-76.xml", &points).unwrap();
    assert_eq!(read.counts(), (606, 0), "control points");
}

#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn openstreetmap_is_the_same_in_both_forms() {
    // Features of the GeoJSON beside, and those that it leaves out: points, and areas of roads.
    for (theme, json, more) in [
        ("building", "buildings", 1),
        ("highway", "roads", 19),
        ("barrier", "barriers", 5),
    ] {
        let options = Options {
            layer: Some(theme.into()),
            ..Options::default()
        };
        let folder = data().join("osm_meijimura");
        let xml = read_in(&folder, "MeijiMura.osm.gz", &options).unwrap();
        let pbf = read_in(&folder, "MeijiMura.osm.pbf", &options).unwrap();
        assert!(xml.lost.is_empty() && pbf.lost.is_empty());
        assert!(xml.features == pbf.features, "{theme}");
        let json = read_in(&folder, &format!("{json}.geojson"), &Options::default()).unwrap();
        assert_eq!(xml.features.len(), json.features.len() + more, "{theme}");
    }
}

fn files_below(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().flatten().map(|e| e.path());
    let mut files: Vec<PathBuf> = entries
        .flat_map(|path| {
            if path.is_dir() {
                files_below(&path)
            } else {
                vec![path]
            }
        })
        .collect();
    files.sort();
    files
}

#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn the_torture_set_is_read_or_told() {
    let folder = data().join("shapefile_torture");
    let (mut shapes, mut built, mut lost) = (0, 0, 0);
    for path in files_below(&folder) {
        if path.extension().is_some_and(|e| e == "shp") {
            let read = read_in(&folder, path.to_str().unwrap(), &Options::default()).unwrap();
            shapes += 1;
            built += read.counts().0;
            lost += read.counts().1;
        }
    }
    println!("{shapes} shapefiles: {built} features, {lost} told");
    assert_eq!(shapes, 48, "none is refused");
    // MultiPatch (2), null shapes (29), an index or garbage behind the last record (2).
    assert_eq!((built, lost), (228, 33));
    let read = |name: &str| read_in(&folder, name, &Options::default()).unwrap();
    assert_eq!(read("mbostock/null.shp").counts(), (5, 4));
    assert_eq!(read("shapelib/csah.shp").counts(), (99, 25));
    let too_long = read("pyshp/corrupt_too_long.shp");
    assert!(matches!(too_long.lost[0].kind, Kind::Damaged { .. }));
    let touching = read("geotools/holeTouchEdge.shp");
    assert_eq!(touching.counts(), (1, 0));
}
