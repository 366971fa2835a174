//! The part of a scene that is written: what its nodes show.

use crate::backend::sound;
use crate::scene::{self, Scene};

/// The meshes and materials that nodes show, by their numbers in the scene; others would only make the file larger.
pub(super) struct Shown<'a> {
    /// Primitives that can be written, each with the number of its mesh.
    pub(super) primitives: Vec<(usize, &'a scene::Primitive)>,
    /// For each material, true if it is on one of them.
    pub(super) materials: Vec<bool>,
}

impl<'a> Shown<'a> {
    pub(super) fn new<'n>(
        scene: &'a Scene,
        nodes: impl IntoIterator<Item = &'n scene::Node>,
    ) -> Shown<'a> {
        let mut used = vec![false; scene.meshes.len()];
        for mesh in nodes.into_iter().filter_map(|n| n.mesh) {
            if let Some(u) = used.get_mut(mesh.0 as usize) {
                *u = true;
            }
        }
        let mut materials = vec![false; scene.materials.len()];
        let mut primitives = vec![];
        for (i, mesh) in scene.meshes.iter().enumerate().filter(|(i, _)| used[*i]) {
            let sound = |p: &&scene::Primitive| sound::primitive(p, scene);
            for p in mesh.primitives.iter().filter(sound) {
                materials[p.material.0 as usize] = true;
                primitives.push((i, p));
            }
        }
        Shown {
            primitives,
            materials,
        }
    }
}
