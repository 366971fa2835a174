//! Zones and envelopes of building law in towns (002-28 to 002-32): from maps of lots, roads and zones to the table and the models.

use crate::towns::in_folder;
use hsd::backend::gltf;
use hsd::backend::images::Library;
use hsd::driver::Options;
use hsd::tiles::envelopes::{page, scenarios, scene, table};
use hsd::town::site::law::EnvelopeRow;
use hsd::town::stream::{Ledger, TownStream};
use hsd::town::{TownInput, run};
use hsd::{Diagnostics, FileId, FolderWorld, Source};
use std::fs;
use std::path::Path;

/// Builds a town of this text in a folder; returns its ledger and the codes of what was found.
fn built(text: &str, folder: &Path) -> (Ledger, Vec<String>) {
    let name = folder.join("town.hsd");
    let source = Source::new(FileId(0), name.to_string_lossy(), text.as_bytes());
    let world = FolderWorld::new(vec![], 1 << 24).with_roots(vec![folder.to_owned()]);
    let (options, mut out) = (Options::default(), Diagnostics::new());
    let read = hsd::driver::documents(&[&source], &world, &options, &mut out);
    let town = read.documents.into_iter().find_map(|d| d.town);
    let input = TownInput::new(&source, &world, &options);
    let plan = run::plan(input, &town.expect("is a town"), &mut out);
    let plan = plan.unwrap_or_else(|| panic!("{:?}", out.iter().collect::<Vec<_>>()));
    let mut stream = TownStream::new(input, &plan);
    while stream.next().is_some() {}
    let (ledger, _) = stream.finish(&mut out);
    (ledger, out.iter().map(|d| d.code.to_string()).collect())
}

fn example() -> Ledger {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/towns");
    let text = fs::read_to_string(folder.join("law.hsd")).expect("is there");
    let (ledger, found) = built(&text, &folder);
    assert_eq!(found, [""; 0]);
    ledger
}

fn row<'l>(ledger: &'l Ledger, key: &str, scenario: &str) -> &'l EnvelopeRow {
    let own = |row: &&EnvelopeRow| row.key == key && row.scenario == scenario;
    let found = ledger.envelopes.iter().find(own);
    found.unwrap_or_else(|| panic!("no envelope of {key}"))
}

fn is(value: f64, expected: f64) {
    assert!((value - expected).abs() < 1e-6, "{value} is not {expected}");
}

#[test]
fn front_land_and_back_land_differ_by_their_roads() {
    let ledger = example();
    assert_eq!(ledger.envelopes.len(), 28);
    // F2 lies on the avenue of 22 m: its designated 600 % on 80 % of the ground are 7.5 storeys of 3 m.
    let front = row(&ledger, "F2", "present law");
    is(front.road_width.expect("on the avenue"), 22.0);
    is(front.ratio.expect("designated"), 6.0);
    is(front.height, 22.5);
    is(front.volume, 7.0 * 30.0 * 22.5);
    // B2 lies on the lane of 4 m: 160 % (002-30) on 60 % of the ground are 8 m, and the slope of the lane begins at 5 m.
    let back = row(&ledger, "B2", "present law");
    is(back.ratio.expect("by the road"), 1.6);
    is(back.height, 8.0);
    let slope = 8.0 / 1.25 - 4.0;
    is(
        back.volume,
        8.0 * (slope * (5.0 + 8.0) / 2.0 + (22.0 - slope) * 8.0),
    );
    assert_eq!(back.arithmetic[1], "1.25 x d; d = 4 + x <= 25");
    // B3 is concave, with B4 in its corner; B7 lies behind others, on no road.
    is(
        row(&ledger, "B3", "present law").lot_area,
        22.0 * 22.0 - 7.0 * 8.0,
    );
    assert_eq!(row(&ledger, "B3", "present law").roads, 1);
    assert_eq!(row(&ledger, "F1", "present law").roads, 2);
    assert_eq!(row(&ledger, "B7", "present law").roads, 0);
    // The plan of 1994 lines them up.
    let guided = row(&ledger, "B2", "plan of 1994");
    is(guided.height, 15.0);
    is(guided.volume, 8.0 * 21.5 * 15.0);
    is(guided.ratio.expect("designated"), 3.0);
}

#[test]
fn houses_above_their_envelope_are_listed() {
    let ledger = example();
    let above = &ledger.report.above_envelope;
    let listed = |key: &str| above.iter().any(|feature| feature.key == key);
    assert!(listed("F5") && listed("B6") && !listed("F4"), "{above:?}");
    let table = table(&ledger.envelopes);
    assert!(table.starts_with("key,layer,scenario,volume,floor_area,height,rules,"));
    assert_eq!(table.lines().count(), 29);
}

#[test]
fn scenarios_stand_side_by_side() {
    let ledger = example();
    assert_eq!(
        scenarios(&ledger.envelopes),
        ["present law", "plan of 1994"]
    );
    // A picture for each of them, lots one after another, scenarios side by side.
    let page = page(&ledger.envelopes);
    assert_eq!(page.matches("<figure>").count(), 28);
    assert_eq!(page.matches("<article>").count(), 14);
    assert!(page.contains("1.25 x d; d = 4 + x &lt;= 25"));
    assert!(page.contains("class=\"above\""));
    let paths: Vec<&str> = page.split(" d=\"M").skip(1).collect();
    assert!(paths.len() > 3 * 28, "{} faces", paths.len());
    for path in paths {
        let path = path.split("Z\"").next().expect("is closed");
        let numbers = path.split(['L', ' ']).map(|n| n.parse::<f64>());
        let numbers: Vec<f64> = numbers.map(|n| n.expect("a number")).collect();
        assert!(numbers.len() >= 6 && numbers.iter().all(|n| (0.0..=260.0).contains(n)));
    }
    let scene = scene(&ledger.envelopes);
    let roots: Vec<f64> = scene
        .nodes
        .iter()
        .filter(|n| n.parent.is_none())
        .map(|n| n.at.x)
        .collect();
    is(roots[0], 0.0);
    is(roots[1], 60.0 * 1.05);
    assert_eq!(scene.nodes.len(), 2 + 28);
    let named = |name: &str| scene.materials.iter().any(|material| material.name == name);
    assert!(named("envelope road 1") && named("envelope ratio") && named("envelope border"));
    let glb = gltf::glb(&scene, &Library::default());
    assert_eq!(&glb[..4], b"glTF");
}

#[test]
fn envelopes_are_glass_in_the_model() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/towns");
    let text = fs::read_to_string(folder.join("law.hsd")).expect("is there");
    let built = in_folder(&text, &folder, |_| {});
    let row = built
        .rows
        .iter()
        .find(|row| row["key"] == "F3")
        .expect("is there");
    assert_eq!((&*row["type"], &*row["what"]), ("envelope", "built"));
    assert!(
        row["parameters"].contains("scenario=present law"),
        "{row:?}"
    );
    let row = built
        .rows
        .iter()
        .find(|row| row["key"] == "B2")
        .expect("is there");
    assert_eq!(&*row["type"], "so-nikai");
    assert!(
        row["parameters"].contains("envelope_road_1=1.25 x d"),
        "{row:?}"
    );
}

#[test]
fn bad_values_are_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let lots = r#"{"type":"FeatureCollection","features":[{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[0,0],[8,0],[8,12],[0,12],[0,0]]]}}]}"#;
    fs::write(folder.path().join("lots.geojson"), lots).expect("is written");
    let found = |attributes: &str| {
        let text = format!(
            r#"<Town><Layer name="lots" src="lots.geojson" crs="local"/><for each="lots"><Envelope {attributes}/></for></Town>"#
        );
        built(&text, folder.path()).1
    };
    for (attributes, code) in [
        (r#"gradient="-1.5""#, "HSD0226"),
        (r#"distance="0""#, "HSD0226"),
        (r#"ratio="400""#, "HSD0226"),
        (r#"ratio="400%""#, "HSD0226"),
        (r#"plan="guide""#, "HSD0227"),
        (r#"plan="guided""#, "HSD1171"),
        (r#"roads="rivers""#, "HSD1170"),
        (r#"setback="7""#, ""),
    ] {
        let found = found(attributes);
        let tells = code.is_empty() || found.iter().any(|own| own == code);
        assert!(tells, "{attributes}: {found:?}");
    }
}

#[test]
fn real_lots_have_envelopes() {
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    let maps = [
        "osm_kyoto_route18/buildings.geojson",
        "plateau_kyoto_roads/roads_tran.geojson",
    ];
    if !maps.iter().all(|map| shared.join(map).exists()) {
        println!("skipped: no ../shared/data");
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    for (map, name) in maps.iter().zip(["lots.geojson", "roads.geojson"]) {
        fs::copy(shared.join(map), folder.path().join(name)).expect("is copied");
    }
    let text = r#"<Town><Layer name="lots" src="lots.geojson" key="idx"/><Layer name="roads" src="roads.geojson"/>
        <for each="lots"><Envelope by_ratio="yes" ratio="4" coverage="0.8" show="no"/></for></Town>"#;
    let (ledger, _) = built(text, folder.path());
    let rows = &ledger.envelopes;
    assert!(rows.len() > 1700, "{}", rows.len());
    let on_roads = rows.iter().filter(|row| row.roads > 0).count();
    assert!(
        on_roads * 5 > rows.len(),
        "{on_roads} of {} are on roads",
        rows.len()
    );
    assert!(
        rows.iter()
            .all(|row| row.volume > 0.0 && row.height <= 60.0 && row.floor_area() >= 0.0)
    );
}
