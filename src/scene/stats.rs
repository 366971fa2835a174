//! The size of a scene.

use super::Scene;

/// Counts of a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// Visible triangles: those of a mesh count once per node that shows it.
    pub triangles: usize,
    /// Stored triangles.
    pub unique_triangles: usize,
    /// Number of meshes.
    pub meshes: usize,
    /// Number of nodes.
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
