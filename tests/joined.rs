//! Houses in common meshes show what houses with their own nodes show, each under its number.

use gltf::binary::Glb;
use hsd::backend::gltf::Writer;
use hsd::backend::images::Library;
use hsd::backend::spool::in_memory;
use hsd::diagnostic::Diagnostics;
use hsd::driver::{self, Feed, Options};
use hsd::scene::{Detail, ScenePart};
use hsd::source::{FileId, NoFiles, Source};
use serde_json::Value;
use std::collections::BTreeMap;

/// What is seen of a house: for each material its triangles, their area, and the sum of their corners.
type Seen = BTreeMap<u64, (usize, f64, [f64; 3])>;

/// Builds a model at detail 0.
fn glb(text: &str, joins: bool, threads: usize) -> Vec<u8> {
    let source = Source::new(FileId(0), "town.hsd", text.as_bytes());
    let options = Options {
        detail: Detail::Body,
        own_meshes: joins,
        ..Options::default()
    };
    let mut out = Diagnostics::new();
    let writer = Writer::new(&in_memory).expect("memory takes every byte");
    let mut writer = writer.joining(joins);
    let mut sink = |part: ScenePart<'_>, images: &Library| writer.add(part, images);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let sources = [&source];
    let town = pool.expect("threads start").install(|| {
        let outlet = (&mut sink as &mut driver::Sink<'_>, &in_memory as _);
        driver::stream(Feed::whole(&sources), &NoFiles, &options, &mut out, outlet)
    });
    let town = town.expect("memory takes every byte");
    assert!(!out.has_errors());
    let glb = writer.glb(&town.materials, &town.library, &town.grown);
    glb.expect("memory takes every byte").bytes()
}

/// A model that is read back.
struct Model {
    json: Value,
    bytes: Vec<u8>,
}

impl Model {
    fn of(bytes: &[u8]) -> Model {
        let parts = Glb::from_slice(bytes).unwrap();
        let json = serde_json::from_slice(&parts.json).unwrap();
        let bytes = parts.bin.unwrap().into_owned();
        Model { json, bytes }
    }

    /// Returns the elements of an accessor, as numbers.
    fn array(&self, accessor: &Value) -> Vec<Vec<f64>> {
        let whole = |value: &Value| value.as_u64().unwrap_or(0) as usize;
        let accessor = &self.json["accessors"][whole(accessor)];
        let view = &self.json["bufferViews"][whole(&accessor["bufferView"])];
        let width = match whole(&accessor["componentType"]) {
            5123 => 2,
            _ => 4,
        };
        let components = match accessor["type"].as_str().unwrap() {
            "SCALAR" => 1,
            "VEC2" => 2,
            _ => 3,
        };
        let stride = view["byteStride"]
            .as_u64()
            .map_or(width * components, |s| s as usize);
        let start = whole(&view["byteOffset"]) + whole(&accessor["byteOffset"]);
        let element = |i: usize| {
            let at = |k: usize| start + i * stride + k * width;
            let number = |k: usize| match whole(&accessor["componentType"]) {
                5123 => f64::from(u16::from_le_bytes(
                    self.bytes[at(k)..][..2].try_into().unwrap(),
                )),
                5125 => f64::from(u32::from_le_bytes(
                    self.bytes[at(k)..][..4].try_into().unwrap(),
                )),
                _ => f64::from(f32::from_le_bytes(
                    self.bytes[at(k)..][..4].try_into().unwrap(),
                )),
            };
            (0..components).map(number).collect()
        };
        (0..whole(&accessor["count"])).map(element).collect()
    }

    /// Returns what is seen of each house, by its name; `id` returns its name from a node and the number of a vertex.
    fn seen(&self, id: impl Fn(&Value, Option<usize>) -> String) -> BTreeMap<String, Seen> {
        let mut houses: BTreeMap<String, Seen> = BTreeMap::new();
        for node in self.json["nodes"].as_array().unwrap() {
            let mesh = &self.json["meshes"][node["mesh"].as_u64().unwrap() as usize];
            let moved = |k: usize| node["translation"][k].as_f64().unwrap_or(0.0);
            let turned = |k: usize| node["rotation"][k].as_f64();
            let (y, w) = (turned(1).unwrap_or(0.0), turned(3).unwrap_or(1.0));
            let (cos, sin) = (w * w - y * y, 2.0 * w * y);
            for p in mesh["primitives"].as_array().unwrap() {
                let points = self.array(&p["attributes"]["POSITION"]);
                let ids = &p["attributes"]["_FEATURE_ID_0"];
                let ids = (!ids.is_null()).then(|| self.array(ids));
                let world = |i: usize| {
                    let [x, h, z] = [0, 1, 2].map(|k| points[i][k]);
                    let turned = [x * cos + z * sin, h, z * cos - x * sin];
                    [0, 1, 2].map(|k| turned[k] + moved(k))
                };
                for three in self.array(&p["indices"]).chunks(3) {
                    let corners = [0, 1, 2].map(|k| three[k][0] as usize);
                    let number = ids.as_ref().map(|ids| corners.map(|i| ids[i][0] as usize));
                    assert!(number.is_none_or(|n| n[0] == n[1] && n[1] == n[2]));
                    let name = id(node, number.map(|n| n[0]));
                    let material = p["material"].as_u64().unwrap();
                    let seen = houses.entry(name).or_default().entry(material).or_default();
                    let [a, b, c] = corners.map(|i| glam::DVec3::from(world(i)));
                    seen.0 += 1;
                    seen.1 += (b - a).cross(c - a).length() / 2.0;
                    let sum = (a + b + c).to_array();
                    seen.2 = [0, 1, 2].map(|k| seen.2[k] + sum[k]);
                }
            }
        }
        houses
    }
}

/// Houses of several shapes and directions; some have a twin far away.
fn town() -> String {
    let mut houses = String::from("<Houses>\n");
    for n in 0..600 {
        let (x, y) = (n % 20 * 30, n / 20 * 30 + n / 500 * 9_000);
        let (a, b) = (n % 7 + 4, n % 3 + 3);
        let rows = match n % 2 {
            0 => vec![(a, ""), (b, ""), (a, ""), (b, "")],
            _ => vec![
                (a + 3, ""),
                (b, ""),
                (3, " turn='L'"),
                (2, ""),
                (a, ""),
                (b + 2, ""),
            ],
        };
        let row = |(units, turn)| format!("<Row{turn}><Part code='KOB' width='{units}'/></Row>");
        let rows: String = rows.into_iter().map(row).collect();
        let azimuth = n % 5 * 50;
        // The last ones are twins of the first.
        let height = 8.5 + (n % 504) as f64 / 500.0;
        houses += &format!(
            "<House name='h{n}' x='{x}' y='{y}' azimuth='{azimuth}'><Storey height='{height}'>{rows}</Storey>\
             <Roofs shape='{}' pitch='4'/></House>\n",
            ["KIR", "YOS"][n % 4 / 2]
        );
    }
    houses + "</Houses>\n"
}

#[test]
fn joined_houses_show_the_same() {
    let town = town();
    let (apart, joined) = (glb(&town, false, 2), glb(&town, true, 2));
    for threads in [1, 7] {
        assert!(
            joined == glb(&town, true, threads),
            "other bytes on {threads} threads"
        );
    }
    assert!(joined.len() < apart.len());
    let (apart, joined) = (Model::of(&apart), Model::of(&joined));
    assert_eq!(
        joined.json["extensionsUsed"],
        serde_json::json!(["EXT_mesh_features"])
    );
    assert!(joined.json["nodes"].as_array().unwrap().len() < 6);
    let names = |node: &Value, number: Option<usize>| match number {
        None => node["name"].as_str().unwrap().to_owned(),
        Some(number) => node["extras"]["names"][number].as_str().unwrap().to_owned(),
    };
    let (apart, joined) = (apart.seen(names), joined.seen(names));
    assert_eq!(apart.len(), 600);
    assert!(apart.keys().eq(joined.keys()));
    for (name, own) in &apart {
        for (material, (count, area, sum)) in own {
            let (also, same, near) = joined[name][material];
            assert_eq!((name, material, *count), (name, material, also));
            assert!((area - same).abs() < 1e-3 * area, "{name}: {area} {same}");
            let off = (0..3).map(|k| (sum[k] - near[k]).abs()).fold(0.0, f64::max);
            assert!(off < 2e-3 * 3.0 * *count as f64, "{name}: {off}");
        }
    }
}
