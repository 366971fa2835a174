//! How big a scene is.

use super::Scene;

/// Counts of a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// Triangles that are seen: those of a mesh as often as nodes show it.
    pub triangles: usize,
    /// Triangles that are stored.
    pub unique_triangles: usize,
    /// Meshes.
    pub meshes: usize,
    /// Nodes.
    pub nodes: usize,
}

impl Scene {
    /// Counts its triangles, meshes and nodes.
    pub fn stats(&self) -> Stats {
        let sizes: Vec<usize> = self
            .meshes
            .iter()
            .map(|mesh| mesh.primitives.iter().map(|p| p.indices.len() / 3).sum())
            .collect();
        let shown = self.nodes.iter().filter_map(|node| node.mesh);
        Stats {
            triangles: shown.map(|mesh| sizes[mesh.0 as usize]).sum(),
            unique_triangles: sizes.iter().sum(),
            meshes: self.meshes.len(),
            nodes: self.nodes.len(),
        }
    }
}
