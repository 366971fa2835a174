//! Meshes: lays out the arrays of those that nodes show in the buffer. Accessors, meshes and bytes are
//! produced one by one during writing, since a town has hundreds of thousands.

use super::arrays::{Array, MaterialRef, bounds};
use super::buffer::view;
use super::materials::Materials;
use super::shown::Shown;
use crate::scene::{self, Scene};
use gltf::json::accessor::GenericComponentType;
use gltf::json::buffer::{Stride, Target, View};
use gltf::json::mesh::{Mode, Primitive};
use gltf::json::validation::Checked::Valid;
use gltf::json::{Accessor, Index, Mesh, Root};
use std::io::{self, Write};

/// A primitive to be written.
pub(super) struct Piece<'a> {
    /// The number of its mesh in the scene.
    mesh: usize,
    pub(super) source: &'a scene::Primitive,
    pub(super) material: MaterialRef,
    /// Its first accessor; those of its other arrays follow.
    pub(super) first: u32,
    /// Offsets of its arrays in the view of each kind.
    offsets: [usize; Array::ALL.len()],
}

/// All meshes.
pub(super) struct Geometry<'a> {
    /// The glTF number of each mesh of the scene.
    numbers: Vec<Option<Index<Mesh>>>,
    names: &'a [scene::Mesh],
    pieces: Vec<Piece<'a>>,
    /// One view per kind of array that occurs.
    views: [Option<Index<View>>; Array::ALL.len()],
    /// Size of the view of each kind, bytes.
    lengths: [usize; Array::ALL.len()],
    /// Size of all views, bytes.
    length: usize,
}

impl<'a> Geometry<'a> {
    /// Lays out all arrays.
    pub(super) fn new(
        scene: &'a Scene,
        shown: Shown<'a>,
        materials: &Materials<'a>,
    ) -> Geometry<'a> {
        let mut geometry = Geometry {
            numbers: vec![None; scene.meshes.len()],
            names: &scene.meshes,
            pieces: Vec::with_capacity(shown.primitives.len()),
            views: [None; Array::ALL.len()],
            lengths: [0; Array::ALL.len()],
            length: 0,
        };
        let (mut meshes, mut accessors) = (0, 0);
        for (mesh, source) in shown.primitives {
            geometry.numbers[mesh].get_or_insert_with(|| {
                meshes += 1;
                Index::new(meshes - 1)
            });
            let piece = Piece {
                mesh,
                source,
                material: materials.of(source.material),
                first: accessors,
                offsets: geometry.lengths,
            };
            for array in piece.arrays() {
                geometry.lengths[array as usize] += array.length(source);
                accessors += 1;
            }
            geometry.pieces.push(piece);
        }
        geometry
    }

    /// Adds the views.
    pub(super) fn add_views(&mut self, root: &mut Root) {
        for array in Array::ALL {
            self.add_view(array, root);
        }
    }

    fn add_view(&mut self, array: Array, root: &mut Root) {
        let length = self.lengths[array as usize];
        let Some(first) = self.pieces.first().filter(|_| length > 0) else {
            return;
        };
        let vertices = array != Array::Indices;
        let target = match vertices {
            true => Target::ArrayBuffer,
            false => Target::ElementArrayBuffer,
        };
        self.views[array as usize] = Some(root.push(View {
            target: Some(Valid(target)),
            // Many accessors share it.
            byte_stride: vertices.then(|| Stride(array.stride(first.source))),
            ..view(self.length, length)
        }));
        self.length += length;
    }

    /// Returns true if there is nothing to show.
    pub(super) fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }

    /// Returns all primitives, in the order of their accessors.
    #[cfg(feature = "compress")]
    pub(super) fn pieces(&self) -> &[Piece<'a>] {
        &self.pieces
    }

    /// Returns the size of all views, bytes.
    pub(super) fn length(&self) -> usize {
        self.length
    }

    /// Returns the glTF number of a node's mesh.
    pub(super) fn mesh(&self, node: &scene::Node) -> Option<Index<Mesh>> {
        let mesh = node.mesh?.0 as usize;
        self.numbers.get(mesh).copied().flatten()
    }

    /// Returns the meshes in the order of their numbers.
    pub(super) fn meshes(&self) -> impl Iterator<Item = Mesh> {
        let meshes = self.pieces.chunk_by(|a, b| a.mesh == b.mesh);
        meshes.map(|pieces| {
            let name = &self.names[pieces[0].mesh].name;
            Mesh {
                name: (!name.is_empty()).then(|| name.clone()),
                primitives: pieces.iter().map(Piece::primitive).collect(),
                weights: None,
                extensions: None,
                extras: None,
            }
        })
    }

    /// Returns the accessors in the order of their numbers.
    pub(super) fn accessors(&self) -> impl Iterator<Item = Accessor> {
        let accessor = |(piece, array): (&Piece<'_>, Array)| Accessor {
            buffer_view: self.views[array as usize],
            ..piece.accessor(array)
        };
        let arrays = |p| Piece::arrays(p).map(move |a| (p, a));
        self.pieces.iter().flat_map(arrays).map(accessor)
    }

    /// Writes the arrays, kind by kind.
    pub(super) fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let mut bytes = vec![];
        for array in Array::ALL {
            for piece in self.pieces.iter().filter(|p| array.is_in(p.material)) {
                bytes.clear();
                array.write(piece.source, piece.material, &mut bytes);
                out.write_all(&bytes)?;
            }
        }
        Ok(())
    }
}

impl Piece<'_> {
    /// Returns the arrays of a primitive in the order of their accessors.
    pub(super) fn arrays(&self) -> impl Iterator<Item = Array> + use<> {
        let material = self.material;
        Array::ALL.into_iter().filter(move |a| a.is_in(material))
    }

    fn primitive(&self) -> Primitive {
        let numbers = (self.first..).map(Index::new);
        let mut indices = None;
        let mut attribute = |(array, number): (Array, _)| {
            let semantic = array.semantic();
            if semantic.is_none() {
                indices = Some(number);
            }
            semantic.map(|s| (Valid(s), number))
        };
        Primitive {
            attributes: self
                .arrays()
                .zip(numbers)
                .filter_map(&mut attribute)
                .collect(),
            indices,
            material: Some(self.material.number),
            mode: Valid(Mode::Triangles),
            targets: None,
            extensions: None,
            extras: None,
        }
    }

    fn accessor(&self, array: Array) -> Accessor {
        let p = self.source;
        let bounds = (array == Array::Positions).then(|| bounds(&p.positions));
        Accessor {
            buffer_view: None,
            byte_offset: Some(self.offsets[array as usize].into()),
            count: array.count(p).into(),
            component_type: Valid(GenericComponentType(array.component(p))),
            type_: Valid(array.elements()),
            min: bounds.map(|(min, _)| min.into()),
            max: bounds.map(|(_, max)| max.into()),
            name: None,
            normalized: false,
            sparse: None,
            extensions: None,
            extras: None,
        }
    }
}
