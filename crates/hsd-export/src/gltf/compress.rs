//! Compressed models for the web: instances, packed arrays, GPU textures.
//!
//! All nodes that show one mesh become one node with a list of placements (`EXT_mesh_gpu_instancing`); the node tree
//! and its extras are dropped. Arrays are quantised and packed by `EXT_meshopt_compression`: positions and placements
//! to an eighth of a millimetre, normals and tangents to 12 bits (`KHR_mesh_quantization`). Colours and gloss become
//! KTX2 ([`Ktx2`]); normal maps stay JPEG, which is smaller at equal quality.
//!
//! The packed arrays are in buffer 0. Buffer 1 has no bytes; readers unpack into it.

mod geometry;
mod ktx2;
mod places;
pub(super) mod streams;

pub use ktx2::Ktx2;

use super::arrays::Array;
use super::materials::{MaterialRefs, Materials};
use super::{Model, writer};
use crate::Images;
use crate::spool::{List, NewSpool, Section, in_memory};
use geometry::{Geometry, Piece};
use gltf::json::accessor::{ComponentType, GenericComponentType, Type};
use gltf::json::buffer::{Stride, Target, View};
use gltf::json::extensions::buffer;
use gltf::json::validation::Checked::Valid;
use gltf::json::{self, Accessor, Buffer, Index, Root};
use hsd_scene::Scene;
use places::Node;
use serde_json::{Map, Value, json};
use std::io;
use streams::Stream;

const MESHOPT: &str = "EXT_meshopt_compression";
const QUANTIZATION: &str = "KHR_mesh_quantization";
const INSTANCING: &str = "EXT_mesh_gpu_instancing";

/// Coordinates are multiples of 2 to this power, metres: a quarter of a millimetre.
pub(super) const METRES: i32 = -12;

/// Texture coordinates are multiples of 2 to this power: a sixteenth of a pixel of 512.
pub(super) const REPEATS: i32 = -13;

/// Quaternions are multiples of 2 to this power, fine enough for the far end of a long roof.
const QUATERNIONS: i32 = -21;

/// Lays out a whole scene.
pub(super) fn model<'a>(scene: &'a Scene, images: &'a dyn Images) -> Model<'a> {
    packed(scene, images, &in_memory).expect("memory takes every byte")
}

fn packed<'a>(
    scene: &'a Scene,
    images: &'a dyn Images,
    new: NewSpool<'_>,
) -> io::Result<Model<'a>> {
    let (mut root, mut refs) = (writer::root(), MaterialRefs::default());
    root.asset.extras = writer::made_from(&scene.provenance, scene.detail);
    let (mut accessors, mut meshes, mut nodes) =
        (List::new(new)?, List::new(new)?, List::new(new)?);
    let mut section = Section::new("packed arrays", new)?;
    let geometry = Geometry::new(scene, &mut refs, images, &mut meshes)?;
    let materials = Materials::new(&refs, &scene.materials, images, &mut root);
    let packed = Packed::new(scene, &geometry, &mut root);
    for accessor in &packed.accessors {
        accessors.push(accessor)?;
    }
    for node in &packed.nodes {
        nodes.push(node)?;
    }
    section.append(|out| {
        out.extend(&packed.bytes);
        Ok(())
    })?;
    Ok(Model {
        root,
        accessors,
        meshes,
        nodes,
        length: section.length(),
        sections: vec![section],
        materials,
        embedded: false,
        unpacked: packed.unpacked,
    })
}

/// Packed shapes and placements.
#[derive(Default)]
struct Packed<'a> {
    /// Accessors of the pieces by their numbers, then those of placements.
    accessors: Vec<Accessor>,
    nodes: Vec<Node<'a>>,
    /// The packed arrays.
    bytes: Vec<u8>,
    /// Size of the unpacked arrays, bytes.
    unpacked: usize,
}

impl<'a> Packed<'a> {
    /// Packs everything, and adds views, the scene and the names of extensions.
    fn new(scene: &'a Scene, geometry: &Geometry<'_>, root: &mut Root) -> Packed<'a> {
        let mut packed = Packed::default();
        packed.add_shapes(&geometry.pieces, root);
        let instanced = packed.add_places(scene, geometry, root);
        if packed.unpacked > 0 {
            require(root, MESHOPT);
            require(root, QUANTIZATION);
        }
        if instanced {
            require(root, INSTANCING);
        }
        if !packed.nodes.is_empty() {
            root.scene = Some(root.push(json::Scene {
                nodes: (0..packed.nodes.len() as u32).map(Index::new).collect(),
                name: None,
                extensions: None,
                extras: None,
            }));
        }
        packed
    }

    /// Adds the arrays of all pieces: one view per kind, with 16-bit and 32-bit indices separate.
    fn add_shapes(&mut self, pieces: &[Piece<'_>], root: &mut Root) {
        let count = pieces.iter().map(|p| p.arrays().count()).sum();
        self.accessors = vec![accessor(ComponentType::F32, Type::Scalar); count];
        for array in Array::ALL {
            for component in [ComponentType::F32, ComponentType::U16, ComponentType::U32] {
                let mut stream = empty(array, component);
                let mut written = vec![];
                for piece in pieces {
                    let found = piece.arrays().position(|a| a == array);
                    let fits = array.component(piece.source) == component;
                    if let Some(place) = found.filter(|_| fits) {
                        let number = piece.first as usize + place;
                        self.accessors[number] = append(array, piece, &mut stream);
                        written.push(number);
                    }
                }
                let target = match array {
                    Array::Indices => Target::ElementArrayBuffer,
                    _ => Target::ArrayBuffer,
                };
                let view = self.add_view(&stream, Some(target), root);
                for number in written {
                    self.accessors[number].buffer_view = view;
                }
            }
        }
    }

    /// Adds the nodes; returns true if any has several placements.
    fn add_places(&mut self, scene: &'a Scene, geometry: &Geometry<'_>, root: &mut Root) -> bool {
        let (mut places, mut turns) = (Stream::floats(3), Stream::floats(4));
        let start = self.accessors.len();
        for group in places::groups(scene, geometry) {
            let mut attributes = Map::new();
            if group.places.len() > 1 {
                let at = group.offsets();
                let mut list = |name: &str, stream: &mut Stream, values: &[f32], step, type_| {
                    let offset = stream.length();
                    stream.push_floats(values, step);
                    attributes.insert(name.into(), self.accessors.len().into());
                    self.accessors.push(Accessor {
                        byte_offset: Some(offset.into()),
                        count: group.places.len().into(),
                        ..accessor(ComponentType::F32, type_)
                    });
                };
                list("TRANSLATION", &mut places, &at, METRES, Type::Vec3);
                if let Some(quaternions) = group.quaternions() {
                    list(
                        "ROTATION",
                        &mut turns,
                        &quaternions,
                        QUATERNIONS,
                        Type::Vec4,
                    );
                }
            }
            let listed = (!attributes.is_empty()).then(|| json!({ "attributes": attributes }));
            self.nodes
                .push(group.node(scene, listed.map(|l| named(INSTANCING, l))));
        }
        let places = self.add_view(&places, None, root);
        let turns = self.add_view(&turns, None, root);
        for accessor in &mut self.accessors[start..] {
            accessor.buffer_view = match accessor.type_ {
                Valid(Type::Vec3) => places,
                _ => turns,
            };
        }
        places.is_some()
    }

    /// Packs the content of a view.
    fn add_view(
        &mut self,
        stream: &Stream,
        target: Option<Target>,
        root: &mut Root,
    ) -> Option<Index<View>> {
        let bytes = stream.packed();
        if bytes.is_empty() {
            return None;
        }
        let extension = stream.extension(self.bytes.len(), bytes.len());
        let vertices = target == Some(Target::ArrayBuffer);
        let view = root.push(View {
            buffer: Index::new(1),
            byte_length: stream.length().into(),
            byte_offset: Some(self.unpacked.into()),
            byte_stride: vertices.then(|| Stride(stream.stride())),
            name: None,
            target: target.map(Valid),
            extensions: Some(buffer::View {
                others: named(MESHOPT, extension),
            }),
            extras: None,
        });
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.unpacked += stream.length().next_multiple_of(4);
        Some(view)
    }
}

/// Adds a buffer of this length without bytes.
pub(super) fn add_fallback(length: usize, root: &mut Root) {
    if length > 0 {
        root.push(Buffer {
            byte_length: length.into(),
            uri: None,
            name: None,
            extensions: Some(buffer::Buffer {
                others: named(MESHOPT, json!({ "fallback": true })),
            }),
            extras: None,
        });
    }
}

/// Adds an extension to those that readers must support.
fn require(root: &mut Root, extension: &str) {
    root.extensions_used.push(extension.into());
    root.extensions_required.push(extension.into());
}

/// Wraps an extension under its name.
fn named(extension: &str, content: Value) -> Map<String, Value> {
    Map::from_iter([(extension.to_owned(), content)])
}

/// Returns an empty stream for arrays of a kind.
fn empty(array: Array, component: ComponentType) -> Stream {
    match array {
        Array::Normals | Array::Tangents => Stream::directions(),
        Array::Indices => Stream::indices(component.size()),
        // Houses that share a mesh are not compressed: `Array::ALL` is without their numbers.
        Array::Positions | Array::Uvs | Array::MirrorUvs | Array::Houses => {
            Stream::floats(array.elements().multiplicity())
        }
    }
}

/// Appends the array of a piece to its stream, and returns its accessor without a view.
fn append(array: Array, piece: &Piece<'_>, stream: &mut Stream) -> Accessor {
    let source = piece.source;
    let mut made = Accessor {
        byte_offset: Some(stream.length().into()),
        count: array.count(source).into(),
        ..accessor(array.component(source), array.elements())
    };
    if array == Array::Indices {
        stream.push_indices(&source.indices);
        return made;
    }
    let mut bytes = vec![];
    array.write(source, piece.material, &mut bytes);
    let (fours, _) = bytes.as_chunks();
    let values: Vec<f32> = fours.iter().map(|four| f32::from_le_bytes(*four)).collect();
    match array {
        Array::Positions => {
            stream.push_floats(&values, METRES);
            let rounded = streams::rounded(&values, METRES);
            let (points, _) = rounded.as_chunks::<3>();
            let edge = |pick: fn(f32, f32) -> f32, start| {
                let all = points.iter().copied();
                let edge = all.fold([start; 3], |e, p| [0, 1, 2].map(|k| pick(e[k], p[k])));
                Some(edge.into())
            };
            made.min = edge(f32::min, f32::MAX);
            made.max = edge(f32::max, f32::MIN);
        }
        Array::Uvs | Array::MirrorUvs => stream.push_floats(&values, REPEATS),
        _ => {
            stream.push_directions(&values, array.elements().multiplicity());
            made.component_type = Valid(GenericComponentType(ComponentType::I16));
            made.normalized = true;
        }
    }
    made
}

/// Returns an empty accessor.
fn accessor(component: ComponentType, type_: Type) -> Accessor {
    Accessor {
        buffer_view: None,
        byte_offset: None,
        count: 0usize.into(),
        component_type: Valid(GenericComponentType(component)),
        type_: Valid(type_),
        min: None,
        max: None,
        name: None,
        normalized: false,
        sparse: None,
        extensions: None,
        extras: None,
    }
}
