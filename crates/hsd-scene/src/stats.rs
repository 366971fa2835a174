//! The size of a scene.

use super::{Mesh, Scene, ScenePart};

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

/// Counts houses as they pass.
#[derive(Clone, Debug, Default)]
pub struct Counter {
    stats: Stats,
    /// The triangles of each mesh.
    sizes: Vec<u32>,
}

impl Counter {
    /// Counts some houses, after all that stand before them.
    pub fn add(&mut self, part: ScenePart<'_>) {
        let size = |mesh: &Mesh| mesh.primitives.iter().map(|p| p.indices.len() / 3).sum();
        let sizes: Vec<usize> = part.meshes.iter().map(size).collect();
        self.sizes.extend(sizes.iter().map(|size| *size as u32));
        let shown = part.nodes.iter().filter_map(|node| node.mesh);
        let shown = shown.filter_map(|mesh| self.sizes.get(mesh.0 as usize));
        self.stats.triangles += shown.map(|size| *size as usize).sum::<usize>();
        self.stats.unique_triangles += sizes.iter().sum::<usize>();
        self.stats.meshes += sizes.len();
        self.stats.nodes += part.nodes.len();
    }

    /// Returns the counts of all houses.
    pub fn stats(&self) -> Stats {
        self.stats
    }
}

impl Scene {
    /// Counts its triangles, meshes and nodes.
    pub fn stats(&self) -> Stats {
        let mut counter = Counter::default();
        counter.add(self.whole());
        counter.stats()
    }
}
