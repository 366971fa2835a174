//! What is seen along parallel lines of sight: the nearest triangle on each.

use super::raster::Grid;
use crate::scene::{MaterialId, NodeId, Scene};
use glam::{DVec2, DVec3};

/// Axes of an eye: to the right, up, and the way it looks.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    right: DVec3,
    up: DVec3,
    way: DVec3,
}

impl Frame {
    /// An eye that looks this way and holds its head upright.
    pub fn new(way: DVec3) -> Frame {
        let way = way.normalize();
        let right = way.cross(DVec3::Z).try_normalize().unwrap_or(DVec3::X);
        Frame {
            right,
            up: right.cross(way),
            way,
        }
    }

    /// A point as the eye sees it.
    pub fn of(&self, p: DVec3) -> DVec2 {
        DVec2::new(self.right.dot(p), self.up.dot(p))
    }

    /// How far away a point is.
    pub fn depth(&self, p: DVec3) -> f64 {
        self.way.dot(p)
    }

    /// Where the eye looks.
    pub fn way(&self) -> DVec3 {
        self.way
    }
}

/// A triangle in the world.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    /// Metres.
    pub corners: [DVec3; 3],
    /// At the corners, of unit length.
    pub normals: [DVec3; 3],
    /// Texture coordinates at the corners.
    pub uvs: [DVec2; 3],
    /// `None` = the ground.
    pub material: Option<MaterialId>,
}

impl Triangle {
    /// A piece of the ground.
    pub(super) fn ground(corners: [DVec3; 3]) -> Triangle {
        Triangle {
            corners,
            normals: [DVec3::Z; 3],
            uvs: [DVec2::ZERO; 3],
            material: None,
        }
    }
}

/// All triangles of some houses, each given by its node, in the world.
pub fn triangles(scene: &Scene, houses: &[NodeId]) -> Vec<Triangle> {
    // Nodes stand behind their parents: one walk tells where each is, and whose.
    let mut places: Vec<Option<(DVec2, DVec3)>> = Vec::with_capacity(scene.nodes.len());
    let mut found = vec![];
    for (n, node) in scene.nodes.iter().enumerate() {
        let place = match node.parent {
            None => houses
                .contains(&NodeId(n as u32))
                .then_some((node.turn, node.at)),
            Some(parent) => places[parent.0 as usize].map(|(turn, at)| {
                let here = turn.rotate(node.at.truncate()).extend(node.at.z) + at;
                (turn.rotate(node.turn), here)
            }),
        };
        places.push(place);
        let (Some((turn, at)), Some(mesh)) = (place, node.mesh) else {
            continue;
        };
        let rotated = |p: [f32; 3]| {
            let p = DVec3::from_array(p.map(f64::from));
            turn.rotate(p.truncate()).extend(p.z)
        };
        for primitive in &scene.meshes[mesh.0 as usize].primitives {
            for t in primitive.indices.chunks_exact(3) {
                let corner = |k: usize| t[k] as usize;
                found.push(Triangle {
                    corners: [0, 1, 2].map(|k| rotated(primitive.positions[corner(k)]) + at),
                    normals: [0, 1, 2].map(|k| rotated(primitive.normals[corner(k)])),
                    uvs: [0, 1, 2].map(|k| {
                        let uv = primitive.uvs[corner(k)].map(f64::from);
                        DVec2::from_array(uv)
                    }),
                    material: Some(primitive.material),
                });
            }
        }
    }
    found
}

/// What one line of sight meets first.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Metres along the line.
    pub depth: f64,
    /// Index of the triangle.
    pub triangle: u32,
    /// Shares of its corners there.
    pub weights: [f32; 3],
}

/// The nearest hit on every line.
pub struct View {
    /// How the eye stands.
    pub frame: Frame,
    /// Its lines of sight.
    pub grid: Grid,
    /// By their places in the grid.
    pub hits: Vec<Option<Hit>>,
}

impl View {
    /// Looks at triangles.
    pub fn of(triangles: &[Triangle], frame: Frame, grid: Grid) -> View {
        let mut hits: Vec<Option<Hit>> = vec![None; grid.width * grid.height];
        for (index, triangle) in triangles.iter().enumerate() {
            let corners = triangle.corners.map(|p| frame.of(p));
            let depths = triangle.corners.map(|p| frame.depth(p));
            grid.meet(corners, |place, weights| {
                let [a, b, c] = [0, 1, 2].map(|k| depths[k] * weights[k]);
                let depth = a + b + c;
                let hit = &mut hits[place];
                if hit.is_none_or(|h| depth < h.depth) {
                    *hit = Some(Hit {
                        depth,
                        triangle: index as u32,
                        weights: weights.map(|w| w as f32),
                    });
                }
            });
        }
        View { frame, grid, hits }
    }
}
