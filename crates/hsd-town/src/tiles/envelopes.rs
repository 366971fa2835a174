//! The envelopes of a town as a table and as a scene: a node for each lot below one for its scenario, a material for each rule, so
//! that each face tells what binds it. Scenarios stand side by side from west to east, in the order of their names' first use
//! (002-32, figures 10 and 11).

mod pictures;

pub use pictures::page;

use crate::decision::ENVELOPES_HEAD;
use crate::site::law::EnvelopeRow;
use compact_str::{CompactString, format_compact};
use glam::{DVec2, DVec3, dvec3};
use hsd_scene::{Image, Kind, Material, MaterialId, Mesh, MeshId, Node, NodeId, Primitive, Scene};
use std::collections::BTreeSet;

/// The free width between two scenarios, as a share of the width of the town.
const APART: f64 = 0.05;
/// The colours of what binds a face, by the word of its rule, linear; those of borders and the ground.
const LOOKS: [(&str, [f32; 4]); 4] = [
    ("road", [0.8, 0.22, 0.1, 1.0]),
    ("side", [0.1, 0.4, 0.75, 1.0]),
    ("ratio", [0.35, 0.55, 0.25, 1.0]),
    ("height", [0.75, 0.6, 0.25, 1.0]),
];
const PLAIN: [f32; 4] = [0.72, 0.7, 0.66, 1.0];

/// Returns the names of the scenarios of envelopes, in the order of their first use.
pub fn scenarios(rows: &[EnvelopeRow]) -> Vec<&str> {
    let mut found: Vec<&str> = vec![];
    for row in rows {
        if !found.contains(&&*row.scenario) {
            found.push(&row.scenario);
        }
    }
    found
}

/// Returns the table of envelopes.
pub fn table(rows: &[EnvelopeRow]) -> String {
    let lines: String = rows.iter().map(EnvelopeRow::line).collect();
    ENVELOPES_HEAD.to_owned() + &lines
}

/// Returns the scene of envelopes.
pub fn scene(rows: &[EnvelopeRow]) -> Scene {
    let faces = rows.iter().flat_map(|row| &row.faces);
    let rules: BTreeSet<&str> = faces.map(|face| &*face.rule).collect();
    let rules: Vec<&str> = rules.into_iter().collect();
    let mut scene = Scene {
        materials: rules.iter().map(|rule| material(rule)).collect(),
        ..Scene::default()
    };
    let step = width(rows) * (1.0 + APART);
    for (number, scenario) in scenarios(rows).into_iter().enumerate() {
        let at = dvec3(step * number as f64, 0.0, 0.0);
        let name = match scenario {
            "" => "envelopes".into(),
            name => CompactString::from(name),
        };
        let root = NodeId(scene.nodes.len() as u32);
        scene.nodes.push(Node::new(None, Kind::Outdoors, name, at));
        for row in rows.iter().filter(|row| row.scenario == scenario) {
            lot(&mut scene, (root, &rules), row);
        }
    }
    scene
}

/// Returns how wide envelopes lie from west to east, metres.
fn width(rows: &[EnvelopeRow]) -> f64 {
    let places = rows.iter().flat_map(|row| &row.faces);
    let places = places.flat_map(|face| face.ring.iter().map(|p| p[0]));
    let wider = |[low, high]: [f64; 2], x: f64| [low.min(x), high.max(x)];
    let [low, high] = places.fold([f64::INFINITY, f64::NEG_INFINITY], wider);
    (high - low).max(0.0)
}

/// Returns the look of the faces that a rule binds.
fn material(rule: &str) -> Material {
    let kind = rule.strip_prefix("end of ").unwrap_or(rule);
    let kind = kind.split(' ').next().unwrap_or_default();
    let look = LOOKS.iter().find(|(word, _)| *word == kind);
    Material {
        name: format!("envelope {rule}"),
        image: Image::None,
        tint: look.map_or(PLAIN, |(_, tint)| *tint),
        roughness: 0.9,
        metallic: 0.0,
        double_sided: false,
        cutout: false,
        reflection: None,
        mirrored: None,
    }
}

/// Adds the envelope of a lot, a primitive for each rule.
fn lot(scene: &mut Scene, (root, rules): (NodeId, &[&str]), row: &EnvelopeRow) {
    let first = row.faces.iter().find_map(|face| face.ring.first());
    let Some(first) = first else {
        return;
    };
    let at = DVec3::from(*first);
    let name = format_compact!("{} {}", row.layer, row.key);
    let primitives = rules.iter().zip(0..).filter_map(|(rule, number)| {
        let own = row.faces.iter().filter(|face| face.rule == *rule);
        let mut primitive = Primitive {
            material: MaterialId(number),
            positions: vec![],
            normals: vec![],
            uvs: vec![],
            mirror_uvs: vec![],
            indices: vec![],
        };
        own.for_each(|face| add(&mut primitive, &face.ring, at));
        (!primitive.indices.is_empty()).then_some(primitive)
    });
    let primitives: Vec<Primitive> = primitives.collect();
    let mut node = Node::new(Some(root), Kind::Outdoors, name.clone(), at);
    node.mesh = Some(MeshId(scene.meshes.len() as u32));
    scene.meshes.push(Mesh {
        name: name.into(),
        primitives,
    });
    scene.nodes.push(node);
}

/// Adds a face.
fn add(primitive: &mut Primitive, ring: &[[f64; 3]], base: DVec3) {
    let ring: Vec<DVec3> = ring.iter().map(|p| DVec3::from(*p) - base).collect();
    let fan = ring[1..].windows(2);
    let normal: DVec3 = fan
        .map(|two| (two[0] - ring[0]).cross(two[1] - ring[0]))
        .sum();
    let normal = normal.normalize_or_zero();
    let right = match normal.truncate().length() > 1e-6 {
        true => DVec3::Z.cross(normal).normalize_or_zero(),
        false => DVec3::X,
    };
    let up = normal.cross(right);
    let start = primitive.positions.len() as u32;
    for p in &ring {
        primitive.positions.push(p.as_vec3().to_array());
        primitive.normals.push(normal.as_vec3().to_array());
        let uv = DVec2::new(p.dot(right), p.dot(up));
        primitive.uvs.push(uv.as_vec2().to_array());
    }
    let last = ring.len() as u32 - 1;
    for n in 1..last {
        primitive.indices.extend([start, start + n, start + n + 1]);
    }
}
