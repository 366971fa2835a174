//! What stands between the houses of a town: roads whose crossings are covered once, whole dashes, trees outside of walls, whole
//! units of fences.

use crate::tiles::{Memory, build};
use crate::towns::{in_folder, number};
use hsd::ast::{House, Item, Piece, Sheet, Tree};
use hsd::driver::Options;
use hsd::glam::{DVec2, DVec3, dvec2};
use hsd::town::stream::TownStream;
use hsd::town::{TownInput, run};
use hsd::{Diagnostics, FileId, FolderWorld, Source};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// A folder with layers of these names and features.
pub(crate) fn folder(layers: &[(&str, &[String])]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, features) in layers {
        let list = features.join(",");
        let text = format!(r#"{{"type":"FeatureCollection","features":[{list}]}}"#);
        fs::write(folder.path().join(format!("{name}.geojson")), text).expect("is written");
    }
    folder
}

pub(crate) fn feature(fields: &str, kind: &str, coordinates: &str) -> String {
    format!(
        r#"{{"type":"Feature","properties":{{{fields}}},"geometry":{{"type":"{kind}","coordinates":{coordinates}}}}}"#
    )
}

pub(crate) fn line(fields: &str, points: &[(f64, f64)]) -> String {
    let points: Vec<String> = points.iter().map(|(x, y)| format!("[{x},{y}]")).collect();
    feature(fields, "LineString", &format!("[{}]", points.join(",")))
}

pub(crate) fn point(fields: &str, (x, y): (f64, f64)) -> String {
    feature(fields, "Point", &format!("[{x},{y}]"))
}

pub(crate) fn square(fields: &str, (x, y): (f64, f64), side: f64) -> String {
    let (e, n) = (x + side, y + side);
    feature(
        fields,
        "Polygon",
        &format!("[[[{x},{y}],[{e},{y}],[{e},{n}],[{x},{n}],[{x},{y}]]]"),
    )
}

pub(crate) fn text(layers: &[&str], rules: &str) -> String {
    let layer =
        |name: &&str| format!("<Layer name=\"{name}\" src=\"{name}.geojson\" crs=\"local\"/>");
    let layers: Vec<String> = layers.iter().map(layer).collect();
    format!(
        "<Town seed=\"1\" origin=\"0 0\">{}{rules}</Town>",
        layers.join("")
    )
}

/// Returns what a town makes.
pub(crate) fn made(text: &str, folder: &Path) -> Vec<House> {
    let name = folder.join("town.hsd");
    let source = Source::new(FileId(0), name.to_string_lossy(), text.as_bytes());
    let world = FolderWorld::new(vec![], 1 << 20).with_roots(vec![folder.to_owned()]);
    let (options, mut out) = (Options::default(), Diagnostics::new());
    let read = hsd::driver::documents(&[&source], &world, &options, &mut out);
    let town = read
        .documents
        .into_iter()
        .find_map(|d| d.town)
        .expect("is a town");
    let input = TownInput::new(&source, &world, &options);
    let plan = run::plan(input, &town, &mut out);
    let plan = plan.unwrap_or_else(|| panic!("{:?}", out.iter().collect::<Vec<_>>()));
    TownStream::new(input, &plan)
        .map(|made| made.house)
        .collect()
}

/// Returns the upper faces of a surface, in the frame of the town, and the height of each.
pub(crate) fn tops(houses: &[House], wanted: impl Fn(&Sheet) -> bool) -> Vec<Vec<DVec3>> {
    let mut found = vec![];
    for house in houses {
        let of = |v: &Option<hsd::source::Spanned<f64>>| v.as_ref().map_or(0.0, |v| v.value);
        let base = DVec3::new(of(&house.settings.x), of(&house.settings.y), 0.0);
        let outdoors = house.fittings.outdoors.iter();
        for sheet in outdoors
            .flat_map(|o| &o.sheets)
            .filter(|sheet| wanted(sheet))
        {
            let flat = sheet
                .faces
                .iter()
                .filter(|f| f.iter().all(|p| (p.z - f[0].z).abs() < 1e-9));
            found.extend(flat.map(|face| face.iter().map(|p| *p + base).collect()));
        }
    }
    found
}

pub(crate) fn holds(face: &[DVec3], p: DVec2) -> bool {
    (0..face.len()).all(|i| {
        let (a, b) = (face[i].truncate(), face[(i + 1) % face.len()].truncate());
        (b - a).perp_dot(p - a) > 1e-6
    })
}

pub(crate) fn area(face: &[DVec3]) -> f64 {
    let cross = |i: usize| {
        face[i]
            .truncate()
            .perp_dot(face[(i + 1) % face.len()].truncate())
    };
    (0..face.len()).map(cross).sum::<f64>() / 2.0
}

fn crossing() -> tempfile::TempDir {
    folder(&[(
        "roads",
        &[
            line(r#""width":12"#, &[(-60.0, 0.0), (0.0, 0.0), (60.0, 8.0)]),
            line(r#""width":6"#, &[(0.0, -50.0), (0.0, 0.0)]),
            line(r#""width":6"#, &[(0.0, 0.0), (10.0, 50.0)]),
            line(r#""width":6"#, &[(-40.0, 30.0), (30.0, 31.0)]),
            line(r#""width":3"#, &[(30.0, -40.0), (30.0, 40.0)]),
        ],
    )])
}

#[test]
fn each_place_of_a_crossing_is_covered_once() {
    let folder = crossing();
    let rule = "<for each=\"roads\"><Road pavement=\"2\" marks=\"no\"/></for>";
    let houses = made(&text(&["roads"], rule), folder.path());
    assert_eq!(houses.len(), 5);
    let faces = tops(&houses, |_| true);
    let carriageways = tops(&houses, |sheet| sheet.finish == "asphalt");
    let ways = [
        ([(-60.0, 0.0), (0.0, 0.0)], 6.0),
        ([(0.0, 0.0), (60.0, 8.0)], 6.0),
        ([(0.0, -50.0), (0.0, 0.0)], 3.0),
        ([(0.0, 0.0), (10.0, 50.0)], 3.0),
        ([(-40.0, 30.0), (30.0, 31.0)], 3.0),
        ([(30.0, -40.0), (30.0, 40.0)], 1.5),
    ];
    let beside = |p: DVec2, [from, to]: [(f64, f64); 2]| {
        let (a, b) = (DVec2::from(from), DVec2::from(to));
        let share = (p - a).dot(b - a) / (b - a).length_squared();
        (share, a.lerp(b, share).distance(p))
    };
    for n in 0..4000 {
        let p = dvec2(
            f64::from(n * 37 % 1201) / 10.0 - 60.05,
            f64::from(n * 91 % 997) / 10.0 - 49.93,
        );
        let count = faces.iter().filter(|face| holds(face, p)).count();
        assert!(count <= 1, "{p} is covered {count} times");
        let on = |half: f64| {
            ways.iter().any(|(line, own)| {
                let (share, far) = beside(p, *line);
                (0.001..0.999).contains(&share) && far < own - half
            })
        };
        if on(0.05) {
            assert_eq!(count, 1, "{p} lies on a road");
        }
        // Pavements are left out where 3 m would not stay: of the road of 3 m.
        let inner = ways.iter().any(|(line, own)| {
            let (share, far) = beside(p, *line);
            let half = if *own > 3.0 { own - 2.0 } else { *own };
            (0.001..0.999).contains(&share) && far < half - 0.05
        });
        if inner {
            assert!(
                carriageways.iter().any(|face| holds(face, p)),
                "{p} is carriageway"
            );
        }
    }
}

#[test]
fn dashes_are_whole_and_leave_crossings_free() {
    let folder = crossing();
    let houses = made(
        &text(&["roads"], "<for each=\"roads\"><Road/></for>"),
        folder.path(),
    );
    let marks = tops(&houses, |sheet| sheet.finish == "road_paint");
    assert!(!marks.is_empty());
    // A road of 6 m: dashes of 5 m in the middle.
    let lane = folder_of_one(&[(0.0, 0.0), (48.0, 0.0)], 6.0);
    let houses = made(
        &text(&["roads"], "<for each=\"roads\"><Road/></for>"),
        lane.path(),
    );
    let marks = tops(&houses, |sheet| sheet.finish == "road_paint");
    let middle: f64 = marks
        .iter()
        .filter(|f| f[0].y.abs() < 0.2)
        .map(|f| area(f))
        .sum();
    assert!(
        (middle - 5.0 * 5.0 * 0.15).abs() < 1e-6,
        "five dashes of 5 m: {middle}"
    );
    let earth = made(
        &text(
            &["roads"],
            "<for each=\"roads\"><Road surface=\"earth\"/></for>",
        ),
        lane.path(),
    );
    assert!(tops(&earth, |sheet| sheet.finish == "road_paint").is_empty());
}

fn folder_of_one(points: &[(f64, f64)], width: f64) -> tempfile::TempDir {
    folder(&[("roads", &[line(&format!("\"width\":{width}"), points)])])
}

#[test]
fn trees_stand_outside_of_walls_and_keep_their_draws() {
    let houses = [square(r#""key":"h1""#, (20.0, 20.0), 10.0)];
    let trees: Vec<String> = [(25.0, 25.0), (5.0, 5.0), (40.0, 8.0)]
        .map(|at| point("", at))
        .to_vec();
    let back: Vec<String> = trees.iter().rev().cloned().collect();
    let grove = [square("", (0.0, 0.0), 60.0)];
    let rules = "<for each=\"houses\"><Place type=\"so-nikai\"/></for><for each=\"trees\"><Tree/></for><for each=\"groves\"><Tree spacing=\"3\"/></for>";
    let text = text(&["houses", "trees", "groves"], rules);
    let town = |trees: &[String]| {
        let folder = folder(&[("houses", &houses), ("trees", trees), ("groves", &grove)]);
        let built = in_folder(&text, folder.path(), |_| {});
        (built, made(&text, folder.path()))
    };
    let ((built, one), (_, other)) = (town(&trees), town(&back));
    let kinds: Vec<&str> = built.rows.iter().map(|row| &*row["type"]).collect();
    assert_eq!(kinds, ["so-nikai", "", "tree", "tree", "tree"]);
    assert_eq!(built.rows[1]["what"], "refused");
    assert!(
        built.found.contains(&"HSD1170".to_owned()),
        "{:?}",
        built.found
    );
    assert!(
        number(&built.rows[0], "width") > 0.0,
        "the grove is no neighbour"
    );
    let all = |houses: &[House]| {
        let of = |house: &House| {
            house
                .fittings
                .outdoors
                .iter()
                .flat_map(|o| o.trees.clone())
                .collect::<Vec<Tree>>()
        };
        let mut trees: Vec<Tree> = houses.iter().flat_map(of).collect();
        trees.sort_by(|a, b| {
            (a.at.x, a.at.y)
                .partial_cmp(&(b.at.x, b.at.y))
                .expect("finite")
        });
        trees
    };
    let (one, other) = (all(&one), all(&other));
    assert_eq!(one, other, "the order of features draws nothing");
    assert!((300..400).contains(&one.len()), "{} trees", one.len());
    for tree in &one {
        let inside = |t: f64| (19.5..30.5).contains(&t);
        assert!(
            !(inside(tree.at.x) && inside(tree.at.y)),
            "{} is in the wall",
            tree.at
        );
    }
}

#[test]
fn a_tree_takes_less_than_200_bytes_of_a_tile() {
    let town = |count: usize| {
        let at = |n: usize| (n as f64 % 20.0 * 6.1, n as f64 / 20.0 * 0.3);
        let trees: Vec<String> = (0..count).map(|n| point("", at(n))).collect();
        let folder = folder(&[("trees", &trees)]);
        let text = text(
            &["trees"],
            "<for each=\"trees\"><Tree/></for><Tiles size=\"1000\"/>",
        );
        let built = build(&text, folder.path(), &Memory::default(), 1).expect("nothing fails");
        let levels = built.town.tiles.iter().flat_map(|tile| &tile.levels);
        let sizes: Vec<u64> = levels.map(|level| level.bytes).collect();
        let glb = built
            .all()
            .1
            .into_iter()
            .find(|(name, _)| name.ends_with("-3.glb"));
        (sizes, glb.expect("is there").1)
    };
    let ((few, _), (many, glb)) = (town(200), town(600));
    for (few, many) in few.iter().zip(&many) {
        let each = (many - few) / 400;
        assert!(each < 200, "{each} bytes a tree");
    }
    let length = u32::from_le_bytes(glb[12..16].try_into().expect("four")) as usize;
    let json: Value = serde_json::from_slice(&glb[20..20 + length]).expect("is JSON");
    let nodes = json["nodes"].as_array().expect("nodes");
    let count = |node: &Value| {
        let extensions = &node["extensions"];
        assert_eq!(
            extensions["EXT_instance_features"]["featureIds"][0]["featureCount"],
            600
        );
        let at = extensions["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"].as_u64();
        json["accessors"][at.expect("stands") as usize]["count"]
            .as_u64()
            .expect("some")
    };
    assert_eq!(nodes.len(), 5, "a model for each species");
    assert_eq!(nodes.iter().map(count).sum::<u64>(), 600);
}

#[test]
fn fences_have_whole_units_and_closed_corners() {
    let lots = [square("", (0.0, 0.0), 12.4)];
    let lines = [line("", &[(30.0, 0.0), (40.0, 0.0), (40.0, 0.3)])];
    let folder = folder(&[("lots", &lots), ("lines", &lines)]);
    let rules = "<for each=\"lots\"><Wall/></for><for each=\"lines\"><Fence first=\"KTB\" last=\"KTK\"/></for>";
    let text = text(&["lots", "lines"], rules);
    let houses = made(&text, folder.path());
    assert_eq!(houses.len(), 2);
    let rows = |house: &House| -> Vec<(Vec<f64>, Vec<String>, f64)> {
        let Some(Item::One(storey)) = house.storeys.first() else {
            panic!("a storey")
        };
        let rows = storey.loops[0].rows.iter().map(|row| {
            let Item::One(row) = row else { panic!("a row") };
            let part = |piece: &Item<Piece>| {
                let Item::One(Piece::Part(part)) = piece else {
                    panic!("a part")
                };
                let width = part.width.as_ref().map_or(0.0, |w| w.value);
                (
                    width * 10.0 / 11.0,
                    part.code.value.as_str().trim_end().to_owned(),
                )
            };
            let (widths, codes) = row.pieces.iter().map(part).unzip();
            (widths, codes, row.turn.as_ref().map_or(0.0, |t| t.value))
        });
        rows.collect()
    };
    let around = rows(&houses[0]);
    assert_eq!(around.len(), 4);
    for (widths, codes, _) in &around {
        assert_eq!(widths.len(), 14, "12.4 m of units of 0.909 m");
        assert!((widths.iter().sum::<f64>() - 12.4).abs() < 1e-6);
        assert!(codes.iter().all(|code| code == "KDB"));
    }
    let turns: Vec<f64> = around.iter().map(|(_, _, turn)| turn.round()).collect();
    assert_eq!(turns[..3], [90.0; 3], "clockwise, its outside to the left");
    let along = rows(&houses[1]);
    assert_eq!(along[0].0.len(), 11);
    assert_eq!(along[0].1[0], "KTB");
    assert_eq!(along[1].1, ["KTK"]);
    assert_eq!(along[0].2.round(), -90.0);
}
