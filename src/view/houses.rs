//! The model of a text, house by house: a page that has most of the houses from the revision before reads only the others.
//!
//! A house is known by its key, which is the same for what looks the same and stands in the same place. Where its parts are
//! written and what it is called is no part of it: that changes for all houses behind the one that is being written.

use super::made::{STEM, print};
use crate::backend::gltf::Glb;
use crate::backend::images::Library;
use crate::backend::{Images, SurfaceFiles};
use crate::scene::{Image, Material, Mesh, Node, Primitive, Scene};
use crate::source::Span;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::hash::Hash;
use std::ops::Range;

/// The houses of a text.
pub(super) struct Houses {
    scene: Scene,
    library: Library,
    houses: Vec<House>,
    /// How many nodes are written, then where each is, as [`Houses::others`] hands it out.
    places: Vec<u8>,
}

/// A house of a scene.
struct House {
    nodes: Range<usize>,
    key: String,
}

impl Houses {
    /// The houses of a scene, and the pictures beside their model by their names in it.
    pub(super) fn new(scene: Scene, library: Library) -> (Houses, BTreeMap<String, Vec<u8>>) {
        let (glb, files) = Glb::beside(&scene, &library, STEM);
        let nodes: Vec<(usize, &Node)> = glb.nodes().collect();
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

    /// All of them, as a `.glb` with its pictures beside it.
    pub(super) fn whole(&self) -> Vec<u8> {
        let (glb, _) = Glb::beside(&self.scene, &self.library, STEM);
        glb.bytes()
    }

    /// The key and the name of each.
    pub(super) fn known(&self) -> impl Iterator<Item = (&str, &str)> {
        let named = |house: &House| self.scene.nodes[house.nodes.start].called();
        self.houses.iter().map(move |h| (&*h.key, named(h)))
    }

    /// Where everything is written.
    pub(super) fn places(&self) -> &[u8] {
        &self.places
    }

    /// Where all parts are written, and the houses that are not among those which somebody has; `None` where that is all of
    /// them.
    ///
    /// Numbers are u32, little-endian: how many nodes the whole has; for each, in its order, the number of its source, and
    /// its first byte there and the one behind its last (`u32::MAX`, 0, 0 = it is not written); how many houses follow, and
    /// the number of each; then a `.glb` of them, if there are any.
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
            out.extend(Glb::houses(&self.scene, &self.library, STEM, &nodes).bytes());
        }
        Some(out)
    }
}

/// Where a node is written.
fn place(node: &Node) -> [u32; 3] {
    let nowhere = [u32::MAX, 0, 0];
    node.span.map_or(nowhere, |Span { file, start, end }| {
        [u32::from(file.0), start, end]
    })
}

/// The houses among the nodes that are written, and their keys.
fn houses(scene: &Scene, images: &dyn Images, nodes: &[(usize, &Node)]) -> Vec<House> {
    let looks: Vec<u64> = scene.materials.iter().map(|m| look(m, images)).collect();
    let mut shapes: Vec<Option<u64>> = vec![None; scene.meshes.len()];
    let mut shape = |mesh: usize| {
        let known = shapes.get_mut(mesh)?;
        Some(*known.get_or_insert_with(|| outline(&scene.meshes[mesh], &looks)))
    };
    let mut alike: HashMap<u64, u32> = HashMap::new();
    let groups = nodes.chunk_by(|_, (_, node)| node.parent.is_some());
    let house = |group: &[(usize, &Node)]| {
        let (first, last) = (group[0].0, group[group.len() - 1].0);
        let key = print(|p| {
            for (number, node) in group {
                (number - first).hash(p);
                lines(node, first).hash(p);
                node.mesh.and_then(|m| shape(m.0 as usize)).hash(p);
            }
        });
        // Of houses that are alike in everything each has a key of its own.
        let count = alike.entry(key).and_modify(|n| *n += 1).or_default();
        House {
            nodes: first..last + 1,
            key: format!("{key:016x}{count}"),
        }
    };
    groups.map(house).collect()
}

/// What of a node is seen or told, but for its mesh and what a house is called; nodes go by their places behind the first
/// one.
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
        span: _,
        shape,
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

/// What is the same for meshes that are alike, whatever they are called.
fn outline(mesh: &Mesh, looks: &[u64]) -> u64 {
    let Mesh {
        name: _,
        primitives,
    } = mesh;
    print(|p| {
        for primitive in primitives {
            let Primitive {
                material,
                positions,
                normals,
                uvs,
                mirror_uvs,
                indices,
            } = primitive;
            looks.get(material.0 as usize).hash(p);
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

/// What is the same for materials that look alike, whatever they are called.
fn look(material: &Material, images: &dyn Images) -> u64 {
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
        print(|p| (files.metres.to_bits(), files.color.bytes, others).hash(p))
    };
    let picture = match image {
        Image::None => None,
        // Drawn by the program itself.
        Image::Surface(name) => Some(print(|p| name.hash(p))),
        Image::Picture(index) => images.picture(*index).map(|f| print(|p| f.bytes.hash(p))),
        Image::Baked(index) => images.baked(*index).map(drawn),
    };
    print(|p| {
        (tint.map(f32::to_bits), picture).hash(p);
        [roughness, metallic].map(|x| x.to_bits()).hash(p);
        (double_sided, cutout, mirrored).hash(p);
        reflection.map(f32::to_bits).hash(p);
    })
}
