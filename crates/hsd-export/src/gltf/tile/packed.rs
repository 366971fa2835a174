//! The arrays of a tile, packed: positions to an eighth of a millimetre, normals and tangents to 12 bits.

use super::vertices::Vertices;
use super::{TANGENT, turned_bounds};
use crate::gltf::compress::streams::Stream;
use crate::gltf::compress::{METRES, REPEATS};
use crate::gltf::json_file::{File, accessor};
use crate::pieces::Pieces;
use serde_json::{Map, Value, json};

/// Numbers of features are whole.
const WHOLE: i32 = 0;

/// Writes the arrays of all vertices; returns the attributes of every primitive.
pub(super) fn attributes(tile: &Vertices, file: &mut File, bin: &mut Pieces) -> Value {
    let count = tile.count;
    let mut attributes = Map::new();
    let mut arrays = |file: &mut File, bytes: &[u8], elements: usize, step: i32| {
        let mut stream = Stream::floats(elements);
        stream.push_floats(&floats(bytes), step);
        file.packed_view(bin, &stream, true)
    };
    let view = arrays(file, &tile.positions, 3, METRES);
    let [low, high] = turned_bounds(tile.bounds);
    let mut points = accessor(view, 5126, count, "VEC3");
    points["min"] = json!(low.map(f64::from));
    points["max"] = json!(high.map(f64::from));
    attributes.insert("POSITION".into(), file.accessor(points).into());
    let view = arrays(file, &tile.uvs, 2, REPEATS);
    let uvs = file.accessor(accessor(view, 5126, count, "VEC2"));
    attributes.insert("TEXCOORD_0".into(), uvs.into());
    let view = arrays(file, &tile.features, 1, WHOLE);
    let ids = file.accessor(accessor(view, 5126, count, "SCALAR"));
    attributes.insert("_FEATURE_ID_0".into(), ids.into());
    let mut directions = |name: &str, values: &[u8], elements: usize, kind: &str| {
        if values.is_empty() {
            return;
        }
        let mut stream = Stream::directions();
        stream.push_directions(&floats(values), elements);
        let mut made = accessor(file.packed_view(bin, &stream, true), 5122, count, kind);
        made["normalized"] = json!(true);
        attributes.insert(name.into(), file.accessor(made).into());
    };
    directions("NORMAL", &tile.normals, 3, "VEC3");
    directions(TANGENT, &tile.tangents, 4, "VEC4");
    Value::Object(attributes)
}

/// Writes the indices of a material; returns their view.
pub(super) fn indices(batch: &[u8], short: bool, file: &mut File, bin: &mut Pieces) -> usize {
    let (numbers, _) = batch.as_chunks::<4>();
    let numbers: Vec<u32> = numbers.iter().map(|n| u32::from_le_bytes(*n)).collect();
    let mut stream = Stream::indices(if short { 2 } else { 4 });
    stream.push_indices(&numbers);
    file.packed_view(bin, &stream, false)
}

/// Returns the floats that some bytes are.
fn floats(bytes: &[u8]) -> Vec<f32> {
    let (floats, _) = bytes.as_chunks::<4>();
    floats.iter().map(|f| f32::from_le_bytes(*f)).collect()
}
