//! The arrays of a tile, packed: positions to an eighth of a millimetre, normals and tangents to 12 bits.

use super::{TANGENT, TileWriter};
use crate::backend::gltf::arrays::{bounds, turned};
use crate::backend::gltf::compress::streams::Stream;
use crate::backend::gltf::compress::{METRES, REPEATS};
use crate::backend::gltf::json_file::{File, accessor};
use crate::backend::gltf::shading::unit;
use serde_json::{Map, Value, json};

/// Numbers of features are whole.
const WHOLE: i32 = 0;

/// Writes the arrays of all vertices; returns the attributes of every primitive.
pub(super) fn attributes(tile: &TileWriter, file: &mut File, bin: &mut Vec<u8>) -> Value {
    let count = tile.positions.len();
    let mut attributes = Map::new();
    let mut floats = |file: &mut File, values: &[f32], elements: usize, step: i32| {
        let mut stream = Stream::floats(elements);
        stream.push_floats(values, step);
        file.packed_view(bin, &stream, true)
    };
    let flat: Vec<f32> = tile.positions.iter().flat_map(|p| turned(*p)).collect();
    let view = floats(file, &flat, 3, METRES);
    let (low, high) = bounds([&*tile.positions]);
    let mut points = accessor(view, 5126, count, "VEC3");
    points["min"] = json!(low.map(f64::from));
    points["max"] = json!(high.map(f64::from));
    attributes.insert("POSITION".into(), file.accessor(points).into());
    let view = floats(file, tile.uvs.as_flattened(), 2, REPEATS);
    let uvs = file.accessor(accessor(view, 5126, count, "VEC2"));
    attributes.insert("TEXCOORD_0".into(), uvs.into());
    let view = floats(file, &tile.features, 1, WHOLE);
    let ids = file.accessor(accessor(view, 5126, count, "SCALAR"));
    attributes.insert("_FEATURE_ID_0".into(), ids.into());
    let mut directions = |name: &str, values: &[f32], elements: usize, kind: &str| {
        if values.is_empty() {
            return;
        }
        let mut stream = Stream::directions();
        stream.push_directions(values, elements);
        let mut made = accessor(file.packed_view(bin, &stream, true), 5122, count, kind);
        made["normalized"] = json!(true);
        attributes.insert(name.into(), file.accessor(made).into());
    };
    let normals = tile.normals.iter().flat_map(|n| turned(unit(*n)));
    directions("NORMAL", &normals.collect::<Vec<f32>>(), 3, "VEC3");
    let tangents = tile.tangents.iter().flat_map(|[x, y, z, w]| {
        let [x, y, z] = turned([*x, *y, *z]);
        [x, y, z, *w]
    });
    directions(TANGENT, &tangents.collect::<Vec<f32>>(), 4, "VEC4");
    Value::Object(attributes)
}

/// Writes the indices of a material; returns their view.
pub(super) fn indices(batch: &[u32], short: bool, file: &mut File, bin: &mut Vec<u8>) -> usize {
    let mut stream = Stream::indices(if short { 2 } else { 4 });
    stream.push_indices(batch);
    file.packed_view(bin, &stream, false)
}
