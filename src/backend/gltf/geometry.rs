//! Meshes: which are shown, their accessors, and their bytes. Accessors and views go into the root, the bytes into the buffer.

use super::materials::{Look, Looks};
use super::tangents::tangents;
use crate::backend::sound;
use crate::scene::{self, Scene};
use gltf::json::accessor::{ComponentType, GenericComponentType, Type};
use gltf::json::buffer::{Stride, Target, View};
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::validation::Checked::Valid;
use gltf::json::{Accessor, Index, Mesh, Root};
use std::collections::BTreeMap;

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

/// What the buffer holds, in this order; each kind that occurs has one view.
const POSITIONS: usize = 0;
const NORMALS: usize = 1;
const TANGENTS: usize = 2;
const UVS: usize = 3;
const INDICES: usize = 4;

/// All meshes.
pub(super) struct Geometry<'a> {
    /// The glTF number of each mesh of the scene.
    pub(super) numbers: Vec<Option<Index<Mesh>>>,
    pieces: Vec<Piece<'a>>,
    views: [Option<Index<View>>; 5],
}

impl<'a> Geometry<'a> {
    pub(super) fn new(
        scene: &'a Scene,
        shown: &Shown<'a>,
        looks: &Looks<'a>,
        root: &mut Root,
    ) -> Geometry<'a> {
        let mut geometry = Geometry {
            numbers: vec![None; scene.meshes.len()],
            pieces: vec![],
            views: [None; 5],
        };
        let shown = shown.primitives.iter().enumerate();
        for (i, list) in shown.filter(|(_, l)| !l.is_empty()) {
            let name = &scene.meshes[i].name;
            let add = |p: &&'a scene::Primitive| geometry.add(root, p, looks.look(p.material));
            let primitives = list.iter().map(add).collect();
            geometry.numbers[i] = Some(root.push(Mesh {
                name: (!name.is_empty()).then(|| name.clone()),
                primitives,
                weights: None,
                extensions: None,
                extras: None,
            }));
        }
        geometry
    }

    fn add(&mut self, root: &mut Root, p: &'a scene::Primitive, look: Look) -> Primitive {
        let count = p.positions.len();
        let mut add = |view, semantic, kind| {
            let number = self.accessor(root, view, ComponentType::F32, kind, count);
            (Valid(semantic), number)
        };
        let position = add(POSITIONS, Semantic::Positions, Type::Vec3);
        let normal = add(NORMALS, Semantic::Normals, Type::Vec3);
        let first = position.1.value();
        let mut attributes = BTreeMap::from([position, normal]);
        attributes.extend(
            look.relief
                .then(|| add(TANGENTS, Semantic::Tangents, Type::Vec4)),
        );
        attributes.extend(
            look.metres
                .map(|_| add(UVS, Semantic::TexCoords(0), Type::Vec2)),
        );
        let (min, max) = bounds(&p.positions);
        let bounded = &mut root.accessors[first];
        (bounded.min, bounded.max) = (Some(min.into()), Some(max.into()));
        let component = if short(count) {
            ComponentType::U16
        } else {
            ComponentType::U32
        };
        let indices = self.accessor(root, INDICES, component, Type::Scalar, p.indices.len());
        self.pieces.push(Piece { source: p, look });
        Primitive {
            attributes,
            indices: Some(indices),
            material: Some(look.number),
            mode: Valid(Mode::Triangles),
            targets: None,
            extensions: None,
            extras: None,
        }
    }

    /// Lengthens the view by the bytes of the accessor.
    fn accessor(
        &mut self,
        root: &mut Root,
        kind: usize,
        component: ComponentType,
        elements: Type,
        count: usize,
    ) -> Index<Accessor> {
        let size = component.size() * elements.multiplicity();
        let vertices = kind != INDICES;
        let index = *self.views[kind].get_or_insert_with(|| {
            let target = if vertices {
                Target::ArrayBuffer
            } else {
                Target::ElementArrayBuffer
            };
            root.push(View {
                target: Some(Valid(target)),
                // Many accessors share it.
                byte_stride: vertices.then_some(Stride(size)),
                ..view(0, 0)
            })
        });
        let length = &mut root.buffer_views[index.value()].byte_length;
        let byte_offset = Some(*length);
        length.0 += (size * count).next_multiple_of(4) as u64;
        root.push(Accessor {
            buffer_view: Some(index),
            byte_offset,
            count: count.into(),
            component_type: Valid(GenericComponentType(component)),
            type_: Valid(elements),
            min: None,
            max: None,
            name: None,
            normalized: false,
            sparse: None,
            extensions: None,
            extras: None,
        })
    }

    /// Appends positions, normals, tangents, texture coordinates and indices, and tells the views where they are.
    pub(super) fn write(&self, root: &mut Root, out: &mut Vec<u8>) {
        let lengths = root.buffer_views.iter().map(|v| v.byte_length.0 as usize);
        out.reserve(lengths.sum());
        for (kind, view) in self.views.iter().enumerate() {
            if let Some(view) = view {
                root.buffer_views[view.value()].byte_offset = Some(out.len().into());
                let pieces = self.pieces.iter();
                pieces.for_each(|piece| piece.write(kind, out));
            }
        }
    }
}

impl Piece<'_> {
    fn write(&self, kind: usize, out: &mut Vec<u8>) {
        let p = self.source;
        match (kind, self.look.metres) {
            (POSITIONS, _) => write_floats(out, &p.positions, turned),
            (NORMALS, _) => write_floats(out, &p.normals, |n| turned(unit(n))),
            (TANGENTS, _) if self.look.relief => {
                write_floats(out, &tangents(p), |[x, y, z, w]| {
                    let [x, y, z] = turned([x, y, z]);
                    [x, y, z, w]
                });
            }
            // v of glTF runs downwards.
            (UVS, Some(metres)) => {
                write_floats(out, &p.uvs, |[u, v]| [u / metres, 1.0 - v / metres]);
            }
            (INDICES, _) => write_indices(out, &p.indices, p.positions.len()),
            _ => (),
        }
    }
}

/// Of the one buffer.
pub(super) fn view(offset: usize, length: usize) -> View {
    View {
        buffer: Index::new(0),
        byte_length: length.into(),
        byte_offset: Some(offset.into()),
        byte_stride: None,
        name: None,
        target: None,
        extensions: None,
        extras: None,
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
