//! Some houses of a scene: what a back end that takes houses one after another is given at a time.

use super::{Detail, Material, Mesh, MeshId, Node, Scene};
use std::ops::Range;

/// Consecutive houses of a scene, and the meshes that are there for them.
#[derive(Clone, Copy, Debug)]
pub struct ScenePart<'s> {
    /// The level of detail.
    pub detail: Detail,
    /// The materials of the scene so far.
    pub materials: &'s [Material],
    /// Meshes, the first of which has the number `first_mesh`.
    pub meshes: &'s [Mesh],
    /// The number of the first of the meshes.
    pub first_mesh: u32,
    /// The nodes of whole houses, the first of which has the number `first_node`.
    pub nodes: &'s [Node],
    /// The number of the first of the nodes.
    pub first_node: u32,
    /// True if all of it has been looked at and nothing is flawed.
    pub sound: bool,
}

impl<'s> ScenePart<'s> {
    /// Returns the nodes of a range, which are those of whole houses, with all meshes.
    pub fn part(&self, nodes: Range<usize>) -> ScenePart<'s> {
        ScenePart {
            first_node: self.first_node + nodes.start as u32,
            nodes: &self.nodes[nodes],
            ..*self
        }
    }

    /// Returns the mesh of a number, if it is there.
    pub fn mesh(&self, id: MeshId) -> Option<&'s Mesh> {
        let at = id.0.checked_sub(self.first_mesh)?;
        self.meshes.get(at as usize)
    }

    /// Returns the index of a node's parent in `nodes`.
    pub fn parent(&self, index: usize) -> Option<usize> {
        let parent = self.nodes[index].parent?.0.checked_sub(self.first_node)? as usize;
        (parent < index).then_some(parent)
    }
}

impl Scene {
    /// Returns all of the scene.
    pub fn whole(&self) -> ScenePart<'_> {
        ScenePart {
            detail: self.detail,
            materials: &self.materials,
            meshes: &self.meshes,
            first_mesh: 0,
            first_node: 0,
            nodes: &self.nodes,
            sound: false,
        }
    }

    /// Returns the nodes of a range, which are those of whole houses, with all meshes.
    pub fn part(&self, nodes: Range<usize>) -> ScenePart<'_> {
        self.whole().part(nodes)
    }
}
