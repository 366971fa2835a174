//! Writes a model house by house.

use super::joined::{FEATURES, Group};
use super::materials::{MaterialRefs, Materials};
use super::nodes::{Tree, kept};
use super::shapes::Shapes;
use super::{Glb, Gltf, Model};
use crate::merged::MergedHouses;
use crate::spool::{NewSpool, in_memory};
use crate::{Images, OutFile, sound};
use gltf::json::{Asset, Extras, Root};
use hsd_scene::{Detail, Material, MeshId, Provenance, Scene, ScenePart};
use serde::Serialize;
use serde_json::value::to_raw_value;
use std::collections::BTreeMap;
use std::io;
use std::ops::Range;

/// A model that takes houses one after another. It keeps what does not fit into the file yet in spools, so the memory
/// it takes grows by a few bytes for each mesh and house.
pub struct Writer<'n> {
    pub(super) new: NewSpool<'n>,
    pub(super) materials: MaterialRefs,
    pub(super) shapes: Shapes,
    pub(super) tree: Tree,
    /// The houses that are still to be written, if houses have common meshes.
    pub(super) group: Group,
    joins: bool,
    merges: bool,
    /// The number of houses that were merged.
    merged: u32,
    /// The level of detail of the houses.
    detail: Detail,
    provenance: Provenance,
}

impl<'n> Writer<'n> {
    /// Creates a model without houses that keeps its content in these spools.
    ///
    /// # Errors Those of the spools.
    pub fn new(new: NewSpool<'n>) -> io::Result<Writer<'n>> {
        Ok(Writer {
            new,
            materials: MaterialRefs::default(),
            shapes: Shapes::new(new)?,
            tree: Tree::new(new)?,
            group: Group::default(),
            joins: false,
            merges: false,
            merged: 0,
            detail: Detail::default(),
            provenance: Provenance::default(),
        })
    }

    /// From now on, some hundred houses of detail 0 have one mesh. Meshes of all houses must be in the parts that show them:
    /// see `SceneBuilder::forget_twins`.
    #[must_use]
    pub fn joining(self, joins: bool) -> Writer<'n> {
        Writer { joins, ..self }
    }

    /// From now on, each house is one mesh with a primitive for each material. As for [`joining`](Writer::joining), the meshes
    /// of all houses must be in the parts that show them.
    #[must_use]
    pub fn merging(self, merges: bool) -> Writer<'n> {
        Writer { merges, ..self }
    }

    /// From now on, vertices have no tangents.
    #[must_use]
    pub fn without_tangents(mut self, without: bool) -> Writer<'n> {
        self.materials.no_tangents = without;
        self
    }

    /// From now on, normals and tangents are written as bytes (KHR_mesh_quantization).
    #[must_use]
    pub fn quantizing(mut self, quantizes: bool) -> Writer<'n> {
        self.shapes.quantized = quantizes;
        self
    }

    /// Tells what the model is made from.
    pub fn made_from(&mut self, provenance: &Provenance) {
        self.provenance = provenance.clone();
    }

    /// Adds houses. Images must be there, except baked pages, which are needed at the end only.
    ///
    /// # Errors Those of the spools.
    pub fn add(&mut self, part: ScenePart<'_>, images: &dyn Images) -> io::Result<()> {
        self.detail = part.detail;
        self.materials.flat = part.detail == Detail::Body;
        if self.joins && self.materials.flat {
            return self.join(part, images);
        }
        if self.merges {
            let houses = MergedHouses::of(part, self.merged);
            self.merged += houses.count();
            return self.add_nodes(houses.part(part), images);
        }
        self.add_nodes(part, images)
    }

    /// Adds houses as they are.
    fn add_nodes(&mut self, part: ScenePart<'_>, images: &dyn Images) -> io::Result<()> {
        for id in part.nodes.iter().filter_map(|node| node.mesh) {
            let materials = (&mut self.materials, images);
            self.shapes.mesh(id, part, materials, self.new)?;
        }
        let shapes = &self.shapes;
        self.tree.add(part, |id| shapes.number(id).flatten())
    }

    /// Numbers the materials of houses that are not written, so that those of others have the same numbers and names.
    pub(super) fn number_materials(&mut self, part: ScenePart<'_>, images: &dyn Images) {
        self.materials.flat = part.detail == Detail::Body;
        let mut seen = vec![false; part.meshes.len()];
        let mut first = |id: MeshId| {
            let seen = seen.get_mut(id.0.checked_sub(part.first_mesh)? as usize)?;
            (!std::mem::replace(seen, true)).then_some(id)
        };
        let shown = part
            .nodes
            .iter()
            .filter_map(|node| node.mesh.and_then(&mut first));
        let meshes = shown.filter_map(|id| part.mesh(id));
        for p in meshes.flat_map(|mesh| &mesh.primitives) {
            if sound::primitive(p, part.materials) {
                let material = &part.materials[p.material.0 as usize];
                self.materials.of(p.material, material, images);
            }
        }
    }

    /// Returns the model as a `.glb` with embedded images. `materials` are those of the scene, `grown` the factors by
    /// which distances from the upper edge of each baked page have grown.
    ///
    /// # Errors Those of the spools.
    pub fn glb<'a>(
        self,
        materials: &'a [Material],
        images: &'a dyn Images,
        grown: &[f32],
    ) -> io::Result<Glb<'a>> {
        Ok(Glb::inside_of(self.model(materials, images, grown)?))
    }

    /// Returns the model as `stem.glb`, and its images in the folder `stem_textures`.
    ///
    /// # Errors Those of the spools.
    pub fn glb_beside<'a>(
        self,
        materials: &'a [Material],
        images: &'a dyn Images,
        grown: &[f32],
        stem: &str,
    ) -> io::Result<(Glb<'a>, Vec<OutFile<'a>>)> {
        let model = self.model(materials, images, grown)?;
        Ok(Glb::beside_of(model, stem))
    }

    /// Returns the model as `stem.gltf`, its `stem.bin`, and its images in the folder `stem_textures`.
    ///
    /// # Errors Those of the spools.
    pub fn gltf<'a>(
        self,
        materials: &'a [Material],
        images: &'a dyn Images,
        grown: &[f32],
        stem: &str,
    ) -> io::Result<Gltf<'a>> {
        Ok(Gltf::of(self.model(materials, images, grown)?, stem))
    }

    pub(super) fn model<'a>(
        mut self,
        materials: &'a [Material],
        images: &'a dyn Images,
        grown: &[f32],
    ) -> io::Result<Model<'a>> {
        self.write_group()?;
        self.shapes.stretch(grown)?;
        let mut root = root();
        root.asset.extras = made_from(&self.provenance, self.detail);
        if self.group.is_used() {
            root.extensions_used.push(FEATURES.to_owned());
        }
        let materials = Materials::new(&self.materials, materials, images, &mut root);
        let (accessors, meshes, sections, length) = self.shapes.into_views(&mut root);
        Ok(Model {
            nodes: self.tree.into_nodes(&mut root),
            root,
            accessors,
            meshes,
            sections,
            materials,
            embedded: false,
            length,
            #[cfg(feature = "compress")]
            unpacked: 0,
        })
    }
}

/// Returns some houses of a scene, given by their nodes: the part of [`Glb::beside`] that shows them, with its images.
pub fn glb_of_houses<'a>(
    scene: &'a Scene,
    images: &'a dyn Images,
    stem: &str,
    houses: &[Range<usize>],
) -> Glb<'a> {
    let write = || {
        let mut writer = Writer::new(&in_memory)?;
        writer.made_from(&scene.provenance);
        // Names of images are those of the whole model.
        writer.number_materials(scene.whole(), images);
        for house in houses {
            writer.add(scene.part(house.clone()), images)?;
        }
        writer.model(&scene.materials, images, &[])
    };
    Glb::beside_of(write().expect("memory takes every byte"), stem).0
}

/// Returns the extras of an asset; none if nothing is known of its files.
pub(super) fn made_from(provenance: &Provenance, detail: Detail) -> Extras {
    #[derive(Serialize)]
    struct MadeFrom<'a> {
        files: &'a [String],
        #[serde(skip_serializing_if = "Option::is_none")]
        seed: Option<u64>,
        #[serde(skip_serializing_if = "BTreeMap::is_empty")]
        parameters: BTreeMap<&'a str, &'a str>,
        detail: usize,
    }
    if provenance.files.is_empty() {
        return None;
    }
    let parameters = provenance.parameters.iter();
    let made = MadeFrom {
        files: &provenance.files,
        seed: provenance.seed,
        parameters: parameters
            .map(|(name, value)| (&**name, &**value))
            .collect(),
        detail: detail as usize,
    };
    to_raw_value(&made).ok()
}

/// Returns an empty root.
pub(super) fn root() -> Root {
    Root {
        asset: Asset {
            generator: Some(concat!("hsd ", env!("CARGO_PKG_VERSION")).into()),
            ..Asset::default()
        },
        ..Root::default()
    }
}

/// Returns the numbers of the nodes of a scene that are written, in the order of the file.
pub fn written_nodes(scene: &Scene) -> Vec<usize> {
    let shapes: Vec<bool> = scene
        .meshes
        .iter()
        .map(|m| {
            let mut all = m.primitives.iter();
            all.any(|p| sound::primitive(p, &scene.materials))
        })
        .collect();
    let has_shape = |id: MeshId| shapes.get(id.0 as usize) == Some(&true);
    let kept = kept(scene.whole(), has_shape);
    (0..kept.len()).filter(|i| kept[*i]).collect()
}
