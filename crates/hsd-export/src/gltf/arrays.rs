//! The arrays of a primitive as bytes, by kind; glTF accesses them through accessors.

use super::shading::{tangents, unit};
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::mesh::Semantic;
use gltf::json::{Index, Material};
use hsd_scene::Primitive;

/// The glTF number of a material, and its properties that affect geometry.
#[derive(Clone, Copy)]
pub(super) struct MaterialRef {
    /// Its glTF number.
    pub(super) number: Index<Material>,
    /// Length of one repeat if it has a texture, metres.
    pub(super) metres: Option<f32>,
    /// True if it has normals, which need tangents.
    pub(super) relief: bool,
    /// True if it shows a reflection, with texture coordinates of its own.
    pub(super) mirrors: bool,
}

/// A kind of array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Array {
    Positions,
    Normals,
    Tangents,
    Uvs,
    MirrorUvs,
    /// The numbers of houses in a common mesh; no primitive of a scene has them.
    Houses,
    Indices,
}

impl Array {
    /// All kinds, in the order of the buffer.
    pub(super) const ALL: [Array; 6] = [
        Array::Positions,
        Array::Normals,
        Array::Tangents,
        Array::Uvs,
        Array::MirrorUvs,
        Array::Indices,
    ];

    /// Returns its name.
    pub(super) fn name(self) -> &'static str {
        match self {
            Array::Positions => "positions",
            Array::Normals => "normals",
            Array::Tangents => "tangents",
            Array::Uvs => "texture coordinates",
            Array::MirrorUvs => "mirror coordinates",
            Array::Houses => "numbers of houses",
            Array::Indices => "indices",
        }
    }

    /// Returns the vertex attribute; `None` for indices.
    pub(super) fn semantic(self) -> Option<Semantic> {
        match self {
            Array::Positions => Some(Semantic::Positions),
            Array::Normals => Some(Semantic::Normals),
            Array::Tangents => Some(Semantic::Tangents),
            Array::Uvs => Some(Semantic::TexCoords(0)),
            Array::MirrorUvs => Some(Semantic::TexCoords(1)),
            Array::Houses => Some(Semantic::Extras("FEATURE_ID_0".to_owned())),
            Array::Indices => None,
        }
    }

    /// Returns the number of components of an element.
    pub(super) fn elements(self) -> Type {
        match self {
            Array::Positions | Array::Normals => Type::Vec3,
            Array::Tangents => Type::Vec4,
            Array::Uvs | Array::MirrorUvs => Type::Vec2,
            Array::Houses | Array::Indices => Type::Scalar,
        }
    }

    /// Returns true for directions, which can be written as bytes (KHR_mesh_quantization).
    pub(super) fn is_direction(self) -> bool {
        matches!(self, Array::Normals | Array::Tangents)
    }

    /// Returns the component type of its elements.
    pub(super) fn component(self, p: &Primitive) -> ComponentType {
        match self {
            Array::Indices => index_type(p.positions.len()),
            _ => ComponentType::F32,
        }
    }

    /// Returns the number of its elements.
    pub(super) fn count(self, p: &Primitive) -> usize {
        match self {
            Array::Indices => p.indices.len(),
            _ => p.positions.len(),
        }
    }

    /// Returns true if a primitive of this material has it.
    pub(super) fn is_in(self, material: MaterialRef) -> bool {
        match self {
            Array::Tangents => material.relief,
            // Coordinates are counted from 0 without a gap.
            Array::Uvs => material.metres.is_some() || material.mirrors,
            Array::MirrorUvs => material.mirrors,
            Array::Houses => false,
            Array::Positions | Array::Normals | Array::Indices => true,
        }
    }

    /// Appends its bytes; each array begins at a multiple of four.
    pub(super) fn write(self, p: &Primitive, material: MaterialRef, out: &mut Vec<u8>) {
        match self {
            Array::Positions => write_floats(out, &p.positions, turned),
            Array::Normals => write_floats(out, &p.normals, |n| turned(unit(n))),
            Array::Tangents => write_floats(out, &tangents(p), |[x, y, z, w]| {
                let [x, y, z] = turned([x, y, z]);
                [x, y, z, w]
            }),
            // v of glTF runs downwards.
            Array::Uvs => {
                let metres = material.metres.unwrap_or(1.0);
                write_floats(out, &p.uvs, |[u, v]| [u / metres, 1.0 - v / metres]);
            }
            Array::MirrorUvs => write_floats(out, &p.mirror_uvs, |[u, v]| [u, 1.0 - v]),
            Array::Houses => {}
            Array::Indices => write_indices(out, &p.indices, (0, p.positions.len())),
        }
    }
}

/// Appends directions as signed bytes in fours: -127 to 127 for -1 to 1, at most 0.4 degrees off. `floats` are their bytes,
/// `size` components each.
pub(super) fn write_packed(out: &mut Vec<u8>, floats: &[u8], size: usize) {
    let (numbers, _) = floats.as_chunks::<4>();
    for direction in numbers.chunks(size) {
        let mut four = [0; 4];
        for (to, from) in four.iter_mut().zip(direction) {
            *to = signed_byte(f32::from_le_bytes(*from)) as u8;
        }
        out.extend(four);
    }
}

/// Returns the type of indices into this number of vertices.
pub(super) fn index_type(vertices: usize) -> ComponentType {
    match short(vertices) {
        true => ComponentType::U16,
        false => ComponentType::U32,
    }
}

/// Returns true if this number of vertices fits 16-bit indices; 65,535 itself is reserved as primitive restart.
fn short(vertices: usize) -> bool {
    vertices <= 65_535
}

/// Converts from z up to y up; adding 0 turns -0 into 0.
#[inline]
pub(super) fn turned([x, y, z]: [f32; 3]) -> [f32; 3] {
    [x + 0.0, z + 0.0, 0.0 - y]
}

/// Returns the least and greatest coordinates, y up.
pub(super) fn bounds<'p>(arrays: impl IntoIterator<Item = &'p [[f32; 3]]>) -> ([f32; 3], [f32; 3]) {
    let (mut min, mut max) = ([f32::MAX; 3], [f32::MIN; 3]);
    for p in arrays.into_iter().flatten() {
        for k in 0..3 {
            min[k] = min[k].min(p[k]);
            max[k] = max[k].max(p[k]);
        }
    }
    // North becomes -z, so its bounds change places.
    let (south, north) = (min[1], max[1]);
    (
        turned([min[0], north, min[2]]),
        turned([max[0], south, max[2]]),
    )
}

pub(super) fn write_floats<const N: usize>(
    out: &mut Vec<u8>,
    list: &[[f32; N]],
    map: impl Fn([f32; N]) -> [f32; N],
) {
    let start = out.len();
    out.resize(start + 4 * N * list.len(), 0);
    for (room, value) in out[start..].chunks_exact_mut(4 * N).zip(list) {
        for (four, number) in room.as_chunks_mut::<4>().0.iter_mut().zip(&map(*value)) {
            *four = number.to_le_bytes();
        }
    }
}

/// Appends the bytes of each element of a list.
pub(super) fn write_each<T: Copy, const N: usize>(
    out: &mut Vec<u8>,
    list: &[T],
    bytes: impl Fn(T) -> [u8; N],
) {
    let start = out.len();
    out.resize(start + N * list.len(), 0);
    for (room, value) in out[start..].as_chunks_mut().0.iter_mut().zip(list) {
        *room = bytes(*value);
    }
}

/// Encodes a number from -1 to 1 in a byte, -127 to 127, halves away from zero. An f64 holds the sum, so that nothing is
/// rounded twice; `round` would be a call of its own on most machines.
#[inline]
pub(super) fn signed_byte(x: f32) -> i8 {
    let scaled = f64::from(x * 127.0);
    (scaled + 0.5f64.copysign(scaled)) as i8
}

/// Appends indices into an array that has `first` vertices of others before them, and `vertices` in all.
pub(super) fn write_indices(out: &mut Vec<u8>, indices: &[u32], (first, vertices): (usize, usize)) {
    let (start, first) = (out.len(), first as u32);
    if short(vertices) {
        out.resize(start + (2 * indices.len()).next_multiple_of(4), 0);
        for (two, i) in out[start..].chunks_exact_mut(2).zip(indices) {
            two.copy_from_slice(&((first + i) as u16).to_le_bytes());
        }
    } else {
        write_each(out, indices, |i| (first + i).to_le_bytes());
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn directions_are_rounded_to_the_nearest_byte() {
        let halves = (-254..=254).map(|n| n as f32 / 254.0);
        let near = halves.flat_map(|x| [x.next_down(), x, x.next_up()]);
        for x in near.chain([0.0, -0.0, 0.49999997 / 127.0, f32::NAN]) {
            assert_eq!(super::signed_byte(x), (x * 127.0).round() as i8, "{x}");
        }
    }
}
