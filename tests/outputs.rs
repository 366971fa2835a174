//! Models for other programs: closed bodies to print, houses as single meshes, and what they tell of their sources.

use crate::support::{Run, assert_none, compile, compile_file, on_all_processors, stem};
use crate::support::{details_in_turn, texts, texts_in_turn};
use hsd::backend::spool::in_memory;
use hsd::backend::{NoImages, gltf, stl};
use hsd::driver;
use hsd::scene::{Detail, Kind, Scene};
use serde_json::Value;
use std::collections::{BTreeMap, HashMap};

/// The corners of the triangles of an `.stl`, millimetres.
fn printed(stl: &[u8]) -> Vec<[[f32; 3]; 3]> {
    let triangles = stl[84..].chunks_exact(50).map(|record| {
        let number = |k: usize| f32::from_le_bytes(record[12 + 4 * k..][..4].try_into().unwrap());
        [0, 1, 2].map(|corner| [0, 1, 2].map(|k| number(3 * corner + k)))
    });
    triangles.collect()
}

/// The number of edges that are used more often in one direction than in the other.
fn open_edges(triangles: &[[[f32; 3]; 3]]) -> usize {
    let mut sums: HashMap<[[u32; 3]; 2], i32> = HashMap::new();
    for triangle in triangles {
        let [a, b, c] = triangle.map(|p| p.map(f32::to_bits));
        for [p, q] in [[a, b], [b, c], [c, a]] {
            let (edge, way) = if p < q { ([p, q], 1) } else { ([q, p], -1) };
            *sums.entry(edge).or_insert(0) += way;
        }
    }
    sums.values().filter(|sum| **sum != 0).count()
}

#[test]
fn every_body_of_every_example_is_closed_at_every_detail() {
    let examples = texts_in_turn("examples", 1);
    assert_none(&on_all_processors(examples.len(), |number| {
        let run = compile_file(&examples[number]);
        let mut found = vec![];
        for &detail in details_in_turn(number) {
            let name = format!("{} at {detail:?}", stem(&examples[number]));
            let scene = driver::scene(&run.building, &run.catalog, detail);
            let triangles = printed(&stl::stl(&scene, stl::Print::default()));
            let open = open_edges(&triangles);
            if open > 0 {
                found.push(format!("{name}: {open} open edges"));
            }
            let corners = || triangles.iter().flatten();
            let least = [0, 1, 2].map(|k| corners().map(|p| p[k]).fold(f32::MAX, f32::min));
            if !triangles.is_empty() && least != [0.0; 3] {
                found.push(format!("{name}: begins at {least:?}"));
            }
        }
        found
    }));
}

#[test]
fn models_are_printed_to_scale() {
    let run = compile_file(&crate::support::root().join("examples/machiya.hsd"));
    let size = |scale: f64, detail: Detail| {
        let scene = driver::scene(&run.building, &run.catalog, detail);
        let print = stl::Print {
            scale,
            min_wall: 0.4,
        };
        let mut writer = stl::Writer::new(print, &in_memory).unwrap();
        writer.add(scene.whole()).unwrap();
        let thin = writer.thin().clone();
        let mut bytes = vec![];
        writer.write(&mut bytes).unwrap();
        let corners = printed(&bytes).into_iter().flatten();
        (corners.map(|p| p[2]).fold(0.0, f32::max), thin)
    };
    let (whole, none) = size(1.0, Detail::Everything);
    let (small, some) = size(100.0, Detail::Everything);
    assert!((whole / small - 100.0).abs() < 0.01, "{whole} {small}");
    assert_eq!(none.thin, 0, "{none:?}");
    assert!(some.thin > 100 && some.thin < some.all, "{some:?}");
    let (least, name, span) = some.thinnest.expect("the thinnest");
    assert!(least < 0.4 && !name.is_empty() && span.is_some());
    // Panels of joinery are as thick as they must be.
    let (_, panels) = size(100.0, Detail::Body);
    assert_eq!(panels.thin, 0, "{panels:?}");
}

/// The description in a `.glb`.
fn json(glb: &[u8]) -> Value {
    let length = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
    serde_json::from_slice(&glb[20..20 + length]).unwrap()
}

fn described(scene: &Scene) -> Value {
    json(&gltf::glb(scene, &NoImages))
}

fn nodes(model: &Value) -> &[Value] {
    model["nodes"].as_array().unwrap()
}

#[test]
fn nodes_tell_where_they_are_written() {
    for path in texts("examples") {
        let run = compile_file(&path);
        for node in run.scene.nodes.iter().filter(|n| n.kind != Kind::Ground) {
            let place = node
                .place
                .map(|p| (p.line.get() as usize, p.column as usize));
            let span = node.span.map(|span| run.file(span).line_column(span));
            assert_eq!(place, span, "{} {}", stem(&path), node.name);
        }
        let model = described(&run.scene);
        let files = model["asset"]["extras"]["files"].as_array().unwrap();
        assert_eq!(files.len(), 1 + run.included.len());
        let house = &nodes(&model)[0]["extras"];
        assert!(files.contains(&house["source"]), "{house}");
    }
    let run = compile_file(&crate::support::root().join("examples/machiya.hsd"));
    let model = described(&run.scene);
    assert_eq!(model["asset"]["extras"]["detail"], 3);
    let parts = nodes(&model).iter().map(|node| &node["extras"]);
    for part in parts.filter(|extras| extras["kind"] == "part") {
        let code = part["code"].as_str().unwrap();
        let known = run
            .catalog
            .parts()
            .iter()
            .find(|p| p.code() == code)
            .unwrap();
        assert_eq!(part["ja"], *known.ja);
        assert_eq!(part["en"], *known.en);
        assert!(part["facade"].is_u64() && part["line"].is_u64(), "{part}");
    }
}

#[test]
fn names_of_nodes_are_unique() {
    for path in texts("examples") {
        let run = compile_file(&path);
        let model = described(&run.scene);
        let mut known: BTreeMap<&str, usize> = BTreeMap::new();
        for node in nodes(&model) {
            *known
                .entry(node["extras"]["id"].as_str().unwrap())
                .or_insert(0) += 1;
        }
        let twice: Vec<_> = known.iter().filter(|(_, n)| **n > 1).collect();
        assert!(twice.is_empty(), "{}: {twice:?}", stem(&path));
    }
}

/// The ids of the parts of a house, with their codes.
fn ids(run: &Run) -> BTreeMap<String, String> {
    let model = described(&run.scene);
    let parts = nodes(&model).iter().map(|node| &node["extras"]);
    let parts = parts.filter(|extras| extras["kind"] == "part");
    let word = |of: &Value| of.as_str().unwrap().to_owned();
    parts.map(|p| (word(&p["id"]), word(&p["code"]))).collect()
}

#[test]
fn names_of_nodes_stay_when_neighbours_change() {
    let house = |front: &str| format!("0 0\n9\n\n{front}\n{}", "GSI  GSI  GSI  GSI\n".repeat(3));
    let before = ids(&compile("a.hsd", house("GSI  TOD  KTU  GSI").as_bytes()));
    // A part is of another kind, and a house comes before.
    let changed = house("GSI  TOD  KTU  KSK");
    let two = format!("20 0\n9\n\n{}%\n{changed}", "KTU  KTU\n".repeat(4));
    let after = ids(&compile("a.hsd", two.as_bytes()));
    assert_eq!(
        after.keys().filter(|id| before.contains_key(*id)).count(),
        before.len()
    );
    let same = before.iter().filter(|(id, code)| after[*id] == **code);
    assert_eq!(same.count(), before.len() - 1, "{before:?} {after:?}");
}

/// A model of merged houses.
fn merged(scene: &Scene, tangents: bool) -> Value {
    let writer = gltf::Writer::new(&in_memory).unwrap().merging(true);
    let mut writer = writer.without_tangents(!tangents);
    writer.add(scene.whole(), &NoImages).unwrap();
    json(
        &writer
            .glb(&scene.materials, &NoImages, &[])
            .unwrap()
            .bytes(),
    )
}

/// The primitives that are drawn, and their triangles.
fn draws(model: &Value) -> (usize, u64) {
    let indices = |p: &Value| {
        let accessor = p["indices"].as_u64().unwrap() as usize;
        model["accessors"][accessor]["count"].as_u64().unwrap() / 3
    };
    let shown = nodes(model).iter().filter_map(|node| node["mesh"].as_u64());
    let primitives = shown.flat_map(|m| {
        model["meshes"][m as usize]["primitives"]
            .as_array()
            .unwrap()
    });
    primitives.fold((0, 0), |(n, sum), p| (n + 1, sum + indices(p)))
}

#[test]
fn merged_houses_have_a_primitive_for_each_material() {
    for name in ["office", "machiya", "street"] {
        let run = compile_file(&crate::support::root().join(format!("examples/{name}.hsd")));
        let (apart, whole) = (described(&run.scene), merged(&run.scene, true));
        let ((many, triangles), (few, same)) = (draws(&apart), draws(&whole));
        assert_eq!(triangles, same, "{name}");
        let houses = run.building.houses.len();
        assert_eq!(nodes(&whole).len(), houses, "{name}");
        let materials = whole["materials"].as_array().unwrap().len();
        assert!(
            few <= materials * houses && few * 4 < many,
            "{name}: {many} to {few}"
        );
        let of = |model: &Value| nodes(model)[0]["extras"].clone();
        assert_eq!(of(&apart), of(&whole), "{name}");
    }
}
