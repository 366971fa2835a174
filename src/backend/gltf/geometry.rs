//! Meshes: which are shown, their accessors, and their bytes. The bytes are written straight into the file.

use super::document::{Accessor, Attributes, BufferView, Mesh, Primitive};
use super::materials::{Look, Looks};
use super::tangents::tangents;
use crate::backend::sound;
use crate::scene::{self, Scene};

const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;

/// What nodes show, by the scene's numbers: other meshes and materials would only make the file larger.
pub(super) struct Shown<'a> {
    /// Primitives of each mesh; empty where none is shown.
    pub(super) primitives: Vec<Vec<&'a scene::Primitive>>,
    /// Whether a material is on one of them.
    pub(super) materials: Vec<bool>,
}

impl<'a> Shown<'a> {
    pub(super) fn new(scene: &'a Scene) -> Shown<'a> {
        let mut used = vec![false; scene.meshes.len()];
        for mesh in scene.nodes.iter().filter_map(|n| n.mesh) {
            if let Some(u) = used.get_mut(mesh.0 as usize) {
                *u = true;
            }
        }
        let mut materials = vec![false; scene.materials.len()];
        let list = |(mesh, used): (&'a scene::Mesh, bool)| -> Vec<_> {
            let sound = mesh
                .primitives
                .iter()
                .filter(|p| used && sound::primitive(p, scene));
            sound
                .inspect(|p| materials[p.material.0 as usize] = true)
                .collect()
        };
        let primitives = scene.meshes.iter().zip(used).map(list).collect();
        Shown {
            primitives,
            materials,
        }
    }
}

/// A primitive to be written.
struct Piece<'a> {
    source: &'a scene::Primitive,
    look: Look,
}

/// What the buffer holds, in this order.
const POSITIONS: usize = 0;
const NORMALS: usize = 1;
const TANGENTS: usize = 2;
const UVS: usize = 3;
const INDICES: usize = 4;

/// All meshes.
pub(super) struct Geometry<'a> {
    pub(super) meshes: Vec<Mesh<'a>>,
    pub(super) accessors: Vec<Accessor>,
    /// The glTF number of each mesh of the scene.
    pub(super) numbers: Vec<Option<u32>>,
    pieces: Vec<Piece<'a>>,
    /// Bytes of each kind.
    lengths: [usize; 5],
}

impl<'a> Geometry<'a> {
    pub(super) fn new(scene: &'a Scene, shown: &Shown<'a>, looks: &Looks<'a>) -> Geometry<'a> {
        let mut geometry = Geometry {
            meshes: vec![],
            accessors: vec![],
            numbers: vec![None; scene.meshes.len()],
            pieces: vec![],
            lengths: [0; 5],
        };
        for (i, list) in shown
            .primitives
            .iter()
            .enumerate()
            .filter(|(_, l)| !l.is_empty())
        {
            geometry.numbers[i] = Some(geometry.meshes.len() as u32);
            let add = |p: &&'a scene::Primitive| geometry.add(p, looks.look(p.material));
            let primitives = list.iter().map(add).collect();
            geometry.meshes.push(Mesh {
                name: &scene.meshes[i].name,
                primitives,
            });
        }
        // Empty views are not written, so the later ones move up.
        let empty = geometry.lengths.map(|l| l == 0);
        for accessor in &mut geometry.accessors {
            let before = &empty[..accessor.buffer_view as usize];
            accessor.buffer_view -= before.iter().filter(|e| **e).count() as u32;
        }
        geometry
    }

    fn add(&mut self, p: &'a scene::Primitive, look: Look) -> Primitive {
        let count = p.positions.len();
        let position = self.accessor(POSITIONS, FLOAT, "VEC3", count, 12 * count);
        let (min, max) = bounds(&p.positions);
        let bounded = &mut self.accessors[position as usize];
        (bounded.min, bounded.max) = (Some(min), Some(max));
        let normal = self.accessor(NORMALS, FLOAT, "VEC3", count, 12 * count);
        let relief = look.relief;
        let tangent = relief.then(|| self.accessor(TANGENTS, FLOAT, "VEC4", count, 16 * count));
        let shows = look.metres.is_some();
        let uv = shows.then(|| self.accessor(UVS, FLOAT, "VEC2", count, 8 * count));
        let number = p.indices.len();
        let indices = if short(count) {
            self.accessor(INDICES, UNSIGNED_SHORT, "SCALAR", number, 2 * number)
        } else {
            self.accessor(INDICES, UNSIGNED_INT, "SCALAR", number, 4 * number)
        };
        self.pieces.push(Piece { source: p, look });
        Primitive {
            attributes: Attributes {
                position,
                normal,
                tangent,
                uv,
            },
            indices,
            material: look.number,
        }
    }

    fn accessor(
        &mut self,
        view: usize,
        component_type: u32,
        kind: &'static str,
        count: usize,
        bytes: usize,
    ) -> u32 {
        self.accessors.push(Accessor {
            buffer_view: view as u32,
            byte_offset: self.lengths[view],
            component_type,
            count,
            kind,
            min: None,
            max: None,
        });
        self.lengths[view] += bytes.next_multiple_of(4);
        self.accessors.len() as u32 - 1
    }

    /// The views of what [`Geometry::write`] writes, and its length.
    pub(super) fn views(&self) -> (Vec<BufferView>, usize) {
        let (mut views, mut at) = (vec![], 0);
        for (kind, &length) in self.lengths.iter().enumerate().filter(|(_, l)| **l > 0) {
            views.push(match kind {
                POSITIONS | NORMALS => BufferView::vertices(at, length, 12),
                TANGENTS => BufferView::vertices(at, length, 16),
                UVS => BufferView::vertices(at, length, 8),
                _ => BufferView::indices(at, length),
            });
            at += length;
        }
        (views, at)
    }

    /// Appends positions, normals, tangents, texture coordinates and indices.
    pub(super) fn write(&self, out: &mut Vec<u8>) {
        for piece in &self.pieces {
            write_floats(out, &piece.source.positions, turned);
        }
        for piece in &self.pieces {
            write_floats(out, &piece.source.normals, |n| turned(unit(n)));
        }
        for piece in self.pieces.iter().filter(|p| p.look.relief) {
            let tangents = tangents(piece.source);
            write_floats(out, &tangents, |[x, y, z, w]| {
                let [x, y, z] = turned([x, y, z]);
                [x, y, z, w]
            });
        }
        for piece in &self.pieces {
            if let Some(metres) = piece.look.metres {
                // v of glTF runs downwards.
                let uv = |[u, v]: [f32; 2]| [u / metres, 1.0 - v / metres];
                write_floats(out, &piece.source.uvs, uv);
            }
        }
        for piece in &self.pieces {
            write_indices(out, &piece.source.indices, piece.source.positions.len());
        }
    }
}

/// Whether so many vertices are numbered in 16 bits; 65,535 itself is no index, it restarts strips.
fn short(vertices: usize) -> bool {
    vertices <= 65_535
}

/// From z up to y up; adding 0 turns -0 into 0.
fn turned([x, y, z]: [f32; 3]) -> [f32; 3] {
    [x + 0.0, z + 0.0, 0.0 - y]
}

/// Normals of other length are errors to a validator.
pub(super) fn unit(n: [f32; 3]) -> [f32; 3] {
    let squared = n.iter().map(|x| x * x).sum::<f32>();
    if (0.9999..1.0001).contains(&squared) {
        n
    } else if squared > 1e-12 && squared.is_finite() {
        n.map(|x| x / squared.sqrt())
    } else {
        [0.0, 0.0, 1.0]
    }
}

/// The least and the greatest coordinates, y up.
fn bounds(positions: &[[f32; 3]]) -> ([f32; 3], [f32; 3]) {
    let (mut min, mut max) = ([f32::MAX; 3], [f32::MIN; 3]);
    for p in positions {
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

fn write_floats<const N: usize>(
    out: &mut Vec<u8>,
    list: &[[f32; N]],
    map: impl Fn([f32; N]) -> [f32; N],
) {
    let start = out.len();
    out.resize(start + 4 * N * list.len(), 0);
    for (room, value) in out[start..].chunks_exact_mut(4 * N).zip(list) {
        for (four, x) in room.chunks_exact_mut(4).zip(map(*value)) {
            four.copy_from_slice(&x.to_le_bytes());
        }
    }
}

fn write_indices(out: &mut Vec<u8>, indices: &[u32], vertices: usize) {
    let start = out.len();
    if short(vertices) {
        out.resize(start + (2 * indices.len()).next_multiple_of(4), 0);
        for (two, i) in out[start..].chunks_exact_mut(2).zip(indices) {
            two.copy_from_slice(&(*i as u16).to_le_bytes());
        }
    } else {
        out.extend(indices.iter().flat_map(|i| i.to_le_bytes()));
    }
}
