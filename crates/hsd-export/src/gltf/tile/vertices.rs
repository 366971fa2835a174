//! The arrays of all vertices of a tile, in the bytes that the file has: a town has gigabytes of them, so each is written
//! once, while houses are added.

use super::{Pose, Spare, byte};
use crate::gltf::arrays::turned;
use crate::gltf::shading::unit;
use glam::{DVec3, Vec3};
use hsd_scene::Detail;
use std::ops::Range;

/// The arrays of all vertices; numbers have the low byte first. The frame is that of the file, y up.
pub(super) struct Vertices {
    /// True if they will be packed: positions are rounded, and directions are floats.
    packed: bool,
    /// The number of vertices.
    pub(super) count: usize,
    /// Three floats each.
    pub(super) positions: Vec<u8>,
    /// Four signed bytes each, the last of which is 0; three floats if they will be packed.
    pub(super) normals: Vec<u8>,
    /// Four signed bytes each, where materials have relief; four floats if they will be packed.
    pub(super) tangents: Vec<u8>,
    /// Two floats each.
    pub(super) uvs: Vec<u8>,
    /// A float each: the number of the feature.
    pub(super) features: Vec<u8>,
    /// The least and greatest coordinates, z up.
    pub(super) bounds: [Vec3; 2],
}

impl Vertices {
    /// Creates arrays without vertices.
    pub(super) fn new(packed: bool) -> Vertices {
        Vertices {
            packed,
            count: 0,
            positions: vec![],
            normals: vec![],
            tangents: vec![],
            uvs: vec![],
            features: vec![],
            bounds: [Vec3::MAX, Vec3::MIN],
        }
    }

    /// The same in the memory of spare arrays, in the order in which a file of this detail has them.
    pub(super) fn over(spare: &mut Spare, detail: Detail, packed: bool) -> Vertices {
        let positions = spare.array();
        let mut directions = |least: Detail| match detail >= least {
            true => spare.array(),
            false => vec![],
        };
        Vertices {
            positions,
            normals: directions(Detail::Flat),
            tangents: directions(Detail::Openings),
            uvs: spare.array(),
            features: spare.array(),
            ..Vertices::new(packed)
        }
    }

    /// Adds vertices of a feature at points round the middle of the tile; returns the number of the first.
    pub(super) fn add(
        &mut self,
        points: &[[f32; 3]],
        (pose, centre): (Pose, DVec3),
        feature: u32,
    ) -> u32 {
        let first = self.count as u32;
        let [mut low, mut high] = self.bounds;
        let new = more::<12>(&mut self.positions, points.len());
        for (room, point) in new.iter_mut().zip(points) {
            let local = rounded((pose.point(*point) - centre).as_vec3(), self.packed);
            (low, high) = (low.min(local), high.max(local));
            *room = three(turned(local.to_array()));
        }
        self.bounds = [low, high];
        more(&mut self.features, points.len()).fill((feature as f32).to_le_bytes());
        self.count += points.len();
        first
    }

    /// Adds the normals of the vertices that were added last.
    pub(super) fn normals(&mut self, normals: &[[f32; 3]], pose: Pose) {
        let of = |normal: &[f32; 3]| turned(unit(pose.normal(*normal)));
        match self.packed {
            true => fill(&mut self.normals, normals, |n| three(of(n))),
            false => fill(&mut self.normals, normals, |n| {
                let [x, y, z] = of(n);
                [byte(x), byte(y), byte(z), 0]
            }),
        }
    }

    /// Adds their tangents.
    pub(super) fn tangents(&mut self, tangents: &[[f32; 4]], pose: Pose) {
        let of = |[x, y, z, w]: [f32; 4]| {
            let [x, y, z] = turned(pose.normal([x, y, z]));
            [x, y, z, w]
        };
        match self.packed {
            true => fill(&mut self.tangents, tangents, |t| four(of(*t))),
            false => fill(&mut self.tangents, tangents, |t| {
                let [x, y, z, w] = of(*t);
                [byte(x), byte(y), byte(z), byte(w)]
            }),
        }
    }

    /// Adds their texture coordinates, as a function of these.
    pub(super) fn uvs(&mut self, uvs: &[[f32; 2]], of: impl Fn([f32; 2]) -> [f32; 2]) {
        fill(&mut self.uvs, uvs, |uv| two(of(*uv)));
    }

    /// Changes the vertical texture coordinates of some vertices.
    pub(super) fn change_v(&mut self, vertices: Range<usize>, of: impl Fn(f32) -> f32) {
        let (uvs, _) = self.uvs.as_chunks_mut::<8>();
        for [_, _, _, _, v @ ..] in &mut uvs[vertices] {
            *v = of(f32::from_le_bytes(*v)).to_le_bytes();
        }
    }
}

/// Appends indices, which count from the first vertex of a primitive.
pub(super) fn add_indices(list: &mut Vec<u8>, indices: &[u32], first: u32) {
    fill(list, indices, |i| (first + i).to_le_bytes());
}

/// Returns indices of so few vertices that 16 bits are enough.
pub(super) fn shortened(indices: &[u8]) -> Vec<u8> {
    let (all, _) = indices.as_chunks::<4>();
    all.iter()
        .flat_map(|[low, high, ..]| [*low, *high])
        .collect()
}

/// Steps of coordinates in a packed metre.
const STEPS: f32 = 4096.0;

/// Rounds a vertex as it will be in the file.
#[inline]
fn rounded(local: Vec3, packed: bool) -> Vec3 {
    match packed {
        true => (local * STEPS).round() / STEPS,
        false => local,
    }
}

// Millions of these a second: written out, since `map` of arrays is not put in line everywhere.

/// Returns the bits of a float, the low byte first.
#[inline]
fn bits(x: f32) -> u32 {
    x.to_bits().to_le()
}

#[inline]
fn two([x, y]: [f32; 2]) -> [u8; 8] {
    bytemuck::cast([bits(x), bits(y)])
}

#[inline]
fn three([x, y, z]: [f32; 3]) -> [u8; 12] {
    bytemuck::cast([bits(x), bits(y), bits(z)])
}

#[inline]
fn four([x, y, z, w]: [f32; 4]) -> [u8; 16] {
    bytemuck::cast([bits(x), bits(y), bits(z), bits(w)])
}

/// Appends the bytes of each element of a list.
fn fill<T, const N: usize>(out: &mut Vec<u8>, list: &[T], bytes: impl Fn(&T) -> [u8; N]) {
    for (room, element) in more(out, list.len()).iter_mut().zip(list) {
        *room = bytes(element);
    }
}

/// Makes room for more elements in a list that grows with the houses of a tile, and returns it. For four times as many as it
/// has, since room that is not written to takes no memory, and to move a list does.
fn more<const N: usize>(list: &mut Vec<u8>, count: usize) -> &mut [[u8; N]] {
    let (start, more) = (list.len(), N * count);
    if list.capacity() - start < more {
        list.reserve(more.max(3 * start));
    }
    list.resize(start + more, 0);
    list[start..].as_chunks_mut().0
}
