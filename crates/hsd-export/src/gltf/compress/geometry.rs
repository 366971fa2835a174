//! The meshes of a packed model: all of them at once, since their arrays are packed together.

use super::super::arrays::{Array, MaterialRef};
use super::super::materials::MaterialRefs;
use super::super::shapes::{arrays, primitive};
use crate::spool::List;
use crate::{Images, sound};
use gltf::json::{Index, Mesh};
use hsd_scene::Scene;
use std::io;

/// A primitive to be written.
pub(super) struct Piece<'a> {
    pub(super) source: &'a hsd_scene::Primitive,
    pub(super) material: MaterialRef,
    /// Its first accessor; those of its other arrays follow.
    pub(super) first: u32,
}

/// All meshes that nodes show.
pub(super) struct Geometry<'a> {
    /// The glTF number of each mesh of the scene.
    numbers: Vec<Option<Index<Mesh>>>,
    pub(super) pieces: Vec<Piece<'a>>,
}

impl<'a> Geometry<'a> {
    /// Lists the meshes and numbers their materials.
    pub(super) fn new(
        scene: &'a Scene,
        materials: &mut MaterialRefs,
        images: &dyn Images,
        meshes: &mut List,
    ) -> io::Result<Geometry<'a>> {
        let mut geometry = Geometry {
            numbers: vec![None; scene.meshes.len()],
            pieces: vec![],
        };
        let mut accessors = 0;
        for id in scene.nodes.iter().filter_map(|node| node.mesh) {
            let at = id.0 as usize;
            if geometry.numbers.get(at).is_none_or(Option::is_some) {
                continue;
            }
            let mesh = &scene.meshes[at];
            let first = geometry.pieces.len();
            let sound = |p: &&hsd_scene::Primitive| sound::primitive(p, &scene.materials);
            for source in mesh.primitives.iter().filter(sound) {
                let material = &scene.materials[source.material.0 as usize];
                let piece = Piece {
                    source,
                    material: materials.of(source.material, material, images),
                    first: accessors,
                };
                accessors += piece.arrays().count() as u32;
                geometry.pieces.push(piece);
            }
            let own = &geometry.pieces[first..];
            if !own.is_empty() {
                let number = meshes.push(&Mesh {
                    name: (!mesh.name.is_empty()).then(|| mesh.name.clone()),
                    primitives: own.iter().map(|p| primitive(p.material, p.first)).collect(),
                    weights: None,
                    extensions: None,
                    extras: None,
                })?;
                geometry.numbers[at] = Some(Index::new(number));
            }
        }
        Ok(geometry)
    }

    /// Returns the glTF number of a node's mesh.
    pub(super) fn mesh(&self, node: &hsd_scene::Node) -> Option<Index<Mesh>> {
        let mesh = node.mesh?.0 as usize;
        self.numbers.get(mesh).copied().flatten()
    }
}

impl Piece<'_> {
    /// Returns its arrays in the order of their accessors.
    pub(super) fn arrays(&self) -> impl Iterator<Item = Array> + use<> {
        arrays(self.material)
    }
}
