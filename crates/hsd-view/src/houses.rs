//! Models house by house: a page that has most houses of the previous revision loads only the others.
//!
//! Houses are identified by keys that depend on shape, material and position. Names and source locations are not part of
//! them, since editing a house shifts the locations of all houses after it.

use super::fingerprint::fingerprint;
use hsd_base::source::Span;
use hsd_export::gltf::{Glb, glb_of_houses, written_nodes};
use hsd_export::images::Library;
use hsd_export::{Images, SurfaceFiles};
use hsd_scene::{Image, Material, Mesh, Node, Primitive, Scene};
use std::collections::{BTreeMap, HashMap, HashSet};
use std::hash::Hash;
use std::ops::Range;

/// The name of the model, and of the folder of its textures.
const STEM: &str = "house";

/// The houses of a source file.
pub(super) struct Houses {
    scene: Scene,
    library: Library,
    houses: Vec<House>,
    /// The number of nodes and their source locations, encoded as in [`Houses::others`].
    places: Vec<u8>,
}

/// A house of a scene.
struct House {
    nodes: Range<usize>,
    key: String,
}

impl Houses {
    /// Divides a scene into houses; returns them with the external textures of the model by name.
    pub(super) fn new(scene: Scene, library: Library) -> (Houses, BTreeMap<String, Vec<u8>>) {
        let (_, files) = Glb::beside(&scene, &library, STEM);
        let written = written_nodes(&scene).into_iter();
        let nodes: Vec<(usize, &Node)> = written.map(|i| (i, &scene.nodes[i])).collect();
        let houses = houses(&scene, &library, &nodes);
        let mut places = (nodes.len() as u32).to_le_bytes().to_vec();
        for number in nodes.iter().flat_map(|(_, node)| place(node)) {
            places.extend(number.to_le_bytes());
        }
        let files = files.into_iter();
        let pictures = files.map(|f| (f.name, f.bytes.into_owned())).collect();
        let houses = Houses {
            houses,
            places,
            scene,
            library,
        };
        (houses, pictures)
    }

    /// Returns the whole model as a `.glb` with external textures.
    pub(super) fn whole(&self) -> Vec<u8> {
        let (glb, _) = Glb::beside(&self.scene, &self.library, STEM);
        glb.bytes()
    }

    /// Returns the keys and names of all houses.
    pub(super) fn known(&self) -> impl Iterator<Item = (&str, &str)> {
        let named = |house: &House| self.scene.nodes[house.nodes.start].called();
        self.houses.iter().map(move |h| (&*h.key, named(h)))
    }

    /// Returns the encoded source locations of all nodes.
    pub(super) fn places(&self) -> &[u8] {
        &self.places
    }

    /// Returns the source locations of all nodes and the houses whose keys are not in `had`; `None` if that is all houses.
    ///
    /// The encoding, with numbers as little-endian u32: the number of nodes; for each node its source, start and end byte
    /// offset (`u32::MAX`, 0, 0 if it has none); the number of houses that follow and the index of each; a `.glb` of these
    /// houses, if there are any.
    pub(super) fn others(&self, had: &[String]) -> Option<Vec<u8>> {
        let had: HashSet<&str> = had.iter().map(|key| &**key).collect();
        let lacks = |number: &usize| !had.contains(&*self.houses[*number].key);
        let lacks: Vec<usize> = (0..self.houses.len()).filter(lacks).collect();
        if lacks.len() == self.houses.len() {
            return None;
        }
        let mut out = self.places.clone();
        for number in [lacks.len()].iter().chain(&lacks) {
            out.extend((*number as u32).to_le_bytes());
        }
        if !lacks.is_empty() {
            let nodes = lacks
                .iter()
                .map(|number| self.houses[*number].nodes.clone());
            let nodes: Vec<_> = nodes.collect();
            out.extend(glb_of_houses(&self.scene, &self.library, STEM, &nodes).bytes());
        }
        Some(out)
    }
}

/// Returns the source location of a node.
fn place(node: &Node) -> [u32; 3] {
    let nowhere = [u32::MAX, 0, 0];
    node.span
        .map_or(nowhere, |Span { file, start, end }| [file.0, start, end])
}

/// Groups the exported nodes by house and computes the keys.
fn houses(scene: &Scene, images: &dyn Images, nodes: &[(usize, &Node)]) -> Vec<House> {
    let materials: Vec<u64> = scene
        .materials
        .iter()
        .map(|m| material_fingerprint(m, images))
        .collect();
    let mut shapes: Vec<Option<u64>> = vec![None; scene.meshes.len()];
    let mut shape = |mesh: usize| {
        let known = shapes.get_mut(mesh)?;
        Some(*known.get_or_insert_with(|| mesh_fingerprint(&scene.meshes[mesh], &materials)))
    };
    let mut alike: HashMap<u64, u32> = HashMap::new();
    let groups = nodes.chunk_by(|_, (_, node)| node.parent.is_some());
    let house = |group: &[(usize, &Node)]| {
        let (first, last) = (group[0].0, group[group.len() - 1].0);
        let key = fingerprint(|p| {
            for (number, node) in group {
                (number - first).hash(p);
                lines(node, first).hash(p);
                node.mesh.and_then(|m| shape(m.0 as usize)).hash(p);
            }
        });
        // Identical houses get distinct keys.
        let count = alike.entry(key).and_modify(|n| *n += 1).or_default();
        House {
            nodes: first..last + 1,
            key: format!("{key:016x}{count}"),
        }
    };
    groups.map(house).collect()
}

/// Returns the hashed properties of a node, except for its mesh and the name of a house. Nodes are numbered relative to
/// `first`.
fn lines(node: &Node, first: usize) -> impl Hash + use<'_> {
    let Node {
        parent,
        kind,
        name,
        at,
        turn,
        mesh: _,
        code,
        storey,
        facade: _,
        names: _,
        span: _,
        file: _,
        place: _,
        shape,
        stretched: _,
    } = node;
    (
        parent.map(|p| (p.0 as usize).wrapping_sub(first)),
        kind.word(),
        parent.map(|_| name),
        at.to_array().map(f64::to_bits),
        turn.to_array().map(f64::to_bits),
        code.as_deref(),
        storey,
        shape.as_deref(),
    )
}

/// Returns the fingerprint of a mesh, without its name.
fn mesh_fingerprint(mesh: &Mesh, materials: &[u64]) -> u64 {
    let Mesh {
        name: _,
        primitives,
    } = mesh;
    fingerprint(|p| {
        for primitive in primitives {
            let Primitive {
                material,
                positions,
                normals,
                uvs,
                mirror_uvs,
                indices,
            } = primitive;
            materials.get(material.0 as usize).hash(p);
            for triples in [positions, normals] {
                triples.len().hash(p);
                triples.iter().for_each(|t| t.map(f32::to_bits).hash(p));
            }
            for pairs in [uvs, mirror_uvs] {
                pairs.len().hash(p);
                pairs.iter().for_each(|t| t.map(f32::to_bits).hash(p));
            }
            indices.hash(p);
        }
    })
}

/// Returns the fingerprint of a material, without its name.
fn material_fingerprint(material: &Material, images: &dyn Images) -> u64 {
    let Material {
        name: _,
        image,
        tint,
        roughness,
        metallic,
        double_sided,
        cutout,
        reflection,
        mirrored,
    } = material;
    let drawn = |files: SurfaceFiles<'_>| {
        let others = [files.normal, files.orm].map(|file| file.map(|f| f.bytes));
        fingerprint(|p| (files.metres.to_bits(), files.color.bytes, others).hash(p))
    };
    let picture = match image {
        Image::None => None,
        // Procedural textures are identified by name.
        Image::Surface(name) => Some(fingerprint(|p| name.hash(p))),
        Image::Picture(index) => images
            .picture(*index)
            .map(|f| fingerprint(|p| f.bytes.hash(p))),
        Image::Baked(index) => images.baked(*index).map(drawn),
    };
    fingerprint(|p| {
        (tint.map(f32::to_bits), picture).hash(p);
        [roughness, metallic].map(|x| x.to_bits()).hash(p);
        (double_sided, cutout, mirrored).hash(p);
        reflection.map(f32::to_bits).hash(p);
    })
}
