//! The rules of 3D Tiles and of what tiles contain, by an own reader of `.glb`.

use super::Built;
use hsd::glam::{DVec3, dvec3};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// A `.glb`: its JSON and its buffer.
pub(super) struct Glb {
    pub(super) json: Value,
    bin: Vec<u8>,
}

impl Glb {
    pub(super) fn new(bytes: &[u8]) -> Glb {
        let number = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four"));
        assert_eq!(&bytes[..4], b"glTF");
        assert_eq!(number(8) as usize, bytes.len(), "the length in the header");
        let json = 20 + number(12) as usize;
        Glb {
            json: serde_json::from_slice(&bytes[20..json]).expect("is JSON"),
            bin: bytes[json + 8..].to_vec(),
        }
    }

    pub(super) fn view(&self, number: &Value) -> &[u8] {
        let view = &self.json["bufferViews"][number.as_u64().expect("a view") as usize];
        let of = |name: &str| view[name].as_u64().unwrap_or(0) as usize;
        assert!(
            of("byteOffset").is_multiple_of(8),
            "tables want multiples of 8"
        );
        &self.bin[of("byteOffset")..of("byteOffset") + of("byteLength")]
    }

    pub(super) fn floats(&self, accessor: &Value) -> Vec<f32> {
        let accessor = &self.json["accessors"][accessor.as_u64().expect("an accessor") as usize];
        let bytes = self.view(&accessor["bufferView"]);
        let four = |b: &[u8]| f32::from_le_bytes(b.try_into().expect("four"));
        bytes.chunks_exact(4).map(four).collect()
    }

    /// The vertices in the frame of the tileset, z up, with their feature.
    pub(super) fn vertices(&self) -> Vec<(DVec3, usize)> {
        let first = &self.json["meshes"][0]["primitives"][0]["attributes"];
        let at = self.json["nodes"][0]["translation"]
            .as_array()
            .expect("is moved");
        let at: Vec<f64> = at.iter().filter_map(Value::as_f64).collect();
        let points = self.floats(&first["POSITION"]);
        let features = self.floats(&first["_FEATURE_ID_0"]);
        assert_eq!(points.len(), 3 * features.len());
        let of = |(p, id): (&[f32], f32)| {
            let [x, y, z] = [0, 1, 2].map(|k| f64::from(p[k]) + at[k]);
            (dvec3(x, -z, y), id as usize)
        };
        points.chunks_exact(3).zip(features).map(of).collect()
    }

    /// A column of texts of its table.
    pub(super) fn texts(&self, name: &str) -> Vec<String> {
        let table = &self.json["extensions"]["EXT_structural_metadata"]["propertyTables"][0];
        let column = &table["properties"][name];
        let values = self.view(&column["values"]);
        let offsets = self.view(&column["stringOffsets"]).chunks_exact(4);
        let offsets: Vec<usize> = offsets
            .map(|b| u32::from_le_bytes(b.try_into().expect("four")) as usize)
            .collect();
        assert_eq!(
            offsets.len() as u64,
            table["count"].as_u64().expect("a count") + 1
        );
        let text = |w: &[usize]| String::from_utf8(values[w[0]..w[1]].to_vec()).expect("is UTF-8");
        offsets.windows(2).map(text).collect()
    }

    pub(super) fn lines(&self) -> Vec<u32> {
        let table = &self.json["extensions"]["EXT_structural_metadata"]["propertyTables"][0];
        let bytes = self
            .view(&table["properties"]["line"]["values"])
            .chunks_exact(4);
        bytes
            .map(|b| u32::from_le_bytes(b.try_into().expect("four")))
            .collect()
    }
}

/// What a walk over a tileset finds: the keys of features by depth of contents.
#[derive(Default)]
pub(crate) struct Found {
    pub(crate) keys: BTreeMap<usize, Vec<String>>,
    uris: BTreeSet<String>,
}

/// Checks a tile and those below it against the rules of 3D Tiles.
fn check(tile: &Value, above: Option<&Value>, level: usize, built: &Built, found: &mut Found) {
    let volume = |t: &Value| -> Vec<f64> {
        let list = t["boundingVolume"]["box"].as_array().expect("a box");
        list.iter().filter_map(Value::as_f64).collect()
    };
    let own = volume(tile);
    assert_eq!(own.len(), 12);
    let corners = |b: &[f64]| {
        let (m, h) = (dvec3(b[0], b[1], b[2]), dvec3(b[3], b[7], b[11]));
        (m - h - 1e-6, m + h + 1e-6)
    };
    let (low, high) = corners(&own);
    let error = tile["geometricError"].as_f64().expect("an error");
    if let Some(above) = above {
        let (from, to) = corners(&volume(above));
        assert!(from.cmple(low + 2e-6).all() && (high - 2e-6).cmple(to).all());
        assert!(error <= above["geometricError"].as_f64().expect("an error"));
    }
    let mut next = level;
    if let Some(uri) = tile["content"]["uri"].as_str() {
        assert!(found.uris.insert(uri.to_owned()), "{uri} is named once");
        if let Some(branch) = built.branches.get(uri) {
            assert!(tile["children"].is_null(), "a file of boxes is a leaf");
            root_of(branch);
            return check(&branch["root"], Some(tile), level, built, found);
        }
        next += 1;
        let glb = Glb::new(
            built
                .files
                .get(uri)
                .unwrap_or_else(|| panic!("{uri} is there")),
        );
        let vertices = glb.vertices();
        let keys = glb.texts("key");
        let shown: BTreeSet<usize> = vertices.iter().map(|(_, id)| *id).collect();
        assert_eq!(
            shown,
            (0..keys.len()).collect(),
            "every feature shows something"
        );
        for (p, _) in &vertices {
            assert!(low.cmple(*p).all() && p.cmple(high).all(), "{p} in {uri}");
        }
        for image in glb.json["images"].as_array().into_iter().flatten() {
            let image = image["uri"]
                .as_str()
                .expect("images stand beside the tiles");
            let name = image
                .strip_prefix("../")
                .expect("above the folder of tiles");
            assert!(built.files.contains_key(name), "{name} is there");
        }
        found.keys.entry(level).or_default().extend(keys);
    }
    let below = tile["children"].as_array().into_iter().flatten();
    for child in below {
        if tile["content"].is_object() {
            assert!(
                child["geometricError"].as_f64() < Some(error),
                "errors shrink"
            );
        }
        check(child, Some(tile), next, built, found);
    }
}

/// Checks what a file says of its tree as a whole.
fn root_of(tileset: &Value) {
    assert_eq!(tileset["asset"]["version"], "1.1");
    assert_eq!(tileset["root"]["refine"], "REPLACE");
    let whole = tileset["geometricError"].as_f64();
    assert!(whole >= tileset["root"]["geometricError"].as_f64());
}

pub(crate) fn checked(built: &Built) -> Found {
    let mut found = Found::default();
    root_of(&built.tileset);
    check(&built.tileset["root"], None, 0, built, &mut found);
    for keys in found.keys.values_mut() {
        keys.sort();
    }
    let contents = built.files.keys().filter(|name| name.ends_with(".glb"));
    let named = contents.count() + built.branches.len();
    assert_eq!(named, found.uris.len(), "no tile is forgotten");
    found
}
