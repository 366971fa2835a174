//! Parallel projection: the nearest triangle along each ray.

use crate::raster::Grid;
use glam::{DVec2, DVec3};
use hsd_scene::{MaterialId, Node, NodeId, Scene};

/// The axes of a camera: right, up, and the viewing direction.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    right: DVec3,
    up: DVec3,
    way: DVec3,
}

impl Frame {
    /// Creates an upright camera with this viewing direction.
    pub fn new(way: DVec3) -> Frame {
        let way = way.normalize();
        let right = way.cross(DVec3::Z).try_normalize().unwrap_or(DVec3::X);
        Frame {
            right,
            up: right.cross(way),
            way,
        }
    }

    /// Projects a point to the image plane.
    pub fn of(&self, p: DVec3) -> DVec2 {
        DVec2::new(self.right.dot(p), self.up.dot(p))
    }

    /// Returns the depth of a point along the viewing direction.
    pub fn depth(&self, p: DVec3) -> f64 {
        self.way.dot(p)
    }

    /// Returns the viewing direction.
    pub fn way(&self) -> DVec3 {
        self.way
    }
}

/// A triangle in world space.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    /// Corners in metres.
    pub corners: [DVec3; 3],
    /// Unit normals at the corners.
    pub normals: [DVec3; 3],
    /// Texture coordinates at the corners.
    pub uvs: [DVec2; 3],
    /// The material; `None` for the ground.
    pub material: Option<MaterialId>,
}

impl Triangle {
    /// Returns the texture coordinates at barycentric weights.
    pub(super) fn uv(&self, [a, b, c]: [f64; 3]) -> DVec2 {
        self.uvs[0] * a + self.uvs[1] * b + self.uvs[2] * c
    }

    /// Creates a triangle of the ground.
    pub(super) fn ground(corners: [DVec3; 3]) -> Triangle {
        Triangle {
            corners,
            normals: [DVec3::Z; 3],
            uvs: [DVec2::ZERO; 3],
            material: None,
        }
    }
}

/// The transform of a node to world space: a rotation about the vertical and a translation.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// The rotation as (cos, sin).
    pub turn: DVec2,
    /// The translation in metres.
    pub at: DVec3,
}

impl Place {
    /// Transforms a direction to world space.
    pub fn way(&self, v: DVec3) -> DVec3 {
        self.turn.rotate(v.truncate()).extend(v.z)
    }

    /// Transforms a point to world space.
    pub fn point(&self, p: DVec3) -> DVec3 {
        self.way(p) + self.at
    }
}

/// Returns the transforms of all nodes. Parents precede their children, so one pass suffices.
pub fn places(scene: &Scene) -> Vec<Place> {
    let mut places: Vec<Place> = Vec::with_capacity(scene.nodes.len());
    for node in &scene.nodes {
        let own = Place {
            turn: node.turn,
            at: node.at,
        };
        places.push(match node.parent {
            None => own,
            Some(parent) => {
                let above = places[parent.0 as usize];
                Place {
                    turn: above.turn.rotate(node.turn),
                    at: above.point(node.at),
                }
            }
        });
    }
    places
}

/// Returns the root of each node.
pub fn roots(scene: &Scene) -> Vec<NodeId> {
    let mut roots: Vec<NodeId> = Vec::with_capacity(scene.nodes.len());
    for (n, node) in (0..).zip(&scene.nodes) {
        let above = node.parent.map(|parent| roots[parent.0 as usize]);
        roots.push(above.unwrap_or(NodeId(n)));
    }
    roots
}

/// Converts a vertex position or normal.
pub(super) fn point(p: [f32; 3]) -> DVec3 {
    DVec3::from_array(p.map(f64::from))
}

/// Adds the triangles of a node in world space.
pub fn pour(scene: &Scene, node: &Node, place: Place, into: &mut Vec<Triangle>) {
    let Some(mesh) = node.mesh else {
        return;
    };
    for primitive in &scene.meshes[mesh.0 as usize].primitives {
        for t in primitive.indices.chunks_exact(3) {
            let corner = |k: usize| t[k] as usize;
            into.push(Triangle {
                corners: [0, 1, 2].map(|k| place.point(point(primitive.positions[corner(k)]))),
                normals: [0, 1, 2].map(|k| place.way(point(primitive.normals[corner(k)]))),
                uvs: [0, 1, 2].map(|k| {
                    let uv = primitive.uvs[corner(k)].map(f64::from);
                    DVec2::from_array(uv)
                }),
                material: Some(primitive.material),
            });
        }
    }
}

/// Returns all triangles of some houses, given by their root nodes, in world space.
pub fn triangles(scene: &Scene, houses: &[NodeId]) -> Vec<Triangle> {
    let mut found = vec![];
    let nodes = scene.nodes.iter().zip(places(scene)).zip(roots(scene));
    for ((node, place), _) in nodes.filter(|(_, root)| houses.contains(root)) {
        pour(scene, node, place, &mut found);
    }
    found
}

/// The nearest intersection of a ray.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Distance along the ray in metres.
    pub depth: f64,
    /// The index of the triangle.
    pub triangle: u32,
    /// Barycentric weights of its corners.
    pub weights: [f32; 3],
}

/// The nearest hits of a grid of rays.
pub struct View {
    /// The axes of the camera.
    pub frame: Frame,
    /// The rays.
    pub grid: Grid,
    /// Hits by ray index.
    pub hits: Vec<Option<Hit>>,
}

impl View {
    /// Casts all rays on triangles; `open` tells whether a triangle has a hole at some weights.
    pub fn of(
        triangles: &[Triangle],
        frame: Frame,
        grid: Grid,
        open: impl Fn(&Triangle, [f64; 3]) -> bool,
    ) -> View {
        let mut hits: Vec<Option<Hit>> = vec![None; grid.width * grid.height];
        for (index, triangle) in triangles.iter().enumerate() {
            let corners = triangle.corners.map(|p| frame.of(p));
            let depths = triangle.corners.map(|p| frame.depth(p));
            grid.meet(corners, |place, weights| {
                let [a, b, c] = [0, 1, 2].map(|k| depths[k] * weights[k]);
                let depth = a + b + c;
                let hit = &mut hits[place];
                if hit.is_none_or(|h| depth < h.depth) && !open(triangle, weights) {
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
