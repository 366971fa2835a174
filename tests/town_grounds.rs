//! Residences and blocks of a town: a house, a wall with its gate, and trees that stand in nothing else.

use crate::town_streets::{area, feature, folder, line, made, point, square, text, tops};
use crate::towns::in_folder;
use hsd::ast::{House, Tree};
use hsd::glam::{DVec2, dvec2};

fn trees(houses: &[House]) -> Vec<DVec2> {
    let mut found = vec![];
    for house in houses {
        let of = |v: &Option<hsd::source::Spanned<f64>>| v.as_ref().map_or(0.0, |v| v.value);
        let base = dvec2(of(&house.settings.x), of(&house.settings.y));
        let trees = house.fittings.outdoors.iter().flat_map(|o| &o.trees);
        found.extend(trees.map(|tree: &Tree| tree.at.truncate() + base));
    }
    found
}

fn named(house: &House) -> &str {
    house.name.as_ref().map_or("", |name| name.value.as_str())
}

const STREET: &str = "<for each=\"lots\"><Residence spacing=\"4\"/></for>";

#[test]
fn a_residence_has_a_house_a_wall_a_gate_to_the_street_and_trees_outside_of_them() {
    let lot = square("", (0.0, 4.0), 40.0);
    let road = line(r#""width":6"#, &[(-20.0, 0.0), (60.0, 0.0)]);
    let folder = folder(&[("lots", &[lot]), ("roads", &[road])]);
    let houses = made(&text(&["lots", "roads"], STREET), folder.path());
    let names: Vec<&str> = houses.iter().map(named).collect();
    assert_eq!(names, ["wall", "mon", "shoin", ""]);
    // The gate stands in the middle of the side to the street, and faces it.
    let gate = &houses[1].settings;
    let number = |v: &Option<hsd::source::Spanned<f64>>| v.as_ref().map_or(f64::NAN, |v| v.value);
    assert!((number(&gate.x) - 20.0).abs() < 1e-6 && (number(&gate.y) - 4.0).abs() < 1e-6);
    assert!((number(&gate.azimuth) - 180.0).abs() < 1e-6);
    // The hall of this plot has two wings about a corner, 8 units a leg: 15.76 m square without a quarter of it.
    let half = 16.0 * 3.25 / 3.3 / 2.0;
    let planted = trees(&houses);
    assert!(planted.len() > 20, "{}", planted.len());
    for at in planted {
        let off = at - dvec2(20.0, 24.0);
        let in_wings = off.abs().max_element() < half + 0.49 && (off.x < -0.49 || off.y < -0.49);
        let in_other = off.abs().max_element() < half + 0.49 && (off.x > 0.49 || off.y < -0.49);
        assert!(!(in_wings && in_other), "{at} stands in the house");
        let edge = (at - dvec2(20.0, 24.0)).abs().max_element();
        assert!(edge <= 19.0, "{at} stands in the wall");
        assert!(
            at.distance(dvec2(20.0, 4.0)) > 4.0,
            "{at} stands in the gate"
        );
    }
}

#[test]
fn a_residence_takes_houses_gates_and_sources_of_its_own_and_tells_what_it_cannot_make() {
    let lot = square("", (0.0, 4.0), 40.0);
    let road = line(r#""width":6"#, &[(-20.0, 0.0), (60.0, 0.0)]);
    let folder = folder(&[("lots", &[lot]), ("roads", &[road])]);
    let own = "<define name=\"hut\"><House name=\"hut\"><Storey><Row>KSK  KSK</Row><Row>KSK  KSK</Row><Row>KSK  KSK</Row><Row>KSK  KSK</Row></Storey></House></define>\
        <for each=\"lots\"><Residence house=\"hut\" code=\"none\" spacing=\"0\" evidence=\"a map\"/></for>";
    let built = in_folder(&text(&["lots", "roads"], own), folder.path(), |_| {});
    assert!(built.told.is_empty(), "{:?}", built.told);
    let kinds: Vec<&str> = built.rows.iter().map(|row| &*row["type"]).collect();
    assert!(kinds.contains(&"hut"), "{kinds:?}");
    let narrow = feature("", "Polygon", "[[[0,4],[3,4],[3,40],[0,40],[0,4]]]");
    let path = folder.path().join("narrow.geojson");
    let narrow = format!(r#"{{"type":"FeatureCollection","features":[{narrow}]}}"#);
    std::fs::write(path, narrow).expect("is written");
    let rule = "<for each=\"narrow\"><Residence evidence=\"a map\"/></for>";
    let small = in_folder(&text(&["narrow", "roads"], rule), folder.path(), |_| {});
    assert!(small.told.is_empty(), "{:?}", small.told);
    assert_eq!(&small.rows[0]["why"], "too small for a residence");
    for (rule, wrong) in [
        ("<Residence house=\"palast\"/>", "palast"),
        ("<Residence gate=\"60\"/>", "60"),
        ("<Residence gates=\"3\"/>", "gates"),
        ("<Residence gatehouse=\"yakuimon\"/>", "yakuimon"),
        ("<Block side=\"wide\"/>", "wide"),
    ] {
        let rule = format!("<for each=\"lots\">{rule}</for>");
        let built = in_folder(&text(&["lots", "roads"], &rule), folder.path(), |_| {});
        assert!(
            built.told.iter().any(|told| told[2].contains(wrong)),
            "{rule}: {:?}",
            built.told
        );
    }
}

#[test]
fn a_block_of_heian_is_as_large_as_its_rank() {
    let sides = [119.0, 84.0, 58.0, 21.0];
    let mut at = 0.0;
    let lots = sides.map(|side| {
        at += side + 20.0;
        square("", (at - side, 10.0), side)
    });
    let road = line(r#""width":12"#, &[(0.0, 0.0), (500.0, 0.0)]);
    let folder = folder(&[("lots", &lots), ("roads", &[road])]);
    let rule = "<for each=\"lots\"><Block/></for>";
    let built = in_folder(&text(&["lots", "roads"], rule), folder.path(), |_| {});
    let kinds: Vec<&str> = built
        .rows
        .iter()
        .filter(|row| row["layer"] == "lots")
        .map(|row| &*row["type"])
        .collect();
    assert_eq!(kinds, ["shinden", "shinden", "hondo", "ura-nagaya"]);
    let houses = made(&text(&["lots", "roads"], rule), folder.path());
    let count = |word: &str| {
        houses
            .iter()
            .filter(|house| named(house).starts_with(word))
            .count()
    };
    assert_eq!((count("wall"), count("mon")), (3, 3));
    assert_eq!((count("main hall"), count("east hall")), (2, 2));
}

#[test]
fn each_area_counts_where_no_house_stands() {
    let ponds = feature(
        "",
        "MultiPolygon",
        "[[[[0,0],[20,0],[20,20],[0,20],[0,0]]],[[[40,0],[50,0],[50,10],[40,10],[40,0]]]]",
    );
    let folder = folder(&[("water", &[ponds])]);
    let rule = "<for each=\"water\"><Water bank=\"none\"/></for>";
    let houses = made(&text(&["water"], rule), folder.path());
    let water: f64 = tops(&houses, |sheet| sheet.finish == "water")
        .iter()
        .map(|face| area(face))
        .sum();
    assert!((water - 500.0).abs() < 1e-6, "{water}");
    let built = in_folder(&text(&["water"], rule), folder.path(), |_| {});
    let keys: Vec<&str> = built.rows.iter().map(|row| &*row["key"]).collect();
    assert_eq!(keys, ["0/1", "0/2"]);
}

#[test]
fn streams_that_meet_and_flow_into_a_pond_cover_each_place_once() {
    let pond = square("", (0.0, 0.0), 30.0);
    let streams = [
        line("", &[(15.0, 15.0), (15.0, 80.0)]),
        line("", &[(15.0, 60.0), (70.0, 60.0)]),
    ];
    let folder = folder(&[("ponds", &[pond]), ("streams", &streams)]);
    let rules = "<for each=\"ponds\"><Water bank_width=\"0.8\"/></for><for each=\"streams\"><Water width=\"6\" bank_width=\"0.8\"/></for>";
    let houses = made(&text(&["ponds", "streams"], rules), folder.path());
    let all = tops(&houses, |sheet| {
        sheet.least == 0 && ["water", "stone"].contains(&sheet.finish)
    });
    let water = tops(&houses, |sheet| sheet.finish == "water");
    let holds = crate::town_streets::holds;
    for n in 0..9000 {
        let p = dvec2(
            f64::from(n * 37 % 1201) / 15.0 - 5.03,
            f64::from(n * 91 % 997) / 11.0 - 6.97,
        );
        let count = all.iter().filter(|face| holds(face, p)).count();
        assert!(count <= 1, "{p} is covered {count} times");
        // The middle of the streams and of the pond is water, also where they meet.
        let in_stream = (p.x - 15.0).abs() < 2.1 && p.y > 10.0 && p.y < 79.0
            || (p.y - 60.0).abs() < 2.1 && p.x > 15.0 && p.x < 69.0;
        let in_pond = p.min_element() > 0.85 && p.max_element() < 29.1;
        if in_stream || in_pond {
            let wet = water.iter().any(|face| holds(face, p));
            let edges = all.iter().any(|face| near_edge(face, p));
            assert!(wet || edges, "{p} is water");
        }
    }
    // No wall of a bank stands across a mouth.
    let inner = houses
        .iter()
        .flat_map(|house| house.fittings.outdoors.iter());
    let inner = inner.flat_map(|o| &o.sheets).filter(|s| s.least == 1);
    for face in inner.flat_map(|sheet| &sheet.faces) {
        let low = face.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
        let (p, q) = (face[0].truncate(), face[1].truncate());
        let middle = p.midpoint(q);
        let across = low < 0.0 && (middle.x - 15.0).abs() < 2.0 && (20.0..79.0).contains(&middle.y);
        assert!(!across || (middle.y - 80.0).abs() < 0.1, "{middle}");
    }
}

fn near_edge(face: &[hsd::glam::DVec3], p: DVec2) -> bool {
    (0..face.len()).any(|i| {
        let (a, b) = (face[i].truncate(), face[(i + 1) % face.len()].truncate());
        let t = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        a.lerp(b, t).distance(p) < 0.01
    })
}

#[test]
fn what_is_no_area_is_told_where_areas_are_divided() {
    let quarter = square("", (0.0, 0.0), 60.0);
    let mark = point("", (90.0, 0.0));
    let folder = folder(&[("quarters", &[quarter, mark])]);
    let town = "<Town seed=\"1\"><Layer name=\"quarters\" src=\"quarters.geojson\" crs=\"local\"/><Divide layer=\"quarters\"/>\
        <for each=\"plots\"><Place type=\"hiraya\" on=\"plot\" cap=\"7\"/></for></Town>";
    let built = in_folder(town, folder.path(), |_| {});
    let told: Vec<_> = built
        .told
        .iter()
        .filter(|t| t[2].contains("Divide"))
        .collect();
    assert_eq!(told.len(), 1, "{:?}", built.told);
    assert!(told[0][2].contains("a point"), "{:?}", told[0]);
}

/// The corners of the model of a tree in a tile of a detail, and the number of its triangles.
fn tree_at(detail: &str) -> (Vec<[f32; 3]>, usize) {
    let folder = folder(&[("trees", &[point("", (3.0, 3.0))])]);
    let town = "<Town seed=\"1\"><Layer name=\"trees\" src=\"trees.geojson\" crs=\"local\"/>\
        <for each=\"trees\"><Tree species=\"cherry\"/></for></Town>";
    let built = crate::tiles::build(town, folder.path(), &crate::tiles::Memory::default(), 1);
    let (_, files, _) = built.expect("nothing fails").all();
    let ending = format!("-{detail}.glb");
    let glb = files.into_iter().find(|(name, _)| name.ends_with(&ending));
    let glb = model(&glb.expect("a tile").1);
    (glb.0, glb.1)
}

/// Reads the corners and counts the triangles of the only mesh of a model.
fn model(glb: &[u8]) -> (Vec<[f32; 3]>, usize) {
    let word = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().expect("four")) as usize;
    let end = 20 + word(12);
    let json: serde_json::Value = serde_json::from_slice(&glb[20..end]).expect("is JSON");
    let number = |value: &serde_json::Value| value.as_u64().unwrap_or(0) as usize;
    let primitives = json["meshes"][0]["primitives"].as_array().expect("a mesh");
    let (mut corners, mut triangles) = (vec![], 0);
    for primitive in primitives {
        let accessor = |index: &serde_json::Value| &json["accessors"][number(index)];
        triangles += number(&accessor(&primitive["indices"])["count"]) / 3;
        let places = accessor(&primitive["attributes"]["POSITION"]);
        assert_eq!(places["componentType"], 5126);
        let view = &json["bufferViews"][number(&places["bufferView"])];
        let from = end + 8 + number(&view["byteOffset"]) + number(&places["byteOffset"]);
        let step = number(&view["byteStride"]).max(12);
        corners.extend(
            (0..number(&places["count"]))
                .map(|k| [0, 4, 8].map(|c| f32::from_bits(word(from + k * step + c) as u32))),
        );
    }
    (corners, triangles)
}

#[test]
fn a_tree_from_afar_is_two_crossed_upright_shapes_cut_to_its_outline() {
    for detail in ["0", "1"] {
        let (corners, triangles) = tree_at(detail);
        let in_plane = |k: usize| corners.iter().filter(|p| p[k].abs() < 1e-6).count();
        assert!(
            corners
                .iter()
                .all(|p| p[0].abs() < 1e-6 || p[2].abs() < 1e-6)
        );
        assert_eq!(in_plane(0), in_plane(2), "as much of it in both planes");
        // Its outline, not a rectangle with a picture: a crown wider than its trunk, narrow again at the top.
        let wide = |low: f32, high: f32| {
            let own = corners.iter().filter(|p| (low..=high).contains(&p[1]));
            own.map(|p| p[0].abs()).fold(0.0, f32::max)
        };
        let top = corners.iter().map(|p| p[1]).fold(0.0, f32::max);
        let middle = wide(top * 0.4, top * 0.7);
        assert!(middle > 5.0 * wide(0.0, top * 0.1) && middle > 1.5 * wide(top * 0.9, top));
        assert!(triangles <= 40, "{triangles} triangles");
    }
    let (corners, near) = tree_at("3");
    assert!(near > 40, "a trunk with a crown near by: {near} triangles");
    assert!(
        corners
            .iter()
            .any(|p| p[0].abs() > 0.01 && p[2].abs() > 0.01)
    );
}

#[test]
fn a_road_on_a_slope_rises_along_its_way() {
    let road = line(r#""width":6"#, &[(-60.0, -20.0), (60.0, 30.0)]);
    let folder = folder(&[("roads", &[road])]);
    let mut grid = "ncols 100\nnrows 100\nxllcorner -100\nyllcorner -100\ncellsize 2\n".to_owned();
    let slope = |x: f64, y: f64| 30.0 + 0.08 * x - 0.03 * y;
    for row in 0..100 {
        for column in 0..100 {
            let (x, y) = (f64::from(column) * 2.0 - 99.0, 99.0 - f64::from(row) * 2.0);
            grid += &format!("{:.6} ", slope(x, y));
        }
        grid.push('\n');
    }
    std::fs::write(folder.path().join("ground.asc"), grid).expect("is written");
    let town = "<Town seed=\"1\" origin=\"0 0\"><Layer name=\"ground\" src=\"ground.asc\" crs=\"local\"/>\
        <Layer name=\"roads\" src=\"roads.geojson\" crs=\"local\"/><for each=\"roads\"><Road/></for></Town>";
    let houses = made(town, folder.path());
    let mut seen = 0;
    for house in &houses {
        let of = |v: &Option<hsd::source::Spanned<f64>>| v.as_ref().map_or(0.0, |v| v.value);
        let base = dvec2(of(&house.settings.x), of(&house.settings.y));
        let sheets = house.fittings.outdoors.iter().flat_map(|o| &o.sheets);
        for face in sheets
            .filter(|s| s.finish == "asphalt")
            .flat_map(|s| &s.faces)
        {
            for p in face {
                let at = p.truncate() + base;
                // On the ground, or under it at the sides.
                let over = p.z - slope(at.x, at.y);
                assert!(
                    (over - 0.03).abs() < 0.01 || (over + 0.97).abs() < 0.01,
                    "{over} at {at}"
                );
                seen += 1;
            }
        }
    }
    assert!(seen > 100, "{seen} corners");
}
