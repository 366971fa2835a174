//! `hsd town init`: what maps are taken for, and that the towns written build at once.

use crate::support::root;
use crate::towns::in_folder;
use hsd::FolderWorld;
use hsd::source::World;
use hsd::survey::{Kind, Surveyed, survey, town};
use std::fs;
use std::path::{Path, PathBuf};

/// Surveys maps in a folder.
fn surveyed(folder: &Path, maps: &[&str]) -> Vec<Surveyed> {
    let world = FolderWorld::new(vec![], 0).with_roots(vec![folder.to_owned()]);
    let from = folder.join("town.hsd");
    let mut all = vec![];
    for map in maps {
        let path = world.text(&from.to_string_lossy(), map).expect("is there");
        all.extend(survey(&world, &path, map).unwrap_or_else(|e| panic!("{map}: {e:?}")));
    }
    all
}

fn kinds(layers: &[Surveyed]) -> Vec<(Kind, usize)> {
    layers.iter().map(|l| (l.kind, l.features)).collect()
}

/// Writes a town for maps and evaluates it; returns its text and the number of houses.
fn first_town(folder: &Path, maps: &[&str]) -> (String, usize) {
    let layers = surveyed(folder, maps);
    let text = town("town", &layers);
    let built = in_folder(&text, folder, |_| {});
    // What a map has faults of is said again; what the rules ask for is there.
    for code in &built.found {
        let of_map = code.starts_with("HSD10");
        let known = of_map
            || ["HSD1108", "HSD1110", "HSD1112", "HSD1118", "HSD1120"].contains(&code.as_str());
        assert!(known, "{maps:?}: {code}\n{text}");
    }
    assert_eq!(built.features, built.built + built.skipped);
    (text, built.houses)
}

fn written(name: &str, text: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join(name), text).expect("is written");
    folder
}

/// One line across the country does not turn the degrees of a town into metres: it is an outlier.
#[test]
fn houses_in_degrees_stay_there_beside_a_very_wide_line() {
    let folder = written("houses.geojson", &squares(&[r#""building":"yes""#; 4]));
    let line = r#"{"type":"Feature","properties":{"highway":"trunk"},"geometry":{"type":"LineString","coordinates":[[129.5,31.5],[142.0,43.0]]}}"#;
    fs::write(folder.path().join("roads.geojson"), line).expect("is written");
    let layers = surveyed(folder.path(), &["houses.geojson", "roads.geojson"]);
    let names = |_: &str| vec![];
    let layers = hsd::survey::joined(layers, &names);
    let text = town("town", &layers);
    assert!(!text.contains("local"), "{text}");
    let built = in_folder(&text, folder.path(), |_| {});
    assert_eq!((built.built, built.skipped), (4, 1));
    let outlier = built.told.iter().find(|told| told[0] == "HSD1007");
    assert!(
        outlier.is_some_and(|told| told[2].contains("roads.geojson")),
        "{:?}",
        built.told
    );
}

/// Heights with units and words are still heights.
#[test]
fn heights_with_units_are_found() {
    let fields = ["8 m", "21 ft", "6,5", "unknown", "9"]
        .map(|h| format!(r#""building":"yes","height":"{h}""#));
    let fields: Vec<&str> = fields.iter().map(String::as_str).collect();
    let folder = written("houses.geojson", &squares(&fields));
    let (text, _) = first_town(folder.path(), &["houses.geojson"]);
    assert!(text.contains(r#"from="height" type="number""#), "{text}");
}

fn squares(fields: &[&str]) -> String {
    let features: Vec<String> = fields
        .iter()
        .enumerate()
        .map(|(n, fields)| {
            let (x, y) = (135.75 + n as f64 * 0.0002, 35.0);
            let (e, n) = (x + 0.00008, y + 0.0001);
            format!(
                r#"{{"type":"Feature","properties":{{{fields}}},"geometry":{{"type":"Polygon","coordinates":[[[{x},{y}],[{e},{y}],[{e},{n}],[{x},{n}],[{x},{y}]]]}}}}"#
            )
        })
        .collect();
    format!(
        r#"{{"type":"FeatureCollection","features":[{}]}}"#,
        features.join(",")
    )
}

#[test]
fn fields_say_what_a_layer_is_and_what_is_built() {
    let buildings = squares(&[
        r#""building":"yes","building:levels":2,"fid":1"#,
        r#""building":"temple","fid":2"#,
        r#""building":"shed","fid":3"#,
        r#""building":"yes","building:levels":"7","fid":4"#,
    ]);
    let folder = written("map.geojson", &buildings);
    let layers = surveyed(folder.path(), &["map.geojson"]);
    assert_eq!(kinds(&layers), [(Kind::Houses, 4)]);
    let (text, houses) = first_town(folder.path(), &["map.geojson"]);
    assert_eq!(houses, 3, "all but the shed");
    for wanted in [
        r#"key="fid""#,
        r#"<Field name="levels" from="building:levels" type="number" default="2"/>"#,
        "kind = 'shed'",
        "kind = 'temple'",
        "levels > 3",
    ] {
        assert!(text.contains(wanted), "{wanted} in {text}");
    }
}

/// Records of vertices (000-25) in metres, mixed up, with Japanese names too; a table whose points are places stays one.
#[test]
fn tables_of_vertices_are_outlines() {
    const TABLE: &str = "house,number,x,y,levels\na,3,6,9,2\nb,1,1010,0,1\na,1,0,0,2\na,4,0,9,2\nb,2,1018,0,1\nb,3,1018,5,1\na,2,6,0,2\nb,4,1014,5,1\nb,5,1014,10,1\nb,6,1010,10,1\n";
    for (by, order) in [
        ("house", "number"),
        ("家屋", "順番"),
        ("町家", "vertex_index"),
    ] {
        let table = TABLE.replace("house,number", &format!("{by},{order}"));
        let folder = written("vertices.csv", &table);
        let layers = surveyed(folder.path(), &["vertices.csv"]);
        assert_eq!(kinds(&layers), [(Kind::Houses, 2)], "{by}");
        let (text, houses) = first_town(folder.path(), &["vertices.csv"]);
        assert_eq!(houses, 2, "{text}");
        let wanted = format!(r#"outline="{by}" order="{order}""#);
        assert!(text.contains(&wanted), "{wanted} in {text}");
        assert!(!text.contains("key="), "the key is the id: {text}");
    }
    // Few metres could be degrees, but no house is as wide as a country; an outline of two points is told, the rest is built.
    let near = TABLE.replace(",10", ",");
    let folder = written("vertices.csv", &(near + "c,1,30,0,1\nc,2,34,0,1\n"));
    let (text, houses) = first_town(folder.path(), &["vertices.csv"]);
    assert_eq!(houses, 2, "{text}");
    assert!(text.contains(r#"crs="local""#), "{text}");
    // Shops along two streets draw no outline, and trees are not numbered by kind.
    let shops = "street,number,x,y\na,1,0,0\na,2,10,0\na,3,20,0\nb,1,0,50\nb,2,10,50\nb,3,20,50\n";
    let trees = "kind,number,x,y\nsugi,1,0,0\nsugi,2,30,0\nsugi,3,30,40\nmatsu,4,100,0\nmatsu,5,130,0\nmatsu,6,130,40\n";
    for places in [shops, trees] {
        let folder = written("places.csv", places);
        let layers = surveyed(folder.path(), &["places.csv"]);
        assert_eq!(kinds(&layers), [(Kind::Places, 6)], "{places}");
    }
}

#[test]
fn japanese_fields_are_known() {
    let buildings = squares(&[
        r#""建物ID":"a","階数":"2","用途":"住宅""#,
        r#""建物ID":"b","階数":"1","用途":"土蔵""#,
        r#""建物ID":"c","階数":"5","用途":"共同住宅""#,
        r#""建物ID":"d","階数":"2","用途":"住宅""#,
    ]);
    let folder = written("建物.geojson", &buildings);
    let (text, houses) = first_town(folder.path(), &["建物.geojson"]);
    assert_eq!(houses, 4);
    for wanted in ["key=\"建物ID\"", "from=\"階数\"", "kind = '土蔵'"] {
        assert!(text.contains(wanted), "{wanted} in {text}");
    }
}

/// With two buildings, values that differ are kinds as well as names.
#[test]
fn a_map_of_few_buildings_has_kinds() {
    let buildings = squares(&[r#""用途":"店舗""#, r#""用途":"倉庫""#]);
    let folder = written("map.geojson", &buildings);
    let (text, _) = first_town(folder.path(), &["map.geojson"]);
    assert!(text.contains("kind = '倉庫'"), "{text}");
}

#[test]
fn maps_of_the_tests_become_towns() {
    let folder = root().join("tests/data");
    for (map, kind) in [
        ("houses.geojson", Kind::Houses),
        ("houses.fgb", Kind::Houses),
        ("houses.shp", Kind::Houses),
        ("houses.gml", Kind::Houses),
        ("hamlet.osm", Kind::Houses),
    ] {
        let layers = surveyed(&folder, &[map]);
        assert!(
            layers.iter().any(|l| l.kind == kind),
            "{map}: {:?}",
            kinds(&layers)
        );
        first_town(&folder, &[map]);
    }
}

fn data(folder: &str) -> PathBuf {
    let data = std::env::var_os("HSD_DATA").map(PathBuf::from);
    data.unwrap_or_else(|| root().join("../shared/data"))
        .join(folder)
}

#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn real_maps_become_towns() {
    use Kind::{Areas, Blocks, Houses, Lines, Lots, Places, Roads, Trees};
    let maps: &[(&str, &[&str], &[Kind], usize)] = &[
        (
            "osm_kyoto_route18",
            &[
                "buildings.geojson",
                "roads.geojson",
                "trees.geojson",
                "hedges.geojson",
            ],
            &[Houses, Roads, Trees, Lines],
            1600,
        ),
        (
            "plateau_kyoto_roads",
            &["roads_tran.geojson", "blocks_derived.geojson"],
            &[Roads, Blocks],
            0,
        ),
        (
            "osm_kyoto_streets",
            &["streets.geojson", "water.geojson"],
            &[Roads, Lines],
            0,
        ),
        (
            "osm_tokyo_asakusa",
            &[
                "buildings.geojson",
                "roads.geojson",
                "trees.geojson",
                "barriers.geojson",
                "landuse.geojson",
            ],
            &[Houses, Roads, Trees, Lines, Areas],
            1300,
        ),
        (
            "osm_meijimura",
            &["MeijiMura.osm.pbf"],
            &[Houses, Roads],
            100,
        ),
        (
            "osm_meijimura",
            &["MeijiMura.osm.gz"],
            &[Houses, Roads],
            100,
        ),
        (
            "plateau_tokyo_yanaka",
            &["buildings.geojson"],
            &[Houses],
            1200,
        ),
        (
            "plateau_tokyo_yanaka",
            &["shapefile_cp932/tatemono.shp"],
            &[Houses],
            1200,
        ),
        ("moj_parcels", &["joetsu_15222.geojson"], &[Lots], 100),
        (
            "moj_parcels",
            &["joetsu_shapefile_cp932/fude.shp"],
            &[Lots],
            100,
        ),
        ("moj_parcels", &["12103-0400-76.xml"], &[Lots], 0),
        (
            "edo_codh",
            &[
                "edo-machiya-areas.geojson",
                "edo-places.geojson",
                "edo-coastline-clip.geojson",
            ],
            &[Areas, Places, Lines],
            0,
        ),
    ];
    for (folder, maps, wanted, least) in maps {
        let folder = data(folder);
        let layers = surveyed(&folder, maps);
        let found: Vec<Kind> = layers.iter().map(|l| l.kind).collect();
        assert_eq!(found[..wanted.len()], **wanted, "{maps:?}");
        let (_, houses) = first_town(&folder, maps);
        println!("{maps:?}: {:?}, {houses} houses", kinds(&layers));
        assert!(houses >= *least, "{maps:?}: {houses}");
    }
}

#[test]
fn grids_of_heights_become_the_ground() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["hill-houses.geojson", "hill-roads.geojson", "hill.asc"] {
        let text = fs::read(root().join("examples/towns").join(name)).expect("is there");
        fs::write(folder.path().join(name), text).expect("is written");
    }
    let maps = ["hill.asc", "hill-houses.geojson", "hill-roads.geojson"];
    let found = kinds(&surveyed(folder.path(), &maps));
    assert_eq!(found[0], (Kind::Heights, 0));
    let layers = surveyed(folder.path(), &maps[..1]);
    let text = town("town", &layers);
    assert!(
        text.contains("<Layer name=\"ground\" src=\"hill.asc\" crs=\"local\"/>"),
        "{text}"
    );
}
